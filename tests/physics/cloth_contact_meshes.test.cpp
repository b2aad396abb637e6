// Contact of cloth with meshes that are no grids: irregular, malformed, folded flat, with a vertex of very many
// triangles. On one thread: other tests compare thread counts, and two threads that wait for each other at the barriers
// of small passes take many times as long where other tests use the cores too.

#include "falling_cloth.h"
#include "malformed_meshes.h"

#include <numbers>
#include <random>

namespace weft::physical {
namespace {

constexpr std::array tiers{SelfCollision::exact, SelfCollision::fast};

World world_with(const TriangleMesh& mesh, SelfCollision contact, std::uint32_t substeps = 10,
                 float thickness = 0.005f) {
    World world = make_world({.solver = {.substeps = substeps}}, CpuOptions{});
    auto topology = build_topology(mesh);
    EXPECT_TRUE(topology.ok());
    Fabric fabric = find_fabric("cotton")->fabric;
    fabric.contact.thickness = thickness;
    auto model = build_cloth_model({.name = "cloth",
                                    .mesh = mesh,
                                    .fabric = fabric,
                                    .collision = {.with_cloth = contact},
                                    .layout = {.lines = true, .hierarchy = true}},
                                   std::move(*topology));
    EXPECT_TRUE(model.ok());
    world.add(*model);
    add_ground(world);
    return world;
}

TriangleMesh turned(TriangleMesh mesh, Vec3 degrees, Vec3 to) {
    const Mat3 turn = rotation_from_degrees(degrees);
    for (Vec3& p : mesh.positions) p = turn * p + to;
    return mesh;
}

// A grid with its vertices moved by up to a quarter of a cell, and diagonals by chance.
TriangleMesh irregular_sheet(std::uint32_t side, unsigned seed) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::uniform);
    mesh.uvs.clear(), mesh.triangles.clear();
    std::mt19937 chance(seed);
    std::uniform_real_distribution<float> shift(-0.25f, 0.25f);
    const float cell = 1 / static_cast<float>(side - 1);
    for (Vec3& p : mesh.positions) {
        const float dx = cell * shift(chance), dz = cell * shift(chance);
        if (std::abs(p.x) < 0.499f) p.x += dx;
        if (std::abs(p.z) < 0.499f) p.z += dz;
    }
    for (std::uint32_t z = 0; z + 1 < side; ++z) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = z * side + x, b = a + 1, c = a + side, d = c + 1;
            const bool other = chance() % 2 != 0;
            for (const Triangle t : other ? std::array<Triangle, 2>{{{a, c, d}, {a, d, b}}}
                                          : std::array<Triangle, 2>{{{a, c, b}, {b, c, d}}})
                mesh.triangles.push_back(t);
        }
    }
    return mesh;
}

// Labels: slow no-asan
TEST(ClothContactMeshes, an_irregular_sheet_that_falls_never_crosses_itself_and_comes_to_rest) {
    for (const unsigned seed : {1u, 2u}) {
        const TriangleMesh mesh = turned(irregular_sheet(28, seed), {80, 20, 45}, {0, 0.75f, 0});
        World exact = world_with(mesh, SelfCollision::exact, 20, 0.007f);
        const Outcome result = fall(exact, 5);
        EXPECT_EQ(result.worst, 0u);
        EXPECT_LT(result.speed, 0.005);
        EXPECT_EQ(result.limited, 0u);
        World fast = world_with(mesh, SelfCollision::fast, 10, 0.007f);
        (void)fall(fast, 5);
        EXPECT_EQ(crossings(fast), 0u);
    }
}

TEST(ClothContactMeshes, malformed_triangles_stay_finite) {
    for (const SelfCollision contact : tiers) {
        for (const TriangleMesh& mesh : {messy_mesh(), folded_mesh(), needle_mesh()}) {
            World world = world_with(mesh, contact);
            run(world, 1);
            EXPECT_TRUE(all_finite(world));
            EXPECT_EQ(world.frame().reports & report_non_finite, 0u);
        }
    }
}

// At distance 0 its halves have no sides; vertices at one place are one particle then.
// Labels: slow
TEST(ClothContactMeshes, a_sheet_folded_flat_onto_itself_stays_finite) {
    for (const float apart : {0.0f, 1e-6f, 0.002f}) {
        TriangleMesh mesh = make_grid({1, 1}, {21, 21}, GridDiagonal::alternating);
        mesh.uvs.clear();
        for (Vec3& p : mesh.positions)
            if (p.x > 0) p = {-p.x, apart, p.z};
        for (const SelfCollision contact : tiers) {
            World world = world_with(turned(mesh, {5, 0, 0}, {0, 0.3f, 0}), contact);
            run(world, 1);
            EXPECT_TRUE(all_finite(world)) << apart;
            EXPECT_LT(mean_speed(world), 3) << apart;
        }
    }
}

// Two disks of 1000 triangles around one vertex each: all of their edges meet near the middle, a million pairs.
// Labels: slow no-asan
TEST(ClothContactMeshes, a_million_pairs_near_one_vertex_are_survived) {
    constexpr std::uint32_t around = 1000;
    TriangleMesh disks;
    for (const float y : {0.3f, 0.31f}) {
        const auto hub = static_cast<std::uint32_t>(disks.positions.size());
        disks.positions.push_back({0.001f * y, y, 0});
        for (std::uint32_t i = 0; i < around; ++i) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / around;
            disks.positions.push_back({0.2f * std::cos(angle), y, 0.2f * std::sin(angle)});
            disks.triangles.push_back({hub, hub + 1 + i, hub + 1 + (i + 1) % around});
        }
    }
    for (const SelfCollision contact : tiers) {
        World world = world_with(disks, contact, 2, 0.01f);
        for (int frame = 0; frame < 12; ++frame) world.step(1.0 / 60);
        EXPECT_TRUE(all_finite(world));
        EXPECT_TRUE(contact == SelfCollision::fast || crossings(world) == 0);
    }
}

}  // namespace
}  // namespace weft::physical
