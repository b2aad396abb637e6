// A device for tests with validation layers. Their messages fail the test.
#pragma once

#include "gpu/device.h"
#include "vulkan/programs.h"

#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace weft::vulkan {

class DeviceTest : public testing::Test {
  protected:
    /// `widest`: pretends that no more workgroups fit along x; 0: the device's own limit.
    void open(std::uint32_t widest = 0) {
        programs_.reset();
        device_.reset();
        auto instance = gpu::Instance::create({.validation = true, .on_message = [this](std::string_view message) {
                                                   const std::lock_guard lock(mutex_);
                                                   messages_.emplace_back(message);
                                               }});
        ASSERT_TRUE(instance.ok()) << instance.error().message();
        auto info = gpu::choose_device((*instance)->devices(), "", true);
        ASSERT_TRUE(info.ok()) << info.error().message();
        if (widest > 0) info->limits.workgroup_count[0] = widest;
        auto device = gpu::Device::create(*instance, *info);
        ASSERT_TRUE(device.ok()) << device.error().message();
        device_ = std::move(*device);
        programs_ = std::make_unique<Programs>(*device_);
    }
    void SetUp() override { open(); }
    void TearDown() override {
        programs_.reset();
        device_.reset();  // may cause messages too
        for (const std::string& message : messages_) ADD_FAILURE() << message;
    }

    gpu::Device& device() { return *device_; }
    Programs& programs() { return *programs_; }

  private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
    std::shared_ptr<gpu::Device> device_;
    std::unique_ptr<Programs> programs_;
};

}  // namespace weft::vulkan
