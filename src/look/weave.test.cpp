#include "look/weave.h"

#include "look/weaves/heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace weft {
namespace {

constexpr Weave all_weaves[] = {Weave::smooth, Weave::plain, Weave::twill, Weave::satin,
                                Weave::knit,   Weave::rib,   Weave::grain};

class EveryWeave : public testing::TestWithParam<Weave> {};
INSTANTIATE_TEST_SUITE_P(Weaves, EveryWeave, testing::ValuesIn(all_weaves));

/// Mean over all texels.
double mean(const std::vector<float>& values, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < values.size(); i += 4) sum += values[i];
    return sum / (static_cast<double>(values.size()) / 4);
}

Image8 one_color(std::uint32_t width, std::uint32_t height, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Image8 image{width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4, 255)};
    for (std::size_t t = 0; t < image.rgba.size(); t += 4) {
        image.rgba[t] = r, image.rgba[t + 1] = g, image.rgba[t + 2] = b;
    }
    return image;
}

TEST_P(EveryWeave, HasLevelsDownToOneTexel) {
    for (const std::uint32_t side : {1u, 2u, 64u}) {
        const Relief relief = make_weave(GetParam(), side);
        std::uint32_t expected = GetParam() == Weave::smooth ? 1 : side;
        for (const ReliefLevel& level : relief.levels) {
            EXPECT_EQ(level.side, expected);
            EXPECT_EQ(level.first.size(), std::size_t{level.side} * level.side * 4);
            EXPECT_EQ(level.second.size(), level.first.size());
            expected /= 2;
        }
        EXPECT_EQ(relief.levels.back().side, 1u);
    }
}

TEST_P(EveryWeave, IsLevelAsAWhole) {
    const Relief relief = make_weave(GetParam());
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(relief.levels.back().first[c], 0, 1e-4);
}

TEST_P(EveryWeave, KeepsItsMomentsFromLevelToLevel) {
    const Relief relief = make_weave(GetParam(), 128);
    const ReliefLevel &largest = relief.levels.front(), &last = relief.levels.back();
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_NEAR(last.first[c], mean(largest.first, c), 1e-5);
        EXPECT_NEAR(last.second[c], mean(largest.second, c), 1e-5);
    }
    for (const ReliefLevel& level : relief.levels) {
        for (std::size_t t = 0; t < level.first.size(); t += 4) {
            ASSERT_GE(level.second[t] * 1.0001f + 1e-6f, level.first[t] * level.first[t]);
            ASSERT_GE(level.second[t + 1] * 1.0001f + 1e-6f, level.first[t + 1] * level.first[t + 1]);
        }
    }
}

TEST_P(EveryWeave, HoldsSharesBetweenNoneAndAll) {
    const Relief relief = make_weave(GetParam(), 128);
    for (const ReliefLevel& level : relief.levels) {
        for (std::size_t t = 0; t < level.first.size(); t += 4) {
            for (std::size_t c : {2, 3}) {
                ASSERT_GE(level.first[t + c], 0);
                ASSERT_LE(level.first[t + c], 1);
            }
        }
    }
    // Gaps are darker, but the mean is not dark.
    EXPECT_GT(relief.levels.back().first[2], 0.85f);
    EXPECT_EQ(relief.levels.back().first[2] < 1, GetParam() != Weave::smooth);
}

TEST_P(EveryWeave, IsAsSteepAsClothIs) {
    if (GetParam() == Weave::smooth) return;
    const Relief relief = make_weave(GetParam());
    const std::vector<float>& second = relief.levels.back().second;
    const double rms = std::sqrt(second[0] + second[1]);
    EXPECT_GT(rms, 0.3);
    EXPECT_LT(rms, 1.2);
}

TEST_P(EveryWeave, IsTheSameEachTime) {
    const Relief a = make_weave(GetParam(), 32), b = make_weave(GetParam(), 32);
    EXPECT_EQ(a.levels[0].first, b.levels[0].first);
    EXPECT_EQ(a.levels[0].second, b.levels[0].second);
}

// A tile with a seam would have larger steps there than inside.
TEST(Weaves, RepeatWithoutASeam) {
    using Make = weaves::Heights (*)(std::uint32_t);
    for (const Make make : {weaves::plain, weaves::twill, weaves::satin, weaves::knit, weaves::rib, weaves::grain}) {
        const weaves::Heights heights = make(256);
        const auto jump = [&](std::uint32_t from, std::uint32_t to, bool along_u) {
            double sum = 0;
            for (std::uint32_t k = 0; k < 256; ++k) {
                const float a = heights.height[along_u ? k * 256 + from : from * 256 + k];
                const float b = heights.height[along_u ? k * 256 + to : to * 256 + k];
                sum += std::abs(a - b);
            }
            return sum;
        };
        for (const bool along_u : {true, false}) {
            double inside = 0;
            for (std::uint32_t k = 0; k < 255; ++k) inside = std::max(inside, jump(k, k + 1, along_u));
            EXPECT_LE(jump(255, 0, along_u), 1.2 * inside);
            EXPECT_GT(jump(0, 128, true) + jump(0, 128, false), 0);
        }
    }
}

// Threads must differ within a tile too, not only between tiles.
TEST(Weaves, AreALittleUneven) {
    const weaves::Heights heights = weaves::plain(256);
    double apart = 0;
    for (std::uint32_t y = 0; y < 256; ++y) {
        for (std::uint32_t x = 0; x < 256; ++x) {
            apart +=
                std::abs(heights.height[y * 256 + x] - heights.height[y * 256 + (x + 64) % 256]);  // two threads apart
        }
    }
    EXPECT_GT(apart / (256 * 256), 0.005);
    EXPECT_LT(apart / (256 * 256), 0.05);
}

TEST(Weaves, ShowAsMuchWarpAsTheyCross) {
    const auto share = [](Weave weave) { return make_weave(weave).levels.back().first[3]; };
    EXPECT_NEAR(share(Weave::plain), 0.5, 0.02);
    EXPECT_NEAR(share(Weave::twill), 0.75, 0.03);
    EXPECT_NEAR(share(Weave::satin), 7.0 / 8, 0.03);
    for (const Weave weave : {Weave::smooth, Weave::knit, Weave::rib, Weave::grain}) EXPECT_EQ(share(weave), 1);
}

TEST(Weaves, SatinGlidesAlongTheWarp) {
    const Relief satin = make_weave(Weave::satin);
    EXPECT_LT(satin.levels.back().second[0] * 2, satin.levels.back().second[1]);
}

TEST(Weaves, SmoothIsOneFlatTexel) {
    const Relief relief = make_weave(Weave::smooth, 256);
    ASSERT_EQ(relief.levels.size(), 1u);
    EXPECT_EQ(relief.levels[0].first, (std::vector<float>{0, 0, 1, 1}));
    EXPECT_EQ(relief.levels[0].second, (std::vector<float>{0, 0, 0, 0}));
}

TEST(NormalMap, GivesTheSlopesBack) {
    for (const float scale : {1.0f, 0.5f}) {
        const Relief relief = make_weave(Weave::twill, 64);
        const Relief back = relief_of_normals(normal_map_of(relief, scale));
        ASSERT_EQ(back.levels.size(), relief.levels.size());
        const std::vector<float>&expected = relief.levels[0].first, &got = back.levels[0].first;
        for (std::size_t t = 0; t < got.size(); t += 4) {
            // A byte is 1/127 of the unit normal; its effect on a slope grows with the square of the slope.
            const float u = scale * expected[t], v = scale * expected[t + 1], step = (1 + u * u + v * v) / 127;
            ASSERT_NEAR(got[t], u, step);
            ASSERT_NEAR(got[t + 1], v, step);
            ASSERT_NEAR(back.levels[0].second[t], got[t] * got[t], 1e-6 + 1e-5 * got[t] * got[t]);
        }
    }
}

TEST(NormalMap, HasUToTheRightAndVUpward) {
    // Two rows: the upper one faces +x, the lower one +y.
    Image8 image = one_color(2, 2, 218, 128, 218);
    for (std::uint32_t x = 0; x < 2; ++x) image.at(x, 1)[0] = 128, image.at(x, 1)[1] = 218;
    const ReliefLevel level = relief_of_normals(image).levels.front();
    ASSERT_EQ(level.side, 2u);
    EXPECT_EQ(level.first[0], 0);
    EXPECT_NEAR(level.first[1], -1, 1e-6);
    EXPECT_NEAR(level.first[2 * 4], -1, 1e-6);
    EXPECT_EQ(level.first[2 * 4 + 1], 0);

    Relief slope;
    slope.levels.push_back({2, {1, 0, 1, 1, 1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1}, std::vector<float>(16)});
    const Image8 map = normal_map_of(slope, 1);
    EXPECT_EQ(map.at(0, 1)[0], 38);  // 128 - 127 / √2: v = 0 is at the bottom, and a rising surface faces back
    EXPECT_EQ(map.at(0, 0)[0], 128);
    EXPECT_EQ(map.at(0, 0)[2], 255);
}

TEST(NormalMap, OfAnySizeKeepsItsMoments) {
    for (const auto& [width, height] : {std::pair{3u, 3u}, {5u, 2u}, {1u, 7u}, {1u, 1u}, {100u, 37u}}) {
        Image8 image = one_color(width, height, 128, 128, 255);
        double sum = 0, squares = 0;
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                image.at(x, y)[0] = static_cast<std::uint8_t>(100 + (7 * x + 13 * y) % 60);
                const double slope = (128.0 - image.at(x, y)[0]) / 127;
                sum += slope, squares += slope * slope;
            }
        }
        const Relief relief = relief_of_normals(image);
        const std::uint32_t side = relief.levels.front().side;
        EXPECT_EQ(side & (side - 1), 0u);
        EXPECT_GE(side, std::max(width, height));
        const ReliefLevel& last = relief.levels.back();
        EXPECT_NEAR(last.first[0], sum / (width * height), 1e-5);
        EXPECT_NEAR(last.second[0], squares / (width * height), 1e-5);
        EXPECT_EQ(last.first[2], 1);
        EXPECT_EQ(last.first[3], 1);
    }
}

TEST(NormalMap, ThatIsEmptyIsFlat) {
    const Relief relief = relief_of_normals({});
    ASSERT_EQ(relief.levels.size(), 1u);
    EXPECT_EQ(relief.levels[0].first, (std::vector<float>{0, 0, 1, 1}));
}

TEST(NormalMap, ThatPointsDownwardIsSteepAndFinite) {
    const ReliefLevel level = relief_of_normals(one_color(1, 1, 255, 0, 0)).levels.front();
    EXPECT_FLOAT_EQ(level.first[0], -16);
    EXPECT_NEAR(level.first[1], 16, 0.2);
}

TEST(NormalMap, LargerThanAnyoneSeesIsMadeSmaller) {
    const Relief relief = relief_of_normals(one_color(5000, 3, 128, 128, 255));
    EXPECT_EQ(relief.levels.front().side, 2048u);
    EXPECT_EQ(relief.levels.back().first[0], 0);
}

}  // namespace
}  // namespace weft
