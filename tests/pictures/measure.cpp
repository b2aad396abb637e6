#include "measure.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

using Color = std::array<float, 3>;

float decoded(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Linear RGB over a background.
std::vector<Color> laid_on(const Image8& image, float behind) {
    std::vector<Color> colors(std::size_t{image.width} * image.height);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const float alpha = static_cast<float>(image.rgba[4 * i + 3]) / 255;
        for (std::size_t c = 0; c < 3; ++c)
            colors[i][c] = decoded(static_cast<float>(image.rgba[4 * i + c]) / 255) * alpha + behind * (1 - alpha);
    }
    return colors;
}

std::vector<Color> blurred(const std::vector<Color>& from, std::uint32_t width, std::uint32_t height) {
    std::vector<Color> to(from.size());
    for (int y = 0; y < static_cast<int>(height); ++y) {
        for (int x = 0; x < static_cast<int>(width); ++x) {
            Color sum{};
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i) {
                    const int px = std::clamp(x + i, 0, static_cast<int>(width) - 1),
                              py = std::clamp(y + j, 0, static_cast<int>(height) - 1);
                    const Color& color = from[static_cast<std::size_t>(py) * width + static_cast<std::size_t>(px)];
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c] / 9;
                }
            }
            to[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = sum;
        }
    }
    return to;
}

/// From linear sRGB, white point D65.
Color lab(const Color& rgb) {
    const float x = (0.4124564f * rgb[0] + 0.3575761f * rgb[1] + 0.1804375f * rgb[2]) / 0.95047f,
                y = 0.2126729f * rgb[0] + 0.7151522f * rgb[1] + 0.0721750f * rgb[2],
                z = (0.0193339f * rgb[0] + 0.1191920f * rgb[1] + 0.9503041f * rgb[2]) / 1.08883f;
    const auto f = [](float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116; };
    return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

}  // namespace

PictureDistance distance_of(const Image8& a, const Image8& b) {
    if (a.width != b.width || a.height != b.height || a.rgba.empty())
        return {.width = 0, .height = 0, .pixels = {}, .mean = 1000, .worst = 1000};
    PictureDistance found{.width = a.width, .height = a.height, .pixels = std::vector<float>(a.rgba.size() / 4)};
    for (const float behind : {0.0f, 1.0f}) {
        const auto one = blurred(laid_on(a, behind), a.width, a.height),
                   other = blurred(laid_on(b, behind), a.width, a.height);
        for (std::size_t i = 0; i < one.size(); ++i) {
            const Color p = lab(one[i]), q = lab(other[i]);
            const float d = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
            found.pixels[i] = std::max(found.pixels[i], d);
        }
    }
    for (const float d : found.pixels) found.mean += static_cast<double>(d) / static_cast<double>(found.pixels.size());
    std::vector<float> sorted = found.pixels;
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 99 / 100);
    std::nth_element(sorted.begin(), place, sorted.end());
    found.worst = static_cast<double>(*place);
    return found;
}

Image8 picture_of(const PictureDistance& distance, const Image8& under) {
    Image8 image{distance.width, distance.height, {}};
    for (std::size_t i = 0; i < distance.pixels.size(); ++i) {
        const int gray = (under.rgba[4 * i] + under.rgba[4 * i + 1] + under.rgba[4 * i + 2]) / 12;
        const float much = std::min(1.0f, distance.pixels[i] / 10);
        const auto mixed = [&](float full) {
            return static_cast<std::uint8_t>(std::clamp(static_cast<float>(gray) * (1 - much) + full, 0.0f, 255.0f));
        };
        image.rgba.insert(image.rgba.end(), {mixed(255 * std::sqrt(much)), mixed(200 * much * much), mixed(0), 255});
    }
    return image;
}

}  // namespace weft
