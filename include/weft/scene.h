// What can be simulated and how: the parts of a scene as values, in SI units, with their defaults. The ranges and more
// words are in docs/scene.md; whoever takes one of these says what is wrong with it.
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

enum class Method { xpbd, pbd };
/// `automatic`: lines with xpbd, gauss_seidel with pbd.
enum class Projection { automatic, lines, gauss_seidel, jacobi };

/// How averaged Jacobi adds up what rows want of a particle.
enum class Accumulate { gather, fixed_point };

/// Every option of the solver. The keys of a scene's `solver`, Options::solver and the options of the command line are
/// those that `solver_keys` (src/scene/scene_keys.h) lists for this struct.
struct SolverDesc {
    std::uint32_t substeps = 20;   ///< per frame, 1…10000
    std::uint32_t iterations = 1;  ///< per substep, 1…10000
    Method method = Method::xpbd;
    Projection projection = Projection::automatic;
    Accumulate accumulate = Accumulate::gather;
    bool hierarchy = true;  ///< coarse levels first: large cloths stretch less
    friend bool operator==(const SolverDesc&, const SolverDesc&) = default;
};

/// Particles held within their way over the cloth from where it is pinned. `automatic`: where coarse levels are on, the
/// fabric is inextensible and the cloth hangs by few places.
enum class Tethers { automatic, on, off };

enum class WindKind { directional };

/// `smooth`: neighbors feel a gust at nearly the same time. `scattered`: every triangle has a phase and a frequency of
/// its own.
enum class GustPhase { smooth, scattered };

struct GustDesc {
    float amplitude = 0;     ///< of the velocity
    float frequency = 0.5f;  ///< 1/s
    float scale = 4;         ///< m: distance over which gusts fall out of step
    GustPhase phase = GustPhase::smooth;
    friend bool operator==(const GustDesc&, const GustDesc&) = default;
};

struct TurbulenceDesc {
    float strength = 0;  ///< of the velocity
    float scale = 0.5f;  ///< m: size of an eddy, across the wind
    float period = 1;    ///< s: how long an eddy lives; 0 keeps them still
    friend bool operator==(const TurbulenceDesc&, const TurbulenceDesc&) = default;
};

struct WindDesc {
    WindKind kind = WindKind::directional;
    Vec3 velocity = {};  ///< m/s
    GustDesc gust = {};
    TurbulenceDesc turbulence = {};
    std::uint32_t seed = 0;
    friend bool operator==(const WindDesc&, const WindDesc&) = default;
};

struct AirDesc {
    float density = 1.225f;           ///< kg/m³
    std::vector<WindDesc> wind = {};  ///< the sum acts
    friend bool operator==(const AirDesc&, const AirDesc&) = default;
};

/// How the cells of a grid are cut. `uniform`: all along +x+z. `alternating`: a checkerboard of both directions.
/// `cross`: both, with one more vertex in the middle of each cell.
enum class GridDiagonal { uniform, alternating, cross };

/// A flat sheet in the xz plane, centered, facing +y, its warp along x. Particle (ix, iz) is vertex
/// iz · resolution[0] + ix.
struct GridDesc {
    std::array<float, 2> size{1, 1};                  ///< m along x and z
    std::array<std::uint32_t, 2> resolution{64, 64};  ///< particles along x and z
    GridDiagonal diagonal = GridDiagonal::alternating;
    friend bool operator==(const GridDesc&, const GridDesc&) = default;
};

struct SphereMeshDesc {
    float radius = 0.5f;             ///< m
    std::uint32_t subdivisions = 4;  ///< 0…7
    friend bool operator==(const SphereMeshDesc&, const SphereMeshDesc&) = default;
};

struct BoxMeshDesc {
    std::array<float, 3> size{1, 1, 1};                   ///< m along x, y and z
    std::array<std::uint32_t, 3> resolution{32, 32, 32};  ///< particles along x, y and z
    friend bool operator==(const BoxMeshDesc&, const BoxMeshDesc&) = default;
};

enum class UpAxis { x, y, z };

struct MeshFileDesc {
    std::string file = {};  ///< looked for beside the scene, then in WEFT_ASSETS, then where packages put models
    float scale = 1;        ///< m per unit of the file
    UpAxis up = UpAxis::y;
    friend bool operator==(const MeshFileDesc&, const MeshFileDesc&) = default;
};

/// Made from numbers, read from a file, or given as it is.
using MeshDesc = std::variant<GridDesc, SphereMeshDesc, BoxMeshDesc, MeshFileDesc, TriangleMesh>;

struct TransformDesc {
    Vec3 position = {};          ///< m
    Vec3 rotation_degrees = {};  ///< R = Rz·Ry·Rx
    float scale = 1;
    friend bool operator==(const TransformDesc&, const TransformDesc&) = default;
};

struct VertexPins {
    std::vector<std::uint32_t> vertices = {};  ///< welded vertices, numbered in order of first appearance in the file
    friend bool operator==(const VertexPins&, const VertexPins&) = default;
};
struct BoxPins {
    Bounds box = {};  ///< world space, after the transform
    friend bool operator==(const BoxPins&, const BoxPins&) = default;
};
struct ColorPins {
    Vec3 color = {};         ///< linear RGB
    float threshold = 0.5f;  ///< largest distance from `color`, per channel
    friend bool operator==(const ColorPins&, const ColorPins&) = default;
};

/// Where a pin is, relative to where it started.
struct OffsetKey {
    float time = 0;    ///< s
    Vec3 offset = {};  ///< m
    friend bool operator==(const OffsetKey&, const OffsetKey&) = default;
};

struct PinDesc {
    std::variant<VertexPins, BoxPins, ColorPins> select = {};
    std::string attach = {};             ///< name of the collider that the particles follow; empty: none
    std::vector<OffsetKey> motion = {};  ///< by ascending time; empty: they stay
    float compliance = 0;                ///< m/N: of the spring between particle and place; 0: the particle is there
    friend bool operator==(const PinDesc&, const PinDesc&) = default;
};

/// A value of a fabric or a solver option: a number, several, true or false, or a word.
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

/// Keys with their values. Of several values for one key the last one is used.
using ParameterValues = std::vector<std::pair<std::string, ParameterValue>>;

/// A fabric known by name, and what is different from it. Keys, units and ranges are those of a scene's `fabric`
/// (docs/scene.md): `FabricDesc("silk").set("density", 0.08).set("stretch", {1500, 1200})`.
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

struct ClothDesc {
    std::string name = {};
    MeshDesc mesh = {};                  ///< what is simulated
    std::optional<MeshDesc> drawn = {};  ///< what is drawn and follows it; without, the same
    TransformDesc transform = {};
    FabricDesc fabric = {};
    std::vector<PinDesc> pins = {};
    Tethers tethers = Tethers::automatic;
    float tether_slack = 0;  ///< of the way over the cloth
};

/// Half space below the plane: normal·x = offset, in the collider's own frame.
struct PlaneDesc {
    Vec3 normal{0, 1, 0};
    float offset = 0;  ///< m
    friend bool operator==(const PlaneDesc&, const PlaneDesc&) = default;
};
struct SphereDesc {
    float radius = 0.5f;  ///< m
    friend bool operator==(const SphereDesc&, const SphereDesc&) = default;
};
struct BoxDesc {
    Vec3 half_extents{0.5f, 0.5f, 0.5f};  ///< m
    friend bool operator==(const BoxDesc&, const BoxDesc&) = default;
};
/// Along the collider's own y axis.
struct CapsuleDesc {
    float radius = 0.1f;       ///< m
    float half_height = 0.5f;  ///< m: half the length between the centers of its two ends
    friend bool operator==(const CapsuleDesc&, const CapsuleDesc&) = default;
};

/// Where a collider is at a time, in place of its transform.
struct PoseKey {
    float time = 0;              ///< s
    Vec3 position = {};          ///< m
    Vec3 rotation_degrees = {};  ///< R = Rz·Ry·Rx
    friend bool operator==(const PoseKey&, const PoseKey&) = default;
};

struct ColliderDesc {
    std::string name = {};
    std::variant<PlaneDesc, SphereDesc, BoxDesc, CapsuleDesc> shape = {};
    TransformDesc transform = {};               ///< `scale` unused
    std::array<float, 2> friction{0.4f, 0.3f};  ///< static, kinetic
    std::vector<PoseKey> motion = {};           ///< by ascending time; empty: it stays at `transform`
    friend bool operator==(const ColliderDesc&, const ColliderDesc&) = default;
};

/// A point in a triangle of a cloth's simulated mesh.
struct MeshPoint {
    std::uint32_t triangle = 0;  ///< in the order of the mesh
    Vec3 weights{1, 0, 0};       ///< of its three corners, each 0…1; their sum is 1
    friend bool operator==(const MeshPoint&, const MeshPoint&) = default;
};

/// One side of a row of stitches: either of the two lists, the other one empty.
struct StitchEnd {
    std::string cloth = {};                    ///< by its name
    std::vector<std::uint32_t> vertices = {};  ///< numbered as for pins
    std::vector<MeshPoint> points = {};
    friend bool operator==(const StitchEnd&, const StitchEnd&) = default;
};

/// A row of stitches: point i of one side is tied to point i of the other. Both sides may be of one cloth.
struct StitchDesc {
    std::string name = {};
    StitchEnd a = {}, b = {};
    float gap = 0;         ///< m, ≥ 0: distance at which tied points are kept
    float compliance = 0;  ///< m/N, ≥ 0: how far each stitch gives way per newton
    friend bool operator==(const StitchDesc&, const StitchDesc&) = default;
};

}  // namespace weft
