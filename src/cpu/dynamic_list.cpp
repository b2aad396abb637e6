#include "cpu/dynamic_list.h"

#include "solver/model/constraint_table.h"

#include <numeric>

namespace weft::cpu {

void DynamicList::prepare(ConstraintKind kind, std::uint32_t items, std::uint32_t capacity) {
    if (found_.size() != items) {
        found_.assign(items, 0);
        places_.assign(std::size_t{items} + 1, 0);
        wanted_ = 0;
    }
    if (capacity == capacity_) return;
    const ConstraintInfo& info = constraint_info(kind);
    capacity_ = capacity;
    stride_ = padded(capacity);
    wanted_ = 0;
    particles_.resize(stride_);
    fields_.resize(info.fields.size() * stride_);
    lambda_.resize(std::size_t{info.lambdas} * stride_);
    share_.resize(stride_);
    corrections_.resize(stride_);
    items_.resize(stride_);
    std::iota(items_.begin(), items_.end(), 0u);
}

void DynamicList::place(std::uint32_t first_dummy) {
    std::uint32_t sum = 0;
    for (std::size_t item = 0; item < found_.size(); ++item) {
        places_[item] = std::min(sum, capacity_);
        sum += found_[item];
    }
    places_.back() = std::min(sum, capacity_);
    wanted_ = sum;
    for (std::size_t item = 0; item < found_.size(); ++item) {
        const std::uint32_t begin = places_[item], end = places_[item + 1];
        for (std::uint32_t row = begin; row < end; ++row) share_[row] = 1.0f / static_cast<float>(end - begin);
    }
    for (std::uint32_t row = rows(); row < padded(rows()); ++row) {
        particles_[row] = dummy(first_dummy, 0, row);
        for (std::size_t at = row; at < fields_.size(); at += stride_) fields_[at] = 0;
        share_[row] = 0;
    }
}

}  // namespace weft::cpu
