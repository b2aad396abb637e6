// Each scene in scenes/ on both backends: the same invariants, and the same bits in two runs on one device.

#include "vulkan_fixture.h"

#include "files/open_scene.h"
#include "solver/measures/statistics.h"

#include <weft/weft.h>

#include <cstdlib>
#include <filesystem>

namespace weft {
namespace {

struct Outcome {
    std::string hash;
    std::uint32_t reports = 0;
    double stretch = 0, residual = 0, speed = 0, energy = 0, penetration = 0;
};

Outcome simulate(const std::filesystem::path& scene, const std::string& backend, int frames) {
    auto session = open_scene(scene, {.backend = backend});
    if (!session) {
        ADD_FAILURE() << session.error().message();
        return {};
    }
    Outcome outcome;
    for (int i = 0; i < frames; ++i) {
        session->advance();
        outcome.reports |= session->world().summary().reports;
    }
    const Frame& frame = session->world().frame();
    EXPECT_TRUE(all_finite(frame));
    for (const ClothFrame& cloth : frame.cloths) {
        for (const Vec4& n : cloth.normals) EXPECT_NEAR(length(n.xyz()), 1, 1e-5);
    }
    outcome.hash = session->world().state_hash();
    outcome.stretch = measure_strain(frame).stretch.mean;
    outcome.residual = session->world().stretch_residual().mean;
    outcome.speed = max_speed(frame);
    outcome.energy = kinetic_energy(frame);
    outcome.penetration = measure_penetration(frame, session->world().colliders()).max;
    return outcome;
}

// `scripts/test --long` runs two frames, so that a frame starts from what the former one left.
// Labels: slow no-asan
TEST(VulkanScenes, are_as_on_the_cpu) {
    const int frames = std::getenv("WEFT_LONG_TESTS") ? 2 : 1;
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(WEFT_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".json") continue;
        SCOPED_TRACE(entry.path().filename().string());
        const Outcome cpu = simulate(entry.path(), "cpu", frames), vulkan = simulate(entry.path(), "vulkan", frames);
        EXPECT_EQ(cpu.reports, vulkan.reports);
        EXPECT_NEAR(vulkan.stretch, cpu.stretch, 0.02 * cpu.stretch + 1e-6);
        EXPECT_NEAR(vulkan.residual, cpu.residual, 0.02 * cpu.residual + 1e-6);
        EXPECT_NEAR(vulkan.speed, cpu.speed, 0.02 * cpu.speed);
        EXPECT_NEAR(vulkan.energy, cpu.energy, 0.01 * cpu.energy);
        EXPECT_LT(vulkan.penetration, 0.01);
        ++scenes;
    }
    EXPECT_GE(scenes, 9);
}

// The order of the arithmetic does not depend on the grouping of passes into dispatches.
// Labels: slow no-asan long
TEST(VulkanScenes, do_not_tell_how_they_are_executed) {
    const auto scene = std::filesystem::path(WEFT_SOURCE_DIR) / "scenes" / "sheet_on_sphere.json";
    const auto run = [&](const char* execution, std::uint32_t substeps) {
        auto session =
            open_scene(scene, {.backend = "vulkan", .execution = execution, .solver = {{"substeps", substeps}}});
        if (!session) {
            ADD_FAILURE() << session.error().message();
            return std::string();
        }
        for (int i = 0; i < 2; ++i) session->advance();
        EXPECT_EQ(session->world().summary().reports, report_none);
        return session->world().state_hash();
    };
    const std::string expected = run("streamed", 3);
    EXPECT_EQ(run("grouped", 3), expected);
    EXPECT_EQ(run("fused", 3), expected);
    EXPECT_NE(run("streamed", 4), expected);
}

// Shared memory may hold the particles of a cloth, its lines and its coarse levels, or some of them: with 32 KiB it has
// room for the 1936 particles of 44 x 44 and nothing else. The sheets hang, so that their levels are at work.
// Labels: long no-asan
TEST(VulkanScenes, do_not_depend_on_what_fits_into_shared_memory) {
    const auto run = [](std::uint32_t side, const SolverDesc& solver, const Options& on) {
        auto made = Simulation::create({.solver = solver}, on);
        if (!made) {
            ADD_FAILURE() << made.error().message();
            return std::string();
        }
        ClothDesc cloth;
        cloth.mesh = GridDesc{.size = {1, 1}, .resolution = {side, side}};
        cloth.transform.rotation_degrees = {90, 0, 0};
        cloth.pins = {PinDesc{.select = VertexPins{{0, side - 1}}}};
        EXPECT_TRUE(made->add(cloth).ok());
        made->step();
        EXPECT_TRUE(made->reports().empty());
        return made->state_hash();
    };
    struct Case {
        std::uint32_t side;
        SolverDesc solver;
    };
    const Case cases[] = {{20, {.substeps = 3}},
                          {40, {.substeps = 3}},
                          {50, {.substeps = 3}},
                          {44, {.substeps = 2, .iterations = 2, .projection = Projection::gauss_seidel}}};
    for (const auto& [side, solver] : cases) {
        SCOPED_TRACE(side);
        const std::string expected = run(side, solver, {.backend = "vulkan", .execution = "streamed"});
        EXPECT_EQ(run(side, solver, {.backend = "vulkan", .execution = "grouped"}), expected);
        EXPECT_EQ(run(side, solver, {.backend = "vulkan", .execution = "fused"}), expected);
        SolverDesc flat = solver;
        flat.hierarchy = false;
        EXPECT_NE(run(side, flat, {.backend = "vulkan"}), expected);
    }
}

// All substeps between the first and the last one run the same commands, also with keyed motion.
// Labels: slow no-asan long
TEST(VulkanScenes, do_not_tell_that_substeps_are_repeated) {
    for (const auto& [name, substeps] : {std::pair("turning_drum", 4u), {"curtain", 6u}}) {
        SCOPED_TRACE(name);
        const auto scene = std::filesystem::path(WEFT_SOURCE_DIR) / "scenes" / (std::string(name) + ".json");
        const auto run = [&](const char* execution) {
            auto session =
                open_scene(scene, {.backend = "vulkan", .execution = execution, .solver = {{"substeps", substeps}}});
            if (!session) {
                ADD_FAILURE() << session.error().message();
                return std::string();
            }
            for (int i = 0; i < 2; ++i) session->world().advance(0.8);
            return session->world().state_hash();
        };
        EXPECT_EQ(run("fused"), run("streamed"));
    }
}

// Averaged Jacobi with contacts, tethers and attachments.
// Labels: slow no-asan long
TEST(VulkanScenes, do_not_tell_how_averages_are_executed) {
    struct Way {
        const char *scene, *method, *accumulate;
    };
    for (const auto& [name, method, accumulate] : {Way{"sheet_on_sphere", "xpbd", "gather"},
                                                   {"sheet_on_sphere", "xpbd", "fixed-point"},
                                                   {"sheet_on_sphere", "pbd", "gather"},
                                                   {"curtain", "pbd", "fixed-point"}}) {
        SCOPED_TRACE(std::string(name) + ", " + method + ", " + accumulate);
        const auto scene = std::filesystem::path(WEFT_SOURCE_DIR) / "scenes" / (std::string(name) + ".json");
        const auto run = [&](const char* execution) {
            auto session = open_scene(scene, {.backend = "vulkan",
                                              .execution = execution,
                                              .solver = {{"substeps", 2},
                                                         {"iterations", 5},
                                                         {"method", method},
                                                         {"projection", "jacobi"},
                                                         {"accumulate", accumulate},
                                                         {"hierarchy", false}}});
            if (!session) {
                ADD_FAILURE() << session.error().message();
                return std::string();
            }
            session->advance();
            return session->world().state_hash();
        };
        EXPECT_EQ(run("fused"), run("streamed"));
    }
}

// Labels: slow no-asan long
TEST(VulkanScenes, give_the_same_bits_twice) {
    for (const char* name : {"sheet_on_sphere", "flag"}) {
        const auto scene = std::filesystem::path(WEFT_SOURCE_DIR) / "scenes" / (std::string(name) + ".json");
        const Outcome once = simulate(scene, "vulkan", 2);
        EXPECT_EQ(once.hash, simulate(scene, "vulkan", 2).hash) << name;
        EXPECT_FALSE(once.hash.empty());
    }
}

// Cloth that falls flat moves within its plane by less than 1e-30 m. Products of such numbers are subnormal.
// Labels: no-asan
TEST(VulkanScenes, flat_cloth_falls_as_on_the_cpu) {
    const auto fall = [](const char* backend) {
        auto world = Simulation::create({}, {.backend = backend, .solver = {{"substeps", 10}}});
        EXPECT_TRUE(world.ok() && world->add({.mesh = GridDesc{.size = {0.6f, 0.6f}, .resolution = {21, 21}},
                                              .transform = {.position = {0, 0.5f, 0}},
                                              .fabric = FabricDesc("cotton")}));
        if (!world) return std::string();
        for (int frame = 0; frame < 8; ++frame) world->step();
        return world->state_hash();
    };
    if (!rounds_like_the_cpu(World(checked_vulkan_backend(), {}))) return;
    EXPECT_EQ(fall("vulkan"), fall("cpu"));
}

// Particles near pins are heavier while their pin holds.
// Labels: slow no-asan
TEST(VulkanScenes, cloth_near_pins_moves_as_on_the_cpu) {
    const auto hang = [](const char* backend, const char* execution) {
        auto world = Simulation::create({.air = AirDesc{}},
                                        {.backend = backend, .execution = execution, .solver = {{"substeps", 4}}});
        EXPECT_TRUE(world.ok());
        if (!world) return std::string();
        const std::vector<PinDesc> pins = {{.select = VertexPins{{0}}}, {.select = VertexPins{{32}}}};
        const auto sheet =
            world->add({.mesh = GridDesc{.resolution = {33, 33}}, .fabric = FabricDesc("silk"), .pins = pins});
        EXPECT_TRUE(sheet.ok());
        std::string hashes;
        for (int frame = 0; frame < 6; ++frame) {
            if (frame == 3) {
                EXPECT_TRUE(world->set_pins(*sheet, {pins[0]}).ok());
            }
            world->step();
            hashes += world->state_hash() + ' ';
        }
        return hashes;
    };
    if (!rounds_like_the_cpu(World(checked_vulkan_backend(), {}))) return;
    const std::string expected = hang("cpu", "auto");
    EXPECT_EQ(hang("vulkan", "streamed"), expected);
    if (!std::getenv("WEFT_LONG_TESTS")) return;
    EXPECT_EQ(hang("vulkan", "grouped"), expected);
    EXPECT_EQ(hang("vulkan", "fused"), expected);
}

}  // namespace
}  // namespace weft
