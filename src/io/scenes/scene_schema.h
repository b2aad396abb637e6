// The scene file format as a JSON Schema, for editors with completion and checks.
#pragma once

#include <string>

namespace weft {

/// JSON Schema, draft 2020-12, made from the tables of scene_keys.h and fabric.h: every key with its type, range, unit,
/// default and description. The scene reader rejects everything that the schema rejects, and more, such as equal names.
std::string scene_schema();

}  // namespace weft
