#include "vulkan/shaders.h"

#include "vulkan/primitives/device.test.h"

#include <gtest/gtest.h>

namespace weft::vulkan {
namespace {

TEST(Shaders, every_device_has_room_for_what_they_are_told) {
    EXPECT_FALSE(shaders().empty());
    for (const gpu::Shader& shader : shaders()) {
        const auto declared = gpu::reflect(shader);
        ASSERT_TRUE(declared.ok()) << declared.error().message();
        EXPECT_GT(declared->push_constants, 0u) << shader.name;
        EXPECT_LE(declared->push_constants, 128u) << shader.name;
        EXPECT_TRUE(declared->bindings.empty()) << shader.name << ": memory goes by address";
    }
}

// A fused product and sum rounds once where the processor rounds twice.
TEST(Shaders, the_compiler_has_fused_nothing) {
    constexpr std::uint32_t op_ext_inst = 12, fma = 50;
    for (const gpu::Shader& shader : shaders()) {
        int fused = 0;
        for (std::size_t at = 5; at < shader.words.size(); at += shader.words[at] >> 16)
            fused += (shader.words[at] & 0xffff) == op_ext_inst && shader.words[at + 4] == fma;
        EXPECT_EQ(fused, 0) << shader.name;
    }
}

using Pipelines = DeviceTest;

// Labels: slow no-asan
TEST_F(Pipelines, are_made_of_every_shader) {
    for (const gpu::Shader& shader : shaders()) {
        SCOPED_TRACE(shader.name);
        const auto pipeline = programs().get(shader.name);
        EXPECT_TRUE(pipeline.ok()) << pipeline.error().message();
    }
}

}  // namespace
}  // namespace weft::vulkan
