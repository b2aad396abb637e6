#include "view/legend.h"

#include "render/shading/color_scale.h"
#include "view/flat_text.h"
#include "view/nice_numbers.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Lengths in units of the text.
constexpr float margin = 8, padding = 7, line = 12, capital = 7, gap = 11;
constexpr float bar_length = 132, bar_height = 8, tick = 3, patch = 7;

constexpr Vec4 ink{0.96f, 0.96f, 0.96f, 1};
constexpr Vec4 backdrop{0.06f, 0.07f, 0.09f, 0.62f};

// Letters are 14 pixels high in an image of height 720, smaller in narrow images, but at least 7, the font's own size.
float unit_of(std::uint32_t width, std::uint32_t height) {
    return std::max(1.0f, std::round(std::min(static_cast<float>(height) / 360, static_cast<float>(width) / 400)));
}

Vec4 color_at(const Legend::Bar& bar, float t) {
    return color_of(bar.scale, t);
}

// The text, shortened to fit into `room`.
std::string shortened(std::string text, float room) {
    if (text_width(text) <= room) return text;
    while (!text.empty() && text_width(text + "..") > room) text.pop_back();
    return text.empty() ? text : text + "..";
}

float height_of(const Legend& legend) {
    float height = capital;
    if (legend.bar) height += 5 + bar_height + tick + 2 + capital;
    return height + static_cast<float>(legend.entries.size()) * line;
}

float width_of(const Legend& legend) {
    float width = text_width(legend.title);
    if (legend.bar) width = std::max(width, bar_length + 24);  // numbers extend beyond both ends
    for (const Legend::Entry& entry : legend.entries)
        width = std::max(width, text_width(entry.text) + (entry.color ? patch + 5 : 0));
    return width;
}

class Page {
  public:
    Page(float left, float top, float unit, float room, std::vector<render::FlatVertex>& flat)
        : left_(left), top_(top), unit_(unit), room_(room), flat_(flat) {}

    void write(const Legend& legend) {
        text(shortened(legend.title, room_), 0, 0);
        top_ += capital * unit_;
        if (legend.bar) draw(*legend.bar);
        for (const Legend::Entry& entry : legend.entries) {
            top_ += (line - capital) * unit_;
            const float indent = entry.color ? patch + 5 : 0;
            if (entry.color) rectangle(0, 0, patch, patch, *entry.color);
            text(shortened(entry.text, room_ - indent), indent, 0);
            top_ += capital * unit_;
        }
        top_ += gap * unit_;
    }

  private:
    void rectangle(float left, float top, float right, float bottom, Vec4 color) {
        draw_rectangle(left_ + left * unit_, top_ + top * unit_, left_ + right * unit_, top_ + bottom * unit_, color,
                       flat_);
    }
    void text(const std::string& letters, float left, float top) {
        draw_text(letters, left_ + left * unit_, top_ + top * unit_, unit_, ink, flat_);
    }

    void draw(const Legend::Bar& bar) {
        top_ += 5 * unit_;
        constexpr int strips = 66;
        const float length = std::min(bar_length, room_ - 24), begin = 12;
        for (int i = 0; i < strips; ++i) {
            const float from = static_cast<float>(i) / strips, to = static_cast<float>(i + 1) / strips;
            draw_gradient(left_ + (begin + from * length) * unit_, top_, left_ + (begin + to * length) * unit_,
                          top_ + bar_height * unit_, color_at(bar, from), color_at(bar, to), flat_);
        }
        top_ += bar_height * unit_;
        std::vector<std::string> numbers = tick_texts(bar);
        const auto widest = std::ranges::max(numbers, {}, [](const std::string& s) { return text_width(s); });
        if (text_width(widest) + 4 > length / 4) numbers = tick_texts(bar, 3);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const float x = begin + length * static_cast<float>(i) / static_cast<float>(numbers.size() - 1);
            rectangle(x - 0.5f, 0, x + 0.5f, tick, ink);
            // Centered under the tick, at whole pixels, and inside the backdrop.
            const float width = text_width(numbers[i]);
            const float at = std::clamp(std::round(x - width / 2), 0.0f, std::max(0.0f, length + 24 - width));
            text(numbers[i], at, tick + 2);
        }
        top_ += (tick + 2 + capital) * unit_;
    }

    float left_, top_, unit_, room_;
    std::vector<render::FlatVertex>& flat_;
};

// A dark rectangle behind the text, with soft edges.
void draw_backdrop(float left, float top, float right, float bottom, float soft,
                   std::vector<render::FlatVertex>& flat) {
    Vec4 clear = backdrop;
    clear.w = 0;
    const float xs[] = {left - soft, left, right, right + soft}, ys[] = {top - soft, top, bottom, bottom + soft};
    const auto corner = [&](int column, int row) -> render::FlatVertex {
        const bool inside = (column == 1 || column == 2) && (row == 1 || row == 2);
        return {xs[column], ys[row], inside ? backdrop : clear};
    };
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const auto a = corner(column, row), b = corner(column + 1, row), c = corner(column, row + 1),
                       d = corner(column + 1, row + 1);
            // The diagonal of a corner cell goes to the inner corner, so that corners fade evenly.
            if (row == column || row == 1 || column == 1) {
                flat.insert(flat.end(), {a, c, d, a, d, b});
            } else {
                flat.insert(flat.end(), {a, c, b, b, c, d});
            }
        }
    }
}

}  // namespace

Vec4 color_of(render::ColorScale scale, float at) {
    const auto color = shading::color_scale(at, static_cast<int>(scale));
    return {color.x, color.y, color.z, 1};
}

std::vector<std::string> tick_texts(const Legend::Bar& bar, std::size_t count) {
    std::vector<std::string> texts;
    const bool signs = bar.least < 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(count - 1);
        const double value = bar.least + t * (static_cast<double>(bar.most) - bar.least);
        texts.push_back((signs && value > 0 ? "+" : "") + short_number(value));
    }
    return texts;
}

void draw_legends(std::span<const Legend> legends, std::uint32_t width, std::uint32_t height,
                  std::vector<render::FlatVertex>& flat) {
    const float unit = unit_of(width, height);
    const float columns = static_cast<float>(width) / unit - 2 * (margin + padding);
    const float rows = static_cast<float>(height) / unit - 2 * (margin + padding);
    float wide = 0, high = 0;
    std::size_t shown = 0;
    for (; shown < legends.size(); ++shown) {
        const float more = height_of(legends[shown]) + (shown > 0 ? gap : 0);
        if (high + more > rows) break;
        high += more;
        wide = std::max(wide, width_of(legends[shown]));
    }
    wide = std::min(std::ceil(wide), columns);
    if (shown == 0 || wide < 40) return;

    const float left = (margin + padding) * unit, bottom = static_cast<float>(height) - (margin + padding) * unit;
    const float top = bottom - high * unit, rim = padding * unit;
    draw_backdrop(left - rim / 2, top - rim / 2, left + wide * unit + rim / 2, bottom + rim / 2, rim / 2, flat);
    Page page(left, top, unit, wide, flat);
    for (const Legend& legend : legends.first(shown)) page.write(legend);
}

}  // namespace weft
