#include "io/exports/constant_mesh.h"

#include <algorithm>
#include <cstring>
#include <tuple>

namespace weft {
namespace {

/// Unlike ==, also for NaN.
template <class Value>
bool same_bits(const Value& a, const Value& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

ConstantMesh::ConstantMesh(const ExportSurface& first)
    : name_(first.name),
      first_count_(first.positions.size()),
      surface_count_(first_count_),
      topology_version_(first.topology_version),
      triangles_(first.triangles.begin(), first.triangles.end()),
      uvs_(first.uvs.begin(), first.uvs.end()),
      colors_(first.colors.begin(), first.colors.end()),
      rest_positions_(first.rest_positions.begin(), first.rest_positions.end()),
      source_(first_count_),
      corner_count_(first_count_) {
    for (std::uint32_t v = 0; v < first_count_; ++v) source_[v] = v;
    for (const Triangle& triangle : triangles_)
        for (const std::uint32_t vertex : triangle) ++corner_count_[vertex];
}

/// A copy has the rest position, UV and color of its original, so other values belong to another part of the cloth.
bool ConstantMesh::is_same_place(std::uint32_t vertex, const ExportSurface& surface, std::uint32_t source) const {
    return (uvs_.empty() || same_bits(uvs_[vertex], surface.uvs[source])) &&
           (colors_.empty() || same_bits(colors_[vertex], surface.colors[source])) &&
           (rest_positions_.empty() || same_bits(rest_positions_[vertex], surface.rest_positions[source]));
}

std::string ConstantMesh::find_moved(const ExportSurface& surface, std::vector<MovedCorner>& moved) const {
    if (surface.triangles.size() != triangles_.size())
        return "has " + std::to_string(surface.triangles.size()) + " triangles instead of " +
               std::to_string(triangles_.size());
    if (surface.uvs.empty() != uvs_.empty() || surface.colors.empty() != colors_.empty() ||
        surface.rest_positions.empty() != rest_positions_.empty()) {
        return "has other data per vertex";
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        const Triangle &vertices = triangles_[t], &now = surface.triangles[t];
        const bool was_there = is_face({source_[vertices[0]], source_[vertices[1]], source_[vertices[2]]});
        const bool is_there = is_face(now);
        if (is_there && !was_there) return "has triangle " + std::to_string(t) + " again, which was removed";
        if (!was_there) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (is_there && !is_same_place(vertices[k], surface, now[k]))
                return "has triangle " + std::to_string(t) + " at another place of the cloth";
            if (now[k] != source_[vertices[k]]) moved.push_back({vertices[k], now[k], t, k});
        }
    }
    return {};
}

std::string ConstantMesh::follow(const ExportSurface& surface) {
    if (surface.topology_version == topology_version_ && surface.positions.size() == surface_count_ &&
        surface.triangles.size() == triangles_.size()) {
        return {};
    }
    std::vector<MovedCorner> moved;
    if (std::string problem = find_moved(surface, moved); !problem.empty()) return problem;
    part(moved);
    topology_version_ = surface.topology_version;
    surface_count_ = surface.positions.size();
    if (std::ranges::any_of(source_, [&](std::uint32_t source) { return source >= surface_count_; }))
        return "has fewer vertices";
    same_as_surface_ = source_.size() == surface_count_ && std::ranges::equal(triangles_, surface.triangles) &&
                       std::ranges::adjacent_find(source_, std::ranges::greater_equal()) == source_.end();
    return {};
}

/// Corners that share a vertex and a source keep sharing one vertex.
void ConstantMesh::part(std::vector<MovedCorner>& moved) {
    std::ranges::sort(moved, {},
                      [](const MovedCorner& c) { return std::tuple(c.vertex, c.source, c.triangle, c.corner); });
    std::vector<std::span<const MovedCorner>> leaving;
    const std::span<const MovedCorner> all = moved;
    for (std::size_t begin = 0; begin < all.size();) {
        const std::uint32_t vertex = all[begin].vertex;
        std::size_t end = begin;
        while (end < all.size() && all[end].vertex == vertex) ++end;
        bool keeps =
            end - begin == corner_count_[vertex];  // if all corners leave, the first ones take the vertex along
        while (begin < end) {
            const std::size_t from = begin;
            while (begin < end && all[begin].source == all[from].source) ++begin;
            if (keeps) {
                source_[vertex] = all[from].source;
            } else {
                leaving.push_back(all.subspan(from, begin - from));
            }
            keeps = false;
        }
    }
    // By source: then new vertices have the numbers of the surface, as long as each vertex has its own source.
    std::ranges::stable_sort(leaving, {}, [](std::span<const MovedCorner> corners) { return corners.front().source; });
    for (const std::span<const MovedCorner> corners : leaving) append_vertex(corners);
}

void ConstantMesh::append_vertex(std::span<const MovedCorner> corners) {
    const auto vertex = static_cast<std::uint32_t>(source_.size());
    const std::uint32_t parent = corners.front().vertex;
    const auto count = static_cast<std::uint32_t>(corners.size());
    parent_.push_back(parent);
    source_.push_back(corners.front().source);
    corner_count_.push_back(count);
    corner_count_[parent] -= count;
    if (!uvs_.empty()) uvs_.push_back(Vec2(uvs_[parent]));
    if (!colors_.empty()) colors_.push_back(Vec4(colors_[parent]));
    if (!rest_positions_.empty()) rest_positions_.push_back(Vec3(rest_positions_[parent]));
    for (const MovedCorner& c : corners) triangles_[c.triangle][c.corner] = vertex;
}

ExportSurface ConstantMesh::show(const ExportSurface& surface) {
    if (same_as_surface_) return surface;
    positions_.clear();
    normals_.clear();
    for (const std::uint32_t source : source_) {
        positions_.push_back(surface.positions[source]);
        normals_.push_back(surface.normals[source]);
    }
    ExportSurface shown = surface;
    shown.positions = positions_;
    shown.normals = normals_;
    shown.triangles = triangles_;
    shown.uvs = uvs_;
    shown.colors = colors_;
    shown.rest_positions = rest_positions_;
    return shown;
}

std::string ConstantMeshes::follow(const ExportFrame& frame) {
    const std::string which = "frame " + std::to_string(frame.index) + ": ";
    if (meshes_.empty()) {
        for (const ExportSurface& surface : frame.surfaces) meshes_.emplace_back(surface);
    }
    if (frame.surfaces.size() != meshes_.size()) return which + "it does not have the cloths of the first frame";
    surfaces_.clear();
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        if (const std::string problem = meshes_[i].follow(frame.surfaces[i]); !problem.empty()) {
            return which + "cloth \"" + std::string(frame.surfaces[i].name) + "\" " + problem +
                   ", so it is not the cloth of the frames before; write a sequence instead";
        }
        surfaces_.push_back(meshes_[i].show(frame.surfaces[i]));
    }
    return {};
}

bool ConstantMeshes::have_grown() const {
    return std::ranges::any_of(meshes_, [](const ConstantMesh& m) { return m.vertex_count() > m.first_count(); });
}

}  // namespace weft
