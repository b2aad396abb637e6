// Error against time: sheets under many settings, so that a method can be judged by what it leaves at equal cost.
#pragma once

#include "cli/bench/bench_measure.h"

#include <filesystem>
#include <string>
#include <vector>

namespace weft::bench {

struct CurveSettings {
    std::vector<std::uint32_t> sides;
    double most_seconds = 30;  ///< what a point may take
    cli::BenchSettings bench;
};

/// One point of a curve.
struct CurvePoint {
    std::string mesh;        ///< "64²", "irregular 64²": points of one mesh are compared
    std::string method;      ///< points of one method make a curve
    std::uint32_t substeps;  ///< along it
    cli::SceneFigures figures;
};

struct Curves {
    std::vector<CurvePoint> points;
    std::vector<std::string> left_out;  ///< which, and why
    bool interrupted = false;           ///< these are the points that were measured before
};

/// One of each mesh, to see whether settings are valid.
std::vector<cli::BenchSubject> curve_meshes(const std::vector<std::uint32_t>& sides);

/// A sheet of cotton, 1 m by 1 m, hung by two corners, for each side; of the smaller ones an irregular twin too: its
/// vertices moved by up to a quarter of a cell, its diagonals by chance. Every method, with more and more substeps
/// until it can no longer be the best, or takes too long. SIGINT and SIGTERM end it early.
Result<Curves> measure_curves(const CurveSettings& settings);

/// Mesh by mesh, method by method. `*` marks what no other point of the mesh beats in both time and stretch.
std::string curves_table(const Curves& curves);

/// A picture of it: stretch over time a frame, both logarithmic, one panel per mesh.
Result<Done> write_curves(const std::vector<CurvePoint>& points, const std::filesystem::path& svg);

}  // namespace weft::bench
