// Runs scenes and times them. What comes out are values; bench_report.h writes and compares them.
#pragma once

#include "cli/shell/command.h"
#include "solver/measures/statistics.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace weft {
class SceneWorld;
}

namespace weft::cli {

struct BenchSettings {
    Length length;              ///< of simulated time, measured
    std::uint32_t warmup = 30;  ///< frames before the first one that counts
    std::uint32_t repeat = 3;   ///< runs, each from a fresh load
    bool quiet = false;         ///< no progress
    Options common;
};

/// Something to measure.
struct BenchSubject {
    std::string name;
    std::function<Result<SceneWorld>(const Options&)> open;
};

/// A scene file.
BenchSubject scene_subject(const std::string& file);
/// A sheet of cotton, 1 m by 1 m, hung by two corners, of 32² to 256² particles.
std::vector<BenchSubject> built_in_subjects();
/// Such sheets with all that takes time to build, tethers and coarse levels included.
std::vector<BenchSubject> build_subjects(const std::vector<std::uint32_t>& sides);

struct Distribution {
    double median = 0, p95 = 0, min = 0, max = 0;
};

struct StageFigures {
    std::string name;
    double ms = 0;            ///< a frame: median over the frames
    double reference_ms = 0;  ///< what it touches, streamed once per pass
};

struct PartFigures {
    std::string name;
    double ms = 0;  ///< all cloths: median over the runs
};

struct ConstraintFigures {
    std::string name;
    std::uint64_t rows = 0;
    /// The stage's time over rows, substeps and iterations, on all threads together: two threads halve it.
    double ns_per_row = 0;
    double bytes_per_row = 0;             ///< likewise, and particles shared out among the rows
    double reference_ns_per_row = 0;      ///< at the scene's bandwidth
    std::optional<double> ratio() const;  ///< measured over reference
};

/// What the frame has to move and how long that takes (bench_reference.h).
struct ReferenceFigures {
    double bytes_per_frame = 0, working_set = 0;
    /// Bytes a second: of copies within as much memory as the working set, on as many threads. 0 where a device runs
    /// it.
    double bandwidth = 0;
    double ms = 0;  ///< 0 without that
};

struct SceneFigures {
    std::string name;
    std::string backend, device, isa;
    std::string solver;  ///< method, projection and whether there is a hierarchy, in words
    std::uint64_t threads = 0, substeps = 0, iterations = 0;
    double frame_rate = 0;
    std::uint64_t warmup = 0, frames = 0, runs = 0;
    std::uint64_t timed_frames = 0;  ///< in each run

    std::uint64_t particles = 0, triangles = 0;
    std::vector<ConstraintFigures> constraints;
    Distribution ms;                  ///< a frame, over the frames of all runs
    std::vector<double> run_medians;  ///< ms
    ReferenceFigures reference;
    std::vector<StageFigures> stages;
    double load_ms = 0;              ///< from the file to a world that can step; median over the runs
    double build_ms = 0;             ///< of that, the making of cloths from meshes
    std::vector<PartFigures> build;  ///< part by part
    double first_frame_ms = 0;       ///< and to the end of its first frame
    /// Averages over the frames of the last 2 s, or of the whole run, warmup included, if that is shorter.
    MeanMax stretch, shear, residual;
    double quality_seconds = 0;  ///< how long that is
    /// What the heap holds for the scene, file and drawn mesh included; nothing where that cannot be known. Where
    /// software plays a GPU, the GPU's memory too.
    std::optional<double> bytes_per_particle;
    double device_bytes_per_particle = 0;  ///< of a device's memory, beside that
    std::vector<std::string> reports;
    std::string state_hash;

    /// Median over reference; nothing without one.
    std::optional<double> ratio() const;
};

/// Largest less smallest median of the runs, as a part of the median of all frames. One run tells nothing of it.
std::optional<double> spread(const SceneFigures& figures);

/// Runs the scene once without a clock, for stretch, residual and memory, and then `repeat` times with one. Measuring
/// every particle between two frames would move the second one out of the caches, hence the run apart. No frame is
/// brought to the host.
/// Fails where the scene cannot be opened, and where two runs end in different states.
Result<SceneFigures> measure_scene(const BenchSubject& subject, const BenchSettings& settings);

/// Frames that sample_scene adds to a run.
inline constexpr std::uint64_t frames_per_sample = 10;

/// Likewise for a comparison of many settings: one run without a clock, and from where it ends `repeat` times a few
/// frames with one. Quality needs all those seconds, time does not. `go_on` is told after every frame how many there
/// have been; where it says no, nothing comes out.
Result<std::optional<SceneFigures>> sample_scene(const BenchSubject& subject, const BenchSettings& settings,
                                                 const std::function<bool(std::uint64_t frames)>& go_on);

}  // namespace weft::cli
