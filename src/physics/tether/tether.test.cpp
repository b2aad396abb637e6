#include "physics/tether/geodesic.h"

#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "physics/constraint.h"
#include "physics/testing.h"

#include <cmath>

namespace weft {
namespace {

using namespace testing_kernels;
using namespace testing_meshes;
using reference::TetherRow;

TEST(Tether, pulls_back_to_its_radius_and_only_then) {
    vec3 x(3, 0, 4), anchor(0.0);
    double lambda = 0;
    reference::project_tether(x, anchor, 2, 0, lambda, TetherRow{4, 0}, make_step(0.01));
    EXPECT_LT(norm(x - vec3(2.4, 0, 3.2)), 1e-12);
    EXPECT_EQ(norm(anchor), 0);
    EXPECT_NEAR(lambda, -0.5, 1e-12);
    const vec3 before = x = vec3(1, 2, 3);
    reference::project_tether(x, anchor, 2, 0, lambda, TetherRow{4, 0}, make_step(0.01));
    EXPECT_EQ(norm(x - before), 0);
}

TEST(Tether, survives_degenerate_input) {
    for (const float w : {0.0f, 1e-30f, 1.0f}) {
        for (const float radius : {0.0f, 1e-20f, 1e30f}) {
            for (const float d : {0.0f, 1e-25f, 1.0f, 1e15f}) {
                scalar::vec3 x(d, 0, 0), anchor(0.0f);
                float lambda = 0;
                scalar::project_tether(x, anchor, w, 0.0f, lambda, {radius, 0},
                                       scalar::step_without_limits(1e-3f, 1e3f, 1e6f));
                EXPECT_TRUE(std::isfinite(x.x)) << w << ' ' << radius << ' ' << d;
                if (w == 0) {
                    EXPECT_EQ(x.x, d);
                }
            }
        }
    }
}

TEST(Geodesic, is_straight_across_a_flat_sheet_whatever_the_diagonals) {
    for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross}) {
        const TriangleMesh mesh = make_grid({1, 1}, {33, 33}, diagonal);
        const auto topology = build_topology(mesh, {.reorder = false});
        const std::uint32_t source[] = {0};
        const Geodesic way = geodesic_distance(*topology, source);
        for (std::uint32_t p = 1; p < topology->particle_count; ++p) {
            const double straight = length(topology->rest_positions[p] - topology->rest_positions[0]);
            EXPECT_GE(way.distance[p], straight * (1 - 1e-5)) << "no way is shorter than the straight one";
            EXPECT_LE(way.distance[p], straight * 1.01 + 1e-6) << "particle " << p;
        }
    }
}

TEST(Geodesic, goes_over_the_surface_not_through_the_air) {
    TriangleMesh mesh = make_grid({2, 0.5f}, {81, 11}, GridDiagonal::alternating);
    for (Vec3& p : mesh.positions) p = {std::sin(p.x * 1.5f) / 1.5f, std::cos(p.x * 1.5f) / 1.5f, p.z};  // rolled up
    const auto topology = build_topology(mesh, {.reorder = false});
    const std::uint32_t source[] = {5 * 81};
    const Geodesic way = geodesic_distance(*topology, source);
    EXPECT_NEAR(way.distance[5 * 81 + 80], 2, 0.005);
    EXPECT_LT(length(topology->rest_positions[5 * 81 + 80] - topology->rest_positions[5 * 81]), 1.4f);
}

TEST(Geodesic, knows_what_it_cannot_reach) {
    const auto topology = build_topology(pieces(2), {.reorder = false});
    const std::uint32_t source[] = {0};
    const Geodesic way = geodesic_distance(*topology, source);
    EXPECT_EQ(way.nearest[4], none);
    EXPECT_TRUE(std::isinf(way.distance[4]));
}

TEST(WaysToPlaces, are_those_to_each_place_by_itself) {
    const TriangleMesh mesh = make_grid({1, 1}, {25, 25}, GridDiagonal::uniform);
    const auto topology = build_topology(mesh, {.reorder = false});
    const std::vector<std::vector<std::uint32_t>> places{{0, 1}, {24}, {300}, {600, 601, 602}, {624}};
    const WaysToPlaces all = ways_to_places(*topology, places, 5), near = ways_to_places(*topology, places, 2);
    std::vector<Geodesic> alone;
    for (const auto& place : places) alone.push_back(geodesic_distance(*topology, place));
    for (std::uint32_t p = 0; p < topology->particle_count; ++p) {
        ASSERT_EQ(all[p].size(), 5u);
        std::vector<double> sorted;
        for (const Way& way : all[p]) {
            EXPECT_EQ(static_cast<float>(way.distance), alone[way.place].distance[p]);
            EXPECT_EQ(way.source, alone[way.place].nearest[p]);
            sorted.push_back(way.distance);
        }
        std::sort(sorted.begin(), sorted.end());
        ASSERT_EQ(near[p].size(), 2u);
        const auto [first, second] = std::minmax(near[p][0].distance, near[p][1].distance);
        EXPECT_EQ(first, sorted[0]) << "nothing stops the nearest front";
        EXPECT_GE(second, sorted[1]);
        EXPECT_LE(second, sorted[1] + 1.0 / 24) << "by a part of an edge";
    }
}

TEST(WaysToPlaces, lead_through_hubs_and_end_where_a_piece_does) {
    constexpr std::uint32_t rim = 2000;
    TriangleMesh mesh = fan(rim);
    add_triangle(mesh, {5, 0, 0}, {5, 0, 1}, {6, 0, 0});
    const auto topology = build_topology(mesh, {.reorder = false});
    const std::vector<std::vector<std::uint32_t>> places{{1}, {1 + rim / 2}};
    const WaysToPlaces ways = ways_to_places(*topology, places, 2);
    for (std::uint32_t p = rim + 1; p < topology->particle_count; ++p) EXPECT_TRUE(ways[p].empty());
    for (std::uint32_t p = 0; p <= rim; ++p) {
        ASSERT_EQ(ways[p].size(), 2u);
        for (const Way& way : ways[p]) {
            const float straight = length(topology->rest_positions[p] - topology->rest_positions[way.source]);
            EXPECT_GE(way.distance, straight * (1 - 1e-5));
            EXPECT_LE(way.distance, 2.0001) << "through the middle";
        }
    }
}

TEST(TetherRows, lead_to_every_place_where_the_cloth_is_held) {
    const TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::alternating);
    const auto topology = build_topology(mesh, {.reorder = false});
    RestShape rest = make_rest_shape(mesh, *topology);
    EXPECT_EQ(build_tether(rest, {.use = Tethers::on}).size(), 0u) << "held nowhere";
    rest.pinned.assign(topology->particle_count, 0);
    rest.pinned[0] = rest.pinned[1] = rest.pinned[8] = 1;  // two neighbors, and another corner
    EXPECT_EQ(build_tether(rest, {.use = Tethers::off}).size(), 0u);
    const RowList rows = build_tether(rest, {.use = Tethers::on, .slack = 0.1f});
    ASSERT_EQ(rows.size(), 2 * (81u - 3));
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const std::uint32_t p = rows.particles[2 * r], anchor = rows.particles[2 * r + 1];
        EXPECT_TRUE(rest.pinned[anchor] && !rest.pinned[p]);
        const float straight = length(topology->rest_positions[p] - topology->rest_positions[anchor]);
        EXPECT_NEAR(rows.fields[2 * r], 1.1f * straight, 0.02f * straight) << p << " to " << anchor;
    }
}

// Two halves of a sheet that are connected at one end: points at a small distance have a large geodesic distance, and
// the geodesic runs along both threads.
TEST(TetherRows, around_a_slit_give_way_as_the_way_does) {
    TriangleMesh mesh = make_grid({1, 1}, {17, 17}, GridDiagonal::alternating);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0f;
        return std::abs(middle.z) < 0.0625f && middle.x < 0.3f;
    });
    const auto topology = build_topology(mesh, {.reorder = false});
    RestShape rest = make_rest_shape(mesh, *topology);
    rest.elasticity = {.warp = 1e-3, .weft = 1e-3, .shear = 0.1, .tension = 1};
    const auto particle_at = [&](float x, float z) {
        std::uint32_t best = 0;
        for (std::uint32_t p = 0; p < topology->particle_count; ++p)
            if (length(topology->rest_positions[p] - Vec3{x, 0, z}) <
                length(topology->rest_positions[best] - Vec3{x, 0, z}))
                best = p;
        return best;
    };
    const std::uint32_t anchor = particle_at(-0.5f, -0.125f), across = particle_at(-0.5f, 0.125f),
                        beside = particle_at(-0.5f, -0.5f);
    rest.pinned.assign(topology->particle_count, 0);
    rest.pinned[anchor] = 1;
    const RowList rows = build_tether(rest, {.use = Tethers::on});
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const double radius = rows.fields[2 * r], compliance = rows.fields[2 * r + 1];
        if (rows.particles[2 * r] == beside) {
            EXPECT_NEAR(compliance / radius, 1e-3, 2e-4) << "along a thread";
        }
        if (rows.particles[2 * r] != across) continue;
        EXPECT_GT(radius, 1.5) << "there and back";
        EXPECT_GT(compliance / radius, 0.02) << "not that of the thread that leads straight across";
    }
}

}  // namespace
}  // namespace weft
