// The same scene gives the same bits, whatever the number of threads and the instruction set.
// Labels of this file: threads no-asan

#include "sheet.h"

#include <numeric>

namespace weft::physical {
namespace {

// Changes with every bit of the result. After an intended change of the physics, put the new hash here and note the
// change in CHANGELOG.md. An unintended change is a bug.
constexpr const char* golden = "4058cb0ff7421a69";

std::string drape(const CpuOptions& options, std::uint32_t iterations, BendModel bend = BendModel::moment,
                  StretchModel stretch = StretchModel::edges) {
    Fabric silk = find_fabric("silk")->fabric;
    silk.bend.model = bend;
    silk.stretch.model = stretch;
    World world = make_world({.solver = {.substeps = 10, .iterations = iterations}}, options);
    world.add(make_sheet({.size = {1, 1},
                          .resolution = {40, 37},
                          .position = {0.01f, 0.4f, 0.02f},
                          .fabric = silk,
                          .pinned = [](Vec3 p) { return p.x < -0.49f && p.z < -0.49f; }}));
    world.add(make_sheet({.size = {0.4f, 0.4f},
                          .resolution = {12, 12},
                          .diagonal = GridDiagonal::cross,
                          .rotation_degrees = {10, 20, 30},
                          .position = {0, 0.6f, 0}}));
    world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}, .transform = {.position = {0, 0, 0}}}));
    world.add(make_collider({.name = "slope", .shape = PlaneDesc{{0.2f, 1, 0}, -0.3f}}));
    run(world, 0.4);
    return world.state_hash();
}

TEST(Determinism, threads_and_instruction_sets_give_the_golden_bits) {
    for (std::string_view isa : cpu_instruction_sets()) {
        for (const unsigned workers : {0u, 1u, 2u, 4u}) {
            EXPECT_EQ(drape({workers, std::string(isa)}, 1), golden) << isa << " with " << workers << " workers";
        }
    }
}

// Labels: slow no-asan long
TEST(Determinism, holds_with_iterations_too) {
    const std::string expected = drape({0, "scalar"}, 3);
    EXPECT_NE(expected, golden);
    for (std::string_view isa : cpu_instruction_sets()) {
        for (const unsigned workers : {1u, 4u}) EXPECT_EQ(drape({workers, std::string(isa)}, 3), expected);
    }
}

// All threads search for sticking particles, each in its own part.
TEST(Determinism, holds_where_cloth_sticks_to_colliders) {
    const auto fall = [](unsigned workers, std::uint32_t capacity) {
        World world = make_world({.solver = {.substeps = 5}, .list_capacity = capacity}, CpuOptions{workers});
        for (const float x : {-0.2f, 0.2f}) {
            Collider ball =
                make_collider({.name = "ball", .shape = SphereDesc{0.1f}, .transform = {.position = {x, 0, 0}}});
            ball.adhesion = Adhesion{0.01f, 1e-4f};
            world.add(std::move(ball));
        }
        world.add(make_sheet({.resolution = {40, 37}, .position = {0.01f, 0.15f, 0.02f}}));
        world.add(make_sheet({.size = {0.4f, 0.4f}, .resolution = {12, 12}, .position = {0, 0.2f, 0}}));
        run(world, 0.3);
        EXPECT_GT(world.frame().lists.rows, 0u);
        return world.state_hash();
    };
    const std::string expected = fall(0, 4096);
    for (const unsigned workers : {0u, 1u, 3u}) EXPECT_EQ(fall(workers, 1), expected) << workers << " workers";
}

// All threads share the pairs of cloth, with all that contact does: the limit, too.
TEST(Determinism, holds_where_cloth_meets_cloth) {
    for (const SelfCollision contact : {SelfCollision::exact, SelfCollision::fast}) {
        const auto fall = [&](unsigned workers) {
            World world = make_world({.solver = {.substeps = 5}}, CpuOptions{workers});
            SheetDesc sheet{.size = {0.6f, 0.6f}, .resolution = {24, 24}, .rotation_degrees = {80, 20, 45}};
            sheet.position = {0, 0.3f, 0};
            sheet.velocity = {0, -4, 0};
            sheet.self_collision = contact;
            world.add(make_sheet(sheet));
            world.add(make_collider({.name = "floor", .shape = PlaneDesc{}}));
            std::uint64_t limited = 0;
            for (int frame = 0; frame < 12; ++frame) {
                run(world, 1.0 / 60);
                limited += world.frame().cloth_contacts.limited;
            }
            EXPECT_EQ(limited > 0, contact == SelfCollision::exact);
            return world.state_hash();
        };
        const std::string expected = fall(0);
        for (const unsigned workers : {1u, 2u}) EXPECT_EQ(fall(workers), expected) << workers << " workers";
    }
}

// Cloths that can collide and are far apart run side by side, and share arrays over the world.
TEST(Determinism, holds_where_cloths_that_can_collide_are_apart) {
    for (const SelfCollision contact : {SelfCollision::exact, SelfCollision::fast}) {
        const auto fall = [&](unsigned workers) {
            World world = make_world({.solver = {.substeps = 5}}, CpuOptions{workers});
            for (int i = 0; i < 4; ++i) {
                SheetDesc sheet{.size = {0.4f, 0.4f}, .resolution = {12, 12}, .rotation_degrees = {80, 20, 45}};
                sheet.position = {2 * static_cast<float>(i), 0.2f, 0};
                sheet.velocity = {0, -4, 0};
                sheet.self_collision = contact;
                world.add(make_sheet(sheet));
            }
            world.add(make_collider({.name = "floor", .shape = PlaneDesc{}}));
            run(world, 0.2);
            return world.state_hash();
        };
        const std::string expected = fall(0);
        for (const unsigned workers : {1u, 2u}) EXPECT_EQ(fall(workers), expected) << workers << " workers";
    }
}

// If there are more cloths than threads, each cloth runs on one thread. A single cloth runs on all threads. Both give
// the same bits.
// Labels: slow no-asan
TEST(Determinism, does_not_tell_how_many_cloths_there_are) {
    const auto sheet = [](int i) {
        return make_sheet({.size = {0.5f, 0.5f},
                           .resolution = {20, 18},
                           .rotation_degrees = {10.0f * static_cast<float>(i), 5, 0},
                           .layout = {.lines = true, .hierarchy = true},
                           .pinned = [](Vec3 p) { return p.x < -0.24f; }});
    };
    const WorldSettings settings{.solver = {.substeps = 8, .hierarchy = true}};
    const auto large = make_sheet({.resolution = {150, 150}, .layout = {.lines = true}});  // this one by all threads
    for (const unsigned workers : {0u, 1u, 3u}) {
        World many = make_world(settings, CpuOptions{workers, ""});
        for (int i = 0; i < 9; ++i) many.add(sheet(i));
        many.add(large);
        run(many, 0.3);
        const Frame& frame = many.frame();
        EXPECT_LE(std::accumulate(frame.stage_ms.begin(), frame.stage_ms.end(), 0.0), frame.step_ms);
        for (const int i : {0, 4, 8}) {
            World one = make_world(settings, CpuOptions{workers, ""});
            one.add(sheet(i));
            run(one, 0.3);
            const auto& a = many.frame().cloths[static_cast<std::size_t>(i)].positions;
            EXPECT_TRUE(std::ranges::equal(a, one.frame().cloths[0].positions)) << i << ", " << workers << " workers";
        }
    }
}

// The smallest cloths run on one thread each, also if there are fewer cloths than threads.
TEST(Determinism, does_not_tell_which_cloths_are_shared) {
    const auto bits = [](std::uint32_t smallest_shared, unsigned workers) {
        const WorldSettings settings{.solver = {.substeps = 4, .hierarchy = true}};
        World world(std::move(*make_cpu_backend({.workers = workers, .smallest_shared = smallest_shared})), settings);
        for (const std::uint32_t side : {12u, 20u, 28u})
            world.add(make_sheet({.resolution = {side, side},
                                  .layout = {.lines = true, .hierarchy = true},
                                  .pinned = [](Vec3 p) { return p.x < -0.49f; }}));
        run(world, 0.1);
        return world.state_hash();
    };
    const std::string expected = bits(0, 0);
    for (const std::uint32_t smallest_shared : {0u, 200u, 500u, 1000u}) {
        for (const unsigned workers : {1u, 3u}) EXPECT_EQ(bits(smallest_shared, workers), expected) << smallest_shared;
    }
}

// Labels: slow no-asan
TEST(Determinism, holds_for_all_that_bends) {
    for (const BendModel model : {BendModel::dihedral, BendModel::plate, BendModel::distance}) {
        const std::string expected = drape({0, "scalar"}, 2, model);
        EXPECT_NE(expected, drape({0, "scalar"}, 2));
        for (std::string_view isa : cpu_instruction_sets()) {
            EXPECT_EQ(drape({0, std::string(isa)}, 2, model), expected) << isa;
        }
        EXPECT_EQ(drape({1, ""}, 2, model), expected) << "two threads";
    }
}

/// The state after some time is the same on every instruction set, with one thread, two and four.
void expect_same_bits(const std::function<World(const CpuOptions&)>& make, double seconds) {
    std::string first;
    for (const std::string_view isa : cpu_instruction_sets()) {
        for (const unsigned workers : {0u, 1u, 3u}) {
            World world = make({.workers = workers, .isa = std::string(isa)});
            run(world, seconds);
            if (first.empty()) first = world.state_hash();
            EXPECT_EQ(world.state_hash(), first) << isa << ' ' << workers;
        }
    }
}

// Labels: slow no-asan
TEST(Determinism, holds_for_membranes) {
    const auto membrane = [](const CpuOptions& options) {
        return drape(options, 2, BendModel::moment, StretchModel::membrane);
    };
    const std::string expected = membrane({0, "scalar"});
    EXPECT_NE(expected, drape({0, "scalar"}, 2));
    for (std::string_view isa : cpu_instruction_sets()) EXPECT_EQ(membrane({0, std::string(isa)}), expected) << isa;
    EXPECT_EQ(membrane({1, ""}), expected) << "two threads";
}

// The threads share the poses of what moves.
TEST(Determinism, holds_over_many_moving_colliders) {
    const WorldSettings settings{.solver = {.substeps = 4, .iterations = 2}, .contact_forces = true};
    expect_same_bits(
        [&](const CpuOptions& options) {
            World world = make_world(
                settings, {.resolution = {24, 24}, .position = {0, 0.1f, 0}, .layout = settings.layout()}, options);
            for (int i = 0; i < 16; ++i) {
                const Vec3 from{0.3f * static_cast<float>(i % 4 - 2), 0, 0.3f * static_cast<float>(i / 4 - 2)};
                world.add(make_collider({.shape = BoxDesc{{0.05f, 0.05f, 0.03f}},
                                         .motion = {{0, from, {}}, {0.5f, {from.z, 0.1f, from.x}, {90, 200, 0}}}}));
            }
            return world;
        },
        0.1);
}

// Labels: slow no-asan
TEST(Determinism, holds_along_lines) {
    for (const std::uint32_t iterations : {1u, 3u}) {
        const WorldSettings settings{.solver = {.substeps = 3, .iterations = iterations, .hierarchy = true}};
        SheetDesc sheet = hung_by_corners(40, settings.layout());
        sheet.fabric.body.density = 0.2f;
        expect_same_bits([&](const CpuOptions& options) { return make_world(settings, sheet, options); }, 0.3);
    }
}

// Labels: slow
TEST(Determinism, holds_with_coarse_levels) {
    SheetDesc sheet = hung_by_corners(40, {.hierarchy = true});
    sheet.fabric.tether.use = Tethers::off;
    const WorldSettings settings{.solver = {.substeps = 3, .hierarchy = true}};
    expect_same_bits([&](const CpuOptions& options) { return make_world(settings, sheet, options); }, 0.3);
}

// Labels: slow no-asan long
TEST(Determinism, holds_for_averaged_jacobi) {
    for (const Method method : {Method::xpbd, Method::pbd}) {
        const WorldSettings settings{
            .solver = {.substeps = 4, .iterations = 3, .method = method, .projection = Projection::jacobi},
            .air = AirDesc{.wind = {{.velocity = {3, 0, 1}, .turbulence = {0.4f}}}}};
        const auto make = [&](const CpuOptions& options) {
            World world = make_world(settings, options);
            world.add(make_sheet({.resolution = {20, 21}, .pinned = [](Vec3 p) { return p.x < -0.49f; }}));
            world.add(make_collider({.shape = SphereDesc{0.3f}, .transform = {.position = {0, -0.4f, 0}}}));
            return world;
        };
        expect_same_bits(make, 0.5);
    }
}

}  // namespace
}  // namespace weft::physical
