#include "collide/tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

EdgeKey key_of(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

// Spreads the lower 21 bits of `v` to every third bit.
std::uint64_t every_third_bit(std::uint64_t v) {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    v = (v | v << 2) & 0x1249249249249249;
    return v;
}

bool is_whole(Triangle t) {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

// The indices of the points, ordered along a space-filling curve.
std::vector<std::uint32_t> sort_along_curve(std::span<const Vec3> points) {
    Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (const Vec3 p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const float extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-30f});
    const auto cell = [&](float v) { return static_cast<std::uint64_t>(v / extent * 0x1fffff); };
    std::vector<std::uint64_t> codes;
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const Vec3 p = points[i] - low;
        codes.push_back(every_third_bit(cell(p.x)) | every_third_bit(cell(p.y)) << 1 | every_third_bit(cell(p.z)) << 2);
        order.push_back(i);
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return codes[i]; });
    return order;
}

std::vector<std::uint32_t> along_curve(TriangleView triangles, std::span<const Vec4> positions) {
    std::vector<Vec3> centroids;
    for (const Triangle t : triangles)
        centroids.push_back((positions[t[0]].xyz() + positions[t[1]].xyz() + positions[t[2]].xyz()) * (1.0f / 3));
    std::vector<std::uint32_t> order = sort_along_curve(centroids);
    std::erase_if(order, [&](std::uint32_t t) { return !is_whole(triangles[t]); });
    return order;
}

// Collects triangles until the tile is full.
class TileBuilder {
  public:
    TileBuilder(TriangleView triangles, std::size_t particles) : mark_(particles, 0), owned_(particles, false) {
        for (const Triangle t : triangles) {
            for (int k = 0; k < 3 && is_whole(t); ++k) edges_.push_back(key_of(t[k], t[(k + 1) % 3]));
        }
        std::ranges::sort(edges_);
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
        edge_owned_.resize(edges_.size());
    }

    bool has_room_for(Triangle t) const {
        std::size_t vertices = vertices_.size(), edges = tile_edges_.size();
        for (int k = 0; k < 3; ++k) {
            vertices += mark_[t[k]] != number_;
            edges += !edge_owned_[place_of(key_of(t[k], t[(k + 1) % 3]))];
        }
        return triangles_.size() < tile_triangles && vertices <= tile_vertices && edges <= tile_edges;
    }

    void add(Triangle t) {
        triangles_.push_back(t);
        for (int k = 0; k < 3; ++k) {
            if (mark_[t[k]] != number_) mark_[t[k]] = number_, vertices_.push_back(t[k]);
            const EdgeKey edge = key_of(t[k], t[(k + 1) % 3]);
            if (edge_owned_[place_of(edge)]) continue;
            edge_owned_[place_of(edge)] = true;
            tile_edges_.push_back(edge);
        }
    }

    Tile finish() {
        Tile tile;
        std::ranges::sort(vertices_);
        const auto others =
            std::stable_partition(vertices_.begin(), vertices_.end(), [&](std::uint32_t p) { return !owned_[p]; });
        tile.own_vertices = static_cast<std::uint32_t>(others - vertices_.begin());
        for (std::uint32_t i = 0; i < tile.own_vertices; ++i) owned_[vertices_[i]] = true;
        tile.vertex_count = static_cast<std::uint32_t>(vertices_.size());
        tile.particle.fill(vertices_.front());
        std::ranges::copy(vertices_, tile.particle.begin());
        const auto local = [&](std::uint32_t p) {
            return static_cast<std::uint32_t>(std::ranges::find(vertices_, p) - vertices_.begin());
        };
        for (const EdgeKey& edge : tile_edges_) {
            tile.edge[0][tile.edge_count] = local(edge.first);
            tile.edge[1][tile.edge_count++] = local(edge.second);
        }
        for (const Triangle& t : triangles_) {
            for (int k = 0; k < 3; ++k) tile.triangle[k][tile.triangle_count] = local(t[k]);
            ++tile.triangle_count;
        }
        vertices_.clear(), tile_edges_.clear(), triangles_.clear();
        ++number_;
        return tile;
    }

    bool is_empty() const { return triangles_.empty(); }

  private:
    std::size_t place_of(EdgeKey edge) const {
        return static_cast<std::size_t>(std::ranges::lower_bound(edges_, edge) - edges_.begin());
    }

    std::uint32_t number_ = 1;         // of the tile that is being built
    std::vector<std::uint32_t> mark_;  // by particle: the last tile that uses it
    std::vector<bool> owned_, edge_owned_;
    std::vector<EdgeKey> edges_;  // of the mesh, sorted
    std::vector<std::uint32_t> vertices_;
    std::vector<EdgeKey> tile_edges_;
    std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<Tile> make_tiles(TriangleView triangles, std::span<const Vec4> positions) {
    std::vector<Tile> tiles;
    TileBuilder builder(triangles, positions.size());
    for (const std::uint32_t t : along_curve(triangles, positions)) {
        if (!builder.has_room_for(triangles[t])) tiles.push_back(builder.finish());
        builder.add(triangles[t]);
    }
    if (!builder.is_empty()) tiles.push_back(builder.finish());
    return tiles;
}

std::vector<std::uint32_t> order_along_curve(std::span<const Vec4> particles) {
    std::vector<Vec3> places;
    for (const Vec4& x : particles) places.push_back(x.xyz());
    return sort_along_curve(places);
}

}  // namespace weft
