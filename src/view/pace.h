// Simulated time beside that of a clock.
#pragma once

#include <algorithm>
#include <cmath>

namespace weft {

/// How many steps are due. Where they take longer than the time that they stand for, the simulation falls behind the
/// clock; it does not run after it with ever more steps at once.
class Pace {
  public:
    /// `most`: steps at once.
    explicit Pace(double step_seconds, unsigned most = 3) : step_(step_seconds), most_(most) {}

    /// `seconds`: on the clock since it was last asked.
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
