// Models that are rebuilt while cloth moves.
// Labels of this file: threads

#include "sheet.h"

#include <atomic>
#include <cmath>
#include <new>

namespace weft::physical {
namespace {

// Runs a second with a pin added at the start and the model rebuilt for it.
std::string hash_with_rebuild(bool background, std::atomic<int>& builds, std::uint64_t& used_from) {
    World world = make_world({.solver = {.hierarchy = true}, .background = background},
                             hung_upright({.lines = true, .hierarchy = true}));
    const ClothId id = world.frame().cloths[0].id;
    SheetDesc with_pin = hung_upright({.lines = true, .hierarchy = true});
    with_pin.pinned = [](Vec3 p) { return p.z < -0.49f && (std::abs(p.x) > 0.49f || std::abs(p.x) < 0.01f); };
    const auto next = make_sheet(with_pin);
    const ClothModel* before = world.model(id).get();
    EXPECT_TRUE(world.set_pins(id, pinned_particles(*next), {}).ok());
    world.rebuild_later(id, [&builds, next] {
        ++builds;
        return Result<std::shared_ptr<const ClothModel>>(next);
    });
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 60);
        if (used_from == 0 && world.model(id).get() != before) used_from = world.index();
    }
    return world.state_hash();
}

TEST(LateModels, are_used_from_the_same_frame_wherever_they_are_built) {
    std::atomic<int> builds = 0;
    std::uint64_t here = 0, there = 0;
    const std::string one = hash_with_rebuild(false, builds, here);
    EXPECT_EQ(hash_with_rebuild(true, builds, there), one);
    EXPECT_EQ(here, frames_to_build(17 * 17));
    EXPECT_EQ(here, there);
    EXPECT_EQ(builds, 2);
}

TEST(LateModels, are_dropped_for_newer_ones_and_with_their_cloth) {
    World world = make_world({.background = true}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    const auto first = make_sheet(hung_upright()), second = make_sheet(hung_upright());
    world.rebuild_later(id, [first] { return Result<std::shared_ptr<const ClothModel>>(first); });
    world.step(1.0 / 60);
    world.rebuild_later(id, [second] { return Result<std::shared_ptr<const ClothModel>>(second); });
    run(world, 0.5);
    EXPECT_EQ(world.model(id), second);
    world.rebuild_later(id, [first] { return Result<std::shared_ptr<const ClothModel>>(first); });
    world.remove(id);
    run(world, 0.5);
    EXPECT_EQ(world.cloth_count(), 0u);
}

TEST(LateModels, that_fail_leave_the_cloth_as_it_is) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    const auto before = world.model(id);
    world.rebuild_later(id, []() -> Result<std::shared_ptr<const ClothModel>> { return Error{"model", "no"}; });
    world.rebuild_later(id, []() -> Result<std::shared_ptr<const ClothModel>> { throw std::bad_alloc(); });
    run(world, 0.5);
    EXPECT_EQ(world.model(id), before);
}

}  // namespace
}  // namespace weft::physical
