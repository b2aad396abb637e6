#include "io/files/overwriting.h"

#include "io/files/atomic_file.h"
#include "io/files/file_pattern.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace weft {
namespace fs = std::filesystem;
namespace {

bool is_number(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// Of a pattern: whether the input has a name that the pattern can produce, in the same folder.
bool overwrites(const fs::path& output, const fs::path& input) {
    if (!has_pattern(output)) return same_file(output, input);
    const auto pattern = parse_pattern(output.filename().string());
    const std::string name = input.filename().string();
    if (!pattern || !same_file(folder_of(output), folder_of(input))) return false;
    const std::size_t around = pattern->before.size() + pattern->after.size();
    return name.size() > around && name.starts_with(pattern->before) && name.ends_with(pattern->after) &&
           is_number(std::string_view(name).substr(pattern->before.size(), name.size() - around));
}

}  // namespace

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) && !error;
}

Errors overwritten_inputs(std::span<const fs::path> outputs, std::span<const fs::path> inputs) {
    Errors errors;
    for (const fs::path& input : inputs)
        for (const fs::path& output : outputs)
            if (overwrites(output, input))
                errors.push_back({output.string(), "would overwrite " + input.string() +
                                                       ", which the scene reads; choose another name"});
    return errors;
}

}  // namespace weft
