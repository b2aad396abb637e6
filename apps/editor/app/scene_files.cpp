#include "editor/app/scene_files.h"

#include "io/files/atomic_file.h"
#include "io/scenes/scene_file.h"
#include "io/scenes/scene_writer.h"

#include <algorithm>
#include <cassert>

namespace weft::editor {
namespace {

constexpr const char* first_scene = R"({
    "weft": 1,
    "name": "silk over a ball",
    "air": {"wind": [{"velocity": [0.4, 0, 0.2], "gust": {"amplitude": 0.8, "frequency": 0.4},
                      "turbulence": {"strength": 0.5, "scale": 0.6}}]},
    "cloths": [{"name": "sheet", "mesh": {"grid": {"size": [1.3, 1.3], "resolution": [64, 64]}},
                "transform": {"position": [0, 0.95, 0]}, "fabric": {"preset": "silk", "friction": [0.9, 0.8]}, "material": "silk",
                "self_collision": "fast", "tearing": "cuts"}],
    "colliders": [{"name": "floor", "plane": {}},
                  {"name": "ball", "sphere": {"radius": 0.3}, "transform": {"position": [0, 0.5, 0]},
                   "friction": [0.7, 0.6]}],
    "camera": {"position": [1.35, 1.15, 1.75], "target": [0, 0.45, 0], "fov": 36}
})";

constexpr const char* new_scene = R"({
    "weft": 1,
    "cloths": [],
    "colliders": [{"name": "floor", "plane": {}}],
    "camera": {"position": [1.6, 1.3, 2.1], "target": [0, 0.4, 0]}
})";

DocumentPtr built_in(const char* text) {
    auto document = make_document(Json::parse(text), {}, {});
    assert(document);
    return *document;
}

/// Names of files in the scene, as they must be in another folder.
void move_file_names(Json& json, const std::filesystem::path& from, const std::filesystem::path& to) {
    for (auto& [key, value] : json.items()) {
        if (value.is_structured()) move_file_names(value, from, to);
        if (!value.is_string() || (key != "file" && !std::string_view(key).ends_with("_map"))) continue;
        const std::filesystem::path name = value.get<std::string>();
        std::error_code failed;
        if (name.empty() || name.is_absolute() || !std::filesystem::exists(from / name, failed)) continue;
        const auto moved = std::filesystem::proximate(from / name, to, failed);
        if (!failed) value = moved.string();
    }
}

}  // namespace

DocumentPtr first_document() {
    return built_in(first_scene);
}
DocumentPtr new_document() {
    return built_in(new_scene);
}

std::vector<GalleryScene> gallery() {
    std::vector<GalleryScene> scenes;
    std::error_code failed;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
    for (const std::filesystem::path& folder :
         {std::filesystem::path(WEFT_SCENES), program / ".." / "share" / "weft" / "scenes"}) {
        for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
            if (entry.path().extension() == ".json") scenes.push_back({entry.path().stem().string(), entry.path()});
        if (!scenes.empty()) break;
    }
    for (GalleryScene& scene : scenes) std::ranges::replace(scene.name, '_', ' ');
    std::ranges::sort(scenes, {}, &GalleryScene::name);
    return scenes;
}

Result<void> save_document(const Document& document, const std::filesystem::path& file) {
    Json json = document.json;
    const std::filesystem::path folder = file.parent_path();
    if (!document.folder.empty() && document.folder != folder)
        move_file_names(json, document.folder, folder.empty() ? "." : folder);
    const auto scene = read_scene(json, {});
    if (!scene) return scene.errors();
    const auto text = write_scene(*scene);
    if (!text) {
        Errors errors = text.errors();
        for (Error& error : errors) error.where = file.string() + ": " + error.where;
        return errors;
    }
    return write_atomically(file, [&](AtomicFile& out) { return out.write(*text); });
}

}  // namespace weft::editor
