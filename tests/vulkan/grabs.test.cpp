// Grabs on the Vulkan backend give the bits of the CPU, with every execution.

#include "vulkan_fixture.h"

#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"

namespace weft {
namespace {

struct GrabScene {
    SelfCollision contact = SelfCollision::off;
    SolverDesc solver = {};
    bool tears = false;
    bool air = false;
};

struct GrabRun {
    std::string hash;
    Vec3 force, position;
};

std::shared_ptr<const ClothModel> grab_model(const GrabScene& scene) {
    TriangleMesh mesh = make_grid({0.6f, 0.6f}, {12, 11}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    Fabric fabric = find_fabric("cotton")->fabric;
    ClothModelDesc desc{.name = "sheet",
                        .mesh = std::move(mesh),
                        .fabric = fabric,
                        .collision = {scene.contact, {}, 0},
                        .pins = {.particles = {0}},
                        .layout = {.lines = resolve(scene.solver.projection, scene.solver.method) == Projection::lines,
                                   .hierarchy = scene.solver.hierarchy}};
    if (scene.tears) desc.reserve = {.particles = 100, .openings = true, .tears = true};
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

GrabRun run_grabs(std::unique_ptr<Backend> backend, const GrabScene& scene) {
    WorldSettings settings{.solver = scene.solver};
    if (scene.air) settings.air = AirDesc{.wind = {{.velocity = {3, 0, 1}}}};
    World world(std::move(backend), settings);
    const ClothId cloth = world.add(grab_model(scene));
    if (!scene.tears) world.add(grab_model({.solver = scene.solver}));  // not grabbed
    const GrabId one = world.grab(cloth, 100, {0.2f, 0.3f, 0.5f}, {0.1f, 0.1f, 0}),
                 two = world.grab(cloth, 100, {0.5f, 0.5f, 0}, {0, 0.1f, 0}, {.max_force = 3, .compliance = 1e-3f});
    for (int i = 0; i < 5; ++i) {
        world.move_grab(one, {0.1f, 0.1f + 0.05f * static_cast<float>(i), 0});
        if (i == 3) world.release(two);
        world.step(frame_seconds);
    }
    EXPECT_EQ(world.frame().reports & report_non_finite, 0u);
    return {world.state_hash(), world.grab_force(one), world.grab_position(one)};
}

class GrabsOn : public testing::TestWithParam<const char*> {};

// Labels: slow no-asan
// Labels with "fused": long
// Labels with "grouped": long
TEST_P(GrabsOn, give_the_bits_of_the_cpu) {
    std::vector<GrabScene> scenes{{.solver = {.substeps = 6, .hierarchy = true}, .air = true},
                                  {.solver = {.substeps = 4, .iterations = 2, .hierarchy = true}}};
    // The fused program takes software drivers half a minute to compile for each scene.
    if (GetParam() != std::string_view("fused")) {
        const GrabScene others[] = {
            {.solver = {.substeps = 1}},
            {.solver = {.substeps = 4, .projection = Projection::jacobi}},
            {.solver = {.substeps = 4, .projection = Projection::jacobi, .accumulate = Accumulate::fixed_point}},
            {.solver = {.substeps = 4, .iterations = 2, .method = Method::pbd}},
            {.solver = {.substeps = 6}, .tears = true},
            {.contact = SelfCollision::fast, .solver = {.substeps = 3}},
            {.contact = SelfCollision::exact, .solver = {.substeps = 3}},
        };
        scenes.insert(scenes.end(), std::begin(others), std::end(others));
    }
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        auto backend = checked_vulkan_backend({.execution = GetParam()});
        ASSERT_NE(backend, nullptr);
        const bool exact = backend->device().find("llvmpipe") != std::string::npos;
        const GrabRun vulkan = run_grabs(std::move(backend), scenes[i]);
        const GrabRun cpu = run_grabs(std::move(*make_cpu_backend()), scenes[i]);
        EXPECT_GT(length(cpu.force), 0.1f) << i;
        EXPECT_LT(length(vulkan.position - cpu.position), 0.02f) << i;
        if (!exact) continue;
        EXPECT_EQ(vulkan.hash, cpu.hash) << "scene " << i;
        EXPECT_EQ(vulkan.force, cpu.force) << "scene " << i;
        EXPECT_EQ(vulkan.position, cpu.position) << "scene " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(, GrabsOn, testing::Values("streamed", "grouped", "fused"));

}  // namespace
}  // namespace weft
