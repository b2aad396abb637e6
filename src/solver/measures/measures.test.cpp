#include "solver/measures/measures.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace weft {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

// Two by two particles, 1 m apart, with one diagonal; the first is pinned.
std::shared_ptr<const ClothModel> square() {
    ClothModelDesc desc{.name = "square", .mesh = make_grid({1, 1}, {2, 2}, GridDiagonal::uniform)};
    auto topology = build_topology(desc.mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    desc.pins.particles = {0};
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

TEST(Tally, is_a_mean_and_a_maximum) {
    Tally tally;
    EXPECT_EQ(tally.result().mean, 0);
    EXPECT_EQ(tally.result().max, 0);
    for (const double value : {0.5, 2.0, 0.5}) tally.add(value);
    EXPECT_DOUBLE_EQ(tally.result().mean, 1);
    EXPECT_DOUBLE_EQ(tally.result().max, 2);
    Tally other;
    other.add(9, 3, 5);
    tally.add(other);
    EXPECT_DOUBLE_EQ(tally.result().mean, 2);
    EXPECT_DOUBLE_EQ(tally.result().max, 5);
}

TEST(Tally, keeps_what_is_no_number) {
    EXPECT_TRUE(std::isnan(larger(nan, 1)) && std::isnan(larger(1, nan)) && std::isnan(larger(nan, infinity)));
    EXPECT_EQ(larger(1, infinity), infinity);
    Tally tally;
    for (const double value : {1.0, nan, infinity, 2.0}) tally.add(value);
    EXPECT_TRUE(std::isnan(tally.result().max));
    EXPECT_TRUE(std::isnan(tally.result().mean));
}

TEST(Measures, are_those_of_a_cloth_on_the_host) {
    const auto model = square();
    std::vector<Vec4> positions(model->start.begin(), model->start.begin() + 4), velocities(4);
    const auto measured = [&] {
        MeasureSums sums;
        sums.add(*model, positions, velocities);
        return sums.result();
    };
    EXPECT_EQ(measured().strain.stretch.max, 0);
    EXPECT_EQ(measured().kinetic_energy, 0);
    EXPECT_TRUE(measured().finite);

    for (Vec4& p : positions) p.x *= 1.5f, p.z *= 1.5f;
    velocities[0] = {0, 3, 4, 0};  // pinned: counts for speed, but not for energy
    velocities[3] = {2, 0, 0, 0};
    const ClothMeasures stretched = measured();
    EXPECT_DOUBLE_EQ(stretched.strain.stretch.mean, 0.5);
    EXPECT_DOUBLE_EQ(stretched.strain.shear.max, 0.5);
    std::vector<double> edges;
    collect_stretch(*model, positions, edges);
    EXPECT_EQ(edges, std::vector<double>(4, 0.5)) << "the sides, without the diagonal";
    EXPECT_NEAR(stretched.kinetic_energy, 2 * model->mass[3], 1e-9);
    EXPECT_DOUBLE_EQ(stretched.max_speed, 5);

    for (const float bad : {static_cast<float>(nan), static_cast<float>(infinity)}) {
        velocities[2].y = bad;
        EXPECT_FALSE(measured().finite);
        EXPECT_FALSE(std::isfinite(measured().max_speed));
        EXPECT_FALSE(std::isfinite(measured().kinetic_energy));
        EXPECT_DOUBLE_EQ(measured().strain.stretch.mean, 0.5);
        velocities[2] = {};
    }
    positions[1].z = static_cast<float>(nan);
    EXPECT_FALSE(measured().finite);
    EXPECT_TRUE(std::isnan(measured().strain.stretch.max));
    EXPECT_DOUBLE_EQ(measured().max_speed, 5);
}

TEST(Measures, of_several_cloths_weigh_each_by_what_it_has) {
    const auto model = square();
    std::vector<Vec4> positions(model->start.begin(), model->start.begin() + 4), velocities(4);
    MeasureSums one, all;
    one.add(*model, positions, velocities);
    one.add_residual(*model, {.mean = 0.1, .max = 0.2});
    all.add(one);
    for (Vec4& p : positions) p.x *= 3, p.z *= 3;
    all.add(*model, positions, velocities);
    all.add_residual(*model, {.mean = 0.3, .max = 0.9});
    EXPECT_DOUBLE_EQ(all.result().strain.stretch.mean, 1);
    EXPECT_DOUBLE_EQ(all.result().strain.stretch.max, 2);
    EXPECT_DOUBLE_EQ(all.result().residual.mean, 0.2);
    EXPECT_DOUBLE_EQ(all.result().residual.max, 0.9);
    EXPECT_EQ(MeasureSums().result().residual.mean, 0);
}

}  // namespace
}  // namespace weft
