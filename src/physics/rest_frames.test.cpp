#include "physics/rest_frames.h"

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

TEST(StraightLine, goes_so_far_along_warp_and_weft) {
    const RestFrame frame{{0, 1, 0}, {1, 0, 0}};
    const StraightLine line = straight_line(frame, frame, {0.3f, 0, -0.4f});
    EXPECT_NEAR(line.length, 0.5, 2e-3);
    EXPECT_GE(line.length, 0.5) << "room for an arc";
    EXPECT_NEAR(line.along_warp, 0.3, 1e-3);
    EXPECT_NEAR(line.along_weft, 0.4, 1e-3);
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
