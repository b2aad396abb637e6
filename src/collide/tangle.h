// Where cloth passes through cloth, and which way leads out: what untangling needs.
#pragma once

#include "collide/crossings.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// An edge that passes through a triangle.
struct TangledPair {
    std::array<std::uint32_t, 5> particle;  ///< the edge's two, the triangle's three
    Vec3 direction;                         ///< unit or shorter: where the edge has to go, relative to the triangle
};

struct Tangle {
    std::vector<TangledPair> pairs;
    /// By particle, the pairs that it is near, ascending: twice the number of the pair, plus 1 if it is near the
    /// triangle. The entries of particle p are `near[first[p]] … near[first[p + 1] - 1]`. Empty without pairs.
    std::vector<std::uint32_t> first, near;

    /// Whether one particle is near the edge of a pair and the other one near its triangle. Features with such
    /// particles have no side.
    bool joins(std::uint32_t p, std::uint32_t q) const;
};

/// What untangling knows of the particles of two cloths.
struct TangleRules {
    CanCross can_cross = {};
    /// Positive: the first particle's cloth belongs in front of the second one's; negative: behind it; 0: no order.
    /// Empty: 0.
    std::function<int(std::uint32_t, std::uint32_t)> order = {};
    /// Whether features with these particles may cross, because a stitch holds them together. Empty: none may.
    std::function<bool(std::uint32_t, std::uint32_t)> tied = {};
};

/// All crossings within one set of triangles (crossings.h). A contour where two cloths intersect moves towards the rim
/// of the smallest part that it cuts off from either of them. A contour without such a part follows the gradient of its
/// length (Volino and Magnenat-Thalmann 2006, "Resolving Surface Collisions through Intersection Contour
/// Minimization"). Between cloths with an order each crossing moves along the normal of the cloth that belongs behind.
/// Deterministic. Expected time O(n log n) for n triangles.
Tangle find_tangle(std::span<const Vec3> positions, std::span<const Triangle> triangles, const TangleRules& rules = {});

}  // namespace weft
