#include "mesh/ordering.h"

#include "mesh/edges.h"
#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace weft {
namespace {

using Numbers = std::vector<std::uint32_t>;

std::vector<Edge> graph(std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs) {
    std::vector<Edge> edges;
    for (const auto& [p, q] : pairs) edges.push_back({std::min(p, q), std::max(p, q), 0, none});
    std::sort(edges.begin(), edges.end(), [](auto& x, auto& y) { return std::pair{x.a, x.b} < std::pair{y.a, y.b}; });
    return edges;
}

std::vector<Edge> renumbered(const std::vector<Edge>& edges, const Numbers& number) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const Edge& e : edges) pairs.push_back({number[e.a], number[e.b]});
    return graph(pairs);
}

Numbers shuffled(std::uint32_t count, std::uint32_t seed) {
    Numbers numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::shuffle(numbers.begin(), numbers.end(), std::mt19937(seed));
    return numbers;
}

bool is_permutation_of_all(Numbers numbers) {
    std::sort(numbers.begin(), numbers.end());
    for (std::uint32_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] != i) return false;
    return true;
}

std::uint32_t bandwidth(const std::vector<Edge>& edges) {
    std::uint32_t widest = 0;
    for (const Edge& e : edges) widest = std::max(widest, e.b - e.a);
    return widest;
}

std::vector<Edge> grid_edges(std::uint32_t nx, std::uint32_t nz, GridDiagonal diagonal = GridDiagonal::uniform) {
    const auto mesh = make_grid({1, 1}, {nx, nz}, diagonal);
    return build_edges(mesh.triangles, nx * nz).edges;
}

TEST(Ordering, mean_span) {
    EXPECT_EQ(mean_edge_span({}), 0);
    EXPECT_EQ(mean_edge_span(graph({{0, 1}, {0, 6}, {5, 3}})), 3);
}

TEST(Ordering, shuffled_path_becomes_a_path) {
    const std::uint32_t count = 1000;
    const Numbers shuffle = shuffled(count, 4);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i + 1 < count; ++i) pairs.push_back({shuffle[i], shuffle[i + 1]});
    const auto path = graph(pairs);
    const Numbers order = reverse_cuthill_mckee(path, count);
    EXPECT_TRUE(is_permutation_of_all(order));
    EXPECT_EQ(bandwidth(renumbered(path, order)), 1u);
}

TEST(Ordering, shuffled_grid_becomes_narrow) {
    const std::uint32_t nx = 20, nz = 100;
    const auto edges = renumbered(grid_edges(nx, nz), shuffled(nx * nz, 9));
    const Numbers order = better_order(edges, nx * nz);
    ASSERT_TRUE(is_permutation_of_all(order));
    ASSERT_EQ(order.size(), nx * nz);
    EXPECT_LE(bandwidth(renumbered(edges, order)), 2 * nx + 2);
    EXPECT_EQ(order, better_order(edges, nx * nz));
}

TEST(Ordering, good_order_stays) {
    EXPECT_TRUE(better_order(grid_edges(30, 30, GridDiagonal::alternating), 900).empty());
    EXPECT_TRUE(better_order(grid_edges(10, 200), 2000).empty());
    EXPECT_TRUE(better_order({}, 0).empty());
}

TEST(Ordering, turned_grid_does_not_stay) {
    // 200 wide and 10 deep, row by row: column by column is far better.
    const auto edges = grid_edges(200, 10);
    const Numbers order = better_order(edges, 2000);
    ASSERT_FALSE(order.empty());
    EXPECT_LT(mean_edge_span(renumbered(edges, order)), 0.3 * mean_edge_span(edges));
}

TEST(Ordering, components_stay_together_and_in_order) {
    // Components {0, 3, 5}, {1, 4} and {2}.
    const auto edges = graph({{0, 3}, {3, 5}, {1, 4}});
    const Numbers order = reverse_cuthill_mckee(edges, 6);
    EXPECT_TRUE(is_permutation_of_all(order));
    EXPECT_LT(std::max({order[0], order[3], order[5]}), 3u);
    EXPECT_LT(std::max(order[1], order[4]), 5u);
    EXPECT_EQ(order[2], 5u);
    // The walk starts at 5, the far end as seen from 0, and its order is reversed.
    EXPECT_EQ(order[5], 2u);
    EXPECT_EQ(order[3], 1u);
}

TEST(Ordering, hub_of_great_valence) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 1; i < 500; ++i) pairs.push_back({0, i});
    EXPECT_TRUE(is_permutation_of_all(reverse_cuthill_mckee(graph(pairs), 500)));
}

}  // namespace
}  // namespace weft
