#include "editor/view/view_quality.h"

namespace weft::editor {
namespace {

// The next better quality must be expected to take at most this part of the target, for so many images in a row.
// Otherwise the size would alternate.
constexpr double reserve = 0.8;
constexpr int patience = 6;

double pixels_of(std::size_t quality) {
    const double side = qualities[quality].percent / 100.0;
    return side * side;
}

}  // namespace

double ViewQuality::expected(double ms, std::size_t quality) const {
    if (!qualities[quality].draft) return best_ms_ < 0 ? target_ms_ * 1e3 : best_ms_;
    return ms * pixels_of(quality) / pixels_of(at_);
}

void ViewQuality::took(double ms) {
    if (!qualities[at_].draft) best_ms_ = ms;
    if (ms > target_ms_) {
        fast_ = 0;
        // At least one step; more if it is clear that one is not enough. A draft may be any amount cheaper.
        std::size_t next = at_ + 1;
        while (qualities[at_].draft && next + 1 < qualities.size() && expected(ms, next) > target_ms_) ++next;
        if (next < qualities.size()) at_ = next;
        return;
    }
    if (at_ == 0) return;
    fast_ = expected(ms, at_ - 1) <= reserve * target_ms_ ? fast_ + 1 : 0;
    if (fast_ < patience) return;
    fast_ = 0;
    --at_;
}

void ViewQuality::best_took(double ms) {
    best_ms_ = ms;
}

}  // namespace weft::editor
