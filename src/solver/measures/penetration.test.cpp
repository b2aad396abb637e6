#include "solver/measures/penetration.h"

#include "collide/convex_hull.h"
#include "collide/distance_field.h"
#include "mesh/procedural.h"
#include "solver/measures/passages.h"
#include "solver/measures/statistics.h"
#include "solver/model/cloth_edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft {
namespace {

// A frame of one cloth whose positions a test sets.
struct Sheet {
    std::shared_ptr<const ClothModel> model;
    std::vector<Vec4> positions;

    explicit Sheet(TriangleMesh mesh, ClothReserve reserve = {}) {
        ClothModelDesc desc{.name = "sheet", .mesh = std::move(mesh), .reserve = reserve};
        auto topology = build_topology(desc.mesh, {.reorder = false});
        EXPECT_TRUE(topology.ok());
        auto made = build_cloth_model(std::move(desc), std::move(*topology));
        EXPECT_TRUE(made.ok());
        model = *made;
        positions.assign(model->start.begin(), model->start.begin() + model->particle_count);
    }
    /// The triangle gets particles of its own.
    void part_triangle(std::uint32_t triangle) {
        const auto [a, b, c] = model->triangles()[triangle];
        const std::uint32_t first = model->particle_count;
        auto edited = with_edit(
            *model,
            {.appended = {a, b, c}, .triangles = {{.triangle = triangle, .corners = {first, first + 1, first + 2}}}});
        ASSERT_TRUE(edited.ok()) << edited.error().message();
        model = *edited;
        for (const std::uint32_t p : {a, b, c}) positions.push_back(Vec4(positions[p]));
    }
    void shift(Vec3 by) {
        for (Vec4& p : positions) p = {p.x + by.x, p.y + by.y, p.z + by.z, p.w};
    }
    Frame frame(std::uint64_t index = 0) const {
        Frame frame;
        frame.index = index;
        ClothFrame cloth;
        cloth.model = model.get();
        cloth.positions = positions;
        cloth.triangles = model->triangles();
        frame.cloths.push_back(cloth);
        return frame;
    }
};

// Level, at height 0, around the origin; with two cells of 1 m the origin is a corner, with one it is on the diagonal.
TriangleMesh grid(std::uint32_t side) {
    return make_grid({2, 2}, {side, side}, GridDiagonal::uniform);
}

Penetration measured(const Sheet& sheet, const std::vector<Collider>& colliders) {
    return PenetrationSearch().measure(sheet.frame(), colliders);
}

Collider placed(ColliderDesc desc, Vec3 position, Vec3 degrees = {}) {
    desc.transform = {.position = position, .rotation_degrees = degrees};
    return make_collider(desc);
}

std::shared_ptr<const ShapeData> solid(const TriangleMesh& mesh, std::uint32_t cells) {
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = cells, .threads = 1});
    EXPECT_TRUE(field.ok()) << field.error().message();
    field->data.bounds = bounds_of(mesh.positions);
    field->data.surface = mesh;
    return std::make_shared<const ShapeData>(std::move(field->data));
}

Collider mesh_collider(const TriangleMesh& mesh, Vec3 position, std::uint32_t cells = 24) {
    return make_collider({.shape = SolidMeshDesc{}, .transform = {.position = position}}, solid(mesh, cells));
}

TEST(PenetrationSearch, finds_a_ball_in_the_middle_of_a_face) {
    const Sheet sheet(grid(2));  // edges of 2 m
    const Penetration found =
        measured(sheet, {placed({.name = "ball", .shape = SphereDesc{0.01f}}, {0.37f, -0.008f, 0.21f})});
    EXPECT_NEAR(found.max, 0.002, PenetrationSearch::resolution);
    EXPECT_LE(found.max, 0.002 + 1e-6);
    EXPECT_GE(found.at_most, 0.002 - 1e-6);
    EXPECT_LE(found.at_most, found.max + 1.01 * PenetrationSearch::resolution);
    EXPECT_EQ(found.count, 1u);
    EXPECT_EQ(found.collider, 0u);
    EXPECT_NEAR(found.place.x, 0.37, 0.01);
    EXPECT_NEAR(found.place.z, 0.21, 0.01);
    EXPECT_EQ(measured(sheet, {placed({.shape = SphereDesc{0.01f}}, {0.37f, -0.0102f, 0.21f})}).max, 0);
}

TEST(PenetrationSearch, finds_a_needle_and_the_corner_of_a_box) {
    const Sheet sheet(grid(2));
    // The axis of the needle ends 2 mm above the sheet: its radius limits the depth.
    const Penetration needle =
        measured(sheet, {placed({.shape = CapsuleDesc{0.0015f, 0.1f}}, {-0.513f, -0.098f, 0.271f})});
    EXPECT_NEAR(needle.max, 0.0015, PenetrationSearch::resolution);
    EXPECT_EQ(needle.count, 1u);

    // A cube on its corner: rotated about z by 45 degrees, an edge points up; depth below both of its faces.
    const double up = 0.003, half = 0.1;
    const Penetration box =
        measured(sheet, {placed({.shape = BoxDesc{{0.1f, 0.1f, 0.01f}}},
                                {0.41f, static_cast<float>(up - half * std::sqrt(2.0)), -0.3f}, {0, 0, 45})});
    EXPECT_NEAR(box.max, up / std::sqrt(2.0), PenetrationSearch::resolution);
}

TEST(PenetrationSearch, measures_the_triangles_of_a_mesh_and_not_its_field) {
    const Sheet sheet(grid(41));
    const Vec3 at{0.013f, -0.28f, 0.021f};
    const Penetration ball = measured(sheet, {placed({.shape = SphereDesc{0.3f}}, at)});
    const Penetration mesh = measured(sheet, {mesh_collider(make_sphere(0.3f, 5), at)});
    EXPECT_NEAR(ball.max, 0.02, 1e-4);
    EXPECT_NEAR(mesh.max, ball.max, 2e-4);
    EXPECT_NEAR(static_cast<double>(mesh.count), static_cast<double>(ball.count), 4);

    // A field of few cells cuts the corner of a box off; the measure does not.
    TriangleMesh cube = make_box({0.2f, 0.2f, 0.2f}, {2, 2, 2});
    const Collider coarse = mesh_collider(cube, {}, 4);
    const Vec3 below_corner{0.099f, 0.099f, 0.099f};
    TrueSurfaces surfaces;
    EXPECT_NEAR(surfaces.distance(coarse, below_corner), -0.001, 1e-6);
    EXPECT_GT(std::abs(signed_distance(coarse, below_corner) + 0.001), 5e-4);
    EXPECT_NEAR(surfaces.distance(coarse, {0.1f, 0.25f, 0.3f}), 0.25, 1e-6);
}

TEST(PenetrationSearch, needs_few_samples_where_cloth_lies_flat) {
    const Sheet sheet(grid(11));
    const Penetration found =
        measured(sheet, {placed({.shape = BoxDesc{{5, 1, 5}}}, {0, -1, 0}), make_collider({.shape = PlaneDesc{}})});
    EXPECT_LE(found.max, 1e-6);
    EXPECT_LE(found.samples, 200u * 2 * 7);
}

TEST(PenetrationSearch, needs_few_samples_where_cloth_lies_on_a_mesh) {
    TriangleMesh open = make_box({4, 1, 4}, {9, 3, 9});
    std::erase_if(open.triangles, [&](const Triangle& t) {
        return std::max({open.positions[t[0]].y, open.positions[t[1]].y, open.positions[t[2]].y}) < -0.49f;
    });
    for (const TriangleMesh& mesh : {make_box({4, 1, 4}, {9, 3, 9}), open}) {
        Sheet sheet(grid(11));
        const Collider collider = mesh_collider(mesh, {0, -0.501f, 0}, 24);
        const Penetration above = measured(sheet, {collider});
        EXPECT_EQ(above.max, 0);
        EXPECT_LE(above.samples, 200u);
        sheet.positions[60].y -= 0.0015f;
        const Penetration below = measured(sheet, {collider});
        EXPECT_NEAR(below.max, 0.0005, 1e-6);
        EXPECT_EQ(below.count, 6u) << "faces around the particle";
    }
}

TEST(PenetrationSearch, survives_degenerate_input) {
    constexpr float bad = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(PenetrationSearch().measure({}, {}).max, 0);
    const std::vector<Collider> ball{placed({.shape = SphereDesc{0.1f}}, {0.2f, 0, 0.1f})};
    EXPECT_EQ(PenetrationSearch().measure({}, ball).max, 0) << "no cloth";
    Sheet sheet(grid(2));
    EXPECT_EQ(measured(sheet, {}).max, 0) << "no collider";
    std::vector<Collider> lost = ball;
    lost[0].pose.position.x = bad;
    EXPECT_EQ(measured(sheet, lost).max, 0);
    sheet.positions[0].x = bad;
    const Penetration half = measured(sheet, ball);
    EXPECT_LE(half.count, 1u);
    for (Vec4& p : sheet.positions) p = {0.2f, 0, 0.1f, 1};  // all in one point
    EXPECT_NEAR(measured(sheet, ball).max, 0.1, 1e-6);
}

std::uint64_t passed(Sheet sheet, std::vector<Collider> colliders, Vec3 sheet_by, const std::vector<Vec3>& by) {
    PassageWatch watch;
    watch.add(sheet.frame(0), colliders);
    sheet.shift(sheet_by);
    std::uint64_t index = 0;
    for (const Vec3 shift : by) {
        for (Collider& collider : colliders) collider.pose.position = collider.pose.position + shift;
        watch.add(sheet.frame(++index), colliders);
    }
    EXPECT_EQ(watch.passages().first.has_value(), watch.passages().count > 0);
    EXPECT_GE(watch.passages().first.value_or(Passages::Place{.frame = 1}).frame, 1u);
    return watch.passages().count;
}

TEST(PassageWatch, counts_what_passed_whole_and_not_what_rests) {
    const Sheet sheet(grid(5));
    const std::vector<Collider> shapes{
        placed({.shape = SphereDesc{0.05f}}, {0.1f, 0.3f, 0.2f}),
        placed({.shape = BoxDesc{{0.2f, 0.001f, 0.2f}}}, {0.1f, 0.3f, 0.2f}, {20, 0, 10}),
        placed({.shape = CapsuleDesc{0.01f, 0.1f}}, {0.1f, 0.3f, 0.2f}, {70, 0, 0}),
        placed({.shape = TaperedCapsuleDesc{{0.05f, 0.02f}, 0.1f}}, {0.1f, 0.3f, 0.2f}),
        mesh_collider(make_sphere(0.1f, 2), {0.1f, 0.3f, 0.2f}),
        mesh_collider(make_box({0.4f, 0.02f, 0.4f}, {2, 2, 2}), {0.1f, 0.3f, 0.2f}),
    };
    for (const Collider& shape : shapes) {
        const auto kind = static_cast<int>(shape.shape);
        EXPECT_EQ(passed(sheet, {shape}, {}, {{0, -0.6f, 0}}), 1u) << kind;
        EXPECT_EQ(passed(sheet, {shape}, {}, {{0, -0.6f, 0}, {0, 0.6f, 0}}), 2u) << kind << ": forth and back";
        EXPECT_EQ(passed(sheet, {shape}, {0, 0.6f, 0}, {{}}), 1u) << kind << ": the sheet moves";
        EXPECT_EQ(passed(sheet, {shape}, {}, {{}, {}}), 0u) << kind << ": at rest";
        EXPECT_EQ(passed(sheet, {shape}, {0, -0.6f, 0}, {{0, -0.6f, 0}}), 0u) << kind << ": both move";
        EXPECT_EQ(passed(sheet, {shape}, {}, {{3, 0, 0}, {0, -0.6f, 0}}), 0u) << kind << ": beside the sheet";
    }
    EXPECT_EQ(passed(sheet, {make_collider({.shape = PlaneDesc{}})}, {0, -1, 0}, {{}}), 0u) << "stays as penetration";
}

TEST(PassageWatch, follows_a_collider_that_turns) {
    Sheet sheet(grid(5));
    sheet.shift({0, -0.02f, 0});
    // A rod of 1 m about its end at the origin: the axis turns from 60 degrees above the sheet to 60 below it.
    const auto rod = [](float degrees) {
        Collider collider = placed({.shape = CapsuleDesc{0.005f, 0.4f}}, {}, {0, 0, degrees - 90});
        collider.pose.position = collider.pose.rotation * Vec3{0, 0.5f, 0};
        return collider;
    };
    PassageWatch watch;
    std::vector<Collider> colliders{rod(60)};
    watch.add(sheet.frame(0), colliders);
    colliders[0].pose = rod(30).pose;
    watch.add(sheet.frame(1), colliders);
    EXPECT_EQ(watch.passages().count, 0u);
    colliders[0].pose = rod(-40).pose;
    watch.add(sheet.frame(2), colliders);
    EXPECT_EQ(watch.passages().count, 1u);
    EXPECT_GT(watch.passages().points, 5u);
}

TEST(PassageWatch, finds_what_passes_while_the_cloth_parts) {
    Sheet sheet(grid(5), {.particles = 3});
    std::vector<Collider> ball{placed({.shape = SphereDesc{0.05f}}, {})};
    // Below the middle of a triangle.
    const Triangle corners = sheet.model->triangles()[7];
    Vec3 middle{};
    for (const std::uint32_t p : corners) middle += sheet.positions[p].xyz() / 3;
    ball[0].pose.position = middle - Vec3{0, 0.3f, 0};
    PassageWatch watch;
    watch.add(sheet.frame(0), ball);
    sheet.part_triangle(7);
    EXPECT_EQ(sheet.model->copied_from.size(), 3u);
    ball[0].pose.position = middle + Vec3{0, 0.3f, 0};
    watch.add(sheet.frame(1), ball);
    EXPECT_EQ(watch.passages().count, 1u);
    ball[0].pose.position = middle - Vec3{0, 0.3f, 0};
    watch.add(sheet.frame(2), ball);
    EXPECT_EQ(watch.passages().count, 2u);
    watch.add(Sheet(grid(5)).frame(3), ball);
    EXPECT_EQ(watch.passages().count, 2u) << "another cloth";
}

TEST(Displacement, of_an_appended_particle_starts_at_its_original) {
    Sheet parts(grid(5), {.particles = 3}), whole(grid(3));
    const auto frame = [&] {
        Frame both = parts.frame();
        both.cloths.push_back(whole.frame().cloths[0]);
        return both;
    };
    const Positions before = positions_of(frame());
    EXPECT_EQ(mean_displacement(before, frame()), 0);
    parts.shift({0, 0.5f, 0}), whole.shift({0, 0.5f, 0});
    EXPECT_NEAR(mean_displacement(before, frame()), 0.5, 1e-6);
    parts.part_triangle(7);
    EXPECT_EQ(frame().cloths[0].positions.size(), 28u);
    EXPECT_NEAR(mean_displacement(before, frame()), 0.5, 1e-6);
}

TEST(PassageWatch, survives_degenerate_input) {
    PassageWatch watch;
    watch.add({}, {});
    watch.add({}, {});
    Sheet sheet(grid(2));
    std::vector<Collider> ball{placed({.shape = SphereDesc{0.1f}}, {0.2f, 0.3f, 0.1f})};
    watch.add(sheet.frame(1), ball);
    sheet.positions[0].x = std::numeric_limits<float>::quiet_NaN();
    watch.add(sheet.frame(2), ball);
    ball[0].pose.position.y = std::numeric_limits<float>::infinity();
    watch.add(sheet.frame(3), ball);
    ball.push_back(placed({.shape = SphereDesc{0.1f}}, {0.2f, 0.3f, 0.1f}));
    watch.add(sheet.frame(4), ball);
    EXPECT_EQ(watch.passages().count, 0u);
}

}  // namespace
}  // namespace weft
