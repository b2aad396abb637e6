// Triangle meshes that no artist means to make.
#pragma once

#include "mesh/triangle_mesh.h"

namespace weft::physical {

/// Three triangles at one edge, a triangle given twice and once more with the opposite winding, one that is a point,
/// one that is a line, an unused vertex, and a triangle that is attached at a single corner.
inline TriangleMesh messy_mesh() {
    return {.positions = {{0, 0, 0},
                          {0, 1, 0},
                          {1, 0.5f, 0},
                          {-1, 0.5f, 0.2f},
                          {0, 0.5f, 1},
                          {5, 5, 5},
                          {0, 2, 0},
                          {0.5f, 3, 0},
                          {-0.5f, 3, 0.1f}},
            .triangles = {
                {0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 2, 0}, {2, 1, 0}, {3, 3, 3}, {0, 1, 6}, {6, 7, 8}, {1, 2, 6}}};
}

/// Two triangles folded onto each other, with opposite normals.
inline TriangleMesh folded_mesh() {
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1e-7f, 0, 1}, {1, 1e-7f, 0.1f}},
            .triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}}};
}

/// Two very thin triangles and a very small one between them.
inline TriangleMesh needle_mesh() {
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-6f, 0}, {0.5f, -1e-6f, 1e-6f}, {0.5f, 0, 100}},
            .triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {1, 4, 2}}};
}

}  // namespace weft::physical
