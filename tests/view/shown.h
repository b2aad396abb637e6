// A world for overlays, with particle positions that a test chooses.
#pragma once

#include "../physics/sheet.h"
#include "view/overlays.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace weft::physical {

class Shown {
  public:
    /// The last frame.
    explicit Shown(const World& world, float size = 0.7f) : world_(world), frame_(world.frame()), size_(size) {
        for (ClothFrame& cloth : frame_.cloths) {
            particles_.emplace_back(cloth.positions.begin(), cloth.positions.end());
            particle_normals_.emplace_back(cloth.normals.begin(), cloth.normals.end());
        }
        follow();
    }
    Shown(const Shown&) = delete;
    Shown& operator=(const Shown&) = delete;

    /// Moves each particle of all cloths to `pose(rest position)`.
    template <class Pose>
    void place(Pose&& pose) {
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            for (std::uint32_t p = 0; p < particles_[i].size(); ++p) {
                const Vec3 x = pose(frame_.cloths[i].model->rest_position(p));
                Vec4& now = particles_[i][p];
                now = {x.x, x.y, x.z, now.w};
            }
        }
        follow();
    }

    /// Sets the contact marks of a particle of the first cloth.
    void mark(std::uint32_t particle, std::uint32_t marks) { frame_.cloths[0].contact_marks.at(particle) = marks; }

    OverlayOutput draw(std::string_view name, std::uint32_t width = 1280, std::uint32_t height = 720) {
        return draw({name}, width, height);
    }
    OverlayOutput draw(std::initializer_list<std::string_view> names, std::uint32_t width = 1280,
                       std::uint32_t height = 720) {
        std::vector<const Overlay*> chosen;
        for (const std::string_view name : names) chosen.push_back(find_overlay(name).value());
        return draw_overlays(
            chosen,
            {.world = world_, .frame = frame_, .fields = fields_, .size = size_, .width = width, .height = height});
    }

    const Frame& frame() const { return frame_; }
    const std::vector<Vec3>& positions(std::size_t cloth = 0) const {
        return frame_.cloths[cloth].render_mesh().positions;
    }
    const std::vector<Vec3>& normals(std::size_t cloth = 0) const { return frame_.cloths[cloth].render_mesh().normals; }

    std::size_t kept_fields() const { return fields_.count(); }

  private:
    void follow() {
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            frame_.cloths[i].positions = particles_[i];
            frame_.cloths[i].normals = particle_normals_[i];
            frame_.cloths[i].invalidate();
        }
    }

    LiveWorldFrame world_;
    Frame frame_;
    FieldSurfaces fields_;
    float size_;
    std::vector<std::vector<Vec4>> particles_, particle_normals_;
};

/// The text of an entry of the first legend.
inline std::string entry(const OverlayOutput& output, std::size_t number) {
    return output.legends.at(0).entries.at(number).text;
}

/// A sheet with a render mesh.
inline std::shared_ptr<const ClothModel> make_bound_sheet(std::array<std::uint32_t, 2> simulated, TriangleMesh drawn) {
    TriangleMesh mesh = make_grid({1, 1}, simulated, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    auto built = build_cloth_model({.name = "sheet", .mesh = std::move(mesh), .render_mesh = std::move(drawn)},
                                   std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

}  // namespace weft::physical
