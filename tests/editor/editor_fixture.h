// What tests of the editor's window share: scenes, and an editor that runs one of them.
#pragma once

#include "base/temporary_folder.test.h"

#include "driven_editor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace weft::editor {

inline constexpr const char* view = "middle/view/view";

/// A sheet that hangs from two corners before the camera.
inline constexpr const char* hanging = R"({ "weft": 1,
    "solver": {"substeps": 4},
    "cloths": [{"name": "sheet", "mesh": {"grid": {"size": [1, 1], "resolution": [21, 21]}}, "fabric": "cotton",
                "transform": {"position": [0, 0.9, 0], "rotation": [90, 0, 0]}, "pins": [{"vertices": [0, 20]}]}],
    "colliders": [{"name": "floor", "plane": {}}],
    "camera": {"position": [1.2, 1.3, 2.6], "target": [0, 0.7, 0], "fov": 40} })";

/// A floor and nothing else.
inline constexpr const char* empty = R"({ "weft": 1, "cloths": [], "colliders": [{"name": "floor", "plane": {}}],
    "camera": {"position": [2, 1.8, 2.4], "target": [0, 0.3, 0], "fov": 50} })";

/// Seen horizontally, so that the ring about y is a line.
inline constexpr const char* level = R"({ "weft": 1, "cloths": [], "colliders": [{"name": "floor", "plane": {}}],
    "camera": {"position": [0, 0.2, 2.5], "target": [0, 0.2, 0], "fov": 50} })";

/// The value that a change has set.
inline Json value_of(const Action& action) {
    return *std::get<ChangeScene>(action).edits.at(0).value;
}

class EditorWindow : public testing::Test {
  protected:
    DrivenEditor& open(const char* scene, std::vector<std::string> arguments = {}) {
        const auto file = folder.write("scene.json", scene);
        arguments.insert(arguments.begin(), file.string());
        return begin({.folder = folder.path() / "run", .arguments = std::move(arguments)});
    }
    DrivenEditor& begin(DrivenEditor::Start start) {
        editor.reset();
        editor.emplace(std::move(start));
        return *editor;
    }
    /// Pauses the run, whose first frames are over.
    void pause() {
        editor->until("some frames", [&] { return editor->frame() > 3; });
        editor->key("space");
        editor->until("the run is paused", [&] { return !editor->plays(); });
        editor->settle();
    }
    void undo_everything() {
        while (editor->is_enabled("toolbar/undo")) editor->key("ctrl+z");
    }
    /// The log leads back to the document and the state of a run without any action.
    void expect_nothing_is_left() {
        const Log log = editor->log();
        Stage played = editor->played();
        auto plain = open_stage(log.head, {});
        ASSERT_TRUE(plain);
        while (plain->frame() < played.frame()) ASSERT_TRUE(plain->step());
        EXPECT_EQ(played.document()->json, log.head.document->json);
        EXPECT_EQ(played.hash(), plain->hash());
    }
    struct Position {
        double x, y, z;
    };
    /// As the properties show it; the object must be selected.
    Position position_of(const std::string& place) {
        const std::string at = "properties" + place + "/transform/position/";
        return {editor->number(at + "x"), editor->number(at + "y"), editor->number(at + "z")};
    }

    /// The view's camera.
    struct Eye {
        std::array<double, 3> position{}, target{};
        double fov = 0;
        /// Unit, from the eye to the target.
        std::array<double, 3> ahead() const {
            std::array<double, 3> d{};
            double squared = 0;
            for (std::size_t i = 0; i < 3; ++i) d[i] = target[i] - position[i], squared += d[i] * d[i];
            for (double& one : d) one /= std::sqrt(squared);
            return d;
        }
        double distance_to(const Eye& other) const {
            return std::hypot(position[0] - other.position[0], position[1] - other.position[1],
                              position[2] - other.position[2]);
        }
    };
    Eye eye() {
        std::istringstream text(editor->value("middle/view/camera"));
        Eye eye;
        for (double& one : eye.position) text >> one;
        for (double& one : eye.target) text >> one;
        text >> eye.fov;
        return eye;
    }
    /// Where the ray through a pixel of the window meets the floor at height 0.
    Point floor_under(Point pixel) {
        const Eye eye = this->eye();
        const Rectangle all = editor->place(view);
        const auto a = eye.ahead();
        const double focal = all.height / 2 / std::tan(eye.fov * std::numbers::pi / 360);
        const double across = std::hypot(a[0], a[2]), x = (pixel.x - all.x - all.width / 2) / focal,
                     y = (pixel.y - all.y - all.height / 2) / focal;
        // Right is (-a.z, 0, a.x) / across, and down is right's cross product with ahead, reversed.
        const std::array<double, 3> right{-a[2] / across, 0, a[0] / across},
            down{a[0] * a[1] / across, -across, a[2] * a[1] / across};
        std::array<double, 3> ray{};
        for (std::size_t i = 0; i < 3; ++i) ray[i] = a[i] + x * right[i] + y * down[i];
        const double t = -eye.position[1] / ray[1];
        return {eye.position[0] + t * ray[0], eye.position[2] + t * ray[2]};
    }

    TemporaryFolder folder;
    std::optional<DrivenEditor> editor;
};

}  // namespace weft::editor
