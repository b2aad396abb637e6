// A scene as a picture: what a simulation holds becomes what a Renderer draws.
#pragma once

#include "base/image.h"
#include "gpu/device.h"
#include "gpu/surface_buffers.h"
#include "look/camera.h"
#include "render/renderer.h"
#include "scene/scene_desc.h"
#include "solver/world/world.h"
#include "view/overlays.h"

#include <weft/result.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

struct ViewOptions {
    std::uint32_t width = 1280, height = 720;  ///< pixels, 1…16384
    std::uint32_t samples = 4;                 ///< a pixel: 1, 2, 4, and up to 256; more than 4 take that much longer
    bool transparent = false;                  ///< no background; the ground is there by its shadows alone
    bool two_passes = false;                   ///< render/drawing.h
    std::vector<std::string> overlays;         ///< names of view/overlays.h

    float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

/// The drawn surface of a cloth on the device, where the simulation has it there; otherwise the view brings it there.
using SurfaceOnDevice = std::function<Result<gpu::SurfaceBuffers>(ClothId cloth)>;

/// A picture that maps of materials are read from: `where` is the place in the scene, for errors.
using ReadPicture = std::function<Result<Image8>(const std::string& file)>;
using ReadLight = std::function<Result<ImageF>(const std::string& file)>;

struct ViewSources {
    SurfaceOnDevice surface = {};
    ReadPicture read_picture = {};
    ReadLight read_light = {};
};

class SceneView {
  public:
    /// On the simulation's device, or one of its own. Scene and world are read during calls alone and may move between
    /// them. A map that cannot be read is a checkered one, and a note says so.
    static Result<SceneView> create(std::shared_ptr<gpu::Device> device, const SceneDesc& scene, World& world,
                                    const ViewOptions& options, const ViewSources& sources = {});
    SceneView(SceneView&&) noexcept;
    SceneView& operator=(SceneView&&) noexcept;
    ~SceneView();

    /// The scene's camera; where it has none, one from which everything is seen as it is now (framing.h).
    Camera camera(const SceneDesc& scene, const World& world) const;
    /// The world as it is now. What has left it since the picture before is freed on the device.
    Result<Image8> picture(const SceneDesc& scene, World& world, const Camera& camera);
    /// The same into a target of any size; returns when it is there, on the device's timeline. `window`: of a window's
    /// image.
    Result<std::uint64_t> draw(const SceneDesc& scene, World& world, const Camera& camera, const render::Target& target,
                               gpu::BinarySemaphores window = {});
    /// From now on, in place of those before.
    void set_overlays(std::vector<const Overlay*> overlays);
    /// What was put right, a line each: maps that cannot be read.
    const std::vector<std::string>& notes() const;

  private:
    struct Impl;
    explicit SceneView(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The camera turned about the vertical axis through its target.
Camera orbited(const Camera& camera, float degrees);

}  // namespace weft
