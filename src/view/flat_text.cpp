#include "view/flat_text.h"

// The functions of stb_easy_font are static, and not all of them are used here.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

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

}  // namespace weft
