// A thread that draws the scene of the editor. The thread of the windows hands it what to draw, and picks up the newest
// image; neither waits for the other.
#pragma once

#include "base/image.h"
#include "gpu/device.h"
#include "look/camera.h"
#include "scene/scene_desc.h"
#include "view/overlays.h"
#include "view/scene_view.h"
#include "view/world_frame.h"

#include <weft/result.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace weft::editor {

/// What an image shows. Copies share scene and world.
struct ViewRequest {
    std::shared_ptr<const WorldFrameCopy> world;
    std::shared_ptr<const SceneDesc> scene;
    std::filesystem::path folder = {};  ///< of the scene's file: images are searched there
    Camera camera = {};
    std::uint32_t width = 0, height = 0;  ///< pixels; nothing is drawn while one is 0
    std::vector<const Overlay*> overlays = {};
    std::shared_ptr<const ClothPaint> paint = {};
    std::vector<std::string> selected_cloths = {}, selected_colliders = {};  ///< names; they get an outline
    std::vector<std::string> hidden = {};  ///< names of cloths and colliders that are not drawn
    friend bool operator==(const ViewRequest&, const ViewRequest&) = default;
};

struct ViewImage {
    Image8 image;                         ///< opaque sRGB; empty if drawing failed
    Camera camera;                        ///< with which it was drawn
    std::uint64_t frame = 0;              ///< Frame::index of the world
    double ms = 0;                        ///< that it took to draw
    unsigned percent = 100;               ///< size of the drawn image relative to the request; it was enlarged
    bool draft = false;                   ///< render::RendererOptions::draft
    std::uint64_t number = 0;             ///< of the request, as request() has returned it
    std::vector<Legend> legends = {};     ///< of the overlays; they are not in the image
    std::vector<std::string> notes = {};  ///< what was worked around (SceneView::notes)
    Errors errors = {};                   ///< why drawing failed; then nothing is drawn until retry()
};

struct ViewThreadOptions {
    /// Called on the thread, at first and by retry(). Empty: the best device of the machine.
    std::function<Result<std::shared_ptr<gpu::Device>>()> open_device = {};
    /// Called on a thread of the ViewThread after each new image. It may wake another thread; it must not wait for one
    /// that uses the ViewThread.
    std::function<void()> on_image = {};
    std::uint32_t samples = 4;               ///< per pixel, of images that do not move
    double target_ms = 50;                   ///< for an image while something moves
    std::chrono::milliseconds settled{200};  ///< so long after the last change nothing moves
};

/// While requests change, images are as large and as good as the target time allows (ViewQuality). Once nothing has
/// changed for a while, one image of the best quality follows, and then none. A second thread draws the outlines, so
/// that a selection shows while a large scene is drawn; it alone does not draw the scene again. All functions may be
/// called by any thread and return at once.
class ViewThread {
  public:
    explicit ViewThread(ViewThreadOptions options = {});
    /// Waits for the image in work, if there is one.
    ~ViewThread();
    ViewThread(const ViewThread&) = delete;
    ViewThread& operator=(const ViewThread&) = delete;

    /// Replaces the request before, drawn or not. A request that equals it changes nothing. Returns the number of the
    /// request.
    std::uint64_t request(ViewRequest request);
    /// The newest image, which may be of an earlier request; null before the first.
    std::shared_ptr<const ViewImage> image() const;
    /// After a failure: opens the device again and draws the last request. Otherwise does nothing.
    void retry();
    /// Images made so far.
    std::uint64_t count() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft::editor
