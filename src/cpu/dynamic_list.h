// Constraints of one kind that are found anew while the world moves, as the CPU backend keeps them. Each row moves one
// particle, and lies with the other rows of that particle.
#pragma once

#include "base/aligned.h"
#include "physics/constraint.h"
#include "solver/state/list_counts.h"

#include <weft/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

class DynamicList {
  public:
    /// Makes room for rows of `items` particles, at most `capacity` of them; only here memory is asked for.
    void prepare(ConstraintKind kind, std::uint32_t items, std::uint32_t capacity);

    /// Rows that each item has: who looks for rows writes them, before place().
    std::span<std::uint32_t> found() { return found_; }
    /// Decides where each item's rows go. Rows that there is no room for have no place. Padding acts on dummies from
    /// `first_dummy` on.
    void place(std::uint32_t first_dummy);
    /// Where rows [first_row(item), first_row(item + 1)) of an item lie.
    std::uint32_t first_row(std::uint32_t item) const { return places_[item]; }
    /// Number of the only particle of a row.
    void put(std::uint32_t row, std::uint32_t particle) { particles_[row] = particle; }
    void set(std::uint32_t row, std::uint32_t field, float value) {
        fields_[std::size_t{field} * stride_ + row] = value;
    }
    float field(std::uint32_t row, std::uint32_t field) const { return fields_[std::size_t{field} * stride_ + row]; }

    std::uint32_t rows() const { return std::min(wanted_, capacity_); }
    bool is_full() const { return wanted_ > capacity_; }
    std::uint32_t wanted() const { return wanted_; }
    std::uint32_t capacity() const { return capacity_; }

    // What the loops over rows need.
    std::uint32_t stride() const { return stride_; }
    const std::uint32_t* particles() const { return particles_.data(); }
    const float* fields() const { return fields_.data(); }
    float* lambda() { return lambda_.data(); }
    float* corrections() { return &corrections_[0].x; }
    const float* share() const { return share_.data(); }
    const std::uint32_t* places() const { return places_.data(); }
    const std::uint32_t* items() const { return items_.data(); }

  private:
    std::uint32_t capacity_ = 0, stride_ = 0, wanted_ = 0;
    std::vector<std::uint32_t> found_, places_;
    AlignedVector<std::uint32_t> particles_;  ///< numbered over the world
    AlignedVector<float> fields_, lambda_, share_;
    AlignedVector<Vec4> corrections_;
    std::vector<std::uint32_t> items_;  ///< row i is item i of the corrections
};

}  // namespace weft::cpu
