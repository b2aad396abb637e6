// Where a cloth is weaker or stronger than its fabric: seams, and painted resistance.
#pragma once

#include <weft/vector.h>

#include <cstdint>
#include <vector>

namespace weft {

struct TearPaint {
    /// An edge of a seam.
    struct Link {
        std::uint32_t link = 0;  ///< entry of the tear table; the edge's other link is listed too
        float strength = 0;      ///< N/m, > 0: of the tension across the edge
        float tear_energy = 0;   ///< J/m: sets the limit at the end of the part that is open; 0: `strength` holds there
        /// Direction across the seam, on the cloth at rest, of any length. Where the seam runs in steps along the mesh,
        /// it is that of the whole seam. 0: perpendicular to the edge.
        Vec3 across = {};
    };
    std::vector<Link> seams;        ///< if a link is listed twice, the last one counts
    std::vector<float> resistance;  ///< per vertex of the tear table: factor on all limits, > 0; empty: 1
};

}  // namespace weft
