// Which colliders are listed for a tile of particles changes the time of a frame, and nothing else.

#include "falling_cloth.h"
#include "physics/contact/shape.h"

#include <random>

namespace weft::physical {
namespace {

// A ground, and 300 balls, boxes and capsules under a sheet, some of them moving. If `listed_everywhere`, none has an
// end and all of them count as moving, so that every tile lists every collider.
std::vector<Collider> pegs(bool listed_everywhere) {
    std::mt19937 engine(3);
    const auto number = [&](float min, float max) {
        return min + (max - min) * static_cast<float>(engine() % 10007) / 10007.0f;
    };
    std::vector<ColliderDesc> all{{.shape = PlaneDesc{.offset = -0.3f}}};
    for (int i = 0; i < 300; ++i) {
        ColliderDesc desc{.transform = {.position = {number(-1, 1), number(-0.3f, 0.1f), number(-1, 1)},
                                        .rotation_degrees = {number(0, 90), number(0, 90), 0}}};
        if (i % 3 == 0) desc.shape = SphereDesc{number(0.01f, 0.05f)};
        if (i % 3 == 1) desc.shape = BoxDesc{{0.03f, number(0.01f, 0.05f), 0.02f}};
        if (i % 3 == 2) desc.shape = CapsuleDesc{0.02f, number(0.01f, 0.1f)};
        const Vec3 from = desc.transform.position;
        if (i % 5 == 0) desc.motion = {{0, from, {}}, {0.2f, {-from.z, from.y + 0.1f, from.x}, {0, 180, 0}}};
        all.push_back(desc);
    }
    std::vector<Collider> made;
    for (ColliderDesc& desc : all) {
        const TransformDesc& place = desc.transform;
        if (listed_everywhere && desc.motion.empty()) desc.motion = {{0, place.position, place.rotation_degrees}};
        made.push_back(make_collider(desc));
        if (listed_everywhere) made.back().bounds = everywhere;
    }
    return made;
}

struct PegResult {
    std::string hash;
    ContactForces forces;
};

PegResult result_over_pegs(bool listed_everywhere, std::uint32_t iterations, SelfCollision contact,
                           CpuOptions options = {}) {
    World world = make_world({.solver = {.substeps = 6, .iterations = iterations}, .contact_forces = true}, options);
    SheetDesc sheet{.resolution = {40, 40}, .position = {0, 0.16f, 0}, .layout = world.settings().layout()};
    sheet.self_collision = contact;
    world.add(make_sheet(sheet));
    for (Collider& collider : pegs(listed_everywhere)) world.add(std::move(collider));
    run(world, 0.4);
    return {world.state_hash(), world.contact_forces()};
}

void expect_same_result(const PegResult& a, const PegResult& b) {
    EXPECT_EQ(a.hash, b.hash);
    ASSERT_EQ(a.forces.colliders.size(), b.forces.colliders.size());
    for (std::size_t i = 0; i < a.forces.colliders.size(); ++i) {
        EXPECT_EQ(a.forces.colliders[i].impulse, b.forces.colliders[i].impulse) << i;
        EXPECT_EQ(a.forces.colliders[i].angular_impulse, b.forces.colliders[i].angular_impulse) << i;
        EXPECT_EQ(a.forces.colliders[i].contacts, b.forces.colliders[i].contacts) << i;
    }
    ASSERT_EQ(a.forces.contacts.size(), b.forces.contacts.size());
    for (std::size_t i = 0; i < a.forces.contacts.size(); ++i)
        EXPECT_EQ(a.forces.contacts[i].impulse, b.forces.contacts[i].impulse) << i;
}

// Labels: slow no-asan
TEST(ManyColliders, lists_change_no_bit) {
    for (const std::uint32_t iterations : {1u, 3u}) {
        const PegResult listed = result_over_pegs(false, iterations, SelfCollision::off);
        EXPECT_GT(listed.forces.contacts.size(), 50u);
        expect_same_result(listed, result_over_pegs(true, iterations, SelfCollision::off));
    }
}

// Labels: slow no-asan
TEST(ManyColliders, lists_change_no_bit_beside_contact_of_cloth) {
    expect_same_result(result_over_pegs(false, 1, SelfCollision::exact),
                       result_over_pegs(true, 1, SelfCollision::exact));
}

// Labels: slow no-asan
TEST(ManyColliders, threads_change_no_bit) {
    const PegResult one = result_over_pegs(false, 2, SelfCollision::off);
    for (const unsigned workers : {1u, 3u})
        expect_same_result(one, result_over_pegs(false, 2, SelfCollision::off, {workers}));
}

}  // namespace
}  // namespace weft::physical
