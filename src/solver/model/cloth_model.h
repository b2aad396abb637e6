// A cloth as it was made: everything that does not change while it moves. Shared by every cloth of its kind.
#pragma once

#include "base/shared_array.h"
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

/// Room for what is added to a cloth while it moves (cloth_edit.h).
struct ClothReserve {
    std::uint32_t particles = 0;
    std::uint32_t constraints = 0;  ///< of each kind that the cloth has
};

struct ClothModelDesc {
    std::string name = {};
    TriangleMesh mesh = {};                  ///< what is simulated, in world space, m
    std::optional<TriangleMesh> drawn = {};  ///< what is drawn in its place and follows it; without, `mesh`
    Fabric fabric = {};
    ClothPins pins = {};
    ClothLayout layout = {};
    ClothReserve reserve = {};
    ColoringOptions coloring = {};
    BuildTimes build_times = {};  ///< what went before: its topology
};

using EdgeEnds = std::array<std::uint32_t, 2>;

/// Edges are the rows of stretch, by row whether along warp or weft (within 10°), and those that have none, as nothing
/// stretches there: of these the ones along warp or weft first, and how many they are.
struct ClothEdges {
    std::vector<bool> axial_rows;
    std::vector<EdgeEnds> without_row;
    std::size_t axial_without_row = 0;
};

/// A copy shares the arrays with the original.
struct ClothModel {
    std::string name;
    /// How the drawn mesh follows the simulated one. Empty where they are the same.
    Binding binding;
    SharedArray<std::uint32_t> vertex_to_particle;  ///< of the drawn mesh, as Topology has it; empty with a binding
    Fabric fabric;                                  ///< `tether.use` is never automatic: it says whether there are any
    Tethers tethers_asked = Tethers::automatic;     ///< what `tether.use` was before

    std::uint32_t particle_count = 0;
    ClothReserve reserved = {};      ///< when it was built
    std::uint32_t reserve = 0;       ///< points behind the particles that can become particles
    std::uint32_t anchor_count = 0;  ///< points without weight behind those, which attachments hold on to
    std::uint32_t anchor_room = 0;   ///< so many there can be
    std::uint32_t pinned_count = 0;
    SharedArray<Vec4> start;  ///< m and 1/kg: position and inverse mass; padded to capacity()
    SharedArray<float> mass;  ///< kg, per particle, pinned ones included
    float extent = 0;         ///< m, of the cloth at rest

    std::array<ConstraintTable, constraint_kind_count> constraints;
    SharedArray<CoarseLevel> hierarchy;  ///< the finest level first; empty if none was asked for, or none is of use
    std::vector<PinSpan> pin_spans;      ///< only with a hierarchy
    Elasticity elasticity;
    /// Corners of the triangles for the surface passes: [corner · stride + triangle], padded with dummies.
    SharedArray<std::uint32_t> faces;
    SharedArray<float> face_area;  ///< m², per triangle at rest
    std::uint32_t triangle_count = 0, face_stride = 0;
    std::shared_ptr<const FacesAround> around = std::make_shared<FacesAround>();  ///< `nothing` is face_stride
    std::shared_ptr<const ClothEdges> edges = std::make_shared<ClothEdges>();
    float mean_edge = 0;  ///< m
    std::uint64_t topology_version = first_topology_version;

    BuildTimes build_times;

    /// As drawn, without normals: cloth has those of its surface.
    const TriangleMesh& mesh() const;
    void set_mesh(TriangleMesh mesh);
    /// Likewise, and positions and triangles are those of the particles: they are not kept, but made when somebody asks
    /// first, in whatever thread.
    void set_mesh_of_particles(std::vector<Vec2> uvs, std::vector<Vec4> colors);

    /// Whether the render mesh is the simulated one, vertex by vertex.
    bool mesh_is_of_particles() const { return drawn_->of_particles && binding.empty(); }
    /// Adds vertices to such a mesh, for particles that are about to be appended: copies of those of `sources`.
    void append_vertices(const std::vector<std::uint32_t>& sources);
    /// Such a mesh is made anew of the particles and triangles as they are now.
    void reset_mesh();

    std::uint32_t first_anchor() const { return particle_count + reserve; }
    /// Particles, those to come, and anchors: what a step moves.
    std::uint32_t point_count() const { return first_anchor() + anchor_count; }
    /// And the anchors to come.
    std::uint32_t room() const { return first_anchor() + anchor_room; }
    std::uint32_t capacity() const { return particle_capacity(room()); }
    Vec3 rest_position(std::uint32_t particle) const { return start[particle].xyz(); }
    /// Of particles, as the cloth starts; what they are later stands in ClothFrame.
    TriangleView triangles() const { return {faces.data(), face_stride, triangle_count}; }
    const ConstraintTable& table(ConstraintKind kind) const { return constraints[static_cast<std::uint32_t>(kind)]; }

  private:
    struct Drawn {
        bool of_particles = false;
        TriangleMesh mesh;
        std::once_flag made;
    };
    std::shared_ptr<Drawn> drawn_ = std::make_shared<Drawn>();
};

/// visit(ends, whether along warp or weft) for every edge, in no particular order.
template <class Visit>
void for_each_edge(const ClothModel& model, Visit&& visit) {
    const ConstraintTable& rows = model.table(ConstraintKind::stretch);
    for (std::uint32_t row = 0; row < rows.stride; ++row) {
        if (rows.is_real(row))
            visit(EdgeEnds{rows.particles[row], rows.particles[std::size_t{rows.stride} + row]},
                  model.edges->axial_rows[row]);
    }
    for (std::size_t i = 0; i < model.edges->without_row.size(); ++i)
        visit(model.edges->without_row[i], i < model.edges->axial_without_row);
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

/// The same rows with the numbers of another material: compliances, masses, inverse masses and elasticity are those
/// that build_cloth_model() gives, bit by bit. All other arrays are shared with `from`: coarse levels and tethers are
/// still those of its fabric. Null where the fabric needs other rows, or rows that this cannot compute: where
/// constraints lose all stiffness or get some, other edges bend, by another model or from another angle, plates get
/// another stiffness, or tethers are asked for in another way. Fails as build_cloth_model() does.
Result<std::shared_ptr<const ClothModel>> with_fabric(const ClothModel& from, const Fabric& fabric);
/// The same cloth with other springs in place of those that it has. All other arrays are shared with `from`, but for
/// `start`. Null where there is no room for so many; fails as build_cloth_model() does.
Result<std::shared_ptr<const ClothModel>> with_attachments(const ClothModel& from,
                                                           const std::vector<Attachment>& attachments);
/// Whether coarse levels or tethers would not be the same for both.
bool limits_differ(const Fabric& a, const Fabric& b);

}  // namespace weft
