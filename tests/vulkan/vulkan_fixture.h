// A Vulkan backend with validation layers; each of their messages fails the test.
#pragma once

#include "vulkan/vulkan_backend.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace weft {

inline constexpr double frame_seconds = 1.0 / 60;

inline std::unique_ptr<Backend> checked_vulkan_backend(VulkanOptions options = {}) {
    options.validation = true;
    options.on_message = [](std::string_view message) { ADD_FAILURE() << message; };
    auto backend = make_vulkan_backend(options);
    if (!backend) {
        ADD_FAILURE() << backend.error().message();
        return nullptr;
    }
    return std::move(*backend);
}

}  // namespace weft
