#include "cli/shell/text.h"

#include <algorithm>

namespace weft::cli {

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
    std::string lines;
    std::size_t line = 0, begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        if (line > 0 && line + 1 + (end - begin) > width)
            lines += '\n' + std::string(indent, ' '), line = 0;
        else if (line > 0)
            lines += ' ', ++line;
        lines.append(text, begin, end - begin);
        line += end - begin;
        begin = end + 1;
    }
    return lines;
}

}  // namespace weft::cli
