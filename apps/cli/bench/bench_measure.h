// Runs scenes and times them. The results are values; bench_report.h writes and compares them.
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
    Length length;              ///< simulated time to measure
    std::uint32_t warmup = 30;  ///< frames before the first measured one
    std::uint32_t repeat = 3;   ///< runs, each with the scene loaded anew
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
/// Such sheets with everything that takes time to build, including tethers and coarse levels.
std::vector<BenchSubject> build_subjects(const std::vector<std::uint32_t>& sides);

struct Distribution {
    double median = 0, p95 = 0, min = 0, max = 0;
};

struct StageFigures {
    std::string name;
    double ms = 0;            ///< per frame: median over the frames
    double reference_ms = 0;  ///< the minimal memory traffic at the reference bandwidth
};

struct PartFigures {
    std::string name;
    double ms = 0;  ///< all cloths: median over the runs
};

struct ConstraintFigures {
    std::string name;
    std::uint64_t rows = 0;
    /// The stage's time divided by constraints, substeps and iterations, for all threads together: two threads halve
    /// it.
    double ns_per_row = 0;
    double bytes_per_row = 0;             ///< likewise, with the bytes of particles divided among the constraints
    double reference_ns_per_row = 0;      ///< at the scene's bandwidth
    std::optional<double> ratio() const;  ///< measured over reference
};

/// The memory traffic of a frame and how long it takes (bench_reference.h).
struct ReferenceFigures {
    double bytes_per_frame = 0, working_set = 0;
    /// Bytes per second: of copies within as much memory as the working set, on as many threads. 0 on a device.
    double bandwidth = 0;
    double ms = 0;  ///< 0 without a bandwidth
};

struct SceneFigures {
    std::string name;
    std::string backend, device, isa;
    std::string solver;  ///< method, projection and whether there is a hierarchy, as text
    std::uint64_t threads = 0, substeps = 0, iterations = 0;
    double frame_rate = 0;
    std::uint64_t warmup = 0, frames = 0, runs = 0;
    std::uint64_t timed_frames = 0;  ///< in each run

    std::uint64_t particles = 0, triangles = 0;
    std::vector<ConstraintFigures> constraints;
    Distribution ms;                  ///< per frame, over the frames of all runs
    std::vector<double> run_medians;  ///< ms
    ReferenceFigures reference;
    std::vector<StageFigures> stages;
    double load_ms = 0;              ///< from the file to a world that can step; median over the runs
    double build_ms = 0;             ///< of that, building cloths from meshes
    std::vector<PartFigures> build;  ///< the same by part
    double first_frame_ms = 0;       ///< load_ms and the first frame
    /// Averages over the frames of the last 2 s, or of the whole run, warmup included, if that is shorter.
    MeanMax stretch, shear, residual;
    double quality_seconds = 0;  ///< length of that window
    /// Heap memory for the scene, including file and drawn mesh; empty if unknown. With a software Vulkan driver it
    /// includes the GPU memory.
    std::optional<double> bytes_per_particle;
    double device_bytes_per_particle = 0;  ///< device memory, in addition
    std::vector<std::string> reports;
    std::string state_hash;

    /// Median divided by reference; empty without a reference.
    std::optional<double> ratio() const;
};

/// Largest minus smallest median of the runs, relative to the median of all frames. Empty for a single run.
std::optional<double> spread(const SceneFigures& figures);

/// Runs the scene once without a clock, for stretch, residual and memory, then `repeat` times with a clock. The run
/// without a clock is separate because measuring every particle between two frames would evict the next frame's data
/// from the caches. No frame is copied to the host. Fails if the scene cannot be opened or if two runs end in different
/// states.
Result<SceneFigures> measure_scene(const BenchSubject& subject, const BenchSettings& settings);

/// Frames that sample_scene() adds per repetition.
inline constexpr std::uint64_t frames_per_sample = 10;

/// The same for a comparison of many settings: one run without a clock, then `repeat` times a few timed frames from its
/// end. Quality needs the whole run, timing does not. `go_on` is called after every frame with the number of frames so
/// far; if it returns false, the result is empty.
Result<std::optional<SceneFigures>> sample_scene(const BenchSubject& subject, const BenchSettings& settings,
                                                 const std::function<bool(std::uint64_t frames)>& go_on);

}  // namespace weft::cli
