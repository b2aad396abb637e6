#include "editor/view/view_thread.h"

#include "cpu/cpu_backend.h"
#include "gpu/test_device.h"
#include "mesh/procedural.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

namespace weft::editor {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<const ClothModel> sheet() {
    TriangleMesh mesh = make_grid({1, 1}, {13, 13}, GridDiagonal::alternating);
    auto topology = build_topology(mesh);
    auto built = build_cloth_model({.name = "sheet", .mesh = std::move(mesh)}, std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

class ViewThreadTest : public gpu::OnDevice {
  protected:
    void SetUp() override {
        OnDevice::SetUp();
        if (HasFatalFailure()) return;
        world.add(sheet());
        world.add(make_collider({.name = "ball", .shape = SphereDesc{0.2f}, .transform = {.position = {0, -0.3f, 0}}}));
        world.add(make_collider({.name = "ground", .shape = PlaneDesc{{0, 1, 0}, -0.5f}}));
        base = {.world = copies.copy(world),
                .scene = std::make_shared<const SceneDesc>(),
                .camera = {.position = {0.8f, 0.9f, 2}, .target = {}, .fov = 40},
                .width = 160,
                .height = 90};
    }

    ViewThreadOptions options() {
        ViewThreadOptions made;
        made.open_device = [this] {
            const std::lock_guard lock(mutex);
            ++opened;
            if (refuse) return Result<std::shared_ptr<gpu::Device>>(Error{"device", "is refused"});
            return gpu::Device::create(instance, info, {.intercept = intercept});
        };
        made.on_image = [this] {
            std::unique_lock lock(mutex);
            arrived.notify_all();
            passing.wait(lock, [&] { return !held; });
        };
        made.samples = 1;
        made.settled = 20ms;
        return made;
    }
    /// The first image for which `is_right`; null after a minute without one.
    template <class Right>
    std::shared_ptr<const ViewImage> wait_for(const ViewThread& thread, Right&& is_right) {
        const auto end = std::chrono::steady_clock::now() + 60s;
        while (std::chrono::steady_clock::now() < end) {
            if (auto image = thread.image(); image && is_right(*image)) return image;
            std::unique_lock lock(mutex);
            arrived.wait_for(lock, 5ms);
        }
        ADD_FAILURE() << "no such image";
        return nullptr;
    }
    static bool is_best(const ViewImage& image) { return image.percent == 100 && !image.draft; }
    void hold(bool on) {
        {
            const std::lock_guard lock(mutex);
            held = on;
        }
        passing.notify_all();
    }

    World world{std::move(*make_cpu_backend()), {}};
    WorldFrameCopies copies;
    ViewRequest base;
    std::function<void(VolkDeviceTable&)> intercept;
    std::mutex mutex;
    std::condition_variable arrived, passing;
    bool refuse = false, held = false;
    int opened = 0;
};

// Labels: no-asan
TEST_F(ViewThreadTest, ends_with_an_image_of_the_best_quality_and_is_then_idle) {
    ViewThread thread(options());
    EXPECT_EQ(thread.image(), nullptr);
    const std::uint64_t number = thread.request(base);
    const auto image = wait_for(thread, is_best);
    ASSERT_TRUE(image);
    EXPECT_TRUE(image->errors.empty());
    EXPECT_EQ(image->number, number);
    EXPECT_EQ(image->image.width, 160u);
    EXPECT_EQ(image->image.height, 90u);
    EXPECT_EQ(image->camera, base.camera);
    EXPECT_EQ(image->frame, 0u);
    EXPECT_GT(image->ms, 0);
    const std::uint64_t count = thread.count();
    EXPECT_LE(count, 2u);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(thread.request(base), number) << "the same request";
    std::this_thread::sleep_for(200ms);
    EXPECT_EQ(thread.count(), count) << "it draws though nothing has changed";
}

// Labels: no-asan
TEST_F(ViewThreadTest, shows_paint_as_colors_of_the_cloth) {
    ViewThread thread(options());
    ViewRequest request = base;
    request.camera = {.position = {0, 2, 0.01f}, .target = {}, .fov = 20};
    const auto painted = [&](std::size_t particles, float value) {
        request.paint = std::make_shared<const ClothPaint>(
            ClothPaint{.cloth = "sheet", .values = std::vector<float>(particles, value)});
        const std::uint64_t number = thread.request(request);
        const auto image = wait_for(thread, [&](const ViewImage& one) { return one.number == number && is_best(one); });
        std::array<int, 3> color{-1, -1, -1};
        if (image) std::copy_n(image->image.at(80, 45), 3, color.begin());
        return color;
    };
    const auto low = painted(169, 0), high = painted(169, 1), other = painted(7, 1);
    EXPECT_GT(high[0], 200);
    EXPECT_LT(high[2], 100);
    EXPECT_LT(low[0], 110);
    EXPECT_GT(other[2], 110) << "values of another cloth are not shown";
}

// Labels: no-asan
TEST_F(ViewThreadTest, draws_each_change) {
    ViewThread thread(options());
    thread.request(base);
    std::vector<std::uint8_t> before;
    const auto expect_change = [&](const ViewRequest& request, const char* what) {
        const std::uint64_t number = thread.request(request);
        const auto image = wait_for(thread, [&](const ViewImage& one) { return one.number == number && is_best(one); });
        ASSERT_TRUE(image) << what;
        EXPECT_TRUE(image->errors.empty()) << what;
        EXPECT_NE(image->image.rgba, before) << what;
        before = image->image.rgba;
    };
    expect_change(base, "first");
    ViewRequest next = base;
    next.camera.position.x += 0.3f;
    expect_change(next, "camera");
    next.overlays = {find_overlay("wireframe").value()};
    expect_change(next, "overlay");
    next.selected_cloths = {"sheet"};
    expect_change(next, "selected cloth");
    next.selected_cloths = {};
    next.selected_colliders = {"ball"};
    expect_change(next, "selected collider");
    next.selected_colliders = {"ground"};
    expect_change(next, "selected plane");
    for (int i = 0; i < 10; ++i) world.step(1.0 / 60);
    next.world = copies.copy(world);
    expect_change(next, "frame");
    EXPECT_EQ(thread.image()->frame, 10u);
    auto scene = std::make_shared<SceneDesc>();
    scene->light.exposure = 1;
    next.scene = scene;
    expect_change(next, "light");
    next.width = 120;
    expect_change(next, "size");
    EXPECT_EQ(thread.image()->image.width, 120u);
    next.width = 0;
    thread.request(next);
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(thread.image()->image.width, 120u) << "a window without pixels";
}

// Labels: no-asan
TEST_F(ViewThreadTest, leaves_out_what_is_hidden) {
    ViewThread thread(options());
    const auto image_without = [&](std::vector<std::string> hidden) {
        ViewRequest request = base;
        request.hidden = std::move(hidden);
        const std::uint64_t number = thread.request(request);
        const auto image = wait_for(thread, [&](const ViewImage& one) { return one.number == number && is_best(one); });
        return image ? image->image.rgba : std::vector<std::uint8_t>();
    };
    const auto whole = image_without({});
    std::set<std::vector<std::uint8_t>> images{whole};
    for (const char* name : {"sheet", "ball", "ground"})
        EXPECT_TRUE(images.insert(image_without({name})).second) << name;
    EXPECT_EQ(image_without({}), whole);
    EXPECT_EQ(image_without({"nobody"}), whole);
}

TEST_F(ViewThreadTest, draws_only_the_newest_request) {
    ViewThread thread(options());
    hold(true);  // the thread stops after its next image
    thread.request(base);
    ASSERT_TRUE(wait_for(thread, [](const ViewImage&) { return true; }));
    std::uint64_t last = 0;
    ViewRequest next = base;
    for (int i = 0; i < 50; ++i) {
        next.camera.position.x += 0.01f;
        last = thread.request(next);
    }
    const std::uint64_t count = thread.count();
    hold(false);
    const auto image = wait_for(thread, [&](const ViewImage& one) { return one.number > 1; });
    ASSERT_TRUE(image);
    EXPECT_EQ(image->number, last);
    EXPECT_EQ(image->camera, next.camera);
    EXPECT_LE(thread.count(), count + 2);
}

// Labels: no-asan
TEST_F(ViewThreadTest, replaces_outlines_without_drawing_the_scene_again) {
    ViewThread thread(options());
    thread.request(base);
    const auto plain = wait_for(thread, is_best);
    ASSERT_TRUE(plain);
    const std::uint64_t count = thread.count();
    ViewRequest next = base;
    next.selected_cloths = {"sheet"};
    const std::uint64_t number = thread.request(next);
    const auto outlined = wait_for(thread, [&](const ViewImage& one) { return one.number == number; });
    ASSERT_TRUE(outlined);
    EXPECT_TRUE(is_best(*outlined)) << "the first image after the selection";
    EXPECT_NE(outlined->image.rgba, plain->image.rgba);
    const std::uint64_t last = thread.request(base);
    const auto again = wait_for(thread, [&](const ViewImage& one) { return one.number == last; });
    ASSERT_TRUE(again);
    EXPECT_EQ(again->image.rgba, plain->image.rgba);
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(thread.count(), count + 2);
}

TEST_F(ViewThreadTest, lowers_the_quality_until_images_are_in_time) {
    ViewThreadOptions hurried = options();
    hurried.target_ms = 0.001;  // nothing is that fast
    hurried.settled = 1h;
    ViewThread thread(hurried);
    ViewRequest next = base;
    for (int i = 0; i < 12; ++i) {
        next.camera.position.x += 0.01f;
        const std::uint64_t number = thread.request(next);
        ASSERT_TRUE(wait_for(thread, [&](const ViewImage& one) { return one.number == number; }));
    }
    const auto image = thread.image();
    EXPECT_TRUE(image->draft);
    EXPECT_EQ(image->percent, 25u);
    EXPECT_EQ(image->image.width, 160u) << "enlarged";
    EXPECT_EQ(image->image.height, 90u);
}

TEST_F(ViewThreadTest, tells_that_there_is_no_device_and_tries_again_when_asked) {
    refuse = true;
    ViewThread thread(options());
    thread.request(base);
    const auto failed = wait_for(thread, [](const ViewImage&) { return true; });
    ASSERT_TRUE(failed);
    ASSERT_FALSE(failed->errors.empty());
    EXPECT_NE(failed->errors.front().message().find("is refused"), std::string::npos);
    EXPECT_TRUE(failed->image.rgba.empty());
    ViewRequest next = base;
    next.camera.position.x += 1;
    thread.request(next);
    std::this_thread::sleep_for(100ms);
    EXPECT_EQ(thread.count(), 1u) << "it tries without being asked";
    EXPECT_EQ(opened, 1);
    {
        const std::lock_guard lock(mutex);
        refuse = false;
    }
    thread.retry();
    const auto image = wait_for(thread, [](const ViewImage& one) { return one.errors.empty(); });
    ASSERT_TRUE(image);
    EXPECT_EQ(image->camera, next.camera);
    thread.retry();
    EXPECT_EQ(opened, 2) << "nothing has failed";
}

std::atomic<bool> lost = false;
PFN_vkQueueSubmit healthy_submit = nullptr;
VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* info, VkFence fence) {
    return lost ? VK_ERROR_DEVICE_LOST : healthy_submit(queue, count, info, fence);
}

// Labels: no-asan
TEST_F(ViewThreadTest, survives_a_lost_device) {
    lost = false;
    intercept = [](VolkDeviceTable& table) {
        healthy_submit = table.vkQueueSubmit;
        table.vkQueueSubmit = submit;
    };
    ViewThread thread(options());
    thread.request(base);
    ASSERT_TRUE(wait_for(thread, is_best));
    lost = true;
    ViewRequest next = base;
    next.camera.position.x += 1;
    thread.request(next);
    const auto failed = wait_for(thread, [](const ViewImage& one) { return !one.errors.empty(); });
    ASSERT_TRUE(failed);
    lost = false;
    thread.retry();
    const auto image = wait_for(thread, is_best);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->camera, next.camera);
    EXPECT_EQ(opened, 2);
}

// Labels: no-asan
TEST_F(ViewThreadTest, ends_without_an_image) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 20; ++i) ViewThread thread(options());
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
}

}  // namespace
}  // namespace weft::editor
