// Nanoseconds per constraint and iteration for every constraint type, on a square sheet, for every instruction set of
// this machine.

#include "cpu/cloth_state.h"
#include "cpu/passes.h"
#include "mesh/procedural.h"

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>

namespace {

using namespace weft;

std::shared_ptr<const ClothModel> sheet(std::uint32_t side, BendModel bend) {
    static std::map<std::pair<std::uint32_t, BendModel>, std::shared_ptr<const ClothModel>> made;
    auto& model = made[{side, bend}];
    if (!model) {
        TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
        auto topology = build_topology(mesh, {.reorder = false});
        Fabric fabric;
        fabric.tether.use = Tethers::on;
        fabric.bend.model = bend;
        model = *build_cloth_model(
            {.name = "sheet", .mesh = std::move(mesh), .fabric = fabric, .pins = {.particles = {0, side - 1}}},
            std::move(*topology));
    }
    return model;
}

BendModel bend_model(ConstraintKind kind) {
    return kind == ConstraintKind::plate           ? BendModel::plate
           : kind == ConstraintKind::distance_bend ? BendModel::distance
           : kind == ConstraintKind::bend          ? BendModel::dihedral
                                                   : BendModel::moment;
}

// Projects all batches of one constraint type once per iteration, as a step with one iteration per substep does.
void project(benchmark::State& state, const cpu::Passes* passes, ConstraintKind kind, std::uint32_t side) {
    const auto model = sheet(side, bend_model(kind));
    cpu::WorldArrays arrays;
    arrays.resize(model->capacity());
    cpu::ClothState cloth(model, arrays, 0);
    const ConstraintTable& table = model->table(kind);
    const cpu::ParticleView particles = cloth.now().view();
    const cpu::RowView rows = cloth.rows(kind);
    const auto index = static_cast<std::uint32_t>(kind);
    for (auto _ : state) {
        for (const Batch& batch : table.batches) {
            if (batch.serial) {
                cpu::scalar_passes().project[index](particles, rows, {batch.begin, batch.begin + batch.rows},
                                                    1.0f / 1200, LambdaUse::discard);
            } else {
                passes->project[index](particles, rows, {batch.begin, batch.padded_end()}, 1.0f / 1200,
                                       LambdaUse::discard);
            }
        }
        benchmark::ClobberMemory();
    }
    state.counters["time/row"] =
        benchmark::Counter(table.rows, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["rows"] = table.rows;
}

}  // namespace

int main(int argc, char** argv) {
    for (const cpu::Passes* passes : cpu::available_passes()) {
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            const auto constraint = static_cast<ConstraintKind>(kind);
            if (constraint_info(constraint).source != RowSource::model) continue;
            for (const std::uint32_t side : {64u, 256u}) {
                const std::string name = std::string(constraint_info(constraint).name) + "/" + std::to_string(side) +
                                         "x" + std::to_string(side) + "/" + std::string(passes->isa);
                benchmark::RegisterBenchmark(name.c_str(), project, passes, constraint, side)
                    ->Unit(benchmark::kMicrosecond);
            }
        }
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
