// Scenes for the editor's tests.
#pragma once

#include "editor/core/stage.h"

#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <string>
#include <vector>

namespace weft::editor {

inline DocumentPtr small_document() {
    auto document = make_document(Json::parse(R"({
        "weft": 1,
        "solver": {"substeps": 4},
        "cloths": [
            {"name": "sheet", "mesh": {"grid": {"resolution": [17, 17]}}, "fabric": "silk", "tearing": "cuts",
             "transform": {"position": [0, 0.5, 0]}, "pins": [{"vertices": [0]}, {"vertices": [16], "attach": "ball"}]},
            {"mesh": {"grid": {"size": [0.5, 0.5], "resolution": [9, 9]}}, "transform": {"position": [0, 1, 0]}}],
        "colliders": [{"name": "ball", "sphere": {"radius": 0.2}}, {"plane": {}, "transform": {"position": [0, -1, 0]}}]
    })"),
                                  {}, {});
    EXPECT_TRUE(document) << document.error().message();
    return *document;
}

inline Stage open_small(StageOptions options = {}) {
    options.simulation.backend = "cpu";
    auto stage = Stage::open(small_document(), std::move(options));
    EXPECT_TRUE(stage) << stage.error().message();
    return std::move(*stage);
}

inline ChangeScene change_of(std::string place, std::optional<Json> value, std::uint64_t gesture = 0) {
    return {.label = "Change of " + place, .edits = {{place, std::move(value)}}, .gesture = gesture};
}

inline void must(const Result<void>& done) {
    ASSERT_TRUE(done) << done.error().message();
}

/// Actions of every kind that changes something, for the small document.
inline std::vector<Action> sample_actions() {
    const Json ball = {{"name", "ball 2"}, {"sphere", {{"radius", 0.1}}}};
    const Json box = {{"box", {{"half_extents", {0.1, 0.2, 0.3}}}}, {"transform", {{"position", {0, 0.2, 0}}}}};
    const Json cloth = {{"mesh", {{"grid", {{"resolution", {5, 6}}}}}}, {"fabric", "denim"}};
    return {change_of("/cloths/0/fabric/density", 0.3),
            change_of("/cloths/0/fabric", "wool"),
            change_of("/cloths/0/transform/position", Json{0.1, 0.6, 0}),
            change_of("/cloths/1/mesh/grid/resolution", Json{7, 12}),
            change_of("/cloths/0/pins", {}),
            change_of("/cloths/1/pins/-", Json{{"vertices", {0, 8}}}),
            change_of("/cloths/0/groups", Json::parse(R"([{"name": "hem", "vertices": [0, 1, 2]}])")),
            change_of("/cloths/1/pins", Json::parse(R"([{"vertices": [3, 4]}])")),
            change_of("/cloths/-", cloth),
            change_of("/colliders/-", ball),
            change_of("/colliders/-", box),
            change_of("/colliders/1", {}),
            change_of("/colliders/0/transform/position", Json{0.05, 0.1, 0}),
            change_of("/colliders/0/friction", Json{0.1, 0.1}),
            change_of("/cloths/1", {}),
            change_of("/air", Json{{"wind", {{{"velocity", {3, 0, 0}}}}}}),
            change_of("/gravity", Json{0, -1, 2}),
            change_of("/solver/substeps", 6),
            change_of("/solver/projection", "jacobi"),
            change_of("/cloths/0/self_collision", "exact"),
            change_of("/cloths/0/material", "velvet"),
            change_of("/light/sun/intensity", 2),
            change_of("/stitches/-", Json::parse(R"({"a": {"cloth": "sheet", "vertices": [100]},
                                                     "b": {"cloth": "cloth 1", "vertices": [4]}})")),
            Rename{"/cloths/0", "banner"},
            Rename{"/colliders/0", "globe"},
            Cut{"sheet", {{-0.6f, 0.5f, 0.01f}, {0.1f, 0.5f, 0.01f}}},
            Grab{"sheet", {40, {0.25f, 0.25f, 0.5f}}, {0.3f, 1, 0.2f}, 5},
            Reset{}};
}

/// A folder that is removed with the object.
class ScratchFolder {
  public:
    ScratchFolder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("weft_editor_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace weft::editor
