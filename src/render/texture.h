// Creates images that shaders sample.
#pragma once

#include "base/image.h"
#include "gpu/device.h"
#include "gpu/image.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace weft::render {

/// `levels`: each has half the size of the one before; bytes in `format`.
Result<gpu::Image> make_texture(gpu::Device& device, std::uint32_t width, std::uint32_t height, VkFormat format,
                                std::span<const std::vector<std::byte>> levels, const std::string& name);
/// From sRGB-encoded colors, with all smaller levels.
Result<gpu::Image> make_texture(gpu::Device& device, const Image8& image, const std::string& name);
/// In half floats, with one level per image.
Result<gpu::Image> make_texture(gpu::Device& device, std::span<const ImageF> levels, const std::string& name);

/// IEEE 754 binary16, rounded to nearest; too large values become the largest finite one.
std::uint16_t half_float(float value);

}  // namespace weft::render
