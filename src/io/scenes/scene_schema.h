// The scene file as a JSON Schema, for editors that complete and check while one types.
#pragma once

#include <string>

namespace weft {

/// JSON Schema, draft 2020-12, made from the tables of scene_keys.h and fabric.h: every key with its type, range, unit,
/// default and meaning. What it refuses, the scene reader refuses too; the reader knows more, as that names differ.
std::string scene_schema();

}  // namespace weft
