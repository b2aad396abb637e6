#include "render/window.h"

#include "render/glfw_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace weft::render {
namespace {

constexpr std::array cursor_shapes = {GLFW_ARROW_CURSOR,     GLFW_IBEAM_CURSOR,   GLFW_CROSSHAIR_CURSOR,
                                      GLFW_HAND_CURSOR,      GLFW_HRESIZE_CURSOR, GLFW_VRESIZE_CURSOR,
#ifdef GLFW_RESIZE_ALL_CURSOR  // GLFW 3.4
                                      GLFW_RESIZE_ALL_CURSOR
#else
                                      GLFW_CROSSHAIR_CURSOR
#endif
};

std::string last_words() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

}  // namespace

Result<std::shared_ptr<const Display>> Display::open() {
    static std::weak_ptr<const Display> opened;
    if (auto display = opened.lock()) return display;
    if (!glfwInit()) {
        return Error::of_machine(
            "window",
            "there is no display; set DISPLAY or WAYLAND_DISPLAY, or write images to files (" + last_words() + ")");
    }
    auto display = std::shared_ptr<const Display>(new Display);
    opened = display;
    return display;
}

Display::~Display() {
    glfwTerminate();
}

std::vector<std::string> Display::surface_extensions() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return names ? std::vector<std::string>(names, names + count) : std::vector<std::string>{};
}

double Display::now() const {
    return glfwGetTime();
}

void Display::wake() const {
    glfwPostEmptyEvent();
}

struct Window::Impl {
    std::shared_ptr<const Display> display;
    std::shared_ptr<gpu::Device> device;
    gpu::SwapchainOptions images;
    GLFWwindow* window = nullptr;
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    std::optional<gpu::Swapchain> swapchain;
    std::vector<WindowEvent> events;
    std::array<GLFWcursor*, cursor_shapes.size()> cursors{};
    WindowInput input;
    bool buttons[3]{};
    double asked = 0;  // s: time of the last call of input()

    ~Impl() {
        drop_surface();
        if (window) glfwDestroyWindow(window);
        for (GLFWcursor* cursor : cursors)
            if (cursor) glfwDestroyCursor(cursor);
    }

    Result<void> open(const WindowOptions& options);
    Result<void> make_surface();
    void drop_surface();
    void listen();
    void listen_to_system();
    void tell(WindowChange what) { events.push_back({glfwGetTime(), std::move(what)}); }
    void moved(double x, double y);
    void clicked(int button, int action, int modifiers);
    void pressed(int key, int scancode, int action, int modifiers);
    void resized();
    VkExtent2D extent() const;
};

Result<void> Window::Impl::open(const WindowOptions& options) {
    images = options.images;
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window = glfwCreateWindow(static_cast<int>(options.width), static_cast<int>(options.height), options.title.c_str(),
                              nullptr, nullptr);
    if (!window) return Error::of_machine("window", "cannot be opened: " + last_words());
    listen();
    asked = glfwGetTime();
    return make_surface();
}

Result<void> Window::Impl::make_surface() {
    if (!device->presents()) {
        return Error::of_machine(device->info().name,
                                 "has no windows: its driver or the Vulkan loader cannot show images on this display; "
                                 "write them to files");
    }
    const VkResult result = glfwCreateWindowSurface(device->instance().handle(), window, nullptr, &surface);
    if (result != VK_SUCCESS) return device->error("to make a window's surface", result);
    auto made = gpu::Swapchain::create(*device, surface, images);
    if (!made) return made.errors();
    swapchain = std::move(*made);
    return {};
}

void Window::Impl::drop_surface() {
    swapchain.reset();
    if (surface == VK_NULL_HANDLE) return;
    const gpu::Instance& instance = device->instance();
    const auto destroy =
        reinterpret_cast<PFN_vkDestroySurfaceKHR>(instance.functions()(instance.handle(), "vkDestroySurfaceKHR"));
    destroy(instance.handle(), std::exchange(surface, VK_NULL_HANDLE), nullptr);
}

void Window::Impl::listen() {
    glfwSetWindowUserPointer(window, this);
    static const auto of = [](GLFWwindow* one) { return static_cast<Impl*>(glfwGetWindowUserPointer(one)); };
    glfwSetCursorPosCallback(window, [](GLFWwindow* one, double x, double y) { of(one)->moved(x, y); });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* one, int entered) {
        if (!entered) of(one)->tell(PointerLeft{});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* one, int button, int action, int modifiers) {
        of(one)->clicked(button, action, modifiers);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* one, double x, double y) {
        of(one)->input.scroll += static_cast<float>(y);
        of(one)->tell(WheelTurned{{static_cast<float>(x), static_cast<float>(y)}});
    });
    glfwSetKeyCallback(window, [](GLFWwindow* one, int key, int scancode, int action, int modifiers) {
        of(one)->pressed(key, scancode, action, modifiers);
    });
    glfwSetCharCallback(window, [](GLFWwindow* one, unsigned character) {
        of(one)->tell(TextTyped{static_cast<char32_t>(character)});
    });
    listen_to_system();
    double x = 0, y = 0;
    glfwGetCursorPos(window, &x, &y);
    input.pointer = {static_cast<float>(x), static_cast<float>(y)};
}

void Window::Impl::listen_to_system() {
    static const auto of = [](GLFWwindow* one) { return static_cast<Impl*>(glfwGetWindowUserPointer(one)); };
    glfwSetWindowFocusCallback(window, [](GLFWwindow* one, int focused) { of(one)->tell(FocusChanged{focused != 0}); });
    glfwSetDropCallback(window, [](GLFWwindow* one, int count, const char** paths) {
        of(one)->tell(FilesDropped{std::vector<std::string>(paths, paths + count)});
    });
    glfwSetWindowContentScaleCallback(window, [](GLFWwindow* one, float x, float) { of(one)->tell(ScaleChanged{x}); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* one, int, int) { of(one)->resized(); });
    glfwSetWindowIconifyCallback(window, [](GLFWwindow* one, int) { of(one)->resized(); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* one) { of(one)->tell(Exposed{}); });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* one) { of(one)->tell(CloseRequested{}); });
}

void Window::Impl::resized() {
    const VkExtent2D pixels = extent();
    tell(Resized{pixels.width, pixels.height, glfwGetWindowAttrib(window, GLFW_ICONIFIED) != 0});
}

VkExtent2D Window::Impl::extent() const {
    if (glfwGetWindowAttrib(window, GLFW_ICONIFIED)) return {0, 0};
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

void Window::Impl::moved(double x, double y) {
    const Vec2 to{static_cast<float>(x), static_cast<float>(y)};
    const Vec2 by = to - input.pointer;
    input.pointer = to;
    const std::pair<int, Vec2*> drags[] = {{GLFW_MOUSE_BUTTON_LEFT, &input.left},
                                           {GLFW_MOUSE_BUTTON_MIDDLE, &input.middle},
                                           {GLFW_MOUSE_BUTTON_RIGHT, &input.right}};
    for (const auto& [button, drag] : drags)
        if (buttons[button]) *drag = {drag->x + by.x, drag->y + by.y};
    tell(PointerMoved{to});
}

void Window::Impl::clicked(int button, int action, int modifiers) {
    if (button <= GLFW_MOUSE_BUTTON_MIDDLE) buttons[button] = action == GLFW_PRESS;
    if (button > GLFW_MOUSE_BUTTON_5) return;
    // Not glfwGetCursorPos(): on X11 it asks where the pointer is now, which may be elsewhere.
    tell(ButtonChanged{static_cast<PointerButton>(button), action == GLFW_PRESS, input.pointer,
                       modifiers_of(modifiers)});
}

void Window::Impl::pressed(int key, int scancode, int action, int modifiers) {
    const bool down = action != GLFW_RELEASE;
    tell(KeyChanged{key_of(key), label_of(key, scancode), down, action == GLFW_REPEAT,
                    modifiers_of(modifiers, key_of(key), down)});
    if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT) input.shift = action != GLFW_RELEASE;
    const int number = key == GLFW_KEY_ESCAPE ? escape_key : key;
    if (number < 0 || number >= static_cast<int>(input.held.size())) return;
    input.held[static_cast<std::size_t>(number)] = action != GLFW_RELEASE;
    if (action == GLFW_PRESS) input.pressed.set(static_cast<std::size_t>(number));
}

Result<Window> Window::create(std::shared_ptr<const Display> display, std::shared_ptr<gpu::Device> device,
                              const WindowOptions& options) {
    auto impl = std::make_unique<Impl>();
    impl->display = std::move(display);
    impl->device = std::move(device);
    if (auto opened = impl->open(options); !opened) return opened.errors();
    return Window(std::move(impl));
}

Window::Window(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

namespace {

void wait_for_events(double patience) {
    if (patience <= 0) {
        glfwPollEvents();
    } else if (std::isinf(patience)) {
        glfwWaitEvents();
    } else {
        glfwWaitEventsTimeout(patience);
    }
}

}  // namespace

std::vector<WindowEvent> Window::events(double patience) {
    wait_for_events(impl_->events.empty() ? patience : 0);
    return std::exchange(impl_->events, {});
}

WindowInput Window::input(double patience) {
    wait_for_events(patience);
    impl_->events.clear();
    WindowInput& now = impl_->input;
    int width = 0, height = 0;
    glfwGetWindowSize(impl_->window, &width, &height);
    now.width = static_cast<float>(width);
    now.height = static_cast<float>(height);
    const double time = glfwGetTime();
    now.seconds = static_cast<float>(time - std::exchange(impl_->asked, time));
    const WindowInput told = now;
    now.left = now.middle = now.right = {};
    now.scroll = 0;
    now.pressed.reset();
    return told;
}

bool Window::closed() const {
    return glfwWindowShouldClose(impl_->window);
}

void Window::close() {
    glfwSetWindowShouldClose(impl_->window, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(impl_->window, title.c_str());
}

void Window::keep_open() {
    glfwSetWindowShouldClose(impl_->window, GLFW_FALSE);
}

// A missing shape leaves the arrow.
void Window::set_cursor(CursorShape shape) {
    GLFWcursor*& cursor = impl_->cursors[static_cast<std::size_t>(shape)];
    if (!cursor) cursor = glfwCreateStandardCursor(cursor_shapes[static_cast<std::size_t>(shape)]);
    glfwSetCursor(impl_->window, cursor);
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(impl_->window);
    return text ? text : "";
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(impl_->window, text.c_str());
}

float Window::content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(impl_->window, &x, &y);
    return x > 0 ? x : 1;
}

float Window::pixels_per_unit() const {
    int pixels = 0, units = 0, unused = 0;
    glfwGetFramebufferSize(impl_->window, &pixels, &unused);
    glfwGetWindowSize(impl_->window, &units, &unused);
    return pixels > 0 && units > 0 ? static_cast<float>(pixels) / static_cast<float>(units) : 1;
}

VkExtent2D Window::extent() const {
    return impl_->extent();
}

VkFormat Window::format() const {
    return impl_->swapchain->format();
}

bool Window::encodes_srgb() const {
    return impl_->swapchain->encodes_srgb();
}

VkPresentModeKHR Window::mode() const {
    return impl_->swapchain->mode();
}

Result<gpu::SwapchainImage> Window::next() {
    if (!impl_->swapchain) {  // the last attempt to make it again failed
        if (auto made = impl_->make_surface(); !made) return made.errors();
    }
    auto image = impl_->swapchain->acquire(extent());
    if (!image || image->state != gpu::Acquired::surface_lost) return image;
    impl_->drop_surface();
    if (auto made = impl_->make_surface(); !made) return made.errors();
    image = impl_->swapchain->acquire(extent());
    if (image && image->state == gpu::Acquired::surface_lost) return gpu::SwapchainImage{};  // retry next time
    return image;
}

Result<void> Window::show(const gpu::SwapchainImage& image, std::uint64_t done) {
    return impl_->swapchain->present(image, done);
}

}  // namespace weft::render
