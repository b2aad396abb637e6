// Which backend a program's options ask for.
#pragma once

#include "solver/world/backend.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <array>
#include <functional>
#include <memory>
#include <string_view>

namespace weft {

/// What options may say.
inline constexpr std::array<std::string_view, 3> backend_names = {"auto", "cpu", "vulkan"};

/// Makes the backend that options ask for.
using MakeBackend = std::function<Result<std::unique_ptr<Backend>>(const Options&)>;

/// `auto` is a GPU if there is one that will do, and the CPU otherwise; never a GPU that software plays. `timings`: of
/// each stage, where they cost something.
Result<std::unique_ptr<Backend>> make_backend(const Options& options);

}  // namespace weft
