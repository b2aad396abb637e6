// Ids of the objects in a simulation. An id is valid until its object is removed. After that it names nothing, also if
// a new object takes the same index.
#pragma once

#include <cstdint>

namespace weft {

/// A handle of an object. A default-constructed id names nothing and converts to false.
template <class Tag>
struct Id {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;  ///< 0: names nothing

    constexpr explicit operator bool() const { return generation != 0; }
    friend constexpr bool operator==(Id, Id) = default;
};

using ClothId = Id<struct ClothTag>;
using ColliderId = Id<struct ColliderTag>;
using StitchId = Id<struct StitchTag>;  ///< names the stitches of one StitchDesc
using GrabId = Id<struct GrabTag>;

}  // namespace weft
