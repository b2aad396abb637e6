// Error against time: sheets under many settings, to compare the methods at equal cost.
#pragma once

#include "cli/bench/bench_measure.h"

#include <filesystem>
#include <string>
#include <vector>

namespace weft::bench {

struct CurveSettings {
    std::vector<std::uint32_t> sides;
    double most_seconds = 30;  ///< limit for one point
    cli::BenchSettings bench;
};

/// One point of a curve.
struct CurvePoint {
    std::string mesh;        ///< "64²", "irregular 64²": points of one mesh are compared
    std::string method;      ///< points of one method form a curve
    std::uint32_t substeps;  ///< parameter along the curve
    cli::SceneFigures figures;
};

struct Curves {
    std::vector<CurvePoint> points;
    std::vector<std::string> left_out;  ///< skipped points with the reason
    bool interrupted = false;           ///< by a signal: only the earlier points were measured
};

/// One scene per mesh, to check whether settings are valid.
std::vector<cli::BenchSubject> curve_meshes(const std::vector<std::uint32_t>& sides);

/// Measures a sheet of cotton, 1 m by 1 m, hung by two corners, for each side. Smaller sides also get an irregular
/// variant: vertices moved by up to a quarter of a cell, random diagonals. Runs every method with increasing substeps
/// until it cannot be the best any more or takes too long. SIGINT and SIGTERM end it early.
Result<Curves> measure_curves(const CurveSettings& settings);

/// A table by mesh and method. `*` marks points that no other point of the mesh beats in both time and stretch.
std::string curves_table(const Curves& curves);

/// Draws a plot: stretch over time per frame, both logarithmic, one panel per mesh.
Result<void> write_curves(const std::vector<CurvePoint>& points, const std::filesystem::path& svg);

}  // namespace weft::bench
