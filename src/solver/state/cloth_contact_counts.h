// Counts of the contact of cloths with themselves and with each other.
#pragma once

#include "physics/constraint.h"

#include <algorithm>
#include <cstdint>

namespace weft {

/// Counts of one frame, over all cloths.
struct ClothContactCounts {
    std::uint64_t contacts = 0;  ///< pairs that pushed in the last substep
    std::uint64_t searches = 0;  ///< substeps in which lists of pairs were searched
    std::uint64_t limited = 0;   ///< particles that were sent back, summed over the substeps
    /// Edges that pass through triangles at the end of the frame; in the frame in which pins press cloth through cloth,
    /// at least the pairs that it could not separate.
    std::uint64_t tangled = 0;
    /// The lowest number of a particle in such a pair: as an index into the world's particles; `no_particle` without
    /// one.
    std::uint32_t tangled_particle = no_particle;

    /// Adds a frame to the counts of a run: keeps the contacts of the last frame, sums searches and limited particles,
    /// and keeps the largest number of tangled pairs and the first particle of one.
    void add(const ClothContactCounts& frame) {
        contacts = frame.contacts;
        searches += frame.searches;
        limited += frame.limited;
        tangled = std::max(tangled, frame.tangled);
        if (tangled_particle == no_particle) tangled_particle = frame.tangled_particle;
    }
    friend bool operator==(const ClothContactCounts&, const ClothContactCounts&) = default;
};

}  // namespace weft
