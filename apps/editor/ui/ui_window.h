// A window with a user interface: waits for events, runs frames, draws them, on a device of its own.
#pragma once

#include "editor/ui/ui.h"
#include "editor/ui/ui_renderer.h"
#include "render/window.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace weft::editor {

struct UiWindowOptions {
    std::string title = "weft";
    std::uint32_t width = 1280, height = 720;
    std::string device = {};  ///< part of a Vulkan device's name; empty: the best that can show images
    Appearance appearance = Appearance::dark;
    float scale = 0;                   ///< of the user interface; 0: as the system asks
    std::filesystem::path probe = {};  ///< file that each frame writes the places of widgets to; empty: none
    double most_rate = 60;             ///< frames/s, of animations and of movements of the pointer
    double least_frame = 0;            ///< s: makes each frame take at least so long, for tests
    bool validation = false;           ///< Vulkan's validation layers, for tests
    std::function<void(std::string_view)> on_message = {};
    std::function<void(VolkDeviceTable&)> intercept = {};  ///< for tests: functions of the device that fail
};

class UiWindow {
  public:
    /// Fails without a display and without a device that can show images on it.
    static Result<std::unique_ptr<UiWindow>> open(const UiWindowOptions& options = {});
    ~UiWindow();

    Ui& ui();
    UiRenderer& renderer();
    render::Window& window();

    /// Builds the content of a frame with ImGui and our widgets.
    using Frame = std::function<Result<void>(Ui&)>;
    /// Runs frames until the window is closed, or until a frame fails. Sleeps while there is nothing to do.
    Result<void> run(const Frame& frame);
    /// One turn of run(): waits at most `patience` s for something to do, and runs a frame if there is any.
    Result<void> turn(const Frame& frame, double patience);

    /// Whether the user has asked to close the window. run() ends after the frame in which this is true, unless
    /// keep_open() was called.
    bool close_requested() const;
    void keep_open();
    void close();
    /// Asks for another frame. Any thread may call this.
    void redraw();

    struct Statistics {
        std::uint64_t frames = 0;          ///< built
        std::uint64_t presented = 0;       ///< drawn, because they differed from the one before
        double build_ms = 0, draw_ms = 0;  ///< of the last frame
    };
    const Statistics& statistics() const;

  private:
    struct Impl;
    explicit UiWindow(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft::editor
