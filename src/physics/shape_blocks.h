// Data of a collider's shape, for kernels.
#pragma once

namespace weft {

/// Blocks of four 32-bit words, aligned to 16 bytes. A shape's kernel file says what they hold. Null for shapes whose
/// four floats say everything.
struct ShapeBlocks {
    const float* words = nullptr;
};

}  // namespace weft
