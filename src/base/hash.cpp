#include "base/hash.h"

namespace weft {

std::string StateHash::text() const {
    constexpr char digits[] = "0123456789abcdef";
    std::string text(16, '0');
    std::uint64_t h = value();
    for (auto it = text.rbegin(); it != text.rend(); ++it, h >>= 4) *it = digits[h & 15];
    return text;
}

}  // namespace weft
