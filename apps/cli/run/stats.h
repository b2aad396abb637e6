// The figures of a run: collected frame by frame, written as JSON, summarized on the terminal.
#pragma once

#include "solver/measures/passages.h"
#include "solver/measures/statistics.h"
#include "solver/measures/tension.h"
#include "weft/scene_world.h"

#include <weft/result.h>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace weft::cli {

/// `sorted` is ascending; the result is 0 if it is empty. The percentile is one of the values (nearest rank).
double median(const std::vector<double>& sorted);
/// The median of values in any order.
double median_of(std::vector<double> values);
double percentile(const std::vector<double>& sorted, double fraction);

/// Frames in which pairs of crossing triangles are counted.
enum class CountCrossings { last, every };

/// Reads the value of --crossings.
Result<CountCrossings> read_crossings(const std::string& word);

/// Frames in which penetration and tension are measured. In `every`, passages are counted too.
enum class MeasurePenetration { last, every };

/// The largest value of all measured frames.
struct WorstTension {
    std::optional<TensionSummary::Place> place;
    std::uint64_t frame = 0;
    void add(const std::optional<TensionSummary::Place>& of_frame, std::uint64_t index);
};

class RunStatistics {
  public:
    /// `frames`: the number of steps that will follow.
    RunStatistics(const SceneWorld& session, std::uint64_t frames, CountCrossings crossings = CountCrossings::last,
                  MeasurePenetration penetration = MeasurePenetration::last);

    /// Call it after every step.
    void add(const World& world);

    /// After the last step: everything that --stats writes. Counting intersections takes long on large meshes.
    nlohmann::ordered_json gather(const SceneWorld& session, const std::string& scene_file) const;

  private:
    double mean_speed(const Frame& frame) const;
    void add_tension(const Frame& frame);
    std::size_t order_lost(const Frame& frame) const;

    double frame_seconds_;
    std::uint64_t snapshot_frame_;
    Positions snapshot_;  ///< one second before the end
    double snapshot_time_ = 0;
    std::vector<double> step_ms_;
    std::array<double, stage_count> stage_ms_{};
    std::uint32_t reports_ = report_none;
    ClothContactCounts cloth_contacts_;
    std::optional<ParticlePlace> tangled_at_;  ///< where cloth was tangled first
    std::uint64_t tangled_frame_ = 0;
    CountCrossings count_crossings_;
    std::optional<Intersections> crossings_;  ///< of the last frame; nullopt: not counted
    std::uint64_t worst_crossings_ = 0;       ///< most pairs of triangles in a counted frame
    MeasurePenetration measure_penetration_;
    mutable PenetrationSearch penetration_search_;
    std::optional<Penetration> penetration_;  ///< of the last frame; nullopt: not measured
    Penetration worst_penetration_;
    std::uint64_t worst_penetration_frame_ = 0;
    PassageWatch passages_;
    TensionMeter tension_meter_;
    std::optional<TensionSummary> tension_;  ///< of the last frame; nullopt: not measured
    WorstTension worst_tension_, worst_load_;
    SheetOrder order_;  ///< followed through the counted frames
};

/// "xpbd, lines", "pbd, jacobi by gather, hierarchy"
std::string solver_text(const WorldSettings& settings);

Result<void> write_stats(const nlohmann::ordered_json& stats, const std::filesystem::path& file);

/// Prints a few lines on stdout.
void print_summary(const nlohmann::ordered_json& stats);

}  // namespace weft::cli
