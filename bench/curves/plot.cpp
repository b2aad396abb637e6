// The plot of error against time.
#include "curves.h"

#include "cli/shell/table.h"
#include "io/files/atomic_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace weft::bench {

using namespace cli;

namespace {

constexpr double panel_width = 440, panel_height = 340;
constexpr double left_margin = 62, right_margin = 14, top_margin = 36, bottom_margin = 52;
constexpr double legend_line = 20;

// Styles in the order in which methods first appear: colors that color-blind readers can distinguish (Okabe and Ito),
// and different marks.
struct Look {
    const char* color;
    const char* mark;  ///< an SVG path around the origin
};
constexpr const char* disc = "M-3.5,0a3.5,3.5 0 1,0 7,0a3.5,3.5 0 1,0 -7,0z";
constexpr const char* square = "M-3.2,-3.2h6.4v6.4h-6.4z";
constexpr const char* triangle = "M0,-4.2l4,7h-8z";
constexpr Look looks[] = {{"#000000", disc},     {"#999999", square},   {"#009e73", disc},  {"#0072b2", disc},
                          {"#56b4e9", triangle}, {"#e69f00", triangle}, {"#cc79a7", square}};

/// Names in the order of their first appearance.
template <class Get>
std::vector<std::string> names_of(const std::vector<CurvePoint>& points, Get get) {
    std::vector<std::string> names;
    for (const CurvePoint& point : points) {
        if (std::ranges::find(names, get(point)) == names.end()) names.push_back(get(point));
    }
    return names;
}

double milliseconds(const CurvePoint& point) {
    return std::max(point.figures.ms.median, 1e-6);
}
double percent(const CurvePoint& point) {
    return std::max(100 * point.figures.stretch.mean, 1e-6);
}

// A sheet stretched beyond twice its size has failed; its points would compress the scale for the others.
constexpr double most_percent = 100;

// --- Axes

constexpr double mantissas[] = {1, 2, 5};

std::string tick_text(double value) {
    return fixed(value, value < 1 ? static_cast<int>(std::ceil(-std::log10(value) - 1e-9)) : 0);
}

/// A logarithmic axis between two round numbers.
struct Axis {
    double least, most;  ///< values
    double from, to;     ///< pixels
    std::vector<double> ticks;

    double at(double value) const { return from + (to - from) * std::log(value / least) / std::log(most / least); }
};

Axis axis_over(const std::vector<double>& values, double from, double to) {
    const auto [least, most] = std::ranges::minmax(values);
    std::vector<double> ticks;
    for (int decade = -7; decade < 10; ++decade) {
        for (const double mantissa : mantissas) ticks.push_back(mantissa * std::pow(10, decade));
    }
    const auto below = std::ranges::upper_bound(ticks, least * 0.999) - 1;
    auto above = std::ranges::lower_bound(ticks, most * 1.001);
    if (above - below < 2) ++above;
    std::vector<double> used(below, above + 1);
    constexpr std::size_t most_ticks = 13;
    const Axis axis{used.front(), used.back(), from, to, {}};
    if (used.size() <= most_ticks) return {axis.least, axis.most, from, to, used};
    std::vector<double> powers;  // over many decades only powers of ten
    for (const double tick : used) {
        if (const double power = std::log10(tick); std::abs(power - std::round(power)) < 1e-6) powers.push_back(tick);
    }
    return {axis.least, axis.most, from, to, powers};
}

// --- Shapes

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
    return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
           text + "</text>\n";
}

std::string line_from(double x1, double y1, double x2, double y2) {
    return "<line x1=\"" + fixed(x1, 1) + "\" y1=\"" + fixed(y1, 1) + "\" x2=\"" + fixed(x2, 1) + "\" y2=\"" +
           fixed(y2, 1) + "\" stroke=\"#ddd\"/>\n";
}

std::string mark_at(double x, double y, const Look& look, const std::string& says) {
    return std::string("<path d=\"") + look.mark + "\" transform=\"translate(" + fixed(x, 1) + ',' + fixed(y, 1) +
           ")\" fill=\"" + look.color + "\"><title>" + says + "</title></path>\n";
}

std::string grid_lines(const Axis& x, const Axis& y) {
    std::string svg;
    for (const double tick : x.ticks) {
        svg += line_from(x.at(tick), y.from, x.at(tick), y.to);
        svg += text_at(x.at(tick), y.from + 16, "middle", tick_text(tick));
    }
    for (const double tick : y.ticks) {
        svg += line_from(x.from, y.at(tick), x.to, y.at(tick));
        svg += text_at(x.from - 6, y.at(tick) + 4, "end", tick_text(tick));
    }
    return svg;
}

std::string curve(const std::vector<const CurvePoint*>& points, const Axis& x, const Axis& y, const Look& look) {
    std::string corners, marks;
    for (const CurvePoint* point : points) {
        const double px = x.at(milliseconds(*point)), py = y.at(percent(*point));
        corners += fixed(px, 1) + ',' + fixed(py, 1) + ' ';
        marks += mark_at(px, py, look,
                         point->method + ", " + std::to_string(point->substeps) + " substeps: " +
                             fixed(milliseconds(*point), 3) + " ms, " + fixed(percent(*point), 3) + " %");
    }
    return "<polyline points=\"" + corners + "\" fill=\"none\" stroke=\"" + look.color + "\" stroke-width=\"1.5\"/>\n" +
           marks;
}

std::string panel(const std::string& mesh, const std::vector<CurvePoint>& all, const std::vector<std::string>& methods,
                  double left, double top) {
    std::vector<CurvePoint> points;
    std::vector<double> times, errors;
    for (const CurvePoint& point : all) {
        if (point.mesh != mesh || percent(point) > most_percent) continue;
        points.push_back(point);
        times.push_back(milliseconds(point));
        errors.push_back(percent(point));
    }
    if (points.empty()) return text_at(left + panel_width / 2, top + 22, "middle", mesh + ": nothing held together");
    const Axis x = axis_over(times, left + left_margin, left + panel_width - right_margin);
    const Axis y = axis_over(errors, top + panel_height - bottom_margin, top + top_margin);
    const double middle = (x.from + x.to) / 2, height = (y.from + y.to) / 2;
    std::string svg = text_at(middle, top + 22, "middle", mesh, " font-weight=\"bold\"");
    svg += grid_lines(x, y);
    svg += text_at(middle, y.from + 34, "middle", "ms a frame");
    svg += text_at(left + 16, height, "middle", "mean stretch, %",
                   " transform=\"rotate(-90 " + fixed(left + 16, 1) + ' ' + fixed(height, 1) + ")\"");
    for (std::size_t m = methods.size(); m-- > 0;) {  // draws the first method on top
        std::vector<const CurvePoint*> mine;
        for (const CurvePoint& point : points) {
            if (point.method == methods[m]) mine.push_back(&point);
        }
        svg += curve(mine, x, y, looks[m % std::size(looks)]);
    }
    return svg;
}

std::string substeps_of(const std::vector<CurvePoint>& points) {
    std::vector<std::uint32_t> counts;
    for (const CurvePoint& point : points) counts.push_back(point.substeps);
    std::ranges::sort(counts);
    const auto repeated = std::ranges::unique(counts);
    counts.erase(repeated.begin(), repeated.end());
    std::string text;
    for (const std::uint32_t count : counts) text += (text.empty() ? "" : ", ") + std::to_string(count);
    return text + " substeps, as far as they are of use; stretch of more than " + fixed(most_percent, 0) +
           " % is not drawn";
}

// Puts as many entries side by side as fit. Moves `bottom` below the legend.
std::string legend(const std::vector<CurvePoint>& points, const std::vector<std::string>& methods, double width,
                   double& bottom) {
    std::string svg;
    double x = left_margin;
    const auto place = [&](const std::string& text, double before) {
        const double needed = before + 7.0 * static_cast<double>(text.size()) + 22;
        if (x > left_margin && x + needed > width) x = left_margin, bottom += legend_line;
        svg += text_at(x + before, bottom + 4, "start", text);
        return std::exchange(x, x + needed);
    };
    bottom += legend_line / 2;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const double at = place(methods[m], 10);
        svg += mark_at(at, bottom, looks[m % std::size(looks)], methods[m]);
    }
    x = left_margin, bottom += legend_line;
    place(substeps_of(points), -4);
    bottom += legend_line;
    return svg;
}

}  // namespace

Result<void> write_curves(const std::vector<CurvePoint>& points, const std::filesystem::path& file) {
    const auto methods = names_of(points, [](const CurvePoint& point) { return point.method; });
    std::string panels;
    // Grids side by side, each with its irregular variant below.
    std::array<double, 2> ends{};
    const auto irregular = [](const std::string& mesh) { return mesh.starts_with("irregular") ? 1u : 0u; };
    for (const std::string& mesh : names_of(points, [](const CurvePoint& point) { return point.mesh; })) {
        double& left = ends[irregular(mesh)];
        panels += panel(mesh, points, methods, left, panel_height * irregular(mesh));
        left += panel_width;
    }
    const double width = std::max({ends[0], ends[1], panel_width});
    double bottom = panel_height * (ends[1] > 0 ? 2 : 1);
    panels += legend(points, methods, width, bottom);
    const std::string size = fixed(width, 0) + ' ' + fixed(bottom, 0);
    const std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed(width, 0) + "\" height=\"" +
                            fixed(bottom, 0) + "\" viewBox=\"0 0 " + size +
                            "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                            "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + panels + "</svg>\n";
    return write_atomically(file, [&](AtomicFile& out) { return out.write(svg); });
}

}  // namespace weft::bench
