// A check that stb_image 2.27 lacks: for the code tables of a JPEG it writes as many entries as the file states, even
// beyond the end of its buffers.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace weft {

/// The first problem with the segments of a JPEG file or with its code tables; empty if there is none. The content of
/// other segments is left to stb_image.
std::string problem_of_jpeg(std::span<const std::byte> bytes);

}  // namespace weft
