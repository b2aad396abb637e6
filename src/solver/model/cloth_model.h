// A cloth as it was made: everything that does not change while it moves. Shared by every cloth of its kind.
#pragma once

#include "mesh/topology.h"
#include "mesh/triangle_view.h"
#include "scene/fabric.h"
#include "solver/model/binding.h"
#include "solver/model/build_times.h"
#include "solver/model/constraint_table.h"
#include "solver/model/faces_around.h"
#include "solver/model/hierarchy.h"
#include "solver/model/pin_spans.h"

#include <weft/result.h>

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace weft {

/// What is held of a cloth.
struct ClothPins {
    std::vector<std::uint32_t> particles = {};  ///< of `topology`, without weight; in any order, repetitions allowed
    std::vector<Attachment> attachments = {};   ///< springs to anchors
};

/// What a model has beyond the plain rows, for steps that use it.
struct ClothLayout {
    bool lines = false;      ///< rows of stretch along lines
    bool hierarchy = false;  ///< coarse levels
    friend bool operator==(const ClothLayout&, const ClothLayout&) = default;
};

struct ClothModelDesc {
    std::string name = {};
    TriangleMesh mesh = {};                  ///< what is simulated, in world space, m
    std::optional<TriangleMesh> drawn = {};  ///< what is drawn in its place and follows it; without, `mesh`
    Fabric fabric = {};
    ClothPins pins = {};
    ClothLayout layout = {};
    ColoringOptions coloring = {};
    BuildTimes build_times = {};  ///< what went before: its topology
};

using EdgeEnds = std::array<std::uint32_t, 2>;

struct ClothModel {
    std::string name;
    /// How the drawn mesh follows the simulated one. Empty where they are the same.
    Binding binding;
    std::vector<std::uint32_t> vertex_to_particle;  ///< of the drawn mesh, as Topology has it; empty with a binding
    Fabric fabric;

    std::uint32_t particle_count = 0;
    std::uint32_t anchor_count = 0;  ///< points without weight behind the particles, which attachments hold on to
    std::uint32_t pinned_count = 0;
    AlignedVector<Vec4> start;  ///< m and 1/kg: position and inverse mass; padded to capacity()
    std::vector<float> mass;    ///< kg, per particle, pinned ones included

    std::array<ConstraintTable, constraint_kind_count> constraints;
    std::vector<CoarseLevel> hierarchy;  ///< the finest level first; empty if none was asked for, or none is of use
    std::vector<PinSpan> pin_spans;      ///< only with a hierarchy
    Elasticity elasticity;
    /// Corners of the triangles for the surface passes: [corner · stride + triangle], padded with dummies.
    AlignedVector<std::uint32_t> faces;
    std::uint32_t triangle_count = 0, face_stride = 0;
    FacesAround around;  ///< `nothing` is face_stride

    /// Edges are the rows of stretch, by row whether along warp or weft (within 10°), and those that have none, as
    /// nothing stretches there: of these the ones along warp or weft first, and how many they are.
    std::vector<bool> axial_rows;
    std::vector<EdgeEnds> edges_without_row;
    std::size_t axial_without_row = 0;
    float mean_edge = 0;  ///< m

    BuildTimes build_times;

    /// As drawn, without normals: cloth has those of its surface.
    const TriangleMesh& mesh() const;
    void set_mesh(TriangleMesh mesh);
    /// Likewise, and positions and triangles are those of the particles: they are not kept, but made when somebody asks
    /// first, in whatever thread.
    void set_mesh_of_particles(std::vector<Vec2> uvs, std::vector<Vec4> colors);

    /// Particles and anchors: what a step moves.
    std::uint32_t point_count() const { return particle_count + anchor_count; }
    std::uint32_t capacity() const { return particle_capacity(point_count()); }
    Vec3 rest_position(std::uint32_t particle) const { return start[particle].xyz(); }
    /// Of particles, as the cloth starts; what they are later stands in ClothFrame.
    TriangleView triangles() const { return {faces.data(), face_stride, triangle_count}; }
    const ConstraintTable& table(ConstraintKind kind) const { return constraints[static_cast<std::uint32_t>(kind)]; }

  private:
    bool mesh_of_particles_ = false;
    mutable TriangleMesh mesh_;
    mutable std::once_flag mesh_made_;
};

/// visit(ends, whether along warp or weft) for every edge, in no particular order.
template <class Visit>
void for_each_edge(const ClothModel& model, Visit&& visit) {
    const ConstraintTable& rows = model.table(ConstraintKind::stretch);
    for (std::uint32_t row = 0; row < rows.stride; ++row) {
        if (rows.is_real(row))
            visit(EdgeEnds{rows.particles[row], rows.particles[std::size_t{rows.stride} + row]}, model.axial_rows[row]);
    }
    for (std::size_t i = 0; i < model.edges_without_row.size(); ++i)
        visit(model.edges_without_row[i], i < model.axial_without_row);
}

/// All edges, ends ascending: those along warp or weft, and the others.
struct EdgesByDirection {
    std::vector<EdgeEnds> axial, others;
};
EdgesByDirection edges_by_direction(const ClothModel& model);

/// kg, of every triangle at rest, with padding, which weighs nothing.
std::vector<float> face_masses(const ClothModel& model);

/// `topology` is that of `desc.mesh`. Fails where values are such that no simulation could follow: density ≤ 0 or not
/// finite, total mass that float cannot hold, a pinned or attached particle out of range, a compliance that is not > 0
/// and finite, a drawn mesh that is not sound.
Result<std::shared_ptr<const ClothModel>> build_cloth_model(ClothModelDesc desc, Topology topology);

/// Another material or other pins for the same mesh. `mesh` and `topology` are those that `from` was built of.
Result<std::shared_ptr<const ClothModel>> change_cloth_model(const ClothModel& from, const TriangleMesh& mesh,
                                                             const Topology& topology, const Fabric& fabric,
                                                             const ClothPins& pins, const ClothLayout& layout = {});

}  // namespace weft
