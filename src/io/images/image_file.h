// Pictures from files and to bytes.
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

/// The largest picture that is read: known from its header, before anything is decoded.
struct PictureLimits {
    std::uint32_t side = 16384;
    std::uint64_t pixels = std::uint64_t{1} << 27;  ///< half a gigabyte of an Image8
};

/// Reads PNG, JPEG, TGA and BMP as eight bits a channel, whatever the file has; without alpha, all of it is opaque.
/// Fails, naming the file, on one that is missing, not a file, empty, cut off, damaged, of another format, or too
/// large.
Result<Image8> read_image(const std::filesystem::path& path);
/// Reads Radiance .hdr, upright ones of up to 2²⁶ pixels, as their numbers are: `EXPOSURE` is not taken back. Fails as
/// read_image does.
Result<ImageF> read_hdr(const std::filesystem::path& path);

/// The same from bytes; `name` is what errors call them.
Result<Image8> decode_image(std::span<const std::byte> bytes, std::string_view name, const PictureLimits& limits = {});
inline constexpr PictureLimits hdr_limits{.pixels = std::uint64_t{1} << 26};
Result<ImageF> decode_hdr(std::span<const std::byte> bytes, std::string_view name,
                          const PictureLimits& limits = hdr_limits);

/// As a PNG, the same bytes for the same picture; without an alpha where all of it is opaque. Fails on a picture
/// without pixels and on one beyond PictureLimits.
Result<std::vector<std::byte>> png_bytes(const Image8& image);

/// Empty if a picture of that size may be read.
std::string problem_of_size(std::uint64_t width, std::uint64_t height, const PictureLimits& limits);

}  // namespace weft
