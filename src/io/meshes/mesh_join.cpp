#include "io/meshes/mesh_join.h"

#include <array>
#include <bit>
#include <numeric>
#include <vector>

namespace weft {
namespace {

using Key = std::array<std::uint32_t, 13>;

/// Open addressing: allocating a hash node per corner would cost more than reading the file.
class KeyTable {
  public:
    explicit KeyTable(std::size_t count) : slots_(std::bit_ceil(2 * count + 1), none) { keys_.reserve(count); }

    /// The number of this key; numbers count up from 0 in the order of first appearance.
    std::uint32_t number_of(const Key& key) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t slot = hash(key) & mask;
        while (slots_[slot] != none && keys_[slots_[slot]] != key) slot = (slot + 1) & mask;
        if (slots_[slot] == none) {
            slots_[slot] = static_cast<std::uint32_t>(keys_.size());
            keys_.push_back(key);
        }
        return slots_[slot];
    }

  private:
    static std::size_t hash(const Key& key) {
        std::uint64_t h = 0;
        for (std::uint32_t word : key) {
            h = (h ^ word) * 0x9e3779b97f4a7c15ull;  // Fibonacci hashing, Knuth vol. 3, 6.4
            h ^= h >> 29;
        }
        return static_cast<std::size_t>(h);
    }

    std::vector<std::uint32_t> slots_;
    std::vector<Key> keys_;
};

// Adding 0 turns -0 into 0, so that equal values have equal bits.
std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value + 0.0f);
}

Key key_of(const TriangleMesh& mesh, std::uint32_t vertex, std::uint32_t source) {
    const Vec3 p = mesh.positions[vertex];
    const Vec2 uv = mesh.uvs.empty() ? Vec2{} : mesh.uvs[vertex];
    const Vec3 n = mesh.normals.empty() ? Vec3{} : mesh.normals[vertex];
    const Vec4 c = mesh.colors.empty() ? Vec4{} : mesh.colors[vertex];
    return {source,    bits(p.x), bits(p.y), bits(p.z), bits(uv.x), bits(uv.y), bits(n.x),
            bits(n.y), bits(n.z), bits(c.x), bits(c.y), bits(c.z),  bits(c.w)};
}

/// Takes the vertices of `mesh` in `order` and drops those that equal an earlier one with the same `source`.
TriangleMesh joined(const TriangleMesh& mesh, std::span<const std::uint32_t> order,
                    std::span<const std::uint32_t> source) {
    TriangleMesh result;
    KeyTable table(order.size());
    std::vector<std::uint32_t> new_number(order.size());
    for (std::uint32_t vertex : order) {
        const std::uint32_t number = table.number_of(key_of(mesh, vertex, source.empty() ? 0 : source[vertex]));
        new_number[vertex] = number;
        if (number < result.positions.size()) continue;
        result.positions.push_back(mesh.positions[vertex]);
        if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[vertex]);
        if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[vertex]);
        if (!mesh.colors.empty()) result.colors.push_back(mesh.colors[vertex]);
    }
    result.triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        result.triangles.push_back({new_number[t[0]], new_number[t[1]], new_number[t[2]]});
    }
    return result;
}

/// Vertices sorted by their source point; vertices of one point keep their order.
std::vector<std::uint32_t> counting_sort(std::span<const std::uint32_t> source, std::size_t point_count) {
    std::vector<std::uint32_t> next(point_count + 1, 0);
    for (std::uint32_t point : source) ++next[point + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint32_t> order(source.size());
    for (std::uint32_t vertex = 0; vertex < source.size(); ++vertex) order[next[source[vertex]]++] = vertex;
    return order;
}

}  // namespace

TriangleMesh joined(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    return joined(mesh, order, {});
}

TriangleMesh in_source_order(const TriangleMesh& mesh, std::span<const std::uint32_t> source,
                             std::span<const Vec3> positions, std::span<const Vec4> colors) {
    TriangleMesh all = mesh;
    std::vector<std::uint32_t> all_source(source.begin(), source.end());
    std::vector<bool> used(positions.size(), false);
    for (std::uint32_t point : source) used[point] = true;
    for (std::uint32_t point = 0; point < positions.size(); ++point) {
        if (!used[point]) all_source.push_back(point);
    }
    all.positions.clear();
    all.colors.clear();
    for (std::uint32_t point : all_source) {
        all.positions.push_back(positions[point]);
        if (!colors.empty()) all.colors.push_back(colors[point]);
    }
    if (!all.uvs.empty()) all.uvs.resize(all_source.size());
    if (!all.normals.empty()) all.normals.resize(all_source.size(), {0, 1, 0});
    return joined(all, counting_sort(all_source, positions.size()), all_source);
}

}  // namespace weft
