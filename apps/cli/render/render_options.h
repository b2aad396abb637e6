// The options of `weft render` and their checks.
#pragma once

#include "cli/shell/command.h"
#include "io/images/film_frames.h"
#include "look/camera.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace weft::cli {

struct RenderOptions {
    std::string scene;
    Length length;
    std::vector<std::string> outputs, overlays;
    std::string size = "1280x720", camera;
    std::int64_t samples = 4;
    double orbit = 0;
    std::optional<double> fps;
    bool transparent = false, quiet = false, window = false;
    Options common;
};

struct PictureSize {
    std::uint32_t width = 0, height = 0;
};
/// "1280x720"
Result<PictureSize> parse_size(const std::string& text);

/// "px,py,pz,tx,ty,tz", optionally with the field of view at the end; the default is that of Camera.
Result<Camera> parse_camera(const std::string& text);

/// All options that can be checked without the scene.
struct RenderPlan {
    PictureSize size;
    std::optional<Camera> camera;
};
Result<RenderPlan> check_options(const RenderOptions& options);

/// Images per second of the video; fails if that is more than the frame rate of the scene.
Result<double> film_rate(const RenderOptions& options, double frame_rate);

}  // namespace weft::cli
