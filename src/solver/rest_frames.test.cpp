#include "solver/rest_frames.h"

#include "base/transform.h"
#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

TEST(RestFrames, of_a_flat_sheet_are_all_alike) {
    TriangleMesh mesh = make_grid({1, 1}, {5, 4}, GridDiagonal::alternating);
    const Mat3 turn = rotation_from_degrees({20, 30, 40});
    for (Vec3& p : mesh.positions) p = turn * p;
    const Topology topology = *build_topology(mesh);
    for (const RestFrame& frame : rest_frames(make_rest_shape(mesh, topology))) {
        EXPECT_NEAR(std::abs(dot(frame.normal, turn * Vec3{0, 1, 0})), 1, 1e-5);
        EXPECT_NEAR(dot(frame.warp, turn * Vec3{1, 0, 0}), 1, 1e-5);
    }
}

TEST(StraightLine, reaches_as_far_as_shear_lets_it) {
    const RestFrame frame{{0, 1, 0}, {1, 0, 0}};
    const auto measure = [&](Vec3 between) { return straight_line(frame, frame, between); };
    EXPECT_NEAR(measure({0.3f, 0, 0}).reach, 0.3, 1e-3) << "along the warp";
    EXPECT_NEAR(measure({0, 0, -0.2f}).reach, 0.2, 1e-3) << "along the weft";
    EXPECT_NEAR(measure({0.3f, 0, 0.4f}).reach, 0.7, 2e-3) << "two sides of a rectangle";
    EXPECT_NEAR(measure({0.3f, 0, 0.4f}).length, 0.5, 2e-3);
    EXPECT_GE(measure({0.3f, 0, 0.4f}).length, 0.5);
}

TEST(StraightLine, is_none_where_cloth_bends_or_its_warp_turns) {
    const RestFrame frame{{0, 1, 0}, {1, 0, 0}};
    const auto tilted = [](float degrees) {
        const Mat3 turn = rotation_from_degrees({0, 0, degrees});
        return RestFrame{turn * Vec3{0, 1, 0}, turn * Vec3{1, 0, 0}};
    };
    EXPECT_GT(straight_line(frame, tilted(3), {1, 0, 0}).length, 0);
    EXPECT_EQ(straight_line(frame, tilted(20), {1, 0, 0}).length, 0);
    EXPECT_EQ(straight_line(frame, frame, {1, 0.2f, 0}).length, 0) << "a step up";
    EXPECT_EQ(straight_line(frame, {{0, 1, 0}, {0, 0, 1}}, {1, 0, 0}).length, 0) << "another warp";
    EXPECT_EQ(straight_line({}, {}, {1, 0, 0}).length, 0) << "no triangles";
    EXPECT_EQ(straight_line(frame, frame, {}).length, 0) << "one place";
}

}  // namespace
}  // namespace weft
