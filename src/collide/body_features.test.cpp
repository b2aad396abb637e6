#include "collide/body_features.h"

#include "collide/convex_hull.h"
#include "collide/distance_field.h"
#include "mesh/procedural.h"
#include "physics/contact/shapes.def"
#include "physics/scalar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace weft {
namespace {

ShapeData shape_data(std::span<const Vec3> points) {
    const auto hull = convex_hull(points);
    EXPECT_TRUE(hull.ok());
    return hull ? make_convex_data(*hull) : ShapeData{};
}

ShapeData solid_data(const TriangleMesh& mesh) {
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = 16});
    EXPECT_TRUE(field.ok());
    if (!field) return {};
    field->data.bounds = bounds_of(mesh.positions);
    field->data.surface = mesh;
    return std::move(field->data);
}

// Every ball of the features touches the surface of the shape from within. `distance(p)` is the shape's.
template <class Distance>
void expect_on_surface(const BodyFeatures& features, Distance&& distance, double tolerance) {
    const auto touches = [&](Vec3 p, float radius) {
        EXPECT_NEAR(double{distance(p)} + double{radius}, 0, tolerance) << p.x << ' ' << p.y << ' ' << p.z;
    };
    for (const RoundPoint& point : features.points) touches(point.place, point.radius);
    for (const RoundEdge& edge : features.edges) {
        for (const float at : {0.0f, 0.3f, 0.5f, 0.9f, 1.0f})
            touches(edge.from + (edge.to - edge.from) * at,
                    edge.radius_from + (edge.radius_to - edge.radius_from) * at);
    }
}

scalar::ShapeNumbers numbers_of(const std::array<float, 4>& n, const ShapeData* data = nullptr) {
    return {n[0], n[1], n[2], n[3], data ? data->blocks() : ShapeBlocks{}};
}

TEST(BodyFeatures, of_round_shapes) {
    EXPECT_EQ(features_of(SphereDesc{.radius = 0.3f}, nullptr), (BodyFeatures{.points = {{{}, 0.3f}}, .edges = {}}));
    const BodyFeatures capsule = features_of(CapsuleDesc{.radius = 0.1f, .half_height = 0.5f}, nullptr);
    EXPECT_EQ(capsule.points, (std::vector<RoundPoint>{{{0, -0.5f, 0}, 0.1f}, {{0, 0.5f, 0}, 0.1f}}));
    EXPECT_EQ(capsule.edges, (std::vector<RoundEdge>{{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.1f, 0.1f}}));
    EXPECT_EQ(features_of(CapsuleDesc{.radius = 0.1f, .half_height = 0}, nullptr),
              features_of(SphereDesc{.radius = 0.1f}, nullptr));
    const BodyFeatures tapered = features_of(TaperedCapsuleDesc{.radius = {0.1f, 0.2f}, .half_height = 0.5f}, nullptr);
    EXPECT_EQ(tapered.points, (std::vector<RoundPoint>{{{0, -0.5f, 0}, 0.1f}, {{0, 0.5f, 0}, 0.2f}}));
    EXPECT_EQ(tapered.edges, (std::vector<RoundEdge>{{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.1f, 0.2f}}));
}

TEST(BodyFeatures, of_a_ball_that_holds_another_one) {
    for (const bool low : {true, false}) {
        const TaperedCapsuleDesc shape{.radius = {low ? 0.3f : 0.1f, low ? 0.1f : 0.3f}, .half_height = 0.1f};
        const BodyFeatures features = features_of(shape, nullptr);
        EXPECT_EQ(features.points, (std::vector<RoundPoint>{{{0, low ? -0.1f : 0.1f, 0}, 0.3f}}));
        EXPECT_TRUE(features.edges.empty());
    }
}

TEST(BodyFeatures, of_a_box) {
    const BoxDesc box{.half_extents = {1, 2, 3}};
    const BodyFeatures features = features_of(box, nullptr);
    EXPECT_EQ(features.points.size(), 8u);
    ASSERT_EQ(features.edges.size(), 12u);
    int of_length[3] = {};
    for (const RoundEdge& edge : features.edges)
        ++of_length[static_cast<int>(length(edge.to - edge.from) / 2 + 0.5f) - 1];
    for (const int count : of_length) EXPECT_EQ(count, 4);
    const auto distance = [&](Vec3 p) {
        scalar::vec3 normal;
        return scalar::distance_box({p.x, p.y, p.z}, numbers_of(shape_numbers(box)), normal);
    };
    expect_on_surface(features, distance, 1e-6);
}

TEST(BodyFeatures, of_a_hull_are_those_of_the_polyhedron) {
    const TriangleMesh box = make_box({1, 0.5f, 2}, {3, 4, 5});
    const ShapeData data = shape_data(box.positions);
    const ConvexDesc shape{.radius = 0.1f};
    const BodyFeatures features = features_of(shape, &data);
    EXPECT_EQ(features.points.size(), 8u);
    EXPECT_EQ(features.edges.size(), 12u);
    const auto distance = [&](Vec3 p) {
        scalar::vec3 normal;
        return scalar::distance_convex({p.x, p.y, p.z}, numbers_of(shape_numbers(shape), &data), normal);
    };
    expect_on_surface(features, distance, 1e-6);
    for (const RoundPoint& point : features.points) EXPECT_EQ(point.radius, 0.1f);
}

TEST(BodyFeatures, of_hulls_have_all_edges) {
    const TriangleMesh ball = make_sphere(1, 2);
    std::vector<Vec3> tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto& points : {std::vector<Vec3>(ball.positions), tetrahedron}) {
        const auto hull = convex_hull(points);
        ASSERT_TRUE(hull.ok());
        const ShapeData data = make_convex_data(*hull);
        const BodyFeatures features = features_of(ConvexDesc{}, &data);
        EXPECT_EQ(features.points.size(), hull->vertices.size());
        ASSERT_EQ(features.edges.size(), hull->edges.size());
        const auto key = [](Vec3 a, Vec3 b) {
            const auto of = [](Vec3 p) { return std::array{p.x, p.y, p.z}; };
            return of(a) < of(b) ? std::pair(of(a), of(b)) : std::pair(of(b), of(a));
        };
        std::set<std::pair<std::array<float, 3>, std::array<float, 3>>> expected, got;
        for (const auto& [a, b] : hull->edges) expected.insert(key(hull->vertices[a], hull->vertices[b]));
        for (const RoundEdge& edge : features.edges) got.insert(key(edge.from, edge.to));
        EXPECT_EQ(got, expected);
    }
}

TEST(BodyFeatures, of_a_mesh_are_those_of_a_small_hull) {
    const TriangleMesh ball = make_sphere(0.5f, 5);
    const ShapeData data = solid_data(ball);
    const BodyFeatures features = features_of(SolidMeshDesc{}, &data);
    EXPECT_LE(features.points.size(), most_mesh_points);
    EXPECT_GE(features.points.size(), most_mesh_points / 2);
    EXPECT_GE(features.edges.size(), features.points.size());
    for (const RoundPoint& point : features.points) EXPECT_NEAR(length(point.place), 0.5f, 1e-6);
    const ShapeData box = solid_data(make_box({1, 2, 3}, {3, 3, 3}));
    EXPECT_EQ(features_of(SolidMeshDesc{}, &box).points.size(), 8u);
    EXPECT_EQ(features_of(SolidMeshDesc{}, &box).edges.size(), 12u);
}

TEST(BodyFeatures, of_a_flat_mesh_are_those_of_the_sheet_that_cloth_meets) {
    const ShapeData data = solid_data(make_grid({1, 0.5f}, {5, 3}, GridDiagonal::alternating));
    const BodyFeatures features = features_of(SolidMeshDesc{}, &data);
    EXPECT_EQ(features.points.size(), 8u);
    EXPECT_EQ(features.edges.size(), 12u);
    for (const RoundPoint& point : features.points)
        EXPECT_TRUE(std::abs(point.place.y) < 1e-6f || std::abs(point.place.y + 2.0f / 16) < 1e-6f) << point.place.y;
}

TEST(BodyFeatures, of_a_plane_are_none) {
    EXPECT_EQ(features_of(PlaneDesc{}, nullptr), BodyFeatures{});
}

}  // namespace
}  // namespace weft
