// How different two pictures look.
#pragma once

#include "base/image.h"

#include <array>
#include <string>
#include <vector>

namespace weft {

/// CIELAB distances (ΔE, 1976) between both pictures, each blurred over 3 by 3 pixels first: noise and the place of an
/// edge within its pixel count little, what an eye sees counts. Pictures that are not opaque are laid on black and on
/// white, and the larger distance counts.
struct PictureDistance {
    std::uint32_t width = 0, height = 0;
    std::vector<float> pixels;
    double mean = 0, worst = 0;  ///< `worst`: one pixel in a hundred is beyond it
};

/// Sizes that differ are as far away as anything can be.
PictureDistance distance_of(const Image8& a, const Image8& b);

/// What golden pictures may differ by. 5 % of brightness, of a picture half as bright as paper, is four times
/// that.
inline constexpr double mean_allowed = 0.25, worst_allowed = 1.5;
inline bool alike(const PictureDistance& d) {
    return d.mean <= mean_allowed && d.worst <= worst_allowed;
}

/// The picture in dim gray, distances from black (none) to red and yellow (10 and more).
Image8 picture_of(const PictureDistance& distance, const Image8& under);

}  // namespace weft
