// Synchronizes simulated time with a clock.
#pragma once

#include <algorithm>
#include <cmath>

namespace weft {

/// Computes how many steps are due. If steps take longer than the time that they simulate, the simulation falls behind
/// the clock. It does not catch up with more and more steps at once.
class Pace {
  public:
    /// `most`: largest number of steps at once.
    explicit Pace(double step_seconds, unsigned most = 3) : step_(step_seconds), most_(most) {}

    /// `seconds`: clock time since the previous call.
    unsigned due(double seconds) {
        owed_ += std::max(0.0, seconds) / step_;
        const double whole = std::floor(owed_ + 1e-9);
        owed_ -= whole;
        return static_cast<unsigned>(std::min(whole, static_cast<double>(most_)));
    }

  private:
    double step_;  // s
    unsigned most_;
    double owed_ = 0;  // steps
};

}  // namespace weft
