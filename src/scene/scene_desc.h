// What a scene says, as values in SI units with their defaults. No file format and no simulation lives here. The ranges
// of the values are in scene_keys.h; check.h applies them.
#pragma once

#include "base/bounds.h"
#include "base/transform.h"
#include "mesh/procedural.h"
#include "scene/fabric.h"

#include <weft/result.h>
#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace weft {

enum class Method { xpbd, pbd };
enum class Projection { gauss_seidel, jacobi };

struct SolverDesc {
    std::uint32_t substeps = 20;   ///< per frame, 1…10000
    std::uint32_t iterations = 1;  ///< per substep, 1…10000
    Method method = Method::xpbd;
    Projection projection = Projection::gauss_seidel;
};

enum class WindKind {
#define WEFT_WIND(name, Name) name,
#include "physics/air/winds.def"
#undef WEFT_WIND
};

/// `smooth`: neighbors feel a gust at nearly the same time. `scattered`: every triangle has a phase and a frequency of
/// its own.
enum class GustPhase { smooth, scattered };

struct GustDesc {
    float amplitude = 0;     ///< of the velocity
    float frequency = 0.5f;  ///< 1/s
    float scale = 4;         ///< m: distance over which gusts fall out of step
    GustPhase phase = GustPhase::smooth;
};

struct TurbulenceDesc {
    float strength = 0;  ///< of the velocity
    float scale = 0.5f;  ///< m: size of an eddy, across the wind
    float period = 1;    ///< s: how long an eddy lives; 0 keeps them still
};

struct WindDesc {
    WindKind kind = WindKind::directional;
    Vec3 velocity = {};  ///< m/s
    GustDesc gust = {};
    TurbulenceDesc turbulence = {};
    std::uint32_t seed = 0;
};

struct AirDesc {
    float density = 1.225f;           ///< kg/m³
    std::vector<WindDesc> wind = {};  ///< the sum acts
};

struct GridDesc {
    std::array<float, 2> size{1, 1};                  ///< m along x and z
    std::array<std::uint32_t, 2> resolution{64, 64};  ///< particles along x and z
    GridDiagonal diagonal = GridDiagonal::alternating;
};

struct SphereMeshDesc {
    float radius = 0.5f;             ///< m
    std::uint32_t subdivisions = 4;  ///< 0…7
};

struct BoxMeshDesc {
    std::array<float, 3> size{1, 1, 1};                   ///< m along x, y and z
    std::array<std::uint32_t, 3> resolution{32, 32, 32};  ///< particles along x, y and z
};

enum class UpAxis { x, y, z };

struct MeshFileDesc {
    std::string file = {};  ///< as written in the scene
    float scale = 1;        ///< m per unit of the file
    UpAxis up = UpAxis::y;
};

using MeshDesc = std::variant<GridDesc, SphereMeshDesc, BoxMeshDesc, MeshFileDesc>;

struct TransformDesc {
    Vec3 position = {};          ///< m
    Vec3 rotation_degrees = {};  ///< R = Rz·Ry·Rx
    float scale = 1;
};

struct VertexPins {
    std::vector<std::uint32_t> vertices = {};  ///< welded vertices, numbered in order of first appearance in the file
};
struct BoxPins {
    Bounds box = {};  ///< world space, after the transform
};
struct ColorPins {
    Vec3 color = {};         ///< linear RGB
    float threshold = 0.5f;  ///< largest distance from `color`, per channel
};

/// Where a pin is, relative to where it started.
struct OffsetKey {
    float time = 0;    ///< s
    Vec3 offset = {};  ///< m
};

struct PinDesc {
    std::variant<VertexPins, BoxPins, ColorPins> select = {};
    std::string attach = {};             ///< name of the collider that the particles follow; empty: none
    std::vector<OffsetKey> motion = {};  ///< by ascending time; empty: they stay
    float compliance = 0;                ///< m/N: of the spring between particle and place; 0: the particle is there
};

struct ClothDesc {
    std::string name = {};
    MeshDesc mesh = {};                  ///< what is simulated
    std::optional<MeshDesc> drawn = {};  ///< what is drawn and follows it; without, the same
    TransformDesc transform = {};
    Fabric fabric = {};
    std::vector<PinDesc> pins = {};
    bool tethers = false;
    float tether_slack = 0.02f;  ///< of the way over the cloth
};

/// Half space below the plane: normal·x = offset, in the collider's own frame.
struct PlaneDesc {
    Vec3 normal{0, 1, 0};
    float offset = 0;  ///< m
};
struct SphereDesc {
    float radius = 0.5f;  ///< m
};
struct BoxDesc {
    Vec3 half_extents{0.5f, 0.5f, 0.5f};  ///< m
};
/// Along the collider's own y axis.
struct CapsuleDesc {
    float radius = 0.1f;       ///< m
    float half_height = 0.5f;  ///< m: half the length between the centers of its two ends
};

/// Where a collider is at a time, in place of its transform.
struct PoseKey {
    float time = 0;              ///< s
    Vec3 position = {};          ///< m
    Vec3 rotation_degrees = {};  ///< R = Rz·Ry·Rx
};

struct ColliderDesc {
    std::string name = {};
    std::variant<PlaneDesc, SphereDesc, BoxDesc, CapsuleDesc> shape = {};
    TransformDesc transform = {};               ///< `scale` unused
    std::array<float, 2> friction{0.4f, 0.3f};  ///< static, kinetic
    std::vector<PoseKey> motion = {};           ///< by ascending time; empty: it stays at `transform`
};

struct SceneDesc {
    std::string name = {};
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    float frame_rate = 60;       ///< frames per second, > 0
    SolverDesc solver = {};
    std::optional<AirDesc> air = {};  ///< without, a vacuum
    std::vector<ClothDesc> cloths = {};  ///< at least one
    std::vector<ColliderDesc> colliders = {};
};

}  // namespace weft
