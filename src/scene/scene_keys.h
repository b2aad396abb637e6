// Every key of a scene beside those of a fabric and of a collider's shape: where its value goes, its range, unit and
// meaning. Reader, checks and documentation work through these tables, so a new value is a member in scene_desc.h and a
// line here.
#pragma once

#include "base/parameter.h"
#include "physics/contact/shapes.def"
#include "scene/scene_desc.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace weft {

inline constexpr std::uint32_t scene_format = 1;

inline constexpr double any_float = std::numeric_limits<float>::max();

/// Vertices of all meshes together that a scene describes by numbers; 2²⁴ is a grid of 4096 × 4096.
inline constexpr std::uint64_t max_made_vertices = 1u << 24;

/// What a file says and a SceneDesc does not keep.
struct SceneHead {
    std::uint32_t weft = scene_format;
};
struct FabricHead {
    std::string preset = "cotton";
};
struct LookHead {
    std::string material = {};
};

// One entry is one key.
// clang-format off
inline constexpr Parameter head_keys[] = {
    {.key = "weft", .kind = ParameterKind::integer, .offset = offsetof(SceneHead, weft), .min = 1,
     .what = "version of the format; this one is 1", .required = true},
};

inline constexpr Parameter scene_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(SceneDesc, name),
     .what = "what to call the scene"},
    {.key = "gravity", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(SceneDesc, gravity),
     .min = -far_away, .max = far_away, .unit = "m/s²", .what = "acceleration of free fall"},
    {.key = "frame_rate", .offset = offsetof(SceneDesc, frame_rate), .min = 0, .max = 100000, .min_excluded = true,
     .unit = "frames/s", .what = "frames per second of simulated time"},
    {.key = "solver", .kind = ParameterKind::object, .what = "how motion is computed"},
    {.key = "air", .kind = ParameterKind::object, .what = "the air around, still or windy; without it, a vacuum"},
    {.key = "cloths", .kind = ParameterKind::list, .what = "the cloths, at least one", .required = true},
    {.key = "colliders", .kind = ParameterKind::list, .what = "what the cloths fall on"},
    {.key = "stitches", .kind = ParameterKind::list, .what = "what ties cloths together"},
    {.key = "camera", .kind = ParameterKind::object,
     .what = "where pictures are taken from; without it, a place from which everything is seen"},
    {.key = "light", .kind = ParameterKind::object, .what = "what lights pictures"},
    {.key = "look", .kind = ParameterKind::object,
     .what = "how cloths and colliders look in pictures: its keys are their names"},
};

inline constexpr Parameter solver_keys[] = {
    {.key = "method", .kind = ParameterKind::choice, .offset = offsetof(SolverDesc, method),
     .what = "`xpbd`: stiffness in N/m, whatever the substeps; `pbd`: plain, stiffness as in the fabric's `stiffness`",
     .choices = "xpbd|pbd"},
    {.key = "projection", .kind = ParameterKind::choice, .offset = offsetof(SolverDesc, projection),
     .what = "`lines`: stretch along each line of the mesh at once, the rest as in `gauss-seidel`: rows one after "
             "another, color by color; `jacobi`: all at once, averaged, slower to converge; `auto`: `lines`, with "
             "`pbd` `gauss-seidel`",
     .choices = "auto|lines|gauss-seidel|jacobi"},
    {.key = "accumulate", .kind = ParameterKind::choice, .offset = offsetof(SolverDesc, accumulate),
     .what = "how `jacobi` adds up what rows want of a particle: `gather` in floats, in a fixed order; `fixed-point` in "
             "whole 1/65536 m, in any order",
     .choices = "gather|fixed-point"},
    {.key = "hierarchy", .kind = ParameterKind::flag, .offset = offsetof(SolverDesc, hierarchy),
     .what = "coarse levels over each cloth, projected first: far less stretch of large ones"},
    {.key = "substeps", .kind = ParameterKind::integer, .offset = offsetof(SolverDesc, substeps), .min = 1,
     .max = 10000, .what = "steps per frame; twice as many cost twice the time and leave about a quarter of the stretch"},
    {.key = "iterations", .kind = ParameterKind::integer, .offset = offsetof(SolverDesc, iterations), .min = 1,
     .max = 10000, .what = "passes over all constraints per substep; more substeps serve better than more iterations"},
};

inline constexpr Parameter air_keys[] = {
    {.key = "density", .offset = offsetof(AirDesc, density), .min = 0, .max = 1e4, .unit = "kg/m³",
     .what = "mass per volume; 1.225 is air at sea level and 15 °C"},
    {.key = "wind", .kind = ParameterKind::list, .what = "what moves the air; the sum acts"},
};

#define WEFT_WIND(name, Name) "|" #name
inline constexpr std::string_view wind_choices = std::string_view(
#include "physics/air/winds.def"
    ).substr(1);
#undef WEFT_WIND

inline constexpr Parameter wind_keys[] = {
    {.key = "kind", .kind = ParameterKind::choice, .offset = offsetof(WindDesc, kind),
     .what = "`directional`: the same everywhere", .choices = wind_choices},
    {.key = "velocity", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(WindDesc, velocity), .min = -1e4,
     .max = 1e4, .unit = "m/s", .what = "where it blows to, and how fast"},
    {.key = "gust", .kind = ParameterKind::object, .what = "how it swells and drops"},
    {.key = "turbulence", .kind = ParameterKind::object, .what = "how it differs from place to place"},
    {.key = "seed", .kind = ParameterKind::integer, .offset = offsetof(WindDesc, seed), .min = 0, .max = 16777215,
     .what = "another number, other gusts and eddies of the same kind"},
};

inline constexpr Parameter gust_keys[] = {
    {.key = "amplitude", .offset = offsetof(GustDesc, amplitude), .min = 0, .max = 100,
     .what = "largest change, as a part of the velocity"},
    {.key = "frequency", .offset = offsetof(GustDesc, frequency), .min = 0, .max = 1e3, .unit = "1/s",
     .what = "how often it comes"},
    {.key = "scale", .offset = offsetof(GustDesc, scale), .min = 0, .max = far_away, .min_excluded = true, .unit = "m",
     .what = "distance across the wind over which gusts fall out of step"},
    {.key = "phase", .kind = ParameterKind::choice, .offset = offsetof(GustDesc, phase),
     .what = "`smooth`: neighbors feel it together; `scattered`: each triangle has its own phase and frequency",
     .choices = "smooth|scattered"},
};

inline constexpr Parameter turbulence_keys[] = {
    {.key = "strength", .offset = offsetof(TurbulenceDesc, strength), .min = 0, .max = 100,
     .what = "largest change, as a part of the velocity"},
    {.key = "scale", .offset = offsetof(TurbulenceDesc, scale), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "size of an eddy across the wind"},
    {.key = "period", .offset = offsetof(TurbulenceDesc, period), .min = 0, .max = 1e6, .unit = "s",
     .what = "how long an eddy lives; 0 keeps them still"},
};

inline constexpr Parameter cloth_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(SceneCloth, name),
     .what = "no two cloths share one; a cloth without is called `cloth 0`, `cloth 1`, …"},
    {.key = "mesh", .kind = ParameterKind::object, .what = "its shape: a grid, a sphere, a box or a file"},
    {.key = "drawn", .kind = ParameterKind::object, .what = "a mesh that is drawn in its place and follows it"},
    {.key = "transform", .kind = ParameterKind::object, .what = "where it starts"},
    {.key = "fabric", .kind = ParameterKind::object, .what = "its material: the name of a preset, or an object"},
    {.key = "tethers", .kind = ParameterKind::choice, .offset = offsetof(SceneCloth, tethers),
     .what = "hold every particle within its way over the cloth from where the cloth is pinned: far less stretch; "
             "`auto`: where coarse levels are on, the fabric is `inextensible` and the cloth hangs by at most 16 places",
     .choices = "auto|on|off"},
    {.key = "tether_slack", .offset = offsetof(SceneCloth, tether_slack), .min = 0, .max = 100,
     .what = "by how much of that way a particle may go beyond it, elasticity apart; with `tethers`"},
    {.key = "pins", .kind = ParameterKind::list, .what = "particles whose place is given"},
};

inline constexpr Parameter mesh_keys[] = {
    {.key = "grid", .kind = ParameterKind::object, .what = "a flat sheet"},
    {.key = "sphere", .kind = ParameterKind::object, .what = "a closed sphere"},
    {.key = "box", .kind = ParameterKind::object, .what = "a closed box"},
};

inline constexpr Parameter mesh_file_keys[] = {
    {.key = "file", .kind = ParameterKind::text, .offset = offsetof(MeshFileDesc, file),
     .what = "name of a mesh file"},
    {.key = "scale", .offset = offsetof(MeshFileDesc, scale), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "length of the file's unit; with `file`"},
    {.key = "up", .kind = ParameterKind::choice, .offset = offsetof(MeshFileDesc, up),
     .what = "the file's axis that points up; with `file`", .choices = "x|y|z"},
};

inline constexpr Parameter grid_keys[] = {
    {.key = "size", .kind = ParameterKind::vector, .count = 2, .offset = offsetof(GridDesc, size), .min = 0,
     .max = far_away, .min_excluded = true, .unit = "m", .what = "extent along x and z"},
    {.key = "resolution", .kind = ParameterKind::integer, .count = 2, .offset = offsetof(GridDesc, resolution),
     .min = 2, .max = 4096, .what = "particles along x and z"},
    {.key = "diagonal", .kind = ParameterKind::choice, .offset = offsetof(GridDesc, diagonal),
     .what = "how cells are cut: all alike, a checkerboard, or both ways with a particle in the middle",
     .choices = "uniform|alternating|cross"},
};

inline constexpr Parameter sphere_mesh_keys[] = {
    {.key = "radius", .offset = offsetof(SphereMeshDesc, radius), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "distance of every particle from the center"},
    {.key = "subdivisions", .kind = ParameterKind::integer, .offset = offsetof(SphereMeshDesc, subdivisions), .min = 0,
     .max = 7, .what = "how often the 20 triangles of an icosahedron are cut into four"},
};

inline constexpr Parameter box_mesh_keys[] = {
    {.key = "size", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(BoxMeshDesc, size), .min = 0,
     .max = far_away, .min_excluded = true, .unit = "m", .what = "extent along x, y and z"},
    {.key = "resolution", .kind = ParameterKind::integer, .count = 3, .offset = offsetof(BoxMeshDesc, resolution),
     .min = 2, .max = 4096, .what = "particles along x, y and z"},
};

inline constexpr Parameter transform_keys[] = {
    {.key = "position", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(TransformDesc, position),
     .min = -far_away, .max = far_away, .unit = "m", .what = "where the origin of the shape is put"},
    {.key = "rotation", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(TransformDesc, rotation_degrees),
     .min = -any_float, .unit = "°", .what = "about x, then y, then z, the axes of the world: R = Rz·Ry·Rx"},
    {.key = "scale", .offset = offsetof(TransformDesc, scale), .min = 0, .max = far_away, .min_excluded = true,
     .what = "enlarges the shape before it is turned"},
};

inline constexpr Parameter fabric_keys[] = {
    {.key = "preset", .kind = ParameterKind::text, .offset = offsetof(FabricHead, preset),
     .what = "the fabric whose values stand where none is given here"},
};

inline constexpr Parameter pin_keys[] = {
    {.key = "vertices", .kind = ParameterKind::list,
     .what = "welded vertices, numbered in order of first appearance in the mesh"},
    {.key = "box", .kind = ParameterKind::object, .what = "all within a box in world space, after the transform"},
};

inline constexpr Parameter pin_motion_keys[] = {
    {.key = "attach", .kind = ParameterKind::text, .offset = offsetof(PinDesc, attach),
     .what = "name of a collider that they follow; without, they stay where they start"},
    {.key = "motion", .kind = ParameterKind::list, .what = "they move by these offsets; instead of `attach`"},
    {.key = "compliance", .offset = offsetof(PinDesc, compliance), .min = 0, .max = 1e6, .unit = "m/N",
     .what = "how far they give way per newton, as on an elastic cord; 0: not at all"},
};

inline constexpr Parameter offset_key_keys[] = {
    {.key = "time", .offset = offsetof(OffsetKey, time), .min = 0, .max = 1e6, .unit = "s",
     .what = "later than that of the key before"},
    {.key = "offset", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(OffsetKey, offset),
     .min = -far_away, .max = far_away, .unit = "m", .what = "from where they started; in between it runs straight"},
};

inline constexpr Parameter color_pin_keys[] = {
    {.key = "color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(ColorPins, color), .min = 0,
     .max = 1, .what = "all whose vertex color (linear RGB) is near this one"},
    {.key = "threshold", .offset = offsetof(ColorPins, threshold), .min = 0, .max = 1,
     .what = "largest difference from `color`, per channel; with `color`"},
};

inline constexpr Parameter box_keys[] = {
    {.key = "min", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Bounds, min), .min = -any_float,
     .unit = "m", .what = "least x, y and z", .required = true},
    {.key = "max", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Bounds, max), .min = -any_float,
     .unit = "m", .what = "greatest x, y and z, none less than that of `min`", .required = true},
};

inline constexpr Parameter collider_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(ColliderDesc, name),
     .what = "no two colliders share one; a collider without is called `collider 0`, `collider 1`, …"},
#define WEFT_SHAPE(name, Name) {.key = #name, .kind = ParameterKind::object, .what = name##_what},
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    {.key = "transform", .kind = ParameterKind::object, .what = "where it is"},
    {.key = "motion", .kind = ParameterKind::object, .what = "`\"static\"`, or how it moves"},
    {.key = "friction", .count = 2, .offset = offsetof(ColliderDesc, friction), .min = 0, .max = 100,
     .what = "static and kinetic friction; a pair's is the geometric mean of its two sides"},
};

/// Those of collider_keys of which a collider has exactly one.
inline constexpr std::string_view shape_keys[] = {
#define WEFT_SHAPE(name, Name) #name,
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
};

inline constexpr Parameter motion_keys[] = {
    {.key = "keys", .kind = ParameterKind::list, .what = "where it is at certain times, at least one"},
};

inline constexpr Parameter pose_key_keys[] = {
    {.key = "time", .offset = offsetof(PoseKey, time), .min = 0, .max = 1e6, .unit = "s",
     .what = "later than that of the key before"},
    {.key = "position", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(PoseKey, position),
     .min = -far_away, .max = far_away, .unit = "m", .what = "in place of the transform's"},
    {.key = "rotation", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(PoseKey, rotation_degrees),
     .min = -any_float, .unit = "°", .what = "in place of the transform's; 360 more is one turn more"},
};

inline constexpr Parameter stitch_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(StitchDesc, name),
     .what = "no two rows of stitches share one; without, they are called `stitches 0`, `stitches 1`, …"},
    {.key = "a", .kind = ParameterKind::object, .what = "points on one side", .required = true},
    {.key = "b", .kind = ParameterKind::object, .what = "as many points on the other side", .required = true},
    {.key = "gap", .offset = offsetof(StitchDesc, gap), .min = 0, .max = far_away, .unit = "m",
     .what = "distance at which tied points are kept"},
    {.key = "compliance", .offset = offsetof(StitchDesc, compliance), .min = 0, .max = 1e6, .unit = "m/N",
     .what = "how far each stitch gives way per newton; 0: not at all"},
};

inline constexpr Parameter stitch_end_keys[] = {
    {.key = "cloth", .kind = ParameterKind::text, .offset = offsetof(StitchEnd, cloth),
     .what = "name of the cloth; both sides may be of one cloth", .required = true},
    {.key = "vertices", .kind = ParameterKind::list, .what = "vertices, numbered as for pins"},
    {.key = "points", .kind = ParameterKind::list, .what = "points in triangles; instead of `vertices`"},
};

inline constexpr Parameter surface_point_keys[] = {
    {.key = "triangle", .kind = ParameterKind::integer, .offset = offsetof(MeshPoint, triangle), .min = 0,
     .max = 1e9, .what = "number of the triangle in the mesh"},
    {.key = "weights", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(MeshPoint, weights), .min = 0,
     .max = 1, .what = "of its three corners; their sum is 1"},
};

inline constexpr Parameter look_keys[] = {
    {.key = "material", .kind = ParameterKind::text, .offset = offsetof(LookHead, material),
     .what = "the material whose values stand where none is given here; without, that of the fabric, and of a collider "
             "`matte`, of a plane `floor`"},
};

// clang-format on

/// A transform without `scale`.
inline constexpr std::span<const Parameter> pose_keys = std::span(transform_keys).first(2);

/// The keys of one object of a scene file.
struct SceneTable {
    std::string_view place;  ///< JSON pointer of the object, `*` for any index
    std::span<const Parameter> keys;
    const void* defaults;  ///< the struct that the keys describe, as it is when a file says nothing
};

/// Every table, those of the fabric included, in the order of the documentation. Tables of one place stand together.
std::span<const SceneTable> scene_tables();

}  // namespace weft
