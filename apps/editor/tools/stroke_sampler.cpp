#include "editor/tools/stroke_sampler.h"

#include <algorithm>

namespace weft::editor {

std::vector<Vec2> StrokeSampler::add(Vec2 pointer) {
    if (!finite(pointer)) return {};
    const Double2 to = exact(pointer);
    if (!last_) {
        last_ = to, left_ = spacing_;
        return {pointer};
    }
    std::vector<Vec2> points;
    const double way = length(to - *last_);
    constexpr double most_points = 10000;
    const double spacing = std::max(spacing_, way / most_points);
    double at = left_;
    for (; at <= way; at += spacing) points.push_back(rounded(*last_ + (to - *last_) * (at / way)));
    left_ = at - way, last_ = to;
    return points;
}

}  // namespace weft::editor
