// The perceived difference of two images.
#pragma once

#include "base/image.h"

#include <array>
#include <string>
#include <vector>

namespace weft {

/// CIELAB distances (ΔE, 1976) between two images. Both are blurred over 3 by 3 pixels first, so that noise and the
/// position of an edge within its pixel count little. Images with transparency are compared on black and on white, and
/// the larger distance counts.
struct PictureDistance {
    std::uint32_t width = 0, height = 0;
    std::vector<float> pixels;
    double mean = 0, worst = 0;  ///< `worst`: one pixel in a hundred is beyond it
};

/// Images of different sizes have the largest distance.
PictureDistance distance_of(const Image8& a, const Image8& b);

/// Tolerance for golden images. A change of brightness by 5 % is four times as much, in an image half as bright as
/// paper.
inline constexpr double mean_allowed = 0.25, worst_allowed = 1.5;
inline bool alike(const PictureDistance& d) {
    return d.mean <= mean_allowed && d.worst <= worst_allowed;
}

/// The image in dim gray, with distances from black (0) over red to yellow (10 and more).
Image8 picture_of(const PictureDistance& distance, const Image8& under);

}  // namespace weft
