#include "view/flat_text.h"

// The functions of stb_easy_font are static, and not all of them are used here.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <string>

namespace weft {
namespace {

// Vertex layout of stb_easy_font.
struct FontVertex {
    float x, y, z;
    unsigned char color[4];
};
static_assert(sizeof(FontVertex) == 16);

// Four corners for each segment. A character has at most 12 segments, and 16 leaves a margin.
constexpr std::size_t vertices_per_character = 4 * 16;

std::string printable(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c < ' ' || c > '~') c = '?';
    return result;
}

}  // namespace

float text_width(std::string_view text) {
    return static_cast<float>(stb_easy_font_width(printable(text).data()));
}

void draw_text(std::string_view text, float x, float y, float size, Vec4 color, std::vector<render::FlatVertex>& flat) {
    std::string letters = printable(text);
    std::vector<FontVertex> corners(letters.size() * vertices_per_character);
    const int quads = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(),
                                          static_cast<int>(corners.size() * sizeof(FontVertex)));
    for (int quad = 0; quad < quads; ++quad) {
        const FontVertex& first = corners[static_cast<std::size_t>(quad) * 4];
        const FontVertex& last = corners[static_cast<std::size_t>(quad) * 4 + 2];
        draw_rectangle(x + first.x * size, y + first.y * size, x + last.x * size, y + last.y * size, color, flat);
    }
}

void draw_rectangle(float left, float top, float right, float bottom, Vec4 color,
                    std::vector<render::FlatVertex>& flat) {
    draw_gradient(left, top, right, bottom, color, color, flat);
}

void draw_gradient(float left, float top, float right, float bottom, Vec4 first, Vec4 last,
                   std::vector<render::FlatVertex>& flat) {
    flat.insert(flat.end(), {{left, top, first},
                             {left, bottom, first},
                             {right, bottom, last},
                             {left, top, first},
                             {right, bottom, last},
                             {right, top, last}});
}

namespace {

using render::FlatVertex;

// Twice the area to the left of the way from a to b that a pixel's center spans, and whether a pixel on the way counts:
// so that of two triangles with a common side exactly one has it.
struct Side {
    float x, y, dx, dy;
    Side(const FlatVertex& a, const FlatVertex& b) : x(a.x), y(a.y), dx(b.x - a.x), dy(b.y - a.y) {}
    float at(float px, float py) const { return dx * (py - y) - dy * (px - x); }
    bool counts(float value) const { return value > 0 || (value == 0 && (dy < 0 || (dy == 0 && dx > 0))); }
};

void draw_triangle(Image8& image, const FlatVertex& a, const FlatVertex& b, const FlatVertex& c) {
    const Side ab(a, b), bc(b, c), ca(c, a);
    const float area = ab.at(c.x, c.y);
    if (area < 0) return draw_triangle(image, a, c, b);
    if (!(area > 0)) return;
    const auto first = [](float least) { return static_cast<std::uint32_t>(std::max(0.0f, std::floor(least))); };
    const auto end = [](float most, std::uint32_t size) {
        return static_cast<std::uint32_t>(std::clamp(std::ceil(most), 0.0f, static_cast<float>(size)));
    };
    const std::uint32_t right = end(std::max({a.x, b.x, c.x}), image.width),
                        bottom = end(std::max({a.y, b.y, c.y}), image.height);
    for (std::uint32_t y = first(std::min({a.y, b.y, c.y})); y < bottom; ++y) {
        for (std::uint32_t x = first(std::min({a.x, b.x, c.x})); x < right; ++x) {
            const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
            const float of_c = ab.at(px, py), of_a = bc.at(px, py), of_b = ca.at(px, py);
            if (!ab.counts(of_c) || !bc.counts(of_a) || !ca.counts(of_b)) continue;
            const auto mean = [&](float Vec4::*channel) {
                return (a.color.*channel * of_a + b.color.*channel * of_b + c.color.*channel * of_c) / area;
            };
            const float opacity = mean(&Vec4::w), parts[] = {mean(&Vec4::x), mean(&Vec4::y), mean(&Vec4::z)};
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint8_t& channel = image.at(x, y)[k];
                const float mixed = static_cast<float>(channel) * (1 - opacity) + 255 * parts[k] * opacity;
                channel = static_cast<std::uint8_t>(std::clamp(std::lround(mixed), 0l, 255l));
            }
        }
    }
}

}  // namespace

void draw_onto(Image8& image, std::span<const FlatVertex> flat) {
    for (std::size_t i = 0; i + 2 < flat.size(); i += 3) draw_triangle(image, flat[i], flat[i + 1], flat[i + 2]);
}

}  // namespace weft
