// What contact of cloth with cloth did to each particle, as bits.
#pragma once

#include <cstdint>

namespace weft {

/// Bits of ClothFrame::contact_marks.
enum ContactMark : std::uint32_t {
    mark_touches = 1u << 0,  ///< in the last substep a pair with the particle was pushed apart
    mark_limited = 1u << 1,  ///< in some substep the particle was sent back; exact contact only
    mark_tangled = 1u << 2,  ///< of a pair that counts as tangled (ClothContactCounts); exact contact only
};

}  // namespace weft
