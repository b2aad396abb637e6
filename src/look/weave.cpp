#include "look/weave.h"

#include "look/weaves/heights.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

using weaves::Heights;

// Slopes and light are computed on a grid that is finer than the tile by this factor.
constexpr std::uint32_t finer = 2;

// A larger map would take hundreds of megabytes as a relief without visible gain: its texels are smaller than pixels.
constexpr std::uint32_t most_texels = 2048;

// cos 86°: flatter normals in a file are treated as errors and clamped.
constexpr float flattest_normal = 1.0f / 16;

// Darkening per thread spacing of depth below the mean of the surroundings.
constexpr float dark_per_depth = 1.6f;

ReliefLevel empty_level(std::uint32_t side) {
    const std::size_t size = std::size_t{side} * side * 4;
    return {side, std::vector<float>(size), std::vector<float>(size)};
}

Relief flat_relief() {
    Relief relief;
    relief.levels.push_back({1, {0, 0, 1, 1}, {0, 0, 0, 0}});
    return relief;
}

/// Averages blocks of two by two texels.
ReliefLevel half_of(const ReliefLevel& large) {
    ReliefLevel small = empty_level(large.side / 2);
    const auto halve = [&](const std::vector<float>& from, std::vector<float>& to) {
        const std::size_t row = std::size_t{large.side} * 4;
        for (std::uint32_t y = 0; y < small.side; ++y) {
            const float* a = &from[2 * y * row];
            float* out = &to[std::size_t{y} * small.side * 4];
            for (std::uint32_t x = 0; x < small.side; ++x, a += 8, out += 4) {
                for (int c = 0; c < 4; ++c) out[c] = 0.25f * ((a[c] + a[c + 4]) + (a[row + c] + a[row + c + 4]));
            }
        }
    };
    halve(large.first, small.first);
    halve(large.second, small.second);
    return small;
}

void add_smaller_levels(Relief& relief) {
    while (relief.levels.back().side > 1) relief.levels.push_back(half_of(relief.levels.back()));
}

/// For each of `count` samples, `stride` apart, the mean of the 2 radius + 1 samples around it. The line repeats.
void blur_line(const float* from, float* to, std::uint32_t count, std::size_t stride, std::uint32_t radius) {
    double sum = 0;
    for (std::uint32_t k = 0; k <= 2 * radius; ++k) sum += from[((k + count - radius % count) % count) * stride];
    const double share = 1.0 / (2 * radius + 1);
    for (std::uint32_t i = 0; i < count; ++i) {
        to[i * stride] = static_cast<float>(sum * share);
        sum += from[((i + radius + 1) % count) * stride];
        sum -= from[((i + count - radius % count) % count) * stride];
    }
}

/// The light that reaches each sample: less where the sample lies below the mean of its surroundings.
std::vector<float> light_in(const Heights& heights) {
    const std::uint32_t side = heights.side, radius = side / heights.spacings / 2;
    std::vector<float> rows(heights.height.size()), around(heights.height.size());
    for (std::uint32_t y = 0; y < side; ++y) {
        const std::size_t at = std::size_t{y} * side;
        blur_line(&heights.height[at], &rows[at], side, 1, radius);
    }
    for (std::uint32_t x = 0; x < side; ++x) blur_line(&rows[x], &around[x], side, side, radius);
    for (std::size_t i = 0; i < around.size(); ++i) {
        around[i] = std::clamp(1 - dark_per_depth * (around[i] - heights.height[i]), 0.0f, 1.0f);
    }
    return around;
}

ReliefLevel largest_level(const Heights& heights) {
    ReliefLevel level = empty_level(heights.side / finer);
    const std::vector<float> light = light_in(heights);
    const std::uint32_t side = heights.side, last = side - 1;
    const float per_step = 0.5f / heights.step(), share = 1.0f / (finer * finer);
    for (std::uint32_t y = 0; y < side; ++y) {
        const float* row = &heights.height[std::size_t{y} * side];
        const float* above = &heights.height[std::size_t{(y + 1) & last} * side];
        const float* below = &heights.height[std::size_t{(y + last) & last} * side];
        for (std::uint32_t x = 0; x < side; ++x) {
            const float su = per_step * (row[(x + 1) & last] - row[(x + last) & last]);
            const float sv = per_step * (above[x] - below[x]);
            const std::size_t fine = std::size_t{y} * side + x;
            const std::size_t at = (std::size_t{y / finer} * level.side + x / finer) * 4;
            const float first[] = {su, sv, light[fine], heights.warp[fine]}, second[] = {su * su, sv * sv, su * sv};
            for (int c = 0; c < 4; ++c) level.first[at + c] += share * first[c];
            for (int c = 0; c < 3; ++c) level.second[at + c] += share * second[c];
        }
    }
    return level;
}

Heights heights_of(Weave weave, std::uint32_t side) {
    switch (weave) {
        case Weave::smooth:
            break;
        case Weave::plain:
            return weaves::plain(side);
        case Weave::twill:
            return weaves::twill(side);
        case Weave::satin:
            return weaves::satin(side);
        case Weave::knit:
            return weaves::knit(side);
        case Weave::rib:
            return weaves::rib(side);
        case Weave::grain:
            return weaves::grain(side);
    }
    return {side, 1};
}

// 128 maps to 0 and 255 to 1, so that a flat map gives exactly zero slopes.
float component(std::uint8_t byte) {
    return (static_cast<float>(byte) - 128) / 127;
}

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(128 + 127 * std::clamp(value, -1.0f, 1.0f)));
}

/// Values per texel in a line of moments: both slopes, their squares, their product.
constexpr std::size_t moments = 5;

void add_texel(const std::uint8_t* rgb, float share, float* to) {
    const float z = std::max(component(rgb[2]), flattest_normal);
    const float su = -component(rgb[0]) / z, sv = -component(rgb[1]) / z;
    const float values[moments] = {su, sv, su * su, sv * sv, su * sv};
    for (std::size_t c = 0; c < moments; ++c) to[c] += share * values[c];
}

/// Divides one length into `targets` and into `sources` cells, and calls `with(target, source, share)` for each pair of
/// cells that overlap. The shares of a target add up to 1.
template <class With>
void for_overlaps(std::uint32_t targets, std::uint32_t sources, const With& with) {
    const std::uint64_t t = targets, s = sources;
    for (std::uint64_t i = 0; i < t; ++i) {
        for (std::uint64_t k = i * s / t; k * t < (i + 1) * s; ++k) {
            const std::uint64_t from = std::max(i * s, k * t), to = std::min((i + 1) * s, (k + 1) * t);
            with(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k),
                 static_cast<float>(static_cast<double>(to - from) / static_cast<double>(s)));
        }
    }
}

}  // namespace

Relief make_weave(Weave weave, std::uint32_t side) {
    assert(std::has_single_bit(side));
    if (weave == Weave::smooth) return flat_relief();
    const Heights heights = heights_of(weave, finer * side);
    Relief relief;
    relief.threads[0] = relief.threads[1] = static_cast<float>(heights.spacings);
    relief.levels.push_back(largest_level(heights));
    add_smaller_levels(relief);
    return relief;
}

Relief relief_of_normals(const Image8& normals) {
    if (normals.width == 0 || normals.height == 0) return flat_relief();
    const std::uint32_t side = std::bit_ceil(std::min(most_texels, std::max(normals.width, normals.height)));
    ReliefLevel level = empty_level(side);
    std::vector<float> row(side * moments);
    std::uint32_t row_of = normals.height;  // the row of the image that `row` holds
    for_overlaps(side, normals.height, [&](std::uint32_t y, std::uint32_t source, float share) {
        const std::uint32_t picture_row = normals.height - 1 - source;  // v grows upward
        if (picture_row != row_of) {
            std::ranges::fill(row, 0.0f);
            for_overlaps(side, normals.width, [&](std::uint32_t x, std::uint32_t column, float part) {
                add_texel(normals.at(column, picture_row), part, &row[x * moments]);
            });
            row_of = picture_row;
        }
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::size_t at = (std::size_t{y} * side + x) * 4;
            const float* from = &row[x * moments];
            for (int c = 0; c < 2; ++c) level.first[at + c] += share * from[c];
            for (int c = 0; c < 3; ++c) level.second[at + c] += share * from[2 + c];
            level.first[at + 2] = level.first[at + 3] = 1;
        }
    });
    Relief relief;
    relief.levels.push_back(std::move(level));
    add_smaller_levels(relief);
    return relief;
}

Image8 normal_map_of(const Relief& relief, float scale) {
    const ReliefLevel& level = relief.levels.front();
    Image8 image{level.side, level.side, std::vector<std::uint8_t>(std::size_t{level.side} * level.side * 4)};
    for (std::uint32_t y = 0; y < level.side; ++y) {
        for (std::uint32_t x = 0; x < level.side; ++x) {
            const float* first = &level.first[(std::size_t{y} * level.side + x) * 4];
            const float u = -scale * first[0], v = -scale * first[1], part = 1 / std::sqrt(1 + u * u + v * v);
            std::uint8_t* to = image.at(x, level.side - 1 - y);
            to[0] = byte_of(u * part), to[1] = byte_of(v * part), to[2] = byte_of(part), to[3] = 255;
        }
    }
    return image;
}

}  // namespace weft
