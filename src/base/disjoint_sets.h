// Sets of numbers that merge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace weft {

class DisjointSets {
  public:
    /// Every number below `count` is a set of its own.
    explicit DisjointSets(std::uint32_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    /// The smallest number in the set of `i`.
    std::uint32_t first_of(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void merge(std::uint32_t a, std::uint32_t b) {
        a = first_of(a), b = first_of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace weft
