// A world at one moment, in memory.
#pragma once

#include "solver/model/cloth_model.h"
#include "solver/state/snapshot.h"
#include "solver/world/collider.h"
#include "solver/world/pending_models.h"
#include "solver/world/world_settings.h"

#include <weft/ids.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace weft {

/// Result of World::moment(). It shares models and shapes with the world, so that its size is about that of the
/// snapshot.
struct WorldMoment {
    Snapshot state;
    std::vector<ClothId> cloths;
    std::vector<std::shared_ptr<const ClothModel>> models;  ///< per cloth, before its edits
    std::vector<Collider> colliders;
    WorldSettings settings;
    PendingModels pending;
};

/// Bytes of memory that the moment does not share.
std::size_t size_of(const WorldMoment& moment);

}  // namespace weft
