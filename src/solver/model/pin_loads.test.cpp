#include "solver/model/pin_loads.h"

#include "mesh/procedural.h"
#include "solver/model/cloth_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <span>

namespace weft {
namespace {

constexpr std::uint32_t side = 33;

// A square meter of a fabric, pinned where `pinned` says so.
struct Sheet {
    explicit Sheet(const std::function<bool(std::uint32_t x, std::uint32_t z)>& pinned, float density = 0.15f) {
        TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
        ClothModelDesc desc{.mesh = mesh, .layout = {.hierarchy = true}};
        desc.fabric.body.density = density;
        for (std::uint32_t p = 0; p < side * side; ++p)
            if (pinned(p % side, p / side)) desc.pins.particles.push_back(p);
        auto topology = build_topology(mesh, {.reorder = false});
        EXPECT_TRUE(topology.ok());
        auto built = build_cloth_model(std::move(desc), std::move(*topology));
        EXPECT_TRUE(built.ok());
        model = *built;
    }
    float steadiness(std::uint32_t x, std::uint32_t z) const { return model->steadiness[z * side + x]; }

    std::shared_ptr<const ClothModel> model;
};

bool is_corner(std::uint32_t x, std::uint32_t z) {
    return (x == 0 || x == side - 1) && (z == 0 || z == side - 1);
}

TEST(PinLoads, fall_with_the_distance_from_a_corner) {
    const Sheet sheet(is_corner);
    ASSERT_TRUE(sheet.model->has_pin_loads());
    EXPECT_EQ(sheet.steadiness(0, 0), 0) << "of a pin";
    EXPECT_EQ(sheet.steadiness(side / 2, side / 2), 0) << "far away";
    for (const std::uint32_t i : {1u, 2u, 4u}) {
        EXPECT_GT(sheet.steadiness(i, i), 2 * sheet.steadiness(2 * i, 2 * i));
        EXPECT_GT(sheet.steadiness(i, i), 0);
        EXPECT_EQ(sheet.model->pin_of[i * side + i], 0u);
        EXPECT_NEAR(sheet.steadiness(side - 1 - i, i) / sheet.steadiness(i, side - 1 - i), 1, 1e-3) << "symmetry";
    }
}

// The weight of a quarter of the sheet, over the length of a quarter circle.
TEST(PinLoads, are_the_tension_of_a_quarter_of_the_weight) {
    const double density = 0.15, edge = 1.0 / (side - 1);
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    const Sheet sheet(is_corner, static_cast<float>(density));
    const double mass = sheet.model->mass[8 * side + 4], r = (8 - 4 + 4 * std::numbers::sqrt2) * edge;
    const double far = 1 + r / (4 * edge), hanging = density * 9.81 * std::numbers::sqrt2;
    const double expected = density * 9.81 / 4 / (std::numbers::pi / 2 * r) - 0.2 * hanging;
    const double edges = sheet.steadiness(4, 8) * mass * far * far / 12;  // times the number of edges, 8 or 4
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(edges / (8 * expected), 0.75, 0.45);
}

TEST(PinLoads, do_not_depend_on_the_density) {
    const Sheet light(is_corner, 0.05f), heavy(is_corner, 0.5f);
    EXPECT_NEAR(light.steadiness(2, 2) / heavy.steadiness(2, 2), 1, 1e-4);
}

TEST(PinLoads, of_whole_sides_and_many_points_are_none) {
    EXPECT_FALSE(Sheet([](auto, auto z) { return z == 0; }).model->has_pin_loads());
    EXPECT_FALSE(Sheet([](auto x, auto z) { return (z == 0 || z == side - 1) && x % 2 == 0; }).model->has_pin_loads());
    EXPECT_FALSE(Sheet([](auto, auto) { return false; }).model->has_pin_loads());
    EXPECT_FALSE(Sheet([](auto, auto) { return true; }).model->has_pin_loads());
}

TEST(PinLoads, are_shared_by_pins_that_touch) {
    const Sheet one([](auto x, auto z) { return z == 0 && x == 16; }),
        three([](auto x, auto z) { return z == 0 && x >= 15 && x <= 17; });
    const auto largest_ease = [](const Sheet& sheet) {
        const ConstraintTable& limits = sheet.model->hierarchy[0].limits;
        return std::ranges::max(std::span(limits.fields).subspan(3 * limits.stride, limits.stride));
    };
    EXPECT_NEAR(largest_ease(one) / largest_ease(three), 3, 0.01);
    EXPECT_GT(three.steadiness(16, 1), 0);
}

// Constraints from a pin are longer, others are not.
TEST(PinLoads, lengthen_limits_from_pins_alone) {
    const Sheet sheet(is_corner);
    for (const CoarseLevel& level : sheet.model->hierarchy) {
        const ConstraintTable& limits = level.limits;
        for (std::uint32_t row = 0; row < limits.stride; ++row) {
            if (!limits.is_real(row)) continue;
            const std::uint32_t a = limits.particles[row], b = limits.particles[limits.stride + row];
            const bool from_pin = (level.weight[a] == 0) != (level.weight[b] == 0);
            const float give = limits.fields[2 * limits.stride + row], ease = limits.fields[3 * limits.stride + row];
            EXPECT_EQ(give > 0, from_pin);
            EXPECT_EQ(ease > 0, from_pin);
            EXPECT_LT(give, 0.1f);
        }
    }
}

}  // namespace
}  // namespace weft
