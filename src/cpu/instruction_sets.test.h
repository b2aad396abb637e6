// Tests of an instruction set against one lane, from one random state.
#pragma once

#include "base/aligned.h"
#include "cpu/passes.h"
#include "solver/model/random_rows.test.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <string_view>

namespace weft::cpu::instruction_sets {

using namespace random_rows;

struct Fixture : RandomState {
    AlignedVector<Vec4> remainder = {};  ///< ParticleView; empty: not kept

    void keep_remainders() { remainder.assign(position.size(), {1e-9f, -2e-9f, 3e-9f, 0}); }
    ParticleView view() {
        ParticleView view{&position[0].x, &start[0].x, &velocity[0].x, &compensation[0].x};
        if (!remainder.empty()) view.remainder = &remainder[0].x;
        return view;
    }
    RowView rows() { return {table.stride, table.particles.data(), table.fields.data(), lambda.data(), {0.3f, 1.01f}}; }
};

inline Fixture random_state(unsigned seed, bool degenerate) {
    return {random_points(seed, degenerate)};
}

inline void expect_same(const AlignedVector<Vec4>& a, const AlignedVector<Vec4>& b, std::string_view what) {
    for (std::uint32_t p = 0; p < particle_count; ++p) {
        const auto bits = [](const Vec4& v) { return std::bit_cast<std::array<std::uint32_t, 4>>(v); };
        // The bits of a NaN depend on the machine.
        const auto same = [&](float x, float y, int k) {
            return bits(a[p])[k] == bits(b[p])[k] || (std::isnan(x) && std::isnan(y));
        };
        ASSERT_TRUE(same(a[p].x, b[p].x, 0) && same(a[p].y, b[p].y, 1) && same(a[p].z, b[p].z, 2) &&
                    same(a[p].w, b[p].w, 3))
            << what << ", particle " << p << ": " << a[p].x << ' ' << a[p].y << ' ' << a[p].z << " against " << b[p].x
            << ' ' << b[p].y << ' ' << b[p].z;
    }
}

class InstructionSet : public testing::TestWithParam<const Passes*> {
  protected:
    /// Runs `f` on the tested table and on the scalar one, from the same state, and compares.
    template <class F>
    void compare(const Fixture& from, F&& f) {
        Fixture ours = from, theirs = from;
        f(*GetParam(), ours);
        f(scalar_passes(), theirs);
        expect_same(ours.position, theirs.position, "position");
        expect_same(ours.start, theirs.start, "start");
        expect_same(ours.velocity, theirs.velocity, "velocity");
        expect_same(ours.compensation, theirs.compensation, "compensation");
        if (!from.remainder.empty()) expect_same(ours.remainder, theirs.remainder, "remainder");
        for (std::size_t r = 0; r < ours.lambda.size(); ++r) {
            if (!ours.is_row(r % ours.table.stride)) continue;
            ASSERT_TRUE(std::bit_cast<std::uint32_t>(ours.lambda[r]) ==
                            std::bit_cast<std::uint32_t>(theirs.lambda[r]) ||
                        (std::isnan(ours.lambda[r]) && std::isnan(theirs.lambda[r])))
                << "lambda of row " << r % ours.table.stride;
        }
    }
};

inline std::string name_of(const testing::TestParamInfo<const Passes*>& tested) {
    return std::string(tested.param->isa);
}

}  // namespace weft::cpu::instruction_sets
