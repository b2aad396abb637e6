// Lists of the colliders near each tile on the device: the CPU's bits, lists that are too short or grow during a frame,
// colliders that change between frames, and what is copied and allocated.

#include "counting_device.h"
#include "vulkan_fixture.h"

#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "physics/contact/shape.h"
#include "solver/state/contact_forces.test.h"
#include "solver/world/world.h"

#include <random>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> sheet_over_pegs(std::uint32_t side, Vec3 position, Vec3 velocity,
                                                  const ClothLayout& layout) {
    ClothModelDesc desc;
    desc.name = "sheet";
    desc.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    for (Vec3& p : desc.mesh.positions) p += position;
    auto topology = build_topology(desc.mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    desc.layout = layout;
    desc.start_velocity = velocity;
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

class Numbers {
  public:
    explicit Numbers(unsigned seed) : engine_(seed) {}
    float operator()(float min, float max) {
        return min + (max - min) * static_cast<float>(engine_() % 10007) / 10007.0f;
    }

  private:
    std::mt19937 engine_;
};

// A ground, and small shapes in and around the way of a sheet. Every fifth moves and turns.
std::vector<Collider> field_of_pegs(int count) {
    Numbers number(5);
    std::vector<Collider> all{make_collider({.shape = PlaneDesc{.offset = -0.1f}})};
    for (int i = 0; i < count; ++i) {
        ColliderDesc desc{.transform = {.position = {number(-0.8f, 0.8f), number(-0.1f, 0.12f), number(-0.8f, 0.8f)},
                                        .rotation_degrees = {number(0, 90), number(0, 90), 0}},
                          .friction = {number(0.2f, 0.9f), number(0.1f, 0.2f)}};
        if (i % 4 == 0) desc.shape = SphereDesc{number(0.005f, 0.02f)};
        if (i % 4 == 1) desc.shape = BoxDesc{{0.01f, number(0.005f, 0.03f), 0.01f}};
        if (i % 4 == 2) desc.shape = CapsuleDesc{0.008f, number(0.01f, 0.04f)};
        if (i % 4 == 3) desc.shape = TaperedCapsuleDesc{{0.02f, 0.01f}, number(0.01f, 0.04f)};
        const Vec3 from = desc.transform.position;
        if (i % 5 == 0) desc.motion = {{0, from, {}}, {0.5f, {-from.z, from.y + 0.1f, from.x}, {0, 180, 0}}};
        all.push_back(make_collider(desc));
    }
    return all;
}

struct PegsFound {
    std::string hash;
    std::vector<std::uint32_t> bits;
    std::size_t contacts = 0;
    std::uint64_t repeats = 0;
    bool exact = false;
};

// `sums_only`: of frames whose contacts may be more than the device has room for. Their sums are complete.
void note(World& world, PegsFound& found, bool sums_only = false) {
    const std::uint32_t allowed = report_speed_capped | (sums_only ? report_contacts_full : report_none);
    EXPECT_EQ(world.step(frame_seconds).reports & ~allowed, report_none);
    found.repeats += world.frame().lists.repeats;
    if (!world.settings().contact_forces) return;
    ContactForces forces = world.contact_forces();
    if (sums_only) forces.contacts.clear();
    const auto more = bits_of(forces);
    found.bits.insert(found.bits.end(), more.begin(), more.end());
    found.contacts += world.contact_forces().contacts.size();
}

struct PegsCase {
    WorldSettings settings = {};
    int pegs = 1200;
    std::uint32_t side = 24;  ///< particles along a side of the larger sheet
    int frames = 5;
    Vec3 velocity = {0, -2, 0};
    bool listed_everywhere = false;
};

PegsFound play_pegs(std::unique_ptr<Backend> backend, const PegsCase& test) {
    World world(std::move(backend), test.settings);
    for (Collider& collider : field_of_pegs(test.pegs)) {
        if (test.listed_everywhere) collider.bounds = everywhere;
        const ColliderId id = world.add(collider);
        // What counts as moving is listed however far away it is.
        if (test.listed_everywhere && collider.motion.empty()) world.move(id, collider.pose);
    }
    world.add(sheet_over_pegs(test.side, {0, 0.15f, 0}, test.velocity, test.settings.layout()));
    world.add(sheet_over_pegs(7, {0.1f, 0.25f, 0}, {0, -4, 0}, test.settings.layout()));
    PegsFound found;
    found.exact = rounds_like_the_cpu(world);
    for (int i = 0; i < test.frames; ++i) note(world, found);
    found.hash = world.state_hash();
    return found;
}

void expect_the_same(const PegsFound& one, const PegsFound& other, const std::string& what) {
    EXPECT_EQ(one.hash, other.hash) << what;
    EXPECT_EQ(one.bits, other.bits) << what;
}

PegsFound play_pegs_on_cpu(const PegsCase& test) {
    return play_pegs(std::move(*make_cpu_backend()), test);
}

// lavapipe leaves the loops of a shader after 65535 rounds, so that a face must not be near too many pegs.
// Labels: slow no-asan long
TEST(VulkanManyColliders, have_the_bits_of_the_cpu) {
    for (const std::uint32_t iterations : {1u, 3u}) {
        PegsCase test{{.solver = {.substeps = 3, .iterations = iterations}, .contact_forces = true}};
        test.pegs = 300;
        test.side = 18;
        test.frames = 4;
        const PegsFound expected = play_pegs_on_cpu(test);
        EXPECT_GT(expected.contacts, 150u);
        const PegsFound found = play_pegs(checked_vulkan_backend({.execution = "streamed"}), test);
        if (found.exact) expect_the_same(found, expected, "streamed");
    }
}

// A whole frame in one dispatch. For the same reason the sheet is small.
PegsCase small_case() {
    PegsCase test{{.solver = {.substeps = 3, .iterations = 2}, .contact_forces = true}};
    test.pegs = 400;
    test.side = 9;
    return test;
}

// Labels: slow no-asan long
TEST(VulkanManyColliders, have_the_bits_of_the_cpu_in_a_fused_frame) {
    const PegsFound expected = play_pegs_on_cpu(small_case());
    EXPECT_GT(expected.contacts, 50u);
    const PegsFound found = play_pegs(checked_vulkan_backend({.execution = "fused"}), small_case());
    if (found.exact) expect_the_same(found, expected, "fused");
}

// Labels: slow no-asan long
TEST(VulkanManyColliders, lists_change_no_bit) {
    PegsCase test{{.solver = {.substeps = 2, .iterations = 2}, .contact_forces = true}};
    test.pegs = 150;
    test.side = 16;
    const PegsFound listed = play_pegs(checked_vulkan_backend(), test);
    EXPECT_GT(listed.contacts, 50u);
    test.listed_everywhere = true;
    expect_the_same(play_pegs(checked_vulkan_backend(), test), listed, "all listed");
}

// The first lists have too few slots. All cloths go back to the start of the frame, also those whose lists were not
// full.
// Labels: slow no-asan long
TEST(VulkanManyColliders, a_full_list_makes_the_frame_run_again) {
    PegsCase test = small_case();
    const PegsFound expected = play_pegs_on_cpu(test);
    test.settings.list_capacity = 1;
    for (const char* execution : {"streamed", "fused"}) {
        const PegsFound found = play_pegs(checked_vulkan_backend({.execution = execution}), test);
        EXPECT_GT(found.repeats, 0u) << execution;
        EXPECT_LT(found.repeats, 20u) << execution;
        if (found.exact) expect_the_same(found, expected, execution);
    }
}

// A plate throws the sheet into the pegs above, faster than its tiles expect: they leave their boxes during a frame, in
// any substep and iteration, with contacts that have been counted before.
PegsFound play_plate(std::unique_ptr<Backend> backend, std::uint32_t iterations, std::uint32_t side) {
    World world(std::move(backend), {.solver = {.substeps = 6, .iterations = iterations}, .contact_forces = true});
    Numbers number(9);
    for (int i = 0; i < 300; ++i)
        world.add(
            make_collider({.shape = SphereDesc{number(0.01f, 0.03f)},
                           .transform = {.position = {number(-0.6f, 0.6f), number(0.1f, 0.5f), number(-0.6f, 0.6f)}}}));
    world.add(
        make_collider({.shape = BoxDesc{{0.4f, 0.05f, 0.4f}},
                       .motion = {{0, {0, -0.06f, 0}, {}}, {0.02f, {0, -0.06f, 0}, {}}, {0.05f, {0, 0.4f, 0}, {}}}}));
    world.add(sheet_over_pegs(side, {}, {}, world.settings().layout()));
    PegsFound found;
    found.exact = rounds_like_the_cpu(world);
    for (int i = 0; i < 2; ++i) note(world, found, true);
    found.hash = world.state_hash();
    return found;
}

// Labels: slow no-asan long
TEST(VulkanManyColliders, a_tile_that_leaves_its_box_keeps_what_its_contacts_add_up) {
    const auto compare = [](const char* execution, std::uint32_t iterations, std::uint32_t side, std::size_t contacts) {
        const PegsFound expected = play_plate(std::move(*make_cpu_backend()), iterations, side);
        EXPECT_GT(expected.contacts, contacts);
        const PegsFound found = play_plate(checked_vulkan_backend({.execution = execution}), iterations, side);
        if (found.exact) expect_the_same(found, expected, execution);
    };
    compare("streamed", 1, 20, 200);
    compare("streamed", 4, 20, 200);
    compare("fused", 2, 8, 20);
}

PegsFound play_changes(std::unique_ptr<Backend> backend) {
    World world(std::move(backend), {.solver = {.substeps = 3}, .contact_forces = true});
    world.add(sheet_over_pegs(16, {0, 0.03f, 0}, {}, world.settings().layout()));
    std::vector<ColliderId> pegs;
    for (int i = 0; i < 60; ++i)
        pegs.push_back(
            world.add(make_collider({.shape = SphereDesc{0.05f},
                                     .transform = {.position = {0.1f * static_cast<float>(i % 8) - 0.4f, 0,
                                                                0.1f * static_cast<float>(i / 8) - 0.4f}}})));
    PegsFound found;
    found.exact = rounds_like_the_cpu(world);
    const auto play = [&] {
        for (int i = 0; i < 2; ++i) note(world, found);
    };
    play();
    world.set_friction(pegs[20], {0.9f, 0.8f});
    play();
    world.move(pegs[27], {{}, {0, 0.05f, 0}});  // the first that moves
    play();
    world.remove(pegs[10]);
    play();
    for (int i = 0; i < 40; ++i)
        world.add(make_collider({.shape = BoxDesc{{0.02f, 0.09f, 0.02f}},
                                 .transform = {.position = {0.01f * static_cast<float>(i), 0, -0.2f}}}));
    world.set_friction(pegs[3], {0.1f, 0.05f});
    play();
    const Snapshot snapshot = world.save();
    play();
    EXPECT_TRUE(world.restore(snapshot).ok());
    play();
    WorldSettings settings = world.settings();
    settings.solver.substeps = 5;
    world.configure(settings);
    world.move(pegs[28], {{}, {0.1f, 0.05f, 0}});
    play();
    for (std::size_t i = 0; i < pegs.size(); ++i)
        if (i != 10) world.remove(pegs[i]);
    play();
    found.hash = world.state_hash();
    return found;
}

// Labels: slow no-asan long
TEST(VulkanManyColliders, may_change_between_frames) {
    const PegsFound expected = play_changes(std::move(*make_cpu_backend())),
                    found = play_changes(checked_vulkan_backend());
    EXPECT_GT(expected.contacts, 500u);
    if (found.exact) expect_the_same(found, expected, "changes");
}

int submits_of_a_frame(World& world) {
    counting_device::submits = 0;
    (void)world.step(frame_seconds);
    return counting_device::submits;
}

// Labels: no-asan long
TEST(VulkanManyColliders, are_copied_only_if_they_have_changed) {
    World world(checked_vulkan_backend({.intercept = counting_device::intercept}), {.solver = {.substeps = 2}});
    world.add(sheet_over_pegs(9, {0, 1, 0}, {}, world.settings().layout()));
    std::vector<ColliderId> balls;
    for (int i = 0; i < 20; ++i) balls.push_back(world.add(make_collider({.shape = SphereDesc{0.1f}})));
    const int first = submits_of_a_frame(world), at_rest = submits_of_a_frame(world);
    EXPECT_GT(first, at_rest);
    world.set_friction(balls[3], {0.8f, 0.7f});
    EXPECT_EQ(submits_of_a_frame(world), at_rest + 1) << "the friction too";
    EXPECT_EQ(submits_of_a_frame(world), at_rest);
    world.move(balls[3], {{}, {0, 0.1f, 0}});
    EXPECT_EQ(submits_of_a_frame(world), at_rest + 1) << "the poses too";
}

// Labels: no-asan
TEST(VulkanManyColliders, need_no_cloth) {
    World world(checked_vulkan_backend(), {.solver = {.substeps = 2}});
    const ColliderId ball = world.add(make_collider({.shape = SphereDesc{0.1f}}));
    for (int i = 0; i < 6; ++i) {
        world.move(ball, {{}, {0, 0.1f * static_cast<float>(i), 0}});
        if (i == 3) world.add(sheet_over_pegs(9, {0, 0.4f, 0}, {}, world.settings().layout()));
        EXPECT_EQ(world.step(frame_seconds).reports & ~report_speed_capped, report_none);
    }
}

// Sums and the contact log have room for what is near a tile.
// Labels: no-asan long
TEST(VulkanManyColliders, far_away_take_little_memory) {
    const auto bytes = [](int colliders) {
        World world(checked_vulkan_backend(), {.solver = {.substeps = 2, .iterations = 2}, .contact_forces = true});
        world.add(sheet_over_pegs(40, {}, {}, world.settings().layout()));
        for (int i = 0; i < colliders; ++i)
            world.add(make_collider(
                {.shape = SphereDesc{0.1f}, .transform = {.position = {10.0f + static_cast<float>(i), 0, 0}}}));
        for (int i = 0; i < 2; ++i) (void)world.step(frame_seconds);
        EXPECT_EQ(world.frame().lists.repeats, 0u);
        return world.backend().device_bytes();
    };
    constexpr std::uint64_t of_each = 1000;
    EXPECT_LT(bytes(2004), bytes(4) + 2000 * of_each);
}

// A number that is not finite makes no list endless, and is named.
// Labels: no-asan
TEST(VulkanManyColliders, survive_numbers_that_are_not_finite) {
    World world(checked_vulkan_backend(), {.solver = {.substeps = 2}});
    for (Collider& collider : field_of_pegs(100)) world.add(std::move(collider));
    world.add(sheet_over_pegs(9, {0, 0.1f, 0}, {}, world.settings().layout()));
    const std::string before = world.state_hash();
    WorldSettings settings = world.settings();
    settings.gravity.x = std::numeric_limits<float>::infinity();
    world.configure(settings);
    EXPECT_EQ(world.step(frame_seconds).reports & report_non_finite, report_non_finite);
    EXPECT_EQ(world.frame().lists.repeats, 0u);
    EXPECT_EQ(world.state_hash(), before);
}

}  // namespace
}  // namespace weft
