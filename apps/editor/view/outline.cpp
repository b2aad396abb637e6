#include "editor/view/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft::editor {
namespace {

constexpr std::array<std::uint8_t, 3> bright{255, 158, 32}, dark{24, 20, 16};

/// For each pixel, how many of the pixels up to `reach` to either side are set; saturates at 255.
void count_along(const std::uint8_t* from, std::uint8_t* to, std::uint32_t count, std::size_t stride,
                 std::uint32_t reach) {
    unsigned sum = 0;
    const auto value = [&](std::int64_t i) {
        return i < 0 || i >= std::int64_t{count} ? 0u : unsigned{from[static_cast<std::size_t>(i) * stride]};
    };
    for (std::uint32_t i = 0; i < reach; ++i) sum += value(i);
    for (std::int64_t i = 0; i < std::int64_t{count}; ++i) {
        sum += value(i + reach);
        to[static_cast<std::size_t>(i) * stride] = static_cast<std::uint8_t>(std::min(sum, 255u));
        sum -= value(i - std::int64_t{reach});
    }
}

std::uint8_t mixed(std::uint8_t below, std::uint8_t above, unsigned opacity) {
    return static_cast<std::uint8_t>((below * (255 - opacity) + above * opacity) / 255);
}

}  // namespace

// The same projection as that of the renderer (render/frame_data.cpp).
Coverage::Coverage(const Camera& camera, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), eye_(camera.position), covered_(std::size_t{width} * height) {
    const Vec3 forward = camera.target - camera.position;
    along_ = normalized(forward);
    const Vec3 upward = std::abs(along_.y) < 0.9999f ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
    right_ = normalized(cross(along_, upward));
    up_ = cross(right_, along_);
    scale_ = 0.5f * static_cast<float>(height) / std::tan(camera.fov * std::numbers::pi_v<float> / 360);
    nearest_ = 0.005f * std::max(length(forward), 1e-4f);
}

Vec3 Coverage::to_view(Vec3 p) const {
    const Vec3 d = p - eye_;
    return {dot(d, right_), dot(d, up_), dot(d, along_)};
}

Coverage::Projected Coverage::project(Vec3 p) const {
    if (!(p.z >= nearest_) || !finite(p)) return {};
    return {0.5f * static_cast<float>(width_) + scale_ * p.x / p.z,
            0.5f * static_cast<float>(height_) - scale_ * p.y / p.z, true};
}

void Coverage::add(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    in_view_.resize(positions.size());
    projected_.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        in_view_[i] = to_view(positions[i]);
        projected_[i] = project(in_view_[i]);
    }
    for (const auto& [a, b, c] : triangles) {
        const Projected &pa = projected_[a], &pb = projected_[b], &pc = projected_[c];
        if (pa.in_front && pb.in_front && pc.in_front) {
            fill(pa, pb, pc);
        } else if (pa.in_front || pb.in_front || pc.in_front) {
            fill_clipped(in_view_[a], in_view_[b], in_view_[c]);
        }
    }
}

// Cuts off the part before the nearest distance and fills the rest: three or four corners.
void Coverage::fill_clipped(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 corners[] = {a, b, c};
    std::array<Projected, 4> rest{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &from = corners[i], &to = corners[(i + 1) % 3];
        if (!finite(from) || !finite(to)) return;
        if (from.z >= nearest_) rest[count++] = project(from);
        if ((from.z >= nearest_) != (to.z >= nearest_)) {
            Vec3 between = from + (to - from) * ((nearest_ - from.z) / (to.z - from.z));
            between.z = nearest_;
            rest[count++] = project(between);
        }
    }
    for (std::size_t i = 2; i < count; ++i) fill(rest[0], rest[i - 1], rest[i]);
}

void Coverage::fill(const Projected& a, const Projected& b, const Projected& c) {
    const auto w = static_cast<float>(width_), h = static_cast<float>(height_);
    const Projected corners[] = {a, b, c};
    for (const Projected& p : corners) {
        if (p.x >= 0 && p.x < w && p.y >= 0 && p.y < h)
            covered_[static_cast<std::size_t>(p.y) * width_ + static_cast<std::size_t>(p.x)] = 1;
    }
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const float first = std::max(0.0f, std::ceil(top - 0.5f)), last = std::min(h - 1, std::floor(bottom - 0.5f));
    for (float row = first; row <= last; ++row) {
        const float y = row + 0.5f;
        float left = w, right = 0;
        for (int i = 0; i < 3; ++i) {
            const Projected &p = corners[i], &q = corners[(i + 1) % 3];
            if ((p.y <= y) == (q.y <= y)) continue;
            const float x = std::clamp(p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y)), 0.0f, w);
            left = std::min(left, x);
            right = std::max(right, x);
        }
        const auto begin = static_cast<std::ptrdiff_t>(std::ceil(left - 0.5f));
        const auto end = static_cast<std::ptrdiff_t>(std::ceil(right - 0.5f));
        if (begin < end) {
            std::uint8_t* const line = covered_.data() + static_cast<std::size_t>(row) * width_;
            std::fill(line + begin, line + end, std::uint8_t{1});
        }
    }
}

void Coverage::outline(Image8& image) const {
    const std::uint32_t band = std::max(1u, (height_ + 180) / 360), rim = std::max(1u, band / 2), reach = band + rim;
    // Only rows and columns that the outline can reach.
    std::uint32_t x0 = width_, x1 = 0, y0 = height_, y1 = 0;
    for (std::uint32_t y = 0; y < height_; ++y) {
        const std::uint8_t* const line = covered_.data() + std::size_t{y} * width_;
        const std::uint8_t* const first = std::find(line, line + width_, std::uint8_t{1});
        if (first == line + width_) continue;
        std::uint32_t last = width_ - 1;
        while (!line[last]) --last;
        x0 = std::min(x0, static_cast<std::uint32_t>(first - line));
        x1 = std::max(x1, last + 1);
        y0 = std::min(y0, y);
        y1 = y + 1;
    }
    if (x0 >= x1) return;
    x0 -= std::min(x0, reach), y0 -= std::min(y0, reach);
    x1 = std::min(width_, x1 + reach), y1 = std::min(height_, y1 + reach);

    const std::uint32_t wide = x1 - x0, high = y1 - y0;
    const auto near = [&](std::uint32_t distance) {
        std::vector<std::uint8_t> rows(std::size_t{wide} * high), both(rows.size());
        for (std::uint32_t y = 0; y < high; ++y)
            count_along(&covered_[std::size_t{y + y0} * width_ + x0], &rows[std::size_t{y} * wide], wide, 1, distance);
        for (std::uint32_t x = 0; x < wide; ++x) count_along(&rows[x], &both[x], high, wide, distance);
        return both;
    };
    const std::vector<std::uint8_t> in_band = near(band), in_rim = near(reach);
    for (std::uint32_t y = 0; y < high; ++y) {
        for (std::uint32_t x = 0; x < wide; ++x) {
            const std::size_t i = std::size_t{y} * wide + x;
            if (in_rim[i] == 0 || at(x + x0, y + y0)) continue;
            // At a straight edge, the count falls by one row of the window with each pixel; corners fade.
            const bool inner = in_band[i] > 0;
            const unsigned full = inner ? band : reach, count = inner ? in_band[i] : in_rim[i];
            const unsigned opacity = std::min(255u, count * 255 / full) * (inner ? 255 : 150) / 255;
            std::uint8_t* const pixel = image.at(x + x0, y + y0);
            for (std::size_t k = 0; k < 3; ++k) pixel[k] = mixed(pixel[k], inner ? bright[k] : dark[k], opacity);
            pixel[3] = std::max(pixel[3], static_cast<std::uint8_t>(opacity));
        }
    }
}

}  // namespace weft::editor
