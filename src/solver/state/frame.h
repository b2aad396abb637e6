// What a step leaves behind, to be read and never written.
#pragma once

#include "mesh/triangle_view.h"
#include "solver/model/cloth_model.h"
#include "solver/plan/pass.h"
#include "solver/state/list_counts.h"

#include <weft/ids.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// What went wrong in a step, or was held back; combined by or.
enum Report : std::uint32_t {
    report_none = 0,
    report_speed_capped = 1u << 0,   ///< particles went faster than the cap and were slowed to it
    report_non_finite = 1u << 1,     ///< a NaN or infinity arose; the cloth is back where the frame began
    report_device_failed = 1u << 2,  ///< the device is lost or out of memory; the cloth is as it was last read
    report_contacts_full =
        1u << 3,  ///< more contacts than there was room for; sums are complete, the next frame has room
};

/// The names of the bits, in the order of the bits.
std::vector<std::string_view> report_names(std::uint32_t reports);

/// What is drawn of a cloth at one moment. Arrays hold one element per vertex of its render mesh; spans point to what
/// stays for as long as the frame does.
struct RenderMesh {
    std::vector<Vec3> positions;  ///< m
    std::vector<Vec3> normals;    ///< unit
    std::span<const Triangle> triangles;
    std::span<const Vec2> uvs;             ///< empty if the mesh has none
    std::span<const Vec4> colors;          ///< likewise
    std::span<const Vec3> rest_positions;  ///< m
};

/// One cloth. Arrays hold one element per particle, in the order of the model's topology.
struct ClothFrame {
    ClothId id;
    const ClothModel* model = nullptr;
    std::span<const Vec4> positions;   ///< m; w is the inverse mass, 1/kg
    std::span<const Vec4> velocities;  ///< m/s; w is internal
    std::span<const Vec4> normals;     ///< unit; empty if the settings leave the surface out
    TriangleView triangles;            ///< of particles
    /// Another number whenever `triangles`, or those of the render mesh, have changed.
    std::uint64_t topology_version = first_topology_version;
    std::uint32_t reports = report_none;
    std::string detail;  ///< the first input or constraint that produced a non-finite value, or what the device says

    /// Computed by the first call in a frame, and costs nothing without one. Needs normals. Not for several threads at
    /// once.
    const RenderMesh& render_mesh() const;
    /// Of the render mesh's vertices, likewise: unit, in w the handedness (tangents.md). Empty if it has no UVs.
    std::span<const Vec4> tangents() const;
    /// Whoever writes other arrays into the frame says so: what was computed from those before is out of date.
    void invalidate() { has_render_mesh_ = has_tangents_ = false; }

  private:
    mutable RenderMesh render_mesh_;
    mutable std::vector<Vec4> tangents_;
    mutable bool has_render_mesh_ = false, has_tangents_ = false;
};

struct Frame {
    std::uint64_t index = 0;  ///< 0 is the start
    double time = 0;          ///< s
    std::vector<ClothFrame> cloths;
    std::array<double, stage_count> stage_ms{};  ///< time in each stage, all cloths; see stage_name()
    /// Of the caller's time, what the frame took: to submit it, and to wait for it where a device runs it. What the
    /// caller did in between does not count.
    double step_ms = 0;
    ListCounts lists;                     ///< of constraints that were found in this frame
    std::uint32_t reports = report_none;  ///< of all cloths
};

/// Positions and normals of the render mesh's vertices. Needs the frame's normals. Where drawn and simulated mesh are
/// the same, vertices that no triangle uses stay where the mesh has them.
void draw_surface(const ClothFrame& cloth, std::vector<Vec3>& positions, std::vector<Vec3>& normals);

/// Tangents of vertices with these positions and normals: unit, in w the handedness (tangents.md). Empty without UVs.
void compute_tangents(std::span<const Triangle> triangles, std::span<const Vec2> uvs, std::span<const Vec3> positions,
                      std::span<const Vec3> normals, std::vector<Vec4>& tangents);

}  // namespace weft
