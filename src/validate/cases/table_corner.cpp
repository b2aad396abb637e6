// A square sheet lies on the corner of a table and hangs over both sides, so that it bends in two directions. Unlike a
// sheet that hangs on all sides, it has one shape: the corner that hangs free is drawn out, and there are no folds.
#include "validate/sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

using namespace cases;
namespace {

constexpr double density = 0.2, gamma = 10;  // rho_A g L³/B with the overhang L = 1 m
constexpr float lying = 0.5f, hanging = 1;   // m, of the sheet's side

struct Mesh {
    const char* name;
    GridDiagonal diagonal;
};

// Places of the vertices that meshes with `shared` cells along the overhang have.
std::vector<Vec4> shape(const Validation& validation, const Mesh& mesh, std::uint32_t cells, std::uint32_t shared) {
    const auto b = static_cast<float>(density * standard_gravity / gamma);
    Fabric fabric = elastic_fabric(density * standard_gravity / 1e-3, density);
    fabric.stretch.shear = 0.2f * fabric.stretch.stretch[0];
    fabric.stretch.model = StretchModel::membrane;  // edges resist shear differently on each mesh
    fabric.bend = {.bend = {b, b, b}};
    WorldSettings settings{.solver = {.substeps = 10, .iterations = 3 * cells}};
    settings.solver.hierarchy = false;
    World world = validation.make_world(settings);
    const std::uint32_t side = cells + cells / 2 + 1;
    const float size = lying + hanging, table = lying - size / 2 + 0.1f / static_cast<float>(cells);
    add_sheet(world, {.mesh = make_grid({size, size}, {side, side}, mesh.diagonal),
                      .fabric = fabric,
                      .pinned = [=](Vec3 p) { return p.x < table && p.z < table; }});
    settle(world, 6, 0.01);
    const std::vector<Vec4> all = places(world);
    std::vector<Vec4> kept;
    for (std::uint32_t z = 0; z < side; z += cells / shared)
        for (std::uint32_t x = 0; x < side; x += cells / shared) kept.push_back(all[z * side + x]);
    return kept;
}

}  // namespace

void validate_table_corner(Validation& validation) {
    constexpr Mesh meshes[] = {{"alternating", GridDiagonal::alternating}, {"uniform", GridDiagonal::uniform}};
    const std::uint32_t finest = validation.quick() ? 8 : 16, shared = finest / 4;
    std::vector<Vec4> finest_of_first;
    for (const Mesh& mesh : meshes) {
        if (validation.quick() && mesh.diagonal != GridDiagonal::alternating) continue;
        const auto converged = shape(validation, mesh, finest, shared);
        const auto distance = [&](std::uint32_t cells) {
            return rms_distance(shape(validation, mesh, cells, shared), converged);
        };
        const double coarse = distance(finest / 4), middle = distance(finest / 2);
        const std::string from = std::string(mesh.name) + ", distance (RMS) from " + std::to_string(finest) + " cells";
        const auto add = [&](std::string what, std::string unit, double measured, double expected, Bound bound) {
            validation.add({.what = std::move(what),
                            .unit = std::move(unit),
                            .measured = measured,
                            .expected = expected,
                            .bound = bound,
                            .settings = {{"mesh", mesh.name}, {"cells", finest}}});
        };
        add(from + ", " + std::to_string(finest / 2) + " cells", "m", middle, 0.32 / finest, Bound::at_most);
        add(from + ", a quarter of them over half of them", "", coarse / middle, 2, Bound::at_least);
        if (finest_of_first.empty())
            finest_of_first = converged;
        else
            add(std::string(mesh.name) + ", distance (RMS) from " + meshes[0].name, "m",
                rms_distance(converged, finest_of_first), 0.01, Bound::at_most);
    }
}

}  // namespace weft
