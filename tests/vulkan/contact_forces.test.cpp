// Contacts that are read back: the CPU's bits for every way to execute a frame; lists that are too short; frames that
// have not finished.

#include "losing_device.h"
#include "vulkan_fixture.h"

#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "solver/state/contact_forces.test.h"
#include "solver/world/world.h"

#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>

#include <volk.h>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> sheet(std::uint32_t side, Vec3 position, const ClothLayout& layout = {},
                                        const std::function<bool(Vec3)>& pinned = {}) {
    ClothModelDesc desc;
    desc.name = "sheet";
    desc.mesh = make_grid({0.4f, 0.4f}, {side, side}, GridDiagonal::alternating);
    for (Vec3& p : desc.mesh.positions) p += position;
    auto topology = build_topology(desc.mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    desc.layout = layout;
    for (std::uint32_t p = 0; pinned && p < topology->particle_count; ++p)
        if (pinned(topology->rest_positions[p])) desc.pins.particles.push_back(p);
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

std::unique_ptr<Backend> cpu_backend() {
    return std::move(*make_cpu_backend());
}

Collider ground(float height) {
    return make_collider({.name = "ground", .shape = PlaneDesc{{0, 1, 0}, height}});
}

// Each shape: at rest, moving and turning.
void add_colliders(World& world) {
    world.add(ground(0.07f));
    world.add(make_collider({.shape = SphereDesc{0.1f}}));
    world.add(make_collider(
        {.shape = CapsuleDesc{0.05f, 0.1f}, .transform = {.position = {0.3f, 0, 0}, .rotation_degrees = {20, 0, 30}}}));
    world.add(make_collider({.shape = TaperedCapsuleDesc{{0.09f, 0.04f}, 0.08f},
                             .transform = {.position = {0.05f, 0.02f, 0.15f}, .rotation_degrees = {10, 40, 80}}}));
    world.add(make_collider({.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
                             .friction = {0.8f, 0.6f},
                             .motion = {{0, {-0.3f, 0, 0}, {}}, {1, {-0.1f, 0.1f, 0}, {0, 40, 0}}}}));
}

struct ForcesFound {
    std::vector<std::uint32_t> bits;
    std::vector<std::uint32_t> contacts;  ///< of the last frame, per collider
    std::string hash;
};

ForcesFound play(std::unique_ptr<Backend> backend, const WorldSettings& settings, bool& exact) {
    World world(std::move(backend), settings);
    exact = rounds_like_the_cpu(world);
    add_colliders(world);
    for (const float x : {-0.3f, 0.0f, 0.3f}) world.add(sheet(x == 0 ? 14 : 9, {x, 0.11f, 0}, settings.layout()));
    world.add(sheet(7, {0, 0.3f, 0}, settings.layout(), [](Vec3 p) { return p.x < -0.19f; }));
    ForcesFound forces;
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(world.step(frame_seconds).reports & ~report_speed_capped, report_none);
        const auto more = bits_of(world.contact_forces());
        forces.bits.insert(forces.bits.end(), more.begin(), more.end());
    }
    for (const ColliderForce& load : world.contact_forces().colliders) forces.contacts.push_back(load.contacts);
    forces.hash = world.state_hash();
    return forces;
}

void expect_same(const WorldSettings& settings, const std::vector<const char*>& executions) {
    bool exact = false, unused = false;
    const ForcesFound expected = play(cpu_backend(), settings, unused);
    for (const std::uint32_t contacts : expected.contacts) EXPECT_GT(contacts, 0u) << "all are touched";
    WorldSettings without = settings;
    without.contact_forces = false;
    EXPECT_EQ(play(cpu_backend(), without, unused).hash, expected.hash) << "nothing moves otherwise for it";
    for (const char* execution : executions) {
        const ForcesFound forces = play(checked_vulkan_backend({.execution = execution}), settings, exact);
        if (!exact) continue;
        EXPECT_EQ(forces.bits, expected.bits) << execution << ", " << settings.solver.iterations << " iterations";
        EXPECT_EQ(forces.hash, expected.hash);
    }
}

// Labels: slow no-asan long
TEST(VulkanContactForces, has_the_bits_of_the_cpu_however_a_frame_is_executed) {
    expect_same({.solver = {.substeps = 4, .hierarchy = false}, .contact_forces = true}, {"streamed"});
    expect_same(
        {.solver = {.substeps = 5, .iterations = 3, .hierarchy = true}, .air = AirDesc{}, .contact_forces = true},
        {"streamed", "grouped", "fused"});
    expect_same({.solver = {.substeps = 3, .iterations = 2, .projection = Projection::jacobi, .hierarchy = false},
                 .contact_forces = true},
                {"streamed", "fused"});
}

// More particles than one workgroup, so that sums of several workgroups are added.
TEST(VulkanContactForces, adds_up_what_many_workgroups_find) {
    const auto force = [](std::unique_ptr<Backend> backend) {
        World world(std::move(backend), {.solver = {.substeps = 2}, .contact_forces = true});
        world.add(ground(0));
        world.add(sheet(40, {0, 0.001f, 0}));
        for (int i = 0; i < 3; ++i) world.step(frame_seconds);
        double weight = 0;
        for (const float m : world.frame().cloths[0].model->mass) weight += m * 9.81;
        EXPECT_EQ(world.contact_forces().contacts.size(), 1600u);
        EXPECT_NEAR(world.contact_forces().colliders[0].force.y, -weight, 1e-4 * weight);
        return std::pair(rounds_like_the_cpu(world), bits_of(world.contact_forces()));
    };
    const auto cpu = force(cpu_backend()), vulkan = force(checked_vulkan_backend());
    if (vulkan.first) {
        EXPECT_EQ(vulkan.second, cpu.second);
    }
}

// Three grounds, each higher than the one before by less than gravity pulls in a substep: each of them pushes all.
// Labels: no-asan
TEST(VulkanContactForces, says_when_the_list_is_full_and_has_room_in_the_next_frame) {
    for (const char* execution : {"streamed", "fused"}) {
        if (execution == std::string_view("fused") && !std::getenv("WEFT_LONG_TESTS")) continue;
        World world(checked_vulkan_backend({.execution = execution}),
                    {.solver = {.substeps = 2}, .contact_forces = true});
        World reference(cpu_backend(), world.settings());
        for (World* one : {&world, &reference}) {
            one->add(sheet(13, {0, 0.001f, 0}));
            one->add(sheet(12, {1, 0.001f, 0}));
            for (int i = 0; i < 3; ++i) one->add(ground(2e-5f * static_cast<float>(i)));
        }
        const std::size_t most = 3 * (169 + 144);
        reference.step(frame_seconds);
        ASSERT_EQ(reference.contact_forces().contacts.size(), most);
        // Streamed cloths have one list each, fused ones share a list.
        const std::uint32_t reports = world.step(frame_seconds).reports;
        EXPECT_EQ(reports, report_contacts_full);
        EXPECT_EQ(report_names(reports), std::vector<std::string_view>{"ContactsFull"});
        EXPECT_EQ(world.contact_forces().contacts.size(), most / 3 * 2) << "two of a particle";
        for (std::size_t i = 0; i < 3; ++i) {
            const ColliderForce &load = world.contact_forces().colliders[i],
                                &expected = reference.contact_forces().colliders[i];
            EXPECT_EQ(load.contacts, expected.contacts) << "counted all the same";
            if (rounds_like_the_cpu(world)) {
                EXPECT_EQ(load.impulse, expected.impulse) << "and added up";
            }
        }
        for (int i = 0; i < 3; ++i) {
            reference.step(frame_seconds);
            EXPECT_EQ(world.step(frame_seconds).reports, report_none);
            EXPECT_EQ(world.contact_forces().contacts.size(), most);
            if (rounds_like_the_cpu(world)) {
                EXPECT_EQ(bits_of(world.contact_forces()), bits_of(reference.contact_forces()));
            }
        }
    }
}

// The device writes the next frame to another buffer than the one that is read.
// Labels: no-asan
TEST(VulkanContactForces, is_read_while_the_next_frame_runs) {
    World world(checked_vulkan_backend(), {.solver = {.substeps = 3}, .contact_forces = true});
    World reference(cpu_backend(), world.settings());
    for (World* one : {&world, &reference}) {
        add_colliders(*one);
        one->add(sheet(9, {0, 0.12f, 0}));
    }
    for (std::uint64_t frame = 1; frame <= 12; ++frame) {
        world.advance(frame_seconds);
        reference.advance(frame_seconds);
        EXPECT_EQ(world.contact_forces().frame, frame - 1);
        if (rounds_like_the_cpu(world)) {
            EXPECT_EQ(bits_of(world.contact_forces()), bits_of(reference.contact_forces()));
        }
    }
    EXPECT_GT(world.contact_forces().contacts.size(), 0u);
    (void)world.summary();
    EXPECT_EQ(world.contact_forces().frame, 12u);
    // The first query comes after the removal of the cloth.
    world.advance(frame_seconds);
    reference.advance(frame_seconds);
    world.remove(world.summary().cloths[0].id);
    reference.remove(reference.summary().cloths[0].id);
    EXPECT_EQ(world.contact_forces().frame, 13u);
    EXPECT_GT(world.contact_forces().contacts.size(), 0u);
    if (rounds_like_the_cpu(world)) {
        EXPECT_EQ(bits_of(world.contact_forces()), bits_of(reference.contact_forces()));
    }
}

// Edits and queries between advance() and the end of the frame lose nothing and do not touch buffers in use.
// Labels: no-asan long
TEST(VulkanContactForces, of_a_world_that_changes_while_a_frame_runs_is_sound) {
    const auto play = [](std::unique_ptr<Backend> backend) {
        World world(std::move(backend), {.solver = {.substeps = 3}, .contact_forces = true});
        const ColliderId floor = world.add(ground(-0.1f));
        const ClothId first = world.add(sheet(9, {0, 0, 0}));
        world.advance(frame_seconds);
        const ColliderId ball = world.add(make_collider({.shape = SphereDesc{0.1f}}));
        world.advance(frame_seconds);
        world.set_friction(ball, {0.9f, 0.8f});
        world.move(ball, {{}, {0, 0.02f, 0}});
        world.advance(frame_seconds);
        world.add(sheet(7, {0.5f, 0, 0}));
        world.advance(frame_seconds);
        EXPECT_TRUE(world.set_model(first, sheet(9, {0, 0, 0}, {}, [](Vec3 p) { return p.x < -0.19f; }), {}).ok());
        world.advance(frame_seconds);
        const Snapshot snapshot = world.save();
        world.advance(frame_seconds);
        std::string hash = world.state_hash();
        world.advance(frame_seconds);
        EXPECT_TRUE(world.restore(snapshot).ok());
        world.advance(frame_seconds);
        EXPECT_EQ(world.state_hash(), hash);
        world.advance(frame_seconds);
        (void)world.stretch_residual();
        WorldSettings settings = world.settings();
        settings.solver.substeps = 2;
        world.advance(frame_seconds);
        world.configure(settings);
        world.advance(frame_seconds);
        world.remove(floor);
        world.advance(frame_seconds);
        world.advance(frame_seconds);
        const bool exact = rounds_like_the_cpu(world);
        std::vector<std::uint32_t> bits = bits_of(world.contact_forces());
        hash += world.state_hash();
        world.advance(frame_seconds);  // the world is destroyed before this frame has finished
        return std::tuple(exact, hash, bits);
    };
    const auto [unused, hash, bits] = play(cpu_backend());
    const auto [exact, vulkan_hash, vulkan_bits] = play(checked_vulkan_backend());
    if (!exact) return;
    EXPECT_EQ(vulkan_hash, hash);
    EXPECT_EQ(vulkan_bits, bits);
}

// Labels: no-asan long
TEST(VulkanContactForces, of_a_frame_that_is_not_finite_is_none_and_the_next_has_its_own) {
    for (const char* execution : {"streamed", "fused"}) {
        World world(checked_vulkan_backend({.execution = execution}),
                    {.solver = {.substeps = 2}, .contact_forces = true});
        World reference(cpu_backend(), world.settings());
        for (World* one : {&world, &reference}) {
            one->add(ground(0));
            one->add(sheet(7, {0, 0.001f, 0}));
            one->step(frame_seconds);
            WorldSettings settings = one->settings();
            settings.gravity.x = std::numeric_limits<float>::infinity();
            one->configure(settings);
            EXPECT_EQ(one->step(frame_seconds).reports & report_non_finite, report_non_finite);
            EXPECT_FALSE(one->summary().cloths[0].detail.empty());
            EXPECT_TRUE(one->contact_forces().contacts.empty());
            EXPECT_EQ(one->contact_forces().frame, 2u);
            EXPECT_EQ(one->contact_forces().colliders[0].contacts, 0u);
            EXPECT_EQ(one->contact_forces().colliders[0].angular_impulse, Vec3());
            settings.gravity.x = 0;
            one->configure(settings);
            one->step(frame_seconds);
            EXPECT_EQ(one->contact_forces().contacts.size(), 49u);
        }
        if (rounds_like_the_cpu(world)) {
            EXPECT_EQ(bits_of(world.contact_forces()), bits_of(reference.contact_forces()));
        }
    }
}

TEST(VulkanContactForces, of_a_device_that_fails_is_none) {
    for (const int lost_after : {0, 1}) {  // of a frame's two submits
        World world(checked_vulkan_backend({.intercept = losing_device::intercept}),
                    {.solver = {.substeps = 2}, .contact_forces = true});
        world.add(ground(0));
        world.add(sheet(7, {0, 0.001f, 0}));
        for (int i = 0; i < 3; ++i) EXPECT_EQ(world.step(frame_seconds).reports, report_none);
        EXPECT_EQ(world.contact_forces().contacts.size(), 49u);
        losing_device::submits_left = lost_after;
        world.advance(frame_seconds);
        EXPECT_EQ(world.contact_forces().frame, 3u);
        EXPECT_EQ(world.contact_forces().contacts.size(), 49u) << "the last that is known";
        EXPECT_EQ(world.summary().reports, report_device_failed);
        EXPECT_EQ(world.contact_forces().frame, 4u);
        EXPECT_TRUE(world.contact_forces().contacts.empty());
        EXPECT_EQ(world.contact_forces().colliders[0].force, Vec3());
    }
}

}  // namespace
}  // namespace weft
