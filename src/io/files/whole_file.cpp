#include "io/files/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace weft {

std::string problem_of_path(const std::filesystem::path& path) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) return "does not exist";
    if (std::filesystem::is_directory(status)) return "is a folder, not a file";
    if (!std::filesystem::is_regular_file(status)) return "is not a regular file";
    return {};
}

Result<std::string> read_whole_file(const std::filesystem::path& path) {
    const std::string file = path.string();
    errno = 0;
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    if (!stream) return Error{file, "cannot be opened: " + std::generic_category().message(errno)};
    std::string content(static_cast<std::size_t>(std::max<std::streamoff>(stream.tellg(), 0)), '\0');
    if (content.empty()) return Error{file, "is empty"};
    stream.seekg(0);
    if (!stream.read(content.data(), static_cast<std::streamsize>(content.size()))) {
        return Error{file, "cannot be read: " + std::generic_category().message(errno)};
    }
    return content;
}

}  // namespace weft
