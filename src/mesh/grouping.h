// Groups items by a small integer in linear time. Edges, adjacency and the search for duplicates use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft {

/// The items of group i are `items[offsets[i]] … items[offsets[i+1] - 1]`.
template <class Item>
struct Groups {
    std::vector<std::uint32_t> offsets;
    std::vector<Item> items;
};

/// A stable counting sort. `produce(put)` must call `put(group, item)` once per item. It is called twice, first to
/// count and then to fill, and must make the same calls both times. Fewer than 2³² items.
template <class Item, class Produce>
Groups<Item> group_items(std::uint32_t group_count, Produce&& produce) {
    Groups<Item> groups;
    groups.offsets.assign(std::size_t{group_count} + 1, 0);
    produce([&](std::uint32_t group, const Item&) { ++groups.offsets[std::size_t{group} + 1]; });
    for (std::size_t i = 1; i < groups.offsets.size(); ++i) groups.offsets[i] += groups.offsets[i - 1];
    groups.items.resize(groups.offsets.back());
    std::vector<std::uint32_t> cursor(groups.offsets.begin(), groups.offsets.end() - 1);
    produce([&](std::uint32_t group, const Item& item) { groups.items[cursor[group]++] = item; });
    return groups;
}

}  // namespace weft
