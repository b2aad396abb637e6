// Input without a valid solution: the result is finite, and the report names the cause.
// src/files/malformed.test.cpp tests malformed files.

#include "malformed_meshes.h"
#include "sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace weft::physical {
namespace {

class Malformed : public testing::Test {
  protected:
    // Fewer frames on a device, where each takes a hundred times as long in software.
    void step_and_check(World& world, double dt, int frames = 20) {
        if (world.backend().name() != "cpu") frames = std::min(frames, 6);
        for (int i = 0; i < frames; ++i) {
            reports |= world.step(dt).reports;
            ASSERT_TRUE(all_finite(world.frame())) << "frame " << i;
            for (const Vec4& n : world.frame().cloths[0].normals) ASSERT_TRUE(finite(n.xyz()));
        }
    }
    std::uint32_t reports = 0;
};

constexpr std::array models = {BendModel::dihedral, BendModel::plate, BendModel::distance, BendModel::moment};

const SheetDesc hung_by_edge{.pinned = [](Vec3 p) { return p.z < -0.49f; }};

// One world for all cases of a test: a device compiles its shaders for each world anew, which takes seconds.
// Labels on Vulkan: long
TEST_F(Malformed, absurd_time_steps) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}, .transform = {}}));
    for (const double dt : {1e-9, 1e-3, 1.0, 10.0, 1e6}) {
        const ClothId sheet = world.add(make_sheet(hung_by_edge));
        step_and_check(world, dt);
        world.remove(sheet);
    }
}

TEST_F(Malformed, enormous_gravity) {
    World world = make_world({.gravity = {0, -1e6f, 0}}, hung_by_edge);
    step_and_check(world, 1.0 / 60);
    EXPECT_TRUE(reports & report_speed_capped);
}

TEST_F(Malformed, gravity_that_is_no_number_is_caught_and_named) {
    for (const float g : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        World world = make_world({.gravity = {0, g, 0}}, hung_by_edge);
        const auto before = world.state_hash();
        step_and_check(world, 1.0 / 60, 3);
        EXPECT_TRUE(reports & report_non_finite);
        EXPECT_EQ(world.state_hash(), before) << "the cloth is where it was";
        EXPECT_EQ(world.frame().cloths[0].detail, "gravity is not finite");
        EXPECT_TRUE(std::isfinite(world.stretch_residual().max));
        EXPECT_TRUE(world.restore(world.save()).ok()) << "a state of it is one to come back to";
    }
}

TEST_F(Malformed, one_cloth_among_many_is_held_and_the_others_go_on) {
    World world = make_world({}, CpuOptions{1, ""});
    const auto model = make_sheet(hung_by_edge);
    std::uint32_t pinned = 0;
    while (model->start[pinned].w != 0) ++pinned;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (int i = 0; i < 5; ++i) {
        KinematicTargets targets;
        if (i == 2) targets = {.motions = {{.offsets = {{0, {nan, 0, 0}}}}}, .particles = {{pinned, 0, {}}}};
        world.add(model, targets);
    }
    const std::vector<Vec4> before(world.frame().cloths[2].positions.begin(), world.frame().cloths[2].positions.end());
    for (int frame = 0; frame < 3; ++frame) world.step(1.0 / 60);
    for (std::size_t i = 0; i < 5; ++i) {
        const ClothFrame& cloth = world.frame().cloths[i];
        EXPECT_EQ(cloth.reports, i == 2 ? report_non_finite : report_none) << i;
        EXPECT_EQ(cloth.detail, i == 2 ? "the motion of a pin is not finite" : "") << i;
        EXPECT_EQ(std::ranges::equal(cloth.positions, before), i == 2) << i;
    }
    EXPECT_EQ(world.frame().reports, report_non_finite);
}

TEST_F(Malformed, a_collider_that_is_no_number_is_named) {
    World world = make_world({}, hung_by_edge);
    world.add(make_collider({.name = "ghost", .shape = SphereDesc{std::numeric_limits<float>::quiet_NaN()}}));
    Collider lost = make_collider({.name = "lost", .shape = SphereDesc{0.1f}});
    lost.pose.position.x = std::numeric_limits<float>::quiet_NaN();
    world.add(lost);
    step_and_check(world, 1.0 / 60, 3);
}

TEST_F(Malformed, everything_pinned_and_nothing_pinned) {
    World all = make_world({}, {.pinned = [](Vec3) { return true; }});
    const auto before = all.state_hash();
    step_and_check(all, 1.0 / 60);
    EXPECT_EQ(all.state_hash(), before);
    World nothing = make_world({}, {.fabric = {}});
    step_and_check(nothing, 1.0 / 60);
}

// Labels on Vulkan: long
TEST_F(Malformed, extreme_fabrics) {
    World world = make_world({});
    world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}, .transform = {.position = {0, -0.1f, 0}}}));
    for (const float density : {1e-6f, 1e4f}) {
        for (const float stiffness : {0.0f, 1e-6f, 1e9f}) {
            Fabric fabric;
            fabric.body.density = density;
            fabric.stretch = {.stretch = {stiffness, stiffness}, .compression = {stiffness, 0}, .shear = stiffness};
            fabric.bend = {.bend = {stiffness, 0, stiffness}};
            const ClothId sheet = world.add(make_sheet({.fabric = fabric, .pinned = hung_by_edge.pinned}));
            step_and_check(world, 1.0 / 60);
            world.remove(sheet);
        }
    }
}

TriangleMesh scaled(TriangleMesh mesh, float scale, Vec3 offset) {
    for (Vec3& p : mesh.positions) p = p * scale + offset;
    return mesh;
}

// Labels on Vulkan: no-asan long
TEST_F(Malformed, meshes_by_every_method) {
    const TriangleMesh grid = make_grid({1, 1}, {5, 5}, GridDiagonal::cross);
    const TriangleMesh meshes[] = {messy_mesh(),
                                   folded_mesh(),
                                   needle_mesh(),
                                   scaled(grid, 1e-4f, {0, 0, 0}),
                                   scaled(grid, 1e6f, {0, 0, 0}),
                                   scaled(grid, 1, {1e6f, 0, 0})};
    int followed = 0;
    World world = make_world({.air = AirDesc{.wind = {{.velocity = {10, 0, 0}}}}});
    world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}}));
    for (int choice = 0; choice < 12; ++choice) {
        WorldSettings settings = world.settings();
        settings.solver = {.substeps = 5,
                           .iterations = 2,
                           .method = choice & 1 ? Method::pbd : Method::xpbd,
                           .projection = choice & 2 ? Projection::jacobi : Projection::gauss_seidel};
        world.configure(settings);
        for (const TriangleMesh& mesh : meshes) {
            Fabric fabric;
            fabric.bend.model = models[static_cast<std::size_t>(choice / 4)];
            fabric.tether.use = Tethers::on;
            auto topology = build_topology(mesh);
            if (!topology) continue;  // far from the origin all vertices round to the same position
            auto model = build_cloth_model({.name = "malformed",
                                            .mesh = mesh,
                                            .fabric = fabric,
                                            .pins = {.particles = {0}, .attachments = {{1, 1e-3f, {0, 1, 0}}}}},
                                           std::move(*topology));
            ASSERT_TRUE(model.ok()) << model.error().message();
            const ClothId cloth = world.add(*model);
            step_and_check(world, 1.0 / 60);
            world.remove(cloth);
            ++followed;
        }
    }
    EXPECT_GE(followed, 5 * 12);
}

// Equal positions in a mesh are one particle; two can still meet later.
TEST_F(Malformed, particles_in_one_place_by_every_method) {
    World world = make_world({});
    for (int choice = 0; choice < 12; ++choice) {
        SheetDesc sheet = hung_by_edge;
        sheet.fabric.bend.model = models[static_cast<std::size_t>(choice / 4)];
        WorldSettings settings = world.settings();
        settings.solver = {.substeps = 5,
                           .method = choice & 1 ? Method::pbd : Method::xpbd,
                           .projection = choice & 2 ? Projection::jacobi : Projection::gauss_seidel};
        world.configure(settings);
        const ClothId cloth = world.add(make_sheet(sheet));
        for (const bool everything : {false, true}) {
            Snapshot snapshot = world.save();
            auto& positions = snapshot.cloths[0].position;
            for (std::size_t p = 20; p < (everything ? positions.size() : 22); ++p) positions[p] = positions[40];
            ASSERT_TRUE(world.restore(snapshot).ok());
            step_and_check(world, 1.0 / 60);
            EXPECT_FALSE(reports & report_non_finite);
        }
        world.remove(cloth);
    }
}

TEST_F(Malformed, cloth_held_by_springs_alone_however_soft) {
    World world = make_world({});
    for (const float compliance : {1e-12f, 1e6f}) {
        for (const Method method : {Method::xpbd, Method::pbd}) {
            for (const Projection projection : {Projection::gauss_seidel, Projection::jacobi}) {
                WorldSettings settings = world.settings();
                settings.solver = {.substeps = 5, .iterations = 2, .method = method, .projection = projection};
                world.configure(settings);
                for (const double dt : {1e-9, 1.0 / 60, 10.0}) {
                    const ClothId sheet =
                        world.add(make_sheet({.resolution = {5, 5}, .spring = [=](Vec3) { return compliance; }}));
                    step_and_check(world, dt);
                    EXPECT_FALSE(reports & report_non_finite) << compliance << ' ' << dt;
                    world.remove(sheet);
                }
            }
        }
    }
}

// Each has a correct checksum; only its values are wrong.
TEST_F(Malformed, saved_states_of_no_world) {
    World world = make_world({.solver = {.substeps = 5}}, hung_by_edge);
    world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}}));
    world.step(1.0 / 60);
    const auto before = world.state_hash();
    const Snapshot good = world.save();
    const auto refusal = [&](auto&& spoil) {
        Snapshot bad = good;
        spoil(bad);
        const auto read = snapshot_from_bytes(to_bytes(bad));
        EXPECT_TRUE(read.ok());
        const auto restored = world.restore(*read);
        EXPECT_EQ(world.state_hash(), before);
        return restored ? "none" : restored.error().message();
    };
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(refusal([](Snapshot&) {}), "none");
    const std::string particle = "state: cloth 0: particle 7 must have finite numbers of at most 1e18";
    EXPECT_EQ(refusal([](Snapshot& s) { s.cloths[0].position[7].y = nan; }), particle);
    EXPECT_EQ(refusal([](Snapshot& s) { s.cloths[0].velocity[7].w = infinity; }), particle);
    EXPECT_EQ(refusal([](Snapshot& s) { s.cloths[0].start[7].x = -1e30f; }), particle);
    EXPECT_EQ(refusal([](Snapshot& s) { s.cloths[0].compensation[7].z = nan; }), particle);
    EXPECT_EQ(refusal([](Snapshot& s) { s.cloths[0].kept[3] = nan; }), "state: cloth 0: constraint 3 must be finite");
    EXPECT_EQ(refusal([](Snapshot& s) { s.cloths[0].substep_seconds = nan; }),
              "state: cloth 0: its substep must be finite and ≥ 0 s");
    EXPECT_EQ(refusal([](Snapshot& s) { s.time = infinity; }), "state: its time must be finite and ≥ 0 s");
    const std::string collider = "state: collider 0 must have a rotation and a finite position";
    EXPECT_EQ(refusal([](Snapshot& s) { s.colliders[0].position.x = nan; }), collider);
    EXPECT_EQ(refusal([](Snapshot& s) { s.colliders[0].rotation.y = {}; }), collider);

    Snapshot far = good;  // at the limit of the range
    for (Vec4& p : far.cloths[0].position) p = {1e18f, -p.y, 1e18f * p.z, 0};
    for (Vec4& v : far.cloths[0].velocity) v = {-1e18f, 1e18f, 0, 1e18f};
    ASSERT_TRUE(world.restore(far).ok());
    step_and_check(world, 1.0 / 60);
}

TEST(Model, refuses_values_that_no_simulation_could_follow) {
    const TriangleMesh mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::uniform);
    for (const float density : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), 1e-44f}) {
        ClothModelDesc desc{.name = "x", .mesh = mesh};
        desc.fabric.body.density = density;
        EXPECT_FALSE(build_cloth_model(desc, *build_topology(mesh)).ok()) << density;
    }
    ClothModelDesc desc{.name = "x", .mesh = mesh, .fabric = {}, .pins = {.particles = {9}}};
    EXPECT_FALSE(build_cloth_model(desc, *build_topology(mesh)).ok());
}

}  // namespace
}  // namespace weft::physical
