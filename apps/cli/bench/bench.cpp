#include "cli/bench/bench_report.h"
#include "cli/run/stats.h"
#include "io/files/atomic_file.h"
#include "weft/scene_world.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace weft::cli {
namespace {

struct BenchOptions {
    std::vector<std::string> scenes;
    BenchSettings settings;
    std::string json, compare;
    std::vector<std::uint32_t> build;  ///< sides of the sheets whose build is measured
};

void append(Errors& all, const Errors& more) {
    // A wrong option fails for every scene; it is reported once.
    for (const Error& error : more) {
        const auto same = [&](const Error& known) { return known.message() == error.message(); };
        if (std::ranges::none_of(all, same)) all.push_back(error);
    }
}

// Checks the input before the first run, because a report may take minutes.
Errors check(const BenchOptions& options, const std::vector<BenchSubject>& subjects) {
    Errors errors;
    const auto range = [&](const char* name, std::uint32_t value, std::uint32_t least, std::uint32_t most) {
        if (value >= least && value <= most) return;
        append(errors, {{name, "must be from " + std::to_string(least) + " to " + std::to_string(most) + ", got " +
                                   std::to_string(value)}});
    };
    range("--repeat", options.settings.repeat, 1, 1000);
    range("--warmup", options.settings.warmup, 0, 1000000);
    for (const std::uint32_t side : options.build) range("--build", side, 8, 2048);
    if (!errors.empty()) return errors;  // do not open scenes with options that are out of range
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
    if (!options.json.empty()) {  // creates and removes the file, to report a wrong name before the runs
        if (const auto file = AtomicFile::create(options.json); !file) append(errors, file.errors());
    }
    return errors;
}

std::vector<BenchSubject> subjects_of(const BenchOptions& options) {
    std::vector<BenchSubject> subjects;
    for (const std::string& scene : options.scenes) subjects.push_back(scene_subject(scene));
    for (BenchSubject& subject : build_subjects(options.build)) subjects.push_back(std::move(subject));
    return subjects.empty() ? built_in_subjects() : subjects;
}

Result<BenchReport> measure(const BenchOptions& options, const std::vector<BenchSubject>& subjects) {
    BenchReport report = empty_report();
    for (const BenchSubject& subject : subjects) {
        auto figures = measure_scene(subject, options.settings);
        if (!figures) return figures.errors();
        report.scenes.push_back(std::move(*figures));
    }
    report.memory = measure_memory(report.scenes.front().threads);
    return report;
}

// For the sheets of --build, if their backend is a device.
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
    const std::vector<BenchSubject> subjects = subjects_of(options);
    std::optional<BenchReport> before;
    if (!options.compare.empty()) {
        auto read = read_report(options.compare);
        if (!read) return failed(read.errors(), exit_usage);
        before = std::move(*read);
    }
    if (const Errors errors = check(options, subjects); !errors.empty()) return failed(errors, exit_usage);
    auto report = measure(options, subjects);
    if (!report) return failed(report.errors(), exit_failed);
    auto edges = edges_of(options, *report);
    if (!edges) return failed(edges.errors(), exit_failed);
    report->edges = std::move(*edges);
    if (!options.json.empty()) {
        if (const auto written = write_stats(to_json(*report), options.json); !written)
            return failed(written.errors(), exit_failed);
    }

    const bool quiet = options.settings.quiet;
    if (!quiet) std::fputs(tables(*report).c_str(), stdout);
    if (before) std::printf("%s%s", quiet ? "" : "\n", comparison(*report, *before, options.compare).c_str());
    if (!options.json.empty() && !quiet) std::printf("\nwrote %s\n", options.json.c_str());
    return exit_done;
}

}  // namespace

Command add_bench(Program& program) {
    Arguments arguments =
        program.add_command("bench", "Measure speed, stretch and memory; compare with an earlier run");
    auto options = std::make_shared<BenchOptions>();
    arguments.add("scene", options->scenes, "scene files; if none is given, hanging sheets of 32² to 256² particles")
        .called("FILE");
    add_length_options(arguments, options->settings.length, "measure");
    arguments.add("--warmup", options->settings.warmup, "frames before those, not measured").called("N").with_default();
    arguments.add("--repeat", options->settings.repeat, "runs, each from a newly loaded scene")
        .called("N")
        .with_default();
    arguments.add("--json", options->json, "write all figures to this file").called("FILE");
    arguments.add("--compare", options->compare, "print ratios to the figures of this file, now / before")
        .called("FILE");
    arguments
        .add("--build", options->build,
             "measure how long cloths of these resolutions take to build, with tethers and coarse levels")
        .called("N");
    arguments.add("--quiet", options->settings.quiet, "print ratios and errors only");
    add_common_options(arguments, options->settings.common);
    arguments.footer(
        "Examples:\n"
        "  weft bench --json before.json\n"
        "  weft bench --compare before.json\n"
        "  weft bench --build 128 317 --frames 1 --warmup 0 --repeat 5\n"
        "  weft bench scenes/banner.json scenes/curtain.json --threads 2 --repeat 5\n"
        "A first run without timing measures stretch, shear and residual over its last 2 s.");
    return [options] { return bench(*options); };
}

}  // namespace weft::cli
