// What several overlays need.
#pragma once

#include "view/overlays.h"

#include <span>
#include <vector>

namespace weft::overlay {

/// Means of values that particles gather.
class ParticleMeans {
  public:
    explicit ParticleMeans(std::uint32_t particle_count) : sums_(particle_count), weights_(particle_count) {}
    void add(std::uint32_t particle, double value, double weight = 1) {
        sums_[particle] += value * weight;
        weights_[particle] += weight;
    }
    /// 0 where there was nothing to gather.
    std::vector<float> result() const;

  private:
    std::vector<double> sums_, weights_;
};

/// Of particles' values, those of the drawn mesh's vertices: between particles where the mesh is bound to them, 0 where
/// a vertex belongs to none or the value is not finite.
std::vector<float> at_vertices(const ClothModel& model, std::span<const float> of_particles);

/// The first drawn vertex of each particle; `none` where the drawn mesh is another one.
std::vector<std::uint32_t> first_vertices(const ClothModel& model);

/// Where the anchors of a cloth's attachments are at the end of the frame.
std::vector<Vec3> anchor_places(const World& world, const ClothFrame& cloth, double time);

/// Pixels for something of that size in a picture of 720 rows; never thinner than `size`.
float pixels(const OverlayInput& input, float size);

/// Nothing where an end is not finite.
void add_line(std::vector<render::Line>& lines, Vec3 from, Vec3 to, Vec4 color, float width);
void add_point(std::vector<render::Point>& points, Vec3 at, Vec4 color, float size);

/// m: of a picture that shows the scene from top to bottom.
float pixel_size(const OverlayInput& input);

/// m: how far lines that lie on a cloth are lifted off it, to either side: less than half a pixel, and little beside
/// its triangles.
float lift(const OverlayInput& input, const ClothModel& model);

/// A line on each side of the surface that it lies on, as either may be seen.
void add_line_on_surface(std::vector<render::Line>& lines, Vec3 from, Vec3 to, Vec3 from_normal, Vec3 to_normal,
                         float lifted, Vec4 color, float width);

/// Of finite drawn positions, all cloths.
Bounds bounds_of_cloths(const OverlayInput& input);

}  // namespace weft::overlay
