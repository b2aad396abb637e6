#include "cli/shell/command.h"

#include "cli/run/stats.h"
#include "cli/shell/progress.h"
#include "files/open_scene.h"
#include "io/exports/export_plan.h"
#include "io/exports/scene_export.h"
#include "io/files/atomic_file.h"
#include "io/files/file_pattern.h"
#include "io/files/overwriting.h"
#include "weft/drawn_frame.h"
#include "weft/drawn_solids.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace weft::cli {
namespace {

struct RunOptions {
    std::string scene;
    Length length;
    std::vector<std::string> outputs;
    std::string stats;
    std::string crossings = "last";
    bool colliders = false;
    bool quiet = false;

    SolidChoice solids() const { return colliders ? SolidChoice::colliders : SolidChoice::bodies; }
    Options common;
};

bool holds_colliders(const std::string& path) {
    return ending_of(path) == ".glb";
}

using Exporters = std::vector<std::unique_ptr<Exporter>>;

Result<Exporters> open_exporters(const RunOptions& options) {
    Exporters exporters;
    Errors errors;
    for (const std::string& path : options.outputs) {
        auto exporter = make_exporter(path);
        if (exporter) {
            exporters.push_back(std::move(*exporter));
        } else {
            errors.insert(errors.end(), exporter.errors().begin(), exporter.errors().end());
        }
    }
    if (!errors.empty()) return errors;
    return exporters;
}

ExportInfo export_info(const SceneWorld& session, std::uint64_t frames) {
    // The start is also a frame.
    return {session.scene().name, session.scene().frame_rate, frames + 1, session.folder()};
}

/// What the exports show of the last frame.
class Exported {
  public:
    explicit Exported(SolidChoice choice) : solids_(choice) {}
    ExportFrame update(const SceneWorld& session) {
        const Frame& frame = session.world().frame();
        cloths_.update(frame, session.scene().cloths);
        solids_.update(session.world(), session.scene().colliders);
        return {frame.index, frame.time, cloths_.surfaces(), solids_.solids()};
    }

  private:
    DrawnFrame cloths_;
    DrawnSolids solids_;
};

Result<std::vector<ExportEstimate>> plan(const Exporters& exporters, const SceneWorld& session, std::uint64_t frames,
                                         Exported& exported) {
    const ExportFrame start = exporters.empty() ? ExportFrame{} : exported.update(session);
    return plan_exports(exporters, export_info(session, frames), start);
}

// Companions of an export, such as the mesh of a point cache, could have the name of a mesh that the scene reads.
Errors overwritten(const RunOptions& options, const SceneWorld& session, std::span<const ExportEstimate> estimates) {
    std::vector<std::filesystem::path> outputs, inputs = files_of(session.scene(), session.folder());
    for (const ExportEstimate& estimate : estimates)
        outputs.insert(outputs.end(), estimate.files.begin(), estimate.files.end());
    if (!options.stats.empty()) outputs.emplace_back(options.stats);
    inputs.emplace_back(options.scene);
    return overwritten_inputs(outputs, inputs);
}

Result<void> simulate(SceneWorld& session, std::uint64_t frames, Exporters& exporters, Exported& exported,
                      RunStatistics& statistics, bool quiet) {
    for (auto& exporter : exporters) {
        if (auto begun = exporter->begin(export_info(session, frames)); !begun) return begun;
    }
    const auto write = [&]() -> Result<void> {
        if (exporters.empty()) return {};
        const ExportFrame frame = exported.update(session);
        for (auto& exporter : exporters) {
            if (auto written = exporter->write(frame); !written) return written;
        }
        return {};
    };
    if (auto written = write(); !written) return written;

    Progress progress("simulating", frames, quiet);
    bool warned = false;
    for (std::uint64_t i = 1; i <= frames; ++i) {
        session.advance();
        const Frame& frame = session.world().summary();
        statistics.add(session.world());
        if (auto went = check_step(frame, warned); !went) return went;
        if (auto written = write(); !written) return written;
        progress.update(i);
    }
    for (auto& exporter : exporters) {
        if (auto finished = exporter->finish(); !finished) return finished;
    }
    return {};
}

int run(const RunOptions& options) {
    const auto wrong = [](const Errors& errors) {
        print_errors(errors);
        return exit_code(errors);
    };
    const auto crossings = read_crossings(options.crossings);
    if (!crossings) return wrong(crossings.errors());
    if (options.colliders && std::ranges::none_of(options.outputs, holds_colliders))
        return wrong({{"--colliders", "needs an --out FILE.glb: the other formats hold cloth alone"}});
    auto exporters = open_exporters(options);
    if (!exporters) return wrong(exporters.errors());
    Options common = options.common;
    common.stage_timings = !options.stats.empty();
    auto session = open_scene(options.scene, common);
    if (!session) return wrong(session.errors());
    const auto frames = frame_count(options.length, session->frame_seconds(), 0);
    if (!frames) return wrong(frames.errors());
    if (*frames == 0 && options.common.contact_forces)
        return wrong({{"--contact-forces", "gives the forces in the last frame, and 0 frames have none"}});
    Exported exported(options.solids());
    const auto estimates = plan(*exporters, *session, *frames, exported);
    if (!estimates) return wrong(estimates.errors());
    if (!options.stats.empty()) {  // creates and removes the file, to report a wrong name before the run
        if (const auto file = AtomicFile::create(options.stats); !file) return wrong(file.errors());
    }
    if (const Errors errors = overwritten(options, *session, *estimates); !errors.empty()) return wrong(errors);
    for (const std::string& note : session->notes()) print_warning(note);
    const std::size_t noted = session->notes().size();
    if (const auto note = large_export_note(*estimates)) print_warning(*note);

    // Without --stats, a run measures its last frame only.
    const auto measured = options.stats.empty() ? MeasurePenetration::last : MeasurePenetration::every;
    RunStatistics statistics(*session, *frames, *crossings, measured);
    if (auto done = simulate(*session, *frames, *exporters, exported, statistics, options.quiet); !done) {
        print_errors(done.errors());
        return exit_failed;
    }
    for (std::size_t i = noted; i < session->notes().size(); ++i) print_warning(session->notes()[i]);
    if (options.quiet && options.stats.empty()) return exit_done;
    const auto stats = statistics.gather(*session, options.scene);
    if (!options.stats.empty()) {
        if (auto written = write_stats(stats, options.stats); !written) {
            print_errors(written.errors());
            return exit_failed;
        }
    }
    if (!options.quiet) {
        print_summary(stats);
        for (const ExportEstimate& written : *estimates) {
            for (const auto& file : written.files) std::printf("wrote %s\n", file.c_str());
        }
        if (!options.stats.empty()) std::printf("wrote %s\n", options.stats.c_str());
    }
    return exit_done;
}

}  // namespace

Result<void> check_step(const Frame& frame, bool& warned) {
    const std::string where = "frame " + std::to_string(frame.index);
    for (const ClothFrame& cloth : frame.cloths) {
        if (cloth.reports & report_device_failed) return Error::of_machine(where, cloth.detail);
        if (warned || !(cloth.reports & report_non_finite)) continue;
        print_warning(where + ": cloth '" + cloth.model->name +
                      "' was reset to the start of the frame: " + cloth.detail);
        warned = true;
    }
    return {};
}

Command add_run(Program& program) {
    Arguments arguments = program.add_command("run", "Simulate a scene, export and measure it");
    auto options = std::make_shared<RunOptions>();
    arguments.add("scene", options->scene, "scene file").called("FILE").required();
    add_length_options(arguments, options->length, "simulate; 0 exports and measures the start");
    arguments
        .add("--out", options->outputs,
             "FILE.glb or FILE.pc2: animated; FILE.obj or FILE.ply: the last frame; DIR/%04d.obj: every frame; may be "
             "repeated")
        .called("FILE")
        .one_at_a_time();
    arguments.add("--colliders", options->colliders,
                  "also write colliders that are no bodies to FILE.glb, except planes");
    arguments
        .add("--stats", options->stats,
             "write times, stretch, energy, penetration and passages of the run to this JSON file; penetration is then "
             "measured in every frame, which takes time")
        .called("FILE");
    arguments
        .add("--crossings", options->crossings,
             "where to count pairs of crossing triangles: in the last frame, or in every frame, which is slow and "
             "finds the worst one")
        .called("last|every")
        .with_default();
    arguments.add("--contact-forces", options->common.contact_forces,
                  "print force and torque of the cloths on each collider in the last frame");
    arguments.add("--quiet", options->quiet, "print errors only");
    add_common_options(arguments, options->common);
    arguments.footer(
        "Examples:\n"
        "  weft run scenes/sheet_on_sphere.json --seconds 3 --out sheet.glb --stats stats.json\n"
        "  weft run scenes/hanging_sheet.json --frames 120 --out frames/%04d.ply --threads 2");
    return [options] { return run(*options); };
}

}  // namespace weft::cli
