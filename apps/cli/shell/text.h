// Text for the terminal.
#pragma once

#include <cstddef>
#include <string>

namespace weft::cli {

/// Breaks text between words into lines of at most `width` bytes. All lines but the first begin with `indent` spaces,
/// which do not count. A longer word gets its own line.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent = 0);

}  // namespace weft::cli
