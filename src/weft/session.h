// A scene, loaded and ready to step: what the public Simulation and the command line both stand on.
#pragma once

#include "io/exporter.h"
#include "scene/scene_desc.h"
#include "solver/world.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace weft {

/// Drawn positions and normals of every cloth in a frame, in buffers that are kept from frame to frame.
class DrawnFrame {
  public:
    void update(const Frame& frame);
    std::span<const ExportSurface> surfaces() const { return surfaces_; }

  private:
    struct Buffers {
        std::vector<Vec3> positions, normals;
    };
    std::vector<Buffers> buffers_;
    std::vector<ExportSurface> surfaces_;
};

class Session {
  public:
    /// Every problem found has its place in the scene file as `where`.
    static Result<Session> open(const std::filesystem::path& scene_file, const Options& options);

    const SceneDesc& scene() const { return scene_; }
    World& world() { return *world_; }
    const World& world() const { return *world_; }
    double frame_seconds() const { return 1.0 / static_cast<double>(scene_.frame_rate); }
    const Frame& step() { return world_->step(frame_seconds()); }

    /// What building found and survived, a line each.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    Session() = default;

    SceneDesc scene_;
    std::unique_ptr<World> world_;
    std::vector<std::string> notes_;
};

}  // namespace weft
