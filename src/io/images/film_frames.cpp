#include "io/images/film_frames.h"

#include <cmath>

namespace weft {

FilmFrames::FilmFrames(std::uint64_t frames, double frame_rate, double film_rate) : step_(frame_rate / film_rate) {
    constexpr double rounding = 1e-6;  // a hundred steps of 1.2 must give 120
    count_ = static_cast<std::uint64_t>(std::floor(static_cast<double>(frames) / step_ + rounding)) + 1;
}

std::uint64_t FilmFrames::frame(std::uint64_t picture) const {
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(picture) * step_));
}

}  // namespace weft
