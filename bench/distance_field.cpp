// Nanoseconds per point of distance_mesh, for every instruction set of this machine, and the time to build a distance
// field.

#include "cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "../bench/distance_field.cpp"
#include <hwy/foreach_target.h>

#include "base/aligned.h"

#ifndef WEFT_BENCH_POINTS
#define WEFT_BENCH_POINTS
struct Points {
    weft::AlignedVector<float> blocks;    // x, y, z, unused
    weft::AlignedVector<float> distance;  // of each
    weft::AlignedVector<float> normals;   // x, y, z, unused
};
#endif

// Highway's portable fallback has no wide vectors.
#if HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR

#include "physics/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace weft::HWY_NAMESPACE {

#include "physics/contact/contact.kernel.h"
#include "physics/contact/mesh.kernel.h"

void read_field(ShapeBlocks data, Points& points) {
    const real zero(0.0f);
    const ShapeNumbers numbers{zero, zero, zero, zero, data};
    for (std::size_t i = 0; i < points.distance.size(); i += lane_count) {
        real unused;
        const vec3 p = load_blocks(points.blocks.data() + 4 * i, unused);
        vec3 normal;
        const real distance = distance_mesh(p, numbers, normal);
        store(distance, points.distance.data() + i);
        store_blocks(normal, distance, points.normals.data() + 4 * i);
    }
}

}  // namespace weft::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE

#include "collide/distance_field.h"
#include "mesh/procedural.h"
#include "physics/scalar.h"

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace weft;

using Read = void (*)(ShapeBlocks, Points&);

void read_field_scalar(ShapeBlocks data, Points& points) {
    for (std::size_t i = 0; i < points.distance.size(); ++i) {
        const float* const p = points.blocks.data() + 4 * i;
        scalar::vec3 normal;
        points.distance[i] = scalar::distance_mesh({p[0], p[1], p[2]}, {0, 0, 0, 0, data}, normal);
        float* const n = points.normals.data() + 4 * i;
        n[0] = normal.x, n[1] = normal.y, n[2] = normal.z, n[3] = points.distance[i];
    }
}

std::vector<std::pair<std::string, Read>> instruction_sets() {
    const std::int64_t supported = hwy::SupportedTargets();
    std::vector<std::pair<std::string, Read>> sets;
#if HWY_TARGETS & HWY_AVX3
    if (supported & HWY_AVX3) sets.emplace_back("avx512", &N_AVX3::read_field);
#endif
#if HWY_TARGETS & HWY_AVX2
    if (supported & HWY_AVX2) sets.emplace_back("avx2", &N_AVX2::read_field);
#endif
#if HWY_TARGETS & HWY_SSE4
    if (supported & HWY_SSE4) sets.emplace_back("sse4", &N_SSE4::read_field);
#endif
#if HWY_TARGETS & HWY_NEON
    if (supported & HWY_NEON) sets.emplace_back("neon", &N_NEON::read_field);
#endif
    sets.emplace_back("scalar", &read_field_scalar);
    return sets;
}

const DistanceField& field_of_sphere(std::uint32_t cells) {
    static std::vector<std::pair<std::uint32_t, DistanceField>> built;
    for (const auto& [size, field] : built) {
        if (size == cells) return field;
    }
    const TriangleMesh mesh = make_sphere(1, 5);
    return built.emplace_back(cells, *build_distance_field(mesh.positions, mesh.triangles, {.cells = cells})).second;
}

// Points of a square sheet that lies on the sphere, row by row, or in random order around it.
Points make_points(bool random) {
    constexpr std::uint32_t side = 96;
    Points points{AlignedVector<float>(4 * side * side), AlignedVector<float>(side * side),
                  AlignedVector<float>(4 * side * side)};
    std::mt19937 engine(1);
    const auto number = [&] { return static_cast<float>(engine() % 2000001) / 1e6f - 1; };
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const auto along = [&](std::uint32_t k) { return 1.2f * (static_cast<float>(k) / side - 0.5f); };
        const float x = random ? 1.2f * number() : along(i % side), z = random ? 1.2f * number() : along(i / side);
        const float y = random ? 1.2f * number() : std::sqrt(std::max(0.0f, 1.02f - x * x - z * z));
        const float block[] = {x, y, z, 0};
        std::copy(block, block + 4, points.blocks.begin() + 4 * i);
    }
    return points;
}

void check_against_scalar(const std::string& name, Read read, ShapeBlocks data, Points points) {
    Points expected = points;
    read_field_scalar(data, expected);
    read(data, points);
    for (std::size_t i = 0; i < points.normals.size(); ++i) {
        if (std::bit_cast<std::uint32_t>(points.normals[i]) == std::bit_cast<std::uint32_t>(expected.normals[i]))
            continue;
        std::fprintf(stderr, "%s: point %zu differs from the scalar one\n", name.c_str(), i / 4);
        std::exit(1);
    }
}

void time_reading(benchmark::State& state, Read read, std::uint32_t cells, bool random) {
    const DistanceField& field = field_of_sphere(cells);
    Points points = make_points(random);
    for (auto _ : state) {
        read(field.data.blocks(), points);
        benchmark::ClobberMemory();
    }
    const auto count = static_cast<double>(points.distance.size()) * static_cast<double>(state.iterations());
    state.counters["per_point"] = benchmark::Counter(count, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["MB"] = static_cast<double>(field.bytes()) / 1e6;
}

void time_building(benchmark::State& state, std::uint32_t cells, unsigned threads) {
    const TriangleMesh mesh = make_sphere(1, 6);
    for (auto _ : state) {
        auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = cells, .threads = threads});
        benchmark::DoNotOptimize(field);
    }
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    for (const auto& [name, read] : instruction_sets()) {
        for (const std::uint32_t cells : {32u, 96u}) {
            for (const bool random : {false, true}) {
                check_against_scalar(name, read, field_of_sphere(cells).data.blocks(), make_points(random));
                const std::string title = "distance_mesh/" + name + "/" + std::to_string(cells) + " cells/" +
                                          (random ? "random points" : "sheet on the surface");
                benchmark::RegisterBenchmark(
                    title.c_str(), [=, r = read](benchmark::State& state) { time_reading(state, r, cells, random); });
            }
        }
    }
    for (const unsigned threads : {1u, 2u}) {
        const std::string title = "build/96 cells/82 k triangles/" + std::to_string(threads) + " threads";
        benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State& state) { time_building(state, 96, threads); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    benchmark::RunSpecifiedBenchmarks();
}

#endif
