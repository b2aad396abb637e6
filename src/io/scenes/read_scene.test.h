// Reads scene text and returns the errors.
#pragma once

#include "io/scenes/scene_file.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft {

/// The messages of all errors of a scene text with the name "s.json".
inline std::vector<std::string> errors_of(std::string_view text) {
    std::vector<std::string> messages;
    if (const Result<SceneDesc> scene = parse_scene(text, "s.json"); !scene)
        for (const Error& error : scene.errors()) messages.push_back(error.message());
    return messages;
}

/// Reads a scene text that must be valid.
inline SceneDesc read(std::string_view text) {
    Result<SceneDesc> scene = parse_scene(text, "s.json");
    EXPECT_TRUE(scene) << scene.error().message() << '\n' << text;
    return scene ? std::move(*scene) : SceneDesc();
}

}  // namespace weft
