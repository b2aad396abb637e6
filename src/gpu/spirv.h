// What a compiled shader declares, and how exactly it computes.
#pragma once

#include <weft/result.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace weft::gpu {

/// A shader as the build embedded it.
struct Shader {
    std::string_view name;
    std::span<const std::uint32_t> words;
};

enum class ShaderStage { compute, vertex, fragment };

struct ShaderBinding {
    std::uint32_t set = 0, binding = 0;
    bool uniform = false;  ///< a uniform buffer
    bool image = false;    ///< an image with its sampler; neither: a storage buffer
};

struct ShaderInterface {
    std::uint32_t push_constants = 0;  ///< bytes
    std::array<std::uint32_t, 3> workgroup{1, 1, 1};
    /// Ids of the specialization constants that set it in place of that.
    std::array<std::optional<std::uint32_t>, 3> workgroup_constants;
    std::vector<ShaderBinding> bindings;        ///< ascending
    std::vector<std::uint32_t> specialization;  ///< ids of the constants that may be set, ascending
};

/// Fails where the words are no shader of that stage. Nothing but the module's frame is checked beforehand: it must
/// come from a compiler.
Result<ShaderInterface> reflect(const Shader& shader, ShaderStage stage = ShaderStage::compute);

/// The same shader with every sum and product decorated as NoContraction: a driver may neither fuse a product with a
/// sum nor simplify (a + b) - a, so that what the compensated sums of the physics keep is not lost, and a device gives
/// the same bits every time. What a compiler has fused before cannot be undone. Words that are no module come back as
/// they are.
std::vector<std::uint32_t> with_exact_arithmetic(std::span<const std::uint32_t> words);

/// The same shader with other defaults of its specialization constants with ids 0, 1, 2, … Some drivers size shared
/// memory by the default, whatever the pipeline says.
void set_constants(std::vector<std::uint32_t>& words, std::span<const std::uint32_t> constants);

}  // namespace weft::gpu
