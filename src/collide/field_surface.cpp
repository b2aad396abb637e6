#include "collide/field_surface.h"

#include "collide/field_grid.h"
#include "physics/scalar.h"

#include <array>
#include <bit>
#include <unordered_map>
#include <utility>
#include <vector>

namespace weft {
namespace {

using field::Counts;
using field::FieldGrid;

/// Reads the header and the table of a field (mesh.kernel.h).
class FieldReader {
  public:
    explicit FieldReader(const ShapeData& data) : data_(data) {
        const auto& words = data.words;
        grid_.origin = {words[0], words[1], words[2]};
        for (std::size_t k = 0; k < 3; ++k) grid_.places[k] = static_cast<std::uint32_t>(words[4 + k]);
        grid_.cell = words[7];
        table_ = static_cast<std::size_t>(words[8]);
    }

    const FieldGrid& grid() const { return grid_; }
    bool has_brick(std::uint32_t place) const { return data_.words[table_ + place] > 0; }

    float distance(Vec3 p) const {
        scalar::vec3 normal;
        return scalar::distance_mesh({p.x, p.y, p.z}, {0, 0, 0, 0, data_.blocks()}, normal);
    }

  private:
    const ShapeData& data_;
    FieldGrid grid_;
    std::size_t table_ = 0;
};

/// A corner of a block of cells, in blocks from the grid's corner.
std::uint64_t key_of(Counts node) {
    constexpr std::uint64_t along = 1 << 14;  // more than a grid has
    return node[0] + along * (node[1] + along * node[2]);
}

/// Corners of a block are numbered x + 2 y + 4 z. A tetrahedron goes from corner 0 along the axes, one after the other,
/// to corner 7. So neighboring blocks divide the square between them in the same way. Positively oriented.
constexpr std::array<std::array<std::uint32_t, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

/// Corners of a positively oriented tetrahedron in an order that keeps its orientation, such that the corners of the
/// bit mask come first.
constexpr std::array<std::array<std::uint8_t, 4>, 16> corners_first{{{0, 1, 2, 3},
                                                                     {0, 1, 2, 3},
                                                                     {1, 0, 3, 2},
                                                                     {0, 1, 2, 3},
                                                                     {2, 0, 1, 3},
                                                                     {0, 2, 3, 1},
                                                                     {1, 2, 0, 3},
                                                                     {0, 1, 2, 3},
                                                                     {3, 0, 2, 1},
                                                                     {0, 3, 1, 2},
                                                                     {1, 3, 2, 0},
                                                                     {0, 3, 1, 2},
                                                                     {2, 3, 0, 1},
                                                                     {0, 2, 3, 1},
                                                                     {1, 3, 2, 0},
                                                                     {0, 1, 2, 3}}};

class SurfaceMaker {
  public:
    /// `stride`: cells along a block; divides the side of a brick.
    SurfaceMaker(const FieldReader& field, std::uint32_t stride) : field_(field), stride_(stride) {}

    /// Places without a brick have no zero: build_distance_field() gives them one where their corners differ.
    TriangleMesh make() {
        for (std::uint32_t place = 0; place < field_.grid().count(); ++place)
            if (field_.has_brick(place)) for_each_block(place, [&](Counts block) { add_block(block); });
        add_normals();
        return std::move(mesh_);
    }

    /// Number of blocks that contain zero.
    std::size_t count() {
        std::size_t found = 0;
        for (std::uint32_t place = 0; place < field_.grid().count(); ++place)
            if (field_.has_brick(place)) for_each_block(place, [&](Counts block) { found += contains_zero(block); });
        return found;
    }

  private:
    static constexpr std::uint32_t longest_side = field::nodes_side;

    Vec3 place_of(Counts node) const {
        const auto cells = [&](std::uint32_t n) { return static_cast<float>(n * stride_); };
        return field_.grid().to_meters({cells(node[0]), cells(node[1]), cells(node[2])});
    }
    static Counts corner_of(Counts block, std::uint32_t corner) {
        return {block[0] + corner % 2, block[1] + corner / 2 % 2, block[2] + corner / 4};
    }

    // Reads the distances at the corners of all blocks of a place, then visits them.
    template <class Visit>
    void for_each_block(std::uint32_t place, Visit&& visit) {
        const std::uint32_t side = field::side / stride_;
        const auto [px, py, pz] = field_.grid().at(place);
        first_ = {px * side, py * side, pz * side};
        for (std::uint32_t z = 0; z <= side; ++z)
            for (std::uint32_t y = 0; y <= side; ++y)
                for (std::uint32_t x = 0; x <= side; ++x)
                    distances_[field::node(x, y, z)] =
                        field_.distance(place_of({first_[0] + x, first_[1] + y, first_[2] + z}));
        for (std::uint32_t z = 0; z < side; ++z)
            for (std::uint32_t y = 0; y < side; ++y)
                for (std::uint32_t x = 0; x < side; ++x) visit({first_[0] + x, first_[1] + y, first_[2] + z});
    }
    float distance_at(Counts node) const {
        return distances_[field::node(node[0] - first_[0], node[1] - first_[1], node[2] - first_[2])];
    }
    bool contains_zero(Counts block) const {
        std::uint32_t inside = 0;
        for (std::uint32_t corner = 0; corner < 8; ++corner) inside += distance_at(corner_of(block, corner)) < 0;
        return inside > 0 && inside < 8;
    }

    void add_block(Counts block) {
        if (!contains_zero(block)) return;
        for (const auto& corners : tetrahedra) {
            std::uint32_t inside = 0;
            for (std::uint32_t k = 0; k < 4; ++k)
                inside |= distance_at(corner_of(block, corners[k])) < 0 ? 1u << k : 0u;
            if (inside == 0 || inside == 15) continue;
            const auto& order = corners_first[inside];
            const auto vertex = [&](std::uint32_t from, std::uint32_t to) {
                return vertex_between(block, corners[order[from]], corners[order[to]]);
            };
            switch (std::popcount(inside)) {
                case 1:
                    add_triangle(vertex(0, 1), vertex(0, 2), vertex(0, 3));
                    break;
                case 2: {
                    const std::uint32_t a = vertex(0, 2), b = vertex(0, 3), c = vertex(1, 3), d = vertex(1, 2);
                    add_triangle(a, b, c);
                    add_triangle(a, c, d);
                    break;
                }
                default:
                    add_triangle(vertex(0, 3), vertex(1, 3), vertex(2, 3));
            }
        }
    }

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
    }

    // The point between two corners of a block where the field is zero. Blocks share it.
    std::uint32_t vertex_between(Counts block, std::uint32_t inside, std::uint32_t outside) {
        const Counts in = corner_of(block, inside), out = corner_of(block, outside);
        // An edge leads from its lower corner along some of the axes; none: the zero is the corner itself.
        const bool is_corner = distance_at(out) == 0;
        const Counts low = is_corner ? out : corner_of(block, inside & outside);
        const std::uint64_t key = 8 * key_of(low) + (is_corner ? 0 : inside ^ outside);
        const auto [known, added] = vertices_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (added) mesh_.positions.push_back(is_corner ? place_of(out) : zero_between(place_of(in), place_of(out)));
        return known->second;
    }

    Vec3 zero_between(Vec3 inside, Vec3 outside) const {
        constexpr int halvings = 16;  // to 1/65536 of the edge
        for (int i = 0; i < halvings; ++i) {
            const Vec3 middle = (inside + outside) * 0.5f;
            (field_.distance(middle) < 0 ? inside : outside) = middle;
        }
        return (inside + outside) * 0.5f;
    }

    // Means of the triangles, weighted by area.
    void add_normals() {
        mesh_.normals.assign(mesh_.positions.size(), {});
        for (const auto& [a, b, c] : mesh_.triangles) {
            const auto& x = mesh_.positions;
            const Vec3 normal = cross(x[b] - x[a], x[c] - x[a]);
            for (const std::uint32_t v : {a, b, c}) mesh_.normals[v] = mesh_.normals[v] + normal;
        }
        for (Vec3& normal : mesh_.normals) normal = normalized(normal);
    }

    const FieldReader& field_;
    const std::uint32_t stride_;
    Counts first_{};  // the first block of the place that is visited
    std::array<float, longest_side * longest_side * longest_side> distances_{};
    std::unordered_map<std::uint64_t, std::uint32_t> vertices_;
    TriangleMesh mesh_;
};

}  // namespace

float cell_of_field(const ShapeData& data) {
    return data.words.size() >= 8 ? data.words[7] : 0;
}

TriangleMesh zero_surface_of_field(const ShapeData& data, std::uint32_t most_cells) {
    const FieldReader field(data);
    std::uint32_t stride = 1;
    while (stride < field::side && SurfaceMaker(field, stride).count() > most_cells) stride *= 2;
    return SurfaceMaker(field, stride).make();
}

}  // namespace weft
