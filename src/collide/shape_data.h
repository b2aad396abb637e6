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
    float steepness = 1;         ///< at least 1: the surface is no nearer than the kernel's distance divided by this
    /// m: parts of the surface that face the same way, one behind the other, are at least this far apart.
    float layer_distance = static_cast<float>(far_away);
    Bounds bounds;         ///< m: of the shape in its own frame, without what its numbers add
    TriangleMesh surface;  ///< the shape's surface, without what its numbers add
    bool open = false;     ///< `surface` has holes

    ShapeBlocks blocks() const { return {words.data()}; }
};

}  // namespace weft
