// Pictures that shaders sample, brought to the device.
#pragma once

#include "base/image.h"
#include "gpu/device.h"
#include "gpu/image.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace weft::render {

/// One level after another, each of half the size of the one before; bytes as `format` has them.
Result<gpu::Image> make_texture(gpu::Device& device, std::uint32_t width, std::uint32_t height, VkFormat format,
                                std::span<const std::vector<std::byte>> levels, const std::string& name);
/// Of colors as sRGB encodes them, with all smaller levels.
Result<gpu::Image> make_texture(gpu::Device& device, const Image8& image, const std::string& name);
/// In half floats, as many levels as there are pictures.
Result<gpu::Image> make_texture(gpu::Device& device, std::span<const ImageF> levels, const std::string& name);

/// IEEE 754 binary16, rounded to nearest; what is too large becomes the largest there is.
std::uint16_t half_float(float value);

}  // namespace weft::render
