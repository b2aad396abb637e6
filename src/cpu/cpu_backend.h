// Runs step plans on lanes and threads.
#pragma once

#include "solver/backend.h"

#include <weft/result.h>

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
};

/// Fails if this machine lacks the instruction set, or if there are more than 255 workers.
Result<std::unique_ptr<Backend>> make_cpu_backend(const CpuOptions& options = {});

/// Names for CpuOptions::isa that this machine can run, the widest first.
std::vector<std::string_view> cpu_instruction_sets();

}  // namespace weft
