#include "solver/model/binding.h"

#include "base/transform.h"
#include "mesh/procedural.h"
#include "solver/state/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace weft {
namespace {

/// Particles at given positions, with the normals that a backend computes.
struct Particles {
    std::vector<Vec4> positions, normals;

    Particles(const Topology& topology, const std::function<Vec3(Vec3)>& place) {
        for (const Vec3 rest : topology.rest_positions) {
            const Vec3 p = place(rest);
            positions.push_back({p.x, p.y, p.z, 1});
        }
        std::vector<Vec3> sums(positions.size());
        for (const auto& [a, b, c] : topology.triangles) {
            const Vec3 n = cross(positions[b].xyz() - positions[a].xyz(), positions[c].xyz() - positions[a].xyz());
            for (const std::uint32_t corner : {a, b, c}) sums[corner] += n;
        }
        for (const Vec3 sum : sums) {
            const Vec3 n = dot(sum, sum) > 0 ? normalized(sum) : Vec3{0, 1, 0};
            normals.push_back({n.x, n.y, n.z, 0});
        }
    }
};

struct Drawn {
    std::vector<Vec3> positions, normals;
    Drawn(const Binding& binding, const Particles& particles) {
        follow(binding, particles.positions, particles.normals, positions, normals);
    }
};

Vec3 in_place(Vec3 p) {
    return p;
}

float greatest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    EXPECT_EQ(a.size(), b.size());
    float greatest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, length(a[i] - b[i]));
    return greatest;
}

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    float number(float reach) { return reach * (2 * static_cast<float>(engine_() % 1000003) / 1000003.0f - 1); }
    Vec3 point(float reach) { return {number(reach), number(reach), number(reach)}; }

  private:
    std::mt19937 engine_;
};

TEST(Binding, to_itself_changes_nothing) {
    for (const TriangleMesh& mesh : {make_sphere(0.5f, 3), make_grid({1, 2}, {9, 5}, GridDiagonal::alternating)}) {
        const auto topology = build_topology(mesh);
        const Binding binding = bind_mesh(mesh, *topology);
        EXPECT_EQ(binding.farthest, 0);
        const Drawn drawn(binding, Particles(*topology, in_place));
        EXPECT_LE(greatest_distance(drawn.positions, mesh.positions), 1e-7f);
        EXPECT_LE(greatest_distance(drawn.normals, mesh.normals), 0.02f) << "a mesh's own and those of its shape";
        // Vertices follow arbitrary motions of the particles.
        Random random(1);
        const Particles moved(*topology, [&](Vec3 p) { return p + random.point(0.1f); });
        const Drawn after(binding, moved);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            EXPECT_LE(length(after.positions[v] - moved.positions[topology->vertex_to_particle[v]].xyz()), 1e-6f);
    }
}

TEST(Binding, shows_at_rest_what_was_drawn) {
    const auto topology = build_topology(make_sphere(0.5f, 1));
    TriangleMesh rough = make_sphere(0.52f, 4);
    Random random(2);
    for (Vec3& p : rough.positions) p += random.point(0.03f);
    const Drawn drawn(bind_mesh(rough, *topology), Particles(*topology, in_place));
    EXPECT_LE(greatest_distance(drawn.positions, rough.positions), 2e-7f);
    EXPECT_LE(greatest_distance(drawn.normals, rough.normals), 1e-6f);
}

TEST(Binding, follows_a_rigid_motion) {
    const auto topology = build_topology(make_sphere(0.5f, 1));
    TriangleMesh fine = make_box({0.8f, 0.9f, 1}, {12, 13, 14});
    for (const Vec3 p : fine.positions) fine.normals.push_back(normalized(p));
    const Binding binding = bind_mesh(fine, *topology);
    for (const Vec3 degrees : {Vec3{90, 0, 0}, Vec3{31, 222, 117}, Vec3{180, 0, 0}}) {
        const Pose pose{rotation_from_degrees(degrees), {3, -2, 1}};
        const Drawn drawn(binding, Particles(*topology, [&](Vec3 p) { return to_world(pose, p); }));
        std::vector<Vec3> positions = fine.positions, normals = fine.normals;
        for (Vec3& p : positions) p = to_world(pose, p);
        for (Vec3& n : normals) n = pose.rotation * n;
        EXPECT_LE(greatest_distance(drawn.positions, positions), 3e-6f);
        EXPECT_LE(greatest_distance(drawn.normals, normals), 3e-6f);
    }
}

TEST(Binding, a_bent_grid_bends_what_is_drawn_smoothly) {
    // 12 cells of 30° around a cylinder. The height of the arc above the chord of two particles is R(1 - cos 15°).
    const float radius = 1 / (2 * 3.14159265f), sagitta = radius * (1 - std::cos(0.2617994f));
    const auto bent = [&](Vec3 p) {
        return Vec3{radius * std::sin(p.x / radius), radius * std::cos(p.x / radius), p.z};
    };
    const auto topology = build_topology(make_grid({1, 1}, {13, 13}, GridDiagonal::alternating));
    const TriangleMesh fine = make_grid({1, 1}, {121, 121}, GridDiagonal::uniform);
    const Binding binding = bind_mesh(fine, *topology);
    const Drawn drawn(binding, Particles(*topology, bent));
    for (std::uint32_t z = 0; z < 121; ++z)
        for (std::uint32_t x = 0; x + 1 < 121; ++x) {
            const std::size_t v = 121 * z + x;
            // The normal of a border particle is computed from one side only.
            const bool inside = fine.positions[v].x > -0.4f && fine.positions[v].x < 0.4f;
            const Vec3 expected = bent(fine.positions[v]);
            EXPECT_LE(length(drawn.positions[v] - expected), inside ? 0.12f * sagitta : 0.6f * sagitta);
            const float step = length(drawn.positions[v + 1] - drawn.positions[v]);
            EXPECT_NEAR(step, 1 / 120.0f, 0.05f / 120) << "neither torn apart nor crowded";
            // 3° per step, with no edge of 30° between coarse triangles.
            if (inside) {
                EXPECT_GE(dot(drawn.normals[v], drawn.normals[v + 1]), std::cos(0.0698f));
            }
        }
}

TEST(Binding, is_continuous_across_the_sides_of_triangles) {
    // Pairs of points on both sides of lines that contain many triangle edges, at several heights.
    constexpr float hair = 1e-4f;
    TriangleMesh pairs;
    for (const float height : {0.0f, 0.05f, -0.08f})
        for (int line = 1; line < 8; ++line)
            for (int i = 1; i < 40; ++i) {
                const float across = static_cast<float>(line) / 8 - 0.5f, along = static_cast<float>(i) / 40 - 0.5f;
                for (const float side : {-hair, hair}) pairs.positions.push_back({across + side, height, along});
                for (const float side : {-hair, hair}) pairs.positions.push_back({along, height, across + side});
                for (const float side : {-hair, hair}) pairs.positions.push_back({along, height, along + side});
            }
    const auto topology = build_topology(make_grid({1, 1}, {9, 9}, GridDiagonal::uniform));
    const Binding binding = bind_mesh(pairs, *topology);
    Random random(3);
    const Drawn drawn(binding, Particles(*topology, [&](Vec3 p) { return p + random.point(0.03f); }));
    for (std::size_t i = 0; i < pairs.positions.size(); i += 2) {
        EXPECT_LE(length(drawn.positions[i] - drawn.positions[i + 1]), 10 * hair);
        EXPECT_LE(length(drawn.normals[i] - drawn.normals[i + 1]), 30 * hair);
    }
}

TEST(Binding, keeps_the_heights_of_details) {
    const auto topology = build_topology(make_grid({1, 1}, {5, 5}, GridDiagonal::alternating));
    TriangleMesh bumps = make_grid({1, 1}, {41, 41}, GridDiagonal::alternating);
    for (Vec3& p : bumps.positions) p.y = 0.01f * std::sin(40 * p.x) * std::sin(40 * p.z);
    const Binding binding = bind_mesh(bumps, *topology);
    EXPECT_NEAR(binding.farthest, 0.01f, 1e-4f);
    // Scaled by 2 and turned upside down: the cloth is stretched, but the heights of details are not.
    const Drawn drawn(binding, Particles(*topology, [](Vec3 p) { return Vec3{2 * p.x, 5, -2 * p.z}; }));
    for (std::size_t v = 0; v < bumps.positions.size(); ++v) {
        const Vec3 rest = bumps.positions[v];
        EXPECT_LE(length(drawn.positions[v] - Vec3{2 * rest.x, 5 - rest.y, -2 * rest.z}), 2e-6f);
    }
}

TEST(Binding, holds_what_is_far_away) {
    const auto topology = build_topology(make_grid({1, 1}, {5, 5}, GridDiagonal::cross));
    TriangleMesh far;
    for (const Vec3 p : {Vec3{100, 0, 0}, Vec3{-300, 40, 7}, Vec3{0, 1000, 0}, Vec3{0.1f, -9, 0.2f}})
        far.positions.push_back(p);
    const Binding binding = bind_mesh(far, *topology);
    EXPECT_EQ(binding.farthest, 1000);
    const Mat3 turn = rotation_from_degrees({40, 50, 60});
    const Drawn drawn(binding, Particles(*topology, [&](Vec3 p) { return turn * p; }));
    for (std::size_t v = 0; v < far.positions.size(); ++v)
        EXPECT_LE(length(drawn.positions[v] - turn * far.positions[v]), 2e-6f * length(far.positions[v]));
}

TEST(Binding, stays_finite_when_the_cloth_collapses) {
    const TriangleMesh fine = make_sphere(0.6f, 3);
    const auto topology = build_topology(make_sphere(0.5f, 1));
    const Binding binding = bind_mesh(fine, *topology);
    const std::function<Vec3(Vec3)> places[] = {
        [](Vec3) { return Vec3{1, 2, 3}; },       [](Vec3 p) { return Vec3{p.x, 0, 0}; },
        [](Vec3 p) { return Vec3{p.x, 0, p.z}; }, [](Vec3 p) { return p * 1e-20f; },
        [](Vec3 p) { return p * 1e12f; },
    };
    for (const auto& place : places) {
        Particles particles(*topology, place);
        for (const bool without_normals : {false, true}) {
            if (without_normals) std::fill(particles.normals.begin(), particles.normals.end(), Vec4{});
            const Drawn drawn(binding, particles);
            for (const Vec3 p : drawn.positions) EXPECT_TRUE(finite(p));
            for (const Vec3 n : drawn.normals) EXPECT_NEAR(length(n), 1, 1e-5f);
        }
    }
}

TEST(Binding, takes_drawn_meshes_that_are_a_mess) {
    const auto topology = build_topology(make_grid({1, 1}, {5, 5}, GridDiagonal::alternating));
    // A triangle without area, a duplicate triangle, an unused vertex and a seam, without normals.
    const TriangleMesh mess{
        .positions = {{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}, {0, 0, 0}, {0.2f, 0.1f, 0}, {-3, 0, 9}},
        .uvs = {},
        .normals = {},
        .colors = {},
        .triangles = {{0, 2, 1}, {0, 0, 1}, {0, 2, 1}, {3, 4, 2}, {3, 1, 3}}};
    const Drawn drawn(bind_mesh(mess, *topology), Particles(*topology, in_place));
    EXPECT_LE(greatest_distance(drawn.positions, mess.positions), 1e-6f);
    for (const Vec3 n : drawn.normals) EXPECT_NEAR(length(n), 1, 1e-5f);
    EXPECT_LE(length(drawn.normals[0] - drawn.normals[3]), 1e-6f) << "smooth across the seam";
    EXPECT_LE(length(drawn.normals[5] - Vec3{0, 1, 0}), 1e-6f) << "that of the cloth";
}

TEST(ClothModel, is_simulated_on_one_mesh_and_drawn_as_another) {
    const TriangleMesh coarse = make_grid({1, 1}, {5, 5}, GridDiagonal::alternating);
    TriangleMesh turned = coarse;  // its UVs swap warp and weft
    for (Vec2& uv : turned.uvs) uv = {uv.y, uv.x};
    const auto model_of = [](const TriangleMesh& mesh, std::optional<TriangleMesh> drawn) {
        auto model =
            build_cloth_model({.name = "x", .mesh = mesh, .render_mesh = std::move(drawn)}, *build_topology(mesh));
        EXPECT_TRUE(model.ok());
        return *model;
    };
    const auto plain = model_of(turned, {});
    TriangleMesh fine = make_grid({1, 1}, {33, 33}, GridDiagonal::uniform);
    const auto bound = model_of(turned, fine);
    EXPECT_TRUE(plain->binding.empty());
    EXPECT_EQ(bound->mesh().positions, fine.positions);
    EXPECT_EQ(bound->particle_count, 25u);
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        EXPECT_EQ(bound->constraints[kind].fields, plain->constraints[kind].fields);
    }
    EXPECT_NE(plain->table(ConstraintKind::moment).fields, model_of(coarse, {})->table(ConstraintKind::moment).fields);

    const Particles particles(*build_topology(turned), in_place);
    ClothFrame frame;
    frame.model = bound.get(), frame.positions = particles.positions, frame.normals = particles.normals;
    std::vector<Vec3> positions, normals;
    draw_surface(frame, positions, normals);
    EXPECT_LE(greatest_distance(positions, fine.positions), 1e-7f);
    EXPECT_LE(greatest_distance(normals, fine.normals), 1e-6f);
    frame.model = plain.get();
    draw_surface(frame, positions, normals);
    EXPECT_EQ(positions, coarse.positions);
}

TEST(ClothModel, refuses_a_drawn_mesh_that_is_not_sound) {
    const TriangleMesh mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::uniform);
    const auto error_with = [&](const std::function<void(TriangleMesh&)>& change) {
        TriangleMesh drawn = mesh;
        change(drawn);
        const auto model = build_cloth_model({.name = "x", .mesh = mesh, .render_mesh = drawn}, *build_topology(mesh));
        return model.ok() ? std::string() : model.error().message();
    };
    EXPECT_EQ(error_with([](TriangleMesh&) {}), "");
    EXPECT_EQ(error_with([](TriangleMesh& m) { m.positions[4].y = std::numeric_limits<float>::infinity(); }),
              "render mesh: vertex 4: position must be within 1e6 m of the origin");
    EXPECT_EQ(error_with([](TriangleMesh& m) { m.positions[4].z = -3e38f; }),
              "render mesh: vertex 4: position must be within 1e6 m of the origin");
    EXPECT_EQ(error_with([](TriangleMesh& m) { m.triangles[1][2] = 9; }),
              "render mesh: triangle 1: indices must be < 9, the number of vertices");
    EXPECT_EQ(error_with([](TriangleMesh& m) { m.triangles.clear(); }), "render mesh: must have at least one triangle");
    EXPECT_EQ(error_with([](TriangleMesh& m) { m.normals.pop_back(); }),
              "render mesh: must have one normal per vertex or none");
}

}  // namespace
}  // namespace weft
