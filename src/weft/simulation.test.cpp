// The public interface.
#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ClothDesc small_sheet(Vec3 position = {}) {
    return {.mesh = GridDesc{.size = {0.5f, 0.5f}, .resolution = {9, 9}}, .transform = {.position = position}};
}

Simulation make_simulation(const WorldDesc& world = {}) {
    auto simulation = Simulation::create(world);
    EXPECT_TRUE(simulation.ok());
    return std::move(*simulation);
}

template <class T>
std::vector<std::string> messages(const Result<T>& result) {
    std::vector<std::string> all;
    if (!result)
        for (const Error& error : result.errors()) all.push_back(error.message());
    return all;
}

TEST(Simulation, is_filled_and_runs) {
    Simulation simulation = make_simulation();
    EXPECT_EQ(simulation.cloth_count(), 0u);
    simulation.step();  // an empty world can be stepped
    const auto sheet = simulation.add(small_sheet({0, 0.3f, 0}));
    const auto ball = simulation.add(ColliderDesc{.name = "ball", .shape = SphereDesc{0.2f}});
    ASSERT_TRUE(sheet.ok() && ball.ok());
    EXPECT_EQ(simulation.surface(*sheet).name, "cloth 0");
    EXPECT_EQ(simulation.surface(*sheet).positions.size(), 81u);
    EXPECT_EQ(simulation.surface(*sheet).triangles.size(), 128u);
    for (int i = 0; i < 60; ++i) simulation.step();
    EXPECT_EQ(simulation.frame(), 61u);
    EXPECT_LT(simulation.surface(*sheet).positions[0].y, 0.2f) << "its corner hangs down";
    EXPECT_GT(simulation.surface(*sheet).positions[40].y, 0.19f) << "its middle lies on the ball";
    const Measures measures = simulation.measure();
    EXPECT_GT(measures.kinetic_energy, 0);
    EXPECT_LT(measures.mean_stretch, 0.05);
    EXPECT_LT(measures.max_penetration, 0.02);
    EXPECT_THAT(simulation.reports(), testing::IsEmpty());
}

TEST(Simulation, tells_what_cloth_does_to_colliders) {
    auto made = Simulation::create({}, {.contact_forces = true});
    ASSERT_TRUE(made.ok());
    Simulation& simulation = *made;
    EXPECT_EQ(simulation.contact_forces().frame, 0u);
    const auto table =
        simulation.add(ColliderDesc{.shape = BoxDesc{{0.5f, 0.5f, 0.5f}}, .transform = {.position = {0, -0.501f, 0}}});
    // A mesh with a seam: contacts name the first vertex of each particle.
    TriangleMesh mesh{.positions = {{0, 0, 0}, {0, 0, 0.2f}, {0.2f, 0, 0}, {0.2f, 0, 0}, {0, 0, 0.2f}, {0.2f, 0, 0.2f}},
                      .triangles = {{0, 1, 2}, {3, 4, 5}}};
    const auto cloth = simulation.add({.mesh = mesh, .fabric = FabricDesc("cotton").set("density", 0.5)});
    ASSERT_TRUE(table.ok() && cloth.ok());
    for (int i = 0; i < 20; ++i) simulation.step();
    EXPECT_EQ(simulation.contact_forces().frame, 19u) << "the last frame has not been waited for";
    (void)simulation.surface(*cloth);
    const ContactForces& contact_forces = simulation.contact_forces();
    EXPECT_EQ(contact_forces.frame, 20u);
    ASSERT_EQ(contact_forces.colliders.size(), 1u);
    EXPECT_EQ(contact_forces.colliders[0].collider, *table);
    EXPECT_NEAR(contact_forces.colliders[0].force.y, -0.5 * 0.04 * 9.81, 1e-4);
    ASSERT_EQ(contact_forces.contacts.size(), 4u);
    std::vector<std::uint32_t> vertices;
    for (const Contact& contact : contact_forces.contacts) {
        EXPECT_EQ(contact.cloth, *cloth);
        EXPECT_EQ(contact.collider, *table);
        EXPECT_EQ(contact.point, simulation.surface(*cloth).positions[contact.vertex]);
        vertices.push_back(contact.vertex);
    }
    EXPECT_THAT(vertices, testing::UnorderedElementsAre(0, 1, 2, 5));

    const std::vector<std::byte> state = simulation.save_state();
    ASSERT_TRUE(simulation.restore_state(state).ok());
    EXPECT_EQ(simulation.contact_forces().frame, 0u);
    Simulation without = make_simulation();
    without.step();
    EXPECT_EQ(without.contact_forces().frame, 0u);
}

TEST(Simulation, shows_the_last_step_though_it_does_not_wait_for_it) {
    Simulation simulation = make_simulation();
    const auto sheet = simulation.add(small_sheet());
    ASSERT_TRUE(sheet.ok());
    for (std::uint64_t i = 1; i <= 5; ++i) {
        simulation.step();
        EXPECT_EQ(simulation.frame(), i);
        EXPECT_NEAR(simulation.time(), static_cast<double>(i) / 60, 1e-9);
    }
    const float y = simulation.surface(*sheet).positions[0].y;
    EXPECT_NEAR(y, -0.5 * 9.81 * 25 / 3600, 2e-3);
    EXPECT_EQ(simulation.cloth(0).positions[0].y, y);
    simulation.step();
    EXPECT_LT(simulation.cloth(0).positions[0].y, y);
}

TEST(Simulation, takes_meshes_from_memory) {
    TriangleMesh mesh{.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}}, .triangles = {{0, 1, 2}, {2, 1, 3}}};
    Simulation simulation = make_simulation();
    const auto cloth = simulation.add({.mesh = mesh, .pins = {{.select = VertexPins{{0}}}}});
    ASSERT_TRUE(cloth.ok()) << messages(cloth)[0];
    simulation.step();
    EXPECT_EQ(simulation.surface(*cloth).positions[0], (Vec3{0, 0, 0}));
    EXPECT_LT(simulation.surface(*cloth).positions[3].y, 0);

    mesh.uvs = {{0, 0}};
    EXPECT_THAT(messages(simulation.add({.mesh = mesh})),
                ElementsAre("/mesh: must have as many uvs as positions, or none, got 1 and 4"));
    mesh.uvs.clear();
    mesh.triangles[0][0] = 7;
    EXPECT_FALSE(simulation.add({.mesh = mesh}).ok());
    mesh.triangles.clear();
    EXPECT_FALSE(simulation.add({.mesh = mesh}).ok());
    mesh = {.positions = {{0, 0, 0}, {0, NAN, 1}, {1, 0, 0}}, .triangles = {{0, 1, 2}}};
    EXPECT_THAT(messages(simulation.add({.mesh = mesh}))[0], HasSubstr("vertex 1"));
    EXPECT_EQ(simulation.cloth_count(), 1u) << "what fails leaves nothing behind";
}

TEST(Simulation, starts_a_cloth_with_a_velocity) {
    Simulation simulation = make_simulation({.gravity = {}});
    ClothDesc thrown = small_sheet();
    thrown.velocity = {0, -15, 0};
    const auto cloth = simulation.add(thrown);
    ASSERT_TRUE(cloth.ok());
    simulation.step();
    EXPECT_NEAR(simulation.surface(*cloth).positions[40].y, -15.0 / 60, 1e-5);

    thrown.velocity = {NAN, 1e9f, -1e4f};
    EXPECT_THAT(messages(simulation.add(thrown)), ElementsAre("/velocity/0: must be a finite number, got nan",
                                                              "/velocity/1: must be ≤ 10000 m/s, got 1e9"));
    EXPECT_EQ(simulation.cloth_count(), 1u);
}

TEST(Simulation, describes_fabrics_by_keys) {
    Simulation simulation = make_simulation();
    ClothDesc cloth = small_sheet();
    cloth.fabric = FabricDesc("silk")
                       .set("density", 1)
                       .set("stretch", {500, 400})
                       .set("rest_angle", "mesh")
                       .set("inextensible", true);
    EXPECT_TRUE(simulation.add(cloth).ok());
    cloth.fabric = FabricDesc("slik")
                       .set("densty", 1)
                       .set("friction", {1, 2, 3})
                       .set("bend_edges", "some")
                       .set("shear", true)
                       .set("inextensible", 1.0)
                       .set("damping", -1);
    EXPECT_THAT(messages(simulation.add(cloth)),
                testing::UnorderedElementsAre("/fabric/preset: unknown fabric \"slik\"; did you mean \"silk\"?",
                                              "/fabric/densty: unknown key \"densty\"; did you mean \"density\"?",
                                              "/fabric/friction: must be one number or 2 numbers, got 3",
                                              "/fabric/bend_edges: must be \"all\" or \"no-diagonals\", got \"some\"",
                                              "/fabric/shear: must not be true or false",
                                              "/fabric/inextensible: must not be a number",
                                              "/fabric/damping: must be ≥ 0 s, got -1"));
}

TEST(Simulation, takes_limits_of_tension_as_keys) {
    Simulation simulation = make_simulation();
    ClothDesc cloth = small_sheet();
    cloth.fabric = FabricDesc("ripstop").set("strength", 100).set("tear_energy", 0).set("tear_ratio", 1);
    EXPECT_TRUE(simulation.add(cloth).ok());
    cloth.fabric = FabricDesc("ripstop").set("strength", {100, NAN}).set("tear_energy", NAN).set("tear_ratio", 0.99);
    EXPECT_THAT(messages(simulation.add(cloth)),
                testing::UnorderedElementsAre("/fabric/strength/1: must be a finite number, got nan",
                                              "/fabric/tear_energy: must be a finite number, got nan",
                                              "/fabric/tear_ratio: must be 0 or ≥ 1, got 0.99"));
}

TEST(Simulation, says_what_is_wrong_with_what_it_is_given) {
    EXPECT_THAT(messages(Simulation::create({.solver = {.substeps = 0}})),
                ElementsAre("/solver/substeps: must be ≥ 1, got 0"));
    EXPECT_THAT(messages(Simulation::create({.gravity = {0, NAN, 0}, .frame_rate = -1})), testing::SizeIs(2));
    EXPECT_THAT(messages(Simulation::create({}, {.threads = 0}))[0], HasSubstr("threads"));
    EXPECT_THAT(messages(Simulation::create({}, {.solver = {{"method", "magic"},
                                                            {"substeps", 1.5},
                                                            {"iterations", -1},
                                                            {"hierarchy", 1},
                                                            {"iteration", 1}}})),
                ElementsAre("solver/method: must be \"xpbd\" or \"pbd\", got \"magic\"",
                            "solver/substeps: must be a whole number, got 1.5",
                            "solver/iterations: must be ≥ 1, got -1", "solver/hierarchy: must not be a number",
                            "solver/iteration: unknown key \"iteration\"; did you mean \"iterations\"?"));
    EXPECT_THAT(
        messages(Simulation::create({.solver = {.method = Method::pbd}}, {.solver = {{"projection", "lines"}}})),
        ElementsAre("solver/projection: must not be \"lines\" with method \"pbd\", which has no such form"));
    Simulation simulation = make_simulation();
    ASSERT_TRUE(simulation.add(ColliderDesc{.name = "ball", .shape = SphereDesc{0.2f}}).ok());
    EXPECT_THAT(messages(simulation.add(ColliderDesc{.name = "ball", .shape = SphereDesc{-1}})),
                ElementsAre("/name: is taken: another is called \"ball\"", "/sphere/radius: must be > 0 m, got -1"));
    ClothDesc cloth = small_sheet();
    cloth.pins = {{.select = VertexPins{{0}}, .attach = "bell"}};
    EXPECT_THAT(messages(simulation.add(cloth)),
                ElementsAre("/pins/0/attach: unknown collider \"bell\"; did you mean \"ball\"?"));
    cloth.pins = {{.select = VertexPins{{81}}}};
    EXPECT_FALSE(simulation.add(cloth).ok());
    cloth = small_sheet();
    cloth.mesh = MeshFileDesc{.file = "no such file.obj"};
    EXPECT_FALSE(simulation.add(cloth).ok());
    EXPECT_FALSE(simulation.step(0).ok());
    EXPECT_FALSE(simulation.step(NAN).ok());
    EXPECT_FALSE(simulation.step(-1).ok());
    EXPECT_FALSE(simulation.set_gravity({INFINITY, 0, 0}).ok());
    EXPECT_FALSE(simulation.set_solver({.iterations = 0}).ok());
    EXPECT_FALSE(simulation.set_air(AirDesc{.density = -1}).ok());
    EXPECT_EQ(simulation.frame(), 0u);
}

TEST(Simulation, knows_no_id_that_has_been_removed) {
    Simulation simulation = make_simulation();
    const ClothId cloth = *simulation.add(small_sheet());
    const ColliderId ball = *simulation.add(ColliderDesc{.name = "ball"});
    EXPECT_EQ(simulation.find_cloth("cloth 0"), cloth);
    EXPECT_EQ(simulation.find_collider("ball"), ball);
    EXPECT_THAT(simulation.cloths(), ElementsAre(cloth));
    EXPECT_THAT(simulation.colliders(), ElementsAre(ball));
    ASSERT_TRUE(simulation.remove(cloth).ok());
    ASSERT_TRUE(simulation.remove(ball).ok());
    const ClothId other = *simulation.add(small_sheet());
    EXPECT_NE(other, cloth);
    for (const auto& result :
         {simulation.remove(cloth), simulation.remove(ball), simulation.set_fabric(cloth, {}),
          simulation.set_pins(cloth, {}), simulation.set_weights(cloth, {}), simulation.set_resistance(cloth, {}),
          simulation.move(ball, {}), simulation.set_friction(ball, 1, 1)})
        EXPECT_FALSE(result.ok());
    EXPECT_TRUE(simulation.surface(cloth).positions.empty());
    EXPECT_TRUE(simulation.tangents(cloth).empty());
    EXPECT_FALSE(simulation.find_cloth("nobody"));
    EXPECT_EQ(simulation.cloth(0).name, "cloth 0");
    EXPECT_TRUE(simulation.cloth(1).positions.empty()) << "there is one cloth";
    EXPECT_TRUE(simulation.cloth(static_cast<std::size_t>(-1)).name.empty());
}

TEST(Simulation, changes_while_it_runs) {
    Simulation simulation = make_simulation();
    ClothDesc desc = small_sheet({0, 1, 0});
    desc.pins = {{.select = VertexPins{{0, 8}}}};
    const ClothId cloth = *simulation.add(desc);
    for (int i = 0; i < 20; ++i) simulation.step();
    const Vec3 before = simulation.surface(cloth).positions[80];
    ASSERT_TRUE(simulation.set_fabric(cloth, FabricDesc("denim").set("damping", 0.3)).ok());
    EXPECT_EQ(simulation.surface(cloth).positions[80], before);
    // Release both corners, and pin another one at its current position.
    ASSERT_TRUE(simulation.set_pins(cloth, {{.select = VertexPins{{80}}}}).ok());
    for (int i = 0; i < 40; ++i) simulation.step();
    EXPECT_EQ(simulation.surface(cloth).positions[80], before);
    EXPECT_LT(simulation.surface(cloth).positions[0].y, before.y);
    ASSERT_TRUE(simulation.set_gravity({0, 9.81f, 0}).ok());
    ASSERT_TRUE(simulation.set_air(AirDesc{}).ok());
    ASSERT_TRUE(simulation.set_solver({.substeps = 8, .iterations = 2}).ok());
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(simulation.step(1.0 / 30).ok());
    EXPECT_GT(simulation.surface(cloth).positions[0].y, before.y + 0.3f) << "up is down now";
    EXPECT_LT(simulation.measure().mean_stretch, 0.05);
    const Vec3 there = simulation.surface(cloth).positions[0];
    ASSERT_TRUE(simulation.set_solver({.substeps = 4, .hierarchy = true}).ok());
    EXPECT_EQ(simulation.surface(cloth).positions[0], there) << "levels come without a jump";
    for (int i = 0; i < 10; ++i) simulation.step();
    EXPECT_LT(simulation.measure().mean_stretch, 0.02);
    // A box selects by current positions. A box without particles is an error, and the old pins stay.
    EXPECT_FALSE(simulation.set_pins(cloth, {{.select = BoxPins{{{8, 8, 8}, {9, 9, 9}}}}}).ok());
    simulation.step();
    EXPECT_EQ(simulation.surface(cloth).positions[80], before);
}

// The same simulation goes on as one that had these weights and this resistance from the start would from this state.
TEST(Simulation, changes_weights_and_resistance_while_it_runs) {
    const std::vector<WeightDesc> weights{{.of = WeightOf::density, .factor = 5, .select = VertexPins{{60, 61}}},
                                          {.of = WeightOf::thickness, .factor = 3, .select = VertexPins{{40}}}};
    const std::vector<ResistanceDesc> resistance{{.factor = 0.5f, .select = VertexPins{{20, 21}}}};
    const auto make = [&](bool from_start) {
        Simulation simulation = make_simulation();
        ClothDesc desc = small_sheet({0, 1, 0});
        desc.pins = {{.select = VertexPins{{0, 8}}}};
        desc.tearing = Tearing::split;
        if (from_start) desc.weights = weights, desc.resistance = resistance;
        EXPECT_TRUE(simulation.add(desc).ok());
        return simulation;
    };
    Simulation changed = make(false);
    const ClothId cloth = changed.cloths()[0];
    for (int i = 0; i < 20; ++i) changed.step();
    const Vec3 before = changed.surface(cloth).positions[80];
    ASSERT_TRUE(changed.set_weights(cloth, weights).ok());
    ASSERT_TRUE(changed.set_resistance(cloth, resistance).ok());
    EXPECT_EQ(changed.surface(cloth).positions[80], before);
    Simulation built = make(true);
    ASSERT_TRUE(built.restore_state(changed.save_state()).ok());
    for (int i = 0; i < 20; ++i) changed.step(), built.step();
    EXPECT_EQ(changed.state_hash(), built.state_hash());
    // What cannot be is an error, and changes nothing.
    EXPECT_EQ(changed.set_weights(cloth, {{.factor = -1, .select = VertexPins{{1}}}}).errors()[0].where,
              "/weights/0/factor");
    EXPECT_EQ(changed.set_weights(cloth, {{.factor = 2, .select = VertexPins{{99}}}}).errors()[0].where,
              "/weights/0/vertices/0");
    EXPECT_EQ(changed.set_resistance(cloth, {{.select = VertexPins{{1}}, .factors = {1, 2}}}).errors()[0].where,
              "/resistance/0/factors");
    EXPECT_EQ(changed.set_resistance(cloth, {{.factor = 2, .select = VertexPins{{99}}}}).errors()[0].where,
              "/resistance/0/vertices/0");
    changed.step(), built.step();
    EXPECT_EQ(changed.state_hash(), built.state_hash());
    Simulation whole = make_simulation();
    const ClothId other = *whole.add(small_sheet());
    EXPECT_EQ(whole.set_resistance(other, resistance).errors()[0].where, "/resistance");
}

TEST(Simulation, carries_cloth_that_is_attached_to_a_collider) {
    Simulation simulation = make_simulation({.gravity = {}});
    const ColliderId hand = *simulation.add(ColliderDesc{.name = "hand", .shape = SphereDesc{0.01f}});
    ClothDesc desc = small_sheet({0, 0.1f, 0});
    desc.pins = {{.select = VertexPins{{0}}, .attach = "hand"},
                 {.select = VertexPins{{8}}, .attach = "hand", .compliance = 1e-3f}};
    const ClothId cloth = *simulation.add(desc);
    const Vec3 corner = simulation.surface(cloth).positions[0], soft = simulation.surface(cloth).positions[8];
    for (int i = 1; i <= 60; ++i) {
        ASSERT_TRUE(simulation.move(hand, {0.01f * static_cast<float>(i), 0, 0}).ok());
        simulation.step();
    }
    EXPECT_NEAR(simulation.surface(cloth).positions[0].x, corner.x + 0.6f, 1e-5f);
    for (int i = 0; i < 120; ++i) simulation.step();
    EXPECT_NEAR(simulation.surface(cloth).positions[8].x, soft.x + 0.6f, 0.02f);
    // Attached pins stay attached after a change of fabric.
    ASSERT_TRUE(simulation.set_fabric(cloth, FabricDesc("wool")).ok());
    for (int i = 1; i <= 30; ++i) {
        ASSERT_TRUE(simulation.move(hand, {0.6f, 0.01f * static_cast<float>(i), 0}).ok());
        simulation.step();
    }
    EXPECT_NEAR(simulation.surface(cloth).positions[0].y, corner.y + 0.3f, 1e-5f);
}

TEST(Simulation, leaves_cloth_where_a_removed_collider_held_it) {
    Simulation simulation = make_simulation();
    const ColliderId hand =
        *simulation.add(ColliderDesc{.name = "hand", .shape = SphereDesc{0.01f}, .transform = {.position = {4, 3, 0}}});
    ClothDesc desc = small_sheet({4, 3, 0});
    desc.pins = {{.select = VertexPins{{0, 8}}, .attach = "hand"}};
    const ClothId cloth = *simulation.add(desc);
    for (int i = 1; i <= 5; ++i) {
        ASSERT_TRUE(simulation.move(hand, {4, 3 + 0.01f * static_cast<float>(i), 0}).ok());
        simulation.step();
    }
    const Vec3 corner = simulation.surface(cloth).positions[0];
    ASSERT_TRUE(simulation.remove(hand).ok());
    simulation.step();
    EXPECT_EQ(simulation.surface(cloth).positions[0], corner);
    ASSERT_TRUE(simulation.set_fabric(cloth, FabricDesc("denim")).ok());
    ASSERT_TRUE(simulation.set_solver({.substeps = 10, .hierarchy = false}).ok());
    for (int i = 0; i < 5; ++i) simulation.step();
    EXPECT_LT(length(simulation.surface(cloth).positions[0] - corner), 1e-5f);
}

TEST(Simulation, reads_meshes_as_it_is_told_to) {
    Simulation without = make_simulation();
    EXPECT_THAT(messages(without.add({.mesh = MeshFileDesc{.file = "shirt.obj"}})),
                ElementsAre("/mesh/file: shirt.obj: cannot be read: this program reads no mesh files "
                            "(Options::read_mesh is empty)"));
    Options options;
    options.read_mesh = [](const std::string& file, const std::filesystem::path& folder) -> Result<TriangleMesh> {
        EXPECT_TRUE(folder.empty());
        if (file != "shirt.obj") return Error{file, "is not in the archive"};
        return TriangleMesh{.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, .triangles = {{0, 1, 2}}};
    };
    auto with = Simulation::create({}, options);
    ASSERT_TRUE(with.ok());
    const auto cloth = with->add({.mesh = MeshFileDesc{.file = "shirt.obj", .scale = 2}});
    ASSERT_TRUE(cloth.ok());
    EXPECT_EQ(with->surface(*cloth).positions[2], (Vec3{2, 0, 0}));
    EXPECT_THAT(messages(with->add({.mesh = MeshFileDesc{.file = "hat.obj"}})),
                ElementsAre("/mesh/file: hat.obj: is not in the archive"));
}

TEST(Simulation, comes_back_to_a_saved_state) {
    Simulation simulation = make_simulation();
    ASSERT_TRUE(simulation.add(small_sheet({0, 0.3f, 0})).ok());
    ASSERT_TRUE(simulation.add(ColliderDesc{.shape = SphereDesc{0.2f}}).ok());
    for (int i = 0; i < 20; ++i) simulation.step();
    const auto state = simulation.save_state();
    const std::string then = simulation.state_hash();
    const Vec3 corner = simulation.cloth(0).positions[0];
    for (int i = 0; i < 20; ++i) simulation.step();
    const std::string later = simulation.state_hash();
    ASSERT_TRUE(simulation.restore_state(state).ok());
    EXPECT_EQ(simulation.state_hash(), then);
    EXPECT_EQ(simulation.cloth(0).positions[0], corner) << "surfaces too";
    for (int i = 0; i < 20; ++i) simulation.step();
    EXPECT_EQ(simulation.state_hash(), later);
    EXPECT_FALSE(simulation.restore_state(std::span(state).first(100)).ok());
    EXPECT_FALSE(make_simulation().restore_state(state).ok());
    EXPECT_EQ(simulation.state_hash(), later);
}

TEST(Simulation, gives_tangents_along_the_warp) {
    Simulation simulation = make_simulation({.gravity = {}});
    ClothDesc desc = small_sheet();
    desc.transform.rotation_degrees = {0, 0, 90};
    const ClothId cloth = *simulation.add(desc);
    simulation.step();
    const auto tangents = simulation.tangents(cloth);
    ASSERT_EQ(tangents.size(), 81u);
    for (const Vec4& t : tangents) {
        EXPECT_NEAR(t.y, 1, 1e-4f) << "x, turned up";
        EXPECT_EQ(std::abs(t.w), 1);
    }
    desc.mesh = SphereMeshDesc{.radius = 0.1f, .subdivisions = 1};
    EXPECT_TRUE(simulation.tangents(*simulation.add(desc)).empty()) << "no UVs, no tangents";
}

}  // namespace
}  // namespace weft
