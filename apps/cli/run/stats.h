// The figures of a run: gathered frame by frame, written as JSON, summed up for a human.
#pragma once

#include "weft/scene_world.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace weft::cli {

/// Of values in ascending order; 0 if there are none. The percentile is one of the values (nearest rank).
double median(const std::vector<double>& sorted);
double percentile(const std::vector<double>& sorted, double fraction);

class RunStatistics {
  public:
    /// `frames` steps are going to be run.
    RunStatistics(const SceneWorld& session, std::uint64_t frames);

    /// After every step.
    void add(const World& world);

    /// After the last one: everything that --stats writes. Counting intersections takes a while on large meshes.
    nlohmann::ordered_json gather(const SceneWorld& session, const std::string& scene_file) const;

  private:
    double mean_speed(const Frame& frame) const;

    double frame_seconds_;
    std::uint64_t snapshot_frame_;
    std::vector<Vec3> snapshot_;  ///< positions a second before the end
    double snapshot_time_ = 0;
    std::vector<double> step_ms_;
    std::array<double, stage_count> stage_ms_{};
    std::uint32_t reports_ = report_none;
};

/// "xpbd, lines", "pbd, jacobi by gather, hierarchy"
std::string solver_text(const WorldSettings& settings);

Result<Done> write_stats(const nlohmann::ordered_json& stats, const std::filesystem::path& file);

/// A few lines on stdout.
void print_summary(const nlohmann::ordered_json& stats);

}  // namespace weft::cli
