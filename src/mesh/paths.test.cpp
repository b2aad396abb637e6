#include "mesh/paths.h"

#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace weft {
namespace {

using namespace testing_meshes;

struct Links {
    std::vector<std::uint32_t> points;
    std::vector<Vec3> positions;
};

Links links_of(const TriangleMesh& mesh) {
    const auto topology = build_topology(mesh, {.reorder = false});
    Links links{.points = {}, .positions = topology->rest_positions};
    for (const Edge& edge : topology->edges) links.points.insert(links.points.end(), {edge.a, edge.b});
    return links;
}

std::vector<std::uint32_t> points_of(const Links& links, const Paths& paths, std::uint32_t path) {
    std::vector<std::uint32_t> visited;
    for (std::uint32_t i = paths.offsets[path]; i < paths.offsets[path + 1]; ++i) {
        const std::uint32_t link = paths.links[i], end = paths.turned[i];
        if (visited.empty()) visited.push_back(links.points[2 * link + end]);
        EXPECT_EQ(visited.back(), links.points[2 * link + end]) << "path " << path << " has a gap";
        visited.push_back(links.points[2 * link + (end ^ 1)]);
    }
    return visited;
}

void expect_sound(const Links& links, const Paths& paths, std::uint32_t max_length) {
    std::vector<std::uint32_t> all = paths.links;
    std::ranges::sort(all);
    ASSERT_EQ(all.size(), links.points.size() / 2);
    for (std::uint32_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i], i) << "every link once";
    for (std::uint32_t path = 0; path < paths.size(); ++path) {
        ASSERT_GT(paths.length(path), 0u);
        ASSERT_LE(paths.length(path), max_length);
        const auto visited = points_of(links, paths, path);
        ASSERT_EQ(std::set(visited.begin(), visited.end()).size(), visited.size()) << "path " << path;
    }
}

TEST(Paths, of_a_grid_are_its_lines) {
    const Links links = links_of(make_grid({1, 1}, {9, 7}, GridDiagonal::uniform));
    const Paths paths = find_paths(links.points, links.positions, 100);
    expect_sound(links, paths, 100);
    EXPECT_EQ(paths.size(), 7u + 9u + (8u + 6u - 1u)) << "rows, columns and diagonals";
}

TEST(Paths, are_cut_into_equal_pieces_and_links_between_where_they_are_too_long) {
    const Links links = links_of(make_grid({1, 1}, {102, 2}, GridDiagonal::uniform));
    const Paths paths = find_paths(links.points, links.positions, 50);
    expect_sound(links, paths, 50);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t path = 0; path < paths.size(); ++path) lengths.push_back(paths.length(path));
    EXPECT_EQ(std::ranges::count(lengths, 50u), 4) << "two sides of 101: two pieces each and the link between them";
}

TEST(Paths, of_a_ring_are_at_least_two) {
    constexpr std::uint32_t count = 24;
    Links ring{.points = {}, .positions = fan(count).positions};
    for (std::uint32_t i = 0; i < count; ++i) ring.points.insert(ring.points.end(), {1 + i, 1 + (i + 1) % count});
    const Paths paths = find_paths(ring.points, ring.positions, 100);
    expect_sound(ring, paths, 100);
    EXPECT_EQ(paths.size(), 2u);
}

TEST(Paths, are_sound_on_anything) {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        Links links;
        const std::uint32_t count = 2 + random() % 40;
        const auto number = [&] { return static_cast<float>(random() % 5); };  // equal places among them
        for (std::uint32_t p = 0; p < count; ++p) links.positions.push_back({number(), number(), number()});
        const std::uint32_t links_tried = random() % 200;
        for (std::uint32_t link = 0; link < links_tried; ++link) {
            const std::uint32_t a = random() % count, b = random() % count;
            if (a != b) links.points.insert(links.points.end(), {a, b});
        }
        const std::uint32_t max_length = 1 + random() % 9;
        expect_sound(links, find_paths(links.points, links.positions, max_length), max_length);
    }
}

TEST(Paths, end_at_the_hub_of_a_large_fan) {
    constexpr std::uint32_t count = 100000;
    Links spokes{.points = {}, .positions = fan(count).positions};
    for (std::uint32_t i = 1; i <= count; ++i) spokes.points.insert(spokes.points.end(), {0u, i});
    const Paths paths = find_paths(spokes.points, spokes.positions, 100);
    EXPECT_EQ(paths.size(), count);
    EXPECT_EQ(find_paths({}, {}, 1).size(), 0u);
}

}  // namespace
}  // namespace weft
