// Distances between pins. Pins that are farther apart than the cloth between them is long force it to stretch. Coarse
// levels that do not allow for this stretch make the cloth jitter.
#pragma once

#include "solver/model/hierarchy.h"

#include <span>
#include <vector>

namespace weft {

struct PinSpan {
    std::uint32_t a = 0, b = 0;  ///< pinned particles
    float length = 0;            ///< m: about the length of cloth between them; less if it is bent at rest
};

/// Returns spans between up to eight pins of each connected piece, chosen as far apart as possible. A span is left out
/// if it is shorter than a quarter of the distance to the farthest point of the piece: it stretches only a small part
/// of the cloth.
std::vector<PinSpan> find_pin_spans(std::span<const CoarseLevel> hierarchy, std::span<const Vec3> at_rest);

/// The largest strain that pins force on the cloth between them; 0 if they force none.
float strain_between(std::span<const PinSpan> spans, std::span<const Vec4> positions);

}  // namespace weft
