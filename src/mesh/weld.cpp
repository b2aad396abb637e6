#include "mesh/weld.h"

#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

// The last steps of MurmurHash3 (Appleby, public domain): every input bit affects the low bits that the mask keeps.
std::uint64_t scramble(std::uint64_t h) {
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdull;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ull;
    return h ^ (h >> 33);
}

// Odd factors, one per axis, so that permuted coordinates do not collide.
constexpr std::array<std::uint64_t, 3> axis_factor{0x9e3779b97f4a7c15ull, 0xc2b2ae3d27d4eb4full, 0x165667b19e3779f9ull};

std::size_t table_size(std::size_t count) {
    return std::bit_ceil(std::max<std::size_t>(2 * count, 16));
}

Weld weld_equal(std::span<const Vec3> positions) {
    Weld weld;
    weld.vertex_to_welded.reserve(positions.size());
    std::vector<std::uint32_t> slots(table_size(positions.size()), none);
    const std::size_t mask = slots.size() - 1;
    // Adding zero turns -0 into +0; every other value keeps its bits.
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0f)}; };
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
        const Vec3 p = positions[vertex];
        std::size_t slot = scramble(scramble(bits(p.x) | bits(p.y) << 32) + axis_factor[0] * bits(p.z)) & mask;
        while (slots[slot] != none && !(positions[weld.first_vertex[slots[slot]]] == p)) slot = (slot + 1) & mask;
        if (slots[slot] == none) {
            slots[slot] = static_cast<std::uint32_t>(weld.first_vertex.size());
            weld.first_vertex.push_back(vertex);
        }
        weld.vertex_to_welded.push_back(slots[slot]);
    }
    return weld;
}

double squared_distance(Vec3 a, Vec3 b) {
    const double x = double{a.x} - double{b.x}, y = double{a.y} - double{b.y}, z = double{a.z} - double{b.z};
    return x * x + y * y + z * z;
}

// A hash of the cells that kept vertices lie in. Cells are numbered in doubles, so no distance can overflow them. Two
// coordinates at most `distance` apart lie in the same cell or in neighboring cells: up to cell number 2^25 because a
// cell is wider than the distance by far more than the rounding of a double; beyond it because floats there are more
// than `distance` apart unless they are equal.
class CellGrid {
  public:
    CellGrid(std::size_t vertex_count, float distance)
        : inverse_width_(1.0 / (double{distance} * (1 + 0x1p-20))), heads_(table_size(vertex_count), none) {}

    /// Calls `visit(welded)` for every kept vertex in the 27 cells around `p`, and possibly for others, in unspecified
    /// order.
    template <class Visit>
    void visit_near(Vec3 p, Visit visit) const {
        const std::array<double, 3> cell = cell_of(p);
        std::array<std::array<std::uint64_t, 3>, 3> part;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t side = 0; side < 3; ++side)
                part[axis][side] = hash_part(axis, cell[axis] + (double(side) - 1));
        for (const std::uint64_t x : part[0])
            for (const std::uint64_t y : part[1])
                for (const std::uint64_t z : part[2])
                    for (std::uint32_t i = heads_[slot(x + y + z)]; i != none; i = next_[i]) visit(i);
    }

    /// Adds the next welded vertex; they are numbered from 0.
    void add(Vec3 p) {
        const std::array<double, 3> cell = cell_of(p);
        std::uint32_t& head = heads_[slot(hash_part(0, cell[0]) + hash_part(1, cell[1]) + hash_part(2, cell[2]))];
        next_.push_back(head);
        head = static_cast<std::uint32_t>(next_.size() - 1);
    }

  private:
    std::array<double, 3> cell_of(Vec3 p) const {
        return {std::floor(p.x * inverse_width_), std::floor(p.y * inverse_width_), std::floor(p.z * inverse_width_)};
    }
    static std::uint64_t hash_part(std::size_t axis, double cell) {
        return scramble(std::bit_cast<std::uint64_t>(cell + 0.0) * axis_factor[axis]);  // + 0.0: -0 is the same cell
    }
    std::size_t slot(std::uint64_t hash) const { return scramble(hash) & (heads_.size() - 1); }

    double inverse_width_;
    std::vector<std::uint32_t> heads_;
    std::vector<std::uint32_t> next_;
};

Weld weld_near(std::span<const Vec3> positions, float distance) {
    Weld weld;
    weld.vertex_to_welded.reserve(positions.size());
    const double limit = double{distance} * double{distance};
    CellGrid grid(positions.size(), distance);
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
        const Vec3 p = positions[vertex];
        std::uint32_t joined = none;
        grid.visit_near(p, [&](std::uint32_t kept) {
            if (kept < joined && squared_distance(positions[weld.first_vertex[kept]], p) <= limit) joined = kept;
        });
        if (joined == none) {
            joined = static_cast<std::uint32_t>(weld.first_vertex.size());
            weld.first_vertex.push_back(vertex);
            grid.add(p);
        }
        weld.vertex_to_welded.push_back(joined);
    }
    return weld;
}

}  // namespace

Weld weld_vertices(std::span<const Vec3> positions, float distance) {
    assert(distance >= 0);
    return distance > 0 ? weld_near(positions, distance) : weld_equal(positions);
}

}  // namespace weft
