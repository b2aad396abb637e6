#include "editor/ui/icons.h"

#include <weft/vector.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace weft::editor {
namespace {

constexpr float grid = 24, half_width = 1.0f;  // of the square and of lines

struct IconPath {
    std::string_view name, path;
};
constexpr std::array icon_paths = {
    IconPath{"none", ""},
#define WEFT_ICON(name, path) IconPath{#name, path},
#include "editor/ui/icons.def"
#undef WEFT_ICON
};

/// A line or an area.
struct Outline {
    std::vector<Vec2> points;
    bool closed = false, filled = false;
};

void add_arc(std::vector<Vec2>& points, Vec2 center, float radius, float from, float to) {
    const int steps = std::max(2, static_cast<int>(std::abs(to - from) / 10));
    for (int i = 0; i <= steps; ++i) {
        const float angle =
            (from + (to - from) * static_cast<float>(i) / static_cast<float>(steps)) * std::numbers::pi_v<float> / 180;
        points.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
    }
}

class PathReader {
  public:
    explicit PathReader(std::string_view path) : rest_(path) {}

    std::vector<Outline> read() {
        for (std::string_view word = next(); !word.empty(); word = next()) obey(word[0]);
        std::erase_if(outlines_, [](const Outline& one) { return one.points.size() < 2; });
        return std::move(outlines_);
    }

  private:
    void obey(char command) {
        if (command == 'f' || command == 's') filled_ = command == 'f';
        if (command == 'm') outlines_.push_back({{point()}, false, filled_});
        if (command == 'l') outlines_.back().points.push_back(point());
        if (command == 'z') outlines_.back().closed = true;
        if (command == 'o') {
            const Vec2 center = point();
            outlines_.push_back({{}, true, filled_});
            add_arc(outlines_.back().points, center, number(), 0, 360);
        }
        if (command == 'a') {  // continues a line that ends where it begins
            const Vec2 center = point();
            const float radius = number(), from = number(), to = number();
            std::vector<Vec2> points;
            add_arc(points, center, radius, from, to);
            const bool goes_on = !outlines_.empty() && !outlines_.back().closed &&
                                 std::hypot(outlines_.back().points.back().x - points[0].x,
                                            outlines_.back().points.back().y - points[0].y) < 0.1f;
            if (!goes_on) outlines_.push_back({{}, false, filled_});
            outlines_.back().points.insert(outlines_.back().points.end(), points.begin(), points.end());
        }
    }
    std::string_view next() {
        while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
        const std::string_view word = rest_.substr(0, rest_.find(' '));
        rest_.remove_prefix(word.size());
        return word;
    }
    float number() {
        const std::string_view word = next();
        float value = 0;
        std::from_chars(word.data(), word.data() + word.size(), value);
        return value;
    }
    Vec2 point() {
        const float x = number();
        return {x, number()};
    }

    std::string_view rest_;
    std::vector<Outline> outlines_;
    bool filled_ = false;
};

/// Distance from the edge of the outline; negative inside.
float distance(const Outline& outline, Vec2 p) {
    float nearest = 1e9f;
    bool inside = false;
    const std::size_t count = outline.points.size();
    const bool around = outline.closed || outline.filled;
    for (std::size_t i = 0; i + (around ? 0 : 1) < count; ++i) {
        const Vec2 a = outline.points[i], b = outline.points[(i + 1) % count];
        const Vec2 along = b - a, to = p - a;
        const float squared = along.x * along.x + along.y * along.y;
        const float t = squared > 0 ? std::clamp((to.x * along.x + to.y * along.y) / squared, 0.0f, 1.0f) : 0.0f;
        nearest = std::min(nearest, std::hypot(to.x - t * along.x, to.y - t * along.y));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + along.x * (p.y - a.y) / along.y) inside = !inside;
    }
    if (!outline.filled) return nearest - half_width;
    return inside ? -nearest : nearest;
}

}  // namespace

std::string text_of(Icon icon) {
    if (icon == Icon::none) return {};
    const auto c = static_cast<unsigned>(character_of(icon));
    return {static_cast<char>(0xE0 | c >> 12), static_cast<char>(0x80 | (c >> 6 & 0x3F)),
            static_cast<char>(0x80 | (c & 0x3F))};
}

std::string_view name_of(Icon icon) {
    return icon_paths[static_cast<std::size_t>(icon)].name;
}

std::vector<std::uint8_t> draw_icon(Icon icon, std::uint32_t side) {
    const std::vector<Outline> outlines = PathReader(icon_paths[static_cast<std::size_t>(icon)].path).read();
    const float pixels = static_cast<float>(side) / grid;  // per unit
    std::vector<std::uint8_t> coverage(std::size_t{side} * side);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const Vec2 p{(static_cast<float>(x) + 0.5f) / pixels, (static_cast<float>(y) + 0.5f) / pixels};
            float most = 0;
            for (const Outline& outline : outlines)
                most = std::max(most, std::clamp(0.5f - distance(outline, p) * pixels, 0.0f, 1.0f));
            coverage[std::size_t{y} * side + x] = static_cast<std::uint8_t>(std::lround(most * 255));
        }
    }
    return coverage;
}

}  // namespace weft::editor
