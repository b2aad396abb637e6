// Barriers between the passes of a frame. All backends use these rules.
#pragma once

#include "solver/plan/pass.h"

#include <vector>

namespace weft {

/// How threads share the items of a pass. This decides which passes can follow one another without a barrier.
enum class Sharing {
    /// Each thread owns the same items in every pass. Passes that access only their own items need no barrier between
    /// them. Neither do passes that run on the same single thread.
    fixed,
    /// Any thread can get any item.
    free,
};

/// Finds the barriers. Call before() for the passes of a frame in order.
class Barriers {
  public:
    explicit Barriers(Sharing sharing) : sharing_(sharing) {}

    /// Whether a barrier is needed before this pass. `single`: one thread runs the whole pass, always the same one.
    bool before(const Pass& pass, bool single = false);

  private:
    struct Touched {
        std::uint32_t array;  ///< an id of the data; see array_of()
        Access access;
        Over over;
        bool single;
    };
    bool conflict(const Touched& earlier, const Touched& later) const;

    Sharing sharing_;
    std::vector<Touched> since_;  ///< since the last barrier
};

}  // namespace weft
