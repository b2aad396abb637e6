#include "collide/bvh.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace weft {
namespace {

std::vector<Bounds> random_boxes(std::size_t count, float largest, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1, 1), extent(0, largest);
    std::vector<Bounds> boxes(count);
    for (Bounds& box : boxes) {
        box.min = {place(random), place(random), place(random)};
        box.max = box.min + Vec3{extent(random), extent(random), extent(random)};
    }
    return boxes;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs all_pairs(const std::vector<Bounds>& boxes) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
            if (boxes[i].overlaps(boxes[j])) pairs.emplace_back(i, j);
        }
    }
    return pairs;
}

Pairs pairs_of(const Bvh& bvh) {
    Pairs pairs;
    bvh.for_each_pair([&](std::uint32_t i, std::uint32_t j) { pairs.emplace_back(i, j); });
    return pairs;
}

Pairs sorted(Pairs pairs) {
    std::ranges::sort(pairs);
    return pairs;
}

std::vector<std::uint32_t> overlaps_of(const Bvh& bvh, const Bounds& box) {
    std::vector<std::uint32_t> found;
    bvh.for_each_overlap(box, [&](std::uint32_t i) { found.push_back(i); });
    std::ranges::sort(found);
    return found;
}

TEST(Bvh, FindsEveryPairOnce) {
    for (std::size_t count : {0u, 1u, 2u, 4u, 5u, 9u, 33u, 600u}) {
        const std::vector<Bounds> boxes = random_boxes(count, 0.3f, 11 + static_cast<unsigned>(count));
        EXPECT_EQ(sorted(pairs_of(Bvh(boxes))), all_pairs(boxes)) << count << " boxes";
    }
    EXPECT_GT(all_pairs(random_boxes(600, 0.3f, 611)).size(), 100u) << "the reference must have something to find";
}

TEST(Bvh, FindsEveryBoxThatOverlapsAGivenOne) {
    const std::vector<Bounds> boxes = random_boxes(500, 0.2f, 3);
    const Bvh bvh(boxes);
    for (const Bounds& query : random_boxes(100, 0.5f, 4)) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            if (boxes[i].overlaps(query)) expected.push_back(i);
        }
        EXPECT_EQ(overlaps_of(bvh, query), expected);
    }
}

TEST(Bvh, BoundsHoldAllBoxes) {
    const std::vector<Bounds> boxes = random_boxes(100, 0.2f, 5);
    const Bvh bvh(boxes);
    EXPECT_EQ(bvh.size(), 100u);
    for (const Bounds& box : boxes) {
        EXPECT_TRUE(bvh.bounds().contains(box.min));
        EXPECT_TRUE(bvh.bounds().contains(box.max));
    }
    EXPECT_TRUE(Bvh().bounds().empty());
}

TEST(Bvh, TouchingBoxesOverlap) {
    const std::vector<Bounds> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{2.5f, 0, 0}, {3, 1, 1}}};
    EXPECT_EQ(pairs_of(Bvh(boxes)), (Pairs{{0, 1}}));
}

TEST(Bvh, EmptyBoxesOverlapNothing) {
    std::vector<Bounds> boxes = random_boxes(200, 0.4f, 6);
    for (std::size_t i = 0; i < boxes.size(); i += 3) boxes[i] = Bounds{};
    const Bvh bvh(boxes);
    EXPECT_EQ(sorted(pairs_of(bvh)), all_pairs(boxes));
    for (std::uint32_t found : overlaps_of(bvh, {{-9, -9, -9}, {9, 9, 9}})) EXPECT_NE(found % 3, 0u);
    EXPECT_TRUE(overlaps_of(bvh, Bounds{}).empty());
    EXPECT_LT(length(bvh.bounds().size()), 5);
    EXPECT_TRUE(pairs_of(Bvh(std::vector<Bounds>(50))).empty());
}

TEST(Bvh, RefitFollowsBoxesThatMoved) {
    Bvh bvh(random_boxes(300, 0.3f, 7));
    const std::vector<Bounds> elsewhere = random_boxes(300, 0.3f, 8);
    bvh.refit(elsewhere);
    EXPECT_EQ(sorted(pairs_of(bvh)), all_pairs(elsewhere));
}

TEST(Bvh, SurvivesBoxesThatNothingSeparates) {
    const std::vector<Bounds> boxes(1000, Bounds{{0, 0, 0}, {1, 1, 1}});
    EXPECT_EQ(pairs_of(Bvh(boxes)).size(), 1000u * 999u / 2u);
}

TEST(Bvh, OrderOfVisitsIsTheSameEveryTime) {
    const std::vector<Bounds> boxes = random_boxes(400, 0.3f, 9);
    EXPECT_EQ(pairs_of(Bvh(boxes)), pairs_of(Bvh(boxes)));
}

}  // namespace
}  // namespace weft
