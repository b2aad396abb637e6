#include "io/mesh_checks.h"

#include <exception>
#include <nlohmann/json.hpp>
#include <vector>

namespace weft {
namespace {

using nlohmann::json;

/// A binary file is a header of 12 bytes and chunks, the first of them the JSON text (glTF 2.0 specification, 4.4).
std::string_view json_text(std::string_view content) {
    constexpr std::size_t begin = 20;
    if (!content.starts_with("glTF") || content.size() < begin) return content;
    std::size_t length = 0;
    for (std::size_t b = 4; b-- > 0;) length = length << 8 | static_cast<unsigned char>(content[12 + b]);
    return content.substr(begin, length);
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

}  // namespace

std::optional<std::uint64_t> gltf_triangle_count(std::string_view content) {
    try {
        const json document = json::parse(json_text(content));
        // glTF 1 keeps its meshes by name instead of in a list, and Assimp leaves its indices as they are.
        if (!document.contains("meshes") || !document.at("meshes").is_array()) return std::nullopt;
        return count_triangles(document);
    } catch (const std::exception&) {  // Assimp names the problem
        return std::nullopt;
    }
}

}  // namespace weft
