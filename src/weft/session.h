// A scene, loaded and ready to step: what the public Simulation and the command line both stand on.
#pragma once

#include "io/exports/exporter.h"
#include "scene/scene_desc.h"
#include "solver/world/world.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace weft {

/// The cloths of a frame as exporters see them.
class DrawnFrame {
  public:
    /// What the surfaces show is the frame's own, and is gone with it. `looks` must stay while surfaces are in use. A
    /// cloth without one is of cotton, or of the colors of its mesh.
    void update(const Frame& frame, std::span<const SceneLook> looks = {});
    std::span<const ExportSurface> surfaces() const { return surfaces_; }

  private:
    std::vector<ExportSurface> surfaces_;
};

class Session {
  public:
    /// Makes the backend that options ask for.
    using MakeBackend = std::function<Result<std::unique_ptr<Backend>>(const Options&)>;

    /// Every problem found has its place in the scene file as `where`. `make`: in place of make_backend().
    static Result<Session> open(const std::filesystem::path& scene_file, const Options& options,
                                const MakeBackend& make = {});
    /// A scene that has been checked (check.h), or one without cloths, to be filled. Files are looked for in `folder`.
    /// Problems have JSON pointers as `where`.
    static Result<Session> create(SceneDesc scene, const Options& options, const std::filesystem::path& folder = {},
                                  const MakeBackend& make = {});

    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;
    ~Session();

    /// `pointer` is the place of the cloth in errors. It has been checked.
    Result<ClothId> add(const SceneCloth& cloth, const std::string& pointer);
    void remove(ClothId id);
    /// Makes coarse levels where they are wanted now and were not before.
    Result<Done> configure(const WorldSettings& settings);
    /// Cloth goes on moving as it was. `name`: of the preset that the fabric began as.
    Result<Done> set_fabric(ClothId id, const Fabric& fabric, const std::string& name);
    /// Particles are held where they are now; boxes are where particles are now.
    Result<Done> set_pins(ClothId id, std::vector<PinDesc> pins);

    const SceneDesc& scene() const { return scene_; }
    /// Where files are looked for.
    const std::filesystem::path& folder() const { return folder_; }
    World& world() { return *world_; }
    const World& world() const { return *world_; }
    double frame_seconds() const { return 1.0 / static_cast<double>(scene_.frame_rate); }
    void advance() { world_->advance(frame_seconds()); }
    void advance(double dt) { world_->advance(dt); }
    const Frame& step() { return world_->step(frame_seconds()); }
    const Frame& step(double dt) { return world_->step(dt); }

    /// What building found and survived, a line each.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    struct Entry;

    Session();
    Entry& entry(ClothId id);
    Result<Done> rebuild(Entry& entry, const SceneCloth& desc, const ClothPins& pins, Holds holds);

    SceneDesc scene_;
    std::filesystem::path folder_;
    std::vector<Entry> entries_;
    std::unique_ptr<World> world_;
    std::vector<std::string> notes_;
};

}  // namespace weft
