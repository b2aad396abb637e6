// All keys of a scene except those of fabrics and of collider shapes: the member that stores the value, its range, unit
// and meaning. Reader, checks and documentation use these tables, so a new value takes a member in scene_desc.h and a
// line here.
#pragma once

#include "base/parameter.h"
#include "physics/air/winds.def"
#include "physics/body/body.data.h"
#include "physics/contact/shapes.def"
#include "scene/scene_desc.h"

#include <weft/grab.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace weft {

inline constexpr std::uint32_t scene_format = 1;

inline constexpr double any_float = std::numeric_limits<float>::max();

/// Limit for the vertices of all meshes that a scene describes by parameters; 2²⁴ is a grid of 4096 × 4096.
inline constexpr std::uint64_t max_made_vertices = 1u << 24;

/// Keys of a file that a SceneDesc does not store.
struct SceneHead {
    std::uint32_t weft = scene_format;
};
struct WindHead {
    int kind = 0;  ///< number of the alternative of WindDesc::kind
};
struct FabricHead {
    std::string preset = "cotton";
};
struct MaterialHead {
    std::string preset = {};
};
struct GroupHead {
    std::string group = {};
};

// One entry per scene key.
// clang-format off
inline constexpr Parameter head_keys[] = {
    {.key = "weft", .kind = ParameterKind::integer, .offset = offsetof(SceneHead, weft), .min = 1,
     .what = "version of the format, 1", .required = true},
};

inline constexpr Parameter scene_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(SceneDesc, name),
     .what = "name of the scene"},
    {.key = "gravity", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(SceneDesc, gravity),
     .min = -far_away, .max = far_away, .unit = "m/s²", .what = "acceleration due to gravity"},
    {.key = "frame_rate", .offset = offsetof(SceneDesc, frame_rate), .min = 0, .max = 100000, .min_excluded = true,
     .unit = "frames/s", .what = "frames per second of simulated time"},
    {.key = "solver", .kind = ParameterKind::object, .what = "solver settings"},
    {.key = "air", .kind = ParameterKind::object, .what = "air and wind; without this key there is no air"},
    {.key = "cloths", .kind = ParameterKind::list, .what = "the cloths, at least one", .required = true},
    {.key = "colliders", .kind = ParameterKind::list, .what = "the colliders"},
    {.key = "stitches", .kind = ParameterKind::list, .what = "stitches between cloths, or within one"},
    {.key = "camera", .kind = ParameterKind::object,
     .what = "camera; without this key it is placed so that the whole scene is visible"},
    {.key = "light", .kind = ParameterKind::object, .what = "lights"},
};

inline constexpr Parameter solver_keys[] = {
    {.key = "method", .kind = ParameterKind::choice, .offset = offsetof(SolverDesc, method),
     .what = "`xpbd`: stiffness in SI units, independent of the substeps; `pbd`: plain position-based dynamics with "
             "the fabric's `stiffness`, for comparison",
     .choices = "xpbd|pbd",
     .choice_words = "stiffness in SI units|plain position-based dynamics, for comparison"},
    {.key = "projection", .kind = ParameterKind::choice, .offset = offsetof(SolverDesc, projection),
     .what = "`gauss-seidel`: one constraint after another, color by color; `lines`: the same, but the stretch of a "
             "whole line of edges at once; `jacobi`: all at once and averaged, converges more slowly; `auto`: "
             "`lines`, for `pbd` `gauss-seidel`",
     .choices = "auto|lines|gauss-seidel|jacobi",
     .choice_words = "lines, or gauss-seidel for pbd|whole lines of edges at once|one constraint after another|"
                     "all at once, averaged; converges slowly"},
    {.key = "accumulate", .kind = ParameterKind::choice, .offset = offsetof(SolverDesc, accumulate),
     .what = "how `jacobi` sums the corrections of a particle: `gather`: as floats in a fixed order; `fixed-point`: "
             "as multiples of 1/65536 m in any order",
     .choices = "gather|fixed-point",
     .choice_words = "sums floats in a fixed order|sums multiples of 1/65536 m in any order"},
    {.key = "hierarchy", .kind = ParameterKind::flag, .offset = offsetof(SolverDesc, hierarchy),
     .what = "solve coarse levels of each cloth first: far less stretch in large cloths"},
    {.key = "substeps", .kind = ParameterKind::integer, .offset = offsetof(SolverDesc, substeps), .min = 1,
     .max = 10000, .what = "substeps per frame; twice as many take twice the time and leave about a quarter of the "
                           "stretch"},
    {.key = "iterations", .kind = ParameterKind::integer, .offset = offsetof(SolverDesc, iterations), .min = 1,
     .max = 10000, .what = "iterations over all constraints per substep; more substeps reduce the error more"},
    {.key = "compensation", .kind = ParameterKind::choice, .offset = offsetof(SolverDesc, compensation),
     .what = "keep what rounding drops from displacements by constraints: `auto`: in substeps shorter than 1/2600 s",
     .choices = "auto|on|off",
     .choice_words = "on in substeps shorter than 1/2600 s|keeps what rounding drops; a quarter slower|drops it"},
};

inline constexpr Parameter air_keys[] = {
    {.key = "density", .offset = offsetof(AirDesc, density), .min = 0, .max = 1e4, .unit = "kg/m³",
     .what = "density; 1.225 is air at sea level and 15 °C"},
    {.key = "wind", .kind = ParameterKind::list, .what = "wind sources; their velocities add up"},
};

#define WEFT_WIND(name, Name) "|" #name
inline constexpr std::string_view wind_choices = std::string_view(
#include "physics/air/winds.def"
    ).substr(1);
#undef WEFT_WIND

inline constexpr Parameter wind_head_keys[] = {
    {.key = "kind", .kind = ParameterKind::choice, .offset = offsetof(WindHead, kind),
     .what = "`directional`: the same everywhere; `jet`: a round turbulent jet from a nozzle; `vortex`: air that turns "
             "around the source's y axis",
     .choices = wind_choices,
     .choice_words = "the same everywhere|a round jet from a nozzle, as of a fan|"
                     "turns around the y axis of the source"},
};

inline constexpr Parameter wind_keys[] = {
    {.key = "velocity", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(WindDesc, velocity), .min = -1e4,
     .max = 1e4, .unit = "m/s",
     .what = "velocity of the air, along the axes of the source; of a `jet` at its nozzle, of a `vortex` on its axis"},
    {.key = "transform", .kind = ParameterKind::object, .what = "position and rotation of the source"},
    {.key = "motion", .kind = ParameterKind::object, .what = "`\"static\"`, or how it moves and changes"},
    {.key = "box", .kind = ParameterKind::object, .what = "bounds of the source; by default it has none"},
    {.key = "shelter", .offset = offsetof(WindDesc, shelter), .min = 0, .max = far_away, .unit = "m",
     .what = "a triangle gets none of this wind if a collider stands within this distance against it; 0: colliders do "
             "not stop the wind"},
    {.key = "gust", .kind = ParameterKind::object, .what = "change over time"},
    {.key = "turbulence", .kind = ParameterKind::object, .what = "change from place to place"},
    {.key = "seed", .kind = ParameterKind::integer, .offset = offsetof(WindDesc, seed), .min = 0, .max = 16777215,
     .what = "selects the random gusts and eddies"},
};

inline constexpr Parameter wind_key_keys[] = {
    {.key = "time", .offset = offsetof(WindKey, time), .min = 0, .max = 1e6, .unit = "s",
     .what = "later than the time of the key before"},
    {.key = "position", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(WindKey, position),
     .min = -far_away, .max = far_away, .unit = "m", .what = "position, in place of the transform's"},
    {.key = "rotation", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(WindKey, rotation_degrees),
     .min = -any_float, .unit = "°", .what = "rotation, in place of the transform's; 360 more adds a turn"},
    {.key = "strength", .offset = offsetof(WindKey, strength), .min = 0, .max = 100,
     .what = "factor of all velocities of the source"},
};

inline constexpr Parameter wind_box_keys[] = {
    {.key = "half_extents", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(WindBoxDesc, half_extents),
     .min = 0, .max = far_away, .min_excluded = true, .unit = "m",
     .what = "half of the size along the x, y and z axes of the source, around its position"},
    {.key = "border", .offset = offsetof(WindBoxDesc, border), .min = 0, .max = far_away, .unit = "m",
     .what = "distance from the box over which the wind fades to nothing"},
};

inline constexpr Parameter gust_keys[] = {
    {.key = "amplitude", .offset = offsetof(GustDesc, amplitude), .min = 0, .max = 100,
     .what = "largest change, as a fraction of the velocity"},
    {.key = "frequency", .offset = offsetof(GustDesc, frequency), .min = 0, .max = 1e3, .unit = "1/s",
     .what = "gusts per second"},
    {.key = "scale", .offset = offsetof(GustDesc, scale), .min = 0, .max = far_away, .min_excluded = true, .unit = "m",
     .what = "distance across the wind at which gusts become independent"},
    {.key = "phase", .kind = ParameterKind::choice, .offset = offsetof(GustDesc, phase),
     .what = "`smooth`: neighboring triangles get the same gust; `scattered`: each triangle has its own phase and "
             "frequency",
     .choices = "smooth|scattered",
     .choice_words = "neighbors get the same gust|each triangle flutters by itself"},
};

inline constexpr Parameter turbulence_keys[] = {
    {.key = "strength", .offset = offsetof(TurbulenceDesc, strength), .min = 0, .max = 100,
     .what = "largest change, as a fraction of the velocity"},
    {.key = "scale", .offset = offsetof(TurbulenceDesc, scale), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "size of an eddy across the wind"},
    {.key = "period", .offset = offsetof(TurbulenceDesc, period), .min = 0, .max = 1e6, .unit = "s",
     .what = "lifetime of an eddy; 0: eddies do not change"},
};

inline constexpr Parameter cloth_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(SceneCloth, name),
     .what = "unique name; by default `cloth 0`, `cloth 1`, …"},
    {.key = "mesh", .kind = ParameterKind::object, .what = "simulated mesh: a grid, a sphere, a box or a file"},
    {.key = "render_mesh", .kind = ParameterKind::object, .what = "mesh that is drawn and exported in place of "
                                                                  "`mesh`, and follows it"},
    {.key = "transform", .kind = ParameterKind::object, .what = "position, rotation and scale at the start"},
    {.key = "velocity", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(SceneCloth, velocity),
     .min = -1e4, .max = 1e4, .unit = "m/s", .what = "velocity at the start, of all particles that are not pinned"},
    {.key = "fabric", .kind = ParameterKind::object, .what = "name of a fabric, or an object"},
    {.key = "tethers", .kind = ParameterKind::choice, .offset = offsetof(SceneCloth, tethers),
     .what = "limit each particle's distance to its pins by the geodesic distance at rest: far less stretch; "
             "`auto`: on if `hierarchy` is on, the fabric is `inextensible` and the cloth hangs by at most 16 places",
     .choices = "auto|on|off",
     .choice_words = "on if the cloth hangs and does not stretch|limits the distance of each particle to its pins|"
                     "only the fabric limits the stretch"},
    {.key = "tether_slack", .offset = offsetof(SceneCloth, tether_slack), .min = 0, .max = 100,
     .what = "fraction by which a particle may exceed that distance; with `tethers`"},
    {.key = "self_collision", .kind = ParameterKind::choice, .offset = offsetof(SceneCloth, self_collision),
     .what = "contact with itself and with the other cloths that have it; `true`: `exact`; `false`: `off`",
     .choices = "off|fast|exact",
     .choice_words = "passes through itself|particles keep a distance; may cross for a moment|"
                     "never passes through itself; slower", .flag_too = true},
    {.key = "tearing", .kind = ParameterKind::choice, .offset = offsetof(SceneCloth, tearing),
     .what = "whether it can part: never; where it is cut; also by itself where its load exceeds the fabric's limits; "
             "or where it is cut, and by losing triangles whose edges exceed `tear_ratio`",
     .choices = "off|cuts|split|erode",
     .choice_words = "never parts, cannot be cut|parts where it is cut|"
                     "also tears by itself where the load is too high|loses triangles that are stretched too far"},
    {.key = "tear_room", .offset = offsetof(SceneCloth, tear_room), .min = 0, .max = 5,
     .what = "room for copies of particles where it parts, as a fraction of its particles; 256 more are always there; "
             "with `tearing`"},
    {.key = "collision_group", .kind = ParameterKind::integer, .offset = offsetof(SceneCloth, collision_group),
     .max = 31, .what = "group of the cloth, for `collision_mask`"},
    {.key = "collision_mask", .kind = ParameterKind::integer, .offset = offsetof(SceneCloth, collision_mask),
     .max = 4294967295, .what = "with which groups of other cloths it collides: the sum of 2^group"},
    {.key = "layer", .kind = ParameterKind::integer, .offset = offsetof(SceneCloth, layer), .max = 1000,
     .what = "where cloths of two layers cross, untangling moves the higher one to the front of the lower one"},
    {.key = "groups", .kind = ParameterKind::list, .what = "vertices with a name, for `pins`, `resistance` and `weights`"},
    {.key = "pins", .kind = ParameterKind::list, .what = "particles whose positions are given"},
    {.key = "cuts", .kind = ParameterKind::list,
     .what = "where the cloth is opened, and when; needs `tearing` `cuts`, `split` or `erode`"},
    {.key = "seams", .kind = ParameterKind::list,
     .what = "edges with a strength of their own; needs `tearing` `split`"},
    {.key = "resistance", .kind = ParameterKind::list,
     .what = "particles that are weaker or stronger than the fabric; needs `tearing` `split` or `erode`"},
    {.key = "weights", .kind = ParameterKind::list,
     .what = "particles whose cloth is heavier or lighter, stiffer or softer, thicker or thinner than the fabric"},
    {.key = "material", .kind = ParameterKind::object,
     .what = "a material's name, or its values; for images and exports"},
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
     .what = "diagonals of the cells: all alike, a checkerboard, or both with a particle in the middle",
     .choices = "uniform|alternating|cross",
     .choice_words = "all alike|a checkerboard, bends alike in all directions|both, with a particle in the middle"},
};

inline constexpr Parameter sphere_mesh_keys[] = {
    {.key = "radius", .offset = offsetof(SphereMeshDesc, radius), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "radius of the sphere"},
    {.key = "subdivisions", .kind = ParameterKind::integer, .offset = offsetof(SphereMeshDesc, subdivisions), .min = 0,
     .max = 7, .what = "how often the 20 triangles of an icosahedron are split into four"},
};

inline constexpr Parameter box_mesh_keys[] = {
    {.key = "size", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(BoxMeshDesc, size), .min = 0,
     .max = far_away, .min_excluded = true, .unit = "m", .what = "extent along x, y and z"},
    {.key = "resolution", .kind = ParameterKind::integer, .count = 3, .offset = offsetof(BoxMeshDesc, resolution),
     .min = 2, .max = 4096, .what = "particles along x, y and z"},
};

inline constexpr Parameter transform_keys[] = {
    {.key = "position", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(TransformDesc, position),
     .min = -far_away, .max = far_away, .unit = "m", .what = "position of the shape's origin"},
    {.key = "rotation", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(TransformDesc, rotation_degrees),
     .min = -any_float, .unit = "°", .what = "rotation about the world's x, then y, then z axis: R = Rz·Ry·Rx"},
    {.key = "scale", .offset = offsetof(TransformDesc, scale), .min = 0, .max = far_away, .min_excluded = true,
     .what = "scale of the shape, applied before the rotation"},
};

inline constexpr Parameter fabric_keys[] = {
    {.key = "preset", .kind = ParameterKind::text, .offset = offsetof(FabricHead, preset),
     .what = "fabric whose values are used for keys that are not given"},
};

inline constexpr Parameter pin_keys[] = {
    {.key = "vertices", .kind = ParameterKind::list,
     .what = "numbers of welded vertices, in order of first appearance in the mesh"},
    {.key = "box", .kind = ParameterKind::object, .what = "all particles within this box in world space, after the "
                                                          "transform"},
};

inline constexpr Parameter group_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(VertexGroup, name),
     .what = "name, unique in the cloth", .required = true},
    {.key = "vertices", .kind = ParameterKind::list, .what = "vertices, numbered as for `pins`", .required = true},
};

/// Selects the vertices of a group.
inline constexpr Parameter in_group_keys[] = {
    {.key = "group", .kind = ParameterKind::text, .offset = offsetof(GroupHead, group),
     .what = "name of one of the cloth's `groups`"},
};

inline constexpr Parameter pin_motion_keys[] = {
    {.key = "attach", .kind = ParameterKind::text, .offset = offsetof(PinDesc, attach),
     .what = "name of a collider that the particles follow, and pull if it is a body; by default they stay where they "
             "start"},
    {.key = "motion", .kind = ParameterKind::list, .what = "offsets at given times; in place of `attach`"},
    {.key = "compliance", .offset = offsetof(PinDesc, compliance), .min = 0, .max = 1e6, .unit = "m/N",
     .what = "displacement per newton, as on an elastic cord; 0: rigid"},
};

inline constexpr Parameter offset_key_keys[] = {
    {.key = "time", .offset = offsetof(OffsetKey, time), .min = 0, .max = 1e6, .unit = "s",
     .what = "later than the time of the key before"},
    {.key = "offset", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(OffsetKey, offset),
     .min = -far_away, .max = far_away, .unit = "m", .what = "offset from the start; linear between keys"},
};

inline constexpr Parameter color_pin_keys[] = {
    {.key = "color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(ColorPins, color), .min = 0,
     .max = 1,
     .above_hint = color_hint, .what = "all particles whose vertex color (linear RGB) is near this one"},
    {.key = "threshold", .offset = offsetof(ColorPins, threshold), .min = 0, .max = 1,
     .what = "largest difference from `color`, per channel; with `color`"},
};

// Where a cut or a seam runs.
inline constexpr Parameter path_points = {
    .key = "points", .kind = ParameterKind::list,
    .what = "a polyline on the cloth at the start, in world space after the transform, at least two points in m"};
inline constexpr Parameter path_plane = {
    .key = "plane", .kind = ParameterKind::object,
    .what = "a plane through the cloth at the start; in place of `points`"};

inline constexpr Parameter cut_keys[] = {
    {.key = "time", .offset = offsetof(CutDesc, time), .min = 0, .max = 1e6, .unit = "s",
     .what = "the cloth is cut before the first frame that begins at this time or later"},
    path_points,
    path_plane,
};

inline constexpr Parameter seam_keys[] = {
    {.key = "strength", .offset = offsetof(SeamDesc, strength), .min = 0, .max = 1e9, .min_excluded = true, .unit = "N/m",
     .what = "tension across the seam that it carries", .required = true},
    {.key = "tear_energy", .offset = offsetof(SeamDesc, tear_energy), .min = 0, .max = 1e9, .unit = "J/m",
     .what = "energy per length of seam; sets the limit at the end of the open part; 0: `strength` holds there too"},
    path_points,
    path_plane,
};

inline constexpr Parameter resistance_vertex_keys[] = {
    {.key = "vertices", .kind = ParameterKind::list,
     .what = "numbers of welded vertices, in order of first appearance in the mesh"},
    {.key = "factors", .kind = ParameterKind::list,
     .what = "one number per vertex, 0.001 … 1000000; `factor` is multiplied by it, and at least 0.001; with `vertices`"},
};

/// One of the list `factors`.
inline constexpr Parameter one_factor = {.key = "factors", .min = 0.001, .max = 1e6};

inline constexpr Parameter resistance_keys[] = {
    {.key = "box", .kind = ParameterKind::object, .what = "all particles within this box in world space, after the "
                                                          "transform"},
};

inline constexpr Parameter resistance_factor_keys[] = {
    {.key = "factor", .offset = offsetof(ResistanceDesc, factor), .min = 0.001, .max = 1e6,
     .what = "factor on `strength`, on the limit at the ends of cuts and on the strain of `tear_ratio`"},
};

inline constexpr Parameter weight_keys[] = {
    {.key = "of", .kind = ParameterKind::choice, .offset = offsetof(WeightDesc, of),
     .what = "what `factor` is multiplied with: the density of the fabric; its stiffness against stretch, shear and "
             "compression; its stiffness against bending; or its thickness in contact",
     .choices = "density|stretch|bend|thickness",
     .choice_words = "mass per area|stiffness against stretch, shear and compression|stiffness against bending|thickness "
                     "in contact",
     .required = true},
};

inline constexpr Parameter weight_factor_keys[] = {
    {.key = "factor", .offset = offsetof(WeightDesc, factor), .min = 0.001, .max = 1e6,
     .what = "factor on the value of the fabric; a triangle has the mean of its corners, or the thickness of the "
             "thinnest one"},
};

inline constexpr Parameter painted_channel_keys[] = {
    {.key = "channel", .kind = ParameterKind::choice, .offset = offsetof(PaintedChannel, channel),
     .what = "all particles; `factor` is multiplied by this channel of the vertex color (linear), and at least 0.001",
     .choices = "red|green|blue|alpha"},
};

inline constexpr Parameter cut_plane_keys[] = {
    {.key = "normal", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(PlaneCut, normal),
     .min = -far_away, .max = far_away, .what = "normal of the plane in world space; any length but 0"},
    {.key = "offset", .offset = offsetof(PlaneCut, offset), .min = -far_away, .max = far_away, .unit = "m",
     .what = "distance of the plane from the origin, along the normal"},
};

inline constexpr Parameter box_keys[] = {
    {.key = "min", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Bounds, min), .min = -any_float,
     .unit = "m", .what = "smallest x, y and z", .required = true},
    {.key = "max", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Bounds, max), .min = -any_float,
     .unit = "m", .what = "largest x, y and z, none less than that of `min`", .required = true},
};

inline constexpr Parameter collider_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(ColliderDesc, name),
     .what = "unique name; by default `collider 0`, `collider 1`, …"},
#define WEFT_SHAPE(name, Name) {.key = #name, .kind = ParameterKind::object, .what = name##_what},
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    {.key = "transform", .kind = ParameterKind::object, .what = "position and rotation"},
    {.key = "motion", .kind = ParameterKind::object, .what = "`\"static\"`, or how it moves"},
    {.key = "friction", .count = 2, .offset = offsetof(ColliderDesc, friction), .min = 0, .max = 100,
     .what = "static and kinetic friction coefficient; a contact has the geometric mean of both sides"},
    {.key = "material", .kind = ParameterKind::object,
     .what = "a material's name, or its values; for images and exports"},
};

/// The keys of collider_keys of which a collider must have exactly one.
inline constexpr std::string_view shape_keys[] = {
#define WEFT_SHAPE(name, Name) #name,
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
};

inline constexpr Parameter motion_keys[] = {
    {.key = "keys", .kind = ParameterKind::list, .what = "poses at given times, at least one"},
};

inline constexpr Parameter collider_motion_keys[] = {
    motion_keys[0],
    {.key = "dynamic", .kind = ParameterKind::object, .what = "a body: gravity and what it touches move it"},
};

inline constexpr Parameter pose_key_keys[] = {
    {.key = "time", .offset = offsetof(PoseKey, time), .min = 0, .max = 1e6, .unit = "s",
     .what = "later than the time of the key before"},
    {.key = "position", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(PoseKey, position),
     .min = -far_away, .max = far_away, .unit = "m", .what = "position, in place of the transform's"},
    {.key = "rotation", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(PoseKey, rotation_degrees),
     .min = -any_float, .unit = "°", .what = "rotation, in place of the transform's; 360 more adds a turn"},
};

inline constexpr Parameter stitch_keys[] = {
    {.key = "name", .kind = ParameterKind::text, .offset = offsetof(StitchDesc, name),
     .what = "unique name; by default `stitches 0`, `stitches 1`, …"},
    {.key = "a", .kind = ParameterKind::object, .what = "points on one side", .required = true},
    {.key = "b", .kind = ParameterKind::object, .what = "as many points on the other side", .required = true},
    {.key = "gap", .offset = offsetof(StitchDesc, gap), .min = 0, .max = far_away, .unit = "m",
     .what = "distance between stitched points"},
    {.key = "compliance", .offset = offsetof(StitchDesc, compliance), .min = 0, .max = 1e6, .unit = "m/N",
     .what = "displacement of a stitch per newton; 0: rigid"},
};

inline constexpr Parameter stitch_end_keys[] = {
    {.key = "cloth", .kind = ParameterKind::text, .offset = offsetof(StitchEnd, cloth),
     .what = "name of the cloth; both sides may be of one cloth", .required = true},
    {.key = "vertices", .kind = ParameterKind::list, .what = "vertices, numbered as for `pins`"},
    {.key = "points", .kind = ParameterKind::list, .what = "points in triangles, in place of `vertices`"},
};

inline constexpr Parameter surface_point_keys[] = {
    {.key = "triangle", .kind = ParameterKind::integer, .offset = offsetof(MeshPoint, triangle), .min = 0,
     .max = 1e9, .what = "number of the triangle in the mesh"},
    {.key = "weights", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(MeshPoint, weights), .min = 0,
     .max = 1, .what = "barycentric weights of its three corners; their sum is 1"},
};

/// Of a grab, which is no part of a scene.
inline constexpr Parameter grab_keys[] = {
    {.key = "max_force", .offset = offsetof(GrabDesc, max_force), .min = 0, .max = largest_grab_force,
     .min_excluded = true, .unit = "N", .what = "the pull is never stronger"},
    {.key = "compliance", .offset = offsetof(GrabDesc, compliance), .min = 0, .max = 1e6, .unit = "m/N",
     .what = "distance between point and target per newton; 0: rigid"},
    {.key = "damping", .offset = offsetof(GrabDesc, damping), .min = 0, .max = 10, .unit = "s",
     .what = "how long the point takes to approach its target"},
};

/// Of a Vec3.
inline constexpr Parameter grab_target_keys[] = {
    {.key = "to", .kind = ParameterKind::vector, .count = 3, .min = -far_away, .max = far_away, .unit = "m",
     .what = "where the point is pulled to"},
};

/// Of a Vec3.
inline constexpr Parameter impulse_keys[] = {
    {.key = "impulse", .kind = ParameterKind::vector, .count = 3, .min = -1e12, .max = 1e12, .unit = "N·s",
     .what = "what the momentum changes by"},
};
inline constexpr Parameter point_keys[] = {
    {.key = "point", .kind = ParameterKind::vector, .count = 3, .min = -far_away, .max = far_away, .unit = "m",
     .what = "where the impulse acts"},
};

inline constexpr Parameter material_keys[] = {
    {.key = "preset", .kind = ParameterKind::text, .offset = offsetof(MaterialHead, preset),
     .what = "material whose values are used for keys that are not given; by default that of the fabric, `matte` "
             "for a collider, `floor` for a plane"},
};

// clang-format on

/// A transform without `scale`.
inline constexpr std::span<const Parameter> pose_keys = std::span(transform_keys).first(2);

/// The keys of one object of a scene file.
struct SceneTable {
    std::string_view place;  ///< JSON pointer of the object, `*` for any index
    std::span<const Parameter> keys;
    const void* defaults;  ///< a struct with the default values; the keys describe its members
};

/// All tables, including those of the fabric, in the order of the documentation. Tables of one place are adjacent.
std::span<const SceneTable> scene_tables();

}  // namespace weft
