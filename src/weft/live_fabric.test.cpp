// Changes of fabric while cloths move.

#include "scene/fabric.h"
#include "weft/scene_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace weft {
namespace {

constexpr std::uint32_t side = 33;  // large enough for coarse levels

SceneDesc hung_sheet() {
    SceneDesc scene;
    scene.solver.substeps = 4;
    SceneCloth cloth;
    cloth.name = "sheet";
    cloth.mesh = GridDesc{.size = {1, 1}, .resolution = {side, side}};
    cloth.transform.rotation_degrees = {85, 0, 0};
    cloth.pins = {{.select = VertexPins{{0, side - 1}}}};
    scene.cloths = {cloth};
    return scene;
}

SceneWorld open_world(const SceneDesc& scene, unsigned threads = 1) {
    auto world = SceneWorld::create(scene, {.backend = "cpu", .threads = threads});
    EXPECT_TRUE(world.ok()) << world.error().message();
    return std::move(*world);
}

void advance(SceneWorld& world, std::uint64_t frames) {
    for (std::uint64_t i = 0; i < frames; ++i) world.advance();
}

const ClothModel& model_of(const SceneWorld& world) {
    return *world.world().model(world.world().cloth_id(0));
}

Result<void> set_fabric(SceneWorld& world, const char* preset) {
    return world.set_fabric(world.world().cloth_id(0), find_fabric(preset)->fabric, preset);
}

bool rebuilding(const SceneWorld& world) {
    return world.world().is_rebuilding(world.world().cloth_id(0));
}

// Limits of tension are numbers of the fabric alone: no constraint changes, and nothing is built again.
TEST(LiveFabric, takes_other_limits_of_tension_as_it_is) {
    SceneWorld world = open_world(hung_sheet()), untouched = open_world(hung_sheet());
    advance(world, 3), advance(untouched, 3);
    Fabric fabric = find_fabric("cotton")->fabric;
    fabric.tear = {.strength = {50, 60}, .tear_energy = 7, .tear_ratio = 1.5f};
    ASSERT_TRUE(world.set_fabric(world.world().cloth_id(0), fabric, "cotton").ok());
    EXPECT_EQ(model_of(world).fabric.tear.strength[1], 60);
    EXPECT_FALSE(rebuilding(world));
    advance(world, 3), advance(untouched, 3);
    EXPECT_EQ(world.world().state_hash(), untouched.world().state_hash());
}

// Expects the model to equal one that is built from the document.
void expect_built_model(const SceneWorld& world) {
    const ClothModel& now = model_of(world);
    const SceneWorld anew = open_world(world.scene());
    const ClothModel& built = model_of(anew);
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind)
        EXPECT_EQ(now.constraints[kind].fields, built.constraints[kind].fields);
    EXPECT_EQ(now.mass, built.mass);
    ASSERT_EQ(now.hierarchy.size(), built.hierarchy.size());
    for (std::size_t i = 0; i < now.hierarchy.size(); ++i) {
        EXPECT_EQ(now.hierarchy[i].limits.fields, built.hierarchy[i].limits.fields);
        EXPECT_EQ(now.hierarchy[i].weight, built.hierarchy[i].weight);
    }
}

TEST(LiveFabric, acts_at_once_and_coarse_levels_follow) {
    SceneWorld world = open_world(hung_sheet());
    advance(world, 3);
    const auto levels = model_of(world).hierarchy;
    ASSERT_FALSE(levels.empty());
    const auto bend = model_of(world).table(ConstraintKind::moment).fields;
    ASSERT_TRUE(set_fabric(world, "denim").ok());
    EXPECT_EQ(world.scene().cloths[0].fabric_name, "denim");
    EXPECT_NE(model_of(world).table(ConstraintKind::moment).fields, bend);
    EXPECT_TRUE(model_of(world).hierarchy.shares(levels)) << "the background rebuild has not landed";
    EXPECT_TRUE(rebuilding(world));
    advance(world, frames_to_build(side * side) - 1);
    EXPECT_TRUE(rebuilding(world));
    advance(world, 1);
    EXPECT_FALSE(rebuilding(world));
    EXPECT_FALSE(model_of(world).hierarchy.shares(levels));
    expect_built_model(world);
}

TEST(LiveFabric, leads_to_the_same_bits_with_and_without_threads) {
    const auto run = [](unsigned threads) {
        SceneWorld world = open_world(hung_sheet(), threads);
        for (const char* preset : {"silk", "denim", "cotton"}) {
            advance(world, 4);
            EXPECT_TRUE(set_fabric(world, preset).ok());
        }
        advance(world, 10);
        EXPECT_FALSE(rebuilding(world));
        return world.world().state_hash();
    };
    EXPECT_EQ(run(1), run(3));
}

TEST(LiveFabric, builds_nothing_for_what_no_level_depends_on) {
    SceneWorld world = open_world(hung_sheet());
    Fabric fabric = world.scene().cloths[0].fabric;
    fabric.air.drag = 3;
    fabric.body.damping = 0;
    fabric.contact.friction[0] = 1;
    fabric.bend.bend[1] = 1e-4f;
    fabric.stretch.compression[0] = 100;
    ASSERT_TRUE(world.set_fabric(world.world().cloth_id(0), fabric, "cotton").ok());
    EXPECT_FALSE(rebuilding(world));
    expect_built_model(world);
}

TEST(LiveFabric, with_other_rows_is_built) {
    SceneWorld world = open_world(hung_sheet());
    advance(world, 3);
    Fabric fabric = find_fabric("silk")->fabric;
    fabric.bend.model = BendModel::distance;
    ASSERT_TRUE(world.set_fabric(world.world().cloth_id(0), fabric, "silk").ok());
    EXPECT_FALSE(rebuilding(world));
    expect_built_model(world);
    advance(world, 3);
    EXPECT_TRUE(world.world().summary().reports == report_none);
}

TEST(LiveFabric, and_pins_that_change_together_both_hold) {
    for (const bool fabric_first : {true, false}) {
        for (const bool coarse : {true, false}) {
            SceneDesc scene = hung_sheet();
            scene.solver.hierarchy = coarse;
            SceneWorld world = open_world(scene);
            advance(world, 2);
            const auto set_pins = [&] {
                ASSERT_TRUE(world.set_pins(world.world().cloth_id(0), {{.select = VertexPins{{40}}}}).ok());
            };
            if (!fabric_first) set_pins();
            ASSERT_TRUE(set_fabric(world, "denim").ok());
            if (fabric_first) set_pins();
            const Vec3 at = world.world().frame().cloths[0].positions[40].xyz();
            advance(world, 10);
            EXPECT_FALSE(rebuilding(world));
            EXPECT_EQ(world.world().frame().cloths[0].positions[40].xyz(), at);
            EXPECT_GT(world.world().frame().cloths[0].positions[0].w, 0);
            expect_built_model(world);
        }
    }
}

TEST(LiveFabric, that_nearly_lost_its_levels_gets_them_back) {
    SceneWorld world = open_world(hung_sheet());
    Fabric soft = find_fabric("cotton")->fabric;
    soft.stretch.stretch[0] = soft.stretch.stretch[1] = 0.5f;
    ASSERT_TRUE(world.set_fabric(world.world().cloth_id(0), soft, "cotton").ok());
    advance(world, 5);
    EXPECT_TRUE(model_of(world).hierarchy.empty()) << "of no use for what is so soft";
    ASSERT_TRUE(set_fabric(world, "cotton").ok());
    ASSERT_TRUE(world.set_pins(world.world().cloth_id(0), {{.select = VertexPins{{7}}}}).ok());
    advance(world, 5);
    EXPECT_FALSE(model_of(world).hierarchy.empty());
    EXPECT_EQ(world.world().frame().cloths[0].positions[7].w, 0) << "not the pins of before";
    expect_built_model(world);
}

TEST(LiveFabric, is_undone_by_a_former_document) {
    SceneWorld world = open_world(hung_sheet());
    advance(world, 2);
    const SceneDesc before = world.scene();
    SceneDesc next = before;
    next.cloths[0].fabric = find_fabric("wool")->fabric;
    next.cloths[0].fabric_name = "wool";
    for (const SceneDesc* document : {&std::as_const(next), &before}) {
        const auto faces = model_of(world).faces;
        ASSERT_TRUE(world.change_to(*document).ok());
        EXPECT_TRUE(world.scene() == *document);
        EXPECT_TRUE(model_of(world).faces.shares(faces)) << "not built";
        const Snapshot saved = world.world().save();  // waits for the pending model
        expect_built_model(world);
        ASSERT_TRUE(world.world().restore(saved).ok());
        advance(world, 2);
    }
}

TEST(LiveFabric, with_tethers_gets_those_of_the_new_fabric) {
    SceneDesc scene = hung_sheet();
    scene.solver.hierarchy = false;
    scene.cloths[0].tethers = Tethers::on;
    SceneWorld world = open_world(scene);
    ASSERT_GT(model_of(world).table(ConstraintKind::tether).rows, 0u);
    ASSERT_TRUE(set_fabric(world, "silk").ok());
    EXPECT_TRUE(rebuilding(world));
    advance(world, 5);
    expect_built_model(world);
}

TEST(LiveFabric, that_no_simulation_could_follow_changes_nothing) {
    SceneWorld world = open_world(hung_sheet());
    const SceneDesc before = world.scene();
    const auto model = world.world().model(world.world().cloth_id(0));
    for (const float density : {std::nanf(""), 0.0f, 1e-44f}) {
        Fabric fabric = find_fabric("silk")->fabric;
        fabric.body.density = density;
        EXPECT_FALSE(world.set_fabric(world.world().cloth_id(0), fabric, "silk").ok());
        EXPECT_TRUE(world.scene() == before);
        EXPECT_EQ(world.world().model(world.world().cloth_id(0)), model);
    }
}

}  // namespace
}  // namespace weft
