// Makes small images of a moving view look better.
#pragma once

#include "base/image.h"

#include <cstdint>

namespace weft::editor {

/// Smooths the steps of edges in an image with one sample per pixel, by FXAA (Lottes 2011). Other pixels keep their
/// values.
Image8 without_steps(const Image8& image);

/// The image in another size, interpolated between its pixels.
Image8 enlarged(const Image8& image, std::uint32_t width, std::uint32_t height);

}  // namespace weft::editor
