// Error against time: sheets under many settings, so that a method can be judged by what it leaves at equal cost.
#pragma once

#include "cli/bench_measure.h"

#include <filesystem>
#include <string>
#include <vector>

namespace weft::cli {

/// One point of a curve, before it is measured.
struct CurveSubject {
    std::string mesh;        ///< "64²", "irregular 64²": points of one mesh are compared
    std::string method;      ///< points of one method make a curve
    std::uint32_t substeps;  ///< along it
    BenchSubject subject;
};

/// A sheet of cotton, 1 m by 1 m, hung by two corners, for each side; of the smaller ones an irregular twin too: its
/// vertices moved by up to a quarter of a cell, its diagonals by chance.
std::vector<CurveSubject> curve_subjects(const std::vector<std::uint32_t>& sides);

/// What was measured of `subjects`, in that order: mesh by mesh, method by method. `*` marks what no other point of the
/// mesh beats in both time and stretch.
std::string curves_table(const std::vector<CurveSubject>& subjects, const std::vector<SceneFigures>& figures);

/// A picture of it: stretch over time a frame, both logarithmic, one panel per mesh.
Result<Done> write_curves(const std::vector<CurveSubject>& subjects, const std::vector<SceneFigures>& figures,
                          const std::filesystem::path& svg);

}  // namespace weft::cli
