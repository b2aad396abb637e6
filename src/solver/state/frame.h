// Results of a step, read-only.
#pragma once

#include "mesh/triangle_view.h"
#include "solver/model/cloth_edit.h"
#include "solver/model/cloth_model.h"
#include "solver/plan/pass.h"
#include "solver/state/cloth_contact_counts.h"
#include "solver/state/contact_marks.h"
#include "solver/state/list_counts.h"

#include <weft/ids.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Bits that report problems of a step; combined with |.
enum Report : std::uint32_t {
    report_none = 0,
    report_speed_capped = 1u << 0,   ///< particles exceeded the speed cap and were slowed to it
    report_non_finite = 1u << 1,     ///< a NaN or infinity arose; the cloth is restored to the start of the frame
    report_device_failed = 1u << 2,  ///< the device is lost or out of memory; the state is that of the last read
    report_contacts_full = 1u << 3,  ///< some contacts are missing; sums are complete, the next frame has room
};

/// The names of the bits, in the order of the bits.
std::vector<std::string_view> report_names(std::uint32_t reports);

/// The render mesh of a cloth in one frame. Arrays have one element per vertex. Spans are valid as long as the frame.
struct RenderMesh {
    std::vector<Vec3> positions;  ///< m
    std::vector<Vec3> normals;    ///< unit
    std::span<const Triangle> triangles;
    std::span<const Vec2> uvs;             ///< empty if the mesh has none
    std::span<const Vec4> colors;          ///< empty if the mesh has none
    std::span<const Vec3> rest_positions;  ///< m
};

/// One cloth. Arrays have one element per particle, in the order of the model's topology.
struct ClothFrame {
    ClothId id;
    const ClothModel* model = nullptr;
    std::span<const Vec4> positions;   ///< m; w is the inverse mass, 1/kg
    std::span<const Vec4> velocities;  ///< m/s; w is internal
    std::span<const Vec4> normals;     ///< unit; empty if the settings disable the surface
    TriangleView triangles;            ///< of particles
    /// Changes whenever the triangles of the cloth or of its render mesh change.
    std::uint64_t topology_version = first_topology_version;
    std::uint32_t reports = report_none;
    /// Bits (ContactMark); empty unless WorldSettings::contact_marks was on in the frame.
    std::vector<std::uint32_t> contact_marks;
    std::vector<Opening> openings;  ///< where it has torn in the frame; the model has them already
    std::string detail;             ///< source of the first non-finite value, or the device's error message

    /// Computed by the first call in a frame, on any thread. Needs normals.
    const RenderMesh& render_mesh() const;
    /// Tangents of the render mesh's vertices, also computed by the first call: unit, w is the handedness
    /// (tangents.md). Empty if the mesh has no UVs.
    std::span<const Vec4> tangents() const;
    /// Must be called after the arrays of the frame have changed: discards the computed mesh and tangents.
    void invalidate() { computed_.clear(); }

  private:
    /// Copies are empty, because a copied frame may get other arrays. Assignment keeps the memory of the arrays.
    struct Computed {
        Computed() = default;
        Computed(const Computed&) {}
        Computed& operator=(const Computed&) {
            clear();
            return *this;
        }
        void clear() { has_mesh = has_tangents = false; }

        std::mutex mutex;
        RenderMesh mesh;
        std::vector<Vec4> tangents;
        std::atomic<bool> has_mesh = false, has_tangents = false;
    };
    mutable Computed computed_;
};

/// A particle of a cloth in a frame.
struct ParticlePlace {
    std::uint32_t cloth = 0, particle = 0;
    friend bool operator==(const ParticlePlace&, const ParticlePlace&) = default;
};

struct Frame {
    std::uint64_t index = 0;  ///< 0: the start
    double time = 0;          ///< s
    std::vector<ClothFrame> cloths;
    std::array<double, stage_count> stage_ms{};  ///< time in each stage, all cloths; see stage_name()
    /// Time in ms that the caller spent on the frame: to submit it, and to wait for the device. Time between the two is
    /// not included.
    double step_ms = 0;
    ListCounts lists;                   ///< of the dynamic lists of this frame
    ClothContactCounts cloth_contacts;  ///< of cloth against cloth in this frame
    /// Where cloth is tangled in this frame: the particle of `cloth_contacts.tangled_particle`.
    std::optional<ParticlePlace> tangled_at;
    std::uint32_t reports = report_none;  ///< bits of all cloths
};

/// Computes positions and normals of the render mesh's vertices. Needs the frame's normals. Without a separate render
/// mesh, vertices that no triangle uses keep their positions.
void draw_surface(const ClothFrame& cloth, std::vector<Vec3>& positions, std::vector<Vec3>& normals);

/// Computes tangents of the vertices: unit, w is the handedness (tangents.md). Empty without UVs.
void compute_tangents(std::span<const Triangle> triangles, std::span<const Vec2> uvs, std::span<const Vec3> positions,
                      std::span<const Vec3> normals, std::vector<Vec4>& tangents);

}  // namespace weft
