// Images in memory, rows from the top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

/// Eight bits per channel: red, green, blue, alpha. Colors are sRGB-encoded and not premultiplied by alpha. An image
/// that does not hold colors (a normal map) holds plain values.
struct Image8 {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba = {};

    std::uint8_t* at(std::uint32_t x, std::uint32_t y) { return &rgba[(std::size_t{y} * width + x) * 4]; }
    const std::uint8_t* at(std::uint32_t x, std::uint32_t y) const { return &rgba[(std::size_t{y} * width + x) * 4]; }
};

/// Linear light, red, green, blue, alpha.
struct ImageF {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba = {};

    float* at(std::uint32_t x, std::uint32_t y) { return &rgba[(std::size_t{y} * width + x) * 4]; }
    const float* at(std::uint32_t x, std::uint32_t y) const { return &rgba[(std::size_t{y} * width + x) * 4]; }
};

}  // namespace weft
