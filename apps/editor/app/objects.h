// Objects that the editor adds, copies and removes: what a scene then says.
#pragma once

#include "editor/core/document.h"
#include "editor/ui/icons.h"
#include "view/world_frame.h"

#include <weft/bounds.h>
#include <weft/vector.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

/// Something that a button adds to the scene.
struct AddableObject {
    std::string_view name;   ///< for tests and scripts: `sphere`
    std::string_view label;  ///< `Sphere`
    std::string_view what;
    Icon icon{};
    bool primary = false;  ///< among the four main buttons
};
std::span<const AddableObject> addable_objects();

/// The edits that add an object of this name, and its place afterwards. Fails if the scene lacks what it needs, such as
/// a cloth for a stitch. Cloths and colliders get a color that the others do not have, except a cloth from a mesh that
/// has colors of its own.
struct Addition {
    std::vector<Edit> edits;
    std::string place;
};
Result<Addition> addition(const Document& document, std::string_view name, const std::string& file = {},
                          std::optional<Vec3> position = {}, bool has_colors = false);

/// What a world holds.
struct Room {
    Bounds objects = {};         ///< of cloths and of colliders without planes, m
    std::optional<float> floor;  ///< height of the highest horizontal plane, m
};
Room room_of(const WorldFrame& world);
/// Where a mesh with these bounds falls on what is in the room: over its middle and just above it. An empty room leaves
/// it where it is.
Vec3 place_above(const Bounds& mesh, const Room& room);

/// A copy of the object, beside it, with a name of its own.
Result<Addition> duplication(const Document& document, const std::string& place);

/// The edits that remove an object and what refers to it: attachments to a collider, stitches of a cloth.
std::vector<Edit> removal(const Document& document, const std::string& place);

/// Whether the place is that of an object that can be moved, duplicated and removed.
bool is_object(const std::string& place);

/// `Sphere ball` for messages; the icon of its kind.
std::string describe_object(const Document& document, const std::string& place);
Icon icon_of(const Document& document, const std::string& place);

}  // namespace weft::editor
