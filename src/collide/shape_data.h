// Data of a collider's shape, made once and shared by all colliders that have it.
#pragma once

#include "base/aligned.h"
#include "physics/shape_blocks.h"

#include <weft/bounds.h>

namespace weft {

struct ShapeData {
    AlignedVector<float> words;  ///< for the shape's kernel, whose file says what they hold; whole blocks of four
    Bounds bounds;               ///< m: of the shape in its own frame

    ShapeBlocks blocks() const { return {words.data()}; }
};

}  // namespace weft
