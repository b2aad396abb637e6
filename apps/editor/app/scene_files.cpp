#include "editor/app/scene_files.h"

#include "io/files/atomic_file.h"
#include "io/scenes/scene_file.h"
#include "io/scenes/scene_text_edit.h"
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

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code failed;
    return std::filesystem::equivalent(a, b, failed) || std::filesystem::absolute(a, failed).lexically_normal() ==
                                                            std::filesystem::absolute(b, failed).lexically_normal();
}

/// Whether text with this value stands anywhere except as the name of an object.
bool is_referred_to(const Json& json, const std::string& name) {
    for (const auto& [key, value] : json.items())
        if (value.is_structured() ? is_referred_to(value, name) : key != "name" && value == name) return true;
    return false;
}

/// Takes away the names that the editor gave to objects of the file, unless something refers to them.
void remove_given_names(Json& json, const std::map<std::string, bool>& given) {
    const Json all = json;
    for (const char* list : {"cloths", "colliders"}) {
        if (!json.contains(list)) continue;
        for (Json& object : json[list]) {
            const auto name = given.find(object.value("name", ""));
            if (name == given.end() || is_referred_to(all, name->first)) continue;
            if (name->second)
                object["name"] = "";
            else
                object.erase("name");
        }
    }
}

/// Numbers that are a float get its fewest digits.
void shorten(Json& json) {
    for (Json& value : json) {
        if (value.is_structured()) shorten(value);
        if (!value.is_number_float()) continue;
        const auto real = value.get<double>();
        const auto rounded = static_cast<float>(real);
        if (rounded != real) continue;
        const Json shorter = number(rounded);
        if (!shorter.is_number() || shorter.get<double>() == real || shorter.get<float>() != rounded) continue;
        value = shorter;
    }
}

/// The document's JSON as a file in the folder must have it.
Json json_in(const Document& document, const std::filesystem::path& folder) {
    Json json = document.json;
    if (!document.folder.empty() && document.folder != folder)
        move_file_names(json, document.folder, folder.empty() ? "." : folder);
    if (!document.original) return json;
    remove_given_names(json, document.given_names);
    // What has not changed keeps all its digits.
    Json wanted = document.original->json;
    for (const Edit& edit : difference(document.original->json, json)) {
        Json value = Json::array({edit.value.value_or(Json())});
        shorten(value);
        if (!editor::apply(wanted, edit.value ? Edit{edit.place, value[0]} : edit)) return json;
    }
    return wanted;
}

Result<std::string> changed_text(const Document& document, const Json& json) {
    if (document.original)
        if (auto text = edit_scene_text(document.original->text, json)) return text;
    const auto scene = read_scene(json, {});
    if (!scene) return scene.errors();
    // The writer wants a cloth, because a run needs one.
    if (scene->cloths.empty()) return edit_scene_text("{\n    \"weft\": 1\n}\n", json);
    return write_scene(*scene);
}

/// Reads what is about to be written. A scene without cloths is valid: cloths can be added to it later.
Result<void> check_text(const std::string& text) {
    const FileTextPtr written = make_file_text(text);
    if (!written) return Error{"", "would not be JSON"};
    const auto scene = read_scene(written->json, {});
    return scene ? Result<void>() : Result<void>(scene.errors());
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
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, failed)) {
            const std::filesystem::path& file = entry.path();
            const std::string above = file.parent_path().lexically_relative(folder).string();
            if (file.extension() == ".json")
                scenes.push_back({file.stem().string(), above == "." ? std::string() : above, file});
        }
        if (!scenes.empty()) break;
    }
    for (GalleryScene& scene : scenes) std::ranges::replace(scene.name, '_', ' ');
    std::ranges::sort(scenes, {}, [](const GalleryScene& one) { return std::pair(one.group, one.name); });
    return scenes;
}

bool changed_on_disk(const Document& document, const std::filesystem::path& file) {
    std::error_code missing;
    if (!document.original || !same_file(document.file, file) || !std::filesystem::exists(file, missing)) return false;
    const auto now = read_scene_text(file);
    return !now || *now != document.original->text;
}

Result<FileTextPtr> save_document(const Document& document, const std::filesystem::path& file, bool overwrite_changed) {
    if (!overwrite_changed && changed_on_disk(document, file))
        return Error{file.string(), "has changed on disk since it was opened; saving would undo those changes"};
    const auto in_file = [&](Errors errors) {
        for (Error& error : errors) error.where = file.string() + (error.where.empty() ? "" : ": ") + error.where;
        return errors;
    };
    const auto text = changed_text(document, json_in(document, file.parent_path()));
    if (!text) return in_file(text.errors());
    if (const auto checked = check_text(*text); !checked) return in_file(checked.errors());
    const auto written = write_atomically(file, [&](AtomicFile& out) { return out.write(*text); });
    if (!written) return written.errors();
    return make_file_text(*text);
}

}  // namespace weft::editor
