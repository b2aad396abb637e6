// Compiled once per instruction set: foreach_target.h includes this file again for each of them.

#include "cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/passes_simd.cpp"
#include <hwy/foreach_target.h>

#include "cpu/passes.h"
#include "physics/constraints.data.h"

#include <algorithm>

// Highway's portable fallback is slower than the single-lane loops in passes_scalar.cpp.
#if HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR

#include "physics/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace weft::HWY_NAMESPACE {

using namespace weft::cpu;

#include "physics/kernels.inl"

#include "cpu/passes.inl"

#if HWY_TARGET == HWY_AVX3
constexpr const char* isa_name = "avx512";
#elif HWY_TARGET == HWY_AVX2
constexpr const char* isa_name = "avx2";
#elif HWY_TARGET == HWY_SSE4
constexpr const char* isa_name = "sse4";
#elif HWY_TARGET == HWY_NEON
constexpr const char* isa_name = "neon";
#else
#error "an instruction set without a name"
#endif

extern const Passes passes;
const Passes passes = make_passes(isa_name);

}  // namespace weft::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE

#include <hwy/targets.h>

#include <vector>

namespace weft::cpu {
namespace {

std::vector<const Passes*> detect() {
    [[maybe_unused]] const std::int64_t supported = hwy::SupportedTargets();
    std::vector<const Passes*> tables;
#if HWY_TARGETS & HWY_AVX3
    if (supported & HWY_AVX3) tables.push_back(&N_AVX3::passes);
#endif
#if HWY_TARGETS & HWY_AVX2
    if (supported & HWY_AVX2) tables.push_back(&N_AVX2::passes);
#endif
#if HWY_TARGETS & HWY_SSE4
    if (supported & HWY_SSE4) tables.push_back(&N_SSE4::passes);
#endif
#if HWY_TARGETS & HWY_NEON
    if (supported & HWY_NEON) tables.push_back(&N_NEON::passes);
#endif
    tables.push_back(&scalar_passes());
    return tables;
}

}  // namespace

std::span<const Passes* const> available_passes() {
    static const std::vector<const Passes*> tables = detect();
    return tables;
}

const Passes* find_passes(std::string_view isa) {
    for (const Passes* passes : available_passes()) {
        if (passes->isa == isa) return passes;
    }
    return nullptr;
}

}  // namespace weft::cpu

#endif
