// All constraints of one kind, packed for backends: a structure of arrays with one row per constraint, batch by batch.
#pragma once

#include "base/aligned.h"
#include "base/shared_array.h"
#include "mesh/coloring.h"
#include "physics/constraint.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace weft {

/// Batches and particle arrays are padded to a multiple of this number: the lanes of the widest register. Loops over
/// them need no tail.
inline constexpr std::uint32_t lane_padding = 16;

constexpr std::uint32_t padded(std::uint32_t count) {
    return (count + lane_padding - 1) / lane_padding * lane_padding;
}

/// Rows [begin, begin + rows) of the table. The rows from there to padded_end() are padding and act on dummy particles.
struct Batch {
    std::uint32_t begin = 0, rows = 0;
    bool serial = false;  ///< the overflow: constraints that share particles and run one after another, in order
    /// For constraints on lines: the blocks of the batch. Only neighbors on a line share a particle.
    std::uint32_t first_block = 0, blocks = 0;
    bool halves = false;  ///< second halves of constraints whose edge was opened (tear_table.h); most rows are padding

    std::uint32_t padded_end() const { return begin + padded(rows); }
};

/// A block of lane_padding interleaved lines. Row `begin + k · lane_padding + lane` is the k-th constraint of its line;
/// its second particle is the first particle of the next constraint. Shorter lines are padded with constraints without
/// stiffness from their last particle to itself.
struct LineBlock {
    std::uint32_t begin = 0, length = 0;
    /// Some of its lines end within them: a constraint need not begin at the particle at which the one before it ends.
    bool cut = false;
    std::uint32_t end() const { return begin + length * lane_padding; }
};

/// Number of dummy particles that padding acts on: one per lane and slot (at most six slots), so that no two lanes of a
/// scatter write to the same element.
inline constexpr std::uint32_t dummy_count = 6 * lane_padding;

struct ConstraintTable {
    ConstraintKind kind{};
    std::uint32_t arity = 0, field_count = 0;
    std::uint32_t rows = 0;                ///< without padding
    std::uint32_t stride = 0;              ///< rows with padding: length of each array below
    SharedArray<std::uint32_t> particles;  ///< [slot · stride + row]
    SharedArray<float> fields;             ///< [field · stride + row]
    std::uint32_t first_dummy = 0;         ///< the dummy_count particles from here on are for padding
    std::vector<Batch> batches;
    std::vector<LineBlock> blocks;     ///< in the order of their rows; empty if constraints are not on lines
    SharedArray<float> geometry = {};  ///< as in RowList, [number · stride + row]; `no_area` in padding
    SharedArray<float> left_out = {};  ///< as in RowList
    /// As in RowList: rows, [k · stride + row], and numbers, [number · stride + row]. In padding and in place of
    /// `none`, a row names itself with numbers of 0.
    SharedArray<std::uint32_t> coupled = {};
    SharedArray<float> coupling = {};
    /// Padding from first_spare on is room for constraints that are added while the cloth moves (cloth_edit.h):
    /// spare_rows in total, spare_used in use.
    std::uint32_t first_spare = 0, spare_rows = 0, spare_used = 0;
    /// Rows second_halves … 2 · second_halves are the second halves of the rows below, which belong to the second
    /// triangle of an edge while it is open. 0: the table has none.
    std::uint32_t second_halves = 0;

    /// Whether a row is a constraint. Padding acts on dummies or, on lines, on one particle twice.
    bool is_real(std::uint32_t row) const {
        return !is_dummy(particles[row]) && !(arity > 1 && particles[row] == particles[std::size_t{stride} + row]) &&
               !is_ended(row);
    }
    /// Whether a constraint on a line was removed: it keeps its particles, without stiffness.
    bool is_ended(std::uint32_t row) const {
        return !blocks.empty() && !geometry.empty() && geometry[geometry.size() - stride + row] < 0;
    }
    bool is_dummy(std::uint32_t particle) const { return particle - first_dummy < dummy_count; }
    /// The block of lines that has the row; none if the row is not on a line.
    std::optional<std::size_t> line_block(std::uint32_t row) const;
    /// Number of Lagrange multipliers, indexed [multiplier · stride + row].
    std::size_t lambda_count() const { return std::size_t{constraint_info(kind).lambdas} * stride; }
    bool is_coupled() const { return !coupling.empty(); }
    std::uint32_t overflow() const { return !batches.empty() && batches.back().serial ? batches.back().rows : 0; }
};

/// First dummy in the particle arrays of a cloth.
constexpr std::uint32_t first_dummy(std::uint32_t particle_count) {
    return padded(particle_count);
}
/// Length of a particle array, dummies included.
constexpr std::uint32_t particle_capacity(std::uint32_t particle_count) {
    return first_dummy(particle_count) + dummy_count;
}

/// The dummy for this slot in row `row` of padding; dummies start at `first`.
constexpr std::uint32_t dummy(std::uint32_t first, std::uint32_t slot, std::uint32_t row) {
    return first + slot * lane_padding + row % lane_padding;
}

/// Adds a second half for each constraint: the same batches and blocks once more, as padding. They are projected only
/// when `batches` lists them (use_second_halves). Call it before add_spare_rows().
void add_second_halves(ConstraintTable& table);
/// Lists the batches of the second halves.
void use_second_halves(ConstraintTable& table);
/// Adds room for `count` constraints.
void add_spare_rows(ConstraintTable& table, std::uint32_t count);

Coloring color_rows(ConstraintKind kind, const RowList& rows, std::uint32_t particle_count,
                    const ColoringOptions& options = {});
ConstraintTable pack_rows(ConstraintKind kind, const RowList& rows, std::uint32_t particle_count,
                          const Coloring& coloring);
/// Colors and packs.
ConstraintTable pack_rows(ConstraintKind kind, const RowList& rows, std::uint32_t particle_count,
                          const ColoringOptions& options = {});
/// Packs with dummies that start at `first` instead of after the particles.
ConstraintTable pack_rows_with_dummies(ConstraintKind kind, const RowList& rows, std::uint32_t first,
                                       const Coloring& coloring);

}  // namespace weft
