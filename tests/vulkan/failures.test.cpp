// Failures of a device: too little memory, and loss during a run.

#include "losing_device.h"
#include "vulkan_fixture.h"

#include "mesh/procedural.h"
#include "solver/measures/statistics.h"
#include "solver/world/world.h"

#include <volk.h>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> sheet(std::uint32_t side) {
    ClothModelDesc desc;
    desc.name = "sheet";
    desc.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    auto topology = build_topology(desc.mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    desc.pins.particles = {0};
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

TEST(VulkanFailures, of_memory_are_errors_and_leave_what_there_was) {
    World world(checked_vulkan_backend({.memory_limit = 8 << 20}), {});
    const auto small = world.try_add(sheet(16));
    ASSERT_TRUE(small.ok()) << small.error().message();
    const auto large = world.try_add(sheet(200));
    ASSERT_FALSE(large.ok());
    EXPECT_EQ(large.error().fault, Fault::machine);
    EXPECT_NE(large.error().message().find("VK_ERROR_OUT_OF_DEVICE_MEMORY"), std::string::npos)
        << large.error().message();
    EXPECT_NE(large.error().message().find("--backend cpu"), std::string::npos) << large.error().message();
    EXPECT_EQ(world.step(1.0 / 60).reports, report_none);
    EXPECT_EQ(world.frame().cloths.size(), 1u);
    EXPECT_LT(world.frame().cloths[0].positions.back().y, 0) << "it falls";
    const auto refused = world.set_model(*small, sheet(16), {});
    EXPECT_TRUE(refused.ok()) << "room for one more of these";
}

TEST(VulkanFailures, of_the_device_in_mid_run_keep_the_last_frame) {
    World world(checked_vulkan_backend({.intercept = losing_device::intercept}), {});
    ASSERT_TRUE(world.try_add(sheet(16)).ok());
    for (int i = 0; i < 3; ++i) EXPECT_EQ(world.step(1.0 / 60).reports, report_none);
    const auto& positions = world.frame().cloths[0].positions;
    const std::vector<Vec4> last(positions.begin(), positions.end());

    losing_device::submits_left = 0;
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(world.step(1.0 / 60).reports, report_device_failed);
        EXPECT_NE(world.frame().cloths[0].detail.find("VK_ERROR_DEVICE_LOST"), std::string::npos)
            << world.frame().cloths[0].detail;
        EXPECT_TRUE(std::ranges::equal(world.frame().cloths[0].positions, last));
    }
    EXPECT_FALSE(world.try_add(sheet(8)).ok());
    EXPECT_TRUE(world.save().cloths[0].position.empty());
}

TEST(VulkanFailures, name_what_was_asked_for) {
    const auto none_such = make_vulkan_backend({.device = "voodoo"});
    ASSERT_FALSE(none_such.ok());
    EXPECT_EQ(none_such.error().fault, Fault::machine);
    EXPECT_EQ(none_such.error().where, "device 'voodoo'");
    EXPECT_NE(none_such.error().what.find("there is none; there are '"), std::string::npos) << none_such.error().what;
    const auto odd = make_vulkan_backend({.execution = "backwards"});
    ASSERT_FALSE(odd.ok());
    EXPECT_EQ(odd.error().fault, Fault::input);
}

}  // namespace
}  // namespace weft
