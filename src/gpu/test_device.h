// For the tests of this folder: a device with validation layers, and shaders.
#pragma once

#include "gpu/commands.h"
#include "gpu/device.h"

#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace weft::gpu {

/// One of test_shaders/, by its file's name.
const Shader& test_shader(std::string_view name);

/// A test on the first usable device, which may be a software device. Fails without Vulkan or the validation layer, and
/// if the layer reports anything.
class OnDevice : public testing::Test {
  protected:
    void SetUp() override {
        auto made = Instance::create(
            {.validation = true, .surface_extensions = surface_extensions, .on_message = [this](std::string_view text) {
                 const std::lock_guard lock(mutex_);
                 messages_.emplace_back(text);
             }});
        ASSERT_TRUE(made.ok()) << made.error().message();
        instance = std::move(*made);
        auto chosen = choose_device(instance->devices(), "", true);
        ASSERT_TRUE(chosen.ok()) << chosen.error().message();
        info = *chosen;
    }
    void TearDown() override {
        device.reset();
        instance.reset();
        for (const std::string& message : messages_) ADD_FAILURE() << message;
    }

    void open(const DeviceOptions& options = {}) {
        auto made = Device::create(instance, info, options);
        ASSERT_TRUE(made.ok()) << made.error().message();
        device = std::move(*made);
    }
    /// The messages since the last call.
    std::vector<std::string> take_messages() {
        const std::lock_guard lock(mutex_);
        return std::exchange(messages_, {});
    }
    Buffer make(std::uint64_t bytes, MemoryKind kind) {
        auto made = device->memory().buffer(bytes, kind, "test");
        EXPECT_TRUE(made.ok()) << made.error().message();
        return made ? std::move(*made) : Buffer{};
    }

    std::vector<std::string> surface_extensions;  // set before SetUp()
    std::shared_ptr<const Instance> instance;
    DeviceInfo info;
    std::shared_ptr<Device> device;

  private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

}  // namespace weft::gpu
