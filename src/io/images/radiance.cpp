// Radiance images: four bytes per pixel, three mantissas and a shared exponent (Ward 1991, "Real Pixels"), run-length
// encoded. The format: radsite.lbl.gov/radiance/refer/filefmts.pdf.
#include "io/images/image_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <utility>

namespace weft {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

// Scanlines of these lengths may be packed channel by channel.
constexpr std::uint32_t shortest_packed = 8, longest_packed = 0x7fff;

class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    /// The next byte; 0 after the end, and then cut_off() is true.
    std::uint8_t next() {
        if (rest_.empty()) {
            cut_off_ = true;
            return 0;
        }
        const auto byte = static_cast<std::uint8_t>(rest_.front());
        rest_ = rest_.subspan(1);
        return byte;
    }
    Pixel pixel() {
        Pixel pixel;
        for (std::uint8_t& byte : pixel) byte = next();
        return pixel;
    }
    std::string line() {
        std::string text;
        while (!rest_.empty()) {
            const char c = static_cast<char>(next());
            if (c == '\n') return text;
            text += c;
        }
        cut_off_ = true;
        return text;
    }
    bool cut_off() const { return cut_off_; }
    std::size_t left() const { return rest_.size(); }

  private:
    std::span<const std::byte> rest_;
    bool cut_off_ = false;
};

struct Size {
    std::uint32_t width = 0, height = 0;
};

/// The size from a line such as `-Y 512 +X 1024`: rows from the top, each from the left. Nothing for other orders.
std::optional<Size> size_in(std::string_view line) {
    const auto number = [&](std::string_view before) -> std::optional<std::uint32_t> {
        if (!line.starts_with(before)) return {};
        line.remove_prefix(before.size());
        std::uint32_t value = 0;
        const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), value);
        if (problem != std::errc()) return {};
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        return value;
    };
    const auto height = number("-Y "), width = number(" +X ");
    if (!height || !width || !line.empty()) return {};
    return Size{*width, *height};
}

/// Unpacks each channel separately: a count above 128 repeats one byte, a lower one is followed by that many bytes.
bool unpack_channels(ByteReader& in, std::span<Pixel> row) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t code = in.next();
            const std::size_t count = code > 128 ? code - 128u : code;
            if (count == 0 || count > row.size() - x) return false;
            const std::uint8_t repeated = code > 128 ? in.next() : std::uint8_t{0};
            for (std::size_t end = x + count; x < end; ++x) row[x][channel] = code > 128 ? repeated : in.next();
        }
    }
    return true;
}

/// Unpacks whole pixels: a pixel of 1, 1, 1 repeats the one before it; consecutive ones add higher digits of the count.
bool unpack_pixels(ByteReader& in, Pixel first, std::span<Pixel> row) {
    unsigned shift = 0;
    Pixel pixel = first;
    for (std::size_t x = 0; x < row.size(); pixel = in.pixel()) {
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            row[x++] = pixel;
            shift = 0;
        } else {
            const std::size_t count = shift < 24 ? std::size_t{pixel[3]} << shift : 0;
            if (x == 0 || count == 0 || count > row.size() - x) return false;
            for (std::size_t end = x + count; x < end; ++x) row[x] = row[x - 1];
            shift += 8;
        }
        if (x == row.size()) return true;
    }
    return true;
}

bool unpack_row(ByteReader& in, std::span<Pixel> row) {
    const Pixel first = in.pixel();
    if (row.size() < shortest_packed || row.size() > longest_packed || first[0] != 2 || first[1] != 2 ||
        first[2] >= 128) {
        return unpack_pixels(in, first, row);
    }
    return first[2] * 256u + first[3] == row.size() && unpack_channels(in, row);
}

struct Header {
    bool known = true;  ///< whether the format is supported
    std::string size;
};

Header read_header(ByteReader& in) {
    Header header;
    for (std::string line = in.line(); !line.empty() && !in.cut_off(); line = in.line()) {
        if (line.starts_with("FORMAT=")) header.known = line == "FORMAT=32-bit_rle_rgbe";
    }
    header.size = in.line();
    return header;
}

}  // namespace

Result<ImageF> decode_hdr(std::span<const std::byte> bytes, std::string_view name, const PictureLimits& limits) {
    const auto error = [&](std::string what) { return Error{std::string(name), std::move(what)}; };
    const std::string cut_off = "is cut short: it ends inside the image data";
    if (bytes.empty()) return error("is empty");
    if (bytes.size() < 2 || bytes[0] != std::byte{'#'} || bytes[1] != std::byte{'?'}) {
        return error("is not a Radiance image (.hdr)");
    }
    ByteReader in(bytes);
    const Header header = read_header(in);
    if (in.cut_off()) return error(cut_off);
    if (!header.known) return error("is not of the format 32-bit_rle_rgbe");
    const std::optional<Size> size = size_in(header.size);
    if (!size) return error("must give its size as `-Y height +X width` after its header");
    if (std::string problem = problem_of_size(size->width, size->height, limits); !problem.empty()) {
        return error(std::move(problem));
    }
    // A row takes at least four bytes: a file that is much too short fails here, before memory is allocated.
    if (in.left() / 4 < size->height) return error(cut_off);

    ImageF image{size->width, size->height, std::vector<float>(std::size_t{size->width} * size->height * 4)};
    std::vector<Pixel> row(size->width);
    for (std::uint32_t y = 0; y < size->height; ++y) {
        const bool sound = unpack_row(in, row);
        if (in.cut_off()) return error(cut_off);
        if (!sound) return error("is damaged: row " + std::to_string(y) + " is longer or shorter than the others");
        for (std::uint32_t x = 0; x < size->width; ++x) {
            const Pixel& pixel = row[x];
            const float scale = pixel[3] == 0 ? 0 : std::ldexp(1.0f, pixel[3] - (128 + 8));
            float* to = image.at(x, y);
            for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<float>(pixel[c]) * scale;
            to[3] = 1;
        }
    }
    return image;
}

}  // namespace weft
