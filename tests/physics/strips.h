// Strips for the cantilever test, and its reference curve.
#pragma once

#include "specimen.h"
#include "validate/strip_mesh.h"

namespace weft::physical {

/// Drop over reach of a heavy clamped elastica, by Γ = ρ_A g L³/B (integrated for this table; Romero et al. 2021,
/// "Physical Validation of Simulators in Computer Graphics", publish the same curve).
struct CurvePoint {
    double gamma, drop_over_reach;
};
inline constexpr CurvePoint cantilever_curve[] = {{1, .12456}, {10, 1.06680}, {50, 3.70556}};

}  // namespace weft::physical
