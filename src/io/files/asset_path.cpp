#include "io/meshes/mesh_file.h"

#include <array>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

namespace weft {
namespace {

constexpr std::array system_folders{
    "/usr/share/glmark2/models",       // glmark2-data: the Stanford bunny, a horse, a cat
    "/usr/share/assimp/models/OBJ",    // assimp-testmodels, one folder per format
    "/usr/share/assimp/models/PLY",    //
    "/usr/share/assimp/models/glTF2",  //
    "/usr/share/assimp/models/FBX",    //
    "/usr/share/assimp/models/STL",    //
    "/usr/share/assimp/models/3DS",    //
};

std::vector<std::filesystem::path> folders_to_search(const std::filesystem::path& scene_folder) {
    std::vector<std::filesystem::path> folders{scene_folder};
    if (const char* variable = std::getenv("WEFT_ASSETS")) {
        std::string_view rest = variable;
        while (!rest.empty()) {
            const std::size_t end = rest.find(':');
            if (end != 0) folders.emplace_back(rest.substr(0, end));
            rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        }
    }
    folders.insert(folders.end(), system_folders.begin(), system_folders.end());
    return folders;
}

}  // namespace

Result<std::filesystem::path> find_asset(std::string_view file, const std::filesystem::path& scene_folder) {
    if (file.empty()) return Error{"", "a file name is empty"};
    const std::filesystem::path given(file);
    std::vector<std::filesystem::path> candidates;
    if (given.is_absolute()) {
        candidates.push_back(given);
    } else {
        for (const std::filesystem::path& folder : folders_to_search(scene_folder)) {
            candidates.push_back(folder / given);
        }
    }
    std::string tried;
    for (const std::filesystem::path& candidate : candidates) {
        std::error_code code;
        if (std::filesystem::is_regular_file(candidate, code)) return candidate;
        tried.append(tried.empty() ? "" : ", ").append(candidate.string());
    }
    return Error{std::string(file), "not found; tried " + tried};
}

}  // namespace weft
