#include "solver/model/parting_mesh.h"

#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "solver/model/cuts.h"
#include "solver/model/drawn_pieces.test.h"
#include "solver/model/tear_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <span>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> partable(TriangleMesh mesh, std::uint32_t room = 2000) {
    auto topology = build_topology(mesh);
    EXPECT_TRUE(topology.ok());
    auto model =
        build_cloth_model({.name = "seamed", .mesh = std::move(mesh), .reserve = {.particles = room, .openings = true}},
                          std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

/// Four patches of a sheet, with seams along x = 0 and z = 0.
TriangleMesh patched_sheet() {
    return testing_meshes::with_seams(make_grid({1, 1}, {17, 17}, GridDiagonal::alternating),
                                      [](Vec3 at) { return 2 * (at.x > 0) + (at.z > 0); });
}
/// Each triangle has its own vertices.
TriangleMesh shattered_sphere() {
    int next = 0;
    return testing_meshes::with_seams(make_sphere(0.5f, 2), [&](Vec3) { return next++; });
}
/// Unused vertices, triangles without area and duplicate triangles.
TriangleMesh messy_sheet() {
    TriangleMesh mesh = patched_sheet();
    mesh.positions.insert(mesh.positions.begin() + 5, Vec3{3, 4, 5});
    mesh.uvs.insert(mesh.uvs.begin() + 5, Vec2{1, 1});
    mesh.colors.insert(mesh.colors.begin() + 5, Vec4{});
    for (Triangle& triangle : mesh.triangles)
        for (std::uint32_t& v : triangle) v += v >= 5;
    mesh.triangles.insert(mesh.triangles.begin() + 7, mesh.triangles[3]);
    mesh.triangles.insert(mesh.triangles.begin() + 9, Triangle{0, 0, 1});
    return mesh;
}

/// Pairs of edges at a vertex, in random order.
std::vector<Opening> shuffled_openings(const ClothModel& model, std::size_t count, unsigned seed) {
    std::vector<Opening> all;
    const TearTable& table = *model.tears;
    std::mt19937 random(seed);
    for (std::uint32_t v = 0; v < table.vertex_count(); ++v) {
        const std::uint32_t first = table.ring_begin[v], links = table.ring_begin[v + 1] - first;
        for (std::uint32_t i = 0; i < links; ++i) {
            const std::uint32_t other = (i + 1 + random() % (links - 1)) % links;
            if (table.entries[first + i].next == none || table.entries[first + other].next == none) continue;
            all.push_back({{first + i, first + other}});
        }
    }
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random() % i]);
    all.resize(std::min(count, all.size()));
    return all;
}

/// Each corner shows its particle, with the values of that corner when the cloth was built.
void expect_follows_particles(const ClothModel& now, const ClothModel& built) {
    const TriangleMesh &mesh = now.mesh(), &before = built.mesh();
    ASSERT_EQ(mesh.triangles.size(), before.triangles.size());
    ASSERT_EQ(mesh.positions.size(), now.vertex_to_particle.size());
    ASSERT_EQ(mesh.positions.size(), mesh.uvs.size());
    std::vector<bool> used(mesh.positions.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[t][k], was = before.triangles[t][k];
            used[vertex] = true;
            ASSERT_EQ(now.vertex_to_particle[vertex], now.triangles()[t][k]) << "triangle " << t;
            ASSERT_EQ(mesh.positions[vertex], before.positions[was]);
            ASSERT_EQ(mesh.uvs[vertex], before.uvs[was]);
            ASSERT_EQ(mesh.colors[vertex], before.colors[was]);
            if (vertex < before.positions.size()) {
                EXPECT_EQ(vertex, was) << "vertices are only appended";
            }
        }
    for (std::size_t v = 0; v < used.size(); ++v)
        EXPECT_EQ(used[v], now.vertex_to_particle[v] != none) << "vertex " << v << " shows nothing";
    EXPECT_LE(now.spare_vertices(), built.spare_vertices());
    EXPECT_EQ(now.spare_vertices() + mesh.positions.size(), built.spare_vertices() + before.positions.size());
}

/// Programs upload triangles again only if there are more vertices.
void expect_same_triangles_if_none_appended(const ClothModel& before, const ClothModel& after) {
    ASSERT_GE(after.mesh().positions.size(), before.mesh().positions.size());
    if (after.mesh().positions.size() > before.mesh().positions.size()) return;
    EXPECT_EQ(after.mesh().triangles, before.mesh().triangles);
}

TEST(PartingMesh, follows_particles_however_the_cloth_is_opened) {
    struct Case {
        const char* name;
        TriangleMesh mesh;
    };
    for (const Case& one :
         {Case{"patched", patched_sheet()}, Case{"shattered", shattered_sphere()}, Case{"messy", messy_sheet()}}) {
        SCOPED_TRACE(one.name);
        const auto built = partable(one.mesh);
        expect_follows_particles(*built, *built);
        for (unsigned seed = 0; seed < 4; ++seed) {
            const std::vector<Opening> openings = shuffled_openings(*built, 40 << seed, seed);
            auto all = with_edit(*built, {.openings = openings});
            ASSERT_TRUE(all.ok()) << all.error().message();
            EXPECT_GT((*all)->copied_from.size(), 0u);
            expect_follows_particles(**all, *built);
            // In many small steps.
            auto step_by_step = built;
            for (std::size_t i = 0; i < openings.size(); i += 2) {
                const std::span some = std::span(openings).subspan(i, std::min<std::size_t>(2, openings.size() - i));
                auto next = with_edit(*step_by_step, {.openings = {some.begin(), some.end()}});
                ASSERT_TRUE(next.ok());
                expect_same_triangles_if_none_appended(*step_by_step, **next);
                step_by_step = *next;
            }
            EXPECT_EQ(step_by_step->mesh(), (*all)->mesh());
            EXPECT_EQ(step_by_step->vertex_to_particle, (*all)->vertex_to_particle);
        }
    }
}

TEST(PartingMesh, leaves_out_what_is_not_simulated) {
    const TriangleMesh mesh = messy_sheet();
    const auto model = partable(mesh);
    EXPECT_EQ(model->mesh().triangles.size(), mesh.triangles.size() - 2);
    EXPECT_EQ(model->mesh().triangles.size(), model->triangle_count);
    EXPECT_EQ(model->mesh().positions, mesh.positions);
    EXPECT_EQ(model->vertex_to_particle[5], none);
}

// A cut along the seam needs no new vertices: both sides have their own.
TEST(PartingMesh, appends_vertices_only_where_they_are_missing) {
    const auto built = partable(patched_sheet());
    const auto cut = [&](Vec3 point, Vec3 normal) {
        std::vector<Vec4> rest(built->start.begin(), built->start.begin() + built->particle_count);
        auto model = with_edit(*built, {.openings = openings_along_plane(*built, rest, point, normal)});
        EXPECT_TRUE(model.ok());
        EXPECT_EQ((*model)->copied_from.size(), 17u);
        return (*model)->mesh().positions.size() - built->mesh().positions.size();
    };
    EXPECT_EQ(cut({}, {1, 0, 0}), 0u);
    EXPECT_EQ(cut({}, {0, 0, 1}), 0u);
    EXPECT_EQ(cut({0.25f, 0, 0}, {1, 0, 0}), 18u) << "17 particles, one of them with two vertices";
}

TEST(PartingMesh, bounds_the_vertices_that_can_be_appended) {
    for (const TriangleMesh& mesh : {patched_sheet(), shattered_sphere()}) {
        const std::size_t corners = 3 * mesh.triangles.size();
        for (const std::uint32_t room : {1u, 9u, 100u, 5000u}) {
            const auto built = partable(mesh, room);
            EXPECT_LE(built->spare_vertices() + mesh.positions.size(), corners + 3 * 4);
            // Opens as much as there is room for.
            auto model = built;
            for (const Opening& opening : shuffled_openings(*built, 1000000, room)) {
                auto next = with_edit(*model, {.openings = {opening}});
                if (next.ok()) model = *next;
            }
            EXPECT_GE(model->copied_from.size() + 2, std::min(room, 600u)) << "an opening can need three";
            expect_follows_particles(*model, *built);
        }
    }
    const auto one = partable(patched_sheet(), 1);
    EXPECT_EQ(one->spare_vertices(), 4u) << "the particle in the middle has four vertices";
}

TEST(PartingMesh, is_as_built_in_a_model_that_is_built_again) {
    const TriangleMesh mesh = patched_sheet();
    const auto built = partable(mesh);
    auto torn = with_edit(*built, {.openings = shuffled_openings(*built, 60, 9)});
    ASSERT_TRUE(torn.ok());
    Fabric denser;
    denser.body.density = 0.3f;
    auto again = change_cloth_model(**torn, mesh, *build_topology(mesh), {.fabric = denser});
    ASSERT_TRUE(again.ok());
    EXPECT_EQ((*again)->mesh(), built->mesh());
    EXPECT_EQ((*again)->vertex_to_particle, built->vertex_to_particle);
    auto torn_again = with_edit(**again, {.openings = shuffled_openings(*built, 60, 9)});
    ASSERT_TRUE(torn_again.ok());
    EXPECT_EQ((*torn_again)->mesh(), (*torn)->mesh());
}

std::shared_ptr<const ClothModel> partable_under(TriangleMesh mesh, TriangleMesh drawn) {
    auto topology = build_topology(mesh);
    EXPECT_TRUE(topology.ok());
    auto model = build_cloth_model({.name = "bound",
                                    .mesh = std::move(mesh),
                                    .render_mesh = std::move(drawn),
                                    .reserve = {.particles = 2000, .openings = true}},
                                   std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

struct DrawnAtRest {
    std::vector<Vec3> positions, normals;

    explicit DrawnAtRest(const ClothModel& model, Vec3 stretch = {1, 1, 1}) {
        std::vector<Vec4> particles, particle_normals(model.particle_count);
        for (std::uint32_t p = 0; p < model.particle_count; ++p) {
            const Vec3 x = model.rest_position(p);
            particles.push_back({x.x * stretch.x, x.y * stretch.y, x.z * stretch.z, 1});
        }
        for (const auto& [a, b, c] : model.triangles()) {
            const Vec3 n = cross(particles[b].xyz() - particles[a].xyz(), particles[c].xyz() - particles[a].xyz());
            for (const std::uint32_t p : {a, b, c})
                particle_normals[p] = {particle_normals[p].x + n.x, particle_normals[p].y + n.y,
                                       particle_normals[p].z + n.z, 0};
        }
        for (Vec4& n : particle_normals) {
            const Vec3 one = normalized(n.xyz());
            n = {one.x, one.y, one.z, 0};
        }
        follow(model.binding, particles, particle_normals, positions, normals);
    }
};

/// Vertices are bound to triangles of particles: each to one that touches the triangles in which its corners lie.
void expect_follows_triangles(const ClothModel& now, const ClothModel& built,
                              const std::vector<std::uint32_t>& triangle_of) {
    const TriangleMesh &mesh = now.mesh(), &before = built.mesh();
    ASSERT_EQ(mesh.triangles.size(), before.triangles.size());
    ASSERT_EQ(mesh.positions.size(), now.binding.vertices.size());
    std::set<std::set<std::uint32_t>> triangles;
    for (const auto& [a, b, c] : now.triangles()) triangles.insert({a, b, c});
    const auto particles = [&](std::uint32_t vertex) {
        const auto& three = now.binding.vertices[vertex].particles;
        return std::set<std::uint32_t>(three.begin(), three.end());
    };
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) ASSERT_TRUE(triangles.contains(particles(v))) << v;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[t][k], was = before.triangles[t][k];
            ASSERT_EQ(mesh.positions[vertex], before.positions[was]);
            ASSERT_EQ(mesh.uvs.empty(), before.uvs.empty());
            ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs[vertex] == before.uvs[was]);
            EXPECT_TRUE(vertex >= before.positions.size() || vertex == was) << "vertices are only appended";
            const auto bound = particles(vertex);
            EXPECT_TRUE(std::ranges::any_of(now.triangles()[triangle_of[t]], [&](auto p) { return bound.contains(p); }))
                << t;
        }
    EXPECT_EQ(now.spare_vertices() + mesh.positions.size(), built.spare_vertices() + before.positions.size());
    EXPECT_EQ(now.binding.farthest, built.binding.farthest);
    test::expect_no_triangle_spans_pieces(now);
}

TEST(PartingMesh, follows_triangles_with_a_render_mesh_of_its_own) {
    struct Case {
        const char* name;
        TriangleMesh mesh, drawn;
    };
    TriangleMesh rough = make_sphere(0.5f, 3);
    for (std::size_t v = 0; v < rough.positions.size(); ++v)
        rough.positions[v] = rough.positions[v] * (1 + 0.002f * static_cast<float>(v % 5));
    for (const Case& one : {Case{"grids", make_grid({1, 1}, {9, 9}, GridDiagonal::alternating),
                                 make_grid({1, 1}, {28, 23}, GridDiagonal::uniform)},
                            Case{"same grid", make_grid({1, 1}, {9, 9}, GridDiagonal::alternating),
                                 make_grid({1, 1}, {9, 9}, GridDiagonal::alternating)},
                            Case{"fourfold grid with seams", make_grid({1, 1}, {9, 9}, GridDiagonal::alternating),
                                 testing_meshes::with_seams(make_grid({1, 1}, {33, 33}, GridDiagonal::cross),
                                                            [](Vec3 at) { return 2 * (at.x > 0) + (at.z > 0); })},
                            Case{"spheres", make_sphere(0.5f, 1), rough}}) {
        SCOPED_TRACE(one.name);
        const auto built = partable_under(one.mesh, one.drawn);
        const auto triangle_of = clip_to_triangles(one.drawn, *build_topology(one.mesh)).triangle_of;
        expect_follows_triangles(*built, *built, triangle_of);
        for (std::size_t v = 0; v < one.drawn.positions.size(); ++v)
            ASSERT_EQ(built->mesh().positions[v], one.drawn.positions[v]);
        const DrawnAtRest at_rest(*built);
        for (std::size_t v = 0; v < at_rest.positions.size(); ++v)
            EXPECT_LE(length(at_rest.positions[v] - built->mesh().positions[v]), 3e-7f);
        for (unsigned seed = 0; seed < 4; ++seed) {
            const std::vector<Opening> openings = shuffled_openings(*built, 20 << seed, seed);
            auto all = with_edit(*built, {.openings = openings});
            ASSERT_TRUE(all.ok()) << all.error().message();
            EXPECT_GT((*all)->mesh().positions.size(), built->mesh().positions.size());
            expect_follows_triangles(**all, *built, triangle_of);
            auto step_by_step = built;
            for (const Opening& opening : openings) {
                auto next = with_edit(*step_by_step, {.openings = {opening}});
                ASSERT_TRUE(next.ok());
                expect_same_triangles_if_none_appended(*step_by_step, **next);
                step_by_step = *next;
            }
            EXPECT_EQ(step_by_step->mesh(), (*all)->mesh());
            for (std::size_t v = 0; v < (*all)->binding.vertices.size(); ++v)
                ASSERT_EQ(step_by_step->binding.vertices[v].particles, (*all)->binding.vertices[v].particles);
        }
    }
}

// The grids are out of step, so the cut runs through drawn triangles.
TEST(PartingMesh, of_a_render_mesh_parts_along_a_cut) {
    const TriangleMesh coarse = make_grid({1, 1}, {9, 9}, GridDiagonal::alternating);
    const TriangleMesh fine = make_grid({1, 1}, {24, 24}, GridDiagonal::uniform);
    const auto built = partable_under(coarse, fine);
    std::vector<Vec4> rest(built->start.begin(), built->start.begin() + built->particle_count);
    auto cut = with_edit(*built, {.openings = openings_along_plane(*built, rest, {0.125f, 0, 0}, {1, 0, 0})});
    ASSERT_TRUE(cut.ok());
    expect_follows_triangles(**cut, *built, clip_to_triangles(fine, *build_topology(coarse)).triangle_of);
    EXPECT_EQ(test::expect_no_triangle_spans_pieces(**cut).size(), 2u);
    std::size_t left = 0, right = 0;
    const TriangleMesh& mesh = (*cut)->mesh();
    for (const auto& [a, b, c] : mesh.triangles) {
        const float least = std::min({mesh.positions[a].x, mesh.positions[b].x, mesh.positions[c].x});
        const float most = std::max({mesh.positions[a].x, mesh.positions[b].x, mesh.positions[c].x});
        EXPECT_TRUE(most < 0.12501f || least > 0.12499f) << least << " to " << most;
        ++(most < 0.12501f ? left : right);
    }
    EXPECT_GT(left, 600u);
    EXPECT_GT(right, 300u);
    // The vertices on the cut are doubled: those of 24 rows and 23 diagonals, and most particles.
    const auto& before = built->mesh().positions;
    const auto on_cut = std::ranges::count_if(before, [](Vec3 p) { return std::abs(p.x - 0.125f) < 1e-5f; });
    EXPECT_GE(on_cut, 24 + 23 + 5);
    EXPECT_EQ(mesh.positions.size(), before.size() + static_cast<std::size_t>(on_cut));
    for (std::size_t v = before.size(); v < mesh.positions.size(); ++v) EXPECT_NEAR(mesh.positions[v].x, 0.125f, 1e-6f);
    // Nothing has moved.
    const DrawnAtRest shown(**cut);
    for (std::size_t v = 0; v < shown.positions.size(); ++v)
        EXPECT_LE(length(shown.positions[v] - mesh.positions[v]), 3e-7f);
}

// Vertices at cuts between simulated triangles are shared, so the surface is as smooth as before it was clipped.
TEST(PartingMesh, of_a_render_mesh_looks_as_if_it_were_not_clipped) {
    const TriangleMesh coarse = make_sphere(0.5f, 1), fine = make_sphere(0.5f, 3);
    const auto built = partable_under(coarse, fine);
    auto plain = build_cloth_model({.name = "plain", .mesh = coarse, .render_mesh = fine}, *build_topology(coarse));
    ASSERT_TRUE(plain.ok());
    const DrawnAtRest clipped(*built, {1.2f, 0.9f, 0.8f}), whole(**plain, {1.2f, 0.9f, 0.8f});
    for (std::size_t v = 0; v < fine.positions.size(); ++v) {
        EXPECT_LE(length(clipped.positions[v] - whole.positions[v]), 0.004f);
        EXPECT_LE(length(clipped.normals[v] - whole.normals[v]), 0.06f);
    }
    // New vertices lie on the drawn triangles, with normals between theirs.
    const auto& mesh = built->mesh();
    for (const auto& [a, b, c] : mesh.triangles) {
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
            const float apart = length(mesh.positions[from] - mesh.positions[to]);
            EXPECT_LE(length(clipped.normals[from] - clipped.normals[to]), 4 * apart + 0.01f);
        }
    }
}

TEST(PartingMesh, changes_by_openings_alone) {
    const auto built = partable(patched_sheet());
    const auto edited = with_edit(*built, {.appended = {3}});
    ASSERT_FALSE(edited.ok());
    EXPECT_EQ(edited.error().message(),
              "cloth 'seamed': has a render mesh of its own, or vertices that share a particle: only openings can "
              "change its triangles");
}

}  // namespace
}  // namespace weft
