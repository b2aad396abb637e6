// Times openings of edges: a cut along the middle column of a square sheet, two edges at a time.
#include "mesh/procedural.h"
#include "solver/model/cuts.h"
#include "solver/model/opened_cloth.h"

#include <benchmark/benchmark.h>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> make_sheet(std::uint32_t side) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    mesh.uvs.clear();
    ClothModelDesc desc{.name = "sheet",
                        .layout = {.lines = true, .hierarchy = true},
                        .reserve = {.particles = 4 * side, .openings = true, .tears = true}};
    auto topology = build_topology(mesh, {.reorder = false});
    desc.mesh = std::move(mesh);
    return *build_cloth_model(std::move(desc), std::move(*topology));
}

void openings(benchmark::State& state) {
    const auto side = static_cast<std::uint32_t>(state.range(0));
    const auto model = make_sheet(side);
    const auto cut =
        openings_along_plane(*model, {model->start.data(), model->particle_count}, {0.001f, 0, 0}, {1, 0, 0});
    const StretchLaw law(model->fabric.stretch);
    for (auto _ : state) {
        state.PauseTiming();
        OpenedArrays arrays(*model);
        state.ResumeTiming();
        for (const Opening& opening : cut) benchmark::DoNotOptimize(Opener(*model, arrays, law).open(opening));
    }
    state.counters["openings"] = static_cast<double>(cut.size());
    state.counters["s_per_opening"] = benchmark::Counter(
        static_cast<double>(cut.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(openings)->Arg(64)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace weft
