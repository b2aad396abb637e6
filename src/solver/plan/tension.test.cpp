#include "solver/plan/tension.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

// Tension of 1 cm constraints under `tension` N/m. If `spared` > 0, only every `spared`-th one is under tension.
float tension_under(double tension, std::uint32_t spared = 0, const Fabric& fabric = {}) {
    RowList rows = make_rows(ConstraintKind::stretch);
    for (std::uint32_t i = 0; i < 4000; ++i) rows.add({2 * i, 2 * i + 1}, {0.01f, 1e-4f, 1e-4f, WEFT_NEVER_STRAIGHT});
    const ConstraintTable table = pack_rows(ConstraintKind::stretch, rows, 8000);
    constexpr double h = 1.0 / 600;
    std::vector<float> lambda(table.stride);
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row) || (spared && table.particles[row] / 2 % spared != 0)) continue;
        lambda[row] = static_cast<float>(-tension * 0.01 * h * h);
    }
    return tension_in(table, lambda, h, fabric.stretch);
}

TEST(Tension, is_what_pulls_at_the_rows) {
    const Fabric fabric;
    const double softest = std::min(fabric.stretch.stretch[0], fabric.stretch.stretch[1]);
    for (const double strain : {0.002, 0.01, 0.05, 0.5}) {
        const double tension = tension_under(strain * softest, 0, fabric);
        EXPECT_GE(tension, 0.999 * strain * softest);
        EXPECT_LE(tension, 1.2 * strain * (1 + 1.2 * strain) * softest) << "a quarter of an octave, and room";
    }
}

TEST(Tension, is_nothing_for_slack_and_for_rigid_cloth) {
    EXPECT_EQ(tension_under(0), 0);
    EXPECT_EQ(tension_under(-100), 0) << "compression";
    Fabric rigid;
    rigid.stretch.inextensible = true;
    EXPECT_EQ(tension_under(100, 0, rigid), 0);
    EXPECT_EQ(tension_in({}, {}, 0.01, {}), 0);
}

TEST(Tension, leaves_out_what_is_pulled_in_few_places) {
    EXPECT_EQ(tension_under(400, 40), 0) << "one row in forty";
    EXPECT_GT(tension_under(400, 4), 0);
}

}  // namespace
}  // namespace weft
