// Build times of a cloth model, by part.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace weft {

enum class BuildPart : std::uint32_t {
    topology,   ///< welding, removal of degenerate triangles, edges, ordering, adjacency
    rows,       ///< parameters of all constraints except tethers
    tethers,    ///< tether constraints: geodesic distances
    coloring,   ///< of constraints into batches
    tables,     ///< constraints packed batch by batch
    hierarchy,  ///< coarse levels with their constraints and tables
    rest,       ///< masses, positions, faces, binding of a render mesh
};
inline constexpr std::uint32_t build_part_count = 7;

constexpr std::string_view build_part_name(std::uint32_t part) {
    constexpr std::array<std::string_view, build_part_count> names = {"topology", "rows",      "tethers", "coloring",
                                                                      "tables",   "hierarchy", "rest"};
    return names[part];
}

struct BuildTimes {
    std::array<double, build_part_count> ms{};

    double total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
};

/// Adds up the times between calls.
class BuildClock {
  public:
    explicit BuildClock(BuildTimes& times) : times_(times), since_(Clock::now()) {}

    /// Adds the time since the last call to `part`.
    void spent_on(BuildPart part) {
        const Clock::time_point now = Clock::now();
        times_.ms[static_cast<std::uint32_t>(part)] += std::chrono::duration<double, std::milli>(now - since_).count();
        since_ = now;
    }

  private:
    using Clock = std::chrono::steady_clock;
    BuildTimes& times_;
    Clock::time_point since_;
};

}  // namespace weft
