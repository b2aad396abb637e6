#include "render/environment.h"

#include "render/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::render {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr std::uint32_t side = 128;          // width of the sharpest level in pixels
constexpr std::uint32_t levels = 6;          // down to 4 by 2
constexpr std::uint32_t mirror_facets = 96;  // samples per pixel of a rough mirror
constexpr std::uint32_t harmonics_side = 64;

ImageF made(std::uint32_t width, std::uint32_t height) {
    return {width, height, std::vector<float>(std::size_t{width} * height * 4, 0.0f)};
}

Vec3 toward(float x, float y) {  // x, y: 0…1 across and down
    const float azimuth = (x - 0.5f) * 2 * pi, polar = y * pi;
    return {std::sin(azimuth) * std::sin(polar), std::cos(polar), -std::cos(azimuth) * std::sin(polar)};
}

Vec3 direction_of_pixel(const ImageF& image, std::uint32_t x, std::uint32_t y) {
    return toward((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                  (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height));
}

Vec3 rgb(const float* p) {
    return {p[0], p[1], p[2]};
}
void put(float* p, Vec3 c) {
    p[0] = c.x, p[1] = c.y, p[2] = c.z, p[3] = 1;
}

/// The image at half the width and height, each pixel the mean of four.
ImageF halved(const ImageF& image) {
    ImageF half = made(std::max(1u, image.width / 2), std::max(1u, image.height / 2));
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            const std::uint32_t x1 = std::min(2 * x + 1, image.width - 1), y1 = std::min(2 * y + 1, image.height - 1);
            const Vec3 sum = rgb(image.at(2 * x, 2 * y)) + rgb(image.at(x1, 2 * y)) + rgb(image.at(2 * x, y1)) +
                             rgb(image.at(x1, y1));
            put(half.at(x, y), sum * 0.25f);
        }
    }
    return half;
}

/// Bilinear sample; wraps around at the left and right, clamps at the poles.
Vec3 sampled(const ImageF& image, Vec3 d) {
    const float u = (std::atan2(d.x, -d.z) / (2 * pi) + 0.5f) * static_cast<float>(image.width) - 0.5f;
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / pi * static_cast<float>(image.height) - 0.5f;
    const float fu = std::floor(u), fv = std::floor(v), s = u - fu, t = v - fv;
    const auto column = [&](float x) {
        const auto width = static_cast<int>(image.width);
        return static_cast<std::uint32_t>((static_cast<int>(x) % width + width) % width);
    };
    const auto row = [&](float y) {
        return static_cast<std::uint32_t>(std::clamp(static_cast<int>(y), 0, static_cast<int>(image.height) - 1));
    };
    const auto at = [&](float x, float y) { return rgb(image.at(column(x), row(y))); };
    return (at(fu, fv) * (1 - s) + at(fu + 1, fv) * s) * (1 - t) +
           (at(fu, fv + 1) * (1 - s) + at(fu + 1, fv + 1) * s) * t;
}

/// The image resampled to the size of the sharpest level, each pixel the mean of the area it covers.
ImageF from_picture(const ImageF& picture, const Environment& environment) {
    std::vector<ImageF> smaller = {picture};
    while (smaller.back().width > 2 * side) smaller.push_back(halved(smaller.back()));
    const float angle = environment.rotation * pi / 180, c = std::cos(angle), s = std::sin(angle);
    ImageF base = made(side, side / 2);
    for (std::uint32_t y = 0; y < base.height; ++y) {
        for (std::uint32_t x = 0; x < base.width; ++x) {
            Vec3 sum{};
            constexpr std::uint32_t taps = 4;
            for (std::uint32_t i = 0; i < taps * taps; ++i) {
                const auto part = [](std::uint32_t k) { return (static_cast<float>(k) + 0.5f) / taps; };
                const Vec3 d = toward((static_cast<float>(x) + part(i % taps)) / static_cast<float>(side),
                                      (static_cast<float>(y) + part(i / taps)) / (static_cast<float>(side) / 2));
                sum += sampled(smaller.back(), {c * d.x - s * d.z, d.y, s * d.x + c * d.z});
            }
            put(base.at(x, y), sum * (environment.intensity / (taps * taps)));
        }
    }
    return base;
}

ImageF from_sky(const Sky& sky) {
    ImageF base = made(side, side / 2);
    for (std::uint32_t y = 0; y < base.height; ++y) {
        const Vec3 light = sky_toward(sky, direction_of_pixel(base, 0, y));
        for (std::uint32_t x = 0; x < base.width; ++x) put(base.at(x, y), light);
    }
    return base;
}

std::array<glm::vec4, 9> harmonics_of(const ImageF& image) {
    // Per band: coefficient of the cosine lobe over pi, times the square of the basis function's factor.
    constexpr float one = 0.282095f * 0.282095f, first = 2.0f / 3 * 0.488603f * 0.488603f,
                    second = 0.25f * 1.092548f * 1.092548f, zonal = 0.25f * 0.315392f * 0.315392f,
                    last = 0.25f * 0.546274f * 0.546274f;
    constexpr float factors[9] = {one, first, first, first, second, second, zonal, second, last};
    std::array<glm::vec4, 9> sums{};
    float area = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        const float share = std::sin((static_cast<float>(y) + 0.5f) / static_cast<float>(image.height) * pi);
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const Vec3 d = direction_of_pixel(image, x, y), light = rgb(image.at(x, y));
            const float basis[9] = {
                1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
            for (int i = 0; i < 9; ++i)
                sums[static_cast<std::size_t>(i)] += glm::vec4(light.x, light.y, light.z, 0) * (basis[i] * share);
            area += share;
        }
    }
    for (std::size_t i = 0; i < 9; ++i) sums[i] *= factors[i] * 4 * pi / area;
    return sums;
}

/// The environment prefiltered for a GGX mirror of that roughness, with view and normal along the reflection (Karis
/// 2013). Samples a level whose blur matches the distance between samples (Krivanek and Colbert 2008).
ImageF mirrored(const std::vector<ImageF>& sharp, float roughness, std::uint32_t width) {
    const float alpha = std::max(roughness * roughness, 1e-3f);
    struct Facet {
        Vec3 light;  // in the tangent frame of the normal
        float weight;
        std::size_t level;
    };
    std::vector<Facet> list;
    const float pixel = 4 * pi / static_cast<float>(sharp[0].width * sharp[0].height);
    for (std::uint32_t i = 0; i < mirror_facets; ++i) {
        const float part = middle(i, mirror_facets), angle = 2 * pi * radical_inverse(i);
        const float slope2 = alpha * alpha * part / (1 - part), cosine = 1 / std::sqrt(1 + slope2);
        const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
        const Vec3 h{sine * std::cos(angle), sine * std::sin(angle), cosine};
        const Vec3 l{2 * cosine * h.x, 2 * cosine * h.y, 2 * cosine * cosine - 1};
        if (l.z <= 0) continue;
        const float d = cosine * cosine * (alpha * alpha - 1) + 1, density = alpha * alpha / (pi * d * d) / 4;
        const float covered = 1 / (mirror_facets * density),
                    level = 0.5f * std::log2(std::max(1.0f, covered / pixel)) + 0.5f;
        list.push_back({l, l.z, std::min(sharp.size() - 1, static_cast<std::size_t>(level))});
    }
    ImageF result = made(width, width / 2);
    for (std::uint32_t y = 0; y < result.height; ++y) {
        for (std::uint32_t x = 0; x < result.width; ++x) {
            const Vec3 n = direction_of_pixel(result, x, y);
            const Vec3 t = normalized(cross(std::abs(n.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n)), b = cross(n, t);
            Vec3 sum{};
            float weights = 0;
            for (const Facet& facet : list) {
                sum += sampled(sharp[facet.level], t * facet.light.x + b * facet.light.y + n * facet.light.z) *
                       facet.weight;
                weights += facet.weight;
            }
            put(result.at(x, y), sum / weights);
        }
    }
    return result;
}

}  // namespace

Vec3 sky_toward(const Sky& sky, Vec3 d) {
    const auto between = [](Vec3 a, Vec3 b, float t) { return a * (1 - t) + b * t; };
    if (d.y >= 0) return between(sky.horizon, sky.zenith, std::sqrt(d.y)) * sky.intensity;
    const float t = std::clamp(-d.y / 0.35f, 0.0f, 1.0f);
    return between(sky.horizon, sky.ground, t * t * (3 - 2 * t)) * sky.intensity;
}

Surroundings surroundings_of(const Lighting& light, const ImageF* environment) {
    std::vector<ImageF> sharp = {environment ? from_picture(*environment, light.environment) : from_sky(light.sky)};
    while (sharp.back().height > 1) sharp.push_back(halved(sharp.back()));
    Surroundings result;
    result.around = harmonics_of(*std::ranges::find(sharp, harmonics_side, &ImageF::width));
    result.mirrored.push_back(sharp.front());
    for (std::uint32_t level = 1; level < levels; ++level) {
        const float roughness = static_cast<float>(level) / (levels - 1);
        result.mirrored.push_back(mirrored(sharp, roughness, side >> level));
    }
    return result;
}

}  // namespace weft::render
