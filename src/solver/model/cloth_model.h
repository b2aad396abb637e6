// The immutable data of a cloth: everything that does not change while it moves. Identical cloths can share one model.
#pragma once

#include "base/collision_filter.h"
#include "base/shared_array.h"
#include "collide/tiles.h"
#include "mesh/topology.h"
#include "mesh/triangle_view.h"
#include "scene/fabric.h"
#include "solver/model/binding.h"
#include "solver/model/build_times.h"
#include "solver/model/cloth_weights.h"
#include "solver/model/constraint_table.h"
#include "solver/model/faces_around.h"
#include "solver/model/faces_by_tile.h"
#include "solver/model/hierarchy.h"
#include "solver/model/pin_spans.h"

#include <weft/result.h>

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The pins of a cloth.
struct ClothPins {
    std::vector<std::uint32_t> particles = {};  ///< rigidly pinned; in any order, repetitions allowed
    std::vector<Attachment> attachments = {};   ///< springs to anchors
};

/// Optional parts of a model, needed by some solver settings.
struct ClothLayout {
    bool lines = false;      ///< stretch constraints ordered along lines
    bool hierarchy = false;  ///< coarse levels
    friend bool operator==(const ClothLayout&, const ClothLayout&) = default;
};

/// With which cloth a cloth collides.
struct ClothCollision {
    SelfCollision with_cloth = SelfCollision::off;
    CollisionFilter filter = {};  ///< for other cloths
    std::uint32_t layer = 0;      ///< a higher one lies in front of lower ones
    bool surface = false;         ///< the surface of a collider (collider_surface.h), which collides with exact cloth

    /// Whether the cloth meets the triangles of colliders that have a surface, not their shapes.
    bool meets_surfaces() const { return with_cloth == SelfCollision::exact && !surface; }
};

/// Whether two cloths of a world collide with each other.
inline bool can_collide(const ClothCollision& a, const ClothCollision& b) {
    if (a.surface || b.surface) return a.surface ? b.meets_surfaces() : a.meets_surfaces();
    return a.with_cloth != SelfCollision::off && b.with_cloth != SelfCollision::off && collide(a.filter, b.filter);
}

/// Room for particles and constraints that are added while the cloth moves (cloth_edit.h).
struct ClothReserve {
    std::uint32_t particles = 0;
    std::uint32_t constraints = 0;  ///< per kind of constraint that the cloth has
    bool openings = false;          ///< its edges can be opened: it has a tear table, and room for second halves
    bool tears = false;             ///< it tears by itself where its load exceeds the fabric's limits; implies openings
    bool erodes = false;            ///< where it tears, triangles are removed; implies tears
};

class PartingMesh;
struct TearTable;
struct TearLaw;
struct TearPaint;
struct PrunedLevels;

struct ClothModelDesc {
    std::string name = {};
    TriangleMesh mesh = {};                        ///< simulated mesh, in world space, m
    std::optional<TriangleMesh> render_mesh = {};  ///< drawn mesh, follows `mesh`; nullopt: `mesh` is drawn
    Vec3 start_velocity = {};                      ///< m/s
    Fabric fabric = {};
    ClothWeights weights = {};
    ClothCollision collision = {};
    ClothPins pins = {};
    ClothLayout layout = {};
    ClothReserve reserve = {};
    ColoringOptions coloring = {};
    BuildTimes build_times = {};  ///< of earlier parts, such as the topology
};

using EdgeEnds = std::array<std::uint32_t, 2>;

/// Directions of the edges, and the edges without a stretch constraint. Axial edges are within 10° of warp or weft.
struct ClothEdges {
    std::vector<bool> axial_rows;       ///< per row of the stretch table: whether its edge is axial
    std::vector<EdgeEnds> without_row;  ///< edges without a stretch constraint, axial ones first
    std::size_t axial_without_row = 0;  ///< number of axial edges in `without_row`
};

/// Copies share the arrays.
struct ClothModel {
    std::string name;
    /// Binding of the render mesh to the simulated mesh. Empty if they are the same.
    Binding binding;
    SharedArray<std::uint32_t> vertex_to_particle;  ///< as in Topology, and appended vertices; empty with a binding
    Fabric fabric;                                  ///< `tether.use` is on or off, never automatic
    std::shared_ptr<const ClothWeights> weights = std::make_shared<ClothWeights>();
    Tethers tethers_asked = Tethers::automatic;  ///< `tether.use` as requested
    ClothCollision collision;

    std::uint32_t particle_count = 0;
    ClothReserve reserved = {};      ///< reserve at build time
    std::uint32_t reserve = 0;       ///< unused points after the particles, for appended particles
    std::uint32_t anchor_count = 0;  ///< anchors of attachments, stored after the reserve; inverse mass 0
    std::uint32_t anchor_room = 0;   ///< largest number of anchors
    std::uint32_t pinned_count = 0;
    SharedArray<Vec4> start;   ///< m and 1/kg: position and inverse mass; padded to capacity()
    Vec3 start_velocity = {};  ///< m/s, of the particles that are not pinned
    SharedArray<float> mass;   ///< kg, per particle, pinned ones included
    float extent = 0;          ///< m, of the cloth at rest
    /// Factors on the fabric's thickness, per particle; padded to capacity(). Empty: 1 everywhere.
    SharedArray<float> thickness_factors;
    std::array<float, 2> thickness_range = {1, 1};  ///< least and largest of them

    std::array<ConstraintTable, constraint_kind_count> constraints;
    SharedArray<CoarseLevel> hierarchy;  ///< finest level first; empty if not requested or of no use
    std::vector<PinSpan> pin_spans;      ///< only with a hierarchy
    /// Per particle, with a hierarchy: how much heavier it is near its pin, 1/s² (physics/pin_load/pin_load.md), and
    /// the particle that is its pin. Padded to capacity(); empty if no pin bears much.
    SharedArray<float> steadiness;
    SharedArray<std::uint32_t> pin_of;
    /// Null unless the coarse levels are older than the triangles, and were pruned (pruned_limits.h).
    std::shared_ptr<const PrunedLevels> pruned;
    Elasticity elasticity;
    /// Triangle corners for the surface passes: [corner · face_stride + triangle], padded with dummies.
    SharedArray<std::uint32_t> faces;
    SharedArray<float> face_area;  ///< m², per triangle at rest; 0 if it was removed
    SharedArray<float> face_warp;  ///< rad, per triangle at rest: from its first side to the warp, about its normal
    std::uint32_t triangle_count = 0, face_stride = 0;
    std::shared_ptr<const FacesAround> around = std::make_shared<FacesAround>();  ///< its `nothing` is face_stride
    std::shared_ptr<const ClothEdges> edges = std::make_shared<ClothEdges>();
    std::shared_ptr<const FacesByTile> faces_by_tile = std::make_shared<FacesByTile>();
    float mean_edge = 0, longest_edge = 0;           ///< m, at rest
    std::shared_ptr<const std::vector<Tile>> tiles;  ///< null if the cloth has no exact contact with cloth
    /// Particles along a curve through the cloth; null if it has no contact of particles with cloth.
    std::shared_ptr<const std::vector<std::uint32_t>> along_curve;
    std::uint64_t topology_version = first_topology_version;
    std::shared_ptr<const TearTable> tears;       ///< null unless its edges can be opened
    std::shared_ptr<const TearLaw> tear_law;      ///< null unless it tears by itself
    std::shared_ptr<const TearPaint> tear_paint;  ///< null: it is as strong as its fabric everywhere
    /// Per appended particle, the first of which follows those that the cloth was built with: the particle it is a copy
    /// of.
    SharedArray<std::uint32_t> copied_from;
    SharedArray<Vec4> contact_rest;  ///< rest_for_contact(); empty: `start`
    SharedArray<float> strayed;      ///< OpenedArrays::strayed; empty without openings
    /// Null unless the edges can be opened and the render mesh is not the simulated one, vertex by vertex.
    std::shared_ptr<const PartingMesh> parting;

    BuildTimes build_times;

    /// The drawn mesh at rest, without normals: normals are computed from the moving surface. Thread-safe.
    const TriangleMesh& mesh() const;
    void set_mesh(TriangleMesh mesh);
    /// Sets a mesh whose positions and triangles are those of the particles. They are computed by the first call of
    /// mesh(), on any thread.
    void set_mesh_of_particles(std::vector<Vec2> uvs, std::vector<Vec4> colors);

    bool has_pin_loads() const { return !steadiness.empty(); }
    /// Sets the coarse levels and what was found with them. `at_rest`: m, by particle.
    void set_hierarchy(Hierarchy found, std::span<const Vec3> at_rest);
    /// Sets `tiles` and `along_curve` for the current triangles and particles.
    void make_tiles_if_needed();

    /// Whether the render mesh is the simulated one, vertex by vertex.
    bool mesh_is_of_particles() const { return drawn_->of_particles && binding.empty(); }
    /// Appends vertices to a mesh of particles, before the particles are appended: copies of the vertices of `sources`.
    void append_vertices(const std::vector<std::uint32_t>& sources);
    /// Recomputes a mesh of particles, or one that parts, from the current particles and triangles.
    void reset_mesh();
    /// The most vertices that openings and edits can still append to the drawn mesh; an upper bound.
    std::size_t spare_vertices() const;

    /// Points are ordered: particles, reserved particles, anchors, reserved anchors.
    std::uint32_t first_anchor() const { return particle_count + reserve; }
    /// Particles, reserved particles and anchors: the points that a step processes.
    std::uint32_t point_count() const { return first_anchor() + anchor_count; }
    /// All points, including reserved anchors.
    std::uint32_t room() const { return first_anchor() + anchor_room; }
    /// Length of particle arrays: room() plus padding and dummies.
    std::uint32_t capacity() const { return particle_capacity(room()); }
    /// m, per particle: at rest, for contact of features.
    const Vec4* rest_of_features() const { return contact_rest.empty() ? start.data() : contact_rest.data(); }
    Vec3 rest_position(std::uint32_t particle) const { return start[particle].xyz(); }
    /// Triangles of particles at the start; ClothFrame has the current ones.
    TriangleView triangles() const { return {faces.data(), face_stride, triangle_count}; }
    const ConstraintTable& table(ConstraintKind kind) const { return constraints[static_cast<std::uint32_t>(kind)]; }
    /// Floats that constraints keep from frame to frame: the multipliers of stretch, then the shifts of moment,
    /// Step::shift_c of all and shift_d of all.
    std::size_t kept_floats() const { return first_shift() + 2 * std::size_t{table(ConstraintKind::moment).stride}; }
    std::size_t first_shift() const { return table(ConstraintKind::stretch).lambda_count(); }

  private:
    struct Drawn {
        bool of_particles = false;
        TriangleMesh mesh;
        std::once_flag made;
    };
    std::shared_ptr<Drawn> drawn_ = std::make_shared<Drawn>();
};

/// Calls visit(ends, axial) for every edge, in no particular order; `axial`: along warp or weft.
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

/// All edges, each with its lower end first, sorted; `axial`: along warp or weft.
struct EdgesByDirection {
    std::vector<EdgeEnds> axial, others;
};
EdgesByDirection edges_by_direction(const ClothModel& model);

/// Velocity of every point at the start: that of the model for particles that are not pinned, 0 for all other points.
/// capacity() elements; w is 0.
std::vector<Vec4> start_velocities(const ClothModel& model);

/// Particles that are rigidly pinned, ascending.
std::vector<std::uint32_t> pinned_particles(const ClothModel& model);

/// kg
float face_mass(const ClothModel& model, std::uint32_t triangle);
/// Mass of every triangle in kg; 0 for padding.
std::vector<float> face_masses(const ClothModel& model);
/// The stiffness of the fabric where its weight is the least.
StretchMaterial softest_stretch(const ClothModel& model);
/// For limits: of the softest place, under the load of a cloth that is as heavy as its heaviest place.
Elasticity elasticity_of(const ClothModel& model);
/// kg/m², mean over the triangles.
double mean_density(const ClothModel& model);
/// Mass of each particle, for the present triangles.
AlignedVector<float> masses_of(const ClothModel& model);

/// Builds a model. `topology` is that of `desc.mesh`. Fails if the density is ≤ 0 or not finite, if the inverse of a
/// particle mass is not > 0 and finite in float, if a pinned or attached particle is out of range, if a compliance is
/// not > 0 and finite, or if the render mesh is malformed. If edges can be opened, triangles that the topology leaves
/// out are not drawn either.
Result<std::shared_ptr<const ClothModel>> build_cloth_model(ClothModelDesc desc, Topology topology);

/// What differs in a model that change_cloth_model() builds.
struct ClothChange {
    Fabric fabric = {};
    ClothWeights weights = {};
    ClothPins pins = {};
    ClothLayout layout = {};
    ClothCollision collision = {};
    /// Another one than the model has. It then has no tear paint. Only if its drawn mesh is that of its particles.
    std::optional<ClothReserve> reserve = {};
};

/// Builds a model of the same mesh. `mesh` and `topology` are those that `from` was built from.
Result<std::shared_ptr<const ClothModel>> change_cloth_model(const ClothModel& from, const TriangleMesh& mesh,
                                                             const Topology& topology, const ClothChange& change);

/// Returns the same constraints with the parameters of another fabric. Compliances, masses, inverse masses and
/// elasticity have the bits that build_cloth_model() gives. All other arrays are shared with `from`, so coarse levels
/// and tethers remain those of its fabric. Returns null if the fabric needs other constraints, or parameters that this
/// function cannot compute: if a stiffness changes between zero and nonzero, if the stretch model, bending edges, bend
/// model or rest angle change, if the stiffness of membranes, plates or weighted moments changes, or if the tether
/// settings change. Fails like build_cloth_model().
Result<std::shared_ptr<const ClothModel>> with_fabric(const ClothModel& from, const Fabric& fabric);
/// ClothModel::kept_floats() for a model that replaces another one: the shifts, if both have the same moment
/// constraints.
std::vector<float> kept_after(const ClothModel& before, std::span<const float> kept, const ClothModel& after);
/// Returns the same model with other attachments. All arrays except `start` and the attachment constraints are shared
/// with `from`. Returns null if there is no room for so many attachments. Fails like build_cloth_model().
Result<std::shared_ptr<const ClothModel>> with_attachments(const ClothModel& from,
                                                           const std::vector<Attachment>& attachments);
/// Whether the two fabrics give different coarse levels or tethers.
bool limits_differ(const Fabric& a, const Fabric& b);

}  // namespace weft
