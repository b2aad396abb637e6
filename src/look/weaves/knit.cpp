#include "look/weaves/heights.h"
#include "look/weaves/noise.h"

#include <algorithm>
#include <span>

namespace weft::weaves {
namespace {

// A stitch is wider than it is long: five courses are as long as four wales are wide.
constexpr std::uint32_t wales = 8, courses = 10;
constexpr float pitch = static_cast<float>(wales) / static_cast<float>(courses);

/// A visible piece of yarn: an ellipse seen from above, one end lower than the other.
struct Limb {
    float u, v;                          ///< center, relative to that of the stitch
    float along_u, along_v;              ///< unit vector
    float per_half_long, per_half_wide;  ///< 1 / spacings
    float crown, rise;                   ///< height of the center, and of the far end above the center
};

/// Random variation, different for each stitch.
struct Stitch {
    float per_thick, shift, lift;
};

std::vector<Stitch> make_stitches() {
    std::vector<Stitch> stitches;
    for (std::uint32_t wale = 0; wale < wales; ++wale) {
        for (std::uint32_t row = 0; row < courses; ++row) {
            stitches.push_back({1 / (1 + 0.06f * swing(31, wale, row)), 0.05f * pitch * swing(32, wale, row),
                                0.02f * swing(33, wale, row)});
        }
    }
    return stitches;
}

float height_of(const Limb& limb, float u, float v, const Stitch& stitch) {
    const float du = u - limb.u, dv = v - limb.v;
    const float s = (du * limb.along_u + dv * limb.along_v) * limb.per_half_long;
    const float q = (dv * limb.along_u - du * limb.along_v) * (limb.per_half_wide * stitch.per_thick);
    return limb.crown * (1 - q * q - 0.6f * s * s) + limb.rise * s + stitch.lift;
}

// The legs of the V lean outward and up. Their upper ends go under the next V, whose lower ends lie on top.
constexpr float lean_u = 0.894f, lean_v = 0.448f;
constexpr Limb face[] = {{0, -0.25f, lean_u, -lean_v, 1 / 0.58f, 1 / 0.27f, 0.3f, -0.15f},
                         {0, 0.25f, lean_u, lean_v, 1 / 0.58f, 1 / 0.27f, 0.3f, -0.15f}};
// On the back the arcs between the legs are visible, alternately upward and downward.
constexpr Limb back[] = {{0, 0, 0, 1, 1 / 0.52f, 1 / 0.3f, 0.26f, 0},
                         {0.5f * pitch, -0.5f, 0, 1, 1 / 0.46f, 1 / 0.27f, 0.22f, 0},
                         {0.5f * pitch, 0.5f, 0, 1, 1 / 0.46f, 1 / 0.27f, 0.22f, 0}};
constexpr float floor_height = -0.3f;

/// `drawn`: the stitches of one wale.
float highest(std::span<const Limb> limbs, std::span<const Stitch> drawn, float u, float v) {
    const auto course = static_cast<std::uint32_t>(u / pitch);
    float top = floor_height;
    for (std::uint32_t near = 0; near < 3; ++near) {
        const Stitch& stitch = drawn[(course + near + courses - 1) % courses];
        const float from_middle = u - (static_cast<float>(course + near) - 0.5f) * pitch - stitch.shift;
        for (const Limb& limb : limbs) top = std::max(top, height_of(limb, from_middle, v, stitch));
    }
    return top;
}

/// `is_back`: whether a wale shows its back; `raise`: its height at v.
template <class IsBack, class Raise>
Heights knitted(std::uint32_t side, const IsBack& is_back, const Raise& raise) {
    Heights out(side, wales);
    const std::vector<Stitch> drawn = make_stitches();
    const float step = out.step();
    for (std::uint32_t y = 0; y < side; ++y) {
        const float v = (static_cast<float>(y) + 0.5f) * step;
        const auto own = static_cast<std::uint32_t>(v);
        const float off = v - static_cast<float>(own) - 0.5f;
        const std::uint32_t other = (own + (off < 0 ? wales - 1 : 1)) % wales;
        const float off_other = off < 0 ? off + 1 : off - 1, height = raise(v);
        const auto at = [&](std::uint32_t wale, float u, float from_middle) {
            return highest(is_back(wale) ? std::span<const Limb>(back) : std::span<const Limb>(face),
                           std::span(drawn).subspan(std::size_t{wale} * courses, courses), u, from_middle);
        };
        for (std::uint32_t x = 0; x < side; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) * step;
            out.height[std::size_t{y} * side + x] = height + std::max(at(own, u, off), at(other, u, off_other));
        }
    }
    return out;
}

}  // namespace

Heights knit(std::uint32_t side) {
    return knitted(
        side, [](std::uint32_t) { return false; }, [](float) { return 0.0f; });
}

Heights rib(std::uint32_t side) {
    // Wales 0 and 1 of four show their face; the height is largest between them.
    return knitted(
        side, [](std::uint32_t wale) { return wale % 4 >= 2; }, [](float v) { return 0.2f * wave((v + 3) * 0.25f); });
}

}  // namespace weft::weaves
