// A scene in a window, as it moves.
#pragma once

#include "cli/shell/command.h"
#include "look/camera.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace weft::cli {

struct ShowOptions {
    std::string scene;
    Length length;  ///< simulated; then it closes; neither: never
    std::uint32_t width = 1280, height = 720;
    std::uint32_t samples = 4;
    std::optional<Camera> camera;
    std::vector<std::string> overlays;  ///< those that are on at first; their names have been checked
    Options common;
};

/// What hands can do, for the help.
std::string window_help();

/// Until it is closed; the exit status.
int show(const ShowOptions& options);

}  // namespace weft::cli
