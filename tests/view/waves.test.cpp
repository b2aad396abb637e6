// Normals and tangents of a waved sheet, compared with those of the exact wave.

#include "../physics/sheet.h"

#include <algorithm>
#include <cmath>

namespace weft::physical {
namespace {

constexpr float height = 0.05f, k = 9;  // m, 1/m

/// Largest errors of normals and tangents away from the borders, in radians for small angles.
struct Off {
    float normal = 0, tangent = 0;
};

Off waved(std::uint32_t side, GridDiagonal diagonal) {
    World world = make_world({}, SheetDesc{.resolution = {side, side}, .diagonal = diagonal});
    Snapshot state = world.save();
    for (Vec4& p : state.cloths[0].position) p.y = height * std::sin(k * p.x) * std::cos(k * p.z);
    EXPECT_TRUE(world.restore(state).ok());
    const ClothFrame& cloth = world.frame().cloths[0];
    const auto& positions = cloth.render_mesh().positions;
    const auto& normals = cloth.render_mesh().normals;
    const std::span<const Vec4> tangents = cloth.tangents();
    Off off;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const Vec3 p = positions[v];
        EXPECT_NEAR(p.y, height * std::sin(k * p.x) * std::cos(k * p.z), 1e-6f);
        if (std::max(std::abs(p.x), std::abs(p.z)) > 0.4f) continue;
        const float slope_x = height * k * std::cos(k * p.x) * std::cos(k * p.z),
                    slope_z = -height * k * std::sin(k * p.x) * std::sin(k * p.z);
        const Vec3 normal = normalized(Vec3{-slope_x, 1, -slope_z}), along = normalized(Vec3{1, slope_x, 0});
        off.normal = std::max(off.normal, length(normals[v] - normal));
        off.tangent = std::max(off.tangent, length(tangents[v].xyz() - along));
        EXPECT_NEAR(length(normals[v]), 1, 1e-5f);
        EXPECT_NEAR(length(tangents[v].xyz()), 1, 1e-5f);
        EXPECT_NEAR(dot(normals[v], tangents[v].xyz()), 0, 1e-5f);
        EXPECT_EQ(tangents[v].w, 1) << "v grows toward -z, along normal × tangent";
    }
    return off;
}

// The error is of second order in the edge length.
TEST(Waves, have_the_normals_and_tangents_of_the_wave) {
    for (const GridDiagonal diagonal : {GridDiagonal::alternating, GridDiagonal::uniform, GridDiagonal::cross}) {
        const Off coarse = waved(21, diagonal), fine = waved(41, diagonal), finer = waved(81, diagonal);
        EXPECT_LT(coarse.normal, 0.08f);
        EXPECT_LT(finer.normal, 0.006f);
        EXPECT_LT(finer.tangent, 0.006f);
        EXPECT_NEAR(coarse.normal / fine.normal, 4, 0.8f);
        EXPECT_NEAR(fine.normal / finer.normal, 4, 0.8f);
        EXPECT_NEAR(coarse.tangent / fine.tangent, 4, 0.8f);
        EXPECT_NEAR(fine.tangent / finer.tangent, 4, 0.8f);
    }
}

}  // namespace
}  // namespace weft::physical
