#include "editor/view/view_quality.h"

#include <gtest/gtest.h>

namespace weft::editor {
namespace {

/// ms of an image on a machine that needs `per_image` for each image, `per_draft` and `per_best` more for all pixels.
struct Machine {
    double per_image = 1, per_draft = 10, per_best = 100;
    double ms(Quality quality) const {
        const double side = quality.percent / 100.0;
        return per_image + (quality.draft ? per_draft : per_best) * side * side;
    }
};

Quality settled(ViewQuality& quality, const Machine& machine, int images = 60) {
    for (int i = 0; i < images; ++i) quality.took(machine.ms(quality.moving()));
    return quality.moving();
}

TEST(ViewQuality, stays_the_best_on_a_fast_machine) {
    ViewQuality quality(50);
    EXPECT_EQ(settled(quality, {1, 5, 20}), (Quality{100, false}));
}

TEST(ViewQuality, is_a_draft_where_only_that_is_in_time) {
    ViewQuality quality(50);
    EXPECT_EQ(settled(quality, {1, 30, 400}), (Quality{100, true}));
}

TEST(ViewQuality, gets_smaller_until_it_is_in_time) {
    for (const auto& [per_draft, percent] :
         {std::pair{75.0, 70u}, {150.0, 50u}, {300.0, 35u}, {600.0, 25u}, {1e5, 25u}}) {
        ViewQuality quality(50);
        EXPECT_EQ(settled(quality, {1, per_draft, 1e4}), (Quality{percent, true})) << per_draft;
    }
}

TEST(ViewQuality, is_in_time_after_few_images) {
    ViewQuality quality(50);
    const Machine slow{1, 600, 1e4};
    int late = 0;
    while (slow.ms(quality.moving()) > 50 && late < 10) {
        ++late;
        quality.took(slow.ms(quality.moving()));
    }
    EXPECT_LE(late, 2) << "the best quality, and one draft";
}

TEST(ViewQuality, recovers_when_the_machine_gets_faster) {
    ViewQuality quality(50);
    settled(quality, {1, 600, 1e4});
    EXPECT_EQ(settled(quality, {1, 20, 1e4}), (Quality{100, true})) << "the best is known to be slow";
    quality.best_took(30);
    EXPECT_EQ(settled(quality, {1, 20, 29}), (Quality{100, false}));
}

TEST(ViewQuality, does_not_alternate) {
    for (double per_draft = 10; per_draft < 700; per_draft *= 1.07) {
        ViewQuality quality(50);
        const Machine machine{5, per_draft, 1e4};
        const Quality end = settled(quality, machine);
        for (int i = 0; i < 100; ++i) {
            quality.took(machine.ms(quality.moving()));
            ASSERT_EQ(quality.moving(), end) << per_draft;
        }
    }
}

TEST(ViewQuality, one_slow_image_costs_little) {
    ViewQuality quality(50);
    const Machine machine{1, 30, 1e4};
    settled(quality, machine);
    quality.took(60);
    EXPECT_NE(quality.moving(), (Quality{100, true}));
    EXPECT_EQ(settled(quality, machine, 20), (Quality{100, true}));
}

}  // namespace
}  // namespace weft::editor
