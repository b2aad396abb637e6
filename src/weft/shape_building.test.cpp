#include "weft/shape_building.h"

#include "mesh/procedural.h"
#include "physics/scalar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace weft {
namespace {

// A wedge that has another size and another side along each axis: the part below y = x / 2, z from 0 to 1.
TriangleMesh wedge() {
    return {.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 0, 1}, {2, 0, 1}, {2, 1, 1}},
            .triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {0, 5, 2}, {0, 3, 5}}};
}

std::shared_ptr<const ShapeData> shape_of(const ColliderDesc& collider) {
    std::vector<std::string> notes;
    ShapeLibrary library;
    auto data = library.data_of(collider, {}, "/colliders/0", notes);
    EXPECT_TRUE(data.ok() && *data);
    return data.ok() ? *data : nullptr;
}

float distance_of_mesh(const ShapeData& data, Vec3 p) {
    scalar::vec3 normal;
    return scalar::distance_mesh({p.x, p.y, p.z}, {0, 0, 0, 0, data.blocks()}, normal);
}
float distance_of_hull(const ShapeData& data, Vec3 p) {
    scalar::vec3 normal;
    return scalar::distance_convex({p.x, p.y, p.z}, {0, 0, 0, 0, data.blocks()}, normal);
}

double volume_of(const TriangleMesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += double{dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c]))} / 6;
    return volume;
}

TEST(ScaledShapes, keep_their_inside) {
    ASSERT_NEAR(volume_of(wedge()), 1, 1e-6);
    for (const Vec3 scale : {Vec3{1, 1, 1}, Vec3{-1, 1, 1}, Vec3{0.5f, -2, 1.5f}, Vec3{-1, -1, 2}, Vec3{-1, -1, -1}}) {
        const auto solid = shape_of({.shape = SolidMeshDesc{.scale = scale, .mesh = wedge(), .resolution = 32}});
        const auto hull = shape_of({.shape = ConvexDesc{.scale = scale, .mesh = wedge()}});
        ASSERT_TRUE(solid && hull);
        EXPECT_NEAR(volume_of(solid->surface), std::abs(double{scale.x * scale.y * scale.z}), 1e-5) << "it faces out";
        const auto scaled = [&](Vec3 p) { return Vec3{p.x * scale.x, p.y * scale.y, p.z * scale.z}; };
        for (const Vec3 in : {Vec3{1.6f, 0.3f, 0.5f}, Vec3{1.2f, 0.2f, 0.3f}}) {
            EXPECT_LT(distance_of_mesh(*solid, scaled(in)), -0.01f);
            EXPECT_LT(distance_of_hull(*hull, scaled(in)), -0.01f);
        }
        for (const Vec3 out : {Vec3{0.4f, 0.6f, 0.5f}, Vec3{-0.3f, 0.2f, 0.5f}, Vec3{1, 0.2f, -0.3f}}) {
            EXPECT_GT(distance_of_mesh(*solid, scaled(out)), 0.01f);
            EXPECT_GT(distance_of_hull(*hull, scaled(out)), 0.01f);
        }
        for (const Vec3 n : solid->surface.normals) EXPECT_NEAR(length(n), 1, 1e-5);
        const Vec3 size{std::abs(2 * scale.x), std::abs(scale.y), std::abs(scale.z)};
        EXPECT_EQ(solid->bounds.size(), size);
    }
}

}  // namespace
}  // namespace weft
