// Random points and constraints, ordinary and degenerate, to compare backends.
#pragma once

#include "base/aligned.h"
#include "solver/model/constraint_table.h"
#include "solver/model/lines.h"

#include <weft/vector.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace weft {

namespace random_rows {

inline constexpr std::uint32_t particle_count = 400;
struct RandomState {
    AlignedVector<Vec4> position, start, velocity, compensation;
    ConstraintTable table;
    AlignedVector<float> lambda;

    // Unlike ConstraintTable::is_real(), includes constraints outside lines that name a particle twice.
    bool is_row(std::size_t r) const {
        return std::ranges::any_of(table.batches, [&](const Batch& batch) {
            if (batch.blocks > 0) return table.is_real(static_cast<std::uint32_t>(r));
            return r >= batch.begin && r < batch.begin + batch.rows;
        });
    }
};

class Numbers {
  public:
    explicit Numbers(unsigned seed) : engine_(seed) {}
    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(static_cast<double>(engine_()) / 4294967296.0);
    }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }

  private:
    std::mt19937 engine_;
};

// `degenerate`: coincident points, zero weights, huge and tiny coordinates, negative and enormous compliances.
inline RandomState random_points(unsigned seed, bool degenerate) {
    Numbers random(seed);
    RandomState f;
    const std::uint32_t capacity = particle_capacity(particle_count);
    for (auto* array : {&f.position, &f.start, &f.velocity, &f.compensation}) array->assign(capacity, Vec4{});
    const auto scale = [&] {
        return degenerate && random.below(4) == 0 ? std::pow(10.0f, random.uniform(-20, 12)) : 1.0f;
    };
    for (std::uint32_t p = 0; p < particle_count; ++p) {
        const float s = scale();
        f.position[p] = {random.uniform(-s, s), random.uniform(-s, s), random.uniform(-s, s), random.uniform(0, 50)};
        f.start[p] = {f.position[p].x + random.uniform(-0.01f, 0.01f), f.position[p].y, f.position[p].z, 1e-8f};
        f.velocity[p] = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3), -1e-8f};
        f.compensation[p] = {1e-9f, -1e-9f, 1e-10f, 1e-9f};
        if (random.below(10) == 0) f.position[p].w = 0;
        if (degenerate && random.below(5) == 0 && p > 0) f.position[p] = f.position[p - 1];
    }
    return f;
}

// How much longer an edge is when its threads are straight: some are, some are not, and some never will be.
inline float random_play(Numbers& random) {
    return random.below(3) == 0 ? static_cast<float>(WEFT_NEVER_STRAIGHT) : random.uniform(0, 1);
}

inline void add_rows(RandomState& f, ConstraintKind kind, unsigned seed, bool degenerate) {
    Numbers random(seed);
    RowList rows = make_rows(kind);
    for (int r = 0; r < 300; ++r) {
        std::vector<std::uint32_t> chosen;
        while (chosen.size() < rows.arity) {
            // Particles that a constraint only reads are anchors, which no constraint of the kind moves.
            constexpr std::uint32_t anchors = 40;
            const bool moved = chosen.size() < constraint_info(kind).moved;
            const std::uint32_t p = moved ? anchors + random.below(particle_count - anchors) : random.below(anchors);
            if (std::find(chosen.begin(), chosen.end(), p) == chosen.end()) chosen.push_back(p);
        }
        if (r % 9 == 0 && rows.arity == constraint_info(kind).moved) chosen.front() = chosen.back();
        rows.particles.insert(rows.particles.end(), chosen.begin(), chosen.end());
        for (std::uint32_t k = 0; k < rows.field_count; ++k) {
            float value = random.uniform(0, k == 0 ? 1.0f : 1e-3f);
            if (kind == ConstraintKind::stretch && k == 3) value = random_play(random);
            if (degenerate && random.below(4) == 0)
                value = random.below(2) ? -1.0f : std::pow(10.0f, random.uniform(-30, 30));
            rows.fields.push_back(value);
        }
    }
    if (kind == ConstraintKind::moment) {
        for (std::size_t i = 0; i < coupled_rows * std::size_t{rows.size()}; ++i)
            rows.coupled.push_back(random.below(5) == 0 ? no_particle : random.below(rows.size()));
        for (std::size_t i = 0; i < coupled_numbers * std::size_t{rows.size()}; ++i)
            rows.coupling.push_back(random.uniform(0, 1e-3f));
    }
    f.table = pack_rows(kind, rows, particle_count);
    f.lambda.assign(std::size_t{constraint_info(kind).lambdas} * f.table.stride, 0.25f);
}

// Shuffled particles in a ring and in lines of all lengths, and cross links that need additional batches.
struct Chains {
    RowList rows = make_rows(ConstraintKind::stretch);
    std::vector<Vec3> at_rest = std::vector<Vec3>(particle_count);

    void link(std::uint32_t a, std::uint32_t b, Numbers& random) {
        if (random.below(2)) std::swap(a, b);
        rows.particles.insert(rows.particles.end(), {a, b});
    }
    explicit Chains(Numbers& random) {
        std::vector<std::uint32_t> order(particle_count);
        std::iota(order.begin(), order.end(), 0);
        for (std::uint32_t p = 1; p < particle_count; ++p) std::swap(order[p], order[random.below(p + 1)]);
        constexpr std::uint32_t ring = 24;
        for (std::uint32_t i = 0; i < ring; ++i) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / ring;
            at_rest[order[i]] = {std::cos(angle), std::sin(angle), 0};
            link(order[i], order[(i + 1) % ring], random);
        }
        std::uint32_t first = ring;
        for (std::uint32_t line = 0; first + 1 < particle_count; ++line) {
            const std::uint32_t most = line == 0 ? longest_line : 1 + random.below(line % 8 == 0 ? longest_line : 9);
            const std::uint32_t length = std::min(most, particle_count - 1 - first);
            for (std::uint32_t k = 0; k <= length; ++k) {
                at_rest[order[first + k]] = {static_cast<float>(k), 0, static_cast<float>(2 * line)};
                if (k > 0) link(order[first + k - 1], order[first + k], random);
            }
            first += length + 1;
        }
        for (int i = 0; i < 60; ++i) {
            const std::uint32_t a = random.below(particle_count), b = random.below(particle_count);
            if (a != b) link(a, b, random);
        }
    }
    ConstraintTable pack() const { return pack_lines(rows, at_rest, particle_count); }
};

inline void add_lines(RandomState& f, unsigned seed, bool degenerate) {
    Numbers random(seed);
    Chains chains(random);
    const auto odd = [&] { return degenerate && random.below(4) == 0; };
    const auto rest = [&] { return odd() ? std::pow(10.0f, random.uniform(-20, 12)) : random.uniform(0, 1); };
    const auto compliance = [&] {
        if (odd()) return std::pow(10.0f, random.uniform(-30, 30));
        return random.below(4) == 0 ? -1.0f : random.below(4) == 0 ? 0.0f : random.uniform(0, 1e-3f);
    };
    for (std::uint32_t r = 0; r < chains.rows.size(); ++r) {
        Vec4 &a = f.position[chains.rows.particles[2 * r]], &b = f.position[chains.rows.particles[2 * r + 1]];
        if (random.below(12) == 0) a.w = b.w = 0;
        if (random.below(12) == 0) b = {a.x, a.y, a.z, b.w};
        const float at_rest = rest(), pulled = compliance(), pushed = compliance();
        chains.rows.fields.insert(chains.rows.fields.end(), {at_rest, pulled, pushed, random_play(random)});
    }
    f.table = chains.pack();
    f.lambda.assign(f.table.lambda_count(), 0.25f);
}

}  // namespace random_rows
}  // namespace weft
