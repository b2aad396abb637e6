// Fabrics that change while cloth moves.

#include "sheet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::physical {
namespace {

Fabric heavy_and_soft() {
    Fabric fabric;
    fabric.body = {.density = 0.5f, .damping = 0.02f};
    fabric.stretch = {.stretch = {300, 500}, .compression = {200, 400}, .shear = 20, .stretch_limit = {0.01f, 0.02f}};
    for (float& b : fabric.bend.bend) b = 1e-3f;
    return fabric;
}

TEST(LiveFabrics, move_cloth_as_a_model_that_is_built_anew_does) {
    for (const Projection projection : {Projection::lines, Projection::gauss_seidel, Projection::jacobi}) {
        const WorldSettings settings{.solver = {.substeps = 4, .projection = projection, .hierarchy = false},
                                     .air = AirDesc{}};
        SheetDesc sheet = hung_upright(settings.layout());
        World here = make_world(settings, sheet), there = make_world(settings, sheet);
        run(here, 0.25), run(there, 0.25);
        sheet.fabric = heavy_and_soft();
        ASSERT_TRUE(set_fabric(here, here.cloth_id(0), sheet.fabric).ok());
        ASSERT_TRUE(there.set_model(there.cloth_id(0), make_sheet(sheet), {}).ok());
        EXPECT_EQ(here.state_hash(), there.state_hash());
        run(here, 0.25), run(there, 0.25);
        EXPECT_EQ(here.state_hash(), there.state_hash());
    }
}

TEST(LiveFabrics, with_another_membrane_need_another_model) {
    Fabric edges = heavy_and_soft(), membrane = edges, stiffer = edges;
    membrane.stretch.model = stiffer.stretch.model = StretchModel::membrane;
    stiffer.stretch.shear *= 2;
    SheetDesc sheet = hung_upright();
    sheet.fabric = edges;
    const auto of_edges = make_sheet(sheet);
    EXPECT_EQ(of_edges->table(ConstraintKind::membrane).rows, 0u);
    EXPECT_FALSE(*with_fabric(*of_edges, membrane));
    sheet.fabric = membrane;
    const auto of_membrane = make_sheet(sheet);
    EXPECT_GT(of_membrane->table(ConstraintKind::membrane).rows, 0u);
    EXPECT_FALSE(*with_fabric(*of_membrane, edges));
    EXPECT_FALSE(*with_fabric(*of_membrane, stiffer));
    membrane.body.density = 0.3f;
    EXPECT_TRUE(*with_fabric(*of_membrane, membrane)) << "the same stiffness";
}

TEST(LiveFabrics, leave_what_moves_and_pins_as_they_are) {
    World world = make_world({.solver = {.substeps = 4}}, hung_upright());
    const ClothId id = world.cloth_id(0);
    run(world, 0.25);
    ASSERT_TRUE(world.set_pins(id, {7, 100}, {}).ok());  // other ones than the model's
    const auto copy = [](std::span<const Vec4> all) { return std::vector<Vec4>(all.begin(), all.end()); };
    const auto positions = copy(world.frame().cloths[0].positions),
               velocities = copy(world.frame().cloths[0].velocities);
    ASSERT_TRUE(set_fabric(world, id, heavy_and_soft()).ok());
    const ClothFrame& now = world.frame().cloths[0];
    EXPECT_EQ(now.model, world.model(id).get());
    for (std::uint32_t p = 0; p < positions.size(); ++p) {
        ASSERT_EQ(now.positions[p].xyz(), positions[p].xyz());
        ASSERT_EQ(now.velocities[p].xyz(), velocities[p].xyz());
        ASSERT_EQ(now.positions[p].w, p == 7 || p == 100 ? 0 : 1 / now.model->mass[p]) << p;
    }
    run(world, 0.25);
    EXPECT_EQ(world.frame().cloths[0].positions[7].xyz(), positions[7].xyz());
    ASSERT_TRUE(world.set_pins(id, {}, {}).ok());
    EXPECT_EQ(world.frame().cloths[0].positions[7].w, 1 / world.model(id)->mass[7]) << "of the new fabric";
}

TEST(LiveFabrics, of_one_cloth_leave_others_of_its_model_alone) {
    const WorldSettings settings{.solver = {.substeps = 4}};
    const auto model = make_sheet(hung_upright(settings.layout()));
    World changing = make_world(settings), still = make_world(settings);
    for (World* world : {&changing, &still}) world->add(model), world->add(model);
    for (int i = 0; i < 3; ++i) {
        run(changing, 0.1), run(still, 0.1);
        Fabric fabric = heavy_and_soft();
        fabric.body.density = 0.5f + 0.1f * static_cast<float>(i);
        ASSERT_TRUE(set_fabric(changing, changing.cloth_id(0), fabric).ok());
    }
    run(changing, 0.1), run(still, 0.1);
    const auto &a = changing.frame().cloths, &b = still.frame().cloths;
    EXPECT_EQ(a[1].model, model.get());
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        ASSERT_EQ(a[1].positions[p], b[1].positions[p]);
        ASSERT_EQ(b[0].positions[p], b[1].positions[p]);
    }
    EXPECT_NE(a[0].positions[200], b[0].positions[200]);
}

// Labels on Vulkan: long
TEST(LiveFabrics, of_every_part_show_at_once) {
    const auto height_with = [](auto&& change, bool twice) {
        World world =
            make_world({.solver = {.substeps = 4}, .air = AirDesc{}},
                       {.resolution = {9, 9}, .position = {0, 1, 0}, .pinned = [](Vec3 p) { return p.x < -0.49f; }});
        world.add(make_collider({.name = "ground", .shape = PlaneDesc{{0, 1, 0}, 0.5f}}));
        run(world, 0.1);
        Fabric fabric;
        change(fabric);
        EXPECT_TRUE(set_fabric(world, world.cloth_id(0), fabric).ok());
        if (twice) {
            EXPECT_TRUE(set_fabric(world, world.cloth_id(0), Fabric()).ok());
        }
        run(world, 0.4);
        return world.state_hash();
    };
    const std::string same = height_with([](Fabric&) {}, false);
    const auto differs = [&](auto&& change) {
        EXPECT_EQ(height_with(change, true), same) << "and back";
        return height_with(change, false) != same;
    };
    EXPECT_TRUE(differs([](Fabric& f) { f.body.density = 0.3f; }));
    EXPECT_TRUE(differs([](Fabric& f) { f.body.damping = 0; }));
    EXPECT_TRUE(differs([](Fabric& f) { f.air.drag = 4; }));
    EXPECT_TRUE(differs([](Fabric& f) { f.bend.bend[0] = 0.01f; }));
    EXPECT_TRUE(differs([](Fabric& f) { f.stretch.inextensible = true; }));
    EXPECT_TRUE(differs([](Fabric& f) { f.contact.thickness = 0.1f; }));
}

// The levels are not rebuilt here: a cloth must hang still with the levels of any other fabric.
// Labels on Vulkan: long
TEST(LiveFabrics, hang_quietly_by_coarse_levels_of_another_fabric) {
    Fabric soft = heavy_and_soft(), rigid;
    rigid.stretch.inextensible = true;
    rigid.body.density = 0.05f;
    for (const auto& [before, after] : {std::pair(soft, rigid), std::pair(rigid, soft), std::pair(Fabric(), soft)}) {
        SheetDesc sheet = hung_by_corners(24, {.lines = true, .hierarchy = true});
        sheet.fabric = before;
        World world = make_world({.solver = {.substeps = 8, .hierarchy = true}}, sheet);
        ASSERT_FALSE(world.model(world.cloth_id(0))->hierarchy.empty());
        run(world, 0.5);
        ASSERT_TRUE(set_fabric(world, world.cloth_id(0), after).ok());
        float fastest = 0;
        for (int i = 0; i < 120; ++i) {
            world.step(1.0 / 60);
            ASSERT_EQ(world.frame().reports & report_non_finite, 0u);
            for (const Vec4& v : world.frame().cloths[0].velocities) fastest = std::max(fastest, length(v.xyz()));
        }
        EXPECT_LT(fastest, 6.3f) << "it has fallen no farther than 2 m";
    }
}

TEST(LiveFabrics, change_how_stiff_plain_dynamics_are) {
    const auto run_with = [](float stiffness) {
        World world = make_world({.solver = {.substeps = 4, .method = Method::pbd}}, hung_upright());
        Fabric fabric;
        fabric.body.stiffness[0] = stiffness;
        EXPECT_TRUE(set_fabric(world, world.cloth_id(0), fabric).ok());
        run(world, 0.5);
        return sag(world);
    };
    EXPECT_GT(run_with(0.05f), run_with(1) + 0.01);
}

TEST(LiveFabrics, are_kept_by_a_state_that_is_restored) {
    World world = make_world({.solver = {.substeps = 4}}, hung_upright());
    run(world, 0.1);
    ASSERT_TRUE(set_fabric(world, world.cloth_id(0), heavy_and_soft()).ok());
    run(world, 0.1);
    const Snapshot saved = world.save();
    run(world, 0.25);
    const std::string hash = world.state_hash();
    ASSERT_TRUE(world.restore(saved).ok());
    run(world, 0.25);
    EXPECT_EQ(world.state_hash(), hash);
}

}  // namespace
}  // namespace weft::physical
