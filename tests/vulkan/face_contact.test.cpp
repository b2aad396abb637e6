// Contact of triangles with colliders on the device: the CPU's bits.

#include "vulkan_fixture.h"

#include "collide/distance_field.h"
#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "solver/world/world.h"

#include <cstdlib>
#include <string_view>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> sheet_of(std::uint32_t side, const ClothLayout& layout) {
    ClothModelDesc desc;
    desc.name = "sheet";
    desc.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    auto topology = build_topology(desc.mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    desc.layout = layout;
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

// A corner, a needle and a field under a sheet, a ball that flies through the place where it is, and a blade that
// turns.
void add_bodies(World& world) {
    world.add(make_collider({.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
                             .transform = {.position = {0.2f, -0.18f, 0.2f}, .rotation_degrees = {45, 0, 35.2644f}}}));
    world.add(make_collider({.shape = CapsuleDesc{0.0025f, 0.1f}, .transform = {.position = {-0.21f, -0.106f, 0.2f}}}));
    const TriangleMesh tip = make_box({0.08f, 0.08f, 0.08f}, {2, 2, 2});
    world.add(make_collider(
        {.shape = SolidMeshDesc{}, .transform = {.position = {0.2f, -0.06f, -0.2f}, .rotation_degrees = {30, 0, 20}}},
        std::make_shared<ShapeData>(
            build_distance_field(tip.positions, tip.triangles, {.cells = 16, .threads = 1})->data)));
    world.add(make_collider(
        {.shape = SphereDesc{0.015f}, .motion = {{0, {0.01f, 0.3f, 0}, {}}, {0.01f, {0.01f, -0.3f, 0}, {}}}}));
    world.add(make_collider(
        {.shape = BoxDesc{{0.1f, 0.01f, 0.02f}},
         .motion = {{0, {-0.2f, -0.03f, -0.2f}, {20, 0, 0}}, {0.1f, {-0.2f, -0.01f, -0.2f}, {20, 0, 170}}}}));
}

// Lets the triangles of the whole sheet pass in turn, so that they are held in many rounds, and stretches them to more
// than twice their length.
void add_swung_rod(World& world) {
    world.add(make_collider({.shape = CapsuleDesc{0.001f, 0.8f},
                             .motion = {{0, {0, 0.1f, 0}, {0, 0, 95}}, {0.015f, {0, -0.5f, 0}, {0, 10, 95}}}}));
}

struct Meeting {
    void (*add_colliders)(World&);
    std::uint32_t side;  // particles of the sheet
    int frames;
};

std::vector<std::string> hashes_of(std::unique_ptr<Backend> backend, const WorldSettings& settings,
                                   const Meeting& meeting, bool& exact) {
    World world(std::move(backend), settings);
    exact = rounds_like_the_cpu(world);
    meeting.add_colliders(world);
    world.add(sheet_of(meeting.side, settings.layout()));
    std::vector<std::string> hashes;
    for (int i = 0; i < meeting.frames; ++i) {
        EXPECT_EQ(world.step(frame_seconds).reports & ~report_speed_capped, report_none);
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

// Labels: slow no-asan long
TEST(VulkanFaceContact, has_the_bits_of_the_cpu) {
    const WorldSettings settings[] = {{.solver = {.substeps = 8}},
                                      {.solver = {.substeps = 5, .iterations = 2}, .contact_forces = true}};
    const Meeting meeting{add_bodies, 20, 6};
    for (const WorldSettings& each : settings) {
        bool exact = false;
        const auto expected = hashes_of(std::move(*make_cpu_backend()), each, meeting, exact);
        for (const char* execution : {"streamed", "grouped"}) {
            // One of both for each.
            const bool other = (execution == std::string_view("grouped")) != each.contact_forces;
            if (other && !std::getenv("WEFT_LONG_TESTS")) continue;
            const auto found = hashes_of(checked_vulkan_backend({.execution = execution}), each, meeting, exact);
            if (!exact) continue;
            EXPECT_EQ(found, expected) << execution;
        }
    }
}

// Labels: slow no-asan
TEST(VulkanFaceContact, holds_what_a_rod_sweeps_through_with_the_bits_of_the_cpu) {
    const Meeting meeting{add_swung_rod, 40, 3};
    const WorldSettings settings{.solver = {.substeps = 20}, .contact_forces = true};
    bool exact = false;
    const auto expected = hashes_of(std::move(*make_cpu_backend()), settings, meeting, exact);
    const auto found = hashes_of(checked_vulkan_backend({}), settings, meeting, exact);
    if (exact) {
        EXPECT_EQ(found, expected);
    }
}

}  // namespace
}  // namespace weft
