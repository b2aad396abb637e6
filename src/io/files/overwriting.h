// Protects the files that a run reads from its own outputs.
#pragma once

#include <weft/result.h>

#include <filesystem>
#include <span>

namespace weft {

/// Whether both paths lead to one existing file or folder.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// An error for each of `inputs` that one of `outputs` would overwrite. Outputs may be patterns such as `%04d.obj`.
Errors overwritten_inputs(std::span<const std::filesystem::path> outputs,
                          std::span<const std::filesystem::path> inputs);

}  // namespace weft
