#include "io/files/file_pattern.h"

#include <algorithm>
#include <cctype>

namespace weft {

std::string FilePattern::name(std::uint64_t number) const {
    std::string digits = std::to_string(number);
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    return before + digits + after;
}

bool has_pattern(const std::filesystem::path& path) {
    return path.filename().string().find('%') != std::string::npos;
}

std::optional<FilePattern> parse_pattern(const std::string& file_name) {
    const std::size_t percent = file_name.find('%');
    if (percent == std::string::npos || file_name.find('%', percent + 1) != std::string::npos) return std::nullopt;
    std::size_t at = percent + 1;
    FilePattern pattern{.before = file_name.substr(0, percent), .after = {}, .width = 0};
    if (at < file_name.size() && file_name[at] == '0') {
        const std::size_t first = ++at;
        while (at < file_name.size() && std::isdigit(static_cast<unsigned char>(file_name[at]))) ++at;
        const std::string width = file_name.substr(first, at - first);
        // One digit: a width of nine covers a billion frames, so more digits are a typing error.
        if (width.size() != 1 || width == "0") return std::nullopt;
        pattern.width = static_cast<std::size_t>(width.front() - '0');
    }
    if (at >= file_name.size() || file_name[at] != 'd') return std::nullopt;
    pattern.after = file_name.substr(at + 1);
    return pattern;
}

std::string ending_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

Error unknown_ending(const std::filesystem::path& path, const std::string& known) {
    const std::string ending = ending_of(path);
    const std::string problem = ending.empty() ? "has no ending" : "unknown ending \"" + ending + "\"";
    return {path.string(), problem + "; " + known};
}

}  // namespace weft
