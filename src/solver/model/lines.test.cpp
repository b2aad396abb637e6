#include "solver/model/lines.h"

#include "mesh/procedural.h"
#include "physics/rest_shape.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace weft {
namespace {

struct Packed {
    RowList rows;
    std::uint32_t particles = 0;
    ConstraintTable table;
};

Packed pack(const TriangleMesh& mesh, const ColoringOptions& options = {}) {
    const auto topology = build_topology(mesh, {.reorder = false});
    Packed packed{.rows = build_stretch(make_rest_shape(mesh, *topology), StretchMaterial{.inextensible = true}),
                  .particles = topology->particle_count,
                  .table = {}};
    packed.table = pack_lines(packed.rows, topology->rest_positions, packed.particles, options);
    return packed;
}

void expect_sound(const Packed& packed) {
    const auto& [rows, particles, table] = packed;
    const auto slot = [&](std::uint32_t k, std::uint32_t row) {
        return table.particles[std::size_t{k} * table.stride + row];
    };
    std::map<std::set<std::uint32_t>, std::uint32_t> row_between;
    for (std::uint32_t row = 0; row < rows.size(); ++row)
        row_between[{rows.particles[2 * row], rows.particles[2 * row + 1]}] = row;
    std::vector<std::uint32_t> seen(rows.size());
    std::uint32_t at = 0;
    for (const Batch& batch : table.batches) {
        EXPECT_EQ(batch.begin, at);
        at = batch.padded_end();
        std::set<std::uint32_t> of_batch;
        for (std::uint32_t b = batch.first_block; b < batch.first_block + batch.blocks; ++b) {
            const LineBlock& block = table.blocks[b];
            EXPECT_LE(block.length, longest_line);
            for (std::uint32_t lane = 0; lane < lane_padding; ++lane) {
                std::set<std::uint32_t> of_line;
                for (std::uint32_t k = 0; k < block.length; ++k) {
                    const std::uint32_t row = block.begin + k * lane_padding + lane;
                    if (k > 0) {
                        EXPECT_EQ(slot(0, row), slot(1, row - lane_padding)) << "a gap in a line";
                    }
                    if (!table.is_real(row)) {
                        EXPECT_LT(table.fields[table.stride + row], 0) << "padding without stiffness";
                        EXPECT_EQ(slot(1, row), slot(0, row)) << "padding connects a particle to itself";
                        continue;
                    }
                    of_line.insert(slot(0, row)), of_line.insert(slot(1, row));
                    EXPECT_EQ(of_line.size(), k + 2) << "a line that crosses itself";
                }
                for (const std::uint32_t p : of_line) EXPECT_TRUE(of_batch.insert(p).second) << "lines that meet";
            }
        }
    }
    EXPECT_EQ(at, table.stride);
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row)) continue;
        const auto found = row_between.find({slot(0, row), slot(1, row)});
        ASSERT_NE(found, row_between.end());
        ++seen[found->second];
        EXPECT_EQ(table.fields[row], rows.fields[rows.field_count * std::size_t{found->second}]);
    }
    for (const std::uint32_t count : seen) EXPECT_EQ(count, 1u);
}

TEST(Lines, of_a_grid_are_three_batches) {
    const Packed packed = pack(make_grid({1, 1}, {40, 40}, GridDiagonal::uniform));
    expect_sound(packed);
    EXPECT_EQ(packed.table.batches.size(), 3u) << "rows, columns, diagonals";
    EXPECT_EQ(packed.table.overflow(), 0u);
}

TEST(Lines, are_sound_on_every_kind_of_mesh) {
    TriangleMesh jittered = make_grid({1, 1}, {50, 30}, GridDiagonal::alternating);
    std::mt19937 random(1);
    for (Vec3& p : jittered.positions) p.x += 0.01f * static_cast<float>(random() % 100) / 100;
    for (const TriangleMesh& mesh : {jittered, make_grid({1, 1}, {300, 5}, GridDiagonal::cross), make_sphere(0.5f, 4),
                                     make_grid({1, 1}, {2, 2}, GridDiagonal::uniform)}) {
        expect_sound(pack(mesh));
        expect_sound(pack(mesh, {.max_colors = 2}));
    }
}

TEST(Lines, that_find_no_color_are_left_over) {
    const Packed packed = pack(make_grid({1, 1}, {20, 20}, GridDiagonal::uniform), {.max_colors = 1});
    expect_sound(packed);
    EXPECT_GT(packed.table.overflow(), 0u);
}

TEST(Lines, of_nothing_are_nothing) {
    const ConstraintTable table = pack_lines(make_rows(ConstraintKind::stretch), {}, 0);
    EXPECT_EQ(table.stride, 0u);
    EXPECT_TRUE(table.batches.empty());
}

}  // namespace
}  // namespace weft
