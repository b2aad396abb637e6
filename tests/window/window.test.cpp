// Windows on a display without a screen (Xvfb), drawn by a software device with validation layers.
#include "render/window.h"

#include "gpu/commands.h"

#include "on_display.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace weft::render {
namespace {

using gpu::Acquired;
using testing::HasSubstr;

constexpr float red[] = {0.5f, 0, 0}, green[] = {0, 0.25f, 0}, blue[] = {0, 0, 1};
using Linear = const float (&)[3];

// Injected failures: the next call of each function returns this once.
VolkDeviceTable healthy;
VkResult acquire_says, present_says, create_says;
int swapchains;        // that exist
VkSwapchainKHR asked;  // of the last acquire
std::uint64_t waited;  // timeline value of the last wait

VkResult once(VkResult& says) {
    return std::exchange(says, VK_SUCCESS);
}
VKAPI_ATTR VkResult VKAPI_CALL acquire(VkDevice device, VkSwapchainKHR chain, std::uint64_t timeout,
                                       VkSemaphore semaphore, VkFence fence, std::uint32_t* index) {
    if (const VkResult failed = once(acquire_says); failed != VK_SUCCESS) return failed;
    asked = chain;
    return healthy.vkAcquireNextImageKHR(device, chain, timeout, semaphore, fence, index);
}
// Semaphores are waited for even if the window shows nothing.
VKAPI_ATTR VkResult VKAPI_CALL present(VkQueue queue, const VkPresentInfoKHR* info) {
    const VkResult result = healthy.vkQueuePresentKHR(queue, info);
    const VkResult failed = once(present_says);
    return failed == VK_SUCCESS ? result : failed;
}
VKAPI_ATTR VkResult VKAPI_CALL create(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                      const VkAllocationCallbacks* callbacks, VkSwapchainKHR* made) {
    if (const VkResult failed = once(create_says); failed != VK_SUCCESS) return failed;
    ++swapchains;
    return healthy.vkCreateSwapchainKHR(device, info, callbacks, made);
}
VKAPI_ATTR void VKAPI_CALL destroy(VkDevice device, VkSwapchainKHR chain, const VkAllocationCallbacks* callbacks) {
    --swapchains;
    healthy.vkDestroySwapchainKHR(device, chain, callbacks);
}
VKAPI_ATTR VkResult VKAPI_CALL wait(VkDevice device, const VkSemaphoreWaitInfo* info, std::uint64_t timeout) {
    waited = std::max(waited, *info->pValues);
    return healthy.vkWaitSemaphores(device, info, timeout);
}
void fail_on_demand(VolkDeviceTable& table) {
    healthy = table;
    acquire_says = present_says = create_says = VK_SUCCESS;
    swapchains = 0;
    waited = 0;
    table.vkAcquireNextImageKHR = acquire;
    table.vkQueuePresentKHR = present;
    table.vkCreateSwapchainKHR = create;
    table.vkDestroySwapchainKHR = destroy;
    table.vkWaitSemaphores = wait;
}

class WindowTest : public OnDisplay {
  protected:
    WindowTest() { device_options.intercept = fail_on_demand; }
    void TearDown() override {
        if (device) (void)device->wait(device->submitted());
        framebuffers.clear();
        frames.clear();
        pass = {};
        OnDisplay::TearDown();
    }

    bool show_window(const gpu::SwapchainOptions& images = {}) {
        if (!OnDisplay::show_window(images)) return false;
        const gpu::Attachment color{.format = window->format(), .after = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
        auto made = gpu::RenderPass::create(*device, {&color, 1}, "test");
        EXPECT_TRUE(made.ok());
        if (made) pass = std::move(*made);
        return made.ok();
    }
    /// Timeline value of the submit that fills the image.
    std::uint64_t fill(const gpu::SwapchainImage& image, Linear color) {
        auto framebuffer =
            gpu::Framebuffer::create(*device, pass, {&image.view, 1}, image.extent.width, image.extent.height);
        auto commands = gpu::Commands::create(*device);
        EXPECT_TRUE(framebuffer.ok() && commands.ok() && commands->begin().ok());
        VkClearValue clear{};
        clear.color = {{color[0], color[1], color[2], 1}};
        commands->begin_pass(pass, *framebuffer, {&clear, 1});
        commands->end_pass();
        EXPECT_TRUE(commands->end().ok());
        const auto value = commands->submit({}, image.semaphores);
        EXPECT_TRUE(value.ok());
        framebuffers.push_back(std::move(*framebuffer));
        frames.push_back(std::move(*commands));
        return value ? *value : 0;
    }
    void show(const gpu::SwapchainImage& image, Linear color) {
        ASSERT_EQ(image.state, Acquired::image);
        const auto shown = window->show(image, fill(image, color));
        EXPECT_TRUE(shown.ok()) << shown.error().message();
    }
    void draw(Linear color) { show(next(), color); }

    /// Whether this pixel of the window takes this color before a timeout.
    bool seen(Linear color, int x = 160, int y = 100) {
        std::array<int, 3> bytes{};
        for (int i = 0; i < 3; ++i) {
            const float v = color[i];
            const float encoded = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
            bytes[static_cast<std::size_t>(i)] =
                static_cast<int>(std::lround(255 * (window->encodes_srgb() ? encoded : v)));
        }
        return shown(bytes, x, y);
    }

    gpu::RenderPass pass;
    std::vector<gpu::Framebuffer> framebuffers;
    std::vector<gpu::Commands> frames;
};

TEST_F(WindowTest, shows_what_is_drawn) {
    if (!show_window()) return;
    EXPECT_EQ(window->extent().width, 320u);
    EXPECT_EQ(window->extent().height, 200u);
    EXPECT_TRUE(window->encodes_srgb());
    EXPECT_EQ(window->mode(), VK_PRESENT_MODE_FIFO_KHR);
    draw(red);
    EXPECT_TRUE(seen(red));
    draw(green);
    EXPECT_TRUE(seen(green));
    draw(blue);
    EXPECT_TRUE(seen(blue));
    EXPECT_TRUE(seen(blue, 319, 199)) << "to the last corner";
    for (int i = 0; i < 20; ++i) draw(i % 2 ? red : green);
    EXPECT_TRUE(seen(red));
}

TEST_F(WindowTest, takes_the_newest_image_where_that_is_asked_for) {
    if (!show_window({.mailbox = true})) return;
    EXPECT_EQ(window->mode(), VK_PRESENT_MODE_MAILBOX_KHR);
    for (int i = 0; i < 20; ++i) draw(red);
    draw(blue);
    EXPECT_TRUE(seen(blue));
}

TEST_F(WindowTest, two_frames_are_under_way_at_most) {
    if (!show_window()) return;
    std::vector<std::uint64_t> done;
    for (std::size_t i = 0; i < 8; ++i) {
        const auto image = next();
        ASSERT_EQ(image.state, Acquired::image);
        EXPECT_EQ(waited, i < 2 ? 0 : done[i - 2]) << "the frame before the last one is done, and no more than that";
        done.push_back(fill(image, red));
        EXPECT_TRUE(window->show(image, done.back()).ok());
    }
}

// The presentation of an image waits for its semaphore until an unknown time. After that the image can be acquired
// again.
TEST_F(WindowTest, every_image_has_a_semaphore_of_its_own) {
    if (!show_window()) return;
    std::map<std::uint32_t, VkSemaphore> of_image;
    VkSemaphore before = VK_NULL_HANDLE;
    const auto frame = [&] {
        const auto image = next();
        const auto known = of_image.try_emplace(image.index, image.semaphores.signal).first;
        EXPECT_EQ(known->second, image.semaphores.signal);
        EXPECT_NE(image.semaphores.wait, before) << "which may not have been waited for yet";
        before = image.semaphores.wait;
        show(image, red);
    };
    for (int i = 0; i < 5; ++i) frame();
    // A display shows an image for a while; this test has to keep it back.
    VkFenceCreateInfo info_of_fence{};
    info_of_fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    std::uint32_t kept = 0;
    ASSERT_EQ(healthy.vkCreateFence(device->handle(), &info_of_fence, nullptr, &fence), VK_SUCCESS);
    ASSERT_EQ(healthy.vkAcquireNextImageKHR(device->handle(), asked, ~0ull, VK_NULL_HANDLE, fence, &kept), VK_SUCCESS);
    EXPECT_EQ(healthy.vkWaitForFences(device->handle(), 1, &fence, VK_TRUE, ~0ull), VK_SUCCESS);
    healthy.vkDestroyFence(device->handle(), fence, nullptr);
    for (int i = 0; i < 5; ++i) frame();
    std::set<VkSemaphore> all;
    for (const auto& [index, semaphore] : of_image) all.insert(semaphore);
    EXPECT_EQ(all.size(), of_image.size());
    EXPECT_GT(of_image.size(), 1u);
}

TEST_F(WindowTest, has_new_images_when_it_is_resized) {
    if (!show_window()) return;
    draw(red);
    const std::uint64_t before = next().generation;
    input->resize(500, 300);
    ASSERT_TRUE(until([&] { return window->extent().width == 500; }));
    const auto image = next();
    EXPECT_EQ(image.extent.width, 500u);
    EXPECT_EQ(image.extent.height, 300u);
    EXPECT_GT(image.generation, before);
    show(image, green);
    EXPECT_TRUE(seen(green, 499, 299));
    EXPECT_EQ(next().state, Acquired::image);
}

TEST_F(WindowTest, may_be_resized_between_getting_an_image_and_showing_it) {
    if (!show_window()) return;
    draw(red);
    for (const unsigned width : {400u, 200u, 600u}) {
        const auto image = next();
        ASSERT_EQ(image.state, Acquired::image);
        const std::uint64_t done = fill(image, green);
        input->resize(width, 250);
        ASSERT_TRUE(until([&] { return window->extent().width == width; }));
        EXPECT_TRUE(window->show(image, done).ok());
        const auto after = next();
        ASSERT_EQ(after.state, Acquired::image);
        EXPECT_EQ(after.extent.width, width);
        show(after, blue);
        EXPECT_TRUE(seen(blue, static_cast<int>(width) - 1, 249));
    }
}

TEST_F(WindowTest, may_be_resized_again_and_again) {
    if (!show_window()) return;
    for (unsigned i = 0; i < 30; ++i) {
        input->resize(200 + 10 * i, 200);
        (void)window->input();
        if (const auto image = next(); image.state == Acquired::image && i % 3 != 0) show(image, red);
        EXPECT_LE(swapchains, 6) << "old ones are kept while they are in use, and no longer";
    }
    ASSERT_TRUE(until([&] { return window->extent().width == 490; }));
    draw(blue);
    EXPECT_TRUE(seen(blue, 489, 199));
    for (int i = 0; i < 10; ++i) draw(green);
    EXPECT_TRUE(seen(green));
    EXPECT_EQ(swapchains, 1);
}

TEST_F(WindowTest, out_of_date_images_are_made_again) {
    if (!show_window()) return;
    draw(red);
    const auto first = next();
    present_says = VK_ERROR_OUT_OF_DATE_KHR;
    show(first, green);
    const auto second = next();
    EXPECT_GT(second.generation, first.generation);
    show(second, green);
    acquire_says = VK_ERROR_OUT_OF_DATE_KHR;
    const auto third = next();
    EXPECT_GT(third.generation, second.generation);
    show(third, blue);
    EXPECT_TRUE(seen(blue));
}

TEST_F(WindowTest, what_is_suboptimal_for_good_is_not_made_again_each_time) {
    if (!show_window()) return;
    draw(red);
    const auto first = next();
    present_says = VK_SUBOPTIMAL_KHR;
    show(first, green);
    EXPECT_EQ(next().generation, first.generation);
}

TEST_F(WindowTest, draws_nothing_while_it_is_minimized) {
    if (!show_window()) return;
    draw(red);
    input->set_minimized(true);
    ASSERT_TRUE(until([&] { return window->extent().width == 0; }));
    EXPECT_EQ(next().state, Acquired::nothing);
    EXPECT_EQ(next().state, Acquired::nothing);
    input->set_minimized(false);
    ASSERT_TRUE(until([&] { return window->extent().width == 320; }));
    draw(blue);
    EXPECT_TRUE(seen(blue));
}

TEST_F(WindowTest, draws_nothing_where_no_image_comes_in_time) {
    if (!show_window()) return;
    draw(red);
    acquire_says = VK_TIMEOUT;
    EXPECT_EQ(next().state, Acquired::nothing);
    draw(blue);
    EXPECT_TRUE(seen(blue));
}

TEST_F(WindowTest, a_surface_that_is_lost_is_made_again) {
    if (!show_window()) return;
    draw(red);
    acquire_says = VK_ERROR_SURFACE_LOST_KHR;
    draw(green);
    EXPECT_TRUE(seen(green));
    present_says = VK_ERROR_SURFACE_LOST_KHR;
    draw(red);
    draw(blue);
    EXPECT_TRUE(seen(blue));
    input->resize(400, 200);
    ASSERT_TRUE(until([&] { return window->extent().width == 400; }));
    create_says = VK_ERROR_SURFACE_LOST_KHR;
    draw(green);
    EXPECT_TRUE(seen(green, 399, 199));
}

TEST_F(WindowTest, an_image_that_was_not_shown_is_given_back) {
    if (!show_window()) return;
    for (int i = 0; i < 10; ++i) EXPECT_EQ(next().state, Acquired::image);
    draw(blue);
    EXPECT_TRUE(seen(blue));
    (void)fill(next(), red);  // drawn, but not shown
    draw(green);
    EXPECT_TRUE(seen(green));
    EXPECT_EQ(next().state, Acquired::image);  // released when the window closes
}

TEST_F(WindowTest, a_device_that_is_lost_is_an_error) {
    if (!show_window()) return;
    draw(red);
    acquire_says = VK_ERROR_DEVICE_LOST;
    const auto image = window->next();
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().fault, Fault::machine);
    EXPECT_THAT(image.error().what, HasSubstr("failed to get a window's next image: VK_ERROR_DEVICE_LOST"));
    const auto taken = next();
    present_says = VK_ERROR_DEVICE_LOST;
    EXPECT_FALSE(window->show(taken, fill(taken, red)).ok());
    input->resize(400, 200);
    ASSERT_TRUE(until([&] { return window->extent().width == 400; }));
    create_says = VK_ERROR_DEVICE_LOST;
    EXPECT_FALSE(window->next().ok());
    draw(blue);
    EXPECT_TRUE(seen(blue)) << "nothing was left half done";
}

TEST_F(WindowTest, is_closed_when_somebody_asks_for_it) {
    if (!show_window()) return;
    (void)window->input();
    EXPECT_FALSE(window->closed());
    input->ask_to_close();
    EXPECT_TRUE(until([&] { return window->closed(); }));
    draw(red);  // until it is destroyed
}

TEST_F(WindowTest, is_closed_by_the_program) {
    if (!show_window()) return;
    window->close();
    EXPECT_TRUE(window->closed());
}

TEST_F(WindowTest, hears_what_hands_do) {
    if (!show_window()) return;
    draw(red);
    WindowInput all;  // of several polls
    const auto hear = [&](const std::function<bool()>& so) {
        for (int i = 0; i < 1000 && !so(); ++i) {
            const WindowInput now = window->input(0.02);
            const Vec2 right = all.right, left = all.left;
            const float scroll = all.scroll;
            const Keys pressed = all.pressed;
            all = now;
            all.right = {right.x + now.right.x, right.y + now.right.y};
            all.left = {left.x + now.left.x, left.y + now.left.y};
            all.scroll += scroll;
            all.pressed |= pressed;
        }
        return so();
    };
    input->point_at(100, 50);
    EXPECT_TRUE(hear([&] { return all.pointer == Vec2{100, 50}; }));
    EXPECT_EQ(all.right, Vec2{}) << "no button was held";
    EXPECT_EQ(all.width, 320);
    EXPECT_EQ(all.height, 200);
    input->button(3, true);
    input->point_at(130, 60);
    EXPECT_TRUE(hear([&] { return all.right == Vec2{30, 10}; }));
    input->button(3, false);
    input->point_at(200, 100);
    EXPECT_TRUE(hear([&] { return all.pointer == Vec2{200, 100}; }));
    EXPECT_EQ(all.right, (Vec2{30, 10}));
    EXPECT_EQ(all.left, Vec2{});
    input->button(4, true);
    input->button(4, true);
    EXPECT_TRUE(hear([&] { return all.scroll == 2; }));
    input->button(5, true);
    EXPECT_TRUE(hear([&] { return all.scroll == 1; }));
    input->key("w", true);
    EXPECT_TRUE(hear([&] { return all.held['W']; }));
    input->key("w", false);
    EXPECT_TRUE(hear([&] { return !all.held['W']; }));
    input->key("Shift_L", true);
    EXPECT_TRUE(hear([&] { return all.shift; }));
    input->key("Escape", true);
    input->key("Escape", false);
    input->key("3", true);
    EXPECT_TRUE(hear([&] { return all.held['3']; }));
    EXPECT_TRUE(all.pressed['W'] && all.pressed['3'] && all.pressed[escape_key]);
    EXPECT_FALSE(all.pressed['S'] || all.held[escape_key]);
    EXPECT_TRUE(window->input().pressed.none()) << "told once";
}

TEST_F(WindowTest, lists_events_in_their_order) {
    if (!show_window()) return;
    draw(red);
    (void)window->events();
    std::vector<WindowEvent> all;
    const auto wait_for = [&](const std::function<bool()>& so) {
        for (int i = 0; i < 1000 && !so(); ++i)
            for (WindowEvent& event : window->events(0.02)) all.push_back(std::move(event));
        return so();
    };
    const auto count = [&]<class What>(What) {
        return std::ranges::count_if(all,
                                     [](const WindowEvent& one) { return std::holds_alternative<What>(one.what); });
    };
    input->point_at(100, 50);
    input->button(1, true);
    input->point_at(130, 60);
    input->button(1, false);
    input->button(4, true);
    input->key("Shift_L", true);
    input->key("w", true);
    input->key("w", false);
    input->key("Shift_L", false);
    input->key("Escape", true);
    input->key("Escape", false);
    input->resize(400, 300);
    input->ask_to_close();
    ASSERT_TRUE(wait_for([&] { return count(CloseRequested{}) > 0 && count(Resized{}) > 0; }));
    std::string told;
    double before = 0;
    for (const WindowEvent& event : all) {
        EXPECT_GE(event.time, before);
        before = event.time;
        if (const auto* one = std::get_if<PointerMoved>(&event.what))
            told += "move" + std::to_string(static_cast<int>(one->to.x)) + " ";
        if (const auto* one = std::get_if<ButtonChanged>(&event.what)) {
            told += one->down ? "press " : "release ";
            EXPECT_EQ(one->at.x, one->down ? 100 : 130);
        }
        if (const auto* one = std::get_if<WheelTurned>(&event.what))
            told += "wheel" + std::to_string(static_cast<int>(one->by.y)) + " ";
        if (const auto* one = std::get_if<TextTyped>(&event.what))
            told += std::string("text_") + static_cast<char>(one->character) + " ";
        if (const auto* one = std::get_if<KeyChanged>(&event.what)) {
            told += one->key == Key::w            ? "w"
                    : one->key == Key::escape     ? "escape"
                    : one->key == Key::left_shift ? "shift"
                                                  : "?";
            told += one->down ? "+ " : "- ";
            EXPECT_EQ(one->label, one->key);
            if (one->key == Key::left_shift) {
                EXPECT_EQ(one->modifiers.shift, one->down) << "after the change";
            }
        }
    }
    EXPECT_THAT(told, HasSubstr("move100 press move130 release wheel1 shift+ w+ "));
    EXPECT_THAT(told, HasSubstr("w- shift- escape+ escape- "));
    EXPECT_THAT(told, HasSubstr("text_"));
    const auto resized =
        std::ranges::find_if(all, [](const WindowEvent& one) { return std::holds_alternative<Resized>(one.what); });
    EXPECT_EQ(std::get<Resized>(resized->what).width, 400u);
    EXPECT_FALSE(std::get<Resized>(resized->what).minimized);
    EXPECT_TRUE(window->closed());
    window->keep_open();
    EXPECT_FALSE(window->closed());
    EXPECT_TRUE(window->events().empty()) << "told once";
}

TEST_F(WindowTest, a_wait_for_events_is_ended_by_another_thread) {
    if (!show_window()) return;
    for (int i = 0; i < 10; ++i) (void)window->events(0.01);
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        display->wake();
    });
    const double before = display->now();
    (void)window->events(20);
    EXPECT_LT(display->now() - before, 10);
    other.join();
}

TEST_F(WindowTest, has_a_cursor_a_clipboard_and_a_scale) {
    if (!show_window()) return;
    for (const CursorShape shape :
         {CursorShape::text, CursorShape::hand, CursorShape::resize_x, CursorShape::resize_both, CursorShape::arrow})
        window->set_cursor(shape);
    window->set_clipboard("weft µ");
    EXPECT_EQ(window->clipboard(), "weft µ");
    EXPECT_GT(window->content_scale(), 0.5f);
    EXPECT_EQ(window->pixels_per_unit(), 1);
}

TEST_F(WindowTest, may_have_images_that_do_not_encode) {
    if (!show_window({.plain = true})) return;
    EXPECT_FALSE(window->encodes_srgb());
    draw(green);
    EXPECT_TRUE(seen(green));
}

TEST_F(WindowTest, there_may_be_two) {
    if (!show_window()) return;
    auto other = Window::create(display, device, {.title = "other", .width = 100, .height = 100});
    ASSERT_TRUE(other.ok()) << other.error().message();
    draw(red);
    window->close();
    EXPECT_FALSE(other->closed());
    auto image = other->next();
    ASSERT_TRUE(image.ok());
    ASSERT_EQ(image->state, Acquired::image);
    EXPECT_TRUE(other->show(*image, fill(*image, blue)).ok());
    draw(green);
    EXPECT_TRUE(seen(green, 300, 180));
    EXPECT_TRUE(seen(blue, 50, 50)) << "it lies on top";
    (void)device->wait(device->submitted());
}

TEST_F(WindowTest, a_device_without_windows_is_an_error) {
    if (!device) return;
    auto plain = gpu::Instance::create();
    ASSERT_TRUE(plain.ok());
    auto opened = gpu::Device::create(*plain, info);
    ASSERT_TRUE(opened.ok());
    EXPECT_FALSE((*opened)->presents());
    const auto made = Window::create(display, *opened);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().where, info.name);
    EXPECT_EQ(made.error().fault, Fault::machine);
    EXPECT_THAT(made.error().what, HasSubstr("write them to files"));
}

TEST(DisplayTest, there_is_none_without_one) {
    const std::string name = std::getenv("DISPLAY");
    const auto without = [](const char* other) {
        other ? ::setenv("DISPLAY", other, 1) : ::unsetenv("DISPLAY");
        const auto opened = Display::open();
        EXPECT_FALSE(opened.ok());
        return opened ? Error{} : opened.error();
    };
    EXPECT_THAT(without(nullptr).message(), HasSubstr("window: there is no display; set DISPLAY"));
    EXPECT_THAT(without(":4711").message(), HasSubstr("there is no display"));
    EXPECT_EQ(without(nullptr).fault, Fault::machine);
    ::setenv("DISPLAY", name.c_str(), 1);
    const auto opened = Display::open();
    ASSERT_TRUE(opened.ok()) << opened.error().message();
    EXPECT_EQ(Display::open().value(), *opened) << "one for all";
}

}  // namespace
}  // namespace weft::render
