// Grabs through the public interface.
#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr Vec3 middle_of_face{1.0f / 3, 1.0f / 3, 1.0f / 3};

Simulation grabbing_simulation(const Options& options = {}) {
    auto made = Simulation::create({}, options);
    EXPECT_TRUE(made.ok());
    return std::move(*made);
}

ClothDesc grid_of(std::uint32_t side) {
    return {.mesh = GridDesc{.size = {0.5f, 0.5f}, .resolution = {side, side}}};
}

template <class T>
std::string first_message(const Result<T>& result) {
    return result ? "" : result.errors().front().message();
}

float length_between(Vec3 a, Vec3 b) {
    return length(a - b);
}

TEST(Grabs, pull_move_and_let_go) {
    Simulation simulation = grabbing_simulation();
    const auto cloth = simulation.add(grid_of(9));
    ASSERT_TRUE(cloth.ok());
    const auto grab = simulation.grab(*cloth, {.triangle = 60, .weights = middle_of_face}, {0, 0.2f, 0});
    ASSERT_TRUE(grab.ok()) << first_message(grab);
    EXPECT_THAT(simulation.grabs(), ElementsAre(*grab));
    for (int i = 0; i < 120; ++i) simulation.step();
    EXPECT_LT(length_between(simulation.grab_position(*grab), {0, 0.2f, 0}), 1e-3f);
    EXPECT_GT(simulation.grab_force(*grab).y, 0.1f);
    ASSERT_TRUE(simulation.move_grab(*grab, {0.1f, 0.2f, 0}).ok());
    for (int i = 0; i < 60; ++i) simulation.step();
    EXPECT_LT(length_between(simulation.grab_position(*grab), {0.1f, 0.2f, 0}), 1e-3f);
    ASSERT_TRUE(simulation.release(*grab).ok());
    for (int i = 0; i < 60; ++i) simulation.step();
    EXPECT_LT(simulation.surface(*cloth).positions[40].y, -2.0f) << "it falls";
    EXPECT_THAT(simulation.grabs(), testing::IsEmpty());
    EXPECT_EQ(simulation.grab_force(*grab), Vec3{});
    EXPECT_EQ(simulation.grab_position(*grab), Vec3{});
}

TEST(Grabs, refuse_what_they_cannot_do) {
    Simulation simulation = grabbing_simulation();
    const auto cloth = simulation.add(grid_of(3));
    ASSERT_TRUE(cloth.ok());
    const float nan = std::nanf("");
    const auto refusal = [&](const MeshPoint& point, Vec3 to, const GrabDesc& spring) {
        return first_message(simulation.grab(*cloth, point, to, spring));
    };
    EXPECT_EQ(refusal({.triangle = 8}, {}, {}), "/triangle: must be a triangle of the mesh, 0 to 7, got 8");
    EXPECT_EQ(refusal({.weights = {0.5f, 0.2f, 0}}, {}, {}), "/weights: must have the sum 1, got 0.7");
    EXPECT_THAT(refusal({.weights = {1.5f, -0.5f, 0}}, {}, {}), HasSubstr("/weights"));
    EXPECT_THAT(refusal({.weights = {nan, 0, 1}}, {}, {}), HasSubstr("/weights"));
    EXPECT_THAT(refusal({}, {nan, 0, 0}, {}), HasSubstr("/to"));
    EXPECT_THAT(refusal({}, {0, 2e6f, 0}, {}), HasSubstr("/to"));
    EXPECT_EQ(refusal({}, {}, {.max_force = 0}), "/max_force: must be > 0 N, got 0");
    EXPECT_THAT(refusal({}, {}, {.max_force = 2e6f}), HasSubstr("/max_force"));
    EXPECT_THAT(refusal({}, {}, {.max_force = nan}), HasSubstr("/max_force"));
    EXPECT_THAT(refusal({}, {}, {.compliance = -1}), HasSubstr("/compliance"));
    EXPECT_THAT(refusal({}, {}, {.damping = 11}), HasSubstr("/damping"));
    EXPECT_THAT(first_message(simulation.grab({}, {}, {})), HasSubstr("cloth"));
    EXPECT_THAT(first_message(simulation.move_grab({}, {})), HasSubstr("grab"));
    EXPECT_THAT(first_message(simulation.release({})), HasSubstr("grab"));
    EXPECT_THAT(simulation.grabs(), testing::IsEmpty());

    const auto grab = simulation.grab(*cloth, {}, {});
    ASSERT_TRUE(grab.ok());
    EXPECT_THAT(first_message(simulation.move_grab(*grab, {nan, 0, 0})), HasSubstr("/to"));
    ASSERT_TRUE(simulation.remove(*cloth).ok());
    EXPECT_THAT(first_message(simulation.release(*grab)), HasSubstr("grab"));
}

// Triangles that are not simulated move the numbers of those after them.
TEST(Grabs, name_triangles_as_the_mesh_does) {
    TriangleMesh mesh{.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}, {2, 0, 0}},
                      .triangles = {{0, 1, 1}, {0, 1, 2}, {0, 2, 4}, {2, 1, 3}}};
    Simulation simulation = grabbing_simulation();
    const auto cloth = simulation.add({.mesh = mesh});
    ASSERT_TRUE(cloth.ok());
    EXPECT_EQ(first_message(simulation.grab(*cloth, {.triangle = 0}, {})), "/triangle: triangle 0 is not simulated");
    EXPECT_EQ(first_message(simulation.grab(*cloth, {.triangle = 2}, {})), "/triangle: triangle 2 is not simulated")
        << "it has no area";
    const auto one = simulation.grab(*cloth, {.triangle = 1, .weights = {0, 1, 0}}, {0, 0, 1}),
               two = simulation.grab(*cloth, {.triangle = 3, .weights = {0, 0, 1}}, {1, 0, 1});
    ASSERT_TRUE(one.ok() && two.ok());
    EXPECT_EQ(simulation.grab_position(*one), (Vec3{0, 0, 1}));
    EXPECT_EQ(simulation.grab_position(*two), (Vec3{1, 0, 1}));
}

TEST(Grabs, stay_through_changes_cuts_and_saved_states) {
    Simulation simulation = grabbing_simulation();
    ClothDesc desc = grid_of(17);
    desc.tearing = Tearing::cuts;
    const auto cloth = simulation.add(desc);
    ASSERT_TRUE(cloth.ok());
    const auto grab = simulation.grab(*cloth, {.triangle = 256, .weights = middle_of_face}, {0, 0, 0});
    ASSERT_TRUE(grab.ok());
    for (int i = 0; i < 10; ++i) simulation.step();
    const auto check = [&](const char* after) {
        for (int i = 0; i < 40; ++i) simulation.step();
        EXPECT_LT(length_between(simulation.grab_position(*grab), {0, 0, 0}), 1e-3f) << after;
        EXPECT_THAT(simulation.reports(), testing::IsEmpty()) << after;
    };
    ASSERT_TRUE(simulation.set_fabric(*cloth, FabricDesc("denim")).ok());
    check("set_fabric");
    ASSERT_TRUE(simulation.set_pins(*cloth, {{.select = VertexPins{{0}}}}).ok());
    check("set_pins");
    ASSERT_TRUE(simulation.set_solver({.substeps = 12, .projection = Projection::gauss_seidel}).ok());
    check("set_solver");
    ASSERT_TRUE(simulation.set_pins(*cloth, {}).ok());
    const auto cut =
        simulation.cut(*cloth, {.along = PathCut{{{-0.3f, 0, 0.03f}, {0.3f, 0, 0.03f}}}}, CutPositions::start);
    ASSERT_TRUE(cut.ok()) << first_message(cut);
    check("cut");
    const auto state = simulation.save_state();
    for (int i = 0; i < 5; ++i) simulation.step();
    const std::string hash = simulation.state_hash();
    ASSERT_TRUE(simulation.release(*grab).ok());
    ASSERT_TRUE(simulation.restore_state(state).ok());
    EXPECT_THAT(simulation.grabs(), ElementsAre(*grab));
    for (int i = 0; i < 5; ++i) simulation.step();
    EXPECT_EQ(simulation.state_hash(), hash);
}

TEST(Grabs, tear_cloth_and_end_with_their_triangle) {
    Simulation simulation = grabbing_simulation();
    ClothDesc desc = grid_of(17);
    desc.tearing = Tearing::erode;
    desc.fabric = FabricDesc("cotton").set("tear_ratio", 1.3);
    desc.pins = {{.select = BoxPins{{{-1, -1, -1}, {1, 1, -0.24f}}}}};
    const auto cloth = simulation.add(desc);
    ASSERT_TRUE(cloth.ok()) << first_message(cloth);
    const auto grab =
        simulation.grab(*cloth, {.triangle = 256, .weights = middle_of_face}, {0, -2, 0}, {.max_force = 100});
    ASSERT_TRUE(grab.ok()) << first_message(grab);
    int frames = 0;
    while (!simulation.grabs().empty() && ++frames < 60) simulation.step();
    EXPECT_LT(frames, 60);
    EXPECT_THAT(first_message(simulation.move_grab(*grab, {})), HasSubstr("grab"));
    EXPECT_THAT(first_message(simulation.grab(*cloth, {.triangle = 256}, {})), HasSubstr("has been removed"));
    for (int i = 0; i < 30; ++i) simulation.step();
    EXPECT_THAT(simulation.reports(), testing::IsEmpty());
}

}  // namespace
}  // namespace weft
