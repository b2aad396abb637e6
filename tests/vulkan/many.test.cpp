// Many cloths in one frame: as many dispatches as for one cloth, one submit, and the same bits for every way to execute
// a frame.

#include "counting_device.h"
#include "vulkan_fixture.h"

#include "mesh/procedural.h"
#include "solver/world/world.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>

namespace weft {
namespace {

// A sheet above the ground, hung by a corner where it has a pin.
std::shared_ptr<const ClothModel> sheet(std::uint32_t side, const ClothLayout& layout, bool pinned,
                                        float bend = 1e-4f) {
    ClothModelDesc desc;
    desc.name = "sheet of " + std::to_string(side);
    desc.mesh = make_grid({0.01f * static_cast<float>(side), 0.3f}, {side, side}, GridDiagonal::alternating);
    std::ranges::fill(desc.fabric.bend.bend, bend);
    auto topology = build_topology(desc.mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    desc.layout = layout;
    if (pinned) desc.pins.particles = {0};
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

struct Frames {
    std::string hash;
    std::vector<std::vector<Vec4>> positions;  ///< by cloth
    int dispatches = 0;                        ///< of a frame
    int submits = 0;
};

World make_world(std::unique_ptr<Backend> backend, const WorldSettings& settings) {
    World world(std::move(backend), settings);
    world.add(make_collider({.name = "ground", .shape = PlaneDesc{{0, 1, 0}, -0.001f}}));
    return world;
}

// Two frames, of which the first one is recorded. Removes the cloths again.
Frames run_once(World& world, const std::vector<std::shared_ptr<const ClothModel>>& models) {
    std::vector<ClothId> cloths;
    for (const auto& model : models) cloths.push_back(world.add(model));
    Frames frames;
    counting_device::dispatches = 0;
    world.advance(frame_seconds);
    EXPECT_EQ(world.summary().reports, report_none);
    frames.dispatches = counting_device::dispatches;
    counting_device::submits = 0;
    world.advance(frame_seconds);
    EXPECT_EQ(world.summary().reports, report_none);
    frames.submits = counting_device::submits;
    EXPECT_EQ(counting_device::dispatches, frames.dispatches) << "recorded once";
    frames.hash = world.state_hash();
    for (const ClothFrame& cloth : world.frame().cloths)
        frames.positions.emplace_back(cloth.positions.begin(), cloth.positions.end());
    for (const ClothId cloth : cloths) world.remove(cloth);
    return frames;
}

// A frame that has to compile pipelines is recorded twice, so this counts the dispatches of the next one.
Frames run(World& world, const std::vector<std::shared_ptr<const ClothModel>>& models) {
    (void)run_once(world, models);
    return run_once(world, models);
}

std::unique_ptr<Backend> vulkan_backend(const char* execution) {
    return checked_vulkan_backend({.execution = execution, .intercept = counting_device::intercept});
}

// Several cloths of one model.
void expect_as_many_dispatches(std::uint32_t side, std::span<const char* const> executions) {
    const WorldSettings settings{.solver = {.substeps = 3, .hierarchy = true}};
    const auto model = sheet(side, settings.layout(), true);
    std::map<std::string, int> of_one;
    for (const std::size_t count : {1u, 130u}) {  // more than a workgroup has invocations
        const std::vector models(count, model);
        std::string expected;
        for (const char* execution : executions) {
            SCOPED_TRACE(std::to_string(count) + " cloths, " + execution);
            World world = make_world(vulkan_backend(execution), settings);
            const Frames frames = run(world, models);
            EXPECT_EQ(frames.dispatches, of_one.try_emplace(execution, frames.dispatches).first->second);
            EXPECT_EQ(frames.submits, 1);
            if (expected.empty()) expected = frames.hash;
            EXPECT_EQ(frames.hash, expected);
        }
    }
    EXPECT_GT(of_one["streamed"], 1);
    if (of_one.contains("grouped")) {
        EXPECT_LT(of_one["grouped"], of_one["streamed"]);
    }
    if (of_one.contains("fused")) {
        EXPECT_EQ(of_one["fused"], 1);
    }
}

// Labels: slow no-asan long
TEST(ManyCloths, take_no_more_dispatches_than_one) {
    expect_as_many_dispatches(12, std::array{"streamed", "grouped"});
}

// Small cloths: software devices run one workgroup per cloth slowly.
// Labels: long no-asan
TEST(ManyCloths, take_one_dispatch_when_fused) {
    expect_as_many_dispatches(6, std::array{"streamed", "fused"});
}

// Cloths of different sizes and constraints, with and without coarse levels, lines and pins, do not affect each other.
// Labels: slow no-asan long
TEST(ManyCloths, that_differ_do_what_each_does_alone) {
    for (const Projection projection : {Projection::lines, Projection::gauss_seidel, Projection::jacobi}) {
        const WorldSettings settings{
            .solver = {.substeps = 3, .iterations = 2, .projection = projection, .hierarchy = true}};
        ClothLayout flat = settings.layout();
        flat.hierarchy = false;
        const std::vector models{sheet(9, flat, false), sheet(15, settings.layout(), true), sheet(8, flat, true, 0),
                                 sheet(12, settings.layout(), true), sheet(7, settings.layout(), false)};
        std::vector<std::vector<Vec4>> expected;
        int sum = 0, longest = 0;
        World one_by_one = make_world(vulkan_backend("streamed"), settings);
        for (const auto& model : models) {
            Frames alone = run(one_by_one, {model});
            expected.push_back(std::move(alone.positions.front()));
            sum += alone.dispatches;
            longest = std::max(longest, alone.dispatches);
        }
        for (const char* execution : {"streamed", "grouped", "fused"}) {
            SCOPED_TRACE(execution);
            World together = make_world(vulkan_backend(execution), settings);
            const Frames frames = run(together, models);
            EXPECT_EQ(frames.positions, expected);
            EXPECT_EQ(frames.submits, 1);
            if (execution != std::string_view("streamed")) continue;
            EXPECT_GE(frames.dispatches, longest);
            EXPECT_LT(frames.dispatches, longest + (sum - longest) / 4);
        }
    }
}

}  // namespace
}  // namespace weft
