#include "editor/ui/ui_window.h"

#include "base/hash.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace weft::editor {
namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();

double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

render::CursorShape shape_of(ImGuiMouseCursor cursor) {
    switch (cursor) {
        case ImGuiMouseCursor_TextInput:
            return render::CursorShape::text;
        case ImGuiMouseCursor_Hand:
            return render::CursorShape::hand;
        case ImGuiMouseCursor_ResizeEW:
            return render::CursorShape::resize_x;
        case ImGuiMouseCursor_ResizeNS:
            return render::CursorShape::resize_y;
        case ImGuiMouseCursor_ResizeAll:
        case ImGuiMouseCursor_ResizeNESW:
        case ImGuiMouseCursor_ResizeNWSE:
            return render::CursorShape::resize_both;
        default:
            return render::CursorShape::arrow;
    }
}

template <class Value>
void add_words(StateHash& hash, const ImVector<Value>& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.Data);
    const std::size_t count = static_cast<std::size_t>(values.Size) * sizeof(Value);
    for (std::size_t i = 0; i < count; i += sizeof(std::uint32_t)) {
        std::uint32_t word = 0;
        std::memcpy(&word, bytes + i, std::min(sizeof word, count - i));
        hash.add(word);
    }
}

/// Equal for frames that look the same, as long as images do not change.
std::uint64_t hash_of(const ImDrawData& data) {
    StateHash hash;
    hash.add(data.DisplaySize.x);
    hash.add(data.DisplaySize.y);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        add_words(hash, list.VtxBuffer);
        add_words(hash, list.IdxBuffer);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4 clip = command.ClipRect;
            for (const float edge : {clip.x, clip.y, clip.z, clip.w}) hash.add(edge);
            hash.add(command.ElemCount);
            hash.add(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
        }
    }
    return hash.value();
}

constexpr double software_rate = 32;  // frames/s

}  // namespace

struct UiWindow::Impl {
    UiWindowOptions options;
    std::shared_ptr<const render::Display> display;
    std::shared_ptr<gpu::Device> device;
    std::unique_ptr<render::Window> window;
    std::unique_ptr<UiRenderer> renderer;
    std::unique_ptr<Ui> ui;
    Statistics statistics;
    bool close_requested = false, exposed = true;
    std::uint64_t shown = 0;   // hash of the frame in the window
    std::uint64_t images = 0;  // version of the images in it
    double begun = -1;         // s: of the last frame
    ImGuiMouseCursor cursor = ImGuiMouseCursor_COUNT;

    Result<void> open();
    Result<void> open_on(const std::shared_ptr<const gpu::Instance>& instance, const gpu::DeviceInfo& info);
    bool must_show() const { return exposed && window->extent().width > 0; }
    void collect(double patience);
    bool wait(double patience);
    Result<void> run_frame(const Frame& frame);
    Result<void> draw(const ImDrawData& data);
};

Result<void> UiWindow::Impl::open() {
    auto opened = render::Display::open();
    if (!opened) return opened.errors();
    display = *opened;
    auto instance = gpu::Instance::create({.validation = options.validation,
                                           .surface_extensions = display->surface_extensions(),
                                           .on_message = options.on_message});
    if (!instance) return instance.errors();
    std::vector<gpu::DeviceInfo> left = (*instance)->devices();
    Errors errors;
    // A GPU without a connection to this display is no error while another device can show images.
    while (true) {
        const auto chosen = gpu::choose_device(left, options.device, true);
        if (!chosen) return errors.empty() ? chosen.errors() : errors;
        auto made = open_on(*instance, *chosen);
        if (made) break;
        if (errors.empty()) errors = made.errors();
        std::erase_if(left, [&](const gpu::DeviceInfo& one) { return one.index == chosen->index; });
        if (left.empty() || !options.device.empty()) return errors;
    }
    auto made = UiRenderer::create(device);
    if (!made) return made.errors();
    renderer = std::make_unique<UiRenderer>(std::move(*made));
    ui = std::make_unique<Ui>(
        UiOptions{.appearance = options.appearance,
                  .scale = options.scale > 0 ? options.scale : window->content_scale(),
                  .clipboard = [this] { return window->clipboard(); },
                  .set_clipboard = [this](const std::string& text) { window->set_clipboard(text); }});
    ui->on_redraw = [shared = display] { shared->wake(); };
    return {};
}

Result<void> UiWindow::Impl::open_on(const std::shared_ptr<const gpu::Instance>& instance,
                                     const gpu::DeviceInfo& info) {
    auto made = gpu::Device::create(instance, info, {.intercept = options.intercept});
    if (!made) return made.errors();
    auto opened = render::Window::create(
        display, *made,
        {.title = options.title, .width = options.width, .height = options.height, .images = {.plain = true}});
    if (!opened) return opened.errors();
    device = *made;
    window = std::make_unique<render::Window>(std::move(*opened));
    return {};
}

// Passes events on to the user interface.
void UiWindow::Impl::collect(double patience) {
    const std::vector<render::WindowEvent> events = window->events(patience);
    for (const render::WindowEvent& event : events) {
        if (std::holds_alternative<render::CloseRequested>(event.what)) close_requested = true;
        if (std::holds_alternative<render::Exposed>(event.what) || std::holds_alternative<render::Resized>(event.what))
            exposed = true;
        if (const auto* scale = std::get_if<render::ScaleChanged>(&event.what); scale && options.scale <= 0)
            ui->set_theme(ui->theme().appearance, scale->scale);
    }
    ui->add(events, window->pixels_per_unit());
}

// Waits until a frame is due; false if none was in that time. Input of a fast mouse and animations make at most
// `most_rate` frames a second. On a GPU, what is left of earlier input follows at once.
bool UiWindow::Impl::wait(double patience) {
    const double give_up = display->now() + patience;
    collect(0);
    while (!close_requested) {
        const double now = display->now();
        const double pace = ui->input_pending() && device->info().is_gpu() ? 0 : 1 / options.most_rate;
        const double soonest = begun + std::max(options.least_frame, pace);
        double due = must_show() ? now : now + std::max(0.0, ui->due_in(now));
        due = std::max(due, soonest);
        if (due <= now) return true;
        if (now >= give_up) return false;
        collect(std::min(due, give_up) - now);
    }
    return true;
}

Result<void> UiWindow::Impl::run_frame(const Frame& frame) {
    begun = display->now();
    const auto start = std::chrono::steady_clock::now();
    const VkExtent2D extent = window->extent();
    const bool hidden = extent.width == 0 || extent.height == 0;
    // While the window is minimized, frames go on with the last size.
    const ImVec2 size =
        hidden ? ui->size() : ImVec2(static_cast<float>(extent.width), static_cast<float>(extent.height));
    ui->begin(size.x, size.y, begun);
    if (ui->take_new_fonts()) {
        if (auto uploaded = renderer->set_fonts(*ImGui::GetIO().Fonts); !uploaded) {
            ui->end();
            return uploaded;
        }
    }
    auto built = frame(*ui);
    if (ImGui::GetMouseCursor() != cursor) {
        cursor = ImGui::GetMouseCursor();
        window->set_cursor(shape_of(cursor));
    }
    const ImDrawData& data = ui->end();
    ++statistics.frames;
    statistics.build_ms = ms_since(start);
    if (!built) return built;
    if (!hidden) {
        if (auto drawn = draw(data); !drawn) return drawn;
    }
    if (!options.probe.empty()) return ui->probe().write(options.probe);
    return {};
}

Result<void> UiWindow::Impl::draw(const ImDrawData& data) {
    const std::uint64_t hash = hash_of(data);
    if (!exposed && hash == shown && images == renderer->version()) return {};
    const auto start = std::chrono::steady_clock::now();
    const auto image = window->next();
    if (!image) return image.errors();
    if (image->state != gpu::Acquired::image) {
        ui->redraw_in(0.1);  // the window is being resized or hidden
        return {};
    }
    const render::Target target{.view = image->view,
                                .format = window->format(),
                                .width = image->extent.width,
                                .height = image->extent.height,
                                .after = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    const auto done = renderer->draw(data, target, ui->theme().colors.background, image->semaphores);
    if (!done) return done.errors();
    if (auto presented = window->show(*image, *done); !presented) return presented;
    // An image of another size than the frame was built for is drawn again.
    exposed = static_cast<float>(image->extent.width) != data.DisplaySize.x ||
              static_cast<float>(image->extent.height) != data.DisplaySize.y;
    if (exposed) ui->redraw();
    shown = hash;
    images = renderer->version();
    ++statistics.presented;
    statistics.draw_ms = ms_since(start);
    return {};
}

// --- Public functions

UiWindow::UiWindow(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

UiWindow::~UiWindow() {
    impl_->ui.reset();
    impl_->renderer.reset();
}

Result<std::unique_ptr<UiWindow>> UiWindow::open(const UiWindowOptions& options) {
    auto impl = std::make_unique<Impl>();
    impl->options = options;
    if (auto opened = impl->open(); !opened) return opened.errors();
    // On a processor, frames take time that a simulation and a view need.
    if (!impl->device->info().is_gpu()) impl->options.most_rate = std::min(options.most_rate, software_rate);
    return std::unique_ptr<UiWindow>(new UiWindow(std::move(impl)));
}

Ui& UiWindow::ui() {
    return *impl_->ui;
}

UiRenderer& UiWindow::renderer() {
    return *impl_->renderer;
}

render::Window& UiWindow::window() {
    return *impl_->window;
}

Result<void> UiWindow::run(const Frame& frame) {
    while (!impl_->window->closed())
        if (auto done = turn(frame, no_end); !done) return done;
    return {};
}

Result<void> UiWindow::turn(const Frame& frame, double patience) {
    if (!impl_->wait(patience)) return {};
    auto done = impl_->run_frame(frame);
    impl_->close_requested = false;
    return done;
}

bool UiWindow::close_requested() const {
    return impl_->close_requested || impl_->window->closed();
}

void UiWindow::keep_open() {
    impl_->window->keep_open();
    impl_->close_requested = false;
}

void UiWindow::close() {
    impl_->window->close();
}

void UiWindow::redraw() {
    impl_->ui->redraw();
}

const UiWindow::Statistics& UiWindow::statistics() const {
    return impl_->statistics;
}

}  // namespace weft::editor
