// Wind sources in a world: forces on panels, shelter, and the same bits on all threads and both backends.

#include "backend_runs.h"

#include "collide/convex_hull.h"
#include "collide/distance_field.h"
#include "mesh/procedural.h"

#include <numbers>

namespace weft::physical {
namespace {

constexpr float area = 0.0004f, panel_density = 200;  // m², kg/m²: it hardly moves within a frame

// A panel of 2 cm that faces the wind.
std::shared_ptr<const ClothModel> panel(Vec3 position, Vec3 facing) {
    SheetDesc sheet{.size = {0.02f, 0.02f}, .resolution = {3, 3}, .position = position};
    sheet.fabric.body.density = panel_density;
    // From the normal y to `facing`.
    const Vec3 n = normalized(facing);
    sheet.rotation_degrees = {0, std::atan2(n.x, n.z) * 180 / std::numbers::pi_v<float>, 0};
    const float tilt = std::acos(n.y) * 180 / std::numbers::pi_v<float>;
    const Mat3 turn = rotation_from_degrees(sheet.rotation_degrees) * rotation_from_degrees({tilt, 0, 0});
    sheet.rotation_degrees = {};
    sheet.shape = [turn](Vec3 p) { return turn * p; };
    return make_sheet(sheet);
}

// N: what the wind does to a panel that faces its velocity `expected`, along that.
double force(const AirDesc& air, Vec3 position, Vec3 expected, const std::vector<Collider>& colliders = {}) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 1}, .air = air}, CpuOptions{});
    for (const Collider& collider : colliders) world.add(collider);
    world.add(panel(position, expected));
    constexpr double dt = 1.0 / 60;
    world.step(dt);
    Vec3 momentum;
    const ClothFrame& cloth = world.frame().cloths[0];
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p)
        momentum = momentum + cloth.velocities[p].xyz() * cloth.model->mass[p];
    return static_cast<double>(dot(momentum, normalized(expected))) / dt;
}

double pressure_force(const AirDesc& air, double speed) {
    return 0.5 * static_cast<double>(air.density) * 1.28 * speed * speed * static_cast<double>(area);
}

TEST(WindSources, push_a_panel_with_the_dynamic_pressure_at_nine_places) {
    const AirDesc breeze{.wind = {{.velocity = {4, 1, -2}}}};
    const AirDesc fan{.wind = {{.kind = JetDesc{0.5f}, .velocity = {0, 0, 12}, .transform = {.position = {0, 1, 0}}}}};
    const AirDesc devil{.wind = {{.kind = VortexDesc{.swirl = 8, .inflow = 3, .radius = 0.5f}, .velocity = {0, 2, 0}}}};
    AirDesc tunnel = breeze;
    tunnel.wind[0].box = WindBoxDesc{.half_extents = {1, 1, 1}, .border = 0.5f};
    const auto of_jet = [](Vec3 p) {
        const double x = p.z, r = std::hypot(double{p.x}, double{p.y} - 1), d = 0.5;
        return Vec3{0, 0, static_cast<float>(12 * std::min(1.0, 6 * d / x) * std::exp2(-std::pow(r / (0.1 * x), 2)))};
    };
    const auto of_vortex = [](Vec3 p) {
        const double alpha = 1.2564312086, r = std::hypot(double{p.x}, double{p.z});
        const double part = (1 + 0.5 / alpha) * (0.5 / r) * (1 - std::exp(-alpha * r * r / 0.25));
        const float around = static_cast<float>(8 * part / r), inward = static_cast<float>(-3 * part / r);
        return Vec3{around * p.z + inward * p.x, static_cast<float>(2 * std::exp(-alpha * r * r / 0.25)),
                    -around * p.x + inward * p.z};
    };
    double worst[4] = {};
    for (int i = 0; i < 9; ++i) {
        const float a = static_cast<float>(i % 3 - 1), b = static_cast<float>(i / 3 - 1);
        const auto check = [&](int source, const AirDesc& air, Vec3 at, Vec3 wind) {
            const double expected = pressure_force(air, length(wind));
            const double error = std::abs(force(air, at, wind) / expected - 1);
            worst[source] = std::max(worst[source], error);
            EXPECT_LT(error, 0.01) << source << ": " << at.x << ' ' << at.y << ' ' << at.z;
        };
        const Vec3 in_jet{0.2f * a, 1 + 0.1f * b, 5 + a + b}, in_vortex{0.5f + 0.3f * a, b, 0.2f + 0.3f * b};
        check(0, breeze, {a, b, a * b}, {4, 1, -2});
        check(1, fan, in_jet, of_jet(in_jet));
        check(2, devil, in_vortex, of_vortex(in_vortex));
        check(3, tunnel, Vec3{a, b, a} * 0.9f, {4, 1, -2});
    }
    std::printf(
        "  largest error of the force on a panel: directional %.3f %%, jet %.3f %%, vortex %.3f %%, box %.3f %%\n",
        100 * worst[0], 100 * worst[1], 100 * worst[2], 100 * worst[3]);
    EXPECT_NEAR(force(tunnel, {1.6f, 0, 0}, {1, 0, 0}), 0, 1e-9) << "outside of the box";
    EXPECT_NEAR(force(tunnel, {1.25f, 0, 0}, {4, 1, -2}) / pressure_force(tunnel, 0.5 * std::sqrt(21.0)), 1, 0.01);
    EXPECT_NEAR(force(fan, {0, 1, -0.1f}, {0, 0, 1}), 0, 1e-9) << "behind the nozzle";
}

TEST(WindSources, of_two_push_with_the_pressure_of_their_sum) {
    const AirDesc both{.wind = {{.velocity = {0, 0, 3}},
                                {.kind = JetDesc{1}, .velocity = {0, 0, 4}, .transform = {.position = {0, 0, -1}}}}};
    EXPECT_NEAR(force(both, {0, 0, 0}, {0, 0, 1}) / pressure_force(both, 7), 1, 0.01);
}

// A wall across the wind at x = 0.
std::vector<Collider> wall() {
    return {make_collider({.shape = BoxDesc{{0.02f, 0.5f, 0.5f}}})};
}

TEST(Shelter, behind_a_wall_leaves_no_force) {
    for (const WindDesc& source :
         {WindDesc{.velocity = {6, 0, 0}, .shelter = 1},
          WindDesc{.kind = JetDesc{2}, .velocity = {6, 0, 0}, .transform = {.position = {-1, 0, 0}}, .shelter = 1}}) {
        const AirDesc air{.wind = {source}};
        const double open = pressure_force(air, 6);
        const auto part = [&](Vec3 p, const std::vector<Collider>& colliders) {
            return force(air, p, {1, 0, 0}, colliders) / open;
        };
        for (int i = 0; i < 9; ++i) {
            const Vec3 p{0.1f + 0.1f * static_cast<float>(i), 0.1f * static_cast<float>(i % 3), -0.2f};
            EXPECT_LT(std::abs(part(p, wall())), 0.05) << p.x;
            EXPECT_GT(part(p, {}), 0.9);
            EXPECT_GT(part({-p.x, p.y, p.z}, wall()), 0.9) << "in front of it";
        }
        EXPECT_GT(part({1.1f, 0, 0}, wall()), 0.9) << "farther away than the shelter";
        EXPECT_GT(part({0.5f, 0.6f, 0}, wall()), 0.9) << "above the wall";
    }
    const AirDesc open{.wind = {{.velocity = {6, 0, 0}}}};
    EXPECT_NEAR(force(open, {0.5f, 0, 0}, {1, 0, 0}, wall()) / pressure_force(open, 6), 1, 0.01) << "off by default";
}

TEST(Shelter, follows_a_wall_that_moves) {
    const AirDesc air{.wind = {{.velocity = {6, 0, 0}, .shelter = 1}}};
    for (const bool away : {false, true}) {
        World world = make_world({.gravity = {}, .air = air}, CpuOptions{});
        world.add(make_collider({.shape = BoxDesc{{0.02f, 0.5f, 0.5f}},
                                 .motion = {{0, {0, 0, 0}, {}}, {0.5f, {0, away ? 5.0f : 0.1f, 0}, {}}}}));
        world.add(panel({0.5f, 0, 0}, {1, 0, 0}));
        run(world, 1);
        const float speed = world.frame().cloths[0].velocities[4].x;
        EXPECT_EQ(speed > 1e-3f, away) << speed;
        EXPECT_EQ(speed == 0, !away);
    }
}

// All kinds, with all options.
AirDesc lively_air() {
    const GustDesc gust{.amplitude = 0.4f, .frequency = 1.3f, .scale = 0.7f};
    const TurbulenceDesc turbulence{.strength = 0.5f, .scale = 0.3f, .period = 0.4f};
    return {.wind = {{.velocity = {3, 0.4f, 1}, .shelter = 2, .gust = gust, .turbulence = turbulence},
                     {.kind = JetDesc{0.2f},
                      .velocity = {9, 0, 0},
                      .transform = {.position = {-1.5f, 0.1f, 0}},
                      .motion = {{.time = 0, .position = {-1.5f, 0, 0}},
                                 {.time = 0.2f, .position = {-1.2f, 0.3f, 0}, .rotation_degrees = {0, 30, -10}}},
                      .shelter = 0.7f,
                      .gust = gust,
                      .turbulence = turbulence,
                      .seed = 3},
                     {.kind = VortexDesc{.swirl = 5, .inflow = 1, .radius = 0.4f},
                      .velocity = {0, 3, 0},
                      .transform = {.rotation_degrees = {10, 0, 20}},
                      .box = WindBoxDesc{.half_extents = {0.3f, 2, 0.5f}, .border = 0.3f},
                      .gust = gust,
                      .turbulence = turbulence,
                      .seed = 5}}};
}

void add_scene(World& world) {
    world.add(make_collider({.shape = SphereDesc{0.3f}, .transform = {.position = {-0.6f, 0, 0}}}));
    world.add(make_collider({.shape = BoxDesc{{0.1f, 0.3f, 0.2f}},
                             .transform = {.position = {0.9f, 0, 0.5f}, .rotation_degrees = {0, 30, 10}},
                             .motion = {{0, {0.9f, 0, 0.5f}, {}}, {0.3f, {-0.9f, 0, 0.5f}, {0, 90, 0}}}}));
    world.add(make_collider({.shape = PlaneDesc{.offset = -0.8f}}));
    const TriangleMesh block = make_box({0.3f, 0.5f, 0.4f}, {2, 2, 2}), ball = make_sphere(0.25f, 3);
    world.add(make_collider({.shape = ConvexDesc{}, .transform = {.position = {-0.9f, 0.5f, -0.5f}}},
                            std::make_shared<ShapeData>(make_convex_data(*convex_hull(block.positions)))));
    auto field = build_distance_field(ball.positions, ball.triangles, {.cells = 24, .threads = 1});
    world.add(make_collider({.shape = SolidMeshDesc{}, .transform = {.position = {-0.9f, -0.4f, 0.6f}}},
                            std::make_shared<ShapeData>(std::move(field->data))));
    world.add(make_sheet({.resolution = {21, 17}, .rotation_degrees = {70, 5, 0}, .pinned = [](Vec3 p) {
                              return p.z < -0.49f && std::abs(p.x) > 0.49f;
                          }}));
}

TEST(WindSources, give_the_same_bits_on_any_number_of_threads) {
    std::string expected;
    for (const unsigned workers : {0u, 1u, 2u, 3u}) {
        World world = make_world({.solver = {.substeps = 5}, .air = lively_air()}, {.workers = workers});
        add_scene(world);
        run(world, 0.5);
        EXPECT_EQ(world.frame().reports, report_none);
        if (expected.empty()) expected = world.state_hash();
        EXPECT_EQ(world.state_hash(), expected) << workers;
    }
}

TEST(WindSources, that_are_all_the_fastest_never_carry_cloth_faster_than_themselves) {
    // 1e4 m/s each, a hundred times as strong, in gusts.
    const std::vector<WindKey> strong{{.time = 0, .strength = 100}};
    const AirDesc air{.density = 1e4f,
                      .wind = {{.velocity = {1e4f, 0, 0}, .motion = strong},
                               {.kind = JetDesc{3}, .velocity = {1e4f, 0, 0}, .motion = strong},
                               {.kind = VortexDesc{.swirl = 1e4f}, .velocity = {0, 1e4f, 0}, .motion = strong}}};
    double most = 0;
    for (const WindDesc& wind : air.wind) most += top_speed(wind);
    for (const std::uint32_t substeps : {1u, 3u, 20u}) {
        for (const bool pinned : {true, false}) {
            SheetDesc sheet{.rotation_degrees = {90, 40, 0}};
            if (pinned) sheet.pinned = [](Vec3 p) { return p.x < -0.49f; };
            sheet.fabric.body.density = 0.01f;
            World world = make_world({.gravity = {}, .solver = {.substeps = substeps}, .air = air}, sheet);
            for (int frame = 0; frame < 30; ++frame) {
                world.step(1.0 / 60);
                ASSERT_TRUE(all_finite(world.frame())) << substeps << ' ' << frame;
                ASSERT_LE(max_speed(world.frame()), most * 1.001);
            }
        }
    }
}

#ifdef WEFT_VULKAN
// Fails if the two backends do not give the same bits in one of these airs, each from the start, on devices that round
// as the CPU does.
void expect_same_bits(const std::vector<AirDesc>& airs, const std::function<void(World&)>& add, int frames) {
    const WorldSettings settings{.solver = {.substeps = 2}, .air = airs[0]};
    World cpu = on_cpu(settings), vulkan = on_vulkan(settings);
    add(cpu), add(vulkan);
    const Snapshot start = cpu.save();
    for (const AirDesc& air : airs) {
        for (World* world : {&cpu, &vulkan}) {
            WorldSettings now = settings;
            now.air = air;
            world->configure(now);
            ASSERT_TRUE(world->restore(start).ok());
            run(*world, frames / 60.0);
            EXPECT_TRUE(all_finite(world->frame()));
        }
        if (!rounds_like_the_cpu(vulkan)) continue;
        EXPECT_EQ(cpu.state_hash(), vulkan.state_hash()) << "air " << &air - airs.data();
    }
}

// Labels: slow no-asan
TEST(WindSources, are_the_same_on_both_backends) {
    std::vector<AirDesc> airs{lively_air()};
    // One kind at a time, so that none hides behind the others.
    for (const WindDesc& wind : lively_air().wind) airs.push_back({.wind = {wind}});
    expect_same_bits(airs, add_scene, 15);
}

// Labels: slow no-asan long
TEST(WindSources, are_the_same_on_both_backends_where_they_degenerate) {
    const std::vector<WindKey> strong{{.time = 0, .strength = 100}};
    const WindBoxDesc speck{.half_extents = {1e-6f, 1e-6f, 1e-6f}, .border = 0},
        huge{.half_extents = {1e6f, 1e6f, 1e6f}};
    const std::vector<AirDesc> airs{
        {.wind = {{.kind = JetDesc{1e-6f}, .velocity = {1e4f, 0, 0}, .motion = strong}}},
        {.wind = {{.kind = JetDesc{1e6f}, .velocity = {0, 1e-30f, 0}, .shelter = 1e6f}}},
        {.wind = {{.kind = VortexDesc{1e4f, -1e4f, 1e-6f}, .velocity = {0, 1e4f, 0}, .motion = strong}}},
        {.wind = {{.kind = VortexDesc{0, 0, 1e6f}, .box = huge, .shelter = 1e-6f}}},
        {.wind = {{.velocity = {1e4f, 1e4f, 1e4f}, .motion = strong, .box = speck, .shelter = 1e6f}}},
        {.wind = {{.velocity = {1, 0, 0}, .transform = {.position = {1e6f, 1e6f, 1e6f}}, .box = huge}}},
    };
    const auto add = [](World& world) {
        add_scene(world);
        // Tiny triangles, on the axis and in the nozzle.
        world.add(make_sheet({.size = {1e-4f, 1e-4f}, .resolution = {3, 3}}));
    };
    expect_same_bits(airs, add, 3);
}

// Labels: slow no-asan
TEST(WindSources, may_be_many_and_change_while_the_world_moves) {
    AirDesc air;
    for (int i = 0; i < 100; ++i)
        air.wind.push_back({.kind = JetDesc{0.1f},
                            .velocity = {1, 0, 0},
                            .transform = {.position = {-1, 0.02f * static_cast<float>(i - 50), 0}}});
    World cpu = on_cpu({.solver = {.substeps = 2}, .air = air}),
          vulkan = on_vulkan({.solver = {.substeps = 2}, .air = air});
    for (World* world : {&cpu, &vulkan}) {
        add_scene(*world);
        run(*world, 0.1);
        {
            WorldSettings s = world->settings();
            s.air = lively_air();
            world->configure(s);
        }
        run(*world, 0.1);
        {
            WorldSettings s = world->settings();
            s.air = AirDesc{.wind = {{.velocity = {1, 0, 0}}}};
            world->configure(s);
        }
        run(*world, 0.1);
    }
    EXPECT_TRUE(all_finite(vulkan.frame()));
    if (!rounds_like_the_cpu(vulkan)) return;
    EXPECT_EQ(cpu.state_hash(), vulkan.state_hash());
}
#endif

}  // namespace
}  // namespace weft::physical
