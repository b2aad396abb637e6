// PNG, alpha as it is: not multiplied into the colors. A picture without transparency has none in the file.

#include "io/picture_format.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace weft {

Result<Done> write_png(const Image8& picture, AtomicFile& file) {
    bool opaque = true;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) opaque = opaque && picture.rgba[i] == 255;
    const int channels = opaque ? 3 : 4;
    std::vector<std::uint8_t> colors;
    if (opaque) {
        colors.reserve(picture.rgba.size() / 4 * 3);
        for (std::size_t i = 0; i < picture.rgba.size(); ++i)
            if (i % 4 != 3) colors.push_back(picture.rgba[i]);
    }
    const std::vector<std::uint8_t>& pixels = opaque ? colors : picture.rgba;
    const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);

    std::vector<std::byte> bytes;
    const auto append = [](void* to, void* data, int size) {
        const auto* first = static_cast<const std::byte*>(data);
        static_cast<std::vector<std::byte>*>(to)->assign(first, first + size);
    };
    if (!stbi_write_png_to_func(append, &bytes, width, height, channels, pixels.data(), width * channels))
        return Error::of_machine(file.path().string(), "there is no memory for the picture");
    return file.write(bytes);
}

}  // namespace weft
