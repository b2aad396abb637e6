// A priority queue with decreasable keys: it holds every item at most once, even if put() is called repeatedly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

/// pop() returns the item with the lowest key; among equal keys, the lowest item. The order therefore does not depend
/// on how the queue was filled. Each node has four children: the heap is half as deep as with two, and the children
/// share a cache line.
class LowestFirst {
  public:
    struct Entry {
        double key = 0;
        std::uint32_t item = 0;
        friend bool operator<(const Entry& a, const Entry& b) {
            return a.key != b.key ? a.key < b.key : a.item < b.item;
        }
    };

    /// Items are < item_count.
    explicit LowestFirst(std::size_t item_count) : place_(item_count, absent) {}

    bool empty() const { return heap_.empty(); }

    /// Adds an item, or lowers the key of an item that is already in the queue.
    void put(std::uint32_t item, double key) {
        std::uint32_t at = place_[item];
        if (at == absent) {
            at = static_cast<std::uint32_t>(heap_.size());
            heap_.emplace_back();
        }
        const Entry entry{key, item};
        while (at > 0 && entry < heap_[(at - 1) / children]) {
            set(at, heap_[(at - 1) / children]);
            at = (at - 1) / children;
        }
        set(at, entry);
    }

    Entry pop() {
        const Entry lowest = heap_.front(), last = heap_.back();
        place_[lowest.item] = absent;
        heap_.pop_back();
        if (!heap_.empty()) sink(last);
        return lowest;
    }

  private:
    static constexpr std::uint32_t absent = ~std::uint32_t{0};
    static constexpr std::size_t children = 4;

    void set(std::size_t at, const Entry& entry) {
        heap_[at] = entry;
        place_[entry.item] = static_cast<std::uint32_t>(at);
    }
    // Moves the entry down from the root to its position.
    void sink(const Entry& entry) {
        std::size_t at = 0;
        while (true) {
            const std::size_t first = children * at + 1, end = std::min(first + children, heap_.size());
            if (first >= end) break;
            std::size_t least = first;
            for (std::size_t child = first + 1; child < end; ++child) {
                if (heap_[child] < heap_[least]) least = child;
            }
            if (!(heap_[least] < entry)) break;
            set(at, heap_[least]);
            at = least;
        }
        set(at, entry);
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> place_;  // of each item: its index in heap_
};

}  // namespace weft
