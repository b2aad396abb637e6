// Mesh colliders with holes, flipped triangles and overlapping parts, mirrored and unevenly scaled: cloth lies on them
// as on the closed, plain mesh.

#include "files/surface_crossings.test.h"
#include "mesh/procedural.h"
#include "scene/fabric.h"
#include "solver/measures/penetration.h"
#include "weft/scene_world.h"

#include <weft/weft.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace weft {
namespace {

template <class Keep>
TriangleMesh part_of(TriangleMesh mesh, Keep&& keep) {
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return !keep((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0f);
    });
    return mesh;
}

// With a fan of triangles over its only hole.
TriangleMesh closed(TriangleMesh mesh) {
    std::map<std::array<std::uint32_t, 2>, int> uses;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    Vec3 sum{};
    float count = 0;
    for (const auto& [edge, times] : uses) {
        if (uses.contains({edge[1], edge[0]})) continue;
        mesh.triangles.push_back({edge[1], edge[0], middle});
        sum = sum + mesh.positions[edge[0]], ++count;
    }
    mesh.positions.push_back(sum / count);
    return mesh;
}

TriangleMesh joined(TriangleMesh mesh, const TriangleMesh& other, Vec3 offset) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : other.positions) mesh.positions.push_back(p + offset);
    for (const auto [a, b, c] : other.triangles) mesh.triangles.push_back({base + a, base + b, base + c});
    return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, Vec3 by) {
    for (Vec3& p : mesh.positions) p = {p.x * by.x, p.y * by.y, p.z * by.z};
    if (by.x * by.y * by.z < 0)
        for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
    return mesh;
}

ColliderDesc solid_of_mesh(TriangleMesh mesh, Vec3 scale = {1, 1, 1}, std::uint32_t cells = 40) {
    return {.shape = SolidMeshDesc{
                .scale = scale, .mesh = std::move(mesh), .resolution = cells, .contact = MeshContact::solid}};
}

struct Lying {
    std::vector<Vec3> positions;
    double deepest = 0;  // m, of every tenth frame
};

Lying lie_on(std::vector<ColliderDesc> colliders) {
    SceneDesc scene;
    SceneCloth& sheet = scene.cloths.emplace_back();
    sheet.mesh = GridDesc{.size = {0.36f, 0.36f}, .resolution = {19, 19}};
    sheet.fabric = find_fabric("leather")->fabric;  // it does not wrinkle, so that small differences stay small
    sheet.fabric.contact.friction[0] = sheet.fabric.contact.friction[1] = 4;
    sheet.transform = {.position = {0.013f, 0.22f, 0.007f}, .rotation_degrees = {0, 17, 0}};
    for (ColliderDesc& collider : colliders) {
        collider.name = "collider " + std::to_string(scene.colliders.size());
        scene.colliders.push_back(std::move(collider));
    }
    auto world = SceneWorld::create(scene, {.backend = "cpu"});
    EXPECT_TRUE(world.ok()) << world.error().message();
    Lying lying;
    PenetrationSearch search;
    for (int i = 0; i < 60; ++i) {
        const Frame& frame = world->step();
        EXPECT_EQ(frame.reports & report_non_finite, 0u);
        if (i % 10 == 9) lying.deepest = std::max(lying.deepest, search.measure(frame, world->world().colliders()).max);
    }
    for (const Vec4& x : world->world().frame().cloths[0].positions) lying.positions.push_back(x.xyz());
    return lying;
}

struct Difference {
    double rms = 0, largest = 0;  // m
};
Difference between(const Lying& one, const Lying& other) {
    Difference result;
    for (std::size_t p = 0; p < one.positions.size(); ++p) {
        const double d = double{length(one.positions[p] - other.positions[p])};
        result.rms += d * d, result.largest = std::max(result.largest, d);
    }
    result.rms = std::sqrt(result.rms / static_cast<double>(one.positions.size()));
    return result;
}

void expect_alike(const Lying& one, const Lying& other, double rms, double largest, const char* name) {
    const Difference difference = between(one, other);
    std::printf("%-28s rms %.3f mm, largest %.3f mm, deepest %.3f and %.3f mm\n", name, difference.rms * 1e3,
                difference.largest * 1e3, one.deepest * 1e3, other.deepest * 1e3);
    EXPECT_LT(difference.rms, rms) << name;
    EXPECT_LT(difference.largest, largest) << name;
    EXPECT_LT(one.deepest, 1e-3) << name;
    EXPECT_LT(other.deepest, 1e-3) << name;
}

// Labels: slow no-asan
TEST(OddMeshes, without_a_part_hold_cloth_as_the_closed_ones) {
    const TriangleMesh ball = make_sphere(0.2f, 4);
    const Lying on_ball = lie_on({solid_of_mesh(ball)});
    const auto without = [&](auto&& keep) { return lie_on({solid_of_mesh(part_of(ball, keep))}); };
    expect_alike(without([](Vec3 p) { return p.y > -0.16f; }), on_ball, 2e-3, 0.015, "hole below");
    expect_alike(without([](Vec3 p) {
                     return length(p - Vec3{0, 0.2f, 0}) > 0.02f;
                 }),
                 on_ball, 4e-3, 0.015, "hole on top");
    const TriangleMesh half = part_of(ball, [](Vec3 p) { return p.y > 0; });
    expect_alike(lie_on({solid_of_mesh(half)}), lie_on({solid_of_mesh(closed(half))}), 1e-3, 5e-3, "half shell");
}

// Labels: no-asan
TEST(OddMeshes, with_flipped_triangles_and_parts_inside_have_the_same_field) {
    const TriangleMesh ball = make_sphere(0.2f, 4);
    TriangleMesh flipped = ball, inverted = ball;
    for (std::size_t t = 0; t < flipped.triangles.size(); t += 5)
        std::swap(flipped.triangles[t][0], flipped.triangles[t][1]);
    for (Triangle& t : inverted.triangles) std::swap(t[0], t[1]);
    const Lying on_ball = lie_on({solid_of_mesh(ball)});
    EXPECT_LT(on_ball.deepest, 1e-3);
    EXPECT_EQ(lie_on({solid_of_mesh(flipped)}).positions, on_ball.positions);
    EXPECT_EQ(lie_on({solid_of_mesh(inverted)}).positions, on_ball.positions);
    EXPECT_EQ(lie_on({solid_of_mesh(joined(ball, make_sphere(0.15f, 3), {}))}).positions, on_ball.positions);
}

// Labels: no-asan
TEST(OddMeshes, of_overlapping_parts_hold_cloth_as_the_parts) {
    const TriangleMesh ball = make_sphere(0.15f, 4), box = make_box({0.2f, 0.2f, 0.2f}, {2, 2, 2});
    const Vec3 aside{0.12f, 0.03f, 0.02f};
    const auto parts = [&](const TriangleMesh& one) {
        ColliderDesc second = solid_of_mesh(one, {1, 1, 1}, 64);
        second.transform.position = aside;
        return lie_on({solid_of_mesh(one, {1, 1, 1}, 64), second});
    };
    const auto together = [&](const TriangleMesh& one) {
        return lie_on({solid_of_mesh(joined(one, one, aside), {1, 1, 1}, 96)});
    };
    expect_alike(together(ball), parts(ball), 3e-3, 0.015, "two balls");
    // The corner that hangs over an edge still swings after a second.
    expect_alike(together(box), parts(box), 0.01, 0.06, "two boxes");
}

// Labels: no-asan
TEST(OddMeshes, mirrored_and_scaled_unevenly_are_those_with_such_vertices) {
    const TriangleMesh mesh =
        joined(make_sphere(0.2f, 4), make_box({0.1f, 0.1f, 0.2f}, {2, 2, 2}), {0.2f, 0.05f, 0.05f});
    for (const Vec3 scale : {Vec3{-1, 1, 1}, Vec3{1, 0.5f, 0.8f}, Vec3{-1, -0.7f, -1.2f}}) {
        EXPECT_EQ(lie_on({solid_of_mesh(mesh, scale)}).positions,
                  lie_on({solid_of_mesh(scaled(mesh, scale))}).positions)
            << scale.x << ", " << scale.y << ", " << scale.z;
    }
}

}  // namespace
}  // namespace weft
