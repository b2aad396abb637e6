// Small images for the tests of the formats.
#pragma once

#include "io/images/picture_writer.h"

#include <filesystem>
#include <vector>

namespace weft::test {

/// Opaque, with different pixels for every number, and hardly compressible.
inline Image8 pattern_picture(std::uint32_t width, std::uint32_t height, int number) {
    Image8 picture{width, height, {}};
    std::uint32_t random = 12345 + static_cast<std::uint32_t>(number);
    for (std::size_t i = 0; i < std::size_t{width} * height * 4; ++i) {
        random = random * 1664525u + 1013904223u;
        picture.rgba.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random >> 24));
    }
    return picture;
}

inline Image8 plain_picture(std::uint32_t width, std::uint32_t height, std::uint8_t red, std::uint8_t green,
                            std::uint8_t blue) {
    Image8 picture{width, height, {}};
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i)
        picture.rgba.insert(picture.rgba.end(), {red, green, blue, 255});
    return picture;
}

/// Calls begin(), writes all images, calls finish().
inline Result<void> write_pictures(const std::filesystem::path& path, const std::vector<Image8>& pictures,
                                   double frame_rate = 30) {
    auto writer = make_picture_writer(path);
    if (!writer) return writer.errors();
    const PictureInfo info{.width = pictures.front().width,
                           .height = pictures.front().height,
                           .frame_rate = frame_rate,
                           .picture_count = pictures.size()};
    if (auto begun = (*writer)->begin(info); !begun) return begun;
    for (const Image8& picture : pictures)
        if (auto written = (*writer)->write(picture); !written) return written;
    return (*writer)->finish();
}

}  // namespace weft::test
