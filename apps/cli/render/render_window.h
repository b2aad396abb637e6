// Shows a running scene in a window.
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
    Length length;  ///< simulated before the window closes; unlimited if empty
    std::uint32_t width = 1280, height = 720;
    std::uint32_t samples = 4;
    std::optional<Camera> camera;
    std::vector<std::string> overlays;  ///< shown at the start; their names have been checked
    Options common;
};

/// Keys and mouse buttons of the window, for the help.
std::string window_help();

/// Runs until the window is closed; returns the exit status.
int show(const ShowOptions& options);

}  // namespace weft::cli
