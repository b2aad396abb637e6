#include "io/images/image_file.h"

#include "io/files/whole_file.h"
#include "io/images/image_checks.h"

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <utility>

// stb is private to this file. radiance.cpp reads Radiance files, because stb_image 2.27 loops forever on truncated
// ones.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace weft {
namespace {

struct Free {
    void operator()(unsigned char* memory) const { std::free(memory); }
};
using Pixels = std::unique_ptr<unsigned char, Free>;

/// Input callbacks for stb_image. It decodes truncated files of most formats without an error, so this class records
/// when it requests more bytes than there are.
class Source {
  public:
    explicit Source(std::span<const std::byte> bytes) : rest_(bytes) {}

    Pixels decode(int& width, int& height) {
        const stbi_io_callbacks calls{read, skip, ended};
        int channels = 0;
        return Pixels(stbi_load_from_callbacks(&calls, this, &width, &height, &channels, 4));
    }
    bool cut_off() const { return cut_off_; }

  private:
    // stb_image fills a buffer of this size ahead of its needs; bytes in requests of other sizes are always needed.
    static constexpr std::size_t ahead = sizeof(stbi__context::buffer_start);

    static int read(void* user, char* to, int size) {
        Source& self = *static_cast<Source*>(user);
        const auto wanted = static_cast<std::size_t>(std::max(size, 0));
        const std::size_t count = std::min(wanted, self.rest_.size());
        if (count == 0 || (count < wanted && wanted != ahead)) self.cut_off_ = true;
        std::memcpy(to, self.rest_.data(), count);
        self.rest_ = self.rest_.subspan(count);
        return static_cast<int>(count);
    }
    static void skip(void* user, int size) {
        Source& self = *static_cast<Source*>(user);
        const auto wanted = static_cast<std::size_t>(std::max(size, 0));
        if (wanted > self.rest_.size()) self.cut_off_ = true;
        self.rest_ = self.rest_.subspan(std::min(wanted, self.rest_.size()));
    }
    static int ended(void* user) { return static_cast<Source*>(user)->rest_.empty(); }

    std::span<const std::byte> rest_;
    bool cut_off_ = false;
};

/// The reason that stb_image gives, which may contain bytes of the file.
std::string reason() {
    const char* text = stbi_failure_reason();
    std::string printable = text ? text : "unknown";
    for (char& c : printable)
        if (c < ' ' || c > '~') c = '?';
    return printable;
}

bool starts_with(std::span<const std::byte> bytes, std::string_view text) {
    return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

constexpr std::string_view jpeg_signature = "\xff\xd8";

bool has_known_signature(std::span<const std::byte> bytes) {
    return starts_with(bytes, "\x89PNG\r\n\x1a\n") || starts_with(bytes, jpeg_signature) || starts_with(bytes, "BM");
}

template <class Picture, class Decode>
Result<Picture> read(const std::filesystem::path& path, const Decode& decode) {
    const std::string file = path.string();
    try {
        if (std::string problem = problem_of_path(path); !problem.empty()) return Error{file, std::move(problem)};
        const Result<std::string> content = read_whole_file(path);
        if (!content) return content.errors();
        return decode(std::as_bytes(std::span(*content)), file);
    } catch (const std::bad_alloc&) {
        return Error::of_machine(file, "cannot be read: not enough memory");
    }
}

bool is_opaque(const Image8& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != 255) return false;
    return true;
}

std::vector<std::uint8_t> without_alpha(const Image8& image) {
    std::vector<std::uint8_t> colors;
    colors.reserve(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        colors.insert(colors.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                      image.rgba.begin() + static_cast<std::ptrdiff_t>(i + 3));
    return colors;
}

}  // namespace

std::string problem_of_size(std::uint64_t width, std::uint64_t height, const PictureLimits& limits) {
    const std::string size = "is " + std::to_string(width) + " by " + std::to_string(height) + " pixels";
    if (width == 0 || height == 0) return size + "; it must have at least one";
    if (width > limits.side || height > limits.side)
        return size + "; at most " + std::to_string(limits.side) + " per side are read";
    if (width * height > limits.pixels)
        return size + "; at most " + std::to_string(limits.pixels) + " in total are read";
    return {};
}

Result<Image8> decode_image(std::span<const std::byte> bytes, std::string_view name, const PictureLimits& limits) {
    const auto error = [&](std::string what) { return Error{std::string(name), std::move(what)}; };
    if (bytes.empty()) return error("is empty");
    if (starts_with(bytes, "#?")) return error("is a Radiance image (.hdr), not PNG, JPEG, TGA or BMP");
    std::string problem;
    if (starts_with(bytes, jpeg_signature) || starts_with(bytes, "\xff\xff")) problem = problem_of_jpeg(bytes);
    if (!problem.empty()) return error("is damaged: " + problem);
    int width = 0, height = 0, channels = 0;
    // The header is at the front, so it is found even if the size is clamped to INT_MAX.
    const int size = static_cast<int>(std::min<std::size_t>(bytes.size(), INT_MAX));
    if (!stbi_info_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), size, &width, &height, &channels)) {
        return error(has_known_signature(bytes) ? "is damaged: its header cannot be read (" + reason() + ')'
                                                : "is not PNG, JPEG, TGA or BMP");
    }
    problem = problem_of_size(static_cast<std::uint64_t>(std::max(width, 0)),
                              static_cast<std::uint64_t>(std::max(height, 0)), limits);
    if (!problem.empty()) return error(std::move(problem));
    Source source(bytes);
    const Pixels pixels = source.decode(width, height);
    if (source.cut_off()) return error("is cut short: it ends inside the image data");
    if (!pixels) return error("is damaged: " + reason());
    Image8 image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    image.rgba.assign(pixels.get(), pixels.get() + std::size_t{image.width} * image.height * 4);
    return image;
}

Result<Image8> read_image(const std::filesystem::path& path) {
    return read<Image8>(path, [](auto bytes, const std::string& file) { return decode_image(bytes, file); });
}

Result<ImageF> read_hdr(const std::filesystem::path& path) {
    return read<ImageF>(path, [](auto bytes, const std::string& file) { return decode_hdr(bytes, file); });
}

Result<std::vector<std::byte>> png_bytes(const Image8& image) {
    if (std::string problem = problem_of_size(image.width, image.height, {}); !problem.empty()) {
        return Error{"", "an image cannot be written as PNG: it " + problem};
    }
    const std::size_t row = std::size_t{image.width} * 4;
    if (image.rgba.size() != row * image.height) {
        return Error{"", "an image cannot be written as PNG: it has " + std::to_string(image.rgba.size()) +
                             " bytes instead of " + std::to_string(row * image.height)};
    }
    const std::vector<std::uint8_t> colors = is_opaque(image) ? without_alpha(image) : std::vector<std::uint8_t>{};
    const int channels = colors.empty() ? 4 : 3, width = static_cast<int>(image.width);
    int size = 0;
    const Pixels bytes(stbi_write_png_to_mem(colors.empty() ? image.rgba.data() : colors.data(), width * channels,
                                             width, static_cast<int>(image.height), channels, &size));
    if (!bytes || size <= 0) return Error::of_machine("", "an image cannot be written as PNG: not enough memory");
    const auto* first = reinterpret_cast<const std::byte*>(bytes.get());
    return std::vector<std::byte>(first, first + size);
}

}  // namespace weft
