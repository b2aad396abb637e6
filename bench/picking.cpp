// Times what the editor does while the pointer moves over a cloth: a tree of its triangles for a new frame, and rays.
#include "editor/tools/picking.h"
#include "editor/tools/surface_distance.h"
#include "editor/tools/vertex_selection.h"
#include "mesh/procedural.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

namespace weft::editor {
namespace {

constexpr Vec2 view_size{1280, 720};
constexpr Camera camera{.position = {0.9f, 1.1f, 1.3f}, .target = {}, .fov = 40};

/// A sheet with folds, as a frame of a cloth stores it.
struct Sheet {
    std::vector<Vec4> positions;
    std::vector<Triangle> triangles;

    Sheet(std::uint32_t side, float phase) {
        TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
        for (const Vec3 p : mesh.positions) {
            const float y = 0.1f * std::sin(17 * p.x + phase) + 0.05f * std::cos(23 * p.z + 9 * p.x);
            positions.push_back({p.x + 0.05f * std::cos(31 * p.z), y, p.z, 1});
        }
        triangles = std::move(mesh.triangles);
    }
    MeshView mesh() const { return {std::span<const Vec4>(positions), std::span<const Triangle>(triangles)}; }
};

std::uint32_t side_of(const benchmark::State& state) {
    return static_cast<std::uint32_t>(state.range(0));
}

std::vector<Vec2> pointers() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> x(300, 980), y(150, 570);
    std::vector<Vec2> pixels(1024);
    for (Vec2& p : pixels) p.x = x(random), p.y = y(random);
    return pixels;
}

void build(benchmark::State& state) {
    const Sheet sheet(side_of(state), 0);
    TriangleTree tree;
    for (auto _ : state) tree.build(sheet.mesh());
}

void refit(benchmark::State& state) {
    const Sheet first(side_of(state), 0), second(side_of(state), 0.3f);
    TriangleTree tree(first.mesh());
    bool odd = false;
    for (auto _ : state) tree.refit((odd = !odd) ? second.mesh() : first.mesh());
}

void pick(benchmark::State& state) {
    const Sheet sheet(side_of(state), 0);
    const TriangleTree tree(sheet.mesh());
    const std::vector<PickSurface> cloths{{.tree = &tree}};
    const std::vector<Vec2> pixels = pointers();
    const Projection view(camera, view_size);
    std::size_t i = 0, hits = 0, picks = 0;
    for (auto _ : state) {
        const Pick found = pick_at(view, pixels[i++ % pixels.size()], {.cloths = cloths});
        hits += found.kind == PickKind::cloth, ++picks;
    }
    state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(picks);
}

/// A new frame, and what is under the pointer in it.
void hover(benchmark::State& state) {
    const Sheet first(side_of(state), 0), second(side_of(state), 0.3f);
    SurfaceTree surface;
    const std::vector<Vec2> pixels = pointers();
    const Projection view(camera, view_size);
    std::uint64_t frame = 0;
    for (auto _ : state) {
        const TriangleTree& tree = surface.of((frame % 2 ? first : second).mesh(), 1, frame);
        const std::vector<PickSurface> cloths{{.tree = &tree}};
        benchmark::DoNotOptimize(pick_at(view, pixels[frame++ % pixels.size()], {.cloths = cloths}));
    }
}

void select_visible(benchmark::State& state) {
    const Sheet sheet(side_of(state), 0);
    const TriangleTree tree(sheet.mesh());
    const std::vector<PickSurface> cloths{{.tree = &tree}};
    const HiddenBy hidden{{.cloths = cloths}};
    const Projection view(camera, view_size);
    std::size_t found = 0;
    for (auto _ : state) found = vertices_in_box(view, sheet.mesh(), {0, 0}, view_size, &hidden).size();
    state.counters["visible"] = static_cast<double>(found);
}

void select_lasso(benchmark::State& state) {
    const Sheet sheet(side_of(state), 0);
    const Projection view(camera, view_size);
    std::vector<Vec2> polygon;
    for (int i = 0; i < 1000; ++i) {
        const float angle = static_cast<float>(i) * 0.00628f, radius = 250 + 30 * std::sin(40 * angle);
        polygon.push_back({640 + radius * std::cos(angle), 360 + radius * std::sin(angle)});
    }
    std::size_t found = 0;
    for (auto _ : state) found = vertices_in_lasso(view, sheet.mesh(), polygon, nullptr).size();
    state.counters["selected"] = static_cast<double>(found);
}

void connect(benchmark::State& state) {
    const Sheet sheet(side_of(state), 0);
    for (auto _ : state) benchmark::DoNotOptimize(SurfaceDistance(sheet.mesh()));
}

void brush_dab(benchmark::State& state) {
    const Sheet sheet(side_of(state), 0);
    SurfaceDistance distance(sheet.mesh());
    std::size_t reached = 0;
    for (auto _ : state) {
        const MeshPlace place{static_cast<std::uint32_t>(sheet.triangles.size() / 2 + side_of(state)), {1, 0, 0}};
        reached = distance.from(sheet.mesh(), place, 0.1f).size();
    }
    state.counters["vertices"] = static_cast<double>(reached);
}

BENCHMARK(build)->Arg(64)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(refit)->Arg(64)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(hover)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(pick)->Arg(128)->Arg(512)->Unit(benchmark::kMicrosecond);
BENCHMARK(select_visible)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(select_lasso)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(connect)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(brush_dab)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace weft::editor
