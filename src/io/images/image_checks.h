// What stb_image 2.27 does not check: of the code tables of a JPEG it writes as many entries as the file says, which is
// more than it has room for.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace weft {

/// The first problem with the segments of a JPEG file and with its code tables; empty if none. What is inside of other
/// segments is left to stb_image.
std::string problem_of_jpeg(std::span<const std::byte> bytes);

}  // namespace weft
