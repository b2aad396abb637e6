#include "gpu/spirv.h"

#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <tuple>

namespace weft::gpu {
namespace {

// Numbers of the SPIR-V specification, section 3.
constexpr std::uint32_t header_words = 5, magic = 0x07230203, largest_bound = 0x3fffff;
constexpr std::uint32_t op_decorate = 71, decoration_no_contraction = 42;
constexpr std::uint32_t op_ext_inst_import = 11, op_ext_inst = 12;
constexpr std::uint32_t op_entry_point = 15, op_function = 54, op_function_end = 56;

// Whether an instruction ends the annotations: types come next, possibly after a line of the source.
constexpr bool ends_annotations(std::uint32_t op) {
    return (op >= 19 && op <= 39) || op == 8 || op == 317;  // OpTypeVoid … OpTypeForwardPointer, OpLine, OpNoLine
}

constexpr bool is_float_arithmetic(std::uint32_t op) {
    switch (op) {
        case 127:  // OpFNegate
        case 129:  // OpFAdd
        case 131:  // OpFSub
        case 133:  // OpFMul
        case 136:  // OpFDiv
        case 140:  // OpFRem
        case 141:  // OpFMod
        case 142:  // OpVectorTimesScalar
        case 143:  // OpMatrixTimesScalar
        case 144:  // OpVectorTimesMatrix
        case 145:  // OpMatrixTimesVector
        case 146:  // OpMatrixTimesMatrix
        case 147:  // OpOuterProduct
        case 148:  // OpDot
            return true;
        default:
            return false;
    }
}

// Calls `visit(op, words of the instruction)` for each instruction. Returns false if the words are not a module: the
// header is wrong, or an instruction has no length or exceeds the end.
template <class Visit>
bool for_each_instruction(std::span<const std::uint32_t> words, Visit&& visit) {
    if (words.size() < header_words || words[0] != magic || words[3] == 0 || words[3] > largest_bound) return false;
    for (std::size_t at = header_words; at < words.size();) {
        const std::size_t length = words[at] >> 16;
        if (length == 0 || length > words.size() - at) return false;
        visit(words[at] & 0xffffu, words.subspan(at, length));
        at += length;
    }
    return true;
}

// The execution model of a stage, and its name.
constexpr std::uint32_t model_of(ShaderStage stage) {
    return stage == ShaderStage::compute ? 5 : stage == ShaderStage::fragment ? 4 : 0;
}
constexpr const char* name_of(ShaderStage stage) {
    return stage == ShaderStage::compute ? "compute" : stage == ShaderStage::fragment ? "fragment" : "vertex";
}

// Returns why the words cannot be a shader of the stage; empty if they may be one.
std::string find_fault(std::span<const std::uint32_t> words, ShaderStage stage) {
    bool found = false;
    int functions = 0, ended = 0;
    const bool sound = for_each_instruction(words, [&](std::uint32_t op, std::span<const std::uint32_t> instruction) {
        found |= op == op_entry_point && instruction.size() > 1 && instruction[1] == model_of(stage);
        functions += op == op_function;
        ended += op == op_function_end;
    });
    if (!sound || functions == 0 || functions != ended) return "cut off, or none at all";
    return found ? "" : std::string("it has no ") + name_of(stage) + " shader";
}

// Instructions of GLSL.std.450 that compute sums of products: Determinant, MatrixInverse, FMix, SmoothStep,
// Length … Refract.
constexpr bool is_float_function(std::uint32_t op) {
    return op == 33 || op == 34 || op == 46 || op == 49 || (op >= 66 && op <= 72);
}

bool names_glsl(std::span<const std::uint32_t> words) {
    constexpr char name[] = "GLSL.std.450";
    return words.size_bytes() >= sizeof name && std::memcmp(words.data(), name, sizeof name) == 0;
}

struct ContextDeleter {
    void operator()(spvc_context_s* context) const { spvc_context_destroy(context); }
};

// Reads the workgroup's size, and the ids of the specialization constants that set it.
void read_workgroup(spvc_compiler compiler, ShaderInterface& out) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        out.workgroup[axis] =
            std::max(1u, spvc_compiler_get_execution_mode_argument_by_index(compiler, SpvExecutionModeLocalSize, axis));
    }
    spvc_specialization_constant sizes[3] = {};
    spvc_compiler_get_work_group_size_specialization_constants(compiler, &sizes[0], &sizes[1], &sizes[2]);
    for (unsigned axis = 0; axis < 3; ++axis) {
        if (sizes[axis].id == 0) continue;
        const spvc_constant constant = spvc_compiler_get_constant_handle(compiler, sizes[axis].id);
        if (constant == nullptr) continue;
        out.workgroup[axis] = spvc_constant_get_scalar_u32(constant, 0, 0);
        out.workgroup_constants[axis] = sizes[axis].constant_id;
    }
}

void read_bindings(spvc_compiler compiler, spvc_resources resources, ShaderInterface& out) {
    for (const spvc_resource_type type :
         {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, SPVC_RESOURCE_TYPE_SAMPLED_IMAGE}) {
        const spvc_reflected_resource* list = nullptr;
        std::size_t count = 0;
        spvc_resources_get_resource_list_for_type(resources, type, &list, &count);
        for (std::size_t i = 0; i < count; ++i) {
            out.bindings.push_back({spvc_compiler_get_decoration(compiler, list[i].id, SpvDecorationDescriptorSet),
                                    spvc_compiler_get_decoration(compiler, list[i].id, SpvDecorationBinding),
                                    type == SPVC_RESOURCE_TYPE_UNIFORM_BUFFER,
                                    type == SPVC_RESOURCE_TYPE_SAMPLED_IMAGE});
        }
    }
    std::ranges::sort(out.bindings, {}, [](const ShaderBinding& b) { return std::tuple(b.set, b.binding); });
}

void read_push_constants(spvc_compiler compiler, spvc_resources resources, ShaderInterface& out) {
    const spvc_reflected_resource* list = nullptr;
    std::size_t count = 0, size = 0;
    spvc_resources_get_resource_list_for_type(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT, &list, &count);
    if (count == 0) return;
    const spvc_type type = spvc_compiler_get_type_handle(compiler, list[0].base_type_id);
    spvc_compiler_get_declared_struct_size(compiler, type, &size);
    out.push_constants = static_cast<std::uint32_t>((size + 3) / 4 * 4);
}

void read_specialization(spvc_compiler compiler, ShaderInterface& out) {
    const spvc_specialization_constant* list = nullptr;
    std::size_t count = 0;
    spvc_compiler_get_specialization_constants(compiler, &list, &count);
    for (std::size_t i = 0; i < count; ++i) out.specialization.push_back(list[i].constant_id);
    std::ranges::sort(out.specialization);
}

}  // namespace

Result<ShaderInterface> reflect(const Shader& shader, ShaderStage stage) {
    if (const std::string fault = find_fault(shader.words, stage); !fault.empty())
        return Error::of_machine(std::string(shader.name), "invalid SPIR-V: " + fault);
    spvc_context raw = nullptr;
    if (spvc_context_create(&raw) != SPVC_SUCCESS) return Error::of_machine(std::string(shader.name), "out of memory");
    const std::unique_ptr<spvc_context_s, ContextDeleter> context(raw);
    const auto failed = [&] {
        return Error::of_machine(std::string(shader.name),
                                 std::string("invalid SPIR-V: ") + spvc_context_get_last_error_string(raw));
    };
    spvc_parsed_ir ir = nullptr;
    spvc_compiler compiler = nullptr;
    spvc_resources resources = nullptr;
    if (spvc_context_parse_spirv(raw, shader.words.data(), shader.words.size(), &ir) != SPVC_SUCCESS) return failed();
    if (spvc_context_create_compiler(raw, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler) !=
        SPVC_SUCCESS)
        return failed();
    if (spvc_compiler_create_shader_resources(compiler, &resources) != SPVC_SUCCESS) return failed();
    ShaderInterface out;
    read_push_constants(compiler, resources, out);
    read_bindings(compiler, resources, out);
    read_workgroup(compiler, out);
    read_specialization(compiler, out);
    return out;
}

std::vector<std::uint32_t> with_exact_arithmetic(std::span<const std::uint32_t> words) {
    std::vector<std::uint32_t> results, decorated;
    std::uint32_t functions = 0;  // id of the imported instruction set
    std::size_t annotations_end = words.size();
    const bool sound = for_each_instruction(words, [&](std::uint32_t op, std::span<const std::uint32_t> instruction) {
        if (ends_annotations(op))
            annotations_end = std::min(annotations_end, static_cast<std::size_t>(instruction.data() - words.data()));
        if (is_float_arithmetic(op) && instruction.size() > 3) results.push_back(instruction[2]);
        if (op == op_ext_inst && instruction.size() > 4 && instruction[3] == functions &&
            is_float_function(instruction[4]))
            results.push_back(instruction[2]);
        if (op == op_ext_inst_import && instruction.size() > 2 && names_glsl(instruction.subspan(2)))
            functions = instruction[1];
        if (op == op_decorate && instruction.size() == 3 && instruction[2] == decoration_no_contraction)
            decorated.push_back(instruction[1]);
    });
    if (!sound) return {words.begin(), words.end()};
    std::ranges::sort(decorated);
    std::vector<std::uint32_t> decorations;
    for (const std::uint32_t result : results) {
        if (std::ranges::binary_search(decorated, result)) continue;  // decorating twice is an error
        decorations.insert(decorations.end(), {3u << 16 | op_decorate, result, decoration_no_contraction});
    }
    const auto middle = words.begin() + static_cast<std::ptrdiff_t>(annotations_end);
    std::vector<std::uint32_t> exact(words.begin(), middle);
    exact.insert(exact.end(), decorations.begin(), decorations.end());
    exact.insert(exact.end(), middle, words.end());
    return exact;
}

void set_constants(std::vector<std::uint32_t>& words, std::span<const std::uint32_t> constants) {
    constexpr std::uint32_t op_spec_constant = 50, decoration_spec_id = 1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places;  // result, id
    for (std::size_t at = header_words; at < words.size();) {
        const std::uint32_t op = words[at] & 0xffffu, length = words[at] >> 16;
        if (length == 0 || at + length > words.size()) break;
        if (op == op_decorate && length == 4 && words[at + 2] == decoration_spec_id)
            places.push_back({words[at + 1], words[at + 3]});
        if (op == op_spec_constant && length == 4) {  // of one word
            const auto place =
                std::ranges::find(places, words[at + 2], &std::pair<std::uint32_t, std::uint32_t>::first);
            if (place != places.end() && place->second < constants.size()) words[at + 3] = constants[place->second];
        }
        at += length;
    }
}

}  // namespace weft::gpu
