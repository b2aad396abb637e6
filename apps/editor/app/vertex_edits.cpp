#include "editor/app/vertex_edits.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace weft::editor {
namespace {

const SceneCloth& scene_cloth(const Document& document, const std::string& cloth) {
    return document.scene.cloths.at(std::stoul(cloth.substr(cloth.rfind('/') + 1)));
}

/// The vertices that a pin, a resistance or a weight lists; nullopt: it selects them by box or color.
std::optional<VertexSet> listed(const Json& one, const Document& document, const std::string& cloth) {
    if (one.contains("vertices")) return make_set(one["vertices"].get<std::vector<std::uint32_t>>());
    if (!one.contains("group")) return {};
    const VertexGroup* group = find_group(document, cloth, one["group"].get<std::string>());
    return group ? make_set(group->vertices) : VertexSet{};
}

/// Calls `name` for each pin, resistance and weight that names the group.
void for_users(const Document& document, const std::string& cloth, const std::string& group,
               const std::function<void(const std::string& place)>& name) {
    for (const char* list : {"/pins", "/resistance", "/weights"}) {
        const Json* all = find(document.json, cloth + list);
        for (std::size_t i = 0; all && i < all->size(); ++i)
            if ((*all)[i].value("group", "") == group) name(cloth + list + "/" + std::to_string(i));
    }
}

std::string place_of_group(const Document& document, const std::string& cloth, const std::string& name) {
    const std::vector<std::string> names = group_names(document, cloth);
    return cloth + "/groups/" + std::to_string(std::ranges::find(names, name) - names.begin());
}

}  // namespace

std::vector<Edit> pin_edits(const Document& document, const std::string& cloth, const VertexSet& vertices) {
    for (const VertexGroup& group : scene_cloth(document, cloth).groups)
        if (make_set(group.vertices) == vertices) return {{cloth + "/pins/-", Json{{"group", group.name}}}};
    return {{cloth + "/pins/-", Json{{"vertices", vertices}}}};
}

PinChange changed_pins(const Document& document, const std::string& cloth, const VertexSet& add,
                       const VertexSet& remove) {
    const std::string place = cloth + "/pins";
    const Json* before = find(document.json, place);
    PinChange change;
    Json pins = Json::array();
    for (const Json& pin : before ? *before : Json::array()) {
        const auto vertices = listed(pin, document, cloth);
        if (!vertices) ++change.others;
        const VertexSet left = vertices ? without(*vertices, remove) : VertexSet{};
        if (!vertices || left == *vertices) {
            pins.push_back(pin);
        } else if (!left.empty()) {
            pins.push_back(pin);
            pins.back().erase("group");
            pins.back()["vertices"] = left;
        }
    }
    if (!add.empty()) {
        const auto plain = std::find_if(pins.rbegin(), pins.rend(),
                                        [](const Json& pin) { return pin.size() == 1 && pin.contains("vertices"); });
        if (plain != pins.rend())
            (*plain)["vertices"] = with(make_set((*plain)["vertices"].get<std::vector<std::uint32_t>>()), add);
        else
            pins.push_back(Json{{"vertices", add}});
    }
    if (pins == (before ? *before : Json::array())) return change;
    change.edits = {{place, pins.empty() ? std::nullopt : std::optional<Json>(pins)}};
    return change;
}

VertexSet listed_pins(const Document& document, const std::string& cloth) {
    std::vector<std::uint32_t> all;
    for (const PinDesc& pin : scene_cloth(document, cloth).pins)
        if (const auto* pins = std::get_if<VertexPins>(&pin.select))
            all.insert(all.end(), pins->vertices.begin(), pins->vertices.end());
    return make_set(std::move(all));
}

// --- Groups

std::vector<std::string> group_names(const Document& document, const std::string& cloth) {
    std::vector<std::string> names;
    for (const VertexGroup& group : scene_cloth(document, cloth).groups) names.push_back(group.name);
    return names;
}

const VertexGroup* find_group(const Document& document, const std::string& cloth, std::string_view name) {
    const auto& groups = scene_cloth(document, cloth).groups;
    const auto found = std::ranges::find(groups, name, &VertexGroup::name);
    return found == groups.end() ? nullptr : &*found;
}

std::string free_group_name(const Document& document, const std::string& cloth, const std::string& name) {
    std::string free = name;
    for (int i = 2; find_group(document, cloth, free); ++i) free = name + " " + std::to_string(i);
    return free;
}

std::vector<Edit> group_edits(const Document& document, const std::string& cloth, const std::string& name,
                              const VertexSet& vertices) {
    if (!find_group(document, cloth, name))
        return {{cloth + "/groups/-", Json{{"name", name}, {"vertices", vertices}}}};
    return {{place_of_group(document, cloth, name) + "/vertices", vertices}};
}

std::vector<Edit> group_renaming(const Document& document, const std::string& cloth, const std::string& name,
                                 const std::string& now) {
    std::vector<Edit> edits{{place_of_group(document, cloth, name) + "/name", now}};
    for_users(document, cloth, name, [&](const std::string& place) { edits.push_back({place + "/group", now}); });
    return edits;
}

std::vector<Edit> group_removal(const Document& document, const std::string& cloth, const std::string& name) {
    std::vector<Edit> edits;
    const VertexGroup* group = find_group(document, cloth, name);
    if (!group) return edits;
    for_users(document, cloth, name, [&](const std::string& place) {
        edits.push_back({place + "/group", {}});
        edits.push_back({place + "/vertices", group->vertices});
    });
    const std::string place = cloth + "/groups";
    if (group_names(document, cloth).size() == 1)
        edits.push_back({place, {}});
    else
        edits.push_back({place_of_group(document, cloth, name), {}});
    return edits;
}

}  // namespace weft::editor
