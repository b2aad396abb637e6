// The stiffness of a sheet in its plane, measured as in a picture frame: springs along its border pull it into a frame
// that is longer or sheared. Their forces give the mean stress, and the border's motion the mean strain.
#include "validate/sheets.h"
#include "validate/weaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace weft {

using namespace cases;
namespace {

constexpr double cell = 1.0 / 8;  // m

// In the order xx, zz, shear: stresses in N/m, strains.
using InPlane = std::array<double, 3>;

// Shear is larger, because rounding of positions stretches threads: 4000 N/m times 2e-7 are felt beside 10 N/m.
constexpr InPlane frame_strains = {2e-3, 2e-3, 1e-2};

struct Framed {
    InPlane stress{}, strain{};
};

// A square of 1 m in a frame of this strain. `stiffness`, N/m, of the sheet against it: that of the springs is similar.
Framed put_in_frame(const Validation& validation, const Fabric& fabric, const TriangleMesh& mesh, const InPlane& strain,
                    double stiffness) {
    WorldSettings settings{.gravity = {}, .solver = {.substeps = 10, .iterations = 30}};
    settings.solver.hierarchy = false;
    World world = validation.make_world(settings);
    SheetOf sheet{.mesh = mesh, .fabric = fabric};
    const double compliance = 2 / stiffness;
    const std::vector<Vec3>& rest = mesh.positions;
    for (std::uint32_t p = 0; p < rest.size(); ++p) {
        if (std::max(std::abs(rest[p].x), std::abs(rest[p].z)) < 0.499f) continue;
        const double x = rest[p].x, z = rest[p].z, shear = 0.5 * strain[2];
        const Vec3 to{static_cast<float>((1 + strain[0]) * x + shear * z), 0,
                      static_cast<float>(shear * x + (1 + strain[1]) * z)};
        sheet.springs.push_back({p, static_cast<float>(compliance), to});
    }
    const auto springs = sheet.springs;
    const double stiffest = std::max(fabric.stretch.stretch[0], fabric.stretch.stretch[1]);
    add_sheet(world, std::move(sheet));
    // In shorter substeps particles would move by less than a float can represent.
    const double frame = 10 * std::sqrt(double{fabric.body.density} * cell * cell / stiffest);
    settle(world, 300 * frame, frame, 0);
    Framed framed;
    for (const Attachment& spring : springs) {
        const auto x = position(world, spring.particle);
        const Vec3 from = rest[spring.particle];
        const double rx = from.x, rz = from.z, moved_x = x[0] - rx, moved_z = x[2] - rz,
                     force_x = (double{spring.place.x} - x[0]) / compliance,
                     force_z = (double{spring.place.z} - x[2]) / compliance;
        framed.stress[0] += force_x * rx, framed.stress[1] += force_z * rz;
        framed.stress[2] += 0.5 * (force_x * rz + force_z * rx);
        // The mean strain is the integral of motion times normal along the border.
        const double share_x = std::abs(rx) < 0.499 ? 0 : std::copysign(std::abs(rz) < 0.499 ? cell : cell / 2, rx),
                     share_z = std::abs(rz) < 0.499 ? 0 : std::copysign(std::abs(rx) < 0.499 ? cell : cell / 2, rz);
        framed.strain[0] += share_x * moved_x, framed.strain[1] += share_z * moved_z;
        framed.strain[2] += share_x * moved_z + share_z * moved_x;
    }
    return framed;
}

// C of stress = C strain, N/m, from three frames.
std::array<InPlane, 3> stiffness_in_frames(const Validation& validation, const Fabric& fabric, const TriangleMesh& mesh,
                                           const InPlane& expected) {
    std::array<Framed, 3> frames;
    for (std::size_t k = 0; k < 3; ++k) {
        InPlane strain{};
        strain[k] = frame_strains[k];
        frames[k] = put_in_frame(validation, fabric, mesh, strain, expected[k]);
    }
    const auto strain = [&](std::size_t i, std::size_t k) { return frames[k].strain[i]; };
    std::array<InPlane, 3> inverse{};  // of the matrix of strains, whose columns are frames
    double determinant = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            inverse[k][i] = strain(i1, k1) * strain(i2, k2) - strain(i1, k2) * strain(i2, k1);
        }
    }
    for (std::size_t k = 0; k < 3; ++k) determinant += strain(0, k) * inverse[k][0];
    std::array<InPlane, 3> stiffness{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) stiffness[i][j] += frames[k].stress[i] * inverse[k][j] / determinant;
    return stiffness;
}

}  // namespace

// Uniaxial: the other direction is free to contract. Along the bias, between sides that do not contract: free to shear.
void validate_picture_frame(Validation& validation) {
    for (const FabricPreset& preset : fabric_presets()) {
        if (validation.quick() && preset.name != "cotton") continue;
        for (const auto& [model, name, kind] : {std::tuple{StretchModel::membrane, "membrane", PullMesh::irregular},
                                                {StretchModel::edges, "edges", PullMesh::alternating}}) {
            if (validation.quick() && model == StretchModel::edges) continue;
            Fabric fabric = preset.fabric;
            fabric.stretch.model = model;
            fabric.bend = {.bend = {0, 0, 0}};
            fabric.body.damping = 0;
            const double warp = fabric.stretch.stretch[0], weft = fabric.stretch.stretch[1],
                         shear = fabric.stretch.shear;
            TriangleMesh mesh = pulled_mesh(kind, 8, 8);
            turn_warp(mesh, 0);
            const auto straight = stiffness_in_frames(validation, fabric, mesh, {warp, weft, shear});
            const auto add = [&, model = model, name = name, kind = kind](const char* direction, double measured,
                                                                          double expected) {
                validation.add_near(std::string("stiffness ") + direction + ", " + name + ", " +
                                        std::string(preset.name) + ", " + name_of(kind),
                                    measured, expected, 0.02, "N/m", model == StretchModel::edges ? 0.1 : 0,
                                    {{"fabric", std::string(preset.name)},
                                     {"model", name},
                                     {"mesh", name_of(kind)},
                                     {"direction", direction}});
            };
            const auto free_of = [](const std::array<InPlane, 3>& c, std::size_t along, std::size_t other) {
                return c[along][along] - c[along][other] * c[other][along] / c[other][other];
            };
            add("along the warp", free_of(straight, 0, 1), warp);
            add("along the weft", free_of(straight, 1, 0), weft);
            add("in shear", straight[2][2], shear);
            if (model != StretchModel::membrane) continue;  // edges promise nothing along the bias
            turn_warp(mesh, 45);
            const double mean = (warp + weft) / 4;
            const auto turned = stiffness_in_frames(validation, fabric, mesh, {mean, mean, mean});
            add("along the bias", free_of(turned, 0, 2), along_bias(warp, weft, shear));
        }
    }
}

}  // namespace weft
