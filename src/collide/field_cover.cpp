#include "collide/field_cover.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

using namespace field;

class FieldCover {
  public:
    FieldCover(const FieldGrid& grid, std::span<const std::uint32_t> brick_of, std::span<BrickNodes> nodes)
        : grid_(grid), brick_of_(brick_of), nodes_(nodes) {}

    void cover_all(const SolidSurface& surface) {
        for (Triangle t : surface.triangles()) {
            std::ranges::sort(t);  // whichever way it faces
            const auto& p = surface.positions();
            const Vec3 a = p[t[0]], ab = p[t[1]] - a, ac = p[t[2]] - a;
            const float longest = std::max({length(ab), length(ac), length(ac - ab)});
            const auto parts = static_cast<std::uint32_t>(std::ceil(2 * longest + 1e-6f));
            for (std::uint32_t i = 0; i <= parts; ++i) {
                for (std::uint32_t j = 0; i + j <= parts; ++j) {
                    const float step = 1 / static_cast<float>(parts);
                    cover(a + ab * (step * static_cast<float>(i)) + ac * (step * static_cast<float>(j)));
                }
            }
        }
    }

  private:
    // A node by its number along each axis of the grid; null where no brick has it.
    std::int16_t* node_at(Counts at) {
        for (std::uint32_t k = 0; k < 8; ++k) {
            Counts place, in;
            bool valid = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::uint32_t before = k >> axis & 1;  // as the last node of the place before
                valid = valid && (!before || (at[axis] % side == 0 && at[axis] > 0));
                place[axis] = at[axis] / side - (valid ? before : 0), in[axis] = before ? side : at[axis] % side;
                valid = valid && place[axis] < grid_.places[axis];
            }
            const std::uint32_t brick = valid ? brick_of_[grid_.number(place[0], place[1], place[2])] : none;
            if (brick != none) return &nodes_[brick][node(in[0], in[1], in[2])];
        }
        return nullptr;
    }

    // How far a node may be lowered without making an edge steeper than a distance is.
    std::int16_t lowest_value(Counts at) {
        double most = -largest_short;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const std::uint32_t step : {~0u, 1u}) {
                Counts next = at;
                next[axis] += step;
                const std::int16_t* value = node_at(next);
                if (value) most = std::max(most, static_cast<double>(*value));
            }
        }
        return to_short(most * fine_unit - 1, fine_unit);
    }

    // Lowers the values around a point, most where they count most, until the field there is at most `uncovered`.
    void cover(Vec3 p) {
        constexpr double uncovered = 0.02;  // cells
        const Counts cell{static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y),
                          static_cast<std::uint32_t>(p.z)};
        const double f[] = {double{p.x} - cell[0], double{p.y} - cell[1], double{p.z} - cell[2]};
        std::array<std::int16_t*, 8> nodes{};
        std::array<double, 8> weights{};
        double value = 0, squares = 0;
        bool has_inside = false;
        for (std::uint32_t k = 0; k < 8; ++k) {
            nodes[k] = node_at({cell[0] + k % 2, cell[1] + k / 2 % 2, cell[2] + k / 4});
            if (!nodes[k]) return;
            weights[k] = (k % 2 ? f[0] : 1 - f[0]) * (k / 2 % 2 ? f[1] : 1 - f[1]) * (k / 4 ? f[2] : 1 - f[2]);
            value += weights[k] * *nodes[k];
            squares += weights[k] * weights[k];
            has_inside = has_inside || *nodes[k] < 0;
        }
        const double excess = value - uncovered / fine_unit;
        if (!has_inside || !(excess > 0)) return;
        for (std::uint32_t k = 0; k < 8; ++k) {
            const double lowered = std::floor(*nodes[k] - excess * weights[k] / squares);
            const double least = lowest_value({cell[0] + k % 2, cell[1] + k / 2 % 2, cell[2] + k / 4});
            if (lowered < *nodes[k] && least < *nodes[k])
                *nodes[k] = static_cast<std::int16_t>(std::max({lowered, least, -largest_short}));
        }
    }

    const FieldGrid& grid_;
    std::span<const std::uint32_t> brick_of_;
    std::span<BrickNodes> nodes_;
};

}  // namespace

void cover_surface(const FieldGrid& grid, const SolidSurface& surface, std::span<const std::uint32_t> brick_of,
                   std::span<BrickNodes> nodes) {
    FieldCover(grid, brick_of, nodes).cover_all(surface);
}

}  // namespace weft
