#include "io/meshes/mesh_checks.h"
#include "io/meshes/node_tree.h"

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace weft {
namespace {

using nlohmann::json;

/// A binary file is a header of 12 bytes and chunks, the first of them the JSON text (glTF 2.0 specification, 4.4).
constexpr std::size_t text_begin = 20;

bool is_binary(std::string_view content) {
    return content.starts_with("glTF") && content.size() >= text_begin;
}

/// The size that the file states.
std::size_t text_size(std::string_view content) {
    std::size_t size = 0;
    for (std::size_t b = 4; b-- > 0;) size = size << 8 | static_cast<unsigned char>(content[12 + b]);
    return size;
}

std::string_view json_text(std::string_view content) {
    return is_binary(content) ? content.substr(text_begin, text_size(content)) : content;
}

std::uint64_t triangles_of(const json& primitive, const json& accessors) {
    enum Mode { triangles = 4, strip = 5, fan = 6 };
    const auto accessor = primitive.contains("indices") ? primitive.at("indices").get<std::size_t>()
                                                        : primitive.at("attributes").at("POSITION").get<std::size_t>();
    const auto count = accessors.at(accessor).at("count").get<std::uint64_t>();
    switch (primitive.value("mode", 4)) {
        case triangles:
            return count / 3;
        case strip:
        case fan:
            return count < 3 ? 0 : count - 2;
        default:
            return 0;
    }
}

std::uint64_t count_triangles(const json& document) {
    const json& nodes = document.at("nodes");
    const json& meshes = document.at("meshes");
    std::vector<std::size_t> open;
    for (const json& root : document.at("scenes").at(document.value("scene", std::size_t{0})).at("nodes")) {
        open.push_back(root.get<std::size_t>());
    }
    std::vector<bool> seen(nodes.size(), false);
    std::uint64_t total = 0;
    while (!open.empty()) {
        const std::size_t index = open.back();
        open.pop_back();
        const json& node = nodes.at(index);
        if (seen[index]) continue;
        seen[index] = true;
        if (node.contains("mesh")) {
            for (const json& primitive : meshes.at(node.at("mesh").get<std::size_t>()).at("primitives")) {
                total += triangles_of(primitive, document.at("accessors"));
            }
        }
        if (!node.contains("children")) continue;
        for (const json& child : node.at("children")) open.push_back(child.get<std::size_t>());
    }
    return total;
}

std::size_t deepest_bracket(std::string_view text) {
    std::size_t depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') ++i;
        if (c == '"') in_string = !in_string;
        if (in_string) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if ((c == ']' || c == '}') && depth > 0) --depth;
    }
    return deepest;
}

/// By number, or by name as in glTF 1.
const json* element(const json& all, const json& which) {
    if (all.is_array() && which.is_number_unsigned() && which < all.size()) return &all[which.get<std::size_t>()];
    if (!all.is_object() || !which.is_string()) return nullptr;
    const auto found = all.find(which.get_ref<const std::string&>());
    return found == all.end() ? nullptr : &*found;
}

std::vector<const json*> elements(const json& all, const json& owner, const char* key) {
    std::vector<const json*> found;
    const auto list = owner.is_object() ? owner.find(key) : owner.end();
    if (list == owner.end() || !list->is_array()) return found;
    for (const json& which : *list)
        if (const json* one = element(all, which)) found.push_back(one);
    return found;
}

}  // namespace

std::string problem_of_gltf(std::string_view content) {
    if (is_binary(content) && text_size(content) > content.size() - text_begin)  // Assimp would allocate that
        return "is cut short: its text ends at byte " + std::to_string(text_begin + text_size(content)) + " of " +
               std::to_string(content.size());
    const std::string_view text = json_text(content);
    if (deepest_bracket(text) > deepest_nesting)
        return "has brackets nested more than " + std::to_string(deepest_nesting) + " deep";
    const json document = json::parse(text, nullptr, false);
    if (!document.is_object() || !document.contains("nodes") || !document.contains("scenes")) return {};
    const json& nodes = document["nodes"];
    std::vector<const json*> roots;
    for (const json& scene : document["scenes"]) {
        const auto of_scene = elements(nodes, scene, "nodes");
        roots.insert(roots.end(), of_scene.begin(), of_scene.end());
    }
    return problem_of_tree(roots, roots.size() + nodes.size(),
                           [&](const json* node) { return elements(nodes, *node, "children"); });
}

std::optional<std::uint64_t> gltf_triangle_count(std::string_view content) {
    try {
        const json document = json::parse(json_text(content));
        // glTF 1 stores its meshes by name, not in a list; Assimp does not change its indices.
        if (!document.contains("meshes") || !document.at("meshes").is_array()) return std::nullopt;
        return count_triangles(document);
    } catch (const std::exception&) {  // Assimp reports the problem
        return std::nullopt;
    }
}

}  // namespace weft
