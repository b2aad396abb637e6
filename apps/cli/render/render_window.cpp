#include "cli/render/render_window.h"

#ifdef WEFT_VULKAN
#include "cli/render/view_sources.h"
#include "files/open_scene.h"
#include "render/orbit.h"
#include "render/window.h"
#include "view/framing.h"
#include "view/overlays.h"
#include "view/pace.h"
#include "view/scene_view.h"
#include "vulkan/interop.h"
#include "weft/backends.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#endif

namespace weft::cli {

#ifdef WEFT_VULKAN
namespace {

constexpr double idle_patience = 0.1;   // s: sleep time while there is nothing to draw
constexpr double title_interval = 0.5;  // s
constexpr std::string_view overlay_keys = "1234567890";

/// The drawing device, which must support windows. It also simulates, if the options allow it.
struct Machine {
    std::shared_ptr<const render::Display> display;
    std::shared_ptr<gpu::Device> device;

    static Result<Machine> open(const Options& options) {
        auto display = render::Display::open();
        if (!display) return display.errors();
        auto device =
            make_vulkan_device({.device = options.device, .surface_extensions = (*display)->surface_extensions()});
        if (!device) return device.errors();
        return Machine{*display, *device};
    }
    Result<std::unique_ptr<Backend>> backend(const Options& options) const {
        const bool vulkan = options.backend == "vulkan" || !options.device.empty() || device->info().is_gpu();
        if (options.backend != "cpu" && vulkan)
            return make_vulkan_backend(device, {.execution = options.execution, .timings = options.stage_timings});
        Options on_cpu = options;
        on_cpu.backend = "cpu";
        on_cpu.device.clear();  // --device names the drawing device
        return make_backend(on_cpu);
    }
};

/// A running scene and its window.
class Show {
  public:
    Show(SceneWorld& session, SceneView& view, render::Window& window, const ShowOptions& options,
         std::optional<std::uint64_t> frames)
        : session_(session),
          view_(view),
          window_(window),
          frames_(frames),
          camera_(options.camera.value_or(view.camera(session.scene(), session.world()))),
          start_(session.world().save()),
          pace_(session.frame_seconds()) {
        for (const std::string& name : options.overlays) {
            const auto it = std::ranges::find(overlays(), name, &Overlay::name);
            if (it != overlays().end()) shown_.push_back(&*it);
        }
        if (options.camera || session.scene().camera) return;
        const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
        following_.emplace(subject_of(session.world()), aspect);
        camera_ = following_->camera();
    }

    Result<void> run() {
        if (auto set = set_overlays(); !set) return set;
        while (!window_.closed()) {
            const render::WindowInput input = window_.input(drawn_ ? 0 : idle_patience);
            if (auto obeyed = obey(input); !obeyed) return obeyed;
            if (auto stepped = step(static_cast<double>(input.seconds)); !stepped) return stepped;
            if (auto drawn = draw(); !drawn) return drawn;
            tell(static_cast<double>(input.seconds));
        }
        return {};
    }

  private:
    static bool pressed(const render::WindowInput& input, char key) {
        return input.pressed[static_cast<std::size_t>(key)];
    }

    Result<void> obey(const render::WindowInput& input) {
        camera_ = render::steered(camera_, input);
        if (pressed(input, render::escape_key)) window_.close();
        if (pressed(input, ' ')) paused_ = !paused_;
        if (pressed(input, 'R')) {
            if (auto restored = session_.world().restore(start_); !restored) return restored;
            if (following_) {
                following_->cut_to(subject_of(session_.world()));
                camera_ = following_->moved_along(camera_);
                followed_ = session_.world().time();
            }
        }
        bool changed = false;
        for (std::size_t i = 0; i < std::min(overlays().size(), overlay_keys.size()); ++i) {
            if (!pressed(input, overlay_keys[i])) continue;
            const Overlay* overlay = &overlays()[i];
            changed = true;
            if (std::erase(shown_, overlay) == 0) shown_.push_back(overlay);
        }
        return changed ? set_overlays() : Result<void>();
    }

    Result<void> set_overlays() {
        const auto need = [&](OverlayNeeds what) {
            return std::ranges::find(shown_, what, &Overlay::needs) != shown_.end();
        };
        session_.set_contact_forces(need(OverlayNeeds::contact_forces));
        session_.set_contact_marks(need(OverlayNeeds::contact_marks));
        view_.set_overlays(shown_);
        return {};
    }

    Result<void> step(double seconds) {
        for (unsigned due = paused_ ? 0 : pace_.due(seconds); due > 0 && !window_.closed(); --due) {
            session_.advance();
            const Frame& frame = session_.world().summary();
            step_ms_ += frame.step_ms;
            ++steps_;
            if (auto went = check_step(frame, warned_); !went) return went;
            if (frames_ && frame.index >= *frames_) window_.close();
        }
        return {};
    }

    // For scenes without a camera. User input moves the camera relative to what it follows.
    void follow() {
        if (!following_) return;
        const double now = session_.world().time();
        following_->follow(subject_of(session_.world()), static_cast<float>(now - std::exchange(followed_, now)));
        camera_ = following_->moved_along(camera_);
    }

    Result<void> draw() {
        follow();
        const auto image = window_.next();
        if (!image) return image.errors();
        drawn_ = image->state == gpu::Acquired::image;
        if (!drawn_) return {};
        const render::Target target{.view = image->view,
                                    .format = window_.format(),
                                    .width = image->extent.width,
                                    .height = image->extent.height,
                                    .after = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
        const auto done = view_.draw(session_.scene(), session_.world(), camera_, target, image->semaphores);
        if (!done) return done.errors();
        ++pictures_;
        return window_.show(*image, *done);
    }

    void tell(double seconds) {
        clock_ += seconds;
        if (clock_ < title_interval) return;
        std::array<char, 96> figures{};
        std::snprintf(figures.data(), figures.size(), "%.0f fps, %.2f ms per step%s", pictures_ / clock_,
                      steps_ > 0 ? step_ms_ / steps_ : 0, paused_ ? ", paused" : "");
        window_.set_title("weft: " + session_.scene().name + ": " + figures.data());
        clock_ = step_ms_ = 0;
        pictures_ = steps_ = 0;
    }

    SceneWorld& session_;
    SceneView& view_;
    render::Window& window_;
    std::optional<std::uint64_t> frames_;
    Camera camera_;
    std::optional<FollowingCamera> following_;
    double followed_ = 0;  // s: the time up to which the camera has followed
    Snapshot start_;
    Pace pace_;
    std::vector<const Overlay*> shown_;
    bool paused_ = false, warned_ = false;
    bool drawn_ = true;  // whether there was an image to draw into
    // Since the title was last updated:
    double clock_ = 0, step_ms_ = 0;
    int pictures_ = 0, steps_ = 0;
};

Result<void> open_and_run(const ShowOptions& options) {
    const auto machine = Machine::open(options.common);
    if (!machine) return machine.errors();
    auto session =
        open_scene(options.scene, options.common, [&](const Options& common) { return machine->backend(common); });
    if (!session) return session.errors();
    std::optional<std::uint64_t> frames;
    if (options.length.frames || options.length.seconds) {
        const auto count = frame_count(options.length, session->frame_seconds(), 0);
        if (!count) return count.errors();
        frames = *count;
    }
    auto window = render::Window::create(
        machine->display, machine->device,
        {.title = "weft: " + session->scene().name, .width = options.width, .height = options.height});
    if (!window) return window.errors();
    auto view = SceneView::create(
        machine->device, session->scene(), session->world(),
        {.width = options.width, .height = options.height, .samples = options.samples, .overlays = {}},
        view_sources(options.scene, session->world()));
    if (!view) return view.errors();
    for (const std::string& note : session->notes()) print_warning(note);
    for (const std::string& note : view->notes()) print_warning(note);
    return Show(*session, *view, *window, options, frames).run();
}

}  // namespace

std::string window_help() {
    std::string help =
        "In the window:\n"
        "  left drag      orbit           W S   up, down\n"
        "  right drag     look around     A D   left, right\n"
        "  middle drag    pan             Q E   back, forward\n"
        "  wheel          zoom            Space pause, R restart, Esc close\n"
        "  overlays:";
    for (std::size_t i = 0; i < std::min(overlays().size(), overlay_keys.size()); ++i)
        help += (i > 0 ? ", " : " ") + std::string{overlay_keys[i], ' '} + std::string(overlays()[i].name);
    return help;
}

int show(const ShowOptions& options) {
    const auto done = open_and_run(options);
    if (done) return exit_done;
    print_errors(done.errors());
    return exit_code(done.errors());
}

#else

std::string window_help() {
    return "This build has no windows.";
}

int show(const ShowOptions&) {
    print_errors({{"", "this build has no Vulkan, which rendering needs; build with -D WEFT_VULKAN=ON"}});
    return exit_failed;
}

#endif

}  // namespace weft::cli
