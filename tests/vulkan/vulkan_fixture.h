// A Vulkan backend with validation layers; each of their messages fails the test.
#pragma once

#include "solver/world/world.h"
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

/// Whether the world's backend rounds division and square roots as the CPU does.
inline bool rounds_like_the_cpu(const World& world) {
    return world.backend().name() == "cpu" || world.backend().device().find("llvmpipe") != std::string::npos;
}

}  // namespace weft
