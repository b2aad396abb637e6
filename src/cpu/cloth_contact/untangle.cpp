// Takes apart what passes through each other (law: physics/cloth_contact/cloth_contact.md, "Untangling").
#include "cpu/cloth_contact/cloth_contact.h"
#include "physics/scalar.h"
#include "solver/plan/cloth_contact_numbers.h"

#include <algorithm>
#include <cmath>

namespace weft::cpu {

// Moves edges and triangles that pass through each other, as they were at the start of the substep. The masses of
// particles are split among all pairs in full: neighboring pairs go the same way.
void ClothContact::untangle() {
    if (!tangle_) return;
    struct Passing {
        const TangledPair* pair;
        std::array<float, 5> weight;
    };
    std::vector<Passing> passing;
    const auto at_start = [&](std::uint32_t p) { return scalar::vec3{start_[p].x, start_[p].y, start_[p].z}; };
    for (const TangledPair& pair : tangle_->pairs) {
        const auto& p = pair.particle;
        const scalar::PassingEdge edge = scalar::edge_through_triangle(at_start(p[0]), at_start(p[1]), at_start(p[2]),
                                                                       at_start(p[3]), at_start(p[4]));
        if (!edge.passes) continue;
        passing.push_back({&pair, {edge.w0, edge.w1, edge.w2, edge.w3, edge.w4}});
        for (int k = 0; k < 5; ++k) add_share(pair.particle[k], passing.back().weight[k]);
    }
    for (const auto& [pair, weight] : passing) {
        float resistance = 0;
        Vec3 moved{};
        for (int k = 0; k < 5; ++k) {
            const std::uint32_t p = pair->particle[k];
            resistance += scalar::contact_resistance(x_[p].w, weight[k], share(p));
            moved = moved + (x_[p].xyz() - start_[p].xyz()) * weight[k];
        }
        const float missing = untangling_speed * h_ - dot(moved, pair->direction);
        if (!(missing > 0) || !(resistance > 1e-12f)) continue;
        for (int k = 0; k < 5; ++k) {
            const std::uint32_t p = pair->particle[k];
            add_to_sum(p, pair->direction * (missing / resistance) * (weight[k] * x_[p].w), WEFT_PUSH_QUANTA_PER_METER);
        }
    }
    in_parallel([&](Mine& mine) {
        for_each_particle(mine, [&](std::uint32_t p) {
            if (sums_[p].share == 0) return;
            Vec3 moved = sum(p, WEFT_PUSH_QUANTA_PER_METER);
            sums_[p] = {};
            const float most = untangling_speed * h_, length2 = dot(moved, moved);
            if (length2 > most * most) moved = moved * (most / std::sqrt(length2));
            x_[p] = {x_[p].x + moved.x, x_[p].y + moved.y, x_[p].z + moved.z, x_[p].w};
        });
    });
}

// Features near a pair that passes through each other do so freely. Drops such pairs from number `begin` on.
void ClothContact::drop_pairs_without_side(NearPairs& near, int kind, std::uint32_t begin) const {
    if (!tangle_) return;
    const int side_one = kind == 0 ? 1 : 2;
    std::uint32_t kept = begin;
    for (std::uint32_t i = begin; i < near.count; ++i) {
        bool drop = false;
        for (int a = 0; a < side_one; ++a)
            for (int b = side_one; b < 4; ++b) drop = drop || tangle_->joins(near.particle[a][i], near.particle[b][i]);
        if (drop) continue;
        near.move(i, kept++);
    }
    near.count = kept;
}

}  // namespace weft::cpu
