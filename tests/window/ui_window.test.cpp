// The window of a user interface on a display without a screen, driven by simulated user input that aims at names.
#include "editor/ui/ui_window.h"

#include "base/temporary_folder.test.h"
#include "editor/ui/widget_page.test.h"

#include "user_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

namespace weft::editor {
namespace {

using testing::HasSubstr;

double processor_seconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class UiWindowTest : public testing::Test {
  protected:
    void TearDown() override {
        input.reset();
        window.reset();
        const std::lock_guard lock(mutex);
        for (const std::string& message : messages) ADD_FAILURE() << message;
    }
    bool open(UiWindowOptions options = {}) {
        options.title = "weft ui";
        if (options.width == 1280) options.width = 900, options.height = 640;
        options.validation = true;
        options.on_message = [this](std::string_view text) {
            const std::lock_guard lock(mutex);
            messages.emplace_back(text);
        };
        auto made = UiWindow::open(options);
        EXPECT_TRUE(made.ok()) << made.error().message();
        if (!made) return false;
        window = std::move(*made);
        input.emplace("weft ui");
        frame = [this](Ui& ui) -> Result<void> {
            page.build(ui);
            return {};
        };
        input->point_at(450, 400);  // where nothing has a tooltip
        return settle();
    }
    /// Turns until what was sent has been processed: nothing is left, and nothing comes for a while.
    bool settle() {
        for (int i = 0, quiet = 0; i < 1000 && quiet < 3; ++i) {
            const std::uint64_t before = window->statistics().frames;
            const auto done = window->turn(frame, patience);
            EXPECT_TRUE(done.ok()) << done.error().message();
            if (!done) return false;
            quiet = window->statistics().frames == before ? quiet + 1 : 0;
        }
        return true;
    }
    const ProbedWidget& widget(const char* path) {
        static const ProbedWidget none;
        const ProbedWidget* found = window->ui().probe().find(path);
        EXPECT_TRUE(found) << path;
        return found ? *found : none;
    }
    void point_at(const char* path) {
        const ProbedWidget& one = widget(path);
        input->point_at(static_cast<int>(one.x + one.width / 2), static_cast<int>(one.y + one.height / 2));
    }
    void click(const char* path) {
        point_at(path);
        input->button(1, true);
        input->button(1, false);
    }
    void press(const std::string& key) {
        input->key(key, true);
        input->key(key, false);
    }

    double patience = 0.05;  // s: longer than a frame
    std::unique_ptr<UiWindow> window;
    std::optional<UserInput> input;
    WidgetPage page;
    UiWindow::Frame frame;
    std::mutex mutex;
    std::vector<std::string> messages;
};

TEST_F(UiWindowTest, widgets_obey_the_mouse_and_the_keys) {
    if (!open()) return;
    click("toolbar/add");
    settle();
    EXPECT_EQ(page.added, 1);
    click("properties/fabric/damping");
    settle();
    press("0");
    press("period");
    press("7");
    press("Return");
    settle();
    EXPECT_NEAR(page.damping, 0.7, 1e-9);
    EXPECT_EQ(page.log, "damping! ");
    page.log.clear();
    const ProbedWidget damping = widget("properties/fabric/damping");
    point_at("properties/fabric/damping");
    input->button(1, true);
    const int x = static_cast<int>(damping.x + damping.width / 2), y = static_cast<int>(damping.y + damping.height / 2);
    input->point_at(x - 20, y);
    input->point_at(x - 40, y);
    input->button(1, false);
    settle();
    EXPECT_NEAR(page.damping, 0.7 - 40 / static_cast<double>(damping.width), 0.01);
    EXPECT_THAT(page.log, testing::EndsWith("damping! "));
    click("properties/fabric/damping");
    click("properties/fabric/damping");
    settle();
    EXPECT_EQ(page.damping, 0.1) << "a double click resets";
}

TEST_F(UiWindowTest, at_three_frames_a_second_no_click_and_no_key_is_lost) {
    patience = 0.4;
    if (!open({.least_frame = 0.33})) return;
    const std::uint64_t frames = window->statistics().frames;
    const auto start = std::chrono::steady_clock::now();
    click("toolbar/add");
    click("toolbar/add");
    click("toolbar/add");
    click("properties/name");
    for (const char* key : {"s", "i", "l", "k", "Return"}) press(key);
    settle();
    EXPECT_EQ(page.added, 3);
    EXPECT_EQ(page.name, "silk");
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_GE(took, 0.33 * static_cast<double>(window->statistics().frames - frames - 1));
}

TEST_F(UiWindowTest, shows_what_a_picture_shows) {
    if (!open()) return;
    window->redraw();
    settle();
    // The lists of the last frame are still there.
    auto drawn = window->renderer().picture(*ImGui::GetDrawData(), window->ui().theme().colors.background);
    ASSERT_TRUE(drawn.ok());
    int compared = 0;
    for (std::uint32_t y = 4; y < drawn->height; y += 37)
        for (std::uint32_t x = 4; x < drawn->width; x += 41, ++compared) {
            const std::uint8_t* pixel = drawn->at(x, y);
            const auto shown = input->color(static_cast<int>(x), static_cast<int>(y));
            for (int i = 0; i < 3; ++i)
                ASSERT_NEAR(shown[static_cast<std::size_t>(i)], pixel[i], 1) << "at " << x << ", " << y;
        }
    EXPECT_GT(compared, 300);
}

TEST_F(UiWindowTest, idle_costs_no_processor_time) {
    if (!open()) return;
    const std::uint64_t frames = window->statistics().frames;
    const double before = processor_seconds();
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(window->turn(frame, 0.5).ok());
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double share = (processor_seconds() - before) / took;
    EXPECT_GT(took, 1.9);
    EXPECT_EQ(window->statistics().frames, frames);
    EXPECT_LT(share, 0.02);
    RecordProperty("percent_of_one_core", std::to_string(100 * share));
    std::printf("idle: %.2f %% of one core\n", 100 * share);
}

TEST_F(UiWindowTest, is_woken_by_other_threads) {
    if (!open()) return;
    const std::uint64_t frames = window->statistics().frames;
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        window->redraw();
    });
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(window->turn(frame, 20).ok());
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_GT(window->statistics().frames, frames);
    other.join();
}

TEST_F(UiWindowTest, frames_that_look_the_same_are_not_presented) {
    if (!open()) return;
    const UiWindow::Statistics before = window->statistics();
    for (int i = 0; i < 5; ++i) {
        window->redraw();
        settle();
    }
    EXPECT_GE(window->statistics().frames, before.frames + 5);
    EXPECT_EQ(window->statistics().presented, before.presented);
    page.done = 0.9f;
    window->redraw();
    settle();
    EXPECT_EQ(window->statistics().presented, before.presented + 1);
}

TEST_F(UiWindowTest, goes_on_when_it_is_small_resized_and_minimized) {
    if (!open()) return;
    input->resize(320, 200);
    settle();
    EXPECT_EQ(window->ui().size().x, 320);
    for (unsigned i = 0; i < 30; ++i) {
        input->resize(320 + 17 * i, 200 + 11 * (i % 7));
        ASSERT_TRUE(window->turn(frame, 0).ok());
    }
    settle();
    EXPECT_EQ(window->ui().size().x, 320 + 17 * 29);
    input->set_minimized(true);
    settle();
    EXPECT_EQ(window->window().extent().width, 0u);
    const std::uint64_t presented = window->statistics().presented, frames = window->statistics().frames;
    page.done = 0.7f;
    window->redraw();
    settle();
    EXPECT_EQ(window->statistics().presented, presented);
    EXPECT_LT(window->statistics().frames, frames + 20) << "it sleeps";
    input->set_minimized(false);
    settle();
    EXPECT_GT(window->statistics().presented, presented);
    for (const unsigned side : {1u, 2u, 900u}) {
        input->resize(side, side);
        settle();
    }
    for (const float scale : {3.0f, 0.75f, 1.0f}) {
        window->ui().set_theme(scale > 1 ? Appearance::light : Appearance::dark, scale);
        settle();
    }
}

TEST_F(UiWindowTest, asks_before_it_closes) {
    if (!open()) return;
    bool saved = false;
    int asked = 0;
    frame = [&](Ui& ui) -> Result<void> {
        page.build(ui);
        if (!window->close_requested()) return {};
        ++asked;
        if (!saved) window->keep_open();
        return {};
    };
    input->ask_to_close();
    settle();
    EXPECT_EQ(asked, 1);
    EXPECT_FALSE(window->window().closed());
    saved = true;
    input->ask_to_close();
    EXPECT_TRUE(window->run(frame).ok());
    EXPECT_EQ(asked, 2);
}

TEST_F(UiWindowTest, the_probe_file_follows) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "probe.json";
    if (!open({.probe = file})) return;
    const auto text = [&] {
        std::ostringstream all;
        all << std::ifstream(file).rdbuf();
        return all.str();
    };
    EXPECT_THAT(text(), HasSubstr("\"toolbar/play\": {\"x\": "));
    EXPECT_THAT(text(), HasSubstr("\"window\": {\"width\": 900, \"height\": 640, \"scale\": 1}"));
    const std::uint64_t settled = window->ui().probe().settled;
    click("toolbar/play");
    settle();
    EXPECT_GT(window->ui().probe().settled, settled);
    EXPECT_THAT(text(), HasSubstr("\"settled\": " + std::to_string(window->ui().probe().settled)));
}

TEST_F(UiWindowTest, copies_to_the_clipboard) {
    if (!open()) return;
    window->window().set_clipboard("µ → cloth");
    EXPECT_EQ(window->window().clipboard(), "µ → cloth");
    click("properties/name");
    input->key("Control_L", true);
    press("v");
    input->key("Control_L", false);
    press("Return");
    settle();
    EXPECT_EQ(page.name, "µ → cloth");
}

VolkDeviceTable unharmed;
bool gone = false;
VKAPI_ATTR VkResult VKAPI_CALL lose_on_demand(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                              VkFence fence) {
    return gone ? VK_ERROR_DEVICE_LOST : unharmed.vkQueueSubmit(queue, count, infos, fence);
}

TEST_F(UiWindowTest, a_lost_device_ends_it_with_an_error_that_says_so) {
    gone = false;
    UiWindowOptions options;
    options.intercept = [](VolkDeviceTable& table) {
        unharmed = table;
        table.vkQueueSubmit = lose_on_demand;
    };
    if (!open(options)) return;
    gone = true;
    page.done = 0.1f;
    window->redraw();
    const auto done = window->run(frame);
    gone = false;
    ASSERT_FALSE(done.ok());
    EXPECT_THAT(done.error().message(), HasSubstr("VK_ERROR_DEVICE_LOST"));
    EXPECT_EQ(done.error().fault, Fault::machine);
}

TEST_F(UiWindowTest, an_unknown_device_is_an_error_with_the_names_of_others) {
    const auto made = UiWindow::open({.device = "no such device"});
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().message(), HasSubstr("no such device"));
}

// A measurement, run by hand: --gtest_also_run_disabled_tests --gtest_filter=*frame_time
TEST_F(UiWindowTest, DISABLED_frame_time) {
    auto made = UiWindow::open({.title = "weft ui", .width = 1280, .height = 720, .most_rate = 1e6});
    ASSERT_TRUE(made.ok());
    window = std::move(*made);
    page.view = window->renderer().add_image();
    Image8 view{668, 652, std::vector<std::uint8_t>(668 * 652 * 4, 200)};
    std::vector<double> build, draw, whole;
    const double before = processor_seconds();
    for (int i = 0; i < 200; ++i) {
        const auto start = std::chrono::steady_clock::now();
        view.rgba[0] = static_cast<std::uint8_t>(i);
        ASSERT_TRUE(window->renderer().update(page.view, view).ok());
        page.done = static_cast<float>(i) / 200;
        window->redraw();
        ASSERT_TRUE(window
                        ->turn(
                            [&](Ui& ui) -> Result<void> {
                                page.build(ui);
                                return {};
                            },
                            0)
                        .ok());
        whole.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        build.push_back(window->statistics().build_ms);
        draw.push_back(window->statistics().draw_ms);
    }
    const auto at = [](std::vector<double>& all, double share) {
        std::ranges::sort(all);
        return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
    };
    // Processor time hardly depends on what else runs on the machine.
    std::printf("frame: median %.2f ms, 95 %% %.2f ms; content %.2f ms; draw and present %.2f ms; processor %.2f ms\n",
                at(whole, 0.5), at(whole, 0.95), at(build, 0.5), at(draw, 0.5),
                (processor_seconds() - before) * 1e3 / static_cast<double>(whole.size()));
}

}  // namespace
}  // namespace weft::editor
