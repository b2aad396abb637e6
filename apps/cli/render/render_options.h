// What `weft render` is asked for, and whether it makes sense.
#pragma once

#include "cli/shell/command.h"
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

/// "px,py,pz,tx,ty,tz" or with the field of view behind it; without that, it is that of a Camera.
Result<Camera> parse_camera(const std::string& text);

/// Everything that can be told without the scene.
struct RenderPlan {
    PictureSize size;
    std::optional<Camera> camera;
};
Result<RenderPlan> check_options(const RenderOptions& options);

/// Which frames of a run are pictures of a film of so many a second: each the one nearest to its time.
class FilmFrames {
  public:
    /// frame_rate ≥ film_rate > 0
    FilmFrames(std::uint64_t frames, double frame_rate, double film_rate);
    std::uint64_t count() const { return count_; }
    std::uint64_t frame(std::uint64_t picture) const;

  private:
    double step_;
    std::uint64_t count_;
};
/// Pictures a second of the film; fails if those are more than the scene has.
Result<double> film_rate(const RenderOptions& options, double frame_rate);

}  // namespace weft::cli
