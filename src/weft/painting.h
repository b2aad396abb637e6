// Factors that a scene gives to particles.
#pragma once

#include "mesh/topology.h"
#include "scene/scene_desc.h"
#include "solver/model/cloth_weights.h"
#include "weft/placement.h"

#include <weft/result.h>

#include <span>
#include <string>
#include <vector>

namespace weft {

/// Sets the factors of the particles that `desc`, a ResistanceDesc or a WeightDesc, selects. `factors`: per particle.
/// Fails if it selects none, or if the mesh has no colors that it needs. `place`: its place in errors.
template <class Desc>
Result<void> paint_factors(const Desc& desc, const PinnedCloth& cloth, std::vector<float>& factors,
                           const std::string& place);
extern template Result<void> paint_factors(const ResistanceDesc&, const PinnedCloth&, std::vector<float>&,
                                           const std::string&);
extern template Result<void> paint_factors(const WeightDesc&, const PinnedCloth&, std::vector<float>&,
                                           const std::string&);

/// The member with the factors on one value of the fabric.
ClothWeights::Factors ClothWeights::*factors_of(WeightOf of);

/// The weights of a cloth, of which each triangle gets the mean of its corners. `place`: that of `weights` in errors.
Result<ClothWeights> weights_of(std::span<const WeightDesc> weights, const PinnedCloth& cloth,
                                std::span<const Triangle> triangles, const std::string& place);

}  // namespace weft
