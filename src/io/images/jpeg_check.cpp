#include "io/images/image_checks.h"

#include <cstdint>

namespace weft {
namespace {

// ITU T.81, table B.1.
constexpr std::uint8_t start_of_image = 0xd8, end_of_image = 0xd9, code_tables = 0xc4, start_of_scan = 0xda;
constexpr std::uint8_t first_restart = 0xd0, last_restart = 0xd7;

// A code table: its number, how many codes of each length there are, and a value for each code (T.81, B.2.4.2).
constexpr std::size_t code_lengths = 16, most_codes = 256;

using Bytes = std::span<const std::byte>;

std::uint8_t at(Bytes bytes, std::size_t place) {
    return std::to_integer<std::uint8_t>(bytes[place]);
}

std::string problem_of_codes(Bytes segment) {
    while (!segment.empty()) {
        if (segment.size() < 1 + code_lengths) return "a code table is cut off";
        std::size_t codes = 0;
        for (std::size_t i = 1; i <= code_lengths; ++i) codes += at(segment, i);
        if (codes > most_codes) return "a code table has " + std::to_string(codes) + " codes, at most 256 are possible";
        if (segment.size() < 1 + code_lengths + codes) return "a code table is cut off";
        segment = segment.subspan(1 + code_lengths + codes);
    }
    return {};
}

/// The position after the codes of a scan: the first marker that is neither a stuffed zero nor a restart.
std::size_t end_of_scan(Bytes bytes, std::size_t place) {
    for (; place + 1 < bytes.size(); ++place) {
        if (at(bytes, place) != 0xff) continue;
        const std::uint8_t next = at(bytes, place + 1);
        const bool restart = next >= first_restart && next <= last_restart;
        if (next != 0 && next != 0xff && !restart) return place;
    }
    return bytes.size();
}

}  // namespace

std::string problem_of_jpeg(Bytes bytes) {
    if (bytes.size() < 2 || at(bytes, 0) != 0xff || at(bytes, 1) != start_of_image)
        return "it does not start as a JPEG";
    std::size_t place = 2;
    while (place < bytes.size()) {
        if (at(bytes, place) != 0xff) return "it has bytes between its segments";
        while (place < bytes.size() && at(bytes, place) == 0xff) ++place;
        if (place == bytes.size()) break;
        const std::uint8_t marker = at(bytes, place++);
        if (marker == end_of_image) return {};
        if (bytes.size() - place < 2) break;
        const std::size_t length = at(bytes, place) * std::size_t{256} + at(bytes, place + 1);
        if (length < 2) return "a segment has no length";
        if (length > bytes.size() - place) break;
        if (marker == code_tables) {
            if (std::string problem = problem_of_codes(bytes.subspan(place + 2, length - 2)); !problem.empty()) {
                return problem;
            }
        }
        place += length;
        if (marker == start_of_scan) place = end_of_scan(bytes, place);
    }
    return "it ends inside the image data";
}

}  // namespace weft
