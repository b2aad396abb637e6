#include "look/weaves/heights.h"
#include "look/weaves/noise.h"

#include <algorithm>
#include <cmath>

namespace weft::weaves {
namespace {

struct Nearest {
    float first = 16, second = 16;  ///< squared distances to the two nearest points
};

/// One point in each of `cells` by `cells` squares (Worley 1996).
class Cells {
  public:
    Cells(std::uint32_t cells, std::uint32_t seed) : cells_(cells) {
        for (std::uint32_t j = 0; j < cells; ++j) {
            for (std::uint32_t i = 0; i < cells; ++i) {
                points_.push_back(0.1f + 0.8f * chance(seed, i, j));
                points_.push_back(0.1f + 0.8f * chance(seed + 1, i, j));
            }
        }
    }

    /// u, v >= 0, in units of squares.
    Nearest near(float u, float v) const {
        const auto i = static_cast<std::uint32_t>(u), j = static_cast<std::uint32_t>(v);
        const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
        Nearest found;
        for (std::uint32_t dj = 0; dj < 3; ++dj) {
            const std::uint32_t row = (j + dj + cells_ - 1) % cells_;
            for (std::uint32_t di = 0; di < 3; ++di) {
                const std::size_t at = 2 * (std::size_t{row} * cells_ + (i + di + cells_ - 1) % cells_);
                const float du = points_[at] + static_cast<float>(di) - 1 - fu;
                const float dv = points_[at + 1] + static_cast<float>(dj) - 1 - fv;
                const float distance = du * du + dv * dv;
                found.second = std::min(found.second, std::max(found.first, distance));
                found.first = std::min(found.first, distance);
            }
        }
        return found;
    }

  private:
    std::uint32_t cells_;
    std::vector<float> points_;  // u and v of each, from the corner of its square
};

/// 0 in a crease, 1 on the cushion beside it.
float cushion(const Nearest& near, float crease) {
    const float from_edge = std::sqrt(near.second) - std::sqrt(near.first);
    return eased(std::min(1.0f, from_edge / crease));
}

}  // namespace

Heights grain(std::uint32_t side) {
    constexpr std::uint32_t large = 8, small = 21;
    Heights out(side, large);
    const Cells grains(large, 41), pebbles(small, 43);
    const float step = out.step(), finer = static_cast<float>(small) / static_cast<float>(large);
    // Bends straight creases a little: offsets u by a function of v, and v by a function of u.
    std::vector<float> bent_u(side), bent_v(side);
    for (std::uint32_t s = 0; s < side; ++s) {
        const float at = (static_cast<float>(s) + 0.5f) * step;
        bent_u[s] = 0.12f * drift(45, 0, 2 * at, 2 * large) + large;  // + large keeps it above 0
        bent_v[s] = 0.12f * drift(45, 1, 2 * at, 2 * large) + large;
    }
    for (std::uint32_t y = 0; y < side; ++y) {
        const float v = (static_cast<float>(y) + 0.5f) * step;
        for (std::uint32_t x = 0; x < side; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) * step;
            const Nearest grain = grains.near(u + bent_u[y], v + bent_v[x]);
            const float base = cushion(grain, 0.5f);
            const float pebble = cushion(pebbles.near(u * finer, v * finer), 0.8f);
            out.height[std::size_t{y} * side + x] = 0.2f * base - 0.1f * grain.first + 0.025f * base * pebble;
        }
    }
    return out;
}

}  // namespace weft::weaves
