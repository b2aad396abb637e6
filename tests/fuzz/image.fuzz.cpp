// Reads any bytes as an image: the result is a readable error, or an image that is the same after writing and reading.
//
// The first byte chooses: 'h' reads the rest as Radiance, any other as PNG, JPEG, TGA or BMP.
#include "io/images/image_file.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace weft;

// Large enough for every path through a decoder, and small enough for thousands of inputs per second.
constexpr PictureLimits limits{.side = 512, .pixels = 1 << 14};

void require(bool targets, const char* what) {
    if (targets) return;
    std::fprintf(stderr, "image fuzzer: %s\n", what);
    std::abort();
}

void require_readable(const Errors& errors) {
    require(!errors.empty(), "refused without an error");
    for (const Error& error : errors) {
        require(error.where == "fuzz", "an error that does not name the file");
        require(!error.what.empty(), "an error that says nothing");
        require(error.message().find('\n') == std::string::npos, "an error of several lines");
    }
}

template <class Picture>
void require_whole(const Picture& picture) {
    require(picture.width > 0 && picture.height > 0, "a picture without pixels");
    require(picture.width <= limits.side && picture.height <= limits.side, "a picture beyond the limits");
    require(picture.rgba.size() == std::size_t{picture.width} * picture.height * 4, "a picture of another size");
}

void try_hdr(std::span<const std::byte> bytes) {
    const Result<ImageF> picture = decode_hdr(bytes, "fuzz", limits);
    if (!picture) return require_readable(picture.errors());
    require_whole(*picture);
    for (const float value : picture->rgba) require(std::isfinite(value) && value >= 0, "light that is no number");
}

void try_image(std::span<const std::byte> bytes) {
    const Result<Image8> picture = decode_image(bytes, "fuzz", limits);
    if (!picture) return require_readable(picture.errors());
    require_whole(*picture);
    const auto png = png_bytes(*picture);
    require(png.ok(), "what was read cannot be written");
    const Result<Image8> again = decode_image(*png, "fuzz", limits);
    require(again.ok() && again->rgba == picture->rgba, "what was written is read otherwise");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    if (size == 0) return 0;
    if (data[0] == 'h') {
        try_hdr(bytes.subspan(1));
    } else {
        try_image(bytes.subspan(1));
    }
    return 0;
}
