#include "io/scenes/scene_schema.h"

#include "scene/check.h"
#include "scene/fabric.h"
#include "scene/problems.h"
#include "scene/scene_keys.h"
#include "scene/values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

/// An object that must have exactly one of these keys. The tables do not contain this rule; scene_schema.test.cpp
/// compares this list with the reader.
struct Kinds {
    std::string_view place;
    std::vector<std::string_view> keys;
};
const Kinds kinds[] = {
    {"/cloths/*/mesh", {"grid", "sphere", "box", "file"}},
    {"/cloths/*/render_mesh", {"grid", "sphere", "box", "file"}},
    {"/cloths/*/pins/*", {"vertices", "group", "box", "color"}},
    {"/cloths/*/cuts/*", {"points", "plane"}},
    {"/cloths/*/seams/*", {"points", "plane"}},
    {"/cloths/*/resistance/*", {"vertices", "group", "box", "color", "channel"}},
    {"/cloths/*/weights/*", {"vertices", "group", "box", "color", "channel"}},
    {"/colliders/*", {std::begin(shape_keys), std::end(shape_keys)}},
    {"/colliders/*/motion", {"keys", "dynamic"}},
    {"/stitches/*/a", {"vertices", "points"}},
    {"/stitches/*/b", {"vertices", "points"}},
};

/// Keys that require one value of the object's key `kind`.
struct KindKeys {
    std::string_view place;
    std::string_view kind;
    std::span<const Parameter> keys;
};
const KindKeys keys_of_kinds[] = {
#define WEFT_WIND(name, Name) {"/air/wind/*", #name, name##_parameters},
#include "physics/air/winds.def"
#undef WEFT_WIND
};

std::vector<const SceneTable*> tables_at(std::string_view place) {
    std::vector<const SceneTable*> found;
    for (const SceneTable& table : scene_tables()) {
        if (table.place == place) found.push_back(&table);
    }
    return found;
}

bool same_keys(const SceneTable* a, const SceneTable* b) {
    return a->keys.data() == b->keys.data() && a->keys.size() == b->keys.size();
}

/// The place whose tables describe the value under `key` of the object at `place`. Objects with the same tables share
/// the places below them, which are listed once. Empty if there is none.
std::string place_below(const std::string& place, const std::string& key) {
    if (!tables_at(place + key).empty()) return place + key;
    // The reader has one function for both.
    if (place + key == "/colliders/*/material") return "/cloths/*/material";
    const auto here = tables_at(place);
    for (const SceneTable& table : scene_tables()) {
        const std::string other(table.place);
        if (std::ranges::equal(tables_at(other), here, same_keys) && !tables_at(other + key).empty()) {
            return other + key;
        }
    }
    return {};
}

/// The shortest decimal form: 0.14f as 0.14, and integers without a point.
template <class Number>
Json number_json(Number number) {
    return Json::parse(number_text(number));
}
Json limit_json(double limit) {
    if (limit == std::round(limit) && std::abs(limit) < 1e15) return static_cast<std::int64_t>(limit);
    return number_json(limit);
}

/// null if there is no default to show.
Json default_json(const Parameter& p, const void* defaults) {
    if (defaults == nullptr || p.required) return nullptr;
    switch (p.kind) {
        case ParameterKind::flag:
            return element<bool>(p, defaults, 0);
        case ParameterKind::choice:
            return choice_names(p).at(static_cast<std::size_t>(element<int>(p, defaults, 0)));
        case ParameterKind::text: {
            const std::string& text = text_of(p, defaults);
            return text.empty() ? Json() : Json(text);
        }
        case ParameterKind::object:
        case ParameterKind::list:
            return nullptr;
        case ParameterKind::angle_or_mesh:
            if (std::isnan(element<float>(p, defaults, 0))) return "mesh";
            break;
        case ParameterKind::number:
        case ParameterKind::vector:
        case ParameterKind::integer:
            break;
    }
    Json numbers = Json::array();
    for (std::size_t i = 0; i < p.count; ++i) {
        numbers.push_back(p.kind == ParameterKind::integer ? number_json(element<std::uint32_t>(p, defaults, i))
                                                           : number_json(element<float>(p, defaults, i)));
    }
    return p.count == 1 ? numbers.front() : numbers;
}

Json one_number(const Parameter& p) {
    const bool integer = p.kind == ParameterKind::integer;
    Json schema = {{"type", integer ? "integer" : "number"}};
    if (p.min > -any_float) schema[p.min_excluded ? "exclusiveMinimum" : "minimum"] = limit_json(p.min);
    const double most = integer ? std::min<double>(p.max, std::numeric_limits<std::uint32_t>::max()) : p.max;
    if (most < any_float) schema["maximum"] = limit_json(most);
    if (p.zero_too) return {{"anyOf", Json::array({{{"const", 0}}, schema})}};
    return schema;
}

Json numbers(const Parameter& p) {
    return {{"type", "array"}, {"items", one_number(p)}, {"minItems", p.count}, {"maxItems", p.count}};
}

Json choices_json(const Parameter& p) {
    Json names = choice_names(p);
    if (p.flag_too) names.push_back(false), names.push_back(true);
    return names;
}

Json fabric_names() {
    Json names = Json::array();
    for (const FabricPreset& preset : fabric_presets()) names.push_back(preset.name);
    return names;
}

Json material_names() {
    Json names = Json::array();
    for (const MaterialPreset& preset : material_presets()) names.push_back(preset.name);
    return names;
}

/// The schema of a string that may replace an object. null if there is none.
Json word_for(std::string_view place) {
    if (place == "/cloths/*/fabric") return {{"enum", fabric_names()}};
    if (place == "/cloths/*/material") return {{"enum", material_names()}};
    if (place == "/colliders/*/motion" || place == "/air/wind/*/motion") return {{"const", "static"}};
    return nullptr;
}

Json object_schema(const std::string& place);

Json object_or_word(const std::string& place) {
    const Json word = word_for(place);
    return word.is_null() ? object_schema(place) : Json{{"anyOf", {word, object_schema(place)}}};
}

Json type_json(const Parameter& p, const std::string& place) {
    const std::string key = '/' + std::string(p.key);
    switch (p.kind) {
        case ParameterKind::number:
            if (p.count == 1) return one_number(p);
            return {{"anyOf", {one_number(p), numbers(p)}}};
        case ParameterKind::vector:
            return numbers(p);
        case ParameterKind::integer:
            if (place.empty() && p.key == "weft") return {{"const", scene_format}};
            return p.count == 1 ? one_number(p) : numbers(p);
        case ParameterKind::angle_or_mesh:
            return {{"anyOf", {one_number(p), {{"const", "mesh"}}}}};
        case ParameterKind::flag:
            return {{"type", "boolean"}};
        case ParameterKind::choice:
            return {{"enum", choices_json(p)}};
        case ParameterKind::text:
            if (place + key == "/cloths/*/fabric/preset") return {{"enum", fabric_names()}};
            if (place + key == "/cloths/*/material/preset") return {{"enum", material_names()}};
            return {{"type", "string"}};
        case ParameterKind::object:
            return object_or_word(place_below(place, key));
        case ParameterKind::list: {
            const std::string below = place_below(place, key + "/*");
            const bool on_cloth = place + key == "/cloths/*/cuts/*/points" || place + key == "/cloths/*/seams/*/points";
            if (on_cloth || place + key == "/colliders/*/convex/points") {
                const Json number = {
                    {"type", "number"}, {"minimum", limit_json(-far_away)}, {"maximum", limit_json(far_away)}};
                return {{"type", "array"},
                        {"items", {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}}},
                        {"minItems", on_cloth ? 2 : 4}};
            }
            if (p.key == one_factor.key) return {{"type", "array"}, {"items", one_number(one_factor)}, {"minItems", 1}};
            // Only lists of vertices have no keys of their own.
            Json items = {{"type", "integer"}, {"minimum", 0}};
            Json schema = {{"type", "array"}, {"items", below.empty() ? items : object_schema(below)}};
            if (p.required || below.empty()) schema["minItems"] = 1;
            return schema;
        }
    }
    return {};
}

Json key_schema(const Parameter& p, const SceneTable& table, const std::string& place) {
    Json schema;
    schema["description"] = std::string(p.what) + (p.unit.empty() ? "" : " (" + std::string(p.unit) + ")");
    if (const Json value = default_json(p, table.defaults); !value.is_null()) schema["default"] = value;
    schema.update(type_json(p, place));
    return schema;
}

/// Requires, for keys that are valid only with one of the `keys` of an object, that key: they share a table with it and
/// with no other of the `keys`.
void add_companions(const SceneTable& table, const std::vector<std::string_view>& keys, Json& schema) {
    const auto is_kind = [&](const Parameter& p) { return std::ranges::find(keys, p.key) != keys.end(); };
    if (!is_kind(table.keys.front()) || std::ranges::count_if(table.keys, is_kind) != 1) return;
    for (const Parameter& p : table.keys.subspan(1)) {
        schema["dependentRequired"][std::string(p.key)] = Json::array({table.keys.front().key});
    }
}

Json object_schema(const std::string& place) {
    Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    Json required = Json::array();
    for (const SceneTable* table : tables_at(place)) {
        for (const Parameter& p : table->keys) {
            schema["properties"][std::string(p.key)] = key_schema(p, *table, place);
            if (p.required) required.push_back(p.key);
        }
    }
    if (!required.empty()) schema["required"] = required;
    for (const KindKeys& of : keys_of_kinds) {
        if (of.place != place) continue;
        const Json with = {{"properties", {{"kind", {{"const", of.kind}}}}}, {"required", {"kind"}}};
        for (const Parameter& p : of.keys) schema["dependentSchemas"][std::string(p.key)] = with;
    }
    const auto* found = std::ranges::find(kinds, place, &Kinds::place);
    if (found == std::end(kinds)) return schema;
    for (const std::string_view key : found->keys) schema["oneOf"].push_back({{"required", Json::array({key})}});
    for (const SceneTable* table : tables_at(place)) add_companions(*table, found->keys, schema);
    return schema;
}

}  // namespace

std::string scene_schema() {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"title", "weft scene"},
                   {"description", "What docs/scene.md says, for editors. Comments are allowed in a scene."}};
    schema.update(object_schema(""));
    return schema.dump(2) + '\n';
}

}  // namespace weft
