#include "cpu/links.h"

namespace weft::cpu {

void LinkState::prepare(const LinkTables& tables, const WorldPlan& plan) {
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind)
        lambda_[kind].resize(rounds_of_links(plan) > 1 ? tables[kind].lambda_count() : 0);
}

void LinkState::run(const Passes& wide, const LinkTables& tables, const WorldPlan& plan, const Pass& pass,
                    std::uint32_t substep, const ParticleView& world, float h, Worker worker) {
    if (!takes_part(tables, pass)) return;
    const auto kind = static_cast<std::uint32_t>(pass.constraint);
    const ConstraintTable& table = tables[kind];
    const Batch& batch = table.batches[pass.batch];
    if (batch.serial && worker.number != 0) return;
    const Share share = worker.of(padded(batch.rows));
    const Range rows = batch.serial ? Range{batch.begin, batch.begin + batch.rows}
                                    : Range{batch.begin + share.begin, batch.begin + share.end};
    const Passes& passes = batch.serial ? scalar_passes() : wide;
    const RowView view{table.stride, table.particles.data(), table.fields.data(), lambda_[kind].data()};
    // Fabrics have no plain stiffness for links, so plain position-based dynamics uses 1.
    if (plan.method == Method::pbd) return passes.project_plain[kind](world, view, rows, {1, 1});
    passes.project[kind](world, view, rows, h, lambda_use(plan, pass, substep, rounds_of_links(plan)));
}

}  // namespace weft::cpu
