#include "cli/bench/bench_report.h"

#include "cli/bench/bench_reference.h"
#include "cli/shell/table.h"

#include <weft/weft.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace weft::cli {
namespace {

// The name that Linux reports; empty on other systems.
std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != line.npos) return line.substr(colon + 2);
    }
    return {};
}

std::string compiler_name() {
#if defined(__clang__)
    return __VERSION__;  // includes the name "Clang"
#elif defined(__GNUC__)
    return "GCC " __VERSION__;
#else
    return {};
#endif
}

std::string steps_text(const SceneFigures& scene) {
    return std::to_string(scene.substeps) + " x " + std::to_string(scene.iterations);
}

const ConstraintFigures* find_constraint(const SceneFigures& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.constraints, name, &ConstraintFigures::name);
    return found == scene.constraints.end() ? nullptr : &*found;
}

// Names of the constraints in any of the scenes, in the order of their first appearance.
std::vector<std::string> constraint_names(const BenchReport& report) {
    std::vector<std::string> names;
    for (const SceneFigures& scene : report.scenes) {
        for (const ConstraintFigures& constraint : scene.constraints) {
            if (std::ranges::find(names, constraint.name) == names.end()) names.push_back(constraint.name);
        }
    }
    return names;
}

std::string head_lines(const BenchReport& report) {
    std::string text = "weft " + report.version;
    if (!report.processor.empty()) text += " on " + report.processor;
    text += ", " + std::to_string(report.hardware_threads) + " hardware threads\n";
    std::string before;
    for (const SceneFigures& scene : report.scenes) {  // one line for consecutive scenes with the same setup
        const std::string line = scene.backend + " (" + scene.device + "), " + std::to_string(scene.threads) +
                                 (scene.threads == 1 ? " thread, " : " threads, ") + scene.solver + ", " +
                                 std::to_string(scene.runs) + (scene.runs == 1 ? " run of " : " runs of ") +
                                 std::to_string(scene.frames) + " frames after " + std::to_string(scene.warmup) + '\n';
        if (line != before) text += line;
        before = line;
    }
    const MemoryFigures& memory = report.memory;
    text += fixed(static_cast<double>(memory.bytes) / 1e6, 0) + " MB are copied at " +
            fixed(memory.bandwidth / 1e9, 1) + " GB/s, read and written, by " + std::to_string(memory.threads) +
            (memory.threads == 1 ? " thread\n" : " threads\n");
    return text;
}

std::string times_table(const BenchReport& report) {
    Table table({"ms per frame", "particles", "substeps", "median", "p95", "min", "max", "runs differ by", "load",
                 "first frame", "B/particle", "on the device"});
    for (const SceneFigures& scene : report.scenes) {
        table.add({scene.name, std::to_string(scene.particles), steps_text(scene), fixed(scene.ms.median, 3),
                   fixed(scene.ms.p95, 3), fixed(scene.ms.min, 3), fixed(scene.ms.max, 3), spread_text(spread(scene)),
                   fixed(scene.load_ms, 1), fixed(scene.first_frame_ms, 1),
                   scene.bytes_per_particle ? fixed(*scene.bytes_per_particle, 0) : "?",
                   scene.device_bytes_per_particle > 0 ? fixed(scene.device_bytes_per_particle, 0) : "-"});
    }
    return table.text();
}

std::string ratio_text(std::optional<double> ratio) {
    return ratio ? fixed(*ratio, 2) : "-";
}

std::string reference_table(const BenchReport& report) {
    Table table({"minimal memory traffic", "MB per frame", "working set, MB", "GB/s of copies", "reference ms",
                 "median ms", "ratio"});
    for (const SceneFigures& scene : report.scenes) {
        const ReferenceFigures& reference = scene.reference;
        table.add({scene.name, fixed(reference.bytes_per_frame / 1e6, 2), fixed(reference.working_set / 1e6, 2),
                   reference.ms > 0 ? fixed(reference.bandwidth / 1e9, 1) : "-",
                   reference.ms > 0 ? fixed(reference.ms, 3) : "-", fixed(scene.ms.median, 3),
                   ratio_text(scene.ratio())});
    }
    return table.text();
}

std::string build_table(const BenchReport& report) {
    std::vector<std::string> heads{"ms to build", "particles", "all"};
    for (std::uint32_t part = 0; part < build_part_count; ++part) heads.emplace_back(build_part_name(part));
    Table table(heads);
    for (const SceneFigures& scene : report.scenes) {
        std::vector<std::string> cells{scene.name, std::to_string(scene.particles), fixed(scene.build_ms, 1)};
        for (const PartFigures& part : scene.build) cells.push_back(fixed(part.ms, 1));
        table.add(std::move(cells));
    }
    return table.text();
}

std::string stages_table(const BenchReport& report) {
    std::vector<std::string> heads{"ms by stage"};
    std::vector<std::size_t> shown;
    for (std::size_t stage = 0; !report.scenes.empty() && stage < report.scenes[0].stages.size(); ++stage) {
        const auto takes_time = [&](const SceneFigures& scene) { return scene.stages[stage].ms > 0; };
        if (std::ranges::none_of(report.scenes, takes_time)) continue;
        heads.push_back(report.scenes[0].stages[stage].name);
        shown.push_back(stage);
    }
    Table table(heads);
    for (const SceneFigures& scene : report.scenes) {
        std::vector<std::string> cells{scene.name};
        for (const std::size_t stage : shown) cells.push_back(fixed(scene.stages[stage].ms, 3));
        table.add(std::move(cells));
    }
    return table.text();
}

std::string rows_table(const BenchReport& report) {
    const std::vector<std::string> names = constraint_names(report);
    std::vector<std::string> heads{"ns per constraint and iteration"};
    for (const std::string& name : names) heads.insert(heads.end(), {name, "reference", "ratio", "constraints"});
    Table table(heads);
    for (const SceneFigures& scene : report.scenes) {
        std::vector<std::string> cells{scene.name};
        for (const std::string& name : names) {
            const ConstraintFigures* found = find_constraint(scene, name);
            cells.push_back(found ? fixed(found->ns_per_row, 2) : "-");
            cells.push_back(found && found->ratio() ? fixed(found->reference_ns_per_row, 2) : "-");
            cells.push_back(found ? ratio_text(found->ratio()) : "-");
            cells.push_back(found ? std::to_string(found->rows) : "-");
        }
        table.add(std::move(cells));
    }
    return table.text();
}

std::string quality_table(const BenchReport& report) {
    Table table({"% over the last " + quality_window(report.scenes), "stretch", "max", "shear", "max", "residual",
                 "max", "state hash", "reports"});
    for (const SceneFigures& scene : report.scenes) {
        std::vector<std::string> cells{scene.name};
        for (const MeanMax* value : {&scene.stretch, &scene.shear, &scene.residual}) {
            cells.push_back(fixed(100 * value->mean, 3));
            cells.push_back(fixed(100 * value->max, 2));
        }
        std::string reports;
        for (const std::string& name : scene.reports) reports += (reports.empty() ? "" : ", ") + name;
        cells.insert(cells.end(), {scene.state_hash, reports.empty() ? "-" : reports});
        table.add(std::move(cells));
    }
    return table.text();
}

}  // namespace

std::string quality_window(const std::vector<SceneFigures>& scenes) {
    if (scenes.empty()) return "-";
    const auto [least, most] = std::ranges::minmax(scenes, {}, &SceneFigures::quality_seconds);
    const std::string to = fixed(most.quality_seconds, 2) + " s", from = fixed(least.quality_seconds, 2) + " s";
    return from == to ? to : from + " to " + to;
}

std::string spread_text(std::optional<double> spread) {
    return spread ? fixed(100 * *spread, 1) + " %" : "-";
}

MemoryFigures measure_memory(std::uint64_t threads) {
    const std::size_t bytes = beyond_caches();
    return {threads, bytes, copy_bandwidth(static_cast<unsigned>(threads), bytes)};
}

BenchReport empty_report() {
    return {version(), compiler_name(), processor_name(), std::thread::hardware_concurrency(), {}, {}, {}};
}

std::string tables(const BenchReport& report) {
    return head_lines(report) + '\n' + times_table(report) + '\n' + reference_table(report) + '\n' +
           build_table(report) + '\n' + stages_table(report) + '\n' + rows_table(report) + '\n' +
           quality_table(report) + (report.edges.empty() ? "" : '\n' + edges_table(report.edges));
}

}  // namespace weft::cli
