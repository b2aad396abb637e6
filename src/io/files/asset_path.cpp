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

// Those that the user chooses.
std::vector<std::filesystem::path> own_folders(const std::filesystem::path& scene_folder) {
    std::vector<std::filesystem::path> folders{scene_folder};
    if (const char* variable = std::getenv("WEFT_ASSETS")) {
        std::string_view rest = variable;
        while (!rest.empty()) {
            const std::size_t end = rest.find(':');
            if (end != 0) folders.emplace_back(rest.substr(0, end));
            rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        }
    }
    return folders;
}

}  // namespace

Result<std::filesystem::path> find_asset(std::string_view file, const std::filesystem::path& scene_folder) {
    if (file.empty()) return Error{"", "a file name is empty"};
    const std::filesystem::path given(file);
    const auto is_there = [](const std::filesystem::path& path) {
        std::error_code code;
        return std::filesystem::is_regular_file(path, code);
    };
    if (given.is_absolute()) {
        if (is_there(given)) return given;
        return Error{std::string(file), "not found"};
    }
    std::string tried;
    for (const std::filesystem::path& folder : own_folders(scene_folder)) {
        if (is_there(folder / given)) return folder / given;
        tried.append((folder / given).string()).append(", ");
    }
    for (const std::filesystem::path folder : system_folders)
        if (is_there(folder / given)) return folder / given;
    return Error{std::string(file), "not found; tried " + tried +
                                        "and the folders of installed models; put it beside the scene, or its folder "
                                        "into WEFT_ASSETS"};
}

}  // namespace weft
