// SceneWorld::go_to() brings everything back, to the bit, after any change.
#include "weft/checkpoint.h"

#include "scene/fabric.h"
#include "weft/scene_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <set>
#include <string_view>

namespace weft {
namespace {

SceneCloth hung_sheet(const std::string& name, float height, std::uint32_t side) {
    SceneCloth cloth;
    cloth.name = name;
    cloth.mesh = GridDesc{.size = {1, 1}, .resolution = {side, side}};
    cloth.transform.position = {0, height, 0};
    cloth.pins = {{.select = VertexPins{{0}}}, {.select = VertexPins{{5}}, .compliance = 1e-3f}};
    cloth.tearing = Tearing::cuts;
    return cloth;
}

SceneDesc furnished_scene() {
    SceneDesc scene;
    scene.solver.substeps = 4;
    scene.air = AirDesc{.wind = {{.velocity = {3, 0, 1}}}};
    scene.cloths = {hung_sheet("a", 0.5f, 40), hung_sheet("b", 1.0f, 20)};
    scene.cloths[1].pins.push_back({.select = VertexPins{{380}}, .attach = "ball"});
    scene.colliders = {ColliderDesc{.name = "ball", .shape = SphereDesc{0.2f}}, ColliderDesc{.name = "floor"}};
    scene.colliders[1].transform.position.y = 0.48f;  // cloth slides on it within a few frames
    scene.stitches = {{.name = "s", .a = {"a", {3, 4}}, .b = {"b", {7, 8}}, .gap = 0.5f}};
    return scene;
}

struct NamedChange {
    const char* name;
    std::function<void(SceneDesc&)> change;
};

// GoogleTest prints parameters.
void PrintTo(const NamedChange& change, std::ostream* out) {
    *out << change.name;
}

const NamedChange all_changes[] = {

    NamedChange{"fabric", [](SceneDesc& s) { s.cloths[0].fabric = find_fabric("denim")->fabric; }},
    NamedChange{"constraints",
                [](SceneDesc& s) {
                    s.cloths[0].fabric.bend.bend[0] = s.cloths[0].fabric.bend.bend[1] =
                        s.cloths[0].fabric.bend.bend[2] = 0;
                }},
    NamedChange{"pins",
                [](SceneDesc& s) {
                    s.cloths[0].pins = {{.select = VertexPins{{39, 7}}}};
                }},
    NamedChange{"springs", [](SceneDesc& s) { s.cloths[1].pins[1].compliance = 0.1f; }},
    NamedChange{"mesh",
                [](SceneDesc& s) {
                    s.cloths[0].mesh = GridDesc{.resolution = {13, 31}};
                }},
    NamedChange{"place", [](SceneDesc& s) { s.cloths[1].transform.position.x = 0.3f; }},
    NamedChange{"cloth_removed", [](SceneDesc& s) { s.cloths.erase(s.cloths.begin()), s.stitches.clear(); }},
    NamedChange{"cloth_inserted", [](SceneDesc& s) { s.cloths.insert(s.cloths.begin(), hung_sheet("c", 2, 9)); }},
    NamedChange{"cloths_swapped", [](SceneDesc& s) { std::swap(s.cloths[0], s.cloths[1]); }},
    NamedChange{"collider_moved", [](SceneDesc& s) { s.colliders[0].transform.position.y = 0.4f; }},
    NamedChange{"collider_removed",
                [](SceneDesc& s) { s.colliders.erase(s.colliders.begin()), s.cloths[1].pins.pop_back(); }},
    NamedChange{"collider_shape", [](SceneDesc& s) { s.colliders[0].shape = BoxDesc{}; }},
    NamedChange{"friction",
                [](SceneDesc& s) {
                    s.colliders[1].friction = {0, 0};
                }},
    NamedChange{"stitches_removed", [](SceneDesc& s) { s.stitches.clear(); }},
    NamedChange{"gravity",
                [](SceneDesc& s) {
                    s.gravity = {1, 2, 3};
                }},
    NamedChange{"air", [](SceneDesc& s) { s.air.reset(); }},
    NamedChange{"substeps", [](SceneDesc& s) { s.solver.substeps = 7; }},
    NamedChange{"layout", [](SceneDesc& s) { s.solver.projection = Projection::jacobi; }},
    NamedChange{"no_levels", [](SceneDesc& s) { s.solver.hierarchy = false; }},
    NamedChange{"self_collision", [](SceneDesc& s) { s.cloths[0].self_collision = SelfCollision::exact; }}};

class Checkpoints : public testing::TestWithParam<NamedChange> {
  protected:
    static SceneWorld open(const SceneDesc& scene) {
        auto world = SceneWorld::create(scene, {.backend = "cpu"});
        EXPECT_TRUE(world.ok()) << world.error().message();
        return std::move(*world);
    }
    static std::vector<std::string> run(SceneWorld& world, int frames) {
        std::vector<std::string> hashes{world.world().state_hash()};
        for (int i = 0; i < frames; ++i) {
            world.advance();
            hashes.push_back(world.world().state_hash());
        }
        return hashes;
    }
    static void change(SceneWorld& world, const std::function<void(SceneDesc&)>& change) {
        SceneDesc next = world.scene();
        change(next);
        const auto changed = world.change_to(next);
        ASSERT_TRUE(changed.ok()) << changed.error().message();
        EXPECT_TRUE(world.scene() == next);
    }
};

// Ten frames: a model that is built in the background comes into use meanwhile.
TEST_P(Checkpoints, bring_back_every_bit_after_a_change) {
    SceneWorld world = open(furnished_scene());
    (void)run(world, 5);
    const Checkpoint then = world.checkpoint();
    const auto expected = run(world, 10);
    ASSERT_TRUE(world.go_to(then).ok());
    change(world, GetParam().change);
    (void)run(world, 10);
    ASSERT_TRUE(world.go_to(then).ok());
    EXPECT_TRUE(world.scene() == *then.scene);
    EXPECT_EQ(world.world().index(), 5u);
    EXPECT_EQ(run(world, 10), expected);
}

// A state between the change and the use of its background build comes back too, and the state before it after that.
TEST_P(Checkpoints, bring_back_what_was_pending) {
    SceneWorld world = open(furnished_scene());
    (void)run(world, 3);
    const Checkpoint first = world.checkpoint();
    const auto unchanged = run(world, 8);
    ASSERT_TRUE(world.go_to(first).ok());
    change(world, GetParam().change);
    const Checkpoint second = world.checkpoint();
    const auto changed = run(world, 8);
    ASSERT_TRUE(world.go_to(second).ok());
    EXPECT_EQ(run(world, 8), changed);
    ASSERT_TRUE(world.go_to(first).ok());
    EXPECT_EQ(run(world, 8), unchanged);
    ASSERT_TRUE(world.go_to(second).ok());
    EXPECT_EQ(run(world, 8), changed);
}

// Before the first frame, a changed world is the one that its document describes.
TEST_P(Checkpoints, and_changes_before_the_first_frame_equal_a_new_world) {
    SceneWorld world = open(furnished_scene());
    change(world, GetParam().change);
    SceneWorld fresh = open(world.scene());
    EXPECT_EQ(run(world, 8), run(fresh, 8));
}

INSTANTIATE_TEST_SUITE_P(OfAScene, Checkpoints, testing::ValuesIn(all_changes),
                         [](const auto& one) { return std::string(one.param.name); });

#ifdef WEFT_VULKAN
// One after another in one world, which keeps the device's memory of the former ones.
// Labels: slow no-asan long
TEST(CheckpointsOnVulkan, bring_back_every_bit_after_each_change) {
    auto world = SceneWorld::create(furnished_scene(), {.backend = "vulkan"});
    ASSERT_TRUE(world.ok()) << world.error().message();
    const auto hash_after = [&](int frames) {
        for (int i = 0; i < frames; ++i) world->advance();
        return world->world().state_hash();
    };
    (void)hash_after(3);
    const Checkpoint then = world->checkpoint();
    const std::string at_once = hash_after(0), later = hash_after(4);
    for (const NamedChange& one : all_changes) {
        static const std::set<std::string_view> tried{"pins", "mesh", "collider_shape"};
        // Each takes seconds on a software device.
        if (!tried.contains(one.name) && !std::getenv("WEFT_LONG_TESTS")) continue;
        ASSERT_TRUE(world->go_to(then).ok());
        SceneDesc next = world->scene();
        one.change(next);
        ASSERT_TRUE(world->change_to(next).ok()) << one.name;
        EXPECT_NE(hash_after(4), later) << one.name;
        ASSERT_TRUE(world->go_to(then).ok());
        EXPECT_EQ(hash_after(0), at_once) << one.name;
        EXPECT_EQ(hash_after(4), later) << one.name;
    }
}
#endif

TEST(Checkpoints, bring_back_cuts) {
    auto world = SceneWorld::create(furnished_scene(), {.backend = "cpu"});
    ASSERT_TRUE(world.ok());
    for (int i = 0; i < 3; ++i) world->advance();
    const Checkpoint whole = world->checkpoint();
    const CutDesc cut{.along = PlaneCut{.normal = {1, 0, 0}, .offset = 0.01f}};
    ASSERT_TRUE(world->cut(world->world().cloth_id(0), cut, CutPositions::start).ok());
    const Checkpoint parted = world->checkpoint();
    world->advance();
    const std::string after_cut = world->world().state_hash();
    ASSERT_TRUE(world->go_to(whole).ok());
    world->advance();
    const std::string without = world->world().state_hash();
    EXPECT_NE(without, after_cut);
    ASSERT_TRUE(world->go_to(parted).ok());
    world->advance();
    EXPECT_EQ(world->world().state_hash(), after_cut);
}

// A move that no frame has made yet.
TEST(Checkpoints, bring_back_a_move_that_is_due) {
    auto world = SceneWorld::create(furnished_scene(), {.backend = "cpu"});
    ASSERT_TRUE(world.ok());
    world->advance();
    world->move(world->world().collider_id(0), {0.2f, 0, 0}, {});
    const Checkpoint then = world->checkpoint();
    world->advance();
    const std::string expected = world->world().state_hash();
    world->move(world->world().collider_id(0), {}, {});
    world->advance();
    ASSERT_TRUE(world->go_to(then).ok());
    world->advance();
    EXPECT_EQ(world->world().collider(world->world().collider_id(0)).pose.position.x, 0.2f);
    EXPECT_EQ(world->world().state_hash(), expected);
}

// The state goes on in a world without objects, for example on another backend.
TEST(Checkpoints, go_to_another_world) {
    auto world = SceneWorld::create(furnished_scene(), {.backend = "cpu"});
    ASSERT_TRUE(world.ok());
    for (int i = 0; i < 4; ++i) world->advance();
    const Checkpoint then = world->checkpoint();
    auto other = SceneWorld::create({}, {.backend = "cpu", .threads = 2});
    ASSERT_TRUE(other.ok());
    ASSERT_TRUE(other->go_to(then).ok());
    for (int i = 0; i < 4; ++i) world->advance(), other->advance();
    EXPECT_EQ(world->world().state_hash(), other->world().state_hash());
    EXPECT_TRUE(world->scene() == other->scene());
    ASSERT_TRUE(world->go_to(then).ok());
    EXPECT_EQ(world->world().index(), 4u);
}

TEST(Checkpoints, of_renamed_objects_move_on) {
    auto world = SceneWorld::create(furnished_scene(), {.backend = "cpu"});
    ASSERT_TRUE(world.ok());
    for (int i = 0; i < 3; ++i) world->advance();
    const Checkpoint then = world->checkpoint();
    world->advance();
    const std::string expected = world->world().state_hash();
    ASSERT_TRUE(world->go_to(then).ok());
    SceneDesc next = world->scene();
    next.cloths[1].name = "other";
    next.stitches[0].b.cloth = "other";
    next.colliders[0].name = next.cloths[1].pins[2].attach = "globe";
    ASSERT_TRUE(world->rename(next).ok());
    EXPECT_TRUE(world->scene() == next);
    EXPECT_EQ(world->world().model(world->world().cloth_id(1))->name, "other");
    EXPECT_EQ(world->world().colliders()[0].name, "globe");
    world->advance();
    EXPECT_EQ(world->world().state_hash(), expected);

    // Back before the rename, and before the stitches were others.
    next.stitches.clear();
    ASSERT_TRUE(world->change_to(next).ok());
    ASSERT_TRUE(world->go_to(then).ok());
    EXPECT_TRUE(world->scene() == *then.scene);
    world->advance();
    EXPECT_EQ(world->world().state_hash(), expected);
}

TEST(Checkpoints, report_their_size) {
    auto world = SceneWorld::create(furnished_scene(), {.backend = "cpu"});
    ASSERT_TRUE(world.ok());
    const std::size_t size = size_of(world->checkpoint());
    EXPECT_GT(size, 2000 * 4 * sizeof(Vec4));
    EXPECT_LT(size, 2000 * 10 * sizeof(Vec4));
}

}  // namespace
}  // namespace weft
