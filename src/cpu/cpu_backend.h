// The CPU backend: runs step plans with SIMD and threads.
#pragma once

#include "solver/world/backend.h"

#include <weft/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

struct CpuOptions {
    /// Threads besides the calling one. The bits of the result do not depend on any of these options.
    unsigned workers = 0;
    /// "avx512", "avx2", "sse4", "neon", "scalar", or empty for the widest that this machine has.
    std::string isa = {};
    /// Particles. A smaller island runs on one thread, because several would wait for each other longer than they work:
    /// two threads are 0.9 times as fast as one on a sheet of 32², 1.2 times on 64².
    std::uint32_t smallest_shared = 2000;
    /// Searches for pairs of features in every substep, whether or not the lists are still valid. For tests.
    bool search_always = false;
};

/// Fails if this machine lacks the instruction set, or if there are more than 255 workers.
Result<std::unique_ptr<Backend>> make_cpu_backend(const CpuOptions& options = {});

/// Names for CpuOptions::isa that this machine can run, the widest first.
std::vector<std::string_view> cpu_instruction_sets();

}  // namespace weft
