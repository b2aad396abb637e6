#include "mesh/coloring.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>

namespace weft {
namespace {

constexpr std::uint32_t word_colors = ColorPool::size;
constexpr std::uint8_t overflow_color = word_colors;

using ColorCounts = std::array<std::uint32_t, word_colors + 1>;  // the overflow last

/// The first color that no particle of a constraint has yet, constraint by constraint.
std::vector<std::uint8_t> first_fit(std::span<const std::uint32_t> particles, std::size_t arity,
                                    std::uint32_t particle_count, std::uint32_t max_colors) {
    ColorPool pool(particle_count, max_colors);
    std::vector<std::uint8_t> color(particles.size() / arity);
    for (std::size_t i = 0; i < color.size(); ++i) {
        color[i] = static_cast<std::uint8_t>(pool.take(particles.subspan(i * arity, arity)));
    }
    return color;
}

}  // namespace

std::uint32_t ColorPool::take(std::span<const std::uint32_t> particles, std::uint64_t allowed) {
    std::uint64_t taken = ~allowed;
    for (const std::uint32_t particle : particles) {
        assert(particle < used_.size());
        taken |= used_[particle];
    }
    if (taken == ~std::uint64_t{0}) return size;
    const auto color = static_cast<std::uint32_t>(std::countr_one(taken));
    for (const std::uint32_t particle : particles) used_[particle] |= std::uint64_t{1} << color;
    return color;
}

Coloring color_rows(std::span<const std::uint32_t> particles, std::uint32_t arity, std::uint32_t particle_count,
                    const ColoringOptions& options) {
    assert(arity > 0 && particles.size() % arity == 0);
    assert(options.max_colors <= word_colors);
    const std::vector<std::uint8_t> color = first_fit(particles, arity, particle_count, options.max_colors);

    ColorCounts count{};
    for (const std::uint8_t c : color) ++count[c];

    // Where the constraints of each color go. Small colors go to the overflow, which keeps the order of the
    // constraints.
    Coloring coloring{.order = std::vector<std::uint32_t>(color.size()), .color_begin = {0}};
    std::array<std::uint8_t, word_colors + 1> place_of_color;
    std::array<std::uint32_t, word_colors + 1> place{};
    place_of_color.fill(overflow_color);
    for (std::uint8_t c = 0; c < word_colors; ++c) {
        if (count[c] == 0 || count[c] < options.min_rows) continue;
        place_of_color[c] = c;
        place[c] = coloring.color_begin.back();
        coloring.color_begin.push_back(place[c] + count[c]);
    }
    place[overflow_color] = coloring.color_begin.back();
    coloring.overflow = static_cast<std::uint32_t>(color.size()) - coloring.color_begin.back();
    for (std::uint32_t i = 0; i < color.size(); ++i) coloring.order[place[place_of_color[color[i]]]++] = i;
    return coloring;
}

}  // namespace weft
