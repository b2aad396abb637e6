#include "vulkan/shaders.h"

#include "vulkan/primitives/device.test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <span>

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

// SwiftShader cannot compile them.
TEST(Shaders, keep_no_references_in_variables_of_structs) {
    enum Op : std::uint32_t { type_array = 28, type_struct = 30, type_pointer = 32, variable = 59 };
    constexpr std::uint32_t function = 7, physical_storage = 5349;
    for (const gpu::Shader& shader : shaders()) {
        std::map<std::uint32_t, std::span<const std::uint32_t>> types;  // by result
        const auto holds_reference = [&](auto&& self, std::uint32_t id) -> bool {
            const auto type = types.find(id);
            if (type == types.end()) return false;
            const std::span<const std::uint32_t> words = type->second;
            const std::uint32_t op = words[0] & 0xffff;
            if (op == type_pointer) return words[2] == physical_storage;
            const auto members = op == type_array ? words.subspan(2, 1) : words.subspan(2);
            return std::ranges::any_of(members, [&](std::uint32_t member) { return self(self, member); });
        };
        int found = 0;
        for (std::size_t at = 5; at < shader.words.size(); at += shader.words[at] >> 16) {
            const auto words = std::span(shader.words).subspan(at, shader.words[at] >> 16);
            const std::uint32_t op = words[0] & 0xffff;
            if (op == type_array || op == type_struct || op == type_pointer) types[words[1]] = words;
            if (op != variable || words[3] != function) continue;
            const std::uint32_t held = types.at(words[1])[3];
            found += types.contains(held) && (types[held][0] & 0xffff) != type_pointer &&
                     holds_reference(holds_reference, held);
        }
        EXPECT_EQ(found, 0) << shader.name;
    }
}

using Pipelines = DeviceTest;

// Labels: slow no-asan long
TEST_F(Pipelines, are_made_of_every_shader) {
    for (const gpu::Shader& shader : shaders()) {
        SCOPED_TRACE(shader.name);
        const auto pipeline = programs().get(shader.name);
        EXPECT_TRUE(pipeline.ok()) << pipeline.error().message();
    }
}

}  // namespace
}  // namespace weft::vulkan
