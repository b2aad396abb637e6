// Compiled once per instruction set, as passes_simd.cpp.

#include "cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/cloth_contact/contact_simd.cpp"
#include <hwy/foreach_target.h>

#include "cpu/cloth_contact/contact_loops.h"
#include "physics/constraints.data.h"
#include "solver/plan/cloth_contact_numbers.h"

#include <algorithm>
#include <bit>
#include <limits>

#if HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR

#include "physics/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace weft::HWY_NAMESPACE {

using namespace weft::cpu;

#include "physics/cloth_contact/cloth_contact.kernel.h"

#include "collide/pair_search.inl"
#include "cpu/cloth_contact/contact_loops.inl"

extern const ContactLoops contact_table;
const ContactLoops contact_table = contact_loops;

}  // namespace weft::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE

namespace weft::cpu {

const ContactLoops& contact_loops_of(std::string_view isa) {
#if HWY_TARGETS & HWY_AVX3
    if (isa == "avx512") return N_AVX3::contact_table;
#endif
#if HWY_TARGETS & HWY_AVX2
    if (isa == "avx2") return N_AVX2::contact_table;
#endif
#if HWY_TARGETS & HWY_SSE4
    if (isa == "sse4") return N_SSE4::contact_table;
#endif
#if HWY_TARGETS & HWY_NEON
    if (isa == "neon") return N_NEON::contact_table;
#endif
    return scalar_contact_loops();
}

}  // namespace weft::cpu

#endif
