#include "validate/sheets.h"
#include "validate/weaves.h"

#include <cmath>
#include <string>
#include <utility>

namespace weft {

using namespace cases;
namespace {

enum class Pull { warp, weft, bias, shear };

struct Woven {
    const char* name;
    float warp, weft, shear;  // N/m
};

// A stiff fabric with little shear stiffness, a soft one with much, and one that differs along warp and weft.
constexpr Woven wovens[] = {{"cotton", 4000, 4000, 40}, {"rubber", 300, 300, 100}, {"denim", 411, 2028, 27}};

constexpr double most_strain = 4e-3;  // at the upper edge

// A sheet in a vertical plane that bears its own weight, and how far it gives way over what its stiffness allows: 1.
double give_of(const Validation& validation, const Woven& woven, StretchModel model, PullMesh kind, Pull pull) {
    const bool sheared = pull == Pull::shear;
    // Pulled: 8 cells high, so wide that the middle does not feel the sides. Sheared: 8 cells from the edge that is
    // held, and so high that it does not bend.
    TriangleMesh mesh = sheared ? pulled_mesh(kind, 8, 96) : pulled_mesh(kind, 32, 8);
    turn_warp(mesh, pull == Pull::warp ? 90 : pull == Pull::bias ? 45 : 0);
    const double stiffness = pull == Pull::warp   ? woven.warp
                             : pull == Pull::weft ? woven.weft
                             : pull == Pull::bias ? along_bias(woven.warp, woven.weft, woven.shear)
                                                  : woven.shear;
    const double density = most_strain * stiffness / standard_gravity;
    Fabric fabric = elastic_fabric(1, density);
    fabric.stretch = {.stretch = {woven.warp, woven.weft},
                      .compression = {woven.warp, woven.weft},
                      .shear = woven.shear,
                      .model = model};
    const std::vector<Vec3> rest = mesh.positions;
    World world = validation.make_world({.solver = {.substeps = 20, .iterations = 8}});
    add_sheet(world, {.mesh = std::move(mesh),
                      .fabric = fabric,
                      .place =
                          [](Vec3 p) {
                              return Vec3{p.x, -p.z, 0};
                          },
                      .pinned = [=](Vec3 p) { return (sheared ? p.x : p.z) < -0.499f; }});
    settle(world, 3, 1.0 / 240);
    double sum = 0, expected = 0;
    for (std::uint32_t p = 0; p < rest.size(); ++p) {
        const double across = sheared ? rest[p].z : rest[p].x, along = (sheared ? rest[p].x : rest[p].z) + 0.5;
        if (std::abs(across) > 0.3) continue;
        sum += -rest[p].z - position(world, p)[1];
        expected += density * standard_gravity * along * (1 - along / 2) / stiffness;
    }
    return sum / expected;
}

}  // namespace

void validate_fabric_pull(Validation& validation) {
    for (const Woven& woven : wovens) {
        for (const PullMesh mesh : {PullMesh::alternating, PullMesh::uniform, PullMesh::cross, PullMesh::irregular}) {
            for (const auto& [pull, direction] : {std::pair{Pull::warp, "along the warp"},
                                                  {Pull::weft, "along the weft"},
                                                  {Pull::bias, "along the bias"},
                                                  {Pull::shear, "in shear"}}) {
                if (validation.quick() && (&woven != wovens || mesh != PullMesh::irregular)) continue;
                // Along stiff threads the free ends of a sheared sheet are felt √(K/K_s) times as far as it is wide.
                if (pull == Pull::shear && woven.shear < woven.weft / 5) continue;
                const std::string what = std::string(woven.name) + ' ' + direction + ", " + name_of(mesh);
                validation.add_near("give over theory, membrane, " + what,
                                    give_of(validation, woven, StretchModel::membrane, mesh, pull), 1, 0.02, "", 0.05);
            }
        }
    }
    if (validation.quick()) return;
    for (const PullMesh mesh : {PullMesh::alternating, PullMesh::irregular}) {
        for (const auto& [pull, direction] :
             {std::pair{Pull::warp, "along the warp"}, {Pull::bias, "along the bias"}}) {
            validation.add_near(std::string("give over theory, edges, cotton ") + direction + ", " + name_of(mesh),
                                give_of(validation, wovens[0], StretchModel::edges, mesh, pull), 1, 0.02, "", 1.5);
        }
    }
}

}  // namespace weft
