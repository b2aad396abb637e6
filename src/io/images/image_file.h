// Reads images from files and encodes them as bytes.
#pragma once

#include "base/image.h"

#include <weft/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Limits for images that are read, checked in the header before decoding.
struct PictureLimits {
    std::uint32_t side = 16384;
    std::uint64_t pixels = std::uint64_t{1} << 27;  ///< half a gigabyte as an Image8
};

/// Reads PNG, JPEG, TGA and BMP as eight bits per channel, whatever the file has; without alpha the image is opaque.
/// Fails, naming the file, if it is missing, not a file, empty, truncated, damaged, of another format, or too large.
Result<Image8> read_image(const std::filesystem::path& path);
/// Reads upright Radiance .hdr images of up to 2²⁶ pixels. The values are those in the file: `EXPOSURE` is not undone.
/// Fails as read_image does.
Result<ImageF> read_hdr(const std::filesystem::path& path);

/// The same from bytes; `name` is the name in error messages.
Result<Image8> decode_image(std::span<const std::byte> bytes, std::string_view name, const PictureLimits& limits = {});
inline constexpr PictureLimits hdr_limits{.pixels = std::uint64_t{1} << 26};
Result<ImageF> decode_hdr(std::span<const std::byte> bytes, std::string_view name,
                          const PictureLimits& limits = hdr_limits);

/// Encodes a PNG; the same image gives the same bytes. Opaque images are written without alpha. Fails on an image
/// without pixels or beyond PictureLimits.
Result<std::vector<std::byte>> png_bytes(const Image8& image);

/// Empty if an image of that size is within the limits.
std::string problem_of_size(std::uint64_t width, std::uint64_t height, const PictureLimits& limits);

}  // namespace weft
