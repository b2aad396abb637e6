// Compliance of hinges whose moments act together within each triangle (moment.md).
#pragma once

#include "physics/moment/moment.data.h"
#include "physics/rest_shape.h"

#include <array>
#include <vector>

namespace weft {

/// Bending stiffness of a sheet, N·m.
struct SheetStiffness {
    double warp, weft, twist;

    explicit SheetStiffness(const MomentMaterial& material);
    bool limp() const { return !(warp > 0); }
};

/// One of the two triangles of a hinge, at rest.
struct HingeSide {
    std::array<float, 2> edge{};  ///< m, along warp and weft: from a to b
    std::array<float, 2> tip{};   ///< from a
    /// 1 if there is a hinge across the edge from b to the tip, and from the tip to a; -1 if that hinge and this one
    /// take the triangle as facing different ways; 0 if there is none.
    std::array<float, 2> link{};
};

/// Compliances in 1/(N·m).
struct SideCompliance {
    double at_once = 0;          ///< with the rest angle as it is
    double own = 0;              ///< by the shift of the rest angle
    std::array<double, 2> by{};  ///< by the moments of the hinges of HingeSide::link
    double total() const { return at_once + own; }
    /// Part of its way that the shift goes per substep.
    double rate() const;
};

/// All 0 if the triangle has no area. A needle is not coupled.
SideCompliance compliance_of(const HingeSide& side, const SheetStiffness& stiffness);

struct CoupledHinge {
    std::array<HingeSide, 2> side;                                                     ///< triangle0, triangle1
    std::array<std::array<std::uint32_t, 2>, 2> linked{{{none, none}, {none, none}}};  ///< numbers of hinges
};

/// One per hinge of the topology.
std::vector<CoupledHinge> couple_hinges(const RestShape& rest);

}  // namespace weft
