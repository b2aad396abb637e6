// Groups rows that share no particle, so that all rows of a group may run at once and in any order with the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct Coloring {
    /// Row indices, color by color; within a color ascending.
    std::vector<std::uint32_t> order;
    /// Start of each color in `order`; one more entry at the end. The overflow, if any, is not among them.
    std::vector<std::uint32_t> color_begin;
    /// Rows at the end of `order`, from `color_begin.back()` on, that found no color: they run one after another.
    std::uint32_t overflow = 0;

    std::uint32_t color_count() const { return static_cast<std::uint32_t>(color_begin.size()) - 1; }
};

struct ColoringOptions {
    std::uint32_t max_colors = 64;  ///< at most 64: a particle keeps its used colors in one word
    /// A color smaller than this costs more (a barrier, half-empty lanes) than running its rows one by one.
    std::uint32_t min_rows = 8;
};

/// Hands out colors, of which a particle may have each only once.
class ColorPool {
  public:
    static constexpr std::uint32_t size = 64;

    /// Colors from max_colors on are never given.
    ColorPool(std::uint32_t particle_count, std::uint32_t max_colors)
        : used_(particle_count, max_colors >= size ? 0 : ~std::uint64_t{0} << max_colors) {}

    /// The first color of those allowed, a bit each, that none of these particles has yet; they have it from now on.
    /// `size` if there is none.
    std::uint32_t take(std::span<const std::uint32_t> particles, std::uint64_t allowed = ~std::uint64_t{0});

  private:
    std::vector<std::uint64_t> used_;
};

/// Greedy, in row order, deterministic. `particles` holds `arity` indices per row, each < particle_count. A row
/// may name a particle twice: it does not get in its own way.
Coloring color_rows(std::span<const std::uint32_t> particles, std::uint32_t arity, std::uint32_t particle_count,
                    const ColoringOptions& options = {});

}  // namespace weft
