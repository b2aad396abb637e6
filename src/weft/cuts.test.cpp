// Cuts of scenes and of programs.

#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "scene/fabric.h"
#include "solver/model/drawn_pieces.test.h"
#include "solver/model/tear_law.h"
#include "solver/model/tear_table.h"
#include "weft/scene_world.h"

#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace weft {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t cut_side = 33;
const CutDesc down_the_middle{.time = 0.1f, .along = PlaneCut{{1, 0, 0}, 0.001f}};
const CutDesc from_the_left{.time = 0.2f, .along = PathCut{{{-0.6f, 0.1f, 0}, {-0.2f, 0, 0}, {-0.1f, 0.2f, 0}}}};

// Hangs upright by its upper hem, y from -0.5 to 0.5 m.
SceneDesc curtain_with(std::vector<CutDesc> cuts) {
    SceneDesc scene;
    scene.solver.substeps = 4;
    SceneCloth cloth;
    cloth.name = "curtain";
    cloth.mesh = GridDesc{.size = {1, 1}, .resolution = {cut_side, cut_side}};
    cloth.transform.rotation_degrees = {90, 0, 0};
    cloth.pins = {{.select = BoxPins{{{-1, 0.49f, -1}, {1, 1, 1}}}}};
    cloth.tearing = Tearing::cuts;
    cloth.cuts = std::move(cuts);
    scene.cloths = {cloth};
    return scene;
}

SceneWorld open_cut_world(const SceneDesc& scene) {
    auto world = SceneWorld::create(scene, {.backend = "cpu"});
    EXPECT_TRUE(world.ok()) << world.error().message();
    return std::move(*world);
}

void step(SceneWorld& world, int frames) {
    for (int i = 0; i < frames; ++i) world.advance();
}

ClothId only_cloth(const SceneWorld& world) {
    return world.world().cloth_id(0);
}
const ClothModel& only_model(const SceneWorld& world) {
    return *world.world().model(only_cloth(world));
}
std::size_t copies_in(const SceneWorld& world) {
    return only_model(world).copied_from.size();
}
std::vector<Vec4> positions_in(const SceneWorld& world) {
    const auto positions = world.world().frame().cloths[0].positions;
    return {positions.begin(), positions.end()};
}

std::string problem_of(const SceneDesc& scene) {
    const auto world = SceneWorld::create(scene, {.backend = "cpu"});
    return world.ok() ? "" : world.error().message();
}

TEST(SceneCuts, open_before_the_first_frame_at_their_time) {
    CutDesc first = down_the_middle;
    first.time = 0;
    SceneWorld world = open_cut_world(curtain_with({from_the_left, first}));
    EXPECT_EQ(copies_in(world), cut_side) << "a cut at time 0 shows in the first frame";
    const std::size_t all = cut_side + 17;
    for (int frame = 0; frame < 15; ++frame) {
        // Frame 12 begins at 0.2 s.
        EXPECT_EQ(copies_in(world), frame <= 12 ? cut_side : all) << frame;
        world.advance();
    }
    EXPECT_EQ(copies_in(world), all);
    EXPECT_TRUE(world.notes().empty());
}

TEST(SceneCuts, change_nothing_before_their_time) {
    SceneWorld cut = open_cut_world(curtain_with({down_the_middle})), whole = open_cut_world(curtain_with({}));
    step(cut, 6), step(whole, 6);
    EXPECT_EQ(cut.world().state_hash(), whole.world().state_hash());
    step(cut, 1), step(whole, 1);
    EXPECT_NE(cut.world().state_hash(), whole.world().state_hash());
}

TEST(SceneCuts, are_made_again_in_a_restored_world_where_they_are_missing) {
    const SceneDesc scene = curtain_with({down_the_middle, from_the_left});
    SceneWorld world = open_cut_world(scene);
    std::vector<Snapshot> saved;
    std::vector<std::string> hashes;
    for (int frame = 0; frame < 20; ++frame) {
        saved.push_back(world.world().save());
        world.advance();
        hashes.push_back(world.world().state_hash());
    }
    SceneWorld other = open_cut_world(scene);
    for (const std::size_t from : {18, 3, 9, 13, 0, 6}) {
        for (SceneWorld* restored : {&world, &other}) {
            ASSERT_TRUE(restored->world().restore(saved[from]).ok());
            for (std::size_t frame = from; frame < hashes.size(); ++frame) {
                restored->advance();
                ASSERT_EQ(restored->world().state_hash(), hashes[frame]) << frame << " from " << from;
            }
            EXPECT_EQ(restored->world().save().cloths[0].edits, world.world().save().cloths[0].edits);
        }
    }
}

TEST(SceneCuts, stay_open_when_the_model_is_built_again) {
    const SceneDesc scene = curtain_with({down_the_middle, from_the_left});
    struct Case {
        const char* name;
        std::function<Result<void>(SceneWorld&)> change;
    };
    const Case cases[] = {
        {"layout", [](SceneWorld& w) { return w.set_solver({.substeps = 4, .hierarchy = false}); }},
        {"lines", [](SceneWorld& w) { return w.set_solver({.substeps = 4, .projection = Projection::gauss_seidel}); }},
        {"bend model",
         [](SceneWorld& w) {
             Fabric fabric = find_fabric("cotton")->fabric;
             fabric.bend.model = BendModel::distance;
             return w.set_fabric(only_cloth(w), fabric, "cotton");
         }},
        {"springs",
         [](SceneWorld& w) {
             PinDesc springs = w.scene().cloths[0].pins[0];
             springs.compliance = 0.01f;
             return w.set_pins(only_cloth(w), {springs});
         }},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        SceneWorld world = open_cut_world(scene);
        step(world, 15);
        const auto faces = only_model(world).faces;
        const auto before = positions_in(world);
        const std::size_t copies = copies_in(world);
        ASSERT_TRUE(one.change(world).ok());
        EXPECT_EQ(copies_in(world), copies);
        EXPECT_EQ(only_model(world).faces, faces);
        for (std::uint32_t p = 0; p < before.size(); ++p)
            EXPECT_EQ(length(before[p].xyz() - positions_in(world)[p].xyz()), 0) << p;
        step(world, 1);
        const Snapshot saved = world.world().save();
        step(world, 5);
        const std::string hash = world.world().state_hash();
        EXPECT_EQ(copies_in(world), copies) << "no cut is made twice";
        ASSERT_TRUE(world.world().restore(saved).ok());
        step(world, 5);
        EXPECT_EQ(world.world().state_hash(), hash);
        EXPECT_EQ(world.world().frame().reports, report_none);
    }
}

// The same constraints as in a cloth that was built with this fabric and cut then.
TEST(SceneCuts, give_the_model_of_a_cloth_that_was_built_so) {
    Fabric fabric = find_fabric("denim")->fabric;
    fabric.bend.model = BendModel::distance;
    SceneDesc wanted = curtain_with({down_the_middle, from_the_left});
    wanted.cloths[0].fabric = fabric;
    SceneWorld changed = open_cut_world(curtain_with({down_the_middle, from_the_left})), built = open_cut_world(wanted);
    step(changed, 15), step(built, 15);
    ASSERT_TRUE(changed.set_fabric(only_cloth(changed), fabric, "denim").ok());
    const ClothModel &a = only_model(changed), &b = only_model(built);
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        EXPECT_EQ(a.constraints[kind].particles, b.constraints[kind].particles) << kind;
        EXPECT_EQ(a.constraints[kind].fields, b.constraints[kind].fields) << kind;
    }
    EXPECT_EQ(a.mass, b.mass);
    ASSERT_EQ(a.hierarchy.size(), b.hierarchy.size());
    ASSERT_FALSE(a.hierarchy.empty());
    for (std::size_t i = 0; i < a.hierarchy.size(); ++i)
        EXPECT_EQ(a.hierarchy[i].limits.fields, b.hierarchy[i].limits.fields);
}

// Cloth that is not drawn as it is simulated: with seams of UVs, and with a render mesh of its own.
TEST(SceneCuts, part_what_is_drawn) {
    const auto patches = [](Vec3 at) { return 2 * (at.x > 0.2f) + (at.z > 0.1f); };
    SceneDesc seams = curtain_with({down_the_middle, from_the_left}), bound = seams;
    seams.cloths[0].mesh =
        testing_meshes::with_seams(make_grid({1, 1}, {cut_side, cut_side}, GridDiagonal::alternating), patches);
    bound.cloths[0].render_mesh =
        testing_meshes::with_seams(make_grid({1, 1}, {50, 47}, GridDiagonal::uniform), patches);
    for (const SceneDesc& scene : {seams, bound}) {
        SceneWorld world = open_cut_world(scene);
        const TriangleMesh built = only_model(world).mesh();
        step(world, 8);
        const std::size_t half = only_model(world).mesh().positions.size();
        EXPECT_GE(half, built.positions.size() + cut_side);
        step(world, 7);
        EXPECT_GE(only_model(world).mesh().positions.size(), half + 16);
        EXPECT_EQ(copies_in(world), cut_side + 17);
        EXPECT_EQ(only_model(world).mesh().triangles.size(), built.triangles.size());
        EXPECT_EQ(test::expect_no_triangle_spans_pieces(only_model(world)).size(), 2u);
        // The same mesh in a model that is built again, and none of the cuts in one without them.
        const TriangleMesh cut = only_model(world).mesh();
        Fabric fabric = find_fabric("cotton")->fabric;
        fabric.bend.model = BendModel::distance;
        ASSERT_TRUE(world.set_fabric(only_cloth(world), fabric, "cotton").ok());
        EXPECT_EQ(only_model(world).mesh(), cut);
        EXPECT_EQ(test::expect_no_triangle_spans_pieces(only_model(world)).size(), 2u);
        EXPECT_EQ(world.world().unedited_model(only_cloth(world))->mesh(), built);
        step(world, 10);
        EXPECT_EQ(world.world().frame().reports, report_none);
        EXPECT_GT(test::widest_gap(world.world().frame().cloths[0]), 1e-3f);
    }
}

std::size_t pinned_copies(const SceneWorld& world) {
    const auto& pinned = world.world().pinned(only_cloth(world));
    return static_cast<std::size_t>(pinned.end() - std::ranges::lower_bound(pinned, cut_side * cut_side));
}

TEST(SceneCuts, leave_both_sides_of_a_pin_pinned) {
    SceneDesc scene = curtain_with({down_the_middle});
    scene.cloths[0].pins[0].motion = {{0, {}}, {1, {0, 0.5f, 0}}};
    SceneWorld world = open_cut_world(scene);
    step(world, 10);
    ASSERT_EQ(pinned_copies(world), 1u);
    Fabric fabric = find_fabric("cotton")->fabric;
    fabric.bend.model = BendModel::plate;
    ASSERT_TRUE(world.set_fabric(only_cloth(world), fabric, "cotton").ok());
    EXPECT_EQ(pinned_copies(world), 1u);
    step(world, 50);
    const auto& pinned = world.world().pinned(only_cloth(world));
    for (const std::uint32_t p : pinned) EXPECT_NEAR(positions_in(world)[p].y, 1, 1e-4) << "particle " << p;
}

TEST(SceneCuts, let_pins_select_copies) {
    SceneWorld world = open_cut_world(curtain_with({down_the_middle}));
    step(world, 10);
    std::vector<std::uint32_t> hem;
    for (std::uint32_t p = 0; p < cut_side; ++p) hem.push_back(p);
    const PinDesc by_number{.select = VertexPins{hem}};
    ASSERT_TRUE(world.set_pins(only_cloth(world), {by_number}).ok());
    EXPECT_EQ(pinned_copies(world), 1u);
    // A box about the right half: the copy is pinned where its own position lies in it.
    ASSERT_TRUE(world.set_pins(only_cloth(world), {{.select = BoxPins{{{0.1f, 0.49f, -1}, {1, 1, 1}}}}}).ok());
    EXPECT_EQ(pinned_copies(world), 0u);
    EXPECT_TRUE(world.world().is_rebuilding(only_cloth(world))) << "coarse levels hold to the old pins";
    step(world, 60);
    EXPECT_FALSE(world.world().is_rebuilding(only_cloth(world)));
    EXPECT_EQ(pinned_copies(world), 0u);
    const auto positions = positions_in(world);
    EXPECT_LT(positions[0].y, -0.5f) << "the left half has fallen";
    EXPECT_GT(positions[cut_side - 1].y, 0.49f);
    EXPECT_EQ(copies_in(world), cut_side);
}

TEST(SceneCuts, keep_elastic_pins_in_place) {
    for (const Tearing tearing : {Tearing::off, Tearing::cuts}) {
        SceneDesc scene = curtain_with({});
        scene.cloths[0].tearing = tearing;
        scene.cloths[0].pins[0].compliance = 1e-4f;
        scene.cloths[0].pins[0].motion = {{0, {}}, {0.5f, {0, 0.3f, 0}}};
        SceneWorld world = open_cut_world(scene);
        step(world, 60);
        EXPECT_NEAR(positions_in(world)[0].y, 0.8f, 0.02f);
    }
}

TEST(SceneCuts, that_cannot_be_made_are_errors_with_their_place) {
    const auto with = [](CutDesc cut) { return problem_of(curtain_with({down_the_middle, std::move(cut)})); };
    EXPECT_THAT(with({.along = PlaneCut{{1, 0, 0}, 3}}), HasSubstr("/cloths/0/cuts/1: meets no closed edge"));
    EXPECT_THAT(with({.along = PathCut{{{0.3125f, 0, 0}, {0.34375f, 0, 0}}}}),
                HasSubstr("/cloths/0/cuts/1: parts nothing"));
    EXPECT_THAT(with({.along = PathCut{{{0.3125f, 0, 0}, {0.32f, 0, 0}}}}), HasSubstr("cuts/1: meets no closed edge"));
    EXPECT_THAT(with({.along = PathCut{{{-0.3f, 0, 0.2f}, {-0.2f, 0, 0.2f}}}}), HasSubstr("cuts/1: leaves the cloth"));
    std::vector<CutDesc> many;
    for (int i = 0; i < 16; ++i) many.push_back({.along = PlaneCut{{0, 1, 0}, -0.45f + 0.06f * static_cast<float>(i)}});
    EXPECT_THAT(problem_of(curtain_with(many)), HasSubstr("needs more room than there is"));
}

TEST(SceneCuts, belong_to_the_document) {
    SceneWorld world = open_cut_world(curtain_with({down_the_middle}));
    step(world, 20);
    SceneDesc next = curtain_with({});
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_EQ(copies_in(world), 0u) << "another cloth";
    ASSERT_TRUE(world.change_to(curtain_with({down_the_middle})).ok());
    step(world, 1);
    EXPECT_EQ(copies_in(world), cut_side) << "its time has passed";
    next = world.scene();
    next.cloths[0].tearing = Tearing::off;
    EXPECT_THAT(world.change_to(next).errors()[0].message(), HasSubstr("/cloths/0/cuts: needs \"tearing\""));
}

SceneDesc tearing_sheet(std::vector<SeamDesc> seams, std::vector<ResistanceDesc> resistance) {
    SceneDesc scene = curtain_with({});
    scene.cloths[0].tearing = Tearing::split;
    scene.cloths[0].seams = std::move(seams);
    scene.cloths[0].resistance = std::move(resistance);
    return scene;
}

TEST(SceneSeams, have_the_edges_that_a_cut_would_open) {
    const SceneWorld world =
        open_cut_world(tearing_sheet({{.strength = 50, .along = PlaneCut{{1, 0, 0}, 0.001f}}}, {}));
    const ClothModel& model = only_model(world);
    ASSERT_TRUE(model.tear_law);
    ASSERT_EQ(model.tear_law->seams.size(), model.tears->entries.size());
    std::uint32_t links = 0;
    for (std::size_t i = 0; i < model.tears->entries.size(); ++i) {
        const auto& [inverse, energy, x, y] = model.tear_law->seams[i];
        if (inverse == 0) continue;
        ++links;
        EXPECT_EQ(inverse, 1.0f / 50);
        EXPECT_NEAR(model.rest_position(model.tears->entries[i].vertex).x, 0, 0.51f / (cut_side - 1));
        EXPECT_NEAR(x * x + y * y, 1, 1e-5f);
    }
    EXPECT_EQ(links, 2 * (cut_side - 1)) << "each edge in the rings of both its ends";
}

TEST(SceneSeams, that_cannot_be_made_are_errors_with_their_place) {
    const auto with = [](SeamDesc seam) { return problem_of(tearing_sheet({std::move(seam)}, {})); };
    EXPECT_THAT(with({.strength = 1, .along = PlaneCut{{1, 0, 0}, 3}}),
                HasSubstr("/cloths/0/seams/0: meets no closed"));
    EXPECT_THAT(with({.strength = 1, .along = PathCut{{{-0.3f, 0, 0.2f}, {-0.2f, 0, 0.2f}}}}),
                HasSubstr("/cloths/0/seams/0: leaves the cloth"));
    const auto painted = [](ResistanceDesc resistance) {
        return problem_of(tearing_sheet({}, {std::move(resistance)}));
    };
    EXPECT_THAT(painted({.select = BoxPins{{{7, 7, 7}, {8, 8, 8}}}}),
                HasSubstr("/cloths/0/resistance/0/box: no vertex"));
    EXPECT_THAT(painted({.select = VertexPins{{5000}}}), HasSubstr("/cloths/0/resistance/0/vertices/0"));
}

// The last description of a particle counts. A channel multiplies the factor by the color.
TEST(SceneResistance, follows_boxes_and_colors) {
    SceneDesc scene = tearing_sheet({}, {{.factor = 2, .select = PaintedChannel{ColorChannel::green}},
                                         {.factor = 0.25f, .select = BoxPins{{{-1, -1, -1}, {-0.4f, 1, 1}}}}});
    TriangleMesh mesh = make_grid({1, 1}, {cut_side, cut_side}, GridDiagonal::alternating);
    for (const Vec3& x : mesh.positions) mesh.colors.push_back({0.3f, x.x + 0.5f, 0, 1});
    scene.cloths[0].mesh = mesh;
    const SceneWorld world = open_cut_world(scene);
    const ClothModel& model = only_model(world);
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const float x = model.rest_position(p).x;
        const float expected = x <= -0.4f ? 0.25f : std::max(0.001f, 2 * (x + 0.5f));
        EXPECT_NEAR(model.tear_law->inverse_resistance[p], 1 / expected, 1e-4f / expected);
    }
    for (Vec4& color : mesh.colors) color.y = NAN;
    scene.cloths[0].mesh = mesh;
    EXPECT_THAT(problem_of(scene), HasSubstr("/cloths/0/resistance/0/channel: the color of vertex 0 is not a finite"));
    mesh.colors.clear();
    scene.cloths[0].mesh = mesh;
    EXPECT_THAT(problem_of(scene), HasSubstr("/cloths/0/resistance/0/channel: the mesh has no vertex colors"));
}

// The strength changes under a cloth that moves and has torn, and nothing else does.
TEST(SceneResistance, changes_while_the_cloth_moves) {
    SceneDesc scene = tearing_sheet({{.strength = 50, .along = PlaneCut{{1, 0, 0}, 0.001f}}}, {});
    SceneWorld world = open_cut_world(scene);
    for (int i = 0; i < 5; ++i) world.advance();
    ASSERT_TRUE(world.cut(world.world().cloth_id(0), {.along = PlaneCut{{0, 1, 0}, 0.001f}}, CutPositions::start));
    world.advance();
    const auto positions = [&] {
        const auto now = world.world().frame().cloths[0].positions;
        return std::vector<Vec4>(now.begin(), now.end());
    };
    const std::vector<Vec4> before = positions();
    const std::uint64_t shape = world.world().frame().cloths[0].topology_version;
    SceneDesc next = world.scene();
    next.cloths[0].resistance = {{.factor = 2, .select = VertexPins{{7, 9}}, .factors = {0.25f, 4}}};
    ASSERT_TRUE(world.change_to(next));
    EXPECT_EQ(world.scene(), next);
    EXPECT_EQ(positions(), before);
    EXPECT_EQ(world.world().frame().cloths[0].topology_version, shape) << "it stays cut";
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[7], 2);
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[9], 1.0f / 8);
    EXPECT_FALSE(only_model(world).tear_law->seams.empty());
    // A new model gets it too, and so does the world that the document describes.
    next.cloths[0].pins = {{.select = VertexPins{{0}}, .compliance = 0.01f}};
    ASSERT_TRUE(world.change_to(next));
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[7], 2);
    const SceneWorld fresh = open_cut_world(next);
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance, only_model(fresh).tear_law->inverse_resistance);
    EXPECT_EQ(only_model(world).tear_law->watch, only_model(fresh).tear_law->watch);
    next.cloths[0].resistance = {{.select = VertexPins{{5000}, "hem"}}};
    EXPECT_THAT(world.change_to(next).errors()[0].message(),
                HasSubstr("/cloths/0/resistance/0/group: must be a vertex"));
    next.cloths[0].resistance.clear();
    ASSERT_TRUE(world.change_to(next));
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[7], 1);
}

// A cloth gets room for cuts and tears while it moves, and loses it again. It goes on as it would have.
TEST(SceneTearing, changes_while_the_cloth_moves) {
    SceneDesc scene = tearing_sheet({}, {});
    scene.cloths[0].tearing = Tearing::off;
    scene.cloths[0].pins = {{.select = VertexPins{{0}}}, {.select = VertexPins{{10}}, .compliance = 0.01f}};
    SceneWorld world = open_cut_world(scene), unchanged = open_cut_world(scene);
    step(world, 10), step(unchanged, 10);
    const auto places = [](const SceneWorld& of) {
        std::vector<Vec3> all;
        for (const Vec4& x : of.world().frame().cloths[0].positions) all.push_back(x.xyz());
        return all;
    };
    const auto at_10 = world.checkpoint();
    const std::string hash = world.world().state_hash();
    SceneDesc next = world.scene();
    next.cloths[0].tearing = Tearing::split;
    next.cloths[0].resistance = {{.factor = 2, .select = VertexPins{{7}}}};
    ASSERT_TRUE(world.change_to(next));
    EXPECT_EQ(world.scene(), next);
    EXPECT_EQ(world.world().state_hash(), hash);
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[7], 0.5f);
    step(world, 5), step(unchanged, 5);
    EXPECT_EQ(places(world), places(unchanged)) << "nothing tears: positions equal those without tearing";
    const ClothId id = world.world().cloth_id(0);
    ASSERT_TRUE(world.cut(id, {.along = PlaneCut{{1, 0, 0}, 0.001f}}, CutPositions::start));
    step(world, 5);
    EXPECT_GT(copies_in(world), 0u);
    // A cloth that is cut starts again.
    const auto cut = world.checkpoint();
    next.cloths[0].tearing = Tearing::off, next.cloths[0].resistance.clear();
    ASSERT_TRUE(world.change_to(next));
    EXPECT_EQ(copies_in(world), 0u);
    // Earlier states come back, with and without room.
    ASSERT_TRUE(world.go_to(cut));
    EXPECT_GT(copies_in(world), 0u);
    ASSERT_TRUE(world.go_to(at_10));
    EXPECT_EQ(world.world().state_hash(), hash);
    step(world, 5);
    EXPECT_EQ(places(world), places(unchanged));
}

// Other names of groups leave the cloth alone.
TEST(SceneGroups, can_change_while_the_cloth_moves) {
    SceneDesc scene = tearing_sheet({}, {});
    scene.cloths[0].groups = {{"hem", {0, 1}}};
    scene.cloths[0].pins = {{.select = VertexPins{{0, 1}, "hem"}, .compliance = 0.01f}};
    SceneWorld world = open_cut_world(scene);
    for (int i = 0; i < 5; ++i) world.advance();
    const std::string before = world.world().state_hash();
    SceneDesc next = world.scene();
    next.cloths[0].groups = {{"edge", {0, 1}}, {"rest", {4}}};
    next.cloths[0].pins[0].select = VertexPins{{0, 1}, "edge"};
    ASSERT_TRUE(world.change_to(next));
    EXPECT_EQ(world.world().state_hash(), before);
    EXPECT_EQ(world.scene().cloths[0].groups[0].name, "edge");
    EXPECT_EQ(std::get<VertexPins>(world.scene().cloths[0].pins[0].select).group, "edge");
}

// Other pins and another fabric keep the strengths.
TEST(SceneSeams, stay_when_the_model_is_built_again) {
    SceneWorld world = open_cut_world(tearing_sheet({{.strength = 50, .along = PlaneCut{{1, 0, 0}, 0.001f}}},
                                                    {{.factor = 3, .select = BoxPins{{{-1, -1, -1}, {1, 1, 1}}}}}));
    SceneDesc next = world.scene();
    next.cloths[0].pins = {{.select = VertexPins{{0}}}};
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[40], 1.0f / 3);
    EXPECT_FALSE(only_model(world).tear_law->seams.empty());
    next.cloths[0].fabric = find_fabric("denim")->fabric;
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[40], 1.0f / 3);
    next.cloths[0].resistance[0].factor = 4;
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_EQ(only_model(world).tear_law->inverse_resistance[40], 1.0f / 4);
}

ClothDesc hung(Tearing tearing) {
    return {.mesh = GridDesc{.size = {1, 1}, .resolution = {cut_side, cut_side}},
            .transform = {.rotation_degrees = {90, 0, 0}},
            .pins = {{.select = BoxPins{{{-1, 0.49f, -1}, {1, 1, 1}}}}},
            .tearing = tearing};
}

TEST(Simulation, cuts_cloth_now) {
    auto made = Simulation::create({}, {.backend = "cpu"});
    ASSERT_TRUE(made.ok());
    Simulation& simulation = *made;
    const ClothId id = *simulation.add(hung(Tearing::cuts)), whole = *simulation.add(hung(Tearing::off));
    for (int i = 0; i < 3; ++i) simulation.step();
    const std::size_t vertices = simulation.surface(id).positions.size();
    const auto before = simulation.save_state();
    // A slit that the lower half hangs from.
    ASSERT_TRUE(simulation.cut(id, {.along = PathCut{{{-0.5f, 0, 0}, {0.3f, 0, 0}}}}).ok());
    EXPECT_EQ(simulation.surface(id).positions.size(), vertices + 26);
    EXPECT_EQ(simulation.surface(id).triangles.size(), 2u * 32 * 32);
    for (int i = 0; i < 30; ++i) simulation.step();
    EXPECT_GT(simulation.surface(id).positions[16 * cut_side].y - simulation.surface(id).positions[17 * cut_side].y,
              0.0f);
    const auto slit = simulation.save_state();
    ASSERT_TRUE(simulation.cut(id, {.along = PlaneCut{{0, 1, 0}, 0.25f}}, CutPositions::start).ok());
    ASSERT_TRUE(simulation.restore_state(before).ok());
    EXPECT_EQ(simulation.surface(id).positions.size(), vertices);
    ASSERT_TRUE(simulation.restore_state(slit).ok());
    EXPECT_EQ(simulation.surface(id).positions.size(), vertices + 26);

    const auto problem = [&](ClothId of, const CutDesc& cut, CutPositions where = CutPositions::current) {
        const auto done = simulation.cut(of, cut, where);
        return done.ok() ? std::string() : done.error().message();
    };
    const std::string hash = simulation.state_hash();
    EXPECT_THAT(problem(ClothId{}, {}), HasSubstr("is not in this simulation"));
    EXPECT_THAT(problem(whole, {.along = PlaneCut{}}), HasSubstr("\"tearing\" is \"off\""));
    EXPECT_THAT(problem(id, {}), HasSubstr("/points: must hold at least two points, got 0"));
    EXPECT_THAT(problem(id, {.along = PlaneCut{{0, 0, 0}, 0}}), HasSubstr("/plane/normal: must not be zero"));
    EXPECT_THAT(problem(id, {.along = PlaneCut{{NAN, 0, 0}, 0}}),
                HasSubstr("/plane/normal/0: must be a finite number"));
    EXPECT_THAT(problem(id, {.along = PathCut{{{0, 0, 0}, {0, INFINITY, 0}}}}), HasSubstr("/points/1/1"));
    EXPECT_THAT(problem(id, {.along = PlaneCut{{0, 1, 0}, 7}}), HasSubstr("cut: meets no closed edge"));
    EXPECT_THAT(problem(id, {.along = PathCut{{{-0.5f, 0, 0}, {0.3f, 0, 0}}}}, CutPositions::start),
                HasSubstr("cut: meets no closed edge"))
        << "they are open";
    EXPECT_EQ(simulation.state_hash(), hash);
}

}  // namespace
}  // namespace weft
