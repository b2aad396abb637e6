// The CPU backend's list of constraints of one kind that is rebuilt while the world moves. Each constraint moves one
// particle; the constraints of a particle are consecutive.
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
    /// Allocates room for at most `capacity` constraints on `items` particles. No other function here allocates.
    void prepare(ConstraintKind kind, std::uint32_t items, std::uint32_t capacity);

    /// Number of constraints per item. The caller writes it before place().
    std::span<std::uint32_t> found() { return found_; }
    /// Assigns the constraints of each item their rows in the table. Constraints beyond the capacity get none. Padding
    /// acts on dummies, which start at `first_dummy`.
    void place(std::uint32_t first_dummy);
    /// The constraints of an item are rows [first_row(item), first_row(item + 1)).
    std::uint32_t first_row(std::uint32_t item) const { return places_[item]; }
    /// Sets the only particle of a row.
    void put(std::uint32_t row, std::uint32_t particle) { particles_[row] = particle; }
    void set(std::uint32_t row, std::uint32_t field, float value) {
        fields_[std::size_t{field} * stride_ + row] = value;
    }
    float field(std::uint32_t row, std::uint32_t field) const { return fields_[std::size_t{field} * stride_ + row]; }

    std::uint32_t rows() const { return std::min(wanted_, capacity_); }
    bool is_full() const { return wanted_ > capacity_; }
    std::uint32_t wanted() const { return wanted_; }
    std::uint32_t capacity() const { return capacity_; }

    // Arrays for the loops over constraints.
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
    std::vector<std::uint32_t> items_;  ///< identity: row i is item i of the corrections
};

}  // namespace weft::cpu
