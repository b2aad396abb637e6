// Whether a scene makes sense, wherever it came from: a file, a program or an editor. Ranges are those of the parameter
// tables; what concerns more than one value is here.
#pragma once

#include "base/parameter.h"
#include "scene/problems.h"
#include "scene/scene_desc.h"

#include <weft/result.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// What is wrong with `value` for one element of `parameter`: `must be > 0 kg/m², got -1`; empty if nothing is. `got`
/// replaces the number in the text.
std::string range_problem(const Parameter& parameter, double value, std::string_view got = {});

/// The names of a `choice`, in the order of its enumerators.
std::vector<std::string_view> choice_names(const Parameter& parameter);

/// Checks every value of a table in the struct at `base`; `pointer` is the place of that struct in a scene file.
void check_values(std::span<const Parameter> table, const void* base, const std::string& pointer, Problems& problems);

/// Checks a whole scene, but for what a mesh file alone can tell.
void check_scene(const SceneDesc& scene, Problems& problems);
/// The same, but a world that is to be filled need not have a cloth.
void check_parts(const SceneDesc& scene, Problems& problems);
/// The same as a list, each `where` a JSON pointer in the terms of a scene file; empty if the scene can be run.
Errors check_scene(const SceneDesc& scene);

/// Parts of a scene, each at its `pointer`. check_cloth leaves alone what concerns other parts.
void check_solver(const SolverDesc& solver, const std::string& pointer, Problems& problems);
void check_air(const AirDesc& air, const std::string& pointer, Problems& problems);
void check_cloth(const SceneCloth& cloth, const std::string& pointer, Problems& problems);
void check_pins(const std::vector<PinDesc>& pins, const MeshDesc& mesh, const std::string& pointer, Problems& problems);
/// Colliders that pins name must be among `names`.
void check_attachments(const std::vector<PinDesc>& pins, std::span<const std::string_view> names,
                       const std::string& pointer, Problems& problems);
/// Cloths that stitches name must be among `names`.
void check_stitches(const StitchDesc& stitches, std::span<const std::string_view> names, const std::string& pointer,
                    Problems& problems);
void check_collider(const ColliderDesc& collider, const std::string& pointer, Problems& problems);

/// In check_look.cpp. The names in `look` must be those of cloths or colliders.
void check_camera(const Camera& camera, const std::string& pointer, Problems& problems);
void check_light(const Lighting& light, const std::string& pointer, Problems& problems);
void check_looks(const SceneDesc& scene, const std::string& pointer, Problems& problems);

/// What cloths and colliders are called, each in their order, once those without a name have one.
std::vector<std::string> cloth_names(const SceneDesc& scene);
std::vector<std::string> collider_names(const SceneDesc& scene);
/// Gives cloths and colliders without a name one that is free: `cloth 0`, `collider 0`, …
void name_unnamed(SceneDesc& scene);

}  // namespace weft
