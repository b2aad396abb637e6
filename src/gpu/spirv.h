// Reflection of compiled shaders, and changes to their arithmetic and constants.
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
    /// Ids of the specialization constants that replace these sizes.
    std::array<std::optional<std::uint32_t>, 3> workgroup_constants;
    std::vector<ShaderBinding> bindings;        ///< ascending
    std::vector<std::uint32_t> specialization;  ///< ids of the constants that may be set, ascending
};

/// Fails if the words are not a shader of that stage. Checks only the outline of the module, so the words must come
/// from a compiler.
Result<ShaderInterface> reflect(const Shader& shader, ShaderStage stage = ShaderStage::compute);

/// Returns the shader with every sum and product decorated as NoContraction. A driver may then neither fuse a product
/// with a sum nor simplify (a + b) - a. This preserves the compensated summation of the physics, and a device gives the
/// same bits every time. Operations that the compiler has already fused stay fused. Words that are not a module are
/// returned unchanged.
std::vector<std::uint32_t> with_exact_arithmetic(std::span<const std::uint32_t> words);

/// Changes the defaults of the specialization constants with ids 0, 1, 2, … Some drivers size shared memory by the
/// defaults and ignore the values of the pipeline.
void set_constants(std::vector<std::uint32_t>& words, std::span<const std::uint32_t> constants);

}  // namespace weft::gpu
