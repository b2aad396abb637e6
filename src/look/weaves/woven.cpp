#include "look/weaves/heights.h"
#include "look/weaves/noise.h"

#include <algorithm>

namespace weft::weaves {
namespace {

constexpr std::uint32_t threads = 8;

/// Lengths are in thread spacings.
struct Yarn {
    float half_width = 0.48f;
    float crown = 0.22f;   ///< height of the middle of a thread above its edges
    float crimp = 0.2f;    ///< amplitude of a thread around the middle plane
    float wander = 0.03f;  ///< amplitude sideways
    float uneven = 0.06f;  ///< relative variation of the width
    float twist = 0.006f;  ///< height of the strands wound around it
};

/// Position and width of a thread at one sample along it.
struct Place {
    float aside, height, per_width;
};

/// All threads of one direction. `over(thread, crossing)`: whether the thread is on top at that crossing.
class Threads {
  public:
    template <class Over>
    Threads(std::uint32_t side, const Yarn& yarn, std::uint32_t seed, const Over& over)
        : side_(side), yarn_(yarn), places_(std::size_t{side} * threads) {
        const float step = static_cast<float>(threads) / static_cast<float>(side);
        for (std::uint32_t thread = 0; thread < threads; ++thread) {
            const float width = yarn.half_width * (1 + yarn.uneven * swing(seed, thread, 101));
            for (std::uint32_t s = 0; s < side; ++s) {
                const float at = (static_cast<float>(s) + 0.5f) * step;
                // Zero slope at the middle of each crossing; the midpoint between two crossings is halfway in height.
                const auto from = static_cast<std::uint32_t>(at + 0.5f) + threads - 1;
                const float here = over(thread, from % threads) ? 1 : -1,
                            next = over(thread, (from + 1) % threads) ? 1 : -1;
                const float way = at + 0.5f - static_cast<float>(static_cast<std::uint32_t>(at + 0.5f));
                const float height = yarn.crimp * (here + (next - here) * eased(way)) +
                                     0.1f * yarn.crimp * drift(seed + 1, thread, at, threads);
                const float thick = 1 + 0.5f * yarn.uneven * drift(seed + 2, thread, at, threads);
                places_[std::size_t{thread} * side + s] = {yarn.wander * drift(seed + 3, thread, at, threads), height,
                                                           1 / (width * thick)};
            }
        }
    }

    /// The larger height of the two threads nearest to `across`, at sample `s` along them.
    float top(std::uint32_t s, float along, float across) const {
        const auto own = static_cast<std::uint32_t>(across);
        const float off = across - static_cast<float>(own) - 0.5f;
        const std::uint32_t other = (own + (off < 0 ? threads - 1 : 1)) % threads;
        return std::max(of(own, s, along, off), of(other, s, along, off < 0 ? off + 1 : off - 1));
    }

  private:
    float of(std::uint32_t thread, std::uint32_t s, float along, float off) const {
        const Place& place = places_[std::size_t{thread} * side_ + s];
        const float q = (off - place.aside) * place.per_width;
        const float round = 1 - q * q;
        float height = place.height + yarn_.crown * round;
        if (yarn_.twist > 0 && round > 0) height += yarn_.twist * round * wave(3 * along + 0.8f * q + 2);
        return height;
    }

    std::uint32_t side_;
    Yarn yarn_;
    std::vector<Place> places_;
};

/// `warp_over(i, j)`: whether the warp thread j is on top where it crosses the weft thread i.
template <class WarpOver>
Heights woven(std::uint32_t side, const Yarn& warp, const Yarn& weft, const WarpOver& warp_over) {
    Heights out(side, threads);
    const Threads along_u(side, warp, 11, [&](std::uint32_t j, std::uint32_t i) { return warp_over(i, j); });
    const Threads along_v(side, weft, 23, [&](std::uint32_t i, std::uint32_t j) { return !warp_over(i, j); });
    const float step = out.step();
    for (std::uint32_t y = 0; y < side; ++y) {
        const float v = (static_cast<float>(y) + 0.5f) * step;
        for (std::uint32_t x = 0; x < side; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) * step;
            const float a = along_u.top(x, u, v), b = along_v.top(y, v, u);
            const std::size_t at = std::size_t{y} * side + x;
            out.height[at] = std::max(a, b);
            out.warp[at] = a > b ? 1.0f : 0.0f;
        }
    }
    return out;
}

}  // namespace

Heights plain(std::uint32_t side) {
    return woven(side, {}, {}, [](std::uint32_t i, std::uint32_t j) { return (i + j) % 2 == 0; });
}

Heights twill(std::uint32_t side) {
    // The thick, hard-twisted yarn of denim. Its ridges run up to the right when the warp is upright (Z twill).
    const Yarn yarn{.crown = 0.28f, .crimp = 0.2f, .wander = 0.035f, .uneven = 0.1f, .twist = 0.008f};
    return woven(side, yarn, yarn, [](std::uint32_t i, std::uint32_t j) { return (i + j) % 4 != 0; });
}

Heights satin(std::uint32_t side) {
    // Filaments without twist, packed so densely that they lie flat.
    const Yarn yarn{.half_width = 0.52f, .crown = 0.16f, .crimp = 0.14f, .wander = 0.02f, .uneven = 0.04f, .twist = 0};
    return woven(side, yarn, yarn, [](std::uint32_t i, std::uint32_t j) { return (i + 3 * j) % 8 != 0; });
}

}  // namespace weft::weaves
