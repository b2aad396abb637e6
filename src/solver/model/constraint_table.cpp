#include "solver/model/constraint_table.h"

#include "physics/change_rows.h"

#include <algorithm>

namespace weft {
namespace {

std::vector<Batch> lay_out(const Coloring& coloring) {
    std::vector<Batch> batches;
    std::uint32_t at = 0;
    const auto append = [&](std::uint32_t rows, bool serial) {
        if (rows == 0) return;
        batches.push_back({at, rows, serial});
        at = batches.back().padded_end();
    };
    for (std::uint32_t c = 0; c < coloring.color_count(); ++c) {
        append(coloring.color_begin[c + 1] - coloring.color_begin[c], false);
    }
    append(coloring.overflow, true);
    return batches;
}

// Widens each field of an array from `stride` to `wider` elements; new elements are `fill`.
template <class T>
AlignedVector<T> widened(const SharedArray<T>& from, std::uint32_t stride, std::uint32_t wider, T fill) {
    AlignedVector<T> to(stride == 0 ? 0 : from.size() / stride * wider, fill);
    for (std::size_t i = 0; i < from.size(); ++i) to[i / stride * wider + i % stride] = from[i];
    return to;
}

}  // namespace

namespace {

// Appends padding to the table.
void widen(ConstraintTable& table, std::uint32_t stride) {
    const std::uint32_t before = table.stride;
    AlignedVector<std::uint32_t> particles = widened(table.particles, before, stride, 0u);
    for (std::uint32_t slot = 0; slot < table.arity; ++slot)
        for (std::uint32_t row = before; row < stride; ++row)
            particles[std::size_t{slot} * stride + row] = dummy(table.first_dummy, slot, row);
    table.particles = std::move(particles);
    table.fields = widened(table.fields, before, stride, 0.0f);
    table.geometry = widened(table.geometry, before, stride, no_area);
    if (table.is_coupled()) {
        AlignedVector<std::uint32_t> coupled = widened(table.coupled, before, stride, 0u);
        for (std::uint32_t k = 0; k < coupled_rows; ++k)
            for (std::uint32_t row = before; row < stride; ++row) coupled[std::size_t{k} * stride + row] = row;
        table.coupled = std::move(coupled);
        table.coupling = widened(table.coupling, before, stride, 0.0f);
    }
    table.stride = stride;
}

}  // namespace

void add_second_halves(ConstraintTable& table) {
    table.second_halves = table.stride;
    widen(table, 2 * table.stride);
}

void use_second_halves(ConstraintTable& table) {
    const bool spare = table.spare_used > 0;  // its batch stays last
    const std::size_t count = table.batches.size() - spare;
    std::vector<Batch> halves(table.batches.begin(), table.batches.begin() + static_cast<std::ptrdiff_t>(count));
    const auto blocks = static_cast<std::uint32_t>(table.blocks.size());
    for (std::uint32_t i = 0; i < blocks; ++i)
        table.blocks.push_back({table.blocks[i].begin + table.second_halves, table.blocks[i].length});
    for (Batch& batch : halves) {
        batch.begin += table.second_halves;
        batch.first_block += blocks;
        batch.halves = true;
    }
    table.batches.insert(table.batches.begin() + static_cast<std::ptrdiff_t>(count), halves.begin(), halves.end());
}

void add_spare_rows(ConstraintTable& table, std::uint32_t count) {
    const std::uint32_t before = table.stride;
    widen(table, before + padded(count));
    table.first_spare = before;
    table.spare_rows = count;
}

std::optional<std::size_t> ConstraintTable::line_block(std::uint32_t row) const {
    const auto after = std::ranges::upper_bound(blocks, row, {}, &LineBlock::begin);
    if (after == blocks.begin() || row >= (after - 1)->end()) return std::nullopt;
    return static_cast<std::size_t>(after - 1 - blocks.begin());
}

namespace {

void couple(ConstraintTable& table, const RowList& list, const Coloring& coloring) {
    const std::size_t stride = table.stride;
    std::vector<std::uint32_t> row_of(list.size());
    std::uint32_t next = 0;
    for (const Batch& batch : table.batches)
        for (std::uint32_t k = 0; k < batch.rows; ++k) row_of[coloring.order[next++]] = batch.begin + k;
    AlignedVector<std::uint32_t> coupled(coupled_rows * stride);
    AlignedVector<float> coupling(coupled_numbers * stride);
    for (std::uint32_t k = 0; k < coupled_rows; ++k)
        for (std::uint32_t row = 0; row < stride; ++row) coupled[k * stride + row] = row;
    for (std::size_t source = 0; source < row_of.size(); ++source) {
        const std::uint32_t row = row_of[source];
        for (std::uint32_t k = 0; k < coupled_rows; ++k)
            if (const std::uint32_t other = list.coupled[source * coupled_rows + k]; other != no_particle)
                coupled[k * stride + row] = row_of[other];
        for (std::uint32_t number = 0; number < coupled_numbers; ++number)
            coupling[number * stride + row] = list.coupling[source * coupled_numbers + number];
    }
    table.coupled = std::move(coupled);
    table.coupling = std::move(coupling);
}

}  // namespace

Coloring color_rows(ConstraintKind kind, const RowList& list, std::uint32_t particle_count,
                    const ColoringOptions& options) {
    const std::uint32_t moved = constraint_info(kind).moved;
    if (moved == list.arity) return color_rows(list.particles, moved, particle_count, options);
    std::vector<std::uint32_t> written;  // constraints of one color may share particles that they only read
    written.reserve(std::size_t{moved} * list.size());
    for (std::uint32_t row = 0; row < list.size(); ++row) {
        const auto first = list.particles.begin() + static_cast<std::ptrdiff_t>(row) * list.arity;
        written.insert(written.end(), first, first + moved);
    }
    return color_rows(written, moved, particle_count, options);
}

ConstraintTable pack_rows(ConstraintKind kind, const RowList& list, std::uint32_t particle_count,
                          const ColoringOptions& options) {
    return pack_rows(kind, list, particle_count, color_rows(kind, list, particle_count, options));
}

ConstraintTable pack_rows(ConstraintKind kind, const RowList& list, std::uint32_t particle_count,
                          const Coloring& coloring) {
    return pack_rows_with_dummies(kind, list, first_dummy(particle_count), coloring);
}

ConstraintTable pack_rows_with_dummies(ConstraintKind kind, const RowList& list, std::uint32_t first,
                                       const Coloring& coloring) {
    ConstraintTable table{.kind = kind,
                          .arity = list.arity,
                          .field_count = list.field_count,
                          .rows = list.size(),
                          .stride = 0,
                          .particles = {},
                          .fields = {},
                          .first_dummy = first,
                          .batches = lay_out(coloring),
                          .blocks = {}};
    table.left_out = std::vector<float>(list.left_out);
    if (table.batches.empty()) return table;

    table.stride = table.batches.back().padded_end();
    const std::size_t stride = table.stride;
    AlignedVector<std::uint32_t> particles(table.arity * stride);
    AlignedVector<float> fields(table.field_count * stride), geometry(list.geometry_count * stride, no_area);
    std::uint32_t next = 0;
    for (const Batch& batch : table.batches) {
        for (std::uint32_t row = batch.begin; row < batch.padded_end(); ++row) {
            const bool real_row = row < batch.begin + batch.rows;
            const std::size_t source = real_row ? coloring.order[next++] : 0;
            for (std::uint32_t slot = 0; slot < table.arity; ++slot) {
                const std::uint32_t particle = real_row ? list.particles[source * table.arity + slot] : no_particle;
                particles[slot * stride + row] = particle == no_particle ? dummy(first, slot, row) : particle;
            }
            if (!real_row) continue;
            for (std::uint32_t field = 0; field < table.field_count; ++field)
                fields[field * stride + row] = list.fields[source * table.field_count + field];
            for (std::uint32_t number = 0; number < list.geometry_count; ++number)
                geometry[number * stride + row] = list.geometry[source * list.geometry_count + number];
        }
    }
    table.particles = std::move(particles);
    table.fields = std::move(fields);
    table.geometry = std::move(geometry);
    if (!list.coupling.empty()) couple(table, list, coloring);
    return table;
}

}  // namespace weft
