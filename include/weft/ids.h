// Names for what is in a world. An id stays valid until what it names is removed; after that it names nothing, even if
// something else has taken the place.
#pragma once

#include <cstdint>

namespace weft {

template <class Tag>
struct Id {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;  ///< 0 is no id

    constexpr explicit operator bool() const { return generation != 0; }
    friend constexpr bool operator==(Id, Id) = default;
};

using ClothId = Id<struct ClothTag>;
using ColliderId = Id<struct ColliderTag>;
using StitchId = Id<struct StitchTag>;  ///< of stitches that were added together

}  // namespace weft
