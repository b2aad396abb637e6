// Creates the backend that the options select.
#pragma once

#include "solver/world/backend.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <array>
#include <functional>
#include <memory>
#include <string_view>

namespace weft {

/// Values of Options::backend.
inline constexpr std::array<std::string_view, 3> backend_names = {"auto", "cpu", "vulkan"};

/// Creates a backend for the given options.
using MakeBackend = std::function<Result<std::unique_ptr<Backend>>(const Options&)>;

/// `auto` selects a suitable GPU if there is one, otherwise the CPU. It never selects a software device.
/// SceneWorld::create() passes `cpu` in its place if the scene needs the CPU.
Result<std::unique_ptr<Backend>> make_backend(const Options& options);

}  // namespace weft
