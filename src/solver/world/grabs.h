// The grabs of a world. Ids are never used again, and a restored state has the ids that it was saved with.
#pragma once

#include "solver/state/grab.h"

#include <weft/ids.h>

#include <algorithm>
#include <cassert>
#include <vector>

namespace weft {

struct Grab {
    GrabId id;
    ClothId cloth;
    GrabStep step;  ///< of the next frame
    Vec3 force;     ///< N, in the last frame
};

class Grabs {
  public:
    GrabId add(ClothId cloth, const GrabStep& step) {
        restore({.id = {next_, 1}, .cloth = cloth, .step = step, .force = {}});
        return all_.back().id;
    }
    /// Adds a grab under the id that it has.
    void restore(const Grab& grab) {
        next_ = std::max(next_, grab.id.index + 1);
        all_.push_back(grab);
    }
    template <class Predicate>
    void remove_if(Predicate&& predicate) {
        std::erase_if(all_, predicate);
    }
    bool contains(GrabId id) const { return std::ranges::find(all_, id, &Grab::id) != all_.end(); }
    Grab& operator[](GrabId id) {
        const auto grab = std::ranges::find(all_, id, &Grab::id);
        assert(grab != all_.end());
        return *grab;
    }
    const Grab& operator[](GrabId id) const { return const_cast<Grabs&>(*this)[id]; }
    bool empty() const { return all_.empty(); }
    std::size_t size() const { return all_.size(); }
    auto begin() { return all_.begin(); }
    auto end() { return all_.end(); }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }

  private:
    std::vector<Grab> all_;  ///< in the order in which they were added
    std::uint32_t next_ = 0;
};

}  // namespace weft
