// Heights on a square grid, from which a Relief is made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::weaves {

/// Lengths are in thread spacings. Sample (x, y) is at u = (x + ½) step, v = (y + ½) step; the grid repeats.
struct Heights {
    std::uint32_t side = 0;      ///< samples
    std::uint32_t spacings = 0;  ///< threads per side
    std::vector<float> height, warp;

    Heights(std::uint32_t samples, std::uint32_t threads)
        : side(samples),
          spacings(threads),
          height(std::size_t{samples} * samples),
          warp(std::size_t{samples} * samples, 1.0f) {}
    float step() const { return static_cast<float>(spacings) / static_cast<float>(side); }
};

/// Two sets of threads that cross.
Heights plain(std::uint32_t side);
/// Warp over three, under one, shifted by one in each row.
Heights twill(std::uint32_t side);
/// Warp over seven, under one, shifted by three.
Heights satin(std::uint32_t side);
/// Wales along u: the face of jersey.
Heights knit(std::uint32_t side);
/// Two wales of face, raised above two wales of back.
Heights rib(std::uint32_t side);
/// Cushions with creases between them.
Heights grain(std::uint32_t side);

}  // namespace weft::weaves
