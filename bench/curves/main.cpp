// weft_bench_curves: error against time, method by method.
#include "cli/bench/bench_report.h"
#include "cli/run/stats.h"
#include "curves.h"
#include "files/open_scene.h"
#include "io/files/atomic_file.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>

namespace weft::bench {
namespace {

using namespace cli;

struct Request {
    CurveSettings curves;
    std::string json, plot;
};

// Checks the input before the first run, because the curves may take minutes.
Errors check(const Request& request) {
    Errors errors;
    const auto range = [&](const char* name, std::uint32_t value, std::uint32_t least, std::uint32_t most) {
        if (value >= least && value <= most) return;
        errors.push_back({name, "must be from " + std::to_string(least) + " to " + std::to_string(most) + ", got " +
                                    std::to_string(value)});
    };
    const BenchSettings& settings = request.curves.bench;
    range("--repeat", settings.repeat, 1, 1000);
    range("--warmup", settings.warmup, 0, 1000000);
    for (const std::uint32_t side : request.curves.sides) range("side", side, 8, 1024);
    for (const auto& [key, value] : settings.common.solver)
        if (key == "substeps" || key == "projection" || key == "hierarchy")
            errors.push_back({"--" + key, "is what the curves go through"});
    if (!errors.empty()) return errors;  // do not open scenes with options that are out of range
    for (const BenchSubject& mesh : curve_meshes(request.curves.sides)) {
        if (const auto session = mesh.open(settings.common); !session) return session.errors();
    }
    if (const auto frames = frame_count(settings.length, 1.0 / SceneDesc{}.frame_rate); !frames) return frames.errors();
    for (const std::string& file : {request.json, request.plot}) {  // creates and removes the files
        if (file.empty()) continue;
        if (const auto made = AtomicFile::create(file); !made) return made.errors();
    }
    return errors;
}

Result<void> write_files(const Request& request, const Curves& curves) {
    if (!request.json.empty()) {
        BenchReport report = empty_report();
        for (const CurvePoint& point : curves.points) report.scenes.push_back(point.figures);
        report.memory = measure_memory(report.scenes.front().threads);
        if (auto written = write_stats(to_json(report), request.json); !written) return written;
    }
    if (!request.plot.empty()) return write_curves(curves.points, request.plot);
    return {};
}

int run(Request request) {
    const auto failed = [](const Errors& errors, ExitCode code) {
        print_errors(errors);
        return code;
    };
    request.curves.bench.common.stage_timings = true;
    if (const Errors errors = check(request); !errors.empty()) return failed(errors, exit_usage);
    const auto curves = measure_curves(request.curves);
    if (!curves) return failed(curves.errors(), exit_failed);
    if (curves->points.empty()) return failed({{"", "interrupted before anything was measured"}}, exit_failed);
    if (const auto written = write_files(request, *curves); !written) return failed(written.errors(), exit_failed);

    if (!request.curves.bench.quiet) {
        std::fputs(curves_table(*curves).c_str(), stdout);
        for (const std::string& file : {request.json, request.plot}) {
            if (!file.empty()) std::printf("\nwrote %s\n", file.c_str());
        }
    }
    if (curves->interrupted) return failed({{"", "interrupted: there are more curves than these"}}, exit_failed);
    return exit_done;
}

int run_program(int argc, char** argv) {
    Program program("Error against time: hung sheets, every method, 3 to 40 substeps.", "weft_bench_curves");
    Arguments arguments = program.arguments();
    Request request;
    BenchSettings& settings = request.curves.bench;
    settings.warmup = 180;  // 5 s with the default length: the sheets have almost come to rest
    arguments.add("side", request.curves.sides, "particles along a side of the sheets, 8 to 1024").required();
    add_length_options(arguments, settings.length, "measure");
    arguments.add("--warmup", settings.warmup, "frames before those, not counted").with_default();
    arguments.add("--repeat", settings.repeat, "how often 10 frames are timed").with_default();
    arguments
        .add("--point-seconds", request.curves.most_seconds, "leave out points of the curves that would take longer")
        .with_default();
    arguments.add("--json", request.json, "write all figures to this file");
    arguments.add("--plot", request.plot, "draw the curves into this SVG file");
    arguments.add("--quiet", settings.quiet, "no progress, no figures");
    add_common_options(arguments, settings.common);
    arguments.footer("Example:\n  weft_bench_curves 32 64 128 --json curves.json --plot curves.svg");
    if (const auto status = program.parse(argc, argv)) return *status;
    return run(std::move(request));
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
    try {
        return weft::bench::run_program(argc, argv);
    } catch (const std::exception& error) {
        weft::cli::print_errors({{"", error.what()}});
    }
    return weft::cli::exit_failed;
}
