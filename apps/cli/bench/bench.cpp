#include "cli/bench/bench_curves.h"
#include "cli/bench/bench_reference.h"
#include "cli/bench/bench_report.h"
#include "cli/run/stats.h"
#include "io/files/atomic_file.h"
#include "weft/session.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace weft::cli {
namespace {

struct BenchOptions {
    std::vector<std::string> scenes;
    BenchSettings settings;
    std::string json, compare;
    std::optional<std::uint32_t> warmup;
    CurveSettings curves;  ///< no sides: no curves
    std::string plot;
    std::vector<std::uint32_t> build;  ///< sides of sheets with all that takes time to build
};

void append(Errors& all, const Errors& more) {
    // An option that is wrong is wrong for every scene.
    for (const Error& error : more) {
        const auto same = [&](const Error& known) { return known.message() == error.message(); };
        if (std::ranges::none_of(all, same)) all.push_back(error);
    }
}

// What is wrong with the input, known before the first run rather than after the last: a report may take minutes.
Errors check(const BenchOptions& options, const std::vector<BenchSubject>& subjects) {
    Errors errors;
    const auto range = [&](const char* name, std::uint32_t value, std::uint32_t least, std::uint32_t most) {
        if (value >= least && value <= most) return;
        append(errors, {{name, "must be from " + std::to_string(least) + " to " + std::to_string(most) + ", got " +
                                   std::to_string(value)}});
    };
    range("--repeat", options.settings.repeat, 1, 1000);
    range("--warmup", options.settings.warmup, 0, 1000000);
    for (const std::uint32_t side : options.curves.sides) range("--curves", side, 8, 1024);
    if (!options.curves.sides.empty() && !options.scenes.empty())
        append(errors, {{"--curves", "has sheets of its own and takes no scenes"}});
    if (!options.curves.sides.empty()) {
        const auto own = [&](const char* name, bool given) {
            if (given) append(errors, {{name, "is what the curves go through"}});
        };
        const Options& common = options.settings.common;
        own("--substeps", common.substeps.has_value());
        own("--projection", !common.projection.empty());
        own("--hierarchy", common.hierarchy.has_value());
    }
    for (const std::uint32_t side : options.build) range("--build", side, 8, 2048);
    if (!options.build.empty() && !options.curves.sides.empty())
        append(errors, {{"--build", "does not go with --curves"}});
    if (!options.plot.empty() && options.curves.sides.empty()) append(errors, {{"--plot", "needs --curves"}});
    if (!errors.empty()) return errors;  // what is out of range need not be tried
    for (const BenchSubject& subject : subjects) {
        const auto session = subject.open(options.settings.common);
        if (!session) {
            append(errors, session.errors());
            continue;
        }
        for (const std::string& note : session->notes()) print_warning(subject.name + ": " + note);
        const auto frames = frame_count(options.settings.length, session->frame_seconds());
        if (!frames) append(errors, frames.errors());
    }
    if (!options.plot.empty()) {
        if (const auto file = AtomicFile::create(options.plot); !file) append(errors, file.errors());
    }
    if (!options.json.empty()) {  // made and gone again: at the end it would be too late to say that it cannot be
        if (const auto file = AtomicFile::create(options.json); !file) append(errors, file.errors());
    }
    return errors;
}

MemoryFigures measure_memory(std::uint64_t threads) {
    const std::size_t bytes = beyond_caches();
    return {threads, bytes, copy_bandwidth(static_cast<unsigned>(threads), bytes)};
}

std::vector<BenchSubject> subjects_of(const BenchOptions& options) {
    std::vector<BenchSubject> subjects = curve_meshes(options.curves.sides);
    for (const std::string& scene : options.scenes) subjects.push_back(scene_subject(scene));
    for (BenchSubject& subject : build_subjects(options.build)) subjects.push_back(std::move(subject));
    return subjects.empty() ? built_in_subjects() : subjects;
}

Result<BenchReport> measure(const BenchOptions& options, const std::vector<BenchSubject>& subjects, Curves& curves) {
    BenchReport report = empty_report();
    if (options.curves.sides.empty()) {
        for (const BenchSubject& subject : subjects) {
            auto figures = measure_scene(subject, options.settings);
            if (!figures) return figures.errors();
            report.scenes.push_back(std::move(*figures));
        }
    } else {
        CurveSettings settings = options.curves;
        settings.bench = options.settings;
        auto measured = measure_curves(settings);
        if (!measured) return measured.errors();
        curves = std::move(*measured);
        for (const CurvePoint& point : curves.points) report.scenes.push_back(point.figures);
        if (report.scenes.empty()) return Error{"", "interrupted before anything was measured"};
    }
    report.memory = measure_memory(report.scenes.front().threads);
    return report;
}

Result<Done> write_files(const BenchOptions& options, const BenchReport& report, const Curves& curves) {
    if (!options.json.empty()) {
        if (auto written = write_stats(to_json(report), options.json); !written) return written;
    }
    if (!options.plot.empty()) return write_curves(curves.points, options.plot);
    return Done{};
}

// Of the sheets of --build, where their backend is a device.
Result<std::vector<EdgeFigures>> edges_of(const BenchOptions& options, const BenchReport& report) {
    const bool on_device = std::ranges::find(report.scenes, "vulkan", &SceneFigures::backend) != report.scenes.end();
    if (options.build.empty() || !on_device) return std::vector<EdgeFigures>{};
    return measure_edges(options.build, options.settings);
}

int bench(BenchOptions options) {
    const auto failed = [](const Errors& errors, ExitCode code) {
        print_errors(errors);
        return code;
    };
    options.settings.common.stage_timings = true;
    // Curves are of cloths that have come to rest as far as they will in 5 s.
    options.settings.warmup = options.warmup.value_or(options.curves.sides.empty() ? 30 : 180);
    const std::vector<BenchSubject> subjects = subjects_of(options);
    std::optional<BenchReport> before;
    if (!options.compare.empty()) {
        auto read = read_report(options.compare);
        if (!read) return failed(read.errors(), exit_usage);
        before = std::move(*read);
    }
    if (const Errors errors = check(options, subjects); !errors.empty()) return failed(errors, exit_usage);
    Curves curves;
    auto report = measure(options, subjects, curves);
    if (!report) return failed(report.errors(), exit_failed);
    auto edges = edges_of(options, *report);
    if (!edges) return failed(edges.errors(), exit_failed);
    report->edges = std::move(*edges);
    if (const auto written = write_files(options, *report, curves); !written)
        return failed(written.errors(), exit_failed);

    const bool quiet = options.settings.quiet;
    if (!quiet) std::fputs((curves.points.empty() ? tables(*report) : curves_table(curves)).c_str(), stdout);
    if (before) std::printf("%s%s", quiet ? "" : "\n", comparison(*report, *before, options.compare).c_str());
    for (const std::string& file : {options.json, options.plot}) {
        if (!file.empty() && !quiet) std::printf("\nwrote %s\n", file.c_str());
    }
    if (curves.interrupted) return failed({{"", "interrupted: there are more curves than these"}}, exit_failed);
    return exit_done;
}

}  // namespace

Command add_bench(CLI::App& program) {
    CLI::App* command = program.add_subcommand("bench", "measures speed and quality, and compares them with before");
    auto options = std::make_shared<BenchOptions>();
    command->add_option("scene", options->scenes, "scene files; without any, hung sheets of 32² to 256² particles");
    add_length_options(*command, options->settings.length, "measure");
    command->add_option("--warmup", options->warmup,
                        "frames before those, not counted (default 30; 180 with --curves)");
    command
        ->add_option("--repeat", options->settings.repeat,
                     "runs, each from a fresh load; with --curves, times that 10 frames are timed")
        ->capture_default_str();
    command->add_option("--json", options->json, "write all figures to this file");
    command->add_option("--compare", options->compare, "print ratios to the figures of this file, now / before");
    command->add_option("--build", options->build,
                        "hung sheets of these sides, with tethers and coarse levels: how long a cloth takes to make");
    command->add_option("--curves", options->curves.sides,
                        "error against time: hung sheets of these sides, every method, 3 to 40 substeps");
    command
        ->add_option("--point-seconds", options->curves.most_seconds,
                     "leave out points of the curves that would take longer")
        ->capture_default_str();
    command->add_option("--plot", options->plot, "draw the curves into this SVG file");
    command->add_flag("--quiet", options->settings.quiet, "no progress, no figures but the ratios");
    add_common_options(*command, options->settings.common);
    command->footer(
        "Examples:\n"
        "  weft bench --json before.json\n"
        "  weft bench --compare before.json\n"
        "  weft bench --build 128 317 --frames 1 --warmup 0 --repeat 5\n"
        "  weft bench --curves 32 64 128 --json curves.json --plot curves.svg\n"
        "  weft bench scenes/banner.json scenes/curtain.json --threads 2 --repeat 5\n"
        "One run more than --repeat goes first, without a clock: it measures stretch, shear and residual over its last "
        "2 s.");
    return [options] { return bench(*options); };
}

}  // namespace weft::cli
