#include "editor/tools/picking.h"

#include "editor/tools/random_views.test.h"
#include "solver/world/collider_mesh.h"

#include <gtest/gtest.h>

#include <vector>

namespace weft::editor {
namespace {

constexpr Camera in_front{.position = {0, 0, 4}, .target = {}, .fov = 40};

/// A sheet in the plane z = 0 that faces +z.
TriangleMesh upright_sheet(std::uint32_t side, float z) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::uniform);
    for (Vec3& p : mesh.positions) p = {p.x, -p.z, z};
    return mesh;
}

TEST(Picking, tells_which_cloth_where_and_which_particle) {
    const TriangleMesh far = upright_sheet(5, -0.5f), near = upright_sheet(5, 0.5f);
    const TriangleTree far_tree{MeshView(far)}, near_tree{MeshView(near)};
    const std::vector<PickSurface> cloths{{.tree = &far_tree}, {.tree = nullptr}, {.tree = &near_tree}};
    const Projection view(in_front, usual_size);
    const Pick pick = pick_at(view, view.project({0.2f, 0.3f, 0.5f})->pixel, {.cloths = cloths});
    ASSERT_EQ(pick.kind, PickKind::cloth);
    EXPECT_EQ(pick.index, 2u);
    expect_close(pick.point, {0.2f, 0.3f, 0.5f}, 1e-5f);
    expect_close(pick.normal, {0, 0, 1}, 1e-6f);
    EXPECT_NEAR(pick.distance, length(pick.point - in_front.position), 1e-6f);
    EXPECT_EQ(near.positions[pick.vertex], (Vec3{0.25f, 0.25f, 0.5f}));
    const auto [a, b, c] = near.triangles[pick.triangle];
    expect_close(
        near.positions[a] * pick.weights.x + near.positions[b] * pick.weights.y + near.positions[c] * pick.weights.z,
        pick.point, 1e-5f);
    EXPECT_EQ(pick_at(view, {2, 2}, {.cloths = cloths}).kind, PickKind::nothing);
    // From behind, the far one is nearer.
    const Projection back(Camera{.position = {0, 0, -4}, .target = {}, .fov = 40}, usual_size);
    const Pick behind = pick_at(back, {640, 360}, {.cloths = cloths});
    EXPECT_EQ(behind.index, 0u);
    expect_close(behind.normal, {0, 0, -1}, 1e-6f);
}

TEST(Picking, meets_every_shape_of_a_collider_where_its_surface_is) {
    Dice dice(20);
    int hits = 0;
    for (const ColliderDesc& desc :
         {ColliderDesc{.shape = SphereDesc{0.3f}}, ColliderDesc{.shape = CapsuleDesc{}},
          ColliderDesc{.shape = BoxDesc{{0.2f, 0.3f, 0.1f}}}, ColliderDesc{.shape = TaperedCapsuleDesc{}},
          ColliderDesc{.shape = PlaneDesc{{0, 1, 0}, 0.1f}}}) {
        Collider collider = make_collider(desc);
        const TriangleMesh mesh = mesh_of(collider);
        const TriangleTree tree{MeshView(mesh)};
        for (int i = 0; i < 100; ++i) {
            collider.pose = {rotation_from_degrees(dice.point(180)), dice.point(0.3f)};
            const std::vector<PickSurface> colliders{pick_surface(collider, &tree)};
            const Projection view(dice.camera(), usual_size);
            const Vec2 pixel = dice.pixel();
            const Pick pick = pick_at(view, pixel, {.colliders = colliders});
            // Marches along the exact distance.
            const auto ray = view.ray(pixel);
            double at = 0, left = 1;
            for (int k = 0; k < 400 && at < 50 && left > 1e-5; ++k) {
                left = std::abs(signed_distance(collider, ray->origin + ray->direction * static_cast<float>(at)));
                at += left;
            }
            const Vec3 end = ray->origin + ray->direction * static_cast<float>(at);
            if (pick.kind != PickKind::collider) continue;
            ++hits;
            EXPECT_NEAR(signed_distance(collider, pick.point), 0, 2e-3) << "meshes of round shapes have corners";
            EXPECT_LE(dot(pick.normal, ray->direction), 0);
            Vec3 normal;
            signed_distance(collider, pick.point, normal);
            const bool grazing = std::abs(dot(normal, ray->direction)) < 0.2f;
            if (at < 50 && !grazing) expect_close(end, pick.point, 0.01f);
        }
    }
    EXPECT_GT(hits, 60);
}

TEST(Picking, a_plane_ends_where_its_ground_ends) {
    const Collider plane = make_collider({.shape = PlaneDesc{}});
    const std::vector<PickSurface> colliders{pick_surface(plane, nullptr)};
    const Camera camera{.position = {0, 1, 2}, .target = {0, 0, 0}, .fov = 60};
    const Projection view(camera, usual_size);
    const Pick near = pick_at(view, {640, 360}, {.colliders = colliders});
    ASSERT_EQ(near.kind, PickKind::collider);
    expect_close(near.point, {}, 1e-5f);
    expect_close(near.normal, {0, 1, 0}, 1e-6f);
    EXPECT_EQ(near.vertex, none);
    const Vec3 inside{0, 0, -13.2f}, outside{0, 0, -13.6f};  // 6 times the distance of √5
    EXPECT_EQ(pick_at(view, view.project(inside)->pixel, {.colliders = colliders}).kind, PickKind::collider);
    EXPECT_EQ(pick_at(view, view.project(outside)->pixel, {.colliders = colliders}).kind, PickKind::nothing);
    const Projection below(Camera{.position = {0, -1, 2}, .target = {}, .fov = 60}, usual_size);
    expect_close(pick_at(below, {640, 360}, {.colliders = colliders}).normal, {0, -1, 0}, 1e-6f);
}

TEST(Picking, a_surface_hides_what_lies_behind_it) {
    const TriangleMesh sheet = upright_sheet(9, 0);
    const TriangleTree tree{MeshView(sheet)};
    const std::vector<PickSurface> cloths{{.tree = &tree}};
    const Projection view(in_front, usual_size);
    EXPECT_TRUE(is_visible(view, {0.1f, 0.1f, 0.5f}, {.cloths = cloths}));
    EXPECT_TRUE(is_visible(view, {0.1f, 0.1f, 0}, {.cloths = cloths})) << "on it";
    EXPECT_TRUE(is_visible(view, {0.1f, 0.1f, -0.0005f}, {.cloths = cloths})) << "within the tolerance";
    EXPECT_FALSE(is_visible(view, {0.1f, 0.1f, -0.0015f}, {.cloths = cloths}));
    EXPECT_FALSE(is_visible(view, {0.1f, 0.1f, -0.5f}, {.cloths = cloths}));
    EXPECT_TRUE(is_visible(view, {0.7f, 0.1f, -0.5f}, {.cloths = cloths})) << "beside it";
    EXPECT_FALSE(is_visible(view, {0, 0, 5}, {})) << "behind the eye";
}

TEST(Picking, nothing_nearer_than_the_near_plane_is_picked) {
    const TriangleMesh close = upright_sheet(3, 3.99f), sheet = upright_sheet(3, 0);
    const TriangleTree close_tree{MeshView(close)}, tree{MeshView(sheet)};
    const std::vector<PickSurface> cloths{{.tree = &close_tree}, {.tree = &tree}};
    const Pick pick = pick_at(Projection(in_front, usual_size), {640, 360}, {.cloths = cloths});
    EXPECT_EQ(pick.index, 1u);
}

TEST(Picking, markers_come_first_within_their_radius) {
    const TriangleMesh sheet = upright_sheet(9, 0);
    const TriangleTree tree{MeshView(sheet)};
    const std::vector<PickSurface> cloths{{.tree = &tree}};
    const Projection view(in_front, usual_size);
    const std::vector<PickMarker> markers{{{0, 0, -1}, 8, true}, {{0.3f, 0, -1}, 8, false}, {{0, 0, 9}, 8, true}};
    const PickScene scene{.cloths = cloths, .markers = markers};
    const Vec2 first = view.project(markers[0].place)->pixel, second = view.project(markers[1].place)->pixel;
    const Pick found = pick_at(view, {first.x + 7.5f, first.y}, scene);
    EXPECT_EQ(found.kind, PickKind::marker);
    EXPECT_EQ(found.index, 0u);
    EXPECT_EQ(found.point, markers[0].place);
    EXPECT_EQ(pick_at(view, {first.x + 8.5f, first.y}, scene).kind, PickKind::cloth);
    EXPECT_EQ(pick_at(view, second, scene).kind, PickKind::cloth) << "it is hidden";
    const std::vector<PickMarker> two{{{0, 0, 1}, 20}, {{0.01f, 0, 1}, 20}};
    const Vec2 between = view.project({0.007f, 0, 1})->pixel;
    EXPECT_EQ(pick_at(view, between, {.markers = two}).index, 1u) << "the nearer one";
}

TEST(Picking, malformed_pointers_pick_nothing) {
    const TriangleMesh sheet = upright_sheet(3, 0);
    const TriangleTree tree{MeshView(sheet)};
    const std::vector<PickSurface> cloths{{.tree = &tree}};
    const std::vector<PickMarker> markers{{{nan_value, 0, 0}, 8}};
    const Projection view(in_front, usual_size);
    EXPECT_EQ(pick_at(view, {nan_value, 360}, {.cloths = cloths}).kind, PickKind::nothing);
    EXPECT_EQ(pick_at(view, {640, 360}, {.cloths = cloths, .markers = markers}).kind, PickKind::cloth);
    const Projection nothing(Camera{.position = {}, .target = {}, .fov = 40}, usual_size);
    EXPECT_EQ(pick_at(nothing, {640, 360}, {.cloths = cloths}).kind, PickKind::nothing);
    EXPECT_FALSE(is_visible(view, {nan_value, 0, 0}, {.cloths = cloths}));
}

}  // namespace
}  // namespace weft::editor
