// A stroke of the pointer across a cloth as cuts.
#pragma once

#include "editor/tools/picking.h"
#include "editor/tools/surface_distance.h"

#include <weft/scene.h>

#include <span>
#include <vector>

namespace weft::editor {

struct CutCloth {
    MeshView mesh;                        ///< as it is now
    const TriangleTree* tree = nullptr;   ///< of the mesh
    SurfaceDistance* distance = nullptr;  ///< of the mesh
    std::span<const Vec4> start = {};  ///< positions at the start, per vertex; empty: cuts lie on the mesh as it is now
};

/// The parts of the stroke that lie on the cloth, in the order of the stroke, as polylines on the cloth as it is now
/// (CutPositions::current) or, with CutCloth::start, as it starts (CutPositions::start). A new part begins where the
/// stroke leaves the cloth, where another surface hides it, and where it passes from one layer of a fold to another.
/// The ends lie within 0.02 pixels of the border. Points that are within a quarter of an edge of the line between
/// others are left out, so that straight strokes give straight cuts. Parts shorter than half an edge are left out, and
/// those shorter than two edges if another one is longer: a single edge inside a cloth parts nothing. `hiding`: all
/// other surfaces.
std::vector<PathCut> cuts_of_stroke(const Projection& view, std::span<const Vec2> stroke, const CutCloth& cloth,
                                    const PickScene& hiding);

}  // namespace weft::editor
