// Elements that were appended as copies of others.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Appends values of elements that did not exist yet, so that there are `count`: each gets the value of the element
/// that it was copied from. `copied_from` is for the last ones of the `count` elements; an original comes before its
/// copies.
template <class Value>
void append_copies(std::vector<Value>& values, std::span<const std::uint32_t> copied_from, std::size_t count) {
    assert(copied_from.size() <= count && values.size() >= count - copied_from.size());
    const std::size_t first = count - copied_from.size();
    values.reserve(count);
    for (std::size_t i = values.size(); i < count; ++i) values.push_back(values[copied_from[i - first]]);
}

}  // namespace weft
