// Even points along the way of the pointer: a fast stroke has no gaps, and its points do not depend on how often the
// pointer was read along a straight way.
#pragma once

#include "editor/tools/double3.h"

#include <optional>
#include <vector>

namespace weft::editor {

class StrokeSampler {
  public:
    /// Pixels between two points, > 0.
    explicit StrokeSampler(double spacing) : spacing_(spacing > 0.01 ? spacing : 0.01) {}

    /// The points up to where the pointer is now; the first pointer is the first point. A pointer that is not finite is
    /// left out.
    std::vector<Vec2> add(Vec2 pointer);

  private:
    double spacing_;
    double left_ = 0;  // pixels from the last pointer to the next point
    std::optional<Double2> last_;
};

}  // namespace weft::editor
