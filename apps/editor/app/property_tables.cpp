#include "editor/app/property_tables.h"

#include "scene/check.h"
#include "scene/fabric.h"
#include "scene/materials.h"
#include "scene/scene_keys.h"
#include "scene/values.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace weft::editor {
namespace {

/// Keys of which an object has one, by the pattern of the object.
struct OneOf {
    std::string_view pattern;
    std::vector<std::string_view> keys;
};
const std::vector<OneOf>& alternatives_of_objects() {
    static const std::vector<OneOf> all = {
        {"/cloths/*/mesh", {"grid", "sphere", "box", "file"}},
        {"/cloths/*/pins/*", {"vertices", "group", "box", "color"}},
        {"/cloths/*/resistance/*", {"vertices", "group", "box", "color", "channel"}},
        {"/cloths/*/weights/*", {"vertices", "group", "box", "color", "channel"}},
        {"/cloths/*/cuts/*", {"points", "plane"}},
        {"/cloths/*/seams/*", {"points", "plane"}},
        {"/stitches/*/a", {"vertices", "points"}},
        {"/colliders/*", {std::begin(shape_keys), std::end(shape_keys)}},
        {"/colliders/*/motion", {"keys", "dynamic"}},
    };
    return all;
}

/// Keys that have a meaning only beside another one.
struct Companion {
    std::string_view pattern, key, needs;
};
constexpr Companion companions[] = {
    {"/cloths/*/mesh", "scale", "file"},
    {"/cloths/*/mesh", "up", "file"},
    {"/cloths/*/pins/*", "threshold", "color"},
    {"/cloths/*/resistance/*", "threshold", "color"},
    {"/cloths/*/resistance/*", "factors", "vertices"},
    {"/cloths/*/weights/*", "threshold", "color"},
    {"/cloths/*/weights/*", "factors", "vertices"},
};

/// Keys of a cloth in the order in which they are shown before all others.
constexpr std::string_view first_of_cloth[] = {"fabric", "transform", "mesh", "material", "pins"};
/// Values of a cloth that few scenes change.
constexpr std::string_view seldom_of_cloth[] = {"velocity",        "tethers",        "tether_slack", "tear_room",
                                                "collision_group", "collision_mask", "layer"};

/// Numbers that are not along x, y and z. `pattern`: empty: in every object.
struct Parts {
    std::string_view pattern, key;
    std::vector<std::string_view> names;
};
const std::vector<Parts>& parts_of_keys() {
    static const std::vector<Parts> all = {
        {"", "friction", {"static", "kinetic"}},
        {"/cloths/*/fabric", "stretch", {"warp", "weft"}},
        {"/cloths/*/fabric", "compression", {"warp", "weft"}},
        {"/cloths/*/fabric", "strength", {"warp", "weft"}},
        {"/cloths/*/fabric", "stretch_limit", {"warp", "weft"}},
        {"/cloths/*/fabric", "bend", {"warp", "bias", "weft"}},
        {"/cloths/*/fabric", "stiffness", {"stretch", "compress", "bend"}},
        {"/cloths/*/mesh/grid", "size", {"x", "z"}},
        {"/cloths/*/mesh/grid", "resolution", {"x", "z"}},
        {"/colliders/*/tapered_capsule", "radius", {"\u2212y", "+y"}},
        {"/cloths/*/material", "roughness", {"along", "across"}},
        {"/cloths/*/material", "uv_tiling", {"u", "v"}},
    };
    return all;
}

/// Some objects have the keys of others, and only those are in the tables.
std::string table_pattern(std::string pattern) {
    const auto replace = [&](std::string_view from, std::string_view to) {
        if (pattern.starts_with(from)) pattern.replace(0, from.size(), to);
    };
    replace("/cloths/*/render_mesh/", "/cloths/*/mesh/");
    replace("/colliders/*/material", "/cloths/*/material");
    replace("/stitches/*/b/", "/stitches/*/a/");
    return pattern;
}

std::size_t index_in(const std::string& place, std::string_view list) {
    return std::stoul(place.substr(list.size()));
}

/// The cloth that the place belongs to; null if it belongs to none.
const SceneCloth* cloth_at(const Document& document, const std::string& place) {
    if (!place.starts_with("/cloths/")) return nullptr;
    const std::size_t index = index_in(place, "/cloths/");
    return index < document.scene.cloths.size() ? &document.scene.cloths[index] : nullptr;
}

const Material* preset_material(const Document& document, const std::string& place) {
    const Json* value = find(document.json, place);
    std::string name;
    if (value && value->is_string()) name = value->get<std::string>();
    if (value && value->is_object()) name = value->value("preset", "");
    if (const MaterialPreset* preset = find_material(name)) return &preset->material;
    if (const SceneCloth* cloth = cloth_at(document, place)) {
        return &default_material(*cloth).material;
    } else if (place.starts_with("/colliders/")) {
        const std::size_t index = index_in(place, "/colliders/");
        if (index < document.scene.colliders.size()) return &default_material(document.scene.colliders[index]).material;
    }
    return &find_material("matte")->material;
}

const Fabric& preset_fabric(const Document& document, const std::string& place) {
    const SceneCloth* cloth = cloth_at(document, place);
    const FabricPreset* preset = cloth ? find_fabric(cloth->fabric_name) : nullptr;
    return preset ? preset->fabric : find_fabric("cotton")->fabric;
}

/// The defaults of a table for this object.
const void* defaults_for(const Document& document, const std::string& place, const std::string& pattern,
                         const SceneTable& table) {
    if (pattern == "/cloths/*/material" && table.keys.data() == std::span(material_parameters).data())
        return preset_material(document, place);
    if (pattern == "/cloths/*/fabric") {
        for (const FabricTable& fabric : fabric_tables())
            if (fabric.parameters.data() == table.keys.data())
                return reinterpret_cast<const std::byte*>(&preset_fabric(document, place)) + fabric.offset;
    }
    return table.defaults;
}

/// Whether the table is that of another kind of wind.
bool is_of_another_wind(const Json* object, const SceneTable& table) {
    const Parameter& kind = wind_head_keys[0];
    const std::vector<std::string_view> names = choice_names(kind);
    const std::string chosen = object && object->is_object() ? object->value("kind", std::string(names[0])) : "";
    std::size_t number = 0;
#define WEFT_WIND(name, Name)                                                                     \
    if (table.keys.data() == std::span(name##_parameters).data()) return names[number] != chosen; \
    ++number;
#include "physics/air/winds.def"
#undef WEFT_WIND
    return false;
}

Json element_json(const Parameter& p, const void* base, std::size_t i) {
    return p.kind == ParameterKind::integer ? Json(element<std::uint32_t>(p, base, i))
                                            : number(element<float>(p, base, i));
}

}  // namespace

std::string pattern_of(const std::string& place) {
    std::string pattern;
    for (std::size_t i = 0; i < place.size();) {
        const std::size_t end = std::min(place.find('/', i + 1), place.size());
        const std::string part = place.substr(i + 1, end - i - 1);
        const bool index = !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
        pattern += '/';
        pattern += index ? "*" : part;
        i = end;
    }
    return pattern;
}

PropertyGroup properties_of(const Document& document, const std::string& place) {
    const std::string pattern = table_pattern(pattern_of(place));
    const std::string own = pattern == "/cloths/*/render_mesh" ? "/cloths/*/mesh" : pattern;
    const Json* object = find(document.json, place);
    const auto has = [&](std::string_view key) {
        return object && object->is_object() && object->contains(std::string(key));
    };
    PropertyGroup group;
    for (const OneOf& one : alternatives_of_objects())
        if (one.pattern == own) group.one_of = one.keys;
    for (const SceneTable& table : scene_tables()) {
        if (table.place != own || (own == "/air/wind/*" && is_of_another_wind(object, table))) continue;
        const void* defaults = defaults_for(document, place, own, table);
        for (const Parameter& p : table.keys) {
            const bool alternative = std::ranges::find(group.one_of, p.key) != group.one_of.end();
            if (alternative && !has(p.key)) continue;
            const auto companion = std::ranges::find_if(
                companions, [&](const Companion& one) { return one.pattern == own && one.key == p.key; });
            if (companion != std::end(companions) && !has(companion->needs)) continue;
            if (p.kind == ParameterKind::object || p.kind == ParameterKind::list)
                group.children.push_back({&p, p.kind == ParameterKind::list});
            else if ((own == "/cloths/*" && std::ranges::find(seldom_of_cloth, p.key) != std::end(seldom_of_cloth)) ||
                     (own == "/cloths/*/fabric" && p.key == "stiffness"))  // of plain constraints only
                group.seldom.push_back({&p, defaults});
            else
                group.values.push_back({&p, defaults});
        }
    }
    if (own == "/cloths/*") {
        const auto place_of = [](const ChildProperty& child) { return std::ranges::find(first_of_cloth, child.key()); };
        std::ranges::stable_sort(group.children, {}, place_of);
    }
    return group;
}

std::optional<Json> default_of(const Property& property) {
    const Parameter& p = *property.parameter;
    const void* base = property.defaults;
    if (!base || p.required) return {};
    switch (p.kind) {
        case ParameterKind::number:
        case ParameterKind::vector:
        case ParameterKind::integer: {
            if (p.count == 1) return element_json(p, base, 0);
            Json list = Json::array();
            for (std::size_t i = 0; i < p.count; ++i) list.push_back(element_json(p, base, i));
            return list;
        }
        case ParameterKind::angle_or_mesh:
            return std::isnan(element<float>(p, base)) ? Json("mesh") : number(element<float>(p, base));
        case ParameterKind::flag:
            return element<bool>(p, base);
        case ParameterKind::choice:
            return std::string(choice_names(p).at(static_cast<std::size_t>(element<int>(p, base))));
        case ParameterKind::text:
            return text_of(p, base);
        case ParameterKind::object:
        case ParameterKind::list:
            break;
    }
    return {};
}

std::optional<Json> value_of(const Document& document, const std::string& place, const Property& property) {
    const Parameter& p = *property.parameter;
    const Json* object = find(document.json, place);
    const std::string key(p.key);
    // A name stands for an object with that preset.
    if (object && object->is_string() && key == "preset") return *object;
    const Json* value = object && object->is_object() && object->contains(key) ? &(*object)[key] : nullptr;
    if (!value) return default_of(property);
    if (p.kind == ParameterKind::number && p.count > 1 && value->is_number()) {
        Json list = Json::array();  // one number for all
        for (std::size_t i = 0; i < p.count; ++i) list.push_back(*value);
        return list;
    }
    if (p.kind == ParameterKind::choice && p.flag_too && value->is_boolean()) {
        const auto names = choice_names(p);
        return std::string(value->get<bool>() ? names.back() : names.front());
    }
    return *value;
}

std::span<const std::string_view> parts_of(const std::string& place, const Parameter& parameter) {
    const std::string pattern = table_pattern(pattern_of(place));
    for (const Parts& one : parts_of_keys())
        if (one.key == parameter.key && one.names.size() == parameter.count &&
            (one.pattern.empty() || one.pattern == pattern))
            return one.names;
    return {};
}

std::string label_of_key(std::string_view key) {
    std::string label(key);
    std::ranges::replace(label, '_', ' ');
    if (!label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    return label;
}

std::vector<std::string> names_for(const Document& document, const std::string& place, std::string_view key) {
    std::vector<std::string> names;
    const std::string pattern = pattern_of(place);
    if (key == "preset" && pattern == "/cloths/*/fabric") {
        for (const FabricPreset& preset : fabric_presets()) names.emplace_back(preset.name);
        std::ranges::sort(names);
    } else if (key == "preset") {
        for (const MaterialPreset& preset : material_presets()) names.emplace_back(preset.name);
        std::ranges::sort(names);
    } else if (key == "attach") {
        names.emplace_back();
        for (const SceneCollider& collider : document.scene.colliders) names.push_back(collider.name);
    } else if (key == "group") {
        if (const SceneCloth* cloth = cloth_at(document, place))
            for (const VertexGroup& group : cloth->groups) names.push_back(group.name);
    } else if (key == "cloth") {
        for (const SceneCloth& cloth : document.scene.cloths) names.push_back(cloth.name);
    }
    return names;
}

std::vector<std::string_view> motions_of(const Document& document, const std::string& collider) {
    const bool plane = find(document.json, collider + "/plane");
    return plane ? std::vector<std::string_view>{"static", "keys"}
                 : std::vector<std::string_view>{"static", "keys", "dynamic"};
}

std::size_t motion_of(const Document& document, const std::string& collider) {
    if (find(document.json, collider + "/motion/keys")) return 1;
    return find(document.json, collider + "/motion/dynamic") ? 2 : 0;
}

std::vector<Edit> change_motion(const Document& document, const std::string& collider, std::size_t motion) {
    const std::string place = collider + "/motion";
    if (motion == 0) return {{place, {}}};
    if (motion == 1) return {{place, Json{{"keys", Json::array({Json{{"time", 0}}})}}}};
    Json body = Json::object();
    const Json* mesh = find(document.json, collider + "/mesh");
    if (mesh) body["mass"] = 1;
    std::vector<Edit> edits{{place, Json{{"dynamic", body}}}};
    if (mesh && mesh->value("contact", "") == "surface") edits.push_back({collider + "/mesh/contact", {}});
    return edits;
}

std::optional<Json> new_element(const Document& document, const std::string& list) {
    const std::string pattern = pattern_of(list);
    const Json* all = find(document.json, list);
    const auto next_time = [&] { return all && !all->empty() ? all->back().value("time", 0.0) + 1 : 0.0; };
    if (pattern == "/cloths/*/pins") return Json{{"vertices", {0}}};
    if (pattern == "/cloths/*/groups")
        return Json{{"name", "group " + std::to_string(all ? all->size() : 0)}, {"vertices", {0}}};
    if (pattern == "/cloths/*/cuts") return Json{{"plane", {{"normal", {1, 0, 0}}}}};
    if (pattern == "/cloths/*/seams") return Json{{"strength", 100}, {"plane", {{"normal", {1, 0, 0}}}}};
    if (pattern == "/cloths/*/resistance") return Json{{"factor", 0.5}, {"vertices", {0}}};
    if (pattern == "/cloths/*/weights") return Json{{"of", "density"}, {"factor", 2}, {"vertices", {0}}};
    if (pattern == "/air/wind") return Json{{"velocity", {3, 0, 0}}};
    if (pattern.ends_with("/motion") || pattern.ends_with("/keys")) return Json{{"time", next_time()}};
    if (pattern == "/stitches" && !document.scene.cloths.empty()) {
        const auto& cloths = document.scene.cloths;
        return Json{{"a", {{"cloth", cloths.front().name}, {"vertices", {0}}}},
                    {"b", {{"cloth", cloths.back().name}, {"vertices", {1}}}}};
    }
    return {};
}

}  // namespace weft::editor
