// Draws a scene: converts the state of a simulation into a Drawing for a Renderer.
#pragma once

#include "base/image.h"
#include "gpu/device.h"
#include "gpu/surface_buffers.h"
#include "look/camera.h"
#include "render/renderer.h"
#include "scene/scene_desc.h"
#include "view/overlays.h"
#include "view/world_frame.h"

#include <weft/result.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

struct ViewOptions {
    std::uint32_t width = 1280, height = 720;  ///< pixels, 1…16384
    std::uint32_t samples = 4;                 ///< per pixel, 1…256; more than 4 take proportionally longer
    bool transparent = false;                  ///< no background; the ground shows only its shadows
    bool two_passes = false;                   ///< render/drawing.h
    bool draft = false;                        ///< RendererOptions::draft
    std::vector<std::string> overlays;         ///< names of view/overlays.h
    bool legends = true;                       ///< draw those of overlays into the image

    float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

/// Returns the drawn surface of a cloth of a live world on the device. If the simulation has none there, the view
/// uploads a copy.
using SurfaceOnDevice = std::function<Result<gpu::SurfaceBuffers>(ClothId cloth)>;

/// Reads the image of a material's map.
using ReadPicture = std::function<Result<Image8>(const std::string& file)>;
using ReadLight = std::function<Result<ImageF>(const std::string& file)>;

struct ViewSources {
    SurfaceOnDevice surface = {};
    ReadPicture read_picture = {};
    ReadLight read_light = {};
};

/// Values that are shown as colors in place of a cloth's material, and of what overlays show on it.
struct ClothPaint {
    std::string cloth;          ///< name
    std::vector<float> values;  ///< per particle that the cloth was built with; copies have those of their originals
    float least = 0, most = 1;  ///< at the ends of the scale
    render::ColorScale scale = render::ColorScale::amount;
};

/// Scene and world are read only during calls. They may move between calls, and anything in them may change: the next
/// image shows it. A world is drawn itself, or from a copy (view/world_frame.h), which may be older than the scene.
class SceneView {
  public:
    /// `device`: that of the simulation, or a separate one. A map that cannot be read is replaced by a checkerboard and
    /// causes a note.
    static Result<SceneView> create(std::shared_ptr<gpu::Device> device, const SceneDesc& scene,
                                    const WorldFrame& world, const ViewOptions& options,
                                    const ViewSources& sources = {});
    static Result<SceneView> create(std::shared_ptr<gpu::Device> device, const SceneDesc& scene, const World& world,
                                    const ViewOptions& options, const ViewSources& sources = {}) {
        return create(std::move(device), scene, LiveWorldFrame(world), options, sources);
    }
    SceneView(SceneView&&) noexcept;
    SceneView& operator=(SceneView&&) noexcept;
    ~SceneView();

    /// The scene's camera; if it has none, one that shows the current state of everything (framing.h).
    Camera camera(const SceneDesc& scene, const WorldFrame& world) const;
    Camera camera(const SceneDesc& scene, const World& world) const { return camera(scene, LiveWorldFrame(world)); }
    /// Draws the current state of the world. Frees device data of objects that were removed since the previous image.
    Result<Image8> picture(const SceneDesc& scene, const WorldFrame& world, const Camera& camera);
    /// The same in another size than that of the options.
    Result<Image8> picture(const SceneDesc& scene, const WorldFrame& world, const Camera& camera, std::uint32_t width,
                           std::uint32_t height);
    Result<Image8> picture(const SceneDesc& scene, const World& world, const Camera& camera) {
        return picture(scene, LiveWorldFrame(world), camera);
    }
    /// The same into a target of any size. Returns the value that the device's timeline reaches when the image is done.
    /// `window`: semaphores of a window's image.
    Result<std::uint64_t> draw(const SceneDesc& scene, const WorldFrame& world, const Camera& camera,
                               const render::Target& target, gpu::BinarySemaphores window = {});
    Result<std::uint64_t> draw(const SceneDesc& scene, const World& world, const Camera& camera,
                               const render::Target& target, gpu::BinarySemaphores window = {}) {
        return draw(scene, LiveWorldFrame(world), camera, target, window);
    }
    /// Cloths and colliders with these names are not drawn.
    void set_hidden(std::vector<std::string> names);
    /// Replaces the overlays.
    void set_overlays(std::vector<const Overlay*> overlays);
    /// Of the overlays of the last image.
    const std::vector<Legend>& legends() const;
    /// Null: none. Does nothing if the cloth does not exist or has another number of particles.
    void set_paint(std::shared_ptr<const ClothPaint> paint);
    /// One line per problem that was worked around: maps that cannot be read.
    const std::vector<std::string>& notes() const;

  private:
    struct Impl;
    explicit SceneView(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The camera turned about the vertical axis through its target.
Camera orbited(const Camera& camera, float degrees);

}  // namespace weft
