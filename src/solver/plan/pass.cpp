#include "solver/plan/pass.h"

#include <array>

namespace weft {
namespace {

// clang-format off
#define own(array) {Data::array, false, true},
#define any(array) {Data::array, false, false},
#define to_own(array) {Data::array, true, true},
#define to_any(array) {Data::array, true, false},
#define WEFT_PASS(name, stage, over, accesses) constexpr Access name##_accesses[] = {accesses};
#include "solver/plan/passes.def"
#undef WEFT_PASS
#undef own
#undef any
#undef to_own
#undef to_any

#define WEFT_PASS(name, stage, over, accesses) PassInfo{#name, stage, over, name##_accesses},
constexpr std::array<PassInfo, pass_kind_count> infos = {
#include "solver/plan/passes.def"
};
#undef WEFT_PASS
// clang-format on

}  // namespace

const PassInfo& pass_info(PassKind kind) {
    return infos[static_cast<std::size_t>(kind)];
}

std::uint32_t stage_of(const Pass& pass) {
    const std::uint32_t stage = pass_info(pass.kind).stage;
    return stage == stage_of_constraint ? static_cast<std::uint32_t>(pass.constraint) : stage;
}

std::string_view stage_name(std::uint32_t stage) {
    constexpr std::array<std::string_view, stage_count - constraint_kind_count> others = {
        "find",   "air",           "predict",    "hierarchy", "average", "grab",    "contact",
        "bodies", "cloth contact", "velocities", "tear",      "damp",    "surface", "fused"};
    return stage < constraint_kind_count ? constraint_info(static_cast<ConstraintKind>(stage)).name
                                         : others[stage - constraint_kind_count];
}

}  // namespace weft
