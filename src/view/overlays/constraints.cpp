// Constraints as lines: a line between two particles; for a hinge, between the tips of its wings; for a plate, its
// triangle, drawn smaller. The color is that of the constraint's batch. Constraints of one batch share no particle, so
// lines of one color do not touch, except constraints along lines (solver/model/lines.h) and the overflow.

#include "view/overlay_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace weft::overlay {
namespace {

// Stretch first, the others in the order of the solver.
std::vector<ConstraintKind> kinds_in_order() {
    std::vector<ConstraintKind> kinds{ConstraintKind::stretch};
    for (std::uint32_t k = 0; k < constraint_kind_count; ++k)
        if (const auto kind = static_cast<ConstraintKind>(k); kind != ConstraintKind::stretch) kinds.push_back(kind);
    return kinds;
}

// Hues at multiples of the golden angle differ from all earlier ones. Lightness alternates too.
Vec4 color_of(std::size_t batch, float opacity) {
    const double hue = std::fmod(0.02 + static_cast<double>(batch) * 0.6180339887, 1.0);
    const float light = std::array{1.0f, 0.72f, 0.88f}[batch % 3];
    const auto channel = [&](double shift) {
        const double wave = std::abs(std::fmod(hue + shift, 1.0) * 6 - 3) - 1;
        return light * static_cast<float>(0.12 + 0.88 * std::clamp(wave, 0.0, 1.0));
    };
    return {channel(0), channel(2.0 / 3), channel(1.0 / 3), opacity};
}

class Drawer {
  public:
    Drawer(const OverlayInput& input, std::size_t cloth, OverlayOutput& output)
        : cloth_(input.frame.cloths[cloth]),
          anchors_(anchor_places(input.world, cloth_, input.frame.time)),
          lifted_(lift(input, *cloth_.model)),
          width_(pixels(input, 1.5f)),
          lines_(output.lines) {}

    void draw(const ConstraintTable& table) {
        std::size_t batch = 0;
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            while (batch + 1 < table.batches.size() && row >= table.batches[batch + 1].begin) ++batch;
            if (table.is_real(row)) draw(table, row, color_of(batch, table.kind == ConstraintKind::stretch ? 1 : 0.7f));
        }
    }

  private:
    Vec3 at(std::uint32_t point) const {
        if (point < cloth_.positions.size()) return cloth_.positions[point].xyz();
        const std::size_t anchor = point - cloth_.model->particle_count;
        return anchor < anchors_.size() ? anchors_[anchor] : Vec3{};
    }
    Vec3 normal(std::uint32_t point) const {
        return point < cloth_.normals.size() ? cloth_.normals[point].xyz() : Vec3{};
    }

    void join(std::uint32_t a, std::uint32_t b, Vec4 color) {
        add_line_on_surface(lines_, at(a), at(b), normal(a), normal(b), lifted_, color, width_);
    }
    void draw_triangle(const std::array<std::uint32_t, 3>& corners, Vec4 color) {
        const Vec3 middle = (at(corners[0]) + at(corners[1]) + at(corners[2])) / 3;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
            add_line_on_surface(lines_, middle + (at(a) - middle) * 0.6f, middle + (at(b) - middle) * 0.6f, normal(a),
                                normal(b), lifted_, color, width_);
        }
    }
    void draw(const ConstraintTable& table, std::uint32_t row, Vec4 color) {
        const auto point = [&](std::uint32_t slot) { return table.particles[std::size_t{slot} * table.stride + row]; };
        switch (table.arity) {
            case 2:
                return join(point(0), point(1), color);
            case 4:
                return join(point(2), point(3), color);
            case 6:
                return draw_triangle({point(3), point(4), point(5)}, color);
        }
    }

    const ClothFrame& cloth_;
    std::vector<Vec3> anchors_;
    float lifted_, width_;
    std::vector<render::Line>& lines_;
};

}  // namespace

void constraints(const OverlayInput& input, OverlayOutput& output) {
    Legend legend{.title = "constraints: rows, in batches"};
    for (const ConstraintKind kind : kinds_in_order()) {
        std::size_t rows = 0, batches = 0, overflow = 0;
        for (std::size_t i = 0; i < input.frame.cloths.size(); ++i) {
            const ConstraintTable& table = input.frame.cloths[i].model->table(kind);
            Drawer(input, i, output).draw(table);
            rows += table.rows;
            batches = std::max(batches, table.batches.size());
            overflow += table.overflow();
        }
        if (rows == 0) continue;
        std::string text = std::string(constraint_info(kind).name) + ": " + std::to_string(rows) + ", " +
                           std::to_string(batches) + (batches == 1 ? " batch" : " batches");
        if (overflow > 0) text += ", " + std::to_string(overflow) + " one by one";
        legend.entries.push_back({{}, std::move(text)});
    }
    output.legends.push_back(std::move(legend));
}

}  // namespace weft::overlay
