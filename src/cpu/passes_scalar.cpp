#include "cpu/passes.h"

#include "physics/scalar.h"

#include <algorithm>
#include <array>

namespace weft::cpu {
namespace {

// Adds in the same order as the SIMD loops.
scalar::vec3 sum_of_one(const AroundView& around, const float* blocks, std::size_t particle) {
    scalar::vec3 sum(0.0f);
    const auto add = [&](std::uint32_t triangle) {
        const float* block = blocks + std::size_t{4} * triangle;
        sum = sum + scalar::vec3(block[0], block[1], block[2]);
    };
    const std::size_t packet = particle / lane_padding, lane = particle % lane_padding;
    const std::uint32_t begin = around.begin[packet], end = around.begin[packet + 1];
    for (std::size_t k = begin; k < end; ++k) add(around.triangles[k * lane_padding + lane]);
    if (begin < end) return sum;
    const std::uint32_t* list = around.offsets + around.own[packet] + lane;
    for (std::uint32_t k = list[0]; k < list[1]; ++k) add(around.items[k]);
    return sum;
}

// Wraps around beyond 32 bits, as on the GPU.
scalar::vec3 fixed_sum(const GatherView& gather, std::uint32_t begin, std::uint32_t end) {
    std::array<std::uint32_t, 3> sum{};
    for (std::uint32_t k = begin; k < end; ++k) {
        const float* c = gather.blocks + std::size_t{4} * gather.items[k];
        for (int axis = 0; axis < 3; ++axis)
            sum[axis] += static_cast<std::uint32_t>(static_cast<std::int32_t>(scalar::to_quanta(c[axis])));
    }
    const auto meters = [&](int axis) {
        return scalar::from_quanta(static_cast<float>(static_cast<std::int32_t>(sum[axis])));
    };
    return {meters(0), meters(1), meters(2)};
}

}  // namespace

void normals_pass(const SurfaceView& s, Range range) {
    using namespace scalar;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        store_blocks(unit_normal(sum_of_one(s.around, s.face_normals, i)), 0.0f, s.normals + 4 * i);
    }
}

Vec3 impulse_of_air(const AirView& air, std::uint32_t particle) {
    const scalar::vec3 sum = sum_of_one(air.around, air.impulse, particle);
    return {sum.x, sum.y, sum.z};
}

void push_pass(const ParticleView& p, const AirView& air, Range range) {
    using namespace scalar;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const float w = p.position[4 * i + 3];
        if (!(w > 0)) continue;
        const vec3 sum = sum_of_one(air.around, air.impulse, i);
        float *v = p.velocity + 4 * i, *x_dropped = p.compensation + 4 * i, *start = p.start + 4 * i;
        Motion m{vec3(v[0], v[1], v[2]), vec3(start[3], v[3], x_dropped[3]), vec3(0.0f)};
        push_by_air(m, sum, w);
        store_blocks(m.v, m.v_dropped.y, v);
        start[3] = m.v_dropped.x;
        x_dropped[3] = m.v_dropped.z;
    }
}

void average_pass(const ParticleView& p, const GatherView& gather, Range range) {
    using namespace scalar;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const std::uint32_t begin = gather.offsets[i], end = gather.offsets[i + 1];
        if (begin == end) continue;
        vec3 sum = gather.fixed ? fixed_sum(gather, begin, end) : vec3(0.0f);
        for (std::uint32_t k = begin; k < end && !gather.fixed; ++k) {
            const float* c = gather.blocks + std::size_t{4} * gather.items[k];
            sum = sum + vec3(c[0], c[1], c[2]);
        }
        if (gather.mean) sum = sum * (1.0f / static_cast<float>(end - begin));
        float* const at = p.position + 4 * i;
        vec3 x(at[0], at[1], at[2]);
        if (p.remainder) {
            float* const kept = p.remainder + 4 * i;
            vec3 remainder(kept[0], kept[1], kept[2]);
            move_exactly(x, remainder, sum);
            store_blocks(remainder, 0.0f, kept);
        } else {
            x = x + sum;
        }
        store_blocks(x, at[3], at);
    }
}

}  // namespace weft::cpu

namespace weft::scalar {

using namespace weft::cpu;

#include "cpu/passes.inl"

static constexpr Passes passes = make_passes("scalar");

}  // namespace weft::scalar

namespace weft::cpu {

const Passes& scalar_passes() {
    return scalar::passes;
}

}  // namespace weft::cpu
