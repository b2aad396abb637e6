#include "solver/state/address_space.h"

#include <algorithm>
#include <cassert>

namespace weft {

std::uint32_t AddressSpace::take(std::uint32_t count) {
    assert(count % lane_padding == 0);
    const auto fit = std::ranges::find_if(free_, [&](const Range& range) { return range.count >= count; });
    if (fit == free_.end()) {
        const std::uint32_t begin = end_;
        end_ += count;
        return begin;
    }
    const std::uint32_t begin = fit->begin;
    fit->begin += count;
    fit->count -= count;
    if (fit->count == 0) free_.erase(fit);
    return begin;
}

void AddressSpace::give_back(std::uint32_t begin, std::uint32_t count) {
    if (count == 0) return;
    auto at = std::ranges::upper_bound(free_, begin, {}, &Range::begin);
    at = free_.insert(at, {begin, count});
    const auto join = [&](auto left) {
        const auto right = left + 1;
        if (right == free_.end() || left->begin + left->count != right->begin) return;
        left->count += right->count;
        free_.erase(right);
    };
    join(at);
    if (at != free_.begin()) join(at - 1);
    if (free_.back().begin + free_.back().count == end_) {
        end_ = free_.back().begin;
        free_.pop_back();
    }
}

}  // namespace weft
