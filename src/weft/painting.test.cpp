// Factors on the values of a fabric, as a scene gives them.

#include "weft/scene_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t painted_side = 11;

SceneDesc painted_scene(std::vector<WeightDesc> weights) {
    SceneDesc scene;
    scene.cloths.emplace_back();
    scene.cloths[0].name = "sheet";
    scene.cloths[0].mesh = GridDesc{.size = {1, 1}, .resolution = {painted_side, painted_side}};
    scene.cloths[0].pins = {{.select = VertexPins{{0, 10}}}};
    scene.cloths[0].weights = std::move(weights);
    return scene;
}

SceneWorld open_painted(const SceneDesc& scene) {
    auto world = SceneWorld::create(scene, {.backend = "cpu"});
    EXPECT_TRUE(world.ok()) << world.errors()[0].message();
    return std::move(*world);
}

std::string problem_of_painted(const SceneDesc& scene) {
    const auto world = SceneWorld::create(scene, {.backend = "cpu"});
    return world ? "" : world.errors()[0].message();
}

const ClothModel& painted_model(const SceneWorld& world) {
    return *world.world().model(world.world().cloth_id(0));
}

double mass_of(const ClothModel& model) {
    double sum = 0;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) sum += double{model.mass[p]};
    return sum;
}

// The last description of a particle counts, for each value by itself.
TEST(SceneWeights, follow_boxes_vertices_and_groups) {
    SceneDesc scene =
        painted_scene({{.of = WeightOf::density, .factor = 3, .select = BoxPins{{{-1, -1, -1}, {1, 1, 1}}}},
                       {.of = WeightOf::bend, .factor = 5, .select = VertexPins{{7}}},
                       {.of = WeightOf::thickness, .factor = 6, .select = VertexPins{{9}}},
                       {.of = WeightOf::density, .factor = 2, .select = VertexPins{{4, 5}}, .factors = {0.5f, 4}}});
    const SceneWorld world = open_painted(scene);
    const ClothWeights& weights = *painted_model(world).weights;
    EXPECT_EQ(weights.density.of_particles[3], 3);
    EXPECT_EQ(weights.density.of_particles[4], 1);
    EXPECT_EQ(weights.density.of_particles[5], 8);
    EXPECT_EQ(weights.bend.of_particles[7], 5);
    EXPECT_EQ(weights.bend.of_particles[8], 1);
    EXPECT_EQ(painted_model(world).thickness_factors[9], 6);
    EXPECT_EQ(painted_model(world).thickness_factors[8], 1);
    EXPECT_TRUE(weights.stretch.empty());
    scene.cloths[0].weights = {{.of = WeightOf::density, .factor = 3, .select = BoxPins{{{-1, -1, -1}, {1, 1, 1}}}}};
    const double density = double{scene.cloths[0].fabric.body.density};
    EXPECT_NEAR(mass_of(painted_model(open_painted(scene))), 3 * density, 1e-5);
}

TEST(SceneWeights, that_cannot_be_are_errors_with_their_place) {
    EXPECT_THAT(problem_of_painted(painted_scene({{.select = BoxPins{{{7, 7, 7}, {8, 8, 8}}}}})),
                HasSubstr("/cloths/0/weights/0/box: no vertex"));
    EXPECT_THAT(
        problem_of_painted(painted_scene({{.factor = 1, .select = VertexPins{{0}}}, {.select = VertexPins{{5000}}}})),
        HasSubstr("/cloths/0/weights/1/vertices/0"));
    EXPECT_THAT(problem_of_painted(painted_scene({{.select = PaintedChannel{}}})),
                HasSubstr("/cloths/0/weights/0/channel: the mesh has no vertex colors"));
}

// Other weights act on the running cloth, which does not jump, and pins stay where they are.
TEST(SceneWeights, change_while_the_cloth_moves) {
    SceneDesc scene = painted_scene({});
    scene.cloths[0].pins.push_back({.select = VertexPins{{60}}, .compliance = 0.01f});
    SceneWorld world = open_painted(scene);
    for (int i = 0; i < 5; ++i) world.advance();
    const auto positions = [&] {
        const auto now = world.world().frame().cloths[0].positions;
        std::vector<Vec3> all;
        for (const Vec4& x : now) all.push_back(x.xyz());
        return all;
    };
    const std::vector<Vec3> before = positions();
    const float weight = world.world().frame().cloths[0].positions[5].w;
    SceneDesc next = world.scene();
    next.cloths[0].weights = {{.of = WeightOf::density, .factor = 4, .select = BoxPins{{{-1, -1, -1}, {1, 1, 1}}}},
                              {.of = WeightOf::stretch, .factor = 2, .select = VertexPins{{5}}}};
    ASSERT_TRUE(world.change_to(next));
    EXPECT_EQ(world.scene(), next);
    EXPECT_EQ(positions(), before);
    EXPECT_FLOAT_EQ(world.world().frame().cloths[0].positions[5].w, weight / 4);
    EXPECT_EQ(painted_model(world).weights->stretch.of_particles[5], 2);
    // The model is the one that the document describes, also with another fabric.
    next.cloths[0].fabric.body.density *= 2;
    ASSERT_TRUE(world.change_to(next));
    const SceneWorld fresh = open_painted(next);
    EXPECT_TRUE(std::ranges::equal(painted_model(world).mass, painted_model(fresh).mass));
    for (int i = 0; i < 5; ++i) world.advance();
    next.cloths[0].weights = {{.select = VertexPins{{5000}, "hem"}}};
    EXPECT_THAT(world.change_to(next).errors()[0].message(), HasSubstr("/cloths/0/weights/0/group: must be a vertex"));
    next.cloths[0].weights.clear();
    ASSERT_TRUE(world.change_to(next));
    EXPECT_TRUE(painted_model(world).weights->density.empty());
}

}  // namespace
}  // namespace weft
