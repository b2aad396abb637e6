// The layers: a folder includes only folders of lower layers.

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

using Layers = std::map<std::string, std::set<std::string>>;

// What each folder may include besides itself and <weft/...>'s vocabulary (below).
const Layers layers = {
    {"base", {}},
    {"mesh", {"base"}},
    {"physics", {"base", "mesh"}},
    {"collide", {"base", "mesh", "physics"}},
    {"look", {"base"}},
    {"scene", {"base", "mesh", "physics", "look"}},
    {"solver", {"base", "mesh", "physics", "collide", "scene"}},
    {"cpu", {"base", "mesh", "physics", "collide", "scene", "solver"}},
    {"gpu", {"base"}},
    {"vulkan", {"base", "mesh", "physics", "collide", "scene", "solver", "gpu"}},
    {"bodies", {"base", "mesh", "physics", "collide", "scene", "solver"}},
    {"io", {"base", "mesh", "physics", "collide", "scene", "look", "solver"}},
    {"render", {"base", "look", "gpu"}},
    {"view", {"base", "mesh", "physics", "collide", "scene", "look", "solver", "render", "gpu"}},
    {"weft", {"base", "mesh", "physics", "collide", "scene", "look", "solver", "cpu", "gpu", "vulkan", "bodies"}},
    {"validate", {"base", "mesh", "physics", "collide", "scene", "solver", "weft"}},
    {"files", {"base", "mesh", "physics", "collide", "scene", "look", "solver", "cpu", "weft", "io"}},
};

// Public headers that every layer may use; the rest of include/weft is for src/weft, the folders above
// it and the apps.
const std::set<std::string> vocabulary = {"bounds.h", "contact_forces.h", "grab.h",  "ids.h",
                                          "mesh.h",   "result.h",         "scene.h", "vector.h"};

// A library of its own: scene text is read and written without mesh import and exports.
const std::regex scenes_may_include(
    "(base|look|scene|io/scenes|io/files/temporary_folder\\.test\\.h)(/.*)?|"
    "physics/(contact/shapes\\.def|air/winds\\.def)");

// Files that the build generates and that the code of the same folder embeds.
const std::regex made_by_the_build("[a-z_]+_table\\.inc");

// Of physics, the scene knows the parameter tables and the list of constraints, no maths.
const std::regex scene_may_include("physics/(constraints\\.def|contact/shapes\\.def|air/winds\\.def|.*\\.data\\.h)");

bool is_source(const fs::path& path) {
    const std::set<std::string> endings = {".h", ".cpp", ".inl", ".def", ".glsl", ".comp", ".vert", ".frag"};
    return endings.count(path.extension().string()) > 0;
}

std::vector<std::string> violations(const fs::path& source_root) {
    const std::regex quoted("^\\s*#\\s*include\\s+\"([^\"]+)\""), angled("^\\s*#\\s*include\\s+<weft/([^>]+)>");
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(source_root)) {
        if (!entry.is_regular_file() || !is_source(entry.path())) continue;
        const fs::path relative = fs::relative(entry.path(), source_root);
        const std::string folder = relative.begin()->string();
        std::ifstream in(entry.path());
        int number = 0;
        for (std::string line; std::getline(in, line);) {
            ++number;
            const std::string place = relative.string() + ":" + std::to_string(number) + ": ";
            std::smatch match;
            if (std::regex_search(line, match, quoted)) {
                const std::string target = match[1];
                const std::string other = target.substr(0, target.find('/'));
                if (std::regex_match(target, made_by_the_build)) continue;
                if (!layers.count(folder)) {
                    found.push_back(place + "src/" + folder + " has no layer in tests/layers.test.cpp");
                } else if (!layers.count(other)) {
                    found.push_back(place + "\"" + target + "\" is not a path from src/");
                } else if (other != folder && !layers.at(folder).count(other)) {
                    found.push_back(place + folder + " must not include " + other);
                } else if (folder == "scene" && other == "physics" && !std::regex_match(target, scene_may_include)) {
                    found.push_back(place + "scene may know only the tables of physics, not " + target);
                } else if (relative.parent_path() == "io/scenes" && !std::regex_match(target, scenes_may_include)) {
                    found.push_back(place + "io/scenes must not include " + target);
                }
            } else if (std::regex_search(line, match, angled)) {
                const bool above = folder == "weft" || folder == "validate" || folder == "files";
                if (!above && !vocabulary.count(match[1])) {
                    found.push_back(place + "only src/weft, the folders above it and the apps may include <weft/" +
                                    match[1].str() + ">");
                }
            }
        }
    }
    return found;
}

TEST(Layers, no_include_leads_to_a_higher_layer) {
    for (const std::string& violation : violations(fs::path(WEFT_SOURCE_DIR) / "src")) ADD_FAILURE() << violation;
}

TEST(Layers, public_headers_stand_on_the_standard_library_alone) {
    const std::regex any("^\\s*#\\s*include\\s+[<\"]([^>\"]+)[>\"]");
    for (const auto& entry : fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "include" / "weft")) {
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            std::smatch match;
            if (!std::regex_search(line, match, any)) continue;
            const std::string target = match[1];
            const bool standard = target.find('.') == std::string::npos && target.find('/') == std::string::npos;
            const bool vulkan = entry.path().filename() == "vulkan.h" && target == "vulkan/vulkan_core.h";
            EXPECT_TRUE(standard || vulkan || target.rfind("weft/", 0) == 0) << entry.path() << " includes " << target;
        }
    }
}

// Folders of the editor, by what each may include besides src.
TEST(Layers, no_include_of_the_editor_leads_to_a_higher_folder) {
    const Layers folders = {
        {"core", {}}, {"ui", {}}, {"tools", {}}, {"view", {}}, {"app", {"core", "ui", "tools", "view"}}};
    const std::regex quoted("^\\s*#\\s*include\\s+\"editor/([^/]+)/"), cli("^\\s*#\\s*include\\s+\"cli/");
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(WEFT_SOURCE_DIR) / "apps" / "editor")) {
        if (!entry.is_regular_file() || !is_source(entry.path())) continue;
        const std::string folder =
            fs::relative(entry.path(), fs::path(WEFT_SOURCE_DIR) / "apps" / "editor").begin()->string();
        ASSERT_TRUE(folders.count(folder)) << entry.path();
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            std::smatch match;
            EXPECT_FALSE(std::regex_search(line, cli)) << entry.path() << ": " << line;
            if (!std::regex_search(line, match, quoted)) continue;
            EXPECT_TRUE(match[1] == folder || folders.at(folder).count(match[1])) << entry.path() << ": " << line;
        }
    }
}

// Negative control: a forbidden include is found.
TEST(Layers, a_wrong_include_is_found) {
    const fs::path root = fs::temp_directory_path() / ("weft_layers_" + std::to_string(::getpid()));
    fs::create_directories(root / "mesh");
    fs::create_directories(root / "scene");
    std::ofstream(root / "mesh" / "a.h")
        << "#include \"solver/world/world.h\"\n#include \"base/hash.h\"\n#include <weft/simulation.h>\n";
    fs::create_directories(root / "io" / "scenes");
    std::ofstream(root / "io" / "scenes" / "c.h") << "#include \"io/meshes/mesh_file.h\"\n#include \"scene/check.h\"\n";
    std::ofstream(root / "scene" / "b.h") << "#include \"physics/scalar.h\"\n#include \"physics/bend/bend.data.h\"\n";
    EXPECT_EQ(violations(root).size(), 4u);
    fs::remove_all(root);
}

}  // namespace
