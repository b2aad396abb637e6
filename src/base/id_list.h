// A contiguous list of values with ids, in the order in which they were added.
#pragma once

#include <weft/ids.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace weft {

template <class T, class Tag>
class IdList {
  public:
    Id<Tag> add(T value) {
        std::uint32_t slot = static_cast<std::uint32_t>(slots_.size());
        const auto free = std::ranges::find(slots_, none, &Slot::place);
        if (free == slots_.end()) {
            slots_.push_back({});
        } else {
            slot = static_cast<std::uint32_t>(free - slots_.begin());
        }
        slots_[slot].place = static_cast<std::uint32_t>(values_.size());
        slots_[slot].generation += 1;
        values_.push_back(std::move(value));
        owners_.push_back(slot);
        return {slot, slots_[slot].generation};
    }

    /// Index of the value in the list, or size() if the id is invalid or its value was removed.
    std::size_t find(Id<Tag> id) const {
        if (id.index >= slots_.size() || slots_[id.index].generation != id.generation) return size();
        return slots_[id.index].place == none ? size() : slots_[id.index].place;
    }
    bool contains(Id<Tag> id) const { return find(id) < size(); }

    /// Moves the values after it down by one index. The id must be valid.
    void remove(Id<Tag> id) {
        const std::size_t place = find(id);
        assert(place < size());
        values_.erase(values_.begin() + static_cast<std::ptrdiff_t>(place));
        owners_.erase(owners_.begin() + static_cast<std::ptrdiff_t>(place));
        slots_[id.index].place = none;
        for (std::size_t i = place; i < owners_.size(); ++i) slots_[owners_[i]].place = static_cast<std::uint32_t>(i);
    }

    /// Orders the values. `order`: all ids of the list, each once.
    void reorder(std::span<const Id<Tag>> order) {
        assert(order.size() == size());
        std::vector<T> values;
        std::vector<std::uint32_t> owners;
        for (const Id<Tag> id : order) {
            values.push_back(std::move(values_[find(id)]));
            owners.push_back(id.index);
        }
        values_ = std::move(values);
        owners_ = std::move(owners);
        for (std::size_t i = 0; i < owners_.size(); ++i) slots_[owners_[i]].place = static_cast<std::uint32_t>(i);
    }

    Id<Tag> id_of(std::size_t place) const { return {owners_[place], slots_[owners_[place]].generation}; }
    std::size_t size() const { return values_.size(); }
    bool empty() const { return values_.empty(); }
    T& operator[](std::size_t place) { return values_[place]; }
    const T& operator[](std::size_t place) const { return values_[place]; }
    const std::vector<T>& values() const { return values_; }
    auto begin() { return values_.begin(); }
    auto end() { return values_.end(); }
    auto begin() const { return values_.begin(); }
    auto end() const { return values_.end(); }

  private:
    static constexpr std::uint32_t none = ~0u;
    struct Slot {
        std::uint32_t place = none, generation = 0;
    };
    std::vector<T> values_;
    std::vector<std::uint32_t> owners_;  // place -> slot
    std::vector<Slot> slots_;
};

}  // namespace weft
