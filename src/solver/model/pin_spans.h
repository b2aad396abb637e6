// How far apart pins hold a cloth. Pulled farther than the cloth between them is long, it has to stretch, and coarse
// levels that would not have it pull at it in vain: it quivers.
#pragma once

#include "solver/model/hierarchy.h"

#include <span>
#include <vector>

namespace weft {

struct PinSpan {
    std::uint32_t a = 0, b = 0;  ///< pinned particles
    float length = 0;            ///< m: hardly more than the cloth between them; less where it is bent at rest
};

/// Between up to eight pins of each connected piece, as far from one another as there are. Those nearer to one another
/// than a quarter of what lies around them do not count: what they stretch is a small part of the cloth.
std::vector<PinSpan> find_pin_spans(std::span<const CoarseLevel> hierarchy, std::span<const Vec3> at_rest);

/// Strain that some way between two pins has at least; 0 if none has to stretch.
float strain_between(std::span<const PinSpan> spans, std::span<const Vec4> positions);

}  // namespace weft
