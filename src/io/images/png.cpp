// PNG with straight alpha: it is not multiplied into the colors.

#include "io/images/image_file.h"
#include "io/images/picture_format.h"

namespace weft {

Result<void> write_png(const Image8& picture, AtomicFile& file) {
    const Result<std::vector<std::byte>> bytes = png_bytes(picture);
    if (!bytes) return Error{file.path().string(), bytes.error().what, bytes.error().fault};
    return file.write(*bytes);
}

}  // namespace weft
