// Turns the cuts of a scene into edges to open.
#pragma once

#include "scene/scene_desc.h"
#include "solver/model/cloth_edit.h"
#include "solver/model/cloth_model.h"
#include "solver/model/tear_paint.h"
#include "weft/placement.h"

#include <weft/result.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The edges that a cut of the scene opens.
struct PlannedCut {
    float time = 0;  ///< s
    std::vector<Opening> openings;
    bool failed = false;  ///< there was no room for it when it was due
};

/// Plans the cuts of a cloth that was just built, by ascending time. Fails if a cut would open nothing, leaves the
/// cloth, or if the cloth has no room for the copies of particles. `pointer`: the place of the cloth in errors.
Result<std::vector<PlannedCut>> plan_cuts(const SceneCloth& cloth, const ClothModel& model, const std::string& pointer);

/// What the scene says of the strength of the cloth: of its seams, and of its particles. Fails if a seam meets no edge
/// or leaves the cloth, or if a resistance selects nothing. Null if it says nothing.
Result<std::shared_ptr<const TearPaint>> paint_strength(const SceneCloth& cloth, const ClothModel& model,
                                                        const PinnedCloth& particles, const std::string& pointer);

/// The same with the seams that the model has.
Result<std::shared_ptr<const TearPaint>> repaint_resistance(const SceneCloth& cloth, const ClothModel& model,
                                                            const PinnedCloth& particles, const std::string& pointer);

/// The closed edges that a cut opens now. `positions`: of the particles; empty: the cut lies on the cloth as it was
/// built. Fails like plan_cuts(); `where` of errors is `place`.
Result<std::vector<Opening>> find_cut(const CutDesc& cut, const ClothModel& model, std::span<const Vec4> positions,
                                      const std::string& place);

/// Fails if opening these edges parts nothing, or needs more copies of particles than the cloth has room for.
Result<void> check_opens(const ClothModel& model, std::span<const Opening> openings, const std::string& place);

}  // namespace weft
