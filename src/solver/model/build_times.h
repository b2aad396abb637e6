// How long the making of a cloth takes, part by part.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace weft {

enum class BuildPart : std::uint32_t {
    topology,   ///< welding, sound triangles, edges, order, adjacency
    rows,       ///< the numbers of every constraint's rows but those of tethers
    tethers,    ///< their rows: ways over the cloth
    coloring,   ///< of rows into batches
    tables,     ///< rows laid out batch by batch
    hierarchy,  ///< coarse levels, their rows and tables included
    rest,       ///< masses, places, faces, binding of a drawn mesh
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

/// Adds up the time between calls.
class BuildClock {
  public:
    explicit BuildClock(BuildTimes& times) : times_(times), since_(Clock::now()) {}

    /// What has gone by since the last call was spent on this.
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
