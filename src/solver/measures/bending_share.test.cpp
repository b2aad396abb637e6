#include "solver/measures/bending_share.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <vector>

namespace weft {
namespace {

double share_of(BendModel bend, float stiffness, std::uint32_t cells, double substep) {
    Fabric fabric;
    fabric.bend = {.bend = {stiffness, stiffness, stiffness}, .model = bend};
    TriangleMesh mesh = make_grid({1, 1}, {cells + 1, cells + 1}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    std::vector<Vec4> positions;
    for (const Vec3 p : mesh.positions) positions.push_back({p.x, p.y, p.z, 0});
    auto model = build_cloth_model({.name = "sheet", .mesh = std::move(mesh), .fabric = fabric}, std::move(*topology));
    EXPECT_TRUE(model.ok());
    for (std::size_t p = 0; p < positions.size(); ++p) positions[p].w = 1 / (*model)->mass[p];
    return bending_share(**model, positions, substep);
}

TEST(BendingShare, is_all_on_coarse_meshes_and_in_short_substeps) {
    for (const BendModel bend : {BendModel::dihedral, BendModel::moment}) {
        EXPECT_EQ(share_of(bend, 1e-5f, 20, 1e-3), 1);
        EXPECT_EQ(share_of(bend, 1e-3f, 80, 1e-5), 1);
    }
    EXPECT_EQ(share_of(BendModel::plate, 1e-3f, 80, 1e-3), 1) << "not counted";
}

// Where it is small it is the compliance over 0.3 of the weight, times the square of the substep.
TEST(BendingShare, falls_with_the_square_of_the_substep_and_with_stiffness) {
    for (const BendModel bend : {BendModel::dihedral, BendModel::moment}) {
        const double little = share_of(bend, 1e-1f, 80, 1e-3);
        EXPECT_LT(little, 0.05);
        EXPECT_NEAR(little / share_of(bend, 1e-1f, 80, 2e-3), 4, 0.3);
        EXPECT_NEAR(little / share_of(bend, 2e-1f, 80, 1e-3), 2, 0.15);
        EXPECT_GT(little / share_of(bend, 1e-1f, 160, 1e-3), 10) << "16 times the weight";
    }
}

}  // namespace
}  // namespace weft
