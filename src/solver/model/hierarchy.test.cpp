#include "solver/model/hierarchy.h"

#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "solver/model/cloth_model.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <numeric>
#include <random>

namespace weft {
namespace {

using namespace testing_meshes;

std::shared_ptr<const ClothModel> leveled_model(TriangleMesh mesh, const Fabric& fabric = {},
                                                std::vector<std::uint32_t> pinned = {0}) {
    auto topology = build_topology(mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    return *build_cloth_model({.mesh = std::move(mesh),
                               .fabric = fabric,
                               .pins = {.particles = std::move(pinned)},
                               .layout = {.hierarchy = true}},
                              std::move(*topology));
}

std::vector<Vec3> places_of(const ClothModel& model) {
    std::vector<Vec3> places;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) places.push_back(model.rest_position(p));
    return places;
}

TriangleMesh jittered(std::uint32_t n) {
    TriangleMesh mesh = make_grid({1, 1}, {n, n}, GridDiagonal::uniform);
    std::mt19937 random(3);
    const auto shift = [&] { return 0.25f / static_cast<float>(n) * (static_cast<float>(random() % 2001) / 1000 - 1); };
    for (Vec3& p : mesh.positions) p += {shift(), 0, shift()};
    return mesh;
}

TEST(Hierarchy, of_a_square_grid_takes_every_second_particle_again_and_again) {
    constexpr std::uint32_t n = 65;
    const auto model = leveled_model(make_grid({1, 1}, {n, n}, GridDiagonal::alternating));
    ASSERT_GE(model->hierarchy.size(), 3u);
    std::uint32_t step = 2;
    for (const CoarseLevel& level : model->hierarchy) {
        const std::uint32_t side = (n - 1) / step + 1;
        EXPECT_EQ(level.count, side * side);
        EXPECT_EQ(level.limits.rows, 2 * side * (side - 1) + 2 * (side - 1) * (side - 1)) << "threads and diagonals";
        for (std::uint32_t node = 0; node < level.count; ++node) {
            EXPECT_EQ(level.particle[node] % n % step, 0u);
            EXPECT_EQ(level.particle[node] / n % step, 0u);
        }
        const float way = static_cast<float>(step) / (n - 1);
        for (std::uint32_t row = 0; row < level.limits.stride; ++row) {
            if (!level.limits.is_real(row)) continue;
            const std::uint32_t a = level.particle[level.limits.particles[row]],
                                b = level.particle[level.limits.particles[level.limits.stride + row]];
            const bool diagonal = a % n != b % n && a / n != b / n;
            const float limit = level.limits.fields[row],
                        straight = way * (diagonal ? std::numbers::sqrt2_v<float> : 1);
            // Near a border or the pin, the members of a node are mostly on one side of it.
            const auto aside = [&](std::uint32_t p) {
                const auto near = [&](std::uint32_t i) { return i < 2 * step || i + 2 * step >= n; };
                return near(p % n) || near(p / n);
            };
            const bool shifted = aside(a) || aside(b);
            const float more = shifted ? 1.15f : 1.0f, less = shifted ? 0.9f : 1.0f;
            EXPECT_GE(limit, straight * less * 0.99999f);
            EXPECT_LE(limit, straight * more * (diagonal ? 1.05f : 1.005f)) << "cotton gives way along the bias";
            EXPECT_GE(limit, straight * less * (diagonal ? 1.02f : 0.99999f));
        }
        step *= 2;
    }
}

// Members and weights of a node's mean.
std::vector<std::pair<std::uint32_t, float>> members_of(const CoarseLevel& level, std::uint32_t node) {
    const Restriction& from = level.restriction;
    std::vector<std::pair<std::uint32_t, float>> members;
    const std::uint32_t packet = node / lane_padding;
    for (std::uint32_t k = from.begin[packet]; k < from.begin[packet + 1]; ++k) {
        const std::size_t at = std::size_t{k} * lane_padding + node % lane_padding;
        if (from.weight[at] > 0) members.emplace_back(from.node[at], from.weight[at]);
    }
    return members;
}

// The restriction is the transpose of the prolongation, weighted by mass. Otherwise coarse levels would add energy.
TEST(Hierarchy, takes_a_nodes_place_from_what_it_carries) {
    for (const TriangleMesh& mesh :
         {make_grid({1, 1}, {40, 40}, GridDiagonal::alternating), jittered(40), make_sphere(0.5f, 4), fan(3000)}) {
        const auto model = leveled_model(mesh);
        std::vector<double> mass(model->mass.begin(), model->mass.begin() + model->particle_count);
        std::vector<std::uint8_t> pinned(mass.size());
        pinned[0] = 1;
        for (const CoarseLevel& level : model->hierarchy) {
            std::vector<std::map<std::uint32_t, double>> carries(level.count);
            for (std::uint32_t i = 0; i < mass.size(); ++i) {
                for (std::uint32_t k = 0; k < Prolongation::parents; ++k) {
                    const std::size_t at = std::size_t{k} * level.prolongation.stride + i;
                    if (level.prolongation.weight[at] > 0)
                        carries[level.prolongation.node(at)][i] += level.prolongation.weight[at] * mass[i];
                }
            }
            std::vector<double> carried(level.count);
            std::vector<std::uint8_t> pinned_node(level.count);
            for (std::uint32_t node = 0; node < level.count; ++node) {
                for (const auto& [finer, weight] : carries[node]) carried[node] += weight;
                pinned_node[node] = level.weight[node] == 0;
                const auto members = members_of(level, node);
                if (pinned_node[node]) {
                    ASSERT_EQ(members.size(), 1u) << "a pinned node is its own place";
                    EXPECT_EQ(members[0].second, 1);
                    EXPECT_TRUE(pinned[members[0].first]);
                    continue;
                }
                double sum = 0;
                for (const auto& [finer, weight] : members) sum += weight;
                EXPECT_NEAR(sum, 1, 1e-5);
                if (members.size() != carries[node].size()) {
                    EXPECT_EQ(members.size(), 256u) << "only of a hub some are left out";
                    EXPECT_GT(carries[node].size(), members.size());
                    continue;
                }
                for (const auto& [finer, weight] : members) {
                    ASSERT_TRUE(carries[node].contains(finer));
                    EXPECT_NEAR(weight, carries[node][finer] / carried[node], 1e-6);
                }
            }
            mass = carried, pinned = pinned_node;
        }
    }
}

// Means differ from the node positions. No coarse constraint may therefore pull at a cloth at rest.
TEST(Hierarchy, leaves_a_cloth_at_rest_alone) {
    for (const bool lines : {false, true}) {
        for (const TriangleMesh& mesh :
             {make_grid({1, 1}, {64, 64}, GridDiagonal::uniform),
              make_grid({1, 1}, {65, 40}, GridDiagonal::alternating), jittered(50), make_sphere(0.5f, 4)}) {
            auto topology = build_topology(mesh, {.reorder = false});
            const auto model = *build_cloth_model(
                {.mesh = mesh, .pins = {.particles = {0, 7}}, .layout = {.lines = lines, .hierarchy = true}},
                std::move(*topology));
            ASSERT_FALSE(model->hierarchy.empty());
            std::vector<Vec3> finer = places_of(*model);
            for (const CoarseLevel& level : model->hierarchy) {
                std::vector<Vec3> mean(level.count);
                for (std::uint32_t node = 0; node < level.count; ++node) {
                    for (const auto& [member, weight] : members_of(level, node)) mean[node] += finer[member] * weight;
                }
                for (std::uint32_t row = 0; row < level.limits.stride; ++row) {
                    if (!level.limits.is_real(row)) continue;
                    const Vec3 a = mean[level.limits.particles[row]],
                               b = mean[level.limits.particles[level.limits.stride + row]];
                    EXPECT_LE(length(a - b), level.limits.fields[row]) << "row " << row;
                }
                finer = std::move(mean);
            }
        }
    }
}

// The prolongation is exact for a constant displacement, and nearly exact for a linear one away from borders.
TEST(Hierarchy, carries_what_its_nodes_do) {
    for (const TriangleMesh& mesh :
         {make_grid({1, 1}, {33, 33}, GridDiagonal::alternating), jittered(33), make_sphere(0.5f, 4)}) {
        const auto model = leveled_model(mesh);
        ASSERT_FALSE(model->hierarchy.empty());
        std::uint32_t finer = model->particle_count;
        double off = 0;
        for (const CoarseLevel& level : model->hierarchy) {
            for (std::uint32_t i = 0; i < finer; ++i) {
                double sum = 0, x = 0;
                for (std::uint32_t k = 0; k < Prolongation::parents; ++k) {
                    const std::size_t at = std::size_t{k} * level.prolongation.stride + i;
                    ASSERT_LT(level.prolongation.node(at), level.count);
                    EXPECT_GE(level.prolongation.weight[at], 0);
                    sum += level.prolongation.weight[at];
                    x += level.prolongation.weight[at] *
                         model->rest_position(level.particle[level.prolongation.node(at)]).x;
                }
                if (&level == &model->hierarchy[0]) {
                    const bool pinned = !(model->start[i].w > 0);
                    EXPECT_NEAR(sum, pinned ? 0 : 1, 1e-6);
                    if (!pinned) off = std::max(off, std::abs(x - model->rest_position(i).x));
                }
            }
            finer = level.count;
        }
        EXPECT_LT(off, 0.06) << "m: no farther than a cell or two";
    }
}

TEST(Hierarchy, weighs_what_it_carries_and_lets_no_row_be_much_shorter_than_the_way) {
    for (const TriangleMesh& mesh : {make_grid({1, 1}, {40, 40}, GridDiagonal::alternating), jittered(40)}) {
        const auto model = leveled_model(mesh);
        const double cloth = std::accumulate(model->mass.begin(), model->mass.end(), -double{model->mass[0]});
        for (const CoarseLevel& level : model->hierarchy) {
            double sum = 0;
            for (std::uint32_t node = 0; node < level.count; ++node) {
                if (level.weight[node] > 0) sum += 1 / double{level.weight[node]};
            }
            EXPECT_LE(sum, cloth * 1.0001);
            EXPECT_GT(sum, 0.8 * cloth) << "what hangs on the pin is not counted";
            EXPECT_EQ(level.weight[0], 0) << "the pinned particle is a node of every level";
            const std::vector<Vec3> x = places_of(*model);
            for (std::uint32_t row = 0; row < level.limits.stride; ++row) {
                if (!level.limits.is_real(row)) continue;
                const Vec3 a = x[level.particle[level.limits.particles[row]]];
                const Vec3 b = x[level.particle[level.limits.particles[level.limits.stride + row]]];
                EXPECT_GE(level.limits.fields[row], length(a - b) * 0.8999f);
            }
        }
    }
}

TEST(Hierarchy, lists_the_nodes_that_are_pinned) {
    const std::vector<std::uint32_t> pins{0, 1, 32, 500};
    const auto model = leveled_model(jittered(33), {}, pins);
    ASSERT_GE(model->hierarchy.size(), 2u);
    for (const CoarseLevel& level : model->hierarchy) {
        std::vector<std::uint32_t> pinned;
        for (std::uint32_t node = 0; node < level.count; ++node)
            if (std::ranges::binary_search(pins, level.particle[node])) pinned.push_back(node);
        EXPECT_EQ(level.pinned, pinned);
        EXPECT_FALSE(pinned.empty());
        for (const std::uint32_t node : pinned) EXPECT_EQ(level.weight[node], 0);
    }
}

TEST(Hierarchy, is_left_out_where_it_is_of_no_use) {
    Fabric soft;
    soft.stretch = {.stretch = {2, 2}, .compression = {2, 2}, .shear = 1};
    EXPECT_TRUE(leveled_model(make_grid({1, 1}, {33, 33}, GridDiagonal::alternating), soft)->hierarchy.empty());
    soft.stretch = {.stretch = {10, 10}, .compression = {10, 10}, .shear = 1};
    EXPECT_FALSE(leveled_model(make_grid({1, 1}, {33, 33}, GridDiagonal::alternating), soft)->hierarchy.empty());
    EXPECT_TRUE(leveled_model(make_grid({1, 1}, {3, 3}, GridDiagonal::alternating))->hierarchy.empty());
    Fabric free;
    free.stretch = {.stretch = {0, 4000}, .compression = {0, 0}, .shear = 0};
    EXPECT_TRUE(leveled_model(make_grid({1, 1}, {33, 33}, GridDiagonal::alternating), free)->hierarchy.empty());
}

TEST(Hierarchy, survives_what_topology_survives) {
    TriangleMesh mesh = make_grid({1, 1}, {12, 12}, GridDiagonal::cross);
    mesh.triangles.push_back({0, 5, 140});                    // long and thin; makes some edges non-manifold
    add_triangle(mesh, {5, 0, 0}, {5, 0, 1e-3f}, {6, 0, 0});  // a separate piece
    mesh.uvs.clear();
    mesh.normals.clear();
    const auto model = leveled_model(mesh);
    for (const CoarseLevel& level : model->hierarchy) {
        for (float w : level.weight) EXPECT_TRUE(std::isfinite(w));
        for (float w : level.prolongation.weight) EXPECT_TRUE(std::isfinite(w));
    }
}

TEST(Hierarchy, is_sound_on_hubs_strips_and_pieces) {
    Fabric stiff;  // so that long meshes have levels too
    stiff.stretch = {.stretch = {1e6f, 1e6f}, .compression = {1e5f, 1e5f}, .shear = 1e5f};
    for (const TriangleMesh& mesh :
         {fan(20000), book(3000, 7), make_grid({100, 0.01f}, {10000, 2}, GridDiagonal::uniform), pieces(5000)}) {
        for (const std::vector<std::uint32_t>& pinned : {std::vector<std::uint32_t>{}, {0}, {7}}) {
            const auto model = leveled_model(mesh, stiff, pinned);
            std::uint32_t finer = model->particle_count;
            for (const CoarseLevel& level : model->hierarchy) {
                EXPECT_LT(level.count, finer);
                for (std::uint32_t i = 0; i < finer; ++i) {
                    double sum = 0;
                    for (std::uint32_t k = 0; k < Prolongation::parents; ++k)
                        sum += level.prolongation.weight[std::size_t{k} * level.prolongation.stride + i];
                    ASSERT_TRUE(sum == 0 || std::abs(sum - 1) < 1e-6) << sum;
                }
                for (std::uint32_t row = 0; row < level.limits.stride; ++row) {
                    ASSERT_TRUE(!level.limits.is_real(row) || std::isfinite(level.limits.fields[row]));
                }
                finer = level.count;
            }
        }
    }
}

}  // namespace
}  // namespace weft
