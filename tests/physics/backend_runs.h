// The same worlds on the CPU and on Vulkan.
#pragma once

#include "falling_cloth.h"

namespace weft::physical {

struct RunOfFrames {
    std::string hash;
    ClothContactCounts counts;   ///< of all frames
    std::uint64_t contacts = 0;  ///< summed over all frames
    std::uint64_t repeats = 0;   ///< frames that ran again because a list was full
};

inline RunOfFrames run_frames(World& world, int frames) {
    RunOfFrames result;
    for (int i = 0; i < frames; ++i) {
        world.step(1.0 / 60);
        result.counts.add(world.frame().cloth_contacts);
        result.contacts += world.frame().cloth_contacts.contacts;
        result.repeats += world.frame().lists.repeats;
    }
    result.hash = world.state_hash();
    return result;
}

inline World on_cpu(const WorldSettings& settings) {
    return make_world(settings, CpuOptions{});
}
inline World on_vulkan(const WorldSettings& settings, const VulkanOptions& options = {}) {
    return World(checked_vulkan_backend(options), settings);
}

/// Adds the same cloths to a world on either backend and compares the runs. Devices that round divisions differently
/// are tested for crossings only.
template <class Add>
RunOfFrames expect_equal(const WorldSettings& settings, Add&& add, int frames, std::uint64_t crossings_left = 0) {
    World cpu = on_cpu(settings), vulkan = on_vulkan(settings);
    add(cpu);
    add(vulkan);
    const RunOfFrames expected = run_frames(cpu, frames), result = run_frames(vulkan, frames);
    EXPECT_EQ(crossings(vulkan), crossings_left);
    if (!rounds_like_the_cpu(vulkan)) return result;
    EXPECT_EQ(result.hash, expected.hash);
    EXPECT_EQ(result.contacts, expected.contacts);
    EXPECT_EQ(result.counts.limited, expected.counts.limited);
    EXPECT_EQ(result.counts.tangled, expected.counts.tangled);
    EXPECT_EQ(result.counts.tangled_particle, expected.counts.tangled_particle);
    return result;
}

inline WorldSettings with_substeps(std::uint32_t substeps) {
    return {.solver = {.substeps = substeps}};
}

inline void add_dropped(World& world, SheetDesc sheet) {
    world.add(make_sheet(sheet));
    add_ground(world);
}

}  // namespace weft::physical
