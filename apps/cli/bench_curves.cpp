#include "cli/bench_curves.h"

#include "cli/bench_report.h"
#include "cli/table.h"
#include "io/atomic_file.h"
#include "mesh/procedural.h"
#include "weft/session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace weft::cli {
namespace {

struct MethodSettings {
    const char* name;
    bool tethers, hierarchy;
    Projection projection;
    const char* color;
};
constexpr MethodSettings methods[] = {
    {"gauss-seidel", false, false, Projection::gauss_seidel, "#d95f02"},
    {"gauss-seidel, tethers", true, false, Projection::gauss_seidel, "#7570b3"},
    {"gauss-seidel, hierarchy", false, true, Projection::gauss_seidel, "#1b9e77"},
    {"lines", false, false, Projection::lines, "#66a61e"},
    {"lines, hierarchy", false, true, Projection::lines, "#222222"},
    {"lines, hierarchy, tethers", true, true, Projection::lines, "#999999"},
    {"jacobi", false, false, Projection::jacobi, "#e7298a"},
};
constexpr std::uint32_t substep_counts[] = {3, 5, 10, 20, 40};
constexpr std::uint32_t largest_irregular = 128;

// Numbered like a grid, so that the corners are where they are there.
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
                     .transform = {.rotation_degrees = {85, 0, 0}},  // leaning, so that it may leave its plane
                     .pins = {{.select = VertexPins{{0, side - 1}}}},
                     .tethers = method.tethers};
    SceneDesc scene{.name = "hung sheet", .cloths = {std::move(sheet)}};
    scene.solver.substeps = substeps;
    scene.solver.projection = method.projection;
    scene.solver.hierarchy = method.hierarchy;
    return scene;
}

bool beaten(std::size_t i, const std::vector<CurveSubject>& subjects, const std::vector<SceneFigures>& figures) {
    for (std::size_t k = 0; k < figures.size(); ++k) {
        const bool better =
            figures[k].ms.median < figures[i].ms.median && figures[k].stretch.mean < figures[i].stretch.mean;
        if (subjects[k].mesh == subjects[i].mesh && better) return true;
    }
    return false;
}

// --- The picture

constexpr double panel_width = 420, panel_height = 320, margin = 60;

struct Axis {
    double low, high, from, to;  // decades; pixels
    double at(double value) const {
        const double t = (std::log10(std::max(value, 1e-12)) - low) / (high - low);
        return from + std::clamp(t, 0.0, 1.0) * (to - from);
    }
};

Axis axis_over(const std::vector<double>& values, double from, double to) {
    const auto [least, most] = std::ranges::minmax(values);
    const double low = std::floor(std::log10(std::max(least, 1e-9))),
                 high = std::ceil(std::log10(std::max(most, 1e-9)));
    return {low, std::max(high, low + 1), from, to};
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
    return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
           text + "</text>\n";
}

std::string panel(const std::string& mesh, const std::vector<CurveSubject>& subjects,
                  const std::vector<SceneFigures>& figures, double left) {
    std::vector<double> times, errors;
    std::map<std::string, std::vector<std::size_t>> curves;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (subjects[i].mesh != mesh) continue;
        times.push_back(figures[i].ms.median);
        errors.push_back(100 * figures[i].stretch.mean);
        curves[subjects[i].method].push_back(i);
    }
    const Axis x = axis_over(times, left + margin, left + panel_width - 10);
    const Axis y = axis_over(errors, panel_height - 50, 40);
    std::string svg = text_at((x.from + x.to) / 2, 22, "middle", mesh, " font-weight=\"bold\"");
    svg += text_at((x.from + x.to) / 2, panel_height - 12, "middle", "ms a frame");
    svg += text_at(left + 14, (y.from + y.to) / 2, "middle", "mean stretch, %",
                   " transform=\"rotate(-90 " + fixed(left + 14, 1) + ' ' + fixed((y.from + y.to) / 2, 1) + ")\"");
    const auto line = [&](double x1, double y1, double x2, double y2) {
        svg += "<line x1=\"" + fixed(x1, 1) + "\" y1=\"" + fixed(y1, 1) + "\" x2=\"" + fixed(x2, 1) + "\" y2=\"" +
               fixed(y2, 1) + "\" stroke=\"#ddd\"/>\n";
    };
    for (double d = x.low; d <= x.high; ++d) {
        const double value = std::pow(10, d);
        line(x.at(value), y.from, x.at(value), y.to);
        svg += text_at(x.at(value), y.from + 16, "middle", fixed(value, d < 0 ? static_cast<int>(-d) : 0));
    }
    for (double d = y.low; d <= y.high; ++d) {
        const double value = std::pow(10, d);
        line(x.from, y.at(value), x.to, y.at(value));
        svg += text_at(x.from - 5, y.at(value) + 4, "end", fixed(value, d < 0 ? static_cast<int>(-d) : 0));
    }
    for (const MethodSettings& method : methods) {
        std::string points;
        for (const std::size_t i : curves[method.name]) {
            const std::string px = fixed(x.at(figures[i].ms.median), 1),
                              py = fixed(y.at(100 * figures[i].stretch.mean), 1);
            points += px + ',' + py + ' ';
            svg += "<circle cx=\"" + px + "\" cy=\"" + py + "\" r=\"3\" fill=\"" + method.color + "\"><title>" +
                   method.name + ", " + std::to_string(subjects[i].substeps) + " substeps</title></circle>\n";
        }
        svg += "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + method.color +
               "\" stroke-width=\"1.5\"/>\n";
    }
    return svg;
}

std::vector<std::string> meshes_of(const std::vector<CurveSubject>& subjects) {
    std::vector<std::string> meshes;
    for (const CurveSubject& one : subjects) {
        if (std::ranges::find(meshes, one.mesh) == meshes.end()) meshes.push_back(one.mesh);
    }
    return meshes;
}

}  // namespace

std::vector<CurveSubject> curve_subjects(const std::vector<std::uint32_t>& sides) {
    std::vector<CurveSubject> subjects;
    for (const std::uint32_t side : sides) {
        for (const bool irregular : {false, true}) {
            if (irregular && side > largest_irregular) continue;
            const std::string mesh = (irregular ? "irregular " : "") + std::to_string(side) + "²";
            for (const MethodSettings& method : methods) {
                for (const std::uint32_t substeps : substep_counts) {
                    const auto open = [=](const Options& options) {
                        return Session::create(hung_sheet(side, irregular, method, substeps), options);
                    };
                    const std::string name = mesh + ' ' + method.name + ' ' + std::to_string(substeps);
                    subjects.push_back({mesh, method.name, substeps, {name, open}});
                }
            }
        }
    }
    return subjects;
}

std::string curves_table(const std::vector<CurveSubject>& subjects, const std::vector<SceneFigures>& figures) {
    Table table({"error over the last " + quality_window(figures), "substeps", "ms a frame", "stretch %", "max %",
                 "residual %", ""});
    for (std::size_t i = 0; i < figures.size(); ++i) {
        const SceneFigures& f = figures[i];
        table.add({subjects[i].mesh + ", " + subjects[i].method, std::to_string(f.substeps), fixed(f.ms.median, 3),
                   fixed(100 * f.stretch.mean, 3), fixed(100 * f.stretch.max, 1), fixed(100 * f.residual.mean, 3),
                   beaten(i, subjects, figures) ? "" : "*"});
    }
    return table.text();
}

Result<Done> write_curves(const std::vector<CurveSubject>& subjects, const std::vector<SceneFigures>& figures,
                          const std::filesystem::path& file) {
    const std::vector<std::string> meshes = meshes_of(subjects);
    const double width = panel_width * static_cast<double>(meshes.size());
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed(width, 0) + "\" height=\"" +
                      fixed(panel_height + 30, 0) + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        svg += panel(meshes[i], subjects, figures, panel_width * static_cast<double>(i));
    }
    double x = margin;
    for (const MethodSettings& method : methods) {
        svg += "<circle cx=\"" + fixed(x, 0) + "\" cy=\"" + fixed(panel_height + 11, 0) + "\" r=\"4\" fill=\"" +
               method.color + "\"/>\n" + text_at(x + 9, panel_height + 15, "start", method.name);
        x += 30 + 7.5 * static_cast<double>(std::string(method.name).size());
    }
    svg += "</svg>\n";
    auto out = AtomicFile::create(file);
    if (!out) return out.errors();
    if (auto written = out->write(svg); !written) return written;
    return out->commit();
}

}  // namespace weft::cli
