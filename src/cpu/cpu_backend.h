// Runs step plans on lanes and threads.
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
    /// Threads besides the calling one. The bits of the result do not depend on it.
    unsigned workers = 0;
    /// "avx512", "avx2", "sse4", "neon", "scalar", or empty for the widest that this machine has. Nor on this.
    std::string isa = {};
    /// Particles: threads share the work on a cloth that has as many. In a smaller one they wait for one another longer
    /// than they work: two take a sheet of 32² 0.9 times as fast as one, of 64² 1.2 times. Nor on this.
    std::uint32_t smallest_shared = 2000;
};

/// Fails if this machine lacks the instruction set, or if there are more than 255 workers.
Result<std::unique_ptr<Backend>> make_cpu_backend(const CpuOptions& options = {});

/// Names for CpuOptions::isa that this machine can run, the widest first.
std::vector<std::string_view> cpu_instruction_sets();

}  // namespace weft
