// Rows of one kind of constraint, packed for backends: structure of arrays, batch by batch.
#pragma once

#include "base/aligned.h"
#include "base/shared_array.h"
#include "mesh/coloring.h"
#include "physics/constraint.h"

#include <cstdint>
#include <vector>

namespace weft {

/// Batches and particle arrays are padded to this many elements: the widest register has so many lanes, so no loop over
/// them needs a tail.
inline constexpr std::uint32_t lane_padding = 16;

constexpr std::uint32_t padded(std::uint32_t count) {
    return (count + lane_padding - 1) / lane_padding * lane_padding;
}

/// Rows [begin, begin + rows). Up to `padded_end` follow rows that act on particles of no weight.
struct Batch {
    std::uint32_t begin = 0, rows = 0;
    bool serial = false;  ///< the overflow: rows that share particles and run one after another, in order
    /// Where rows follow one another along lines: the blocks that they are in. They share particles along a line and
    /// nowhere else.
    std::uint32_t first_block = 0, blocks = 0;

    std::uint32_t padded_end() const { return begin + padded(rows); }
};

/// Lines side by side, as many as lane_padding: row `begin + k · lane_padding + lane` is the k-th of its line, and its
/// second particle is the first of the row after it. Shorter lines end in rows without stiffness from their end to
/// itself.
struct LineBlock {
    std::uint32_t begin = 0, length = 0;
    std::uint32_t end() const { return begin + length * lane_padding; }
};

/// Particles that padding acts on: a lane of each of six slots has its own, so that no two lanes of a scatter write to
/// the same place.
inline constexpr std::uint32_t dummy_count = 6 * lane_padding;

struct ConstraintTable {
    ConstraintKind kind{};
    std::uint32_t arity = 0, field_count = 0;
    std::uint32_t rows = 0;                ///< real rows
    std::uint32_t stride = 0;              ///< rows with padding: length of each array below
    SharedArray<std::uint32_t> particles;  ///< [slot · stride + row]
    SharedArray<float> fields;             ///< [field · stride + row]
    std::uint32_t first_dummy = 0;         ///< so many particles from here on are for padding alone: dummy_count
    std::vector<Batch> batches;
    std::vector<LineBlock> blocks;     ///< in the order of their rows; empty where rows are laid out one by one
    SharedArray<float> geometry = {};  ///< as RowList has it, [number · stride + row]; `no_area` in padding
    SharedArray<float> left_out = {};  ///< likewise
    /// Padding from first_spare on that constraints may take which are added while the cloth moves (cloth_edit.h): how
    /// many, and how many have.
    std::uint32_t first_spare = 0, spare_rows = 0, spare_used = 0;

    /// Whether a row is more than padding, which acts on dummies or, along lines, on one particle twice.
    bool is_real(std::uint32_t row) const {
        return !is_dummy(particles[row]) && !(arity > 1 && particles[row] == particles[std::size_t{stride} + row]) &&
               !is_ended(row);
    }
    /// Whether a constraint along a line is gone: it keeps its ends, and has no stiffness.
    bool is_ended(std::uint32_t row) const {
        return !blocks.empty() && !geometry.empty() && geometry[geometry.size() - stride + row] < 0;
    }
    bool is_dummy(std::uint32_t particle) const { return particle - first_dummy < dummy_count; }
    /// Multipliers of all rows: [multiplier · stride + row].
    std::size_t lambda_count() const { return std::size_t{constraint_info(kind).lambdas} * stride; }
    std::uint32_t overflow() const { return !batches.empty() && batches.back().serial ? batches.back().rows : 0; }
};

/// Where they start in the array of a cloth.
constexpr std::uint32_t first_dummy(std::uint32_t particle_count) {
    return padded(particle_count);
}
/// Length of a particle array, dummies included.
constexpr std::uint32_t particle_capacity(std::uint32_t particle_count) {
    return first_dummy(particle_count) + dummy_count;
}

/// What row `row` of padding acts on, of dummies that start at `first`.
constexpr std::uint32_t dummy(std::uint32_t first, std::uint32_t slot, std::uint32_t row) {
    return first + slot * lane_padding + row % lane_padding;
}

/// Adds padding for so many constraints.
void add_spare_rows(ConstraintTable& table, std::uint32_t count);

Coloring color_rows(ConstraintKind kind, const RowList& rows, std::uint32_t particle_count,
                    const ColoringOptions& options = {});
ConstraintTable pack_rows(ConstraintKind kind, const RowList& rows, std::uint32_t particle_count,
                          const Coloring& coloring);
/// Both.
ConstraintTable pack_rows(ConstraintKind kind, const RowList& rows, std::uint32_t particle_count,
                          const ColoringOptions& options = {});
/// Rows whose dummies start at `first` and not behind the particles.
ConstraintTable pack_rows_with_dummies(ConstraintKind kind, const RowList& rows, std::uint32_t first,
                                       const Coloring& coloring);

}  // namespace weft
