// Data of a collider's shape, made once and shared by all colliders that have it.
#pragma once

#include "base/aligned.h"
#include "base/parameter.h"
#include "mesh/triangle_mesh.h"
#include "physics/shape_blocks.h"

#include <weft/bounds.h>

namespace weft {

struct ShapeData {
    AlignedVector<float> words;  ///< for the shape's kernel, whose file says what they hold; whole blocks of four
    /// The surface is no nearer than the kernel's distance divided by this: 1 for a convex shape, more for another one.
    float steepness = 1;
    /// m: what passes through the shape, without what its numbers add, or through one of its parts, moves at least this
    /// far.
    float width = 0;
    Bounds bounds;         ///< m: of the shape in its own frame, without what its numbers add
    TriangleMesh surface;  ///< the shape's surface, without what its numbers add
    bool open = false;     ///< `surface` has holes

    ShapeBlocks blocks() const { return {words.data()}; }
};

}  // namespace weft
