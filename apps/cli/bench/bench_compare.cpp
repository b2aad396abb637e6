#include "cli/bench/bench_report.h"
#include "cli/shell/table.h"

#include <algorithm>

namespace weft::cli {
namespace {

std::string ratio(double now, double before) {
    return before > 0 ? fixed(now / before, 3) : "-";
}

const SceneFigures* find_scene(const BenchReport& report, const std::string& name) {
    const auto found = std::ranges::find(report.scenes, name, &SceneFigures::name);
    return found == report.scenes.end() ? nullptr : &*found;
}

/// Collects `threads 2 (before 1), substeps 10 (before 20)`.
class Differences {
  public:
    void check(const char* what, const std::string& now, const std::string& before) {
        if (now == before) return;
        text_ += (text_.empty() ? "" : ", ") + std::string(what) + ' ' + now + " (before " + before + ')';
    }
    void check(const char* what, std::uint64_t now, std::uint64_t before) {
        check(what, std::to_string(now), std::to_string(before));
    }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

/// Lines that begin with the scenes that they concern: `sheet 32, sheet 64: settings differ: …`.
class Notes {
  public:
    void add(const std::string& concerned, const std::string& what, const std::string& differences) {
        if (differences.empty()) return;
        const std::string text = what + ": " + differences;
        const auto same = std::ranges::find(lines_, text, &Line::text);
        if (same == lines_.end()) {
            lines_.push_back({concerned, text});
        } else {
            same->concerned += ", " + concerned;
        }
    }
    std::string text() const {
        std::string all;
        for (const Line& line : lines_) all += line.concerned + ": " + line.text + '\n';
        return all;
    }

  private:
    struct Line {
        std::string concerned, text;
    };
    std::vector<Line> lines_;
};

std::string program_differences(const BenchReport& now, const BenchReport& before) {
    Differences program;
    program.check("version", now.version, before.version);
    program.check("compiler", now.compiler, before.compiler);
    program.check("processor", now.processor, before.processor);
    program.check("hardware threads", now.hardware_threads, before.hardware_threads);
    return program.text();
}

std::string settings_differences(const SceneFigures& now, const SceneFigures& before) {
    Differences settings;
    settings.check("backend", now.backend, before.backend);
    settings.check("device", now.device, before.device);
    settings.check("instruction set", now.isa, before.isa);
    settings.check("threads", now.threads, before.threads);
    settings.check("solver", now.solver, before.solver);
    settings.check("substeps", now.substeps, before.substeps);
    settings.check("iterations", now.iterations, before.iterations);
    settings.check("frame rate", fixed(now.frame_rate, 3), fixed(before.frame_rate, 3));
    settings.check("frames", now.frames, before.frames);
    settings.check("warmup", now.warmup, before.warmup);
    settings.check("runs", now.runs, before.runs);
    settings.check("seconds of stretch", fixed(now.quality_seconds, 2), fixed(before.quality_seconds, 2));
    return settings.text();
}

std::string scene_differences(const SceneFigures& now, const SceneFigures& before) {
    // The order of the kinds does not matter.
    const auto rows = [](std::vector<ConstraintFigures> constraints) {
        std::ranges::sort(constraints, {}, &ConstraintFigures::name);
        std::string text;
        for (const ConstraintFigures& constraint : constraints)
            text += (text.empty() ? "" : " + ") + std::to_string(constraint.rows) + ' ' + constraint.name;
        return text;
    };
    Differences scene;
    scene.check("particles", now.particles, before.particles);
    scene.check("triangles", now.triangles, before.triangles);
    scene.check("rows", rows(now.constraints), rows(before.constraints));
    return scene.text();
}

std::string result_differences(const SceneFigures& now, const SceneFigures& before) {
    Differences result;
    result.check("state", now.state_hash, before.state_hash);
    return result.text();
}

std::vector<std::string> shared_constraints(const BenchReport& now, const BenchReport& before) {
    std::vector<std::string> names;
    for (const SceneFigures& scene : now.scenes) {
        const SceneFigures* other = find_scene(before, scene.name);
        if (!other) continue;
        for (const ConstraintFigures& constraint : scene.constraints) {
            if (std::ranges::find(other->constraints, constraint.name, &ConstraintFigures::name) ==
                    other->constraints.end() ||
                std::ranges::find(names, constraint.name) != names.end())
                continue;
            names.push_back(constraint.name);
        }
    }
    return names;
}

std::vector<std::string> line_of(const SceneFigures& now, const SceneFigures& before,
                                 const std::vector<std::string>& constraints) {
    std::vector<std::string> cells{now.name, fixed(now.ms.median, 3), fixed(before.ms.median, 3),
                                   ratio(now.ms.median, before.ms.median)};
    for (const SceneFigures* scene : {&now, &before}) {
        const auto over_reference = scene->ratio();
        cells.push_back(over_reference ? fixed(*over_reference, 2) : "-");
    }
    for (const std::string& name : constraints) {
        const auto a = std::ranges::find(now.constraints, name, &ConstraintFigures::name);
        const auto b = std::ranges::find(before.constraints, name, &ConstraintFigures::name);
        const bool both = a != now.constraints.end() && b != before.constraints.end();
        cells.push_back(both ? ratio(a->ns_per_row, b->ns_per_row) : "-");
    }
    cells.insert(cells.end(),
                 {ratio(now.stretch.mean, before.stretch.mean), spread_text(std::max(spread(now), spread(before)))});
    return cells;
}

/// Edges and hinges of the meshes in both reports; empty if there are none.
std::string edges_comparison(const BenchReport& now, const BenchReport& before) {
    Table table({"edges and hinges, now / before", "triangles", "CPU", "device with transfers", "device only"});
    bool any = false;
    for (const EdgeFigures& one : now.edges) {
        const auto former = std::ranges::find_if(before.edges, [&](const EdgeFigures& other) {
            return other.name == one.name && other.triangles == one.triangles;
        });
        if (former == before.edges.end()) continue;
        table.add({one.name, std::to_string(one.triangles), ratio(one.cpu_ms, former->cpu_ms),
                   ratio(one.wall_ms, former->wall_ms), ratio(one.device_ms, former->device_ms)});
        any = true;
    }
    return any ? table.text() : "";
}

}  // namespace

std::string comparison(const BenchReport& now, const BenchReport& before, const std::string& before_name) {
    const std::vector<std::string> constraints = shared_constraints(now, before);
    std::vector<std::string> heads{"ratios are now / before", "ms now",  "ms before", "ms",
                                   "x reference now",         "x before"};
    for (const std::string& name : constraints) heads.push_back(name + " ns/row");
    heads.insert(heads.end(), {"mean stretch", "runs differ by"});
    Table table(heads);
    Notes notes;
    bool any = false;
    notes.add("all", "the program or the machine differs", program_differences(now, before));
    for (const SceneFigures& scene : now.scenes) {
        if (const SceneFigures* former = find_scene(before, scene.name)) {
            table.add(line_of(scene, *former, constraints));
            notes.add(scene.name, "settings differ", settings_differences(scene, *former));
            notes.add(scene.name, "the scene differs", scene_differences(scene, *former));
            notes.add(scene.name, "the result differs", result_differences(scene, *former));
            any = true;
        } else {
            notes.add(scene.name, "nothing to compare with", "not in " + before_name);
        }
    }
    for (const SceneFigures& scene : before.scenes) {
        if (!find_scene(now, scene.name)) notes.add(scene.name, "not measured now", "in " + before_name + " only");
    }
    std::string differing = notes.text();
    if (differing.empty()) differing = "machine, program, settings, scenes and results are the same\n";
    return "compared with " + before_name + '\n' + (any ? table.text() : "") + edges_comparison(now, before) +
           differing;
}

}  // namespace weft::cli
