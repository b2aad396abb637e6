// What the parameter tables say about a place in a scene: its values with units, ranges and defaults, and what lies
// below.
#pragma once

#include "base/parameter.h"
#include "editor/core/document.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

/// A value under a key of an object.
struct Property {
    const Parameter* parameter = nullptr;
    const void* defaults = nullptr;  ///< the struct that holds the default; null: there is none
    std::string_view key() const { return parameter->key; }
};

/// An object or a list under a key.
struct ChildProperty {
    const Parameter* parameter = nullptr;
    bool is_list = false;
    std::string_view key() const { return parameter->key; }
};

/// Keys of one object of a scene.
struct PropertyGroup {
    std::vector<Property> values;
    std::vector<Property> seldom;         ///< values that few scenes change, for a section of their own
    std::vector<ChildProperty> children;  ///< the most used ones first
    /// Keys of which the object has exactly one, such as the shapes of a collider.
    std::vector<std::string_view> one_of;
};

/// `/cloths/*/pins/*` of `/cloths/0/pins/3`.
std::string pattern_of(const std::string& place);

/// Everything that the tables know about the object at `place`. Defaults of a fabric or a material are those of its
/// preset.
PropertyGroup properties_of(const Document& document, const std::string& place);

/// The default as a scene file would have it; nullopt: there is none.
std::optional<Json> default_of(const Property& property);
/// The value of the document, or the default.
std::optional<Json> value_of(const Document& document, const std::string& place, const Property& property);

/// `Static friction` of `static_friction`.
std::string label_of_key(std::string_view key);

/// Names of the numbers under a key, such as `static` and `kinetic`; empty: they are along x, y and z.
std::span<const std::string_view> parts_of(const std::string& place, const Parameter& parameter);

/// Names that a text may have: fabrics, materials, colliders, cloths; empty: any text.
std::vector<std::string> names_for(const Document& document, const std::string& place, std::string_view key);

/// How a collider can move, as a choice shows it: `static`, `keys` and `dynamic`. A plane cannot be `dynamic`.
std::vector<std::string_view> motions_of(const Document& document, const std::string& collider);
/// The number of the present one among those.
std::size_t motion_of(const Document& document, const std::string& collider);
/// The edits that make a collider move as the choice with this number says. The new motion passes the checks of a
/// scene: a first key at the transform, or a body. A mesh becomes a body of 1 kg, which needs no volume, and a solid.
std::vector<Edit> change_motion(const Document& document, const std::string& collider, std::size_t motion);

/// A new element for a list, which passes the checks of a scene; nullopt: the list cannot be extended by a button.
std::optional<Json> new_element(const Document& document, const std::string& list);

}  // namespace weft::editor
