// Groups constraints that share no particle: those of one group may run in parallel, and the bits of the result do not
// depend on their order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct Coloring {
    /// Indices of constraints, color by color; within a color ascending.
    std::vector<std::uint32_t> order;
    /// Start of each color in `order`, and the end of the last color. The overflow, if any, is not included.
    std::vector<std::uint32_t> color_begin;
    /// Number of constraints without a color, which run one after another. They start at `color_begin.back()` in
    /// `order`.
    std::uint32_t overflow = 0;

    std::uint32_t color_count() const { return static_cast<std::uint32_t>(color_begin.size()) - 1; }
};

struct ColoringOptions {
    std::uint32_t max_colors = 64;  ///< at most 64: a particle keeps its used colors in one word
    /// A color with fewer constraints costs more (a barrier, half-empty lanes) than running them one by one.
    std::uint32_t min_rows = 8;
};

/// Assigns colors so that no particle gets the same color twice.
class ColorPool {
  public:
    static constexpr std::uint32_t size = 64;

    /// Colors from max_colors on are never assigned.
    ColorPool(std::uint32_t particle_count, std::uint32_t max_colors)
        : used_(particle_count, max_colors >= size ? 0 : ~std::uint64_t{0} << max_colors) {}

    /// Assigns to these particles the first color that `allowed` (one bit per color) contains and that none of them has
    /// yet. Returns `size` if there is none.
    std::uint32_t take(std::span<const std::uint32_t> particles, std::uint64_t allowed = ~std::uint64_t{0});

  private:
    std::vector<std::uint64_t> used_;
};

/// Greedy, in the order of the constraints, deterministic. `particles` holds `arity` indices per constraint, each <
/// particle_count. A constraint may name a particle twice.
Coloring color_rows(std::span<const std::uint32_t> particles, std::uint32_t arity, std::uint32_t particle_count,
                    const ColoringOptions& options = {});

}  // namespace weft
