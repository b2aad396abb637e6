// Checks a scene, whether it comes from a file, a program or an editor. The parameter tables hold the ranges of single
// values; this file checks everything that concerns more than one value.
#pragma once

#include "base/parameter.h"
#include "scene/problems.h"
#include "scene/scene_desc.h"

#include <weft/result.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// The problem with `value` for one element of `parameter`, such as `must be > 0 kg/m², got -1`; empty if there is
/// none. `got` replaces the number in the text.
std::string range_problem(const Parameter& parameter, double value, std::string_view got = {});

/// The names of a `choice`, in the order of its enumerators.
std::vector<std::string_view> choice_names(const Parameter& parameter);
/// A short line about each of them; none if they need none.
std::vector<std::string_view> choice_words(const Parameter& parameter);

/// Checks every value of a table in the struct at `base`; `pointer` is the JSON pointer of that struct.
void check_values(std::span<const Parameter> table, const void* base, const std::string& pointer, Problems& problems);

/// Checks a whole scene, except what only the content of mesh files shows.
void check_scene(const SceneDesc& scene, Problems& problems);
/// The same, but a scene without a cloth is valid: cloths can be added to the world later.
void check_parts(const SceneDesc& scene, Problems& problems);
/// The same as a list, each `where` a JSON pointer into the scene file; empty if the scene can be run.
Errors check_scene(const SceneDesc& scene);

/// Checks of single parts of a scene, each at its `pointer`. check_cloth does not check references to other parts.
void check_solver(const SolverDesc& solver, const std::string& pointer, Problems& problems);
void check_air(const AirDesc& air, const std::string& pointer, Problems& problems);
void check_cloth(const SceneCloth& cloth, const std::string& pointer, Problems& problems);
void check_pins(const std::vector<PinDesc>& pins, const MeshDesc& mesh, const std::string& pointer, Problems& problems);
void check_weights(const std::vector<WeightDesc>& weights, const MeshDesc& mesh, const std::string& pointer,
                   Problems& problems);
void check_resistance(const std::vector<ResistanceDesc>& resistance, const MeshDesc& mesh, const std::string& pointer,
                      Problems& problems);
void check_cut(const CutDesc& cut, const std::string& pointer, Problems& problems);
/// Colliders that pins name must be among `names`, which are those of `colliders`, and must not be bodies.
void check_attachments(const std::vector<PinDesc>& pins, std::span<const std::string_view> names,
                       const std::string& pointer, Problems& problems);
/// Cloths that stitches name must be among `names`.
void check_stitches(const StitchDesc& stitches, std::span<const std::string_view> names, const std::string& pointer,
                    Problems& problems);
/// A point in a triangle: its weights must sum to 1.
void check_mesh_point(const MeshPoint& point, const std::string& pointer, Problems& problems);
void check_collider(const ColliderDesc& collider, const std::string& pointer, Problems& problems);
/// Accepts an absent material.
void check_material(const std::optional<SceneMaterial>& material, const std::string& pointer, Problems& problems);

void check_camera(const Camera& camera, const std::string& pointer, Problems& problems);
void check_light(const Lighting& light, const std::string& pointer, Problems& problems);

/// Names of the cloths and of the colliders, in their order, including the names that unnamed ones get.
std::vector<std::string> cloth_names(const SceneDesc& scene);
std::vector<std::string> collider_names(const SceneDesc& scene);
/// Gives each cloth and collider without a name a free one: `cloth 0`, `collider 0`, …
void name_unnamed(SceneDesc& scene);

}  // namespace weft
