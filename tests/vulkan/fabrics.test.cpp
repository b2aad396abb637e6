// A change of fabric of a moving cloth gives the CPU's bits on the device.

#include "vulkan_fixture.h"

#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "solver/world/world.h"

#include <algorithm>
#include <array>
#include <functional>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> hung_sheet(const ClothLayout& layout, BendModel bend) {
    ClothModelDesc desc;
    desc.name = "sheet";
    desc.mesh = make_grid({1, 1}, {30, 30}, GridDiagonal::alternating);
    desc.fabric.bend.model = bend;
    desc.layout = layout;
    desc.pins.particles = {0, 29};
    auto topology = build_topology(desc.mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

// Two cloths share a model; the fabric of the first one changes, the second one keeps its fabric.
std::array<std::vector<Vec4>, 2> run(std::unique_ptr<Backend> backend, const WorldSettings& settings, BendModel bend) {
    World world(std::move(backend), settings);
    const auto model = hung_sheet(settings.layout(), bend);
    const ClothId changing = world.add(model);
    world.add(model);
    for (int change = 0; change < 3; ++change) {
        for (int i = 0; i < 2; ++i) world.step(frame_seconds);
        Fabric fabric;
        fabric.bend.model = bend;
        fabric.body = {.density = 0.1f + 0.2f * static_cast<float>(change), .damping = 0.01f};
        fabric.stretch.stretch[0] = fabric.stretch.stretch[1] = 400;
        std::ranges::fill(fabric.bend.bend, 1e-3f);
        auto next = with_fabric(*world.model(changing), fabric);
        EXPECT_TRUE(next.ok() && *next);
        EXPECT_TRUE(world.set_material(changing, std::move(*next)).ok());
        EXPECT_TRUE(world.set_pins(changing, {0, 29, 450}, {}).ok());
    }
    for (int i = 0; i < 2; ++i) world.step(frame_seconds);
    EXPECT_EQ(world.frame().reports, report_none);
    const auto positions = [&](std::size_t cloth) {
        const auto all = world.frame().cloths[cloth].positions;
        return std::vector<Vec4>(all.begin(), all.end());
    };
    EXPECT_GT(world.measure().kinetic_energy, 0) << "with the new masses";
    return {positions(0), positions(1)};
}

// Labels: no-asan
TEST(Fabrics, change_on_the_device_as_on_the_cpu) {
    for (const Projection projection : {Projection::lines, Projection::jacobi}) {
        for (const BendModel bend : {BendModel::dihedral, BendModel::distance, BendModel::moment}) {
            const WorldSettings settings{.solver = {.substeps = 4, .projection = projection, .hierarchy = true},
                                         .air = AirDesc{}};
            auto cpu = make_cpu_backend();
            ASSERT_TRUE(cpu.ok());
            const auto here = run(std::move(*cpu), settings, bend);
            const auto there = run(checked_vulkan_backend(), settings, bend);
            for (std::size_t cloth = 0; cloth < 2; ++cloth) {
                for (std::size_t p = 0; p < here[cloth].size(); ++p) {
                    ASSERT_LE(length(there[cloth][p].xyz() - here[cloth][p].xyz()), 1e-4f) << cloth << ": " << p;
                    ASSERT_EQ(there[cloth][p].w, here[cloth][p].w);
                }
            }
            EXPECT_GT(length(here[0][870].xyz() - here[1][870].xyz()), 1e-3f) << "what changes makes a difference";
        }
    }
}

}  // namespace
}  // namespace weft
