// The parts of a scene as plain structs with their defaults, in SI units. docs/scene.md describes them in more detail.
// Functions that take one of these structs check its ranges and return an error for each value that is out of range.
#pragma once

#include <weft/bounds.h>
#include <weft/mesh.h>
#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace weft {

/// `xpbd`: extended position-based dynamics, with stiffness in SI units, independent of the substeps. `pbd`: plain
/// position-based dynamics with the fabric's `stiffness`, for comparison.
enum class Method { xpbd, pbd };
/// `gauss_seidel`: one constraint after another, color by color. `lines`: the same, but the stretch constraints of a
/// whole line of edges are solved at once; not with `pbd`. `jacobi`: all constraints at once, averaged per particle;
/// converges more slowly. `automatic`: `lines` with `xpbd`, `gauss_seidel` with `pbd`.
enum class Projection { automatic, lines, gauss_seidel, jacobi };

/// How `jacobi` sums the corrections of a particle. `gather`: as floats in a fixed order. `fixed_point`: as multiples
/// of 1/65536 m in any order.
enum class Accumulate { gather, fixed_point };

/// Whether projections keep what rounding drops from the displacements of particles, and add it to the next substep. In
/// short substeps that is much of the displacements: cloth sags too far, and loses momentum. `automatic`: in substeps
/// shorter than 1/2600 s.
enum class Compensation { automatic, on, off };

/// All options of the solver. Scene files, Options::solver and the command line use the keys that
/// solver_keys lists (src/scene/scene_keys.h).
struct SolverDesc {
    std::uint32_t substeps = 20;   ///< per frame, 1…10000
    std::uint32_t iterations = 1;  ///< per substep, 1…10000
    Method method = Method::xpbd;
    Projection projection = Projection::automatic;
    Accumulate accumulate = Accumulate::gather;
    bool hierarchy = true;                                ///< solve coarse levels first: large cloths stretch less
    Compensation compensation = Compensation::automatic;  ///< not `on` with `pbd`
    friend bool operator==(const SolverDesc&, const SolverDesc&) = default;
};

/// Limits each particle's distance to its pins by the geodesic distance at rest. `automatic`: on if
/// SolverDesc::hierarchy is on, the fabric is inextensible and the cloth hangs by at most 16 places.
enum class Tethers { automatic, on, off };

/// Contact of a cloth with itself and with the other cloths that have it. `exact`: the cloth passes neither through
/// itself nor through another exact cloth. `fast`: particles keep a distance like spheres; several times cheaper, with
/// a wider gap and without that guarantee. An exact and a fast cloth meet as fast ones.
enum class SelfCollision { off, fast, exact };

/// Whether a cloth can part. `cuts`: where Simulation::cut() and cuts of the scene open it. `split`: also by itself,
/// along edges of its mesh, where its load exceeds the fabric's limits. `erode`: where an edge exceeds the fabric's
/// `tear_ratio`, a triangle at it is removed. Needs a mesh in which no edge has three triangles or more.
enum class Tearing { off, cuts, split, erode };

/// `smooth`: neighboring triangles get the same gust. `scattered`: each triangle has its own phase and frequency.
enum class GustPhase { smooth, scattered };

/// Change of a wind over time.
struct GustDesc {
    float amplitude = 0;     ///< largest change, as a fraction of the velocity, 0…100
    float frequency = 0.5f;  ///< gusts per second, 0…1000
    float scale = 4;         ///< m, > 0: distance across the wind at which gusts become independent
    GustPhase phase = GustPhase::smooth;
    friend bool operator==(const GustDesc&, const GustDesc&) = default;
};

/// Change of a wind from place to place.
struct TurbulenceDesc {
    float strength = 0;  ///< largest change, as a fraction of the velocity, 0…100
    float scale = 0.5f;  ///< m, > 0: size of an eddy across the wind
    float period = 1;    ///< s, ≥ 0: lifetime of an eddy; 0: eddies do not change
    friend bool operator==(const TurbulenceDesc&, const TurbulenceDesc&) = default;
};

/// Diagonals of the cells of a grid. `uniform`: all along +x+z. `alternating`: a checkerboard of both directions.
/// `cross`: both, with an additional vertex in the middle of each cell.
enum class GridDiagonal { uniform, alternating, cross };

/// A flat sheet in the xz plane, centered, facing +y. Its warp runs along x. Particle (ix, iz) is vertex
/// iz · resolution[0] + ix.
struct GridDesc {
    std::array<float, 2> size{1, 1};                  ///< m, > 0, along x and z
    std::array<std::uint32_t, 2> resolution{64, 64};  ///< particles along x and z, 2…4096 each
    GridDiagonal diagonal = GridDiagonal::alternating;
    friend bool operator==(const GridDesc&, const GridDesc&) = default;
};

/// A closed sphere about the origin with 10 · 4^subdivisions + 2 particles. The warp runs along x.
struct SphereMeshDesc {
    float radius = 0.5f;             ///< m, > 0
    std::uint32_t subdivisions = 4;  ///< how often the 20 triangles of an icosahedron are split into four, 0…7
    friend bool operator==(const SphereMeshDesc&, const SphereMeshDesc&) = default;
};

/// A closed box, centered at the origin.
struct BoxMeshDesc {
    std::array<float, 3> size{1, 1, 1};                   ///< m, > 0, along x, y and z
    std::array<std::uint32_t, 3> resolution{32, 32, 32};  ///< particles along x, y and z, 2…4096 each
    friend bool operator==(const BoxMeshDesc&, const BoxMeshDesc&) = default;
};

/// The axis of a file that points up; it is rotated to +y.
enum class UpAxis { x, y, z };

/// A mesh file, read by Options::read_mesh.
struct MeshFileDesc {
    std::string file = {};  ///< name of the file; read_mesh_file() lists the folders that are searched
    float scale = 1;        ///< m per unit of the file, > 0
    UpAxis up = UpAxis::y;
    friend bool operator==(const MeshFileDesc&, const MeshFileDesc&) = default;
};

/// The mesh of a cloth: generated, read from a file, or given in memory.
using MeshDesc = std::variant<GridDesc, SphereMeshDesc, BoxMeshDesc, MeshFileDesc, TriangleMesh>;

/// A point of a mesh is placed at R · (scale · point) + position.
struct TransformDesc {
    Vec3 position = {};          ///< m
    Vec3 rotation_degrees = {};  ///< R = Rz·Ry·Rx
    float scale = 1;             ///< > 0
    friend bool operator==(const TransformDesc&, const TransformDesc&) = default;
};

/// The same velocity everywhere.
struct DirectionalDesc {
    friend bool operator==(const DirectionalDesc&, const DirectionalDesc&) = default;
};
/// A round turbulent jet from a nozzle at the source's position, which blows along the velocity. On the axis the air
/// has the full velocity for 6 diameters; then it slows down as 1/x. Behind the nozzle the air is still.
struct JetDesc {
    float diameter = 0.3f;  ///< m, 1e-6…1e6, of the nozzle
    friend bool operator==(const JetDesc&, const JetDesc&) = default;
};
/// A Lamb-Oseen vortex around the source's local y axis. The velocity of the source is added on the axis and fades away
/// from it.
struct VortexDesc {
    float swirl = 5;      ///< m/s, within ±1e4: largest speed around the axis, right-handed
    float inflow = 0;     ///< m/s, within ±1e4: largest speed toward the axis; negative: away from it
    float radius = 0.3f;  ///< m, 1e-6…1e6: where both are largest
    friend bool operator==(const VortexDesc&, const VortexDesc&) = default;
};

/// Bounds of a wind source: a box at its position, along its axes. Outside of the border the source has no wind.
struct WindBoxDesc {
    Vec3 half_extents{1, 1, 1};  ///< m, > 0, half of the size along the local x, y and z
    float border = 0.1f;         ///< m, ≥ 0: distance from the box over which the wind fades
    friend bool operator==(const WindBoxDesc&, const WindBoxDesc&) = default;
};

/// Place, direction and strength of a wind source at a time. They are interpolated linearly between keys and constant
/// before the first and after the last one.
struct WindKey {
    float time = 0;              ///< s
    Vec3 position = {};          ///< m
    Vec3 rotation_degrees = {};  ///< R = Rz·Ry·Rx; each angle is interpolated, 360° more adds a turn
    float strength = 1;          ///< factor of all velocities of the source, 0…100
    friend bool operator==(const WindKey&, const WindKey&) = default;
};

/// One wind source.
struct WindDesc {
    std::variant<DirectionalDesc, JetDesc, VortexDesc> kind = {};
    Vec3 velocity = {};                   ///< m/s, each component within ±1e4, in the source's local frame
    TransformDesc transform = {};         ///< place and direction; `scale` is ignored
    std::vector<WindKey> motion = {};     ///< by ascending time; empty: the source stays at `transform`
    std::optional<WindBoxDesc> box = {};  ///< nullopt: not bounded
    float shelter = 0;  ///< m, 0…1e6: a triangle with a collider this near against the wind gets none; 0: no shelter
    GustDesc gust = {};
    TurbulenceDesc turbulence = {};
    std::uint32_t seed = 0;  ///< selects the random gusts and eddies, 0…16777215
    friend bool operator==(const WindDesc&, const WindDesc&) = default;
};

/// The air around the cloths.
struct AirDesc {
    float density = 1.225f;           ///< kg/m³, 0…1e4
    std::vector<WindDesc> wind = {};  ///< their velocities add up
    friend bool operator==(const AirDesc&, const AirDesc&) = default;
};

/// Selects particles by number. Fails if a number is out of range, or the vertex belongs to no triangle.
struct VertexPins {
    std::vector<std::uint32_t> vertices = {};  ///< welded vertices, numbered in order of first appearance in the file
    std::string group = {};                    ///< the group of a scene file that lists them; empty: none
    /// The same vertices are selected, whatever lists them.
    friend bool operator==(const VertexPins& a, const VertexPins& b) { return a.vertices == b.vertices; }
};
/// Selects all particles in a box. Fails if there are none.
struct BoxPins {
    Bounds box = {};  ///< m, in world space, after the transform
    friend bool operator==(const BoxPins&, const BoxPins&) = default;
};
/// Selects all particles with this vertex color. Fails if there are none.
struct ColorPins {
    Vec3 color = {};         ///< linear RGB, 0…1
    float threshold = 0.5f;  ///< largest difference from `color`, per channel, 0…1
    friend bool operator==(const ColorPins&, const ColorPins&) = default;
};

/// Offset of a pin from its start position at a time. Offsets are interpolated linearly between keys and constant
/// before the first and after the last one.
struct OffsetKey {
    float time = 0;    ///< s
    Vec3 offset = {};  ///< m
    friend bool operator==(const OffsetKey&, const OffsetKey&) = default;
};

/// Particles whose positions are given. If several pins select a particle, the last one counts. `attach` and `motion`
/// exclude each other.
struct PinDesc {
    std::variant<VertexPins, BoxPins, ColorPins> select = {};  ///< the pinned particles
    std::string attach = {};             ///< name of the collider that the particles follow; empty: none
    std::vector<OffsetKey> motion = {};  ///< by ascending time; empty: they do not move
    float compliance = 0;                ///< m/N, 0…1e6, of the spring that holds a particle; 0: rigid
    friend bool operator==(const PinDesc&, const PinDesc&) = default;
};

/// A polyline on the cloth. The cut follows edges of the mesh, between the particles nearest to its points.
struct PathCut {
    std::vector<Vec3> points = {};  ///< m, at least two
    friend bool operator==(const PathCut&, const PathCut&) = default;
};
/// The plane normal·x = offset. The cut follows edges of the mesh, at most 0.53 edges away from the plane.
struct PlaneCut {
    Vec3 normal{1, 0, 0};  ///< any length but 0
    float offset = 0;      ///< m
    friend bool operator==(const PlaneCut&, const PlaneCut&) = default;
};

/// A cut through a cloth. In ClothDesc it lies on the cloth as it is at the start, in world space, m.
struct CutDesc {
    float time = 0;  ///< s, 0…1e6, simulated time: made before the first frame that begins then or later
    std::variant<PathCut, PlaneCut> along = {};
    friend bool operator==(const CutDesc&, const CutDesc&) = default;
};

/// Edges with a strength of their own, chosen like those of a cut: a seam, a perforation. They open where the tension
/// across them exceeds it. No rip runs along edges that are stronger than the fabric.
struct SeamDesc {
    float strength = 0;     ///< N/m, above 0, up to 1e9: tension across the seam that it carries
    float tear_energy = 0;  ///< J/m, 0…1e9: sets the limit at the end of the open part; 0: `strength` holds there too
    std::variant<PathCut, PlaneCut> along = {};  ///< on the cloth as it is at the start, in world space, m
    friend bool operator==(const SeamDesc&, const SeamDesc&) = default;
};

enum class ColorChannel { red, green, blue, alpha };
/// Selects all particles; the factor is multiplied by this channel of the vertex color (linear).
struct PaintedChannel {
    ColorChannel channel = ColorChannel::red;
    friend bool operator==(const PaintedChannel&, const PaintedChannel&) = default;
};
/// Particles that are weaker or stronger than the fabric. If several descriptions select a particle, the last one
/// counts.
struct ResistanceDesc {
    float factor = 1;  ///< 0.001…1e6: on all limits of the fabric. A product with a channel is at least 0.001
    std::variant<VertexPins, BoxPins, ColorPins, PaintedChannel> select = {};
    /// With VertexPins: one per vertex, 0.001…1e6, each multiplied by `factor`; empty: all 1. A product is at least
    /// 0.001.
    std::vector<float> factors = {};
    friend bool operator==(const ResistanceDesc&, const ResistanceDesc&) = default;
};

enum class WeightOf { density, stretch, bend, thickness };
/// Particles whose cloth is heavier or lighter, stiffer or softer, thicker or thinner than the fabric. A triangle has
/// the mean of its three corners, or the thickness of the thinnest one. If several descriptions of the same value
/// select a particle, the last one counts.
struct WeightDesc {
    WeightOf of = WeightOf::density;  ///< stretch: with shear and compression
    float factor = 1;  ///< 0.001…1e6: on the value of the fabric. A product with a channel is at least 0.001
    std::variant<VertexPins, BoxPins, ColorPins, PaintedChannel> select = {};
    std::vector<float> factors = {};  ///< as in ResistanceDesc
    friend bool operator==(const WeightDesc&, const WeightDesc&) = default;
};

/// Where a cut lies that Simulation::cut() makes: on the cloth as it is now, or as it was at the start. Both are in
/// world space.
enum class CutPositions { current, start };

/// A value of a fabric or a solver option: one or several numbers, a flag, or text.
class ParameterValue {
  public:
    template <class Number>
    requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>) ParameterValue(Number number)
        : value_(std::vector<double>{static_cast<double>(number)}) {}
    ParameterValue(std::initializer_list<double> numbers) : value_(std::vector<double>(numbers)) {}
    ParameterValue(bool flag) : value_(flag) {}
    ParameterValue(std::string word) : value_(std::move(word)) {}
    ParameterValue(const char* word) : value_(std::string(word)) {}

    const std::variant<std::vector<double>, bool, std::string>& get() const { return value_; }

  private:
    std::variant<std::vector<double>, bool, std::string> value_;
};

/// Keys with their values. If a key has several values, the last one is used.
using ParameterValues = std::vector<std::pair<std::string, ParameterValue>>;

/// A fabric: a preset and values that replace some of its own. Presets, keys, units and ranges are those of a scene's
/// `fabric` (docs/scene.md): `FabricDesc("silk").set("density", 0.08).set("stretch", {1500, 1200})`. Unknown names and
/// values out of range are errors of the function that takes the FabricDesc.
struct FabricDesc {
    std::string preset = "cotton";
    ParameterValues values = {};

    FabricDesc() = default;
    FabricDesc(const char* name) : preset(name) {}
    FabricDesc(std::string name) : preset(std::move(name)) {}
    FabricDesc& set(std::string key, ParameterValue value) {
        values.emplace_back(std::move(key), std::move(value));
        return *this;
    }
};

/// One cloth.
struct ClothDesc {
    std::string name = {};                     ///< unique; empty: a free name is chosen
    MeshDesc mesh = {};                        ///< simulated mesh
    std::optional<MeshDesc> render_mesh = {};  ///< drawn mesh, follows `mesh`; nullopt: `mesh` is drawn
    TransformDesc transform = {};              ///< of both meshes, at the start
    Vec3 velocity = {};  ///< m/s, each component within ±1e4: of all particles that are not pinned, at the start
    FabricDesc fabric = {};
    std::vector<PinDesc> pins = {};
    std::vector<CutDesc> cuts = {};               ///< need `tearing`
    std::vector<SeamDesc> seams = {};             ///< need Tearing::split
    std::vector<ResistanceDesc> resistance = {};  ///< needs Tearing::split or Tearing::erode
    std::vector<WeightDesc> weights = {};
    Tethers tethers = Tethers::automatic;
    float tether_slack = 0;  ///< fraction by which a particle may exceed the geodesic distance, 0…100
    SelfCollision self_collision = SelfCollision::off;
    Tearing tearing = Tearing::off;
    /// 0…5: copies of particles that openings can make, as a fraction of the particles; 256 more are always there. 5 is
    /// enough for any cloth to fall into single triangles.
    float tear_room = 0.125f;
    std::uint32_t collision_group = 0;          ///< 0…31
    std::uint32_t collision_mask = 0xffffffff;  ///< bit g: collides with cloths of group g
    std::uint32_t layer =
        0;  ///< 0…1000: where cloths of two layers cross, the higher one is moved to the lower one's front
};

/// The solid half space normal·x ≤ offset, in the collider's local frame.
struct PlaneDesc {
    Vec3 normal{0, 1, 0};  ///< points out of the solid; any length but 0
    float offset = 0;      ///< m
    friend bool operator==(const PlaneDesc&, const PlaneDesc&) = default;
};
/// A sphere about the collider's position.
struct SphereDesc {
    float radius = 0.5f;  ///< m, > 0
    friend bool operator==(const SphereDesc&, const SphereDesc&) = default;
};
/// A box, centered at the collider's position.
struct BoxDesc {
    Vec3 half_extents{0.5f, 0.5f, 0.5f};  ///< m, > 0, half of the size along the local x, y and z
    friend bool operator==(const BoxDesc&, const BoxDesc&) = default;
};
/// A capsule along the collider's local y axis, centered at its position.
struct CapsuleDesc {
    float radius = 0.1f;       ///< m, > 0
    float half_height = 0.5f;  ///< m, ≥ 0: half the distance between the centers of its two ends
    friend bool operator==(const CapsuleDesc&, const CapsuleDesc&) = default;
};
/// A capsule along the collider's local y axis whose ends differ in radius: two balls and the cone that touches both.
/// If one ball holds the other, the shape is the larger ball.
struct TaperedCapsuleDesc {
    std::array<float, 2> radius{0.1f, 0.05f};  ///< m, > 0: of the ball at -y and of the one at +y
    float half_height = 0.5f;                  ///< m, ≥ 0: half the distance between the centers of the two balls
    friend bool operator==(const TaperedCapsuleDesc&, const TaperedCapsuleDesc&) = default;
};

/// The convex hull of a mesh's vertices, or of points. A hull has at most 256 vertices: a finer one is simplified from
/// within.
struct ConvexDesc {
    std::string file = {};   ///< read by Options::read_mesh; empty: `mesh` is used
    Vec3 scale{1, 1, 1};     ///< m per unit along the axes of the file or of `mesh`; negative: mirrored; not 0
    UpAxis up = UpAxis::y;   ///< of the file
    TriangleMesh mesh = {};  ///< its positions; a scene file has them as `points`. Triangles only for programs
    float radius = 0;        ///< m, ≥ 0: everything within this distance of the hull is solid too
    friend bool operator==(const ConvexDesc&, const ConvexDesc&) = default;
};

/// How cloth meets a mesh. `surface`: cloths whose self-collision is exact touch its triangles, from either side, and
/// never pass through them; all other cloths meet the solid. `solid`: all cloths meet the solid. `automatic`: `surface`
/// if the mesh has holes, else `solid`.
enum class MeshContact { automatic, solid, surface };

/// A mesh as a solid. It may have holes, flipped triangles and parts that overlap: inside is where the mesh winds
/// around a point more than half a time. Parts that are thinner than two cells of the distance field are not reliable.
struct SolidMeshDesc {
    std::string file = {};          ///< read by Options::read_mesh; empty: `mesh` is used
    Vec3 scale{1, 1, 1};            ///< m per unit along the axes of the file or of `mesh`; negative: mirrored; not 0
    UpAxis up = UpAxis::y;          ///< of the file
    TriangleMesh mesh = {};         ///< only for programs: a scene file must name a file
    std::uint32_t resolution = 96;  ///< cells of the distance field along the longest side of the mesh, 4…1024
    MeshContact contact = MeshContact::automatic;
    friend bool operator==(const SolidMeshDesc&, const SolidMeshDesc&) = default;
};

/// Pose of a collider at a time, in place of its transform. Poses are interpolated linearly between keys and constant
/// before the first and after the last one.
struct PoseKey {
    float time = 0;              ///< s
    Vec3 position = {};          ///< m
    Vec3 rotation_degrees = {};  ///< R = Rz·Ry·Rx; each angle is interpolated, 360° more adds a turn
    friend bool operator==(const PoseKey&, const PoseKey&) = default;
};

/// Calls visit(shape) if the shape is made from a mesh: ConvexDesc or SolidMeshDesc, const or not.
template <class Shape, class Visit>
void with_mesh_shape(Shape& shape, Visit&& visit) {
    if (auto* convex = std::get_if<ConvexDesc>(&shape)) visit(*convex);
    if (auto* solid = std::get_if<SolidMeshDesc>(&shape)) visit(*solid);
}

/// What makes a collider a body: it falls, and what it touches pushes it.
struct BodyDesc {
    float mass = 0;          ///< kg, 0…1e9; 0: the volume of the shape times `density`
    float density = 1000;    ///< kg/m³, > 0…1e6
    Vec3 center = {};        ///< m: the center of mass, from where the shape has it, in the collider's frame
    Vec3 inertia = {};       ///< kg·m², about the center of mass, along the collider's axes; 0: of the shape
    Vec3 velocity = {};      ///< m/s at the start, of the center of mass
    Vec3 spin = {};          ///< °/s at the start, about the world's axes
    float damping = 0;       ///< 1/s, 0…1e6: the rate at which the velocity decays
    float spin_damping = 0;  ///< 1/s, 0…1e6
    float restitution = 0;   ///< 0…1, against colliders and bodies; a pair has the larger one
    bool reaction = true;    ///< false: cloth does not push the body
    friend bool operator==(const BodyDesc&, const BodyDesc&) = default;
};

/// A rigid shape that cloth collides with.
struct ColliderDesc {
    std::string name = {};
    std::variant<PlaneDesc, SphereDesc, BoxDesc, CapsuleDesc, TaperedCapsuleDesc, ConvexDesc, SolidMeshDesc> shape = {};
    TransformDesc transform = {};               ///< `scale` is ignored
    std::array<float, 2> friction{0.4f, 0.3f};  ///< static and kinetic coefficient, 0…100
    std::vector<PoseKey> motion = {};           ///< by ascending time; empty: the collider stays at `transform`
    std::optional<BodyDesc> body = {};          ///< a body starts at `transform`; `motion` must then be empty
    friend bool operator==(const ColliderDesc&, const ColliderDesc&) = default;
};

/// A point in a triangle of a cloth's simulated mesh.
struct MeshPoint {
    std::uint32_t triangle = 0;  ///< number of the triangle in the mesh
    Vec3 weights{1, 0, 0};       ///< barycentric weights of its corners, each 0…1; their sum is 1
    friend bool operator==(const MeshPoint&, const MeshPoint&) = default;
};

/// One side of a StitchDesc. Exactly one of `vertices` and `points` is not empty.
struct StitchEnd {
    std::string cloth = {};                    ///< name of the cloth
    std::vector<std::uint32_t> vertices = {};  ///< numbered as for pins
    std::vector<MeshPoint> points = {};        ///< points in triangles
    friend bool operator==(const StitchEnd&, const StitchEnd&) = default;
};

/// Stitches: point i of side `a` is tied to point i of side `b`. Both sides have the same number of points and may
/// belong to one cloth.
struct StitchDesc {
    std::string name = {};
    StitchEnd a = {}, b = {};
    float gap = 0;         ///< m, 0…1e6: distance between tied points
    float compliance = 0;  ///< m/N, 0…1e6, of each stitch; 0: rigid
    friend bool operator==(const StitchDesc&, const StitchDesc&) = default;
};

}  // namespace weft
