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

    std::uint32_t size() const { return static_cast<std::uint32_t>(parent_.size()); }
    /// The sets. Numbers in a set are ascending; sets are sorted by their first number.
    std::vector<std::vector<std::uint32_t>> sets() {
        std::vector<std::vector<std::uint32_t>> sets;
        std::vector<std::uint32_t> set_of(size());
        for (std::uint32_t i = 0; i < size(); ++i) {
            const std::uint32_t first = first_of(i);
            if (first == i) set_of[i] = static_cast<std::uint32_t>(sets.size()), sets.emplace_back();
            sets[set_of[first]].push_back(i);
        }
        return sets;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace weft
