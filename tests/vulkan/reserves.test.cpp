// Cloths with room for more particles on the device: the same bits as on the CPU, with each kind of contact and of
// tearing.

#include "vulkan_fixture.h"

#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "solver/model/cuts.h"

namespace weft {
namespace {

struct ReserveCase {
    SelfCollision contact;
    ClothReserve reserve;
};

// It hangs by two corners; springs hold the other two. So there are particles in reserve and anchors after the others.
std::shared_ptr<const ClothModel> sheet_with_reserve(Vec3 at, float size, const ReserveCase& test) {
    TriangleMesh mesh = make_grid({size, size}, {13, 13}, GridDiagonal::uniform);
    for (Vec3& p : mesh.positions) p += at;
    auto topology = build_topology(mesh, {.reorder = false});
    ClothModelDesc desc{.name = "sheet", .collision = {test.contact}, .reserve = test.reserve};
    desc.pins.particles = {0, 12};
    for (const std::uint32_t p : {156u, 168u})
        desc.pins.attachments.push_back({p, 1e-3f, mesh.positions[p] + Vec3{0, 0.05f, 0}});
    desc.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

// The ball is round and small, so the cloth's faces touch it as well as its particles.
std::string hash_after_contact(std::unique_ptr<Backend> backend, const ReserveCase& test, bool& exact) {
    World world(std::move(backend), {.solver = {.substeps = 2}});
    exact = rounds_like_the_cpu(world);
    world.add(make_collider({.name = "ball", .shape = SphereDesc{0.2f}}));
    const auto model = sheet_with_reserve({0, 0.21f, 0}, 1, test);
    const ClothId sheet = world.add(model);
    world.add(sheet_with_reserve({0.1f, 0.23f, 0.1f}, 0.5f, test));
    for (int i = 0; i < 2; ++i) world.step(frame_seconds);
    if (test.reserve.openings && test.reserve.particles > 0) {
        EXPECT_TRUE(world.edit(sheet, {.openings = openings_along_plane(*model, model->start, {}, {1, 0, 0})}).ok());
        for (int i = 0; i < 2; ++i) world.step(frame_seconds);
    }
    return world.state_hash();
}

// Labels: slow no-asan long
TEST(Reserves, have_the_bits_of_the_cpu_with_every_contact_and_tearing) {
    const ReserveCase cases[] = {
        {SelfCollision::off, {}},
        {SelfCollision::off, {.particles = 8}},
        {SelfCollision::off, {.particles = 40}},
        {SelfCollision::off, {.particles = 40, .openings = true, .tears = true}},
        {SelfCollision::fast, {.particles = 40, .openings = true, .tears = true}},
        {SelfCollision::exact, {.particles = 40, .openings = true}},
        {SelfCollision::exact, {.particles = 40, .openings = true, .tears = true, .erodes = true}}};
    for (const ReserveCase& test : cases) {
        bool exact = true;
        const std::string expected = hash_after_contact(std::move(*make_cpu_backend()), test, exact);
        const std::string found = hash_after_contact(checked_vulkan_backend(), test, exact);
        if (!exact) continue;
        EXPECT_EQ(found, expected) << "contact " << static_cast<int>(test.contact) << ", " << test.reserve.particles
                                   << " in reserve, openings " << test.reserve.openings << test.reserve.tears
                                   << test.reserve.erodes;
    }
}

}  // namespace
}  // namespace weft
