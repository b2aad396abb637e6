#include "collide/sheet_order.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace weft {
namespace {

using Place = std::function<Vec3(Vec3)>;

SheetPose placed(const TriangleMesh& mesh, const Place& place) {
    SheetPose sheet{.positions = {}, .triangles = mesh.triangles};
    for (const Vec3 p : mesh.positions) sheet.positions.push_back(place(p));
    return sheet;
}

TriangleMesh square(float size, std::uint32_t resolution) {
    return make_grid({size, size}, {resolution, resolution}, GridDiagonal::alternating);
}

Place moved(Vec3 by) {
    return [by](Vec3 p) { return p + by; };
}

Vec3 turned_about_x(Vec3 p, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

// Two sheets of different meshes, the second one above the first.
const TriangleMesh lower = square(1, 12), upper = square(0.8f, 9);

std::vector<SheetPose> two(const Place& place_lower, const Place& place_upper) {
    return {placed(lower, place_lower), placed(upper, place_upper)};
}

std::size_t lost(const std::vector<std::vector<SheetPose>>& poses,
                 double near = std::numeric_limits<double>::infinity()) {
    SheetOrder order(poses.front());
    for (std::size_t i = 1; i < poses.size(); ++i) order.add(poses[i], near);
    return order.lost();
}

// Both at once and through all poses between, t from 0 to 1.
void expect_lost(std::size_t expected, const std::function<std::vector<SheetPose>(float)>& at) {
    EXPECT_EQ(lost({at(0), at(1)}), expected);
    std::vector<std::vector<SheetPose>> poses;
    for (int i = 0; i <= 40; ++i) poses.push_back(at(static_cast<float>(i) / 40));
    EXPECT_EQ(lost(poses), expected);
}

TEST(SheetOrder, a_sheet_that_passes_through_another_one_is_found) {
    const auto tilted = [](float height) {
        return [height](Vec3 p) { return turned_about_x(p, 0.3f) + Vec3{0.07f, height, 0}; };
    };
    expect_lost(1, [&](float t) { return two(moved({}), moved({0, 0.1f - 0.15f * t, 0})); });
    expect_lost(1, [&](float t) { return two(moved({}), tilted(0.5f - t)); });
    // It slides at the same time, and both fall and turn.
    expect_lost(1, [&](float t) {
        const auto fall = [t](Vec3 p) { return turned_about_x(p, 2 * t) - Vec3{0, 3 * t, 0}; };
        return two(fall, [=](Vec3 p) { return fall(p + Vec3{0.1f - 0.2f * t, 0.05f - 0.1f * t, 0}); });
    });
}

TEST(SheetOrder, a_stack_that_moves_as_a_whole_keeps_its_order) {
    expect_lost(0, [](float t) {
        const auto turn = [t](Vec3 p) { return turned_about_x(p, 3.1f * t) + Vec3{0, -0.5f * t, 0}; };
        return two(turn, [=](Vec3 p) { return turn(p + Vec3{0, 0.004f, 0}); });
    });
}

TEST(SheetOrder, a_sheet_that_falls_on_another_one_keeps_its_order) {
    expect_lost(0, [](float t) { return two(moved({}), moved({0, 0.5f - 0.498f * t, 0})); });
}

// First to the side, then down, then under the other sheet.
Vec3 around_the_rim(float t) {
    if (t < 0.4f) return {2.6f * t, 0.01f, 0};
    if (t < 0.5f) return {1.04f, 0.01f - 0.4f * (t - 0.4f), 0};
    return {1.04f - 2 * (t - 0.5f), -0.03f, 0};
}

TEST(SheetOrder, a_sheet_that_slides_off_another_one_keeps_its_order) {
    expect_lost(0, [](float t) { return two(moved({}), moved(around_the_rim(0.5f * t))); });
    std::vector<std::vector<SheetPose>> poses;
    for (int i = 0; i <= 100; ++i) poses.push_back(two(moved({}), moved(around_the_rim(static_cast<float>(i) / 100))));
    EXPECT_EQ(lost(poses), 0u) << "followed to its place below the other sheet";
    // Far below the other sheet, it may have slid off too.
    const auto start = two(moved({}), moved({0, 0.01f, 0})), end = two(moved({}), moved({0.2f, -0.6f, 0}));
    EXPECT_EQ(lost({start, end}, 0.2), 0u);
    EXPECT_EQ(lost({start, end}), 1u);
}

TEST(SheetOrder, a_sheet_that_folds_around_a_rim_keeps_its_order) {
    // The part beyond x = 0.45 + wraps around the rim of a narrower sheet until it lies below it.
    const TriangleMesh inner = square(0.6f, 10), outer = square(1.2f, 25);
    expect_lost(0, [&](float t) {
        return std::vector{
            placed(inner, moved({})), placed(outer, [t](Vec3 p) {
                const float radius = 0.01f, from = 0.32f, half_turn = std::numbers::pi_v<float> * radius;
                const float beyond = std::max(0.0f, p.x - from), angle = t * std::min(beyond, half_turn) / radius;
                const float straight = std::max(0.0f, beyond - half_turn);
                if (beyond == 0) return Vec3{p.x, radius, p.z};
                const float curve = t > 0 ? radius / t : 0;
                const float x = t > 0 ? curve * std::sin(angle) : std::min(beyond, half_turn);
                const float y = t > 0 ? curve * (1 - std::cos(angle)) : 0;
                return Vec3{from + x + straight * std::cos(angle), radius - y - straight * std::sin(angle), p.z};
            })};
    });
}

// Points of a curve whose curvature falls along its length, and their distance from it along its normal.
Vec3 rolled(Vec3 p, float t, float away) {
    float x = 0, y = 0, angle = 0;
    const int steps = 400;
    const float along = p.x + 1, step = along / steps;
    for (int i = 0; i < steps; ++i) {
        const float s = step * (static_cast<float>(i) + 0.5f);
        angle += t * step / (0.06f + 0.08f * s);
        x += step * std::cos(angle), y += step * std::sin(angle);
    }
    return {x - away * std::sin(angle), y + away * std::cos(angle), p.z};
}

TEST(SheetOrder, sheets_that_roll_up_together_keep_their_order) {
    const TriangleMesh strip = make_grid({2, 0.3f}, {101, 8}, GridDiagonal::alternating);
    for (const float away : {0.004f, 0.02f})
        expect_lost(0, [&](float t) {
            return std::vector{placed(strip, [&](Vec3 p) { return rolled(p, t, 0); }),
                               placed(strip, [&](Vec3 p) { return rolled(p, t, -away); })};
        });
}

TEST(SheetOrder, less_than_half_of_a_sheet_has_not_passed) {
    const auto lower_by = [](float part) {
        return two(moved({}), [part](Vec3 p) { return p + Vec3{0, p.x < -0.4f + 0.8f * part ? -0.01f : 0.01f, 0}; });
    };
    const auto start = two(moved({}), moved({0, 0.01f, 0}));
    EXPECT_EQ(lost({start, lower_by(0.3f)}), 0u);
    EXPECT_EQ(lost({start, lower_by(0.7f)}), 1u);
    // What is left of a sheet that slides off does not speak for all of it.
    EXPECT_EQ(lost({start, lower_by(0.2f),
                    two(moved({}),
                        [](Vec3 p) {
                            return p + Vec3{0.75f, p.x < -0.24f ? -0.01f : 0.01f, 0};
                        })}),
              0u);
}

TEST(SheetOrder, each_pair_counts_once_and_for_good) {
    const auto stack = [](std::array<float, 3> heights) {
        std::vector<SheetPose> sheets;
        for (const float height : heights) sheets.push_back(placed(square(1, 8), moved({0, height, 0})));
        return sheets;
    };
    EXPECT_EQ(lost({stack({0, 0.1f, 0.2f}), stack({0.3f, 0.1f, 0.2f})}), 2u);
    EXPECT_EQ(lost({stack({0, 0.1f, 0.2f}), stack({0.2f, 0.1f, 0})}), 3u);
    EXPECT_EQ(lost({stack({0, 0.1f, 0.2f}), stack({0, 0.3f, 0.2f}), stack({0, 0.1f, 0.2f})}), 1u);
    EXPECT_EQ(lost({stack({0, 0.1f, 0.2f}), stack({0, 0.3f, 0.2f}), stack({5, 9, 13})}), 1u) << "they came apart";
}

TEST(SheetOrder, a_ball_has_an_inside) {
    const TriangleMesh ball = make_sphere(0.5f, 3), small = make_sphere(0.1f, 2);
    const auto at = [&](float x) { return std::vector{placed(ball, moved({})), placed(small, moved({x, 0, 0}))}; };
    EXPECT_EQ(lost({at(0.8f), at(0.65f)}), 0u);
    EXPECT_EQ(lost({at(0.8f), at(0.2f)}), 1u);
    EXPECT_EQ(lost({at(0.2f), at(-0.2f)}), 0u);
}

// Each triangle gets particles of its own. Their originals go elsewhere.
SheetPose torn(const SheetPose& sheet, const SheetPose& originals) {
    SheetPose parts{originals.positions, sheet.triangles};
    for (Triangle& triangle : parts.triangles) {
        for (std::uint32_t& corner : triangle) {
            parts.copied_from.push_back(corner);
            parts.positions.push_back(sheet.positions[corner]);
            corner = static_cast<std::uint32_t>(parts.positions.size() - 1);
        }
    }
    return parts;
}

TEST(SheetOrder, a_sheet_that_tears_is_followed) {
    // Askew, so that closest points are inside triangles: all particles of a torn sheet are on a rim. Both sheets
    // slant, so that their boxes overlap.
    const auto at = [](float height) {
        const auto slanted = [](Vec3 p) { return turned_about_x(p, 0.3f); };
        return two(slanted, [=](Vec3 p) { return slanted(p + Vec3{0.013f, height, 0.017f}); });
    };
    for (const bool both : {false, true}) {
        // The originals stay where they were: above and below the other sheet.
        const auto torn_at = [&](float height) {
            std::vector<SheetPose> sheets = at(height);
            sheets[1] = torn(sheets[1], at(0.02f)[1]);
            if (both)
                sheets[0] = torn(sheets[0], placed(lower, [](Vec3 p) {
                                     return turned_about_x(p - Vec3{0, 0.02f, 0}, 0.3f);
                                 }));
            return sheets;
        };
        EXPECT_EQ(lost({at(0.02f), torn_at(0.01f), torn_at(0.02f)}), 0u);
        EXPECT_EQ(lost({at(0.02f), torn_at(0.01f), torn_at(-0.01f)}), 1u);
        EXPECT_EQ(lost({at(0.02f), torn_at(-0.01f)}), 1u) << "between the same two poses";
        EXPECT_EQ(lost({at(0.02f), at(0.01f), torn_at(-0.01f)}), 1u) << "copies know where their originals were";
        EXPECT_EQ(lost({at(0.02f), at(0.01f), torn_at(0.02f)}), 0u);
    }
}

TEST(SheetOrder, degenerate_and_malformed_sheets_are_survived) {
    const SheetPose none, point{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}, sheet = placed(lower, moved({}));
    EXPECT_EQ(lost({{}, {}}), 0u);
    EXPECT_EQ(lost({{none, point, sheet}, {none, point, sheet}}), 0u);
    SheetPose broken = sheet;
    broken.positions[5].x = std::nanf("");
    EXPECT_EQ(lost({two(moved({}), moved({0, 0.1f, 0})), {broken, placed(upper, moved({0, -0.1f, 0}))}}), 0u);
}

TEST(SheetSides, edges_and_particles_of_a_sharp_fold_have_a_side) {
    // A roof with a steep right side, seen from above.
    const std::vector<Vec3> roof{{-1, 0, -1}, {-1, 0, 0},     {-1, 0, 1},    {0, 1, -1},   {0, 1, 0},
                                 {0, 1, 1},   {-0.4f, 0, -1}, {-0.4f, 0, 0}, {-0.4f, 0, 1}};
    std::vector<Triangle> triangles;
    for (const std::uint32_t row : {0u, 3u})
        for (const std::uint32_t i : {0u, 1u}) {
            const std::uint32_t a = row + i;
            triangles.push_back({a, a + 1, a + 3}), triangles.push_back({a + 1, a + 4, a + 3});
        }
    const SheetSides sides(roof, triangles);
    for (const float z : {-0.3f, 0.0f, 0.4f}) {
        EXPECT_EQ(sides.find({0.05f, 1.2f, z}).side, SideOfSheet::in_front) << z;
        EXPECT_EQ(sides.find({0.2f, 1.02f, z}).side, SideOfSheet::in_front) << z;
        EXPECT_EQ(sides.find({-0.3f, 0.5f, z}).side, SideOfSheet::behind) << z;
    }
    EXPECT_EQ(sides.find({-0.9f, 0, 1.2f}).side, SideOfSheet::unknown) << "the rim is closest";
    EXPECT_EQ(sides.find({-2, 0, 0}).side, SideOfSheet::unknown) << "a particle of the rim is closest";
}

}  // namespace
}  // namespace weft
