// Where the passes of a frame must wait for one another. The only place that knows; every backend asks here.
#pragma once

#include "solver/plan/pass.h"

#include <vector>

namespace weft {

/// How passes share work, which decides what may run without a barrier between.
enum class Sharing {
    /// Each thread owns the same items in every pass, so a pass that touches its own items alone may follow another
    /// such pass at once. A pass of a single thread may follow another one of that thread.
    fixed,
    /// Any thread may get any item.
    free,
};

/// Goes through a frame's passes in order.
class Barriers {
  public:
    explicit Barriers(Sharing sharing) : sharing_(sharing) {}

    /// Whether all threads must be done with what came before when this pass begins. `single`: one thread does all of
    /// it, always the same one.
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
