// Functions that several overlays use.
#pragma once

#include "view/overlays.h"

#include <span>
#include <vector>

namespace weft::overlay {

/// Weighted means of values per particle.
class ParticleMeans {
  public:
    explicit ParticleMeans(std::uint32_t particle_count) : sums_(particle_count), weights_(particle_count) {}
    void add(std::uint32_t particle, double value, double weight = 1) {
        sums_[particle] += value * weight;
        weights_[particle] += weight;
    }
    /// 0 for particles without values.
    std::vector<float> result() const;

  private:
    std::vector<double> sums_, weights_;
};

/// Converts values per particle to values per vertex of the drawn mesh. Interpolates if the mesh is bound to particles.
/// 0 for a vertex without particles and for a value that is not finite.
std::vector<float> at_vertices(const ClothModel& model, std::span<const float> of_particles);

/// The first drawn vertex of each particle; `none` if the drawn mesh is a different mesh.
std::vector<std::uint32_t> first_vertices(const ClothModel& model);

/// Positions of the anchors of a cloth's attachments at the end of the frame.
std::vector<Vec3> anchor_places(const WorldFrame& world, const ClothFrame& cloth, double time);

/// Scales a size in pixels from an image of height 720 to this image; at least `size`.
float pixels(const OverlayInput& input, float size);

/// Both add nothing if a position is not finite.
void add_line(std::vector<render::Line>& lines, Vec3 from, Vec3 to, Vec4 color, float width);
void add_point(std::vector<render::Point>& points, Vec3 at, Vec4 color, float size);

/// Size of a pixel in m, in an image that shows the scene from top to bottom.
float pixel_size(const OverlayInput& input);

/// Offset of lines from the cloth that they lie on, to either side, in m: less than half a pixel, and small compared
/// with its triangles.
float lift(const OverlayInput& input, const ClothModel& model);

/// Adds a line on each side of the surface, because either side may be visible.
void add_line_on_surface(std::vector<render::Line>& lines, Vec3 from, Vec3 to, Vec3 from_normal, Vec3 to_normal,
                         float lifted, Vec4 color, float width);

/// Bounds of all finite drawn positions of all cloths.
Bounds bounds_of_cloths(const OverlayInput& input);

}  // namespace weft::overlay
