// Tension in cloth, and how near it is to what the fabric carries (physics/tear/tear.md).
#pragma once

#include "solver/model/stress_table.h"
#include "solver/state/frame.h"

#include <optional>
#include <span>
#include <vector>

namespace weft {

/// One value per particle. Values computed from positions that are not finite are not finite either.
struct ClothTension {
    std::vector<double> tension;  ///< N/m: the larger principal tension, 0 if all directions are compressed
    std::vector<double> load;     ///< tension or length over its limit: 1 where the fabric would tear; 0 without limits
};

/// Whether the fabric has a limit, so that `load` is not 0 everywhere.
bool has_limit(const StressTable& table);

ClothTension measure_tension(const StressTable& table, std::span<const Vec4> positions);

/// Of all cloths of a frame.
struct TensionSummary {
    struct Place {
        double value = 0;
        ParticlePlace at;
    };
    std::optional<double> mean;  ///< N/m, over the area at rest; nullopt if every cloth is inextensible
    std::optional<Place> most;   ///< N/m: the largest tension; nullopt if every cloth is inextensible
    std::optional<Place> load;   ///< the largest load; nullopt if no cloth has a limit
};

/// Keeps the tables of a world whose cloths stay the same; other fabrics and edits are allowed.
class TensionMeter {
  public:
    TensionSummary measure(const Frame& frame);

  private:
    struct Entry {
        StressTable table;
        Fabric fabric;
        std::shared_ptr<const ClothWeights> weights;
        std::shared_ptr<const TearPaint> paint;
        std::uint64_t topology_version = 0;
        std::uint32_t particle_count = 0;
    };
    std::vector<Entry> entries_;
};

}  // namespace weft
