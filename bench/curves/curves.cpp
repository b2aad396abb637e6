#include "curves.h"

#include "cli/bench/bench_report.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress.h"
#include "cli/shell/table.h"
#include "mesh/procedural.h"
#include "weft/scene_world.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

namespace weft::bench {

using namespace cli;

namespace {

struct MethodSettings {
    const char* name;
    bool tethers, hierarchy;
    Projection projection;
};
// Methods that are expected to win come first: their stretch and times decide how far the others are followed.
constexpr MethodSettings methods[] = {
    {"lines, hierarchy", false, true, Projection::lines},
    {"lines, hierarchy, tethers", true, true, Projection::lines},
    {"lines", false, false, Projection::lines},
    {"gauss-seidel, hierarchy", false, true, Projection::gauss_seidel},
    {"gauss-seidel, tethers", true, false, Projection::gauss_seidel},
    {"gauss-seidel", false, false, Projection::gauss_seidel},
    {"jacobi", false, false, Projection::jacobi},
};
constexpr std::uint32_t substep_counts[] = {3, 5, 10, 20, 40};
constexpr std::uint32_t largest_irregular = 128;

// Numbered like a grid, so that the corners have the same numbers.
TriangleMesh irregular_sheet(std::uint32_t side) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::uniform);
    std::mt19937 random(side);
    const float quarter = 0.25f / static_cast<float>(side - 1);
    const auto shift = [&] { return quarter * (static_cast<float>(random() % 2001) / 1000 - 1); };
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const std::uint32_t ix = v % side, iz = v / side;
        const bool border = ix == 0 || iz == 0 || ix + 1 == side || iz + 1 == side;
        if (!border) mesh.positions[v] += {shift(), 0, shift()};
    }
    mesh.triangles.clear();
    for (std::uint32_t iz = 0; iz + 1 < side; ++iz) {
        for (std::uint32_t ix = 0; ix + 1 < side; ++ix) {
            const std::uint32_t a = iz * side + ix, b = a + 1, c = a + side, d = c + 1;
            if (random() % 2) {
                mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
            } else {
                mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
            }
        }
    }
    for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
        mesh.uvs[v] = {mesh.positions[v].x + 0.5f, mesh.positions[v].z + 0.5f};
    }
    return mesh;
}

SceneDesc hung_sheet(std::uint32_t side, bool irregular, const MethodSettings& method, std::uint32_t substeps) {
    SceneCloth sheet{.name = "sheet",
                     .mesh = irregular ? MeshDesc(irregular_sheet(side)) : GridDesc{.resolution = {side, side}},
                     .transform = {.rotation_degrees = {85, 0, 0}},  // tilted, so that it can leave its plane
                     .pins = {{.select = VertexPins{{0, side - 1}}}},
                     .tethers = method.tethers ? Tethers::on : Tethers::off};
    SceneDesc scene{.name = "hung sheet", .cloths = {std::move(sheet)}};
    scene.solver.substeps = substeps;
    scene.solver.projection = method.projection;
    scene.solver.hierarchy = method.hierarchy;
    return scene;
}

// --- Candidates

struct Candidate {
    std::uint32_t side;
    std::string mesh;
    const MethodSettings* method;
    std::uint32_t substeps;
    BenchSubject subject;
    std::uint64_t work;  ///< per frame, estimated; for the progress display
};

std::vector<Candidate> candidates(const std::vector<std::uint32_t>& sides) {
    std::vector<Candidate> all;
    for (const std::uint32_t side : sides) {
        for (const bool irregular : {false, true}) {
            if (irregular && side > largest_irregular) continue;
            const std::string mesh = (irregular ? "irregular " : "") + std::to_string(side) + "²";
            for (const MethodSettings& method : methods) {
                for (const std::uint32_t substeps : substep_counts) {
                    const auto open = [=, &method](const Options& options) {
                        return SceneWorld::create(hung_sheet(side, irregular, method, substeps), options);
                    };
                    const std::string name = mesh + ' ' + method.name + ' ' + std::to_string(substeps);
                    all.push_back({side, mesh, &method, substeps, {name, open}, std::uint64_t{side} * side * substeps});
                }
            }
        }
    }
    return all;
}

bool better(const SceneFigures& a, double ms, double stretch) {
    return a.ms.median < ms && a.stretch.mean < stretch;
}

// Lower bounds for the time and stretch of `next`, from the last result of its method with fewer substeps: time is
// nearly proportional to substeps, and stretch decreases at best with their square, or with their cube above 10 %
// stretch.
struct Hope {
    double ms, stretch;
};
Hope hope_of(const Candidate& next, const CurvePoint& last) {
    constexpr double surely = 0.8, held_together = 0.1;
    const double times = static_cast<double>(next.substeps) / last.substeps, stretch = last.figures.stretch.mean;
    return {surely * times * last.figures.ms.median, stretch / std::pow(times, stretch < held_together ? 2 : 3)};
}

double seconds_of(const Candidate& next, const CurvePoint& last) {
    const SceneFigures& f = last.figures;
    const auto frames = static_cast<double>(f.warmup + f.frames + f.runs * f.timed_frames);
    return frames * f.ms.median / 1e3 * next.substeps / last.substeps;
}

// Why the first of `next` and the following ones, of the same method with more substeps, can be skipped, given all
// measured points; empty if the first should be measured.
std::string why_not(std::span<const Candidate> next, const std::vector<CurvePoint>& points, double most_seconds) {
    const Candidate& first = next.front();
    if (points.empty() || points.back().mesh != first.mesh || points.back().method != first.method->name) return {};
    const CurvePoint& last = points.back();
    const double seconds = seconds_of(first, last);
    if (seconds > most_seconds) return "would take some " + fixed(seconds, 0) + " s, more than --point-seconds";
    std::string why;
    for (const Candidate& one : next) {
        if (one.mesh != first.mesh || one.method != first.method || seconds_of(one, last) > most_seconds) break;
        const Hope hope = hope_of(one, last);
        const auto beats = [&](const CurvePoint& point) {
            return point.mesh == one.mesh && better(point.figures, hope.ms, hope.stretch);
        };
        const auto found = std::ranges::find_if(points, beats);
        if (found == points.end()) return {};
        if (why.empty())
            why = "cannot be better than " + found->method + " with " + std::to_string(found->substeps) + " substeps";
    }
    return why;
}

}  // namespace

std::vector<BenchSubject> curve_meshes(const std::vector<std::uint32_t>& sides) {
    std::vector<BenchSubject> subjects;
    std::string mesh;
    for (Candidate& candidate : candidates(sides)) {
        if (candidate.mesh != mesh) subjects.push_back(std::move(candidate.subject));
        mesh = candidate.mesh;
    }
    return subjects;
}

Result<Curves> measure_curves(const CurveSettings& settings) {
    const std::vector<Candidate> all = candidates(settings.sides);
    std::uint64_t total = 0, done = 0;  // frames, weighted by the work of each
    const auto frames = frame_count(settings.bench.length, 1.0 / SceneDesc{}.frame_rate);
    if (!frames) return frames.errors();
    const std::uint64_t of_each =
        settings.bench.warmup + *frames + std::uint64_t{settings.bench.repeat} * frames_per_sample;
    for (const Candidate& one : all) total += one.work * of_each;
    Curves curves;
    Progress progress("curves", total, settings.bench.quiet, Progress::work);
    const EndOnSignal end_on_signal;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Candidate& next = all[i];
        if (std::string why = why_not(std::span(all).subspan(i), curves.points, settings.most_seconds); !why.empty()) {
            for (; i < all.size() && all[i].mesh == next.mesh && all[i].method == next.method; ++i)
                total -= all[i].work * of_each;
            --i;  // skips more substeps of the same method
            progress.set_total(total);
            curves.left_out.push_back(next.subject.name + " and more: " + why);
            continue;
        }
        progress.set_what(next.subject.name);
        const auto go_on = [&](std::uint64_t frame) {
            progress.update(done + frame * next.work);
            return !end_on_signal.asked();
        };
        auto figures = sample_scene(next.subject, settings.bench, go_on);
        if (!figures) return figures.errors();
        if (!*figures) {
            curves.interrupted = true;
            break;
        }
        curves.points.push_back({next.mesh, next.method->name, next.substeps, std::move(**figures)});
        done += next.work * of_each;
    }
    return curves;
}

std::string curves_table(const Curves& curves) {
    if (curves.points.empty()) return {};
    std::vector<SceneFigures> scenes;
    for (const CurvePoint& point : curves.points) scenes.push_back(point.figures);
    Table table({"error over the last " + quality_window(scenes), "substeps", "ms a frame", "reference ms", "ratio",
                 "stretch %", "max %", "residual %", ""});
    for (const CurvePoint& point : curves.points) {
        const SceneFigures& f = point.figures;
        const bool beaten = std::ranges::any_of(curves.points, [&](const CurvePoint& other) {
            return other.mesh == point.mesh && better(other.figures, f.ms.median, f.stretch.mean);
        });
        const auto ratio = f.ratio();
        table.add({point.mesh + ", " + point.method, std::to_string(point.substeps), fixed(f.ms.median, 3),
                   fixed(f.reference.ms, 3), ratio ? fixed(*ratio, 2) : "-", fixed(100 * f.stretch.mean, 3),
                   fixed(100 * f.stretch.max, 1), fixed(100 * f.residual.mean, 3), beaten ? "" : "*"});
    }
    std::string text = table.text();
    if (!curves.left_out.empty()) text += "\nnot measured\n";
    for (const std::string& line : curves.left_out) text += "  " + line + '\n';
    return text;
}

}  // namespace weft::bench
