// Plays a file of actions without a window: a recorded session, or lines that a person wrote.
#pragma once

#include "editor/core/stage.h"

#include <weft/result.h>

#include <filesystem>
#include <functional>
#include <string>

namespace weft::editor {

/// Every line is an action (action.h), `{"do": "advance", "frames": 10}`, or one of
///
///     {"do": "say_hash", "name": "draped"}         keeps and tells the hash of document and state
///     {"do": "expect_hash", "name": "draped"}      fails unless the hash is the one kept under that name
///     {"end": 120}                                  goes on to that frame
///
/// An action with `at` acts at that frame: the script advances to it. Without `at` it acts at once. Lines that are
/// empty or begin with `//` are skipped, and so is the head of a log. `say`: gets a line of text for each hash. Fails
/// at the first action that fails; `where` names the file and the line.
Result<void> run_script(Stage& stage, const std::filesystem::path& file,
                        const std::function<void(const std::string&)>& say);

}  // namespace weft::editor
