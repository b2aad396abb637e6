// <weft/vulkan.h> in a host with its own instance, device and queue, with validation layers.

#include "gpu/device.h"
#include "gpu/host_device.test.h"
#include "read_back.h"

#include <weft/vulkan.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <mutex>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class VulkanHosts : public testing::Test {
  protected:
    void SetUp() override {
        auto made = gpu::Instance::create({.validation = true, .on_message = [this](std::string_view text) {
                                               const std::lock_guard lock(mutex_);
                                               messages_.emplace_back(text);
                                           }});
        ASSERT_TRUE(made.ok()) << made.error().message();
        instance_ = std::move(*made);
        const auto info = gpu::choose_device(instance_->devices(), "", true);
        ASSERT_TRUE(info.ok()) << info.error().message();
        host.instance = instance_->handle();
        host.physical_device = instance_->physical(*info);
        host.device = gpu::make_host_device(host.physical_device);
        ASSERT_NE(host.device, nullptr);
        volkLoadDeviceTable(&vk_, host.device);
        vk_.vkGetDeviceQueue(host.device, 0, 0, &host.queue);
    }
    // Fails if weft has leaked an object or has destroyed the device.
    void TearDown() override {
        if (host.device != VK_NULL_HANDLE) vk_.vkDestroyDevice(host.device, nullptr);
        instance_.reset();
        for (const std::string& message : messages_) ADD_FAILURE() << message;
    }

    Simulation make() {
        auto simulation = create_on(host, {.solver = {.substeps = 4}});
        EXPECT_TRUE(simulation.ok()) << simulation.error().message();
        return std::move(*simulation);
    }
    std::vector<std::string> refusal(const VulkanHost& wrong, const Options& options = {}) {
        const auto made = create_on(wrong, {}, options);
        std::vector<std::string> messages;
        if (!made)
            for (const Error& error : made.errors()) messages.push_back(error.message());
        return messages;
    }

    VulkanHost host;
    VolkDeviceTable vk_{};

  private:
    std::shared_ptr<const gpu::Instance> instance_;
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

ClothDesc sheet() {
    return {.mesh = GridDesc{.size = {0.5f, 0.5f}, .resolution = {9, 9}}, .pins = {{.select = VertexPins{{0, 8}}}}};
}

template <class T>
std::vector<T> read(ReadBack& reader, const VulkanArray& array, const TimelinePoint& ready) {
    EXPECT_EQ(array.stride, array.count > 0 ? sizeof(T) : 0);
    EXPECT_EQ(array.offset % 256, 0u);
    return reader.read<T>(array.buffer, array.offset, array.count, ready.semaphore, ready.value);
}

// These are copies of what the simulation's own device holds: the same on every device.
void expect_same_surface(Simulation& simulation, ClothId id, const VulkanHost& on) {
    ReadBack reader(on.physical_device, on.device, on.queue, on.queue_family);
    const auto device = vulkan_surface(simulation, id);
    ASSERT_TRUE(device.ok()) << device.error().message();
    const Surface expected = simulation.surface(id);
    const auto xyz = [](const std::vector<Vec4>& array) {
        std::vector<Vec3> all;
        for (const Vec4& v : array) all.push_back(v.xyz());
        return all;
    };
    EXPECT_EQ(device->positions.format, VK_FORMAT_R32G32B32A32_SFLOAT);
    EXPECT_EQ(device->triangles.format, VK_FORMAT_R32G32B32_UINT);
    EXPECT_EQ(device->triangles.count, expected.triangles.size());
    EXPECT_NE(device->positions.address, 0u);
    EXPECT_THAT(xyz(read<Vec4>(reader, device->positions, device->ready)),
                testing::ElementsAreArray(expected.positions));
    EXPECT_THAT(xyz(read<Vec4>(reader, device->normals, device->ready)), testing::ElementsAreArray(expected.normals));
    EXPECT_THAT(read<Vec2>(reader, device->uvs, device->ready), testing::ElementsAreArray(expected.uvs));
    EXPECT_THAT(read<Triangle>(reader, device->triangles, device->ready),
                testing::ElementsAreArray(expected.triangles));
    const auto tangents = read<Vec4>(reader, device->tangents, device->ready);
    const auto expected_tangents = simulation.tangents(id);
    ASSERT_EQ(tangents.size(), expected_tangents.size());
    for (std::size_t v = 0; v < tangents.size(); ++v) {
        EXPECT_LT(length(tangents[v].xyz() - expected_tangents[v].xyz()), 1e-5f);
        EXPECT_EQ(tangents[v].w, expected_tangents[v].w);
    }
}

TEST_F(VulkanHosts, get_the_surface_on_their_device) {
    Simulation simulation = make();
    const auto id = simulation.add(sheet());
    ASSERT_TRUE(id.ok()) << id.error().message();
    expect_same_surface(simulation, *id, host);
    for (int i = 0; i < 3; ++i) {
        simulation.step();
        expect_same_surface(simulation, *id, host);
    }
    EXPECT_LT(simulation.surface(*id).positions.back().y, -0.001f) << "it falls";
    const auto device = vulkan_device(simulation);
    ASSERT_TRUE(device.ok());
    EXPECT_EQ(device->device, host.device);
    EXPECT_EQ(device->queue, host.queue);
    EXPECT_EQ(device->instance, host.instance);
}

TEST_F(VulkanHosts, go_on_after_changes) {
    Simulation simulation = make();
    const ClothId id = *simulation.add(sheet());
    const ClothId ball = *simulation.add({.mesh = SphereMeshDesc{.radius = 0.2f, .subdivisions = 2}});
    simulation.step();
    EXPECT_EQ(vulkan_surface(simulation, ball)->tangents.buffer, VkBuffer{VK_NULL_HANDLE}) << "it has no UVs";
    const auto state = simulation.save_state();
    simulation.step();
    expect_same_surface(simulation, id, host);
    ASSERT_TRUE(simulation.set_fabric(id, FabricDesc("silk")).ok());
    expect_same_surface(simulation, id, host);
    ASSERT_TRUE(simulation.set_pins(id, {}).ok());
    simulation.step();
    expect_same_surface(simulation, id, host);
    ASSERT_TRUE(simulation.restore_state(state).ok());
    expect_same_surface(simulation, id, host);
    ASSERT_TRUE(simulation.remove(id).ok());
    expect_same_surface(simulation, ball, host);
    const auto gone = vulkan_surface(simulation, id);
    ASSERT_FALSE(gone.ok());
    EXPECT_EQ(gone.error().message(), "cloth: is not in this simulation; it was removed or belongs to another one");
}

TEST_F(VulkanHosts, may_load_scenes_and_bring_their_own_functions) {
    host.get_instance_proc_addr = vkGetInstanceProcAddr;
    const auto scene = std::filesystem::path(WEFT_SOURCE_DIR) / "scenes" / "hanging_sheet.json";
    auto simulation = load_on(host, scene, {.solver = {{"substeps", 2}}});
    ASSERT_TRUE(simulation.ok()) << simulation.error().message();
    simulation->step();
    expect_same_surface(*simulation, simulation->cloths().front(), host);
    const auto missing = load_on(host, "nowhere.json");
    ASSERT_FALSE(missing.ok());
    EXPECT_THAT(missing.error().message(), HasSubstr("nowhere.json"));
}

TEST_F(VulkanHosts, are_asked_for_their_queue) {
    int held = 0, times = 0;
    host.lock_queue = [&] {
        EXPECT_EQ(++held, 1) << "never one within another";
        ++times;
    };
    host.unlock_queue = [&] { EXPECT_EQ(--held, 0); };
    {
        Simulation simulation = make();
        const ClothId id = *simulation.add(sheet());
        simulation.step();  // the first step prepares the later ones
        const int before_step = times;
        EXPECT_GT(before_step, 0);
        simulation.step();
        EXPECT_EQ(times, before_step + 1) << "a frame of a cloth is one submission";
        ASSERT_TRUE(vulkan_surface(simulation, id).ok());
        const int with_surface = times;
        simulation.step();
        ASSERT_TRUE(vulkan_surface(simulation, id).ok() && vulkan_surface(simulation, id).ok());
        EXPECT_EQ(times, with_surface + 2) << "one for the frame, one for its surface, and none for what was not asked";
    }
    EXPECT_EQ(held, 0);
}

TEST_F(VulkanHosts, are_told_everything_that_is_wrong_at_once) {
    EXPECT_THAT(
        refusal({.api_version = VK_API_VERSION_1_1}),
        ElementsAre("instance: must not be null", "physical_device: must not be null", "device: must not be null",
                    "queue: must not be null", "api_version: must be at least 1.2, got 1.1"));
    VulkanHost wrong = host;
    wrong.lock_queue = [] {};
    EXPECT_THAT(refusal(wrong), ElementsAre("unlock_queue: is missing: both are called, or neither"));
    wrong = host;
    wrong.unlock_queue = [] {};
    EXPECT_THAT(refusal(wrong), ElementsAre("lock_queue: is missing: both are called, or neither"));
    EXPECT_THAT(refusal(host, {.backend = "cpu"}),
                ElementsAre("backend: must be auto or vulkan on a host's device, got 'cpu'"));
    EXPECT_THAT(refusal(host, {.device = "nvidia"}),
                ElementsAre("device: must be empty on a host's device, got 'nvidia'"));
    EXPECT_THAT(refusal(host, {.execution = "backwards"}),
                ElementsAre("execution: must be auto, streamed, grouped or fused, got 'backwards'"));
    EXPECT_THAT(refusal(host, {.threads = 0}), ElementsAre("threads: must be from 1 to 256, got 0"));
}

TEST_F(VulkanHosts, are_told_what_does_not_fit_together) {
    VulkanHost wrong = host;
    wrong.queue_family = 77;
    EXPECT_THAT(refusal(wrong), ElementsAre(HasSubstr("queue family 77 does not compute")));
    wrong = host;
    wrong.physical_device = reinterpret_cast<VkPhysicalDevice>(&wrong);  // not of this instance
    EXPECT_THAT(refusal(wrong), ElementsAre(HasSubstr("does not belong to the instance")));
}

TEST_F(VulkanHosts, of_a_simulation_on_the_cpu_get_an_error) {
    auto simulation = Simulation::create({}, {.backend = "cpu"});
    ASSERT_TRUE(simulation.ok());
    const ClothId id = *simulation->add(sheet());
    const auto surface = vulkan_surface(*simulation, id);
    ASSERT_FALSE(surface.ok());
    EXPECT_EQ(surface.error().message(), "backend: must be vulkan for buffers on a device, is cpu");
    EXPECT_EQ(surface.error().fault, Fault::input);
    EXPECT_FALSE(vulkan_device(*simulation).ok());
}

TEST_F(VulkanHosts, without_a_device_get_that_of_weft) {
    auto simulation = Simulation::create({.solver = {.substeps = 4}}, {.backend = "vulkan"});
    ASSERT_TRUE(simulation.ok()) << simulation.error().message();
    const ClothId id = *simulation->add(sheet());
    const auto own = vulkan_device(*simulation);
    ASSERT_TRUE(own.ok()) << own.error().message();
    EXPECT_NE(own->device, host.device);
    EXPECT_NE(own->get_instance_proc_addr, nullptr);
    for (int i = 0; i < 2; ++i) {
        simulation->step();
        expect_same_surface(*simulation, id, *own);
    }
}

// The device outlives one simulation, and serves two at a time.
TEST_F(VulkanHosts, may_have_several_simulations) {
    Simulation first = make();
    const ClothId a = *first.add(sheet());
    {
        Simulation second = make();
        const ClothId b = *second.add(sheet());
        second.step();
        expect_same_surface(second, b, host);
    }
    first.step();
    expect_same_surface(first, a, host);
}

}  // namespace
}  // namespace weft
