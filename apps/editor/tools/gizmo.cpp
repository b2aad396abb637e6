#include "editor/tools/gizmo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft::editor {
namespace {

// In sizes of the gizmo.
constexpr double shaft_start = 0.2, head_length = 0.18, head_width = 0.07;
constexpr double square_from = 0.28, square_to = 0.5;
constexpr double box_half = 0.06, center_half = 0.09;
// Sines of the angle to the line of sight, below which an axis or a square cannot be grabbed.
constexpr double arrow_end_on = 0.15, square_end_on = 0.15;
// The gizmo is never larger than this part of its distance, so that all of it lies in front of the eye.
constexpr double largest = 0.4;

GizmoHandle following(GizmoHandle first, std::size_t by) {
    return static_cast<GizmoHandle>(static_cast<std::size_t>(first) + by);
}

double distance_to_line(Double2 p, Double2 a, Double2 b) {
    const Double2 along = b - a;
    const double squared = dot(along, along);
    const double t = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0;
    return length(p - (a + along * t));
}

// 0 inside a filled polygon.
double distance_to(const GizmoShape& shape, Double2 p) {
    double least = std::numeric_limits<double>::infinity();
    bool left = false, right = false;
    const std::size_t count = shape.points.size(), sides = count - (shape.closed || shape.filled ? 0 : 1);
    for (std::size_t i = 0; i < sides; ++i) {
        const Double2 a = exact(shape.points[i]), b = exact(shape.points[(i + 1) % count]);
        least = std::min(least, distance_to_line(p, a, b));
        const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        left = left || side > 0, right = right || side < 0;
    }
    return shape.filled && left != right ? 0 : least;
}

}  // namespace

Gizmo::Gizmo(const Projection& view, const GizmoPlace& place, GizmoKind kind, GizmoAxes axes, const GizmoStyle& style)
    : view_(view), frame_(gizmo_frame(place, kind, axes)), style_(style) {
    if (!view.project(place.position) || !finite(place.rotation_degrees) || !(style.size > 0)) return;
    center_ = view.to_view(exact(place.position));
    meters_ = center_.z / view.focal();
    size_ = std::min(static_cast<double>(style.size) * meters_, largest * center_.z);
    if (kind == GizmoKind::turn) {
        for (std::size_t i = 0; i < 3; ++i)
            add_ring(following(GizmoHandle::turn_x, i), static_cast<int>(i), view.direction_to_view(frame_.axes[i]),
                     size_);
        add_ring(GizmoHandle::turn_view, 3, normalized(center_ * -1), outer_ring * size_);
        return;
    }
    const bool scales = kind == GizmoKind::scale;
    add_arrows(scales ? GizmoHandle::scale_x : GizmoHandle::move_x, scales);
    if (!scales) add_planes();
    add_square(scales ? GizmoHandle::scale_all : GizmoHandle::move_view, 3, center_, center_half * size_);
}

// `points` in the view's frame.
void Gizmo::add_line(GizmoHandle handle, int axis, std::vector<Double3> points, bool pickable, bool faint) {
    if (points.size() < 2) return;
    GizmoShape shape{.handle = handle, .axis = axis, .faint = faint};
    double depth = 0;
    for (const Double3& p : points) {
        shape.points.push_back(rounded(view_.pixel_of(p)));
        depth += p.z;
    }
    shape.depth = static_cast<float>(depth / static_cast<double>(points.size()));
    parts_.push_back({std::move(shape), pickable});
}

// A square that lies in the plane of the image.
void Gizmo::add_square(GizmoHandle handle, int axis, Double3 center, double half) {
    const Double2 middle = view_.pixel_of(center);
    const double h = half / meters_;
    GizmoShape shape{.handle = handle, .axis = axis, .filled = true, .depth = static_cast<float>(center.z)};
    for (const Double2 corner : {Double2{-h, -h}, {h, -h}, {h, h}, {-h, h}})
        shape.points.push_back(rounded(middle + corner));
    parts_.push_back({std::move(shape)});
}

void Gizmo::add_arrows(GizmoHandle first, bool boxes) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Double3 axis = view_.direction_to_view(frame_.axes[i]);
        const GizmoHandle handle = following(first, i);
        const bool faint = length(cross(axis, normalized(center_))) < arrow_end_on;
        const Double3 neck = center_ + axis * (size_ * (1 - head_length)), tip = center_ + axis * size_;
        add_line(handle, static_cast<int>(i), {center_ + axis * (size_ * shaft_start), neck}, !faint, faint);
        if (boxes) {
            add_square(handle, static_cast<int>(i), tip, box_half * size_);
        } else {
            const Double2 end = view_.pixel_of(tip), base = view_.pixel_of(neck);
            const Double2 along = end - base;
            const double l = std::max(length(along), 1e-9), half = head_width * size_ / meters_;
            const Double2 side = Double2{-along.y, along.x} * (half / l);
            parts_.push_back({{.handle = handle,
                               .axis = static_cast<int>(i),
                               .points = {rounded(end), rounded(base + side), rounded(base - side)},
                               .filled = true,
                               .depth = static_cast<float>(tip.z)}});
        }
        parts_.back().shape.faint = faint;
        parts_.back().pickable = !faint;
    }
}

void Gizmo::add_planes() {
    for (std::size_t i = 0; i < 3; ++i) {
        const Double3 u = view_.direction_to_view(frame_.axes[(i + 1) % 3]) * size_;
        const Double3 v = view_.direction_to_view(frame_.axes[(i + 2) % 3]) * size_;
        const Double3 normal = view_.direction_to_view(frame_.axes[i]);
        if (std::abs(dot(normal, normalized(center_))) < square_end_on) continue;
        add_line(following(GizmoHandle::move_yz, i), static_cast<int>(i),
                 {center_ + u * square_from + v * square_from, center_ + u * square_to + v * square_from,
                  center_ + u * square_to + v * square_to, center_ + u * square_from + v * square_to},
                 true, false);
        parts_.back().shape.filled = true;
    }
}

// The half that faces the eye is drawn and grabbed, the other one is faint. A ring seen from the front has no halves.
void Gizmo::add_ring(GizmoHandle handle, int axis, Double3 around, double radius) {
    const Double3 toward_eye = normalized(center_ * -1);
    const Double3 in_plane = toward_eye - around * dot(around, toward_eye);
    constexpr int steps = 96;
    const bool whole = length(in_plane) < ring_front;
    const Double3 start =
        whole ? cross(around, std::abs(around.x) < 0.7 ? Double3{1, 0, 0} : Double3{0, 1, 0}) : in_plane;
    const Double3 u = normalized(start), v = cross(around, u);
    const auto arc = [&](int from, int to) {
        std::vector<Double3> points;
        for (int i = from; i <= to; ++i) {
            const double angle = i * 2 * std::numbers::pi / steps;
            points.push_back(center_ + (u * std::cos(angle) + v * std::sin(angle)) * radius);
        }
        return points;
    };
    if (whole) {
        add_line(handle, axis, arc(0, steps - 1), true, false);
        parts_.back().shape.closed = true;
        return;
    }
    add_line(handle, axis, arc(steps / 4, 3 * steps / 4), false, true);
    add_line(handle, axis, arc(-steps / 4, steps / 4), true, false);
}

GizmoHandle Gizmo::handle_at(Vec2 pointer) const {
    if (!finite(pointer)) return GizmoHandle::none;
    GizmoHandle best = GizmoHandle::none;
    double least = static_cast<double>(style_.tolerance);
    float depth = std::numeric_limits<float>::infinity();
    for (const Part& part : parts_) {
        if (!part.pickable) continue;
        const double off = distance_to(part.shape, exact(pointer));
        if (off > least || (off == least && part.shape.depth >= depth)) continue;
        least = off, depth = part.shape.depth, best = part.shape.handle;
    }
    return best;
}

std::vector<GizmoShape> Gizmo::shapes(GizmoHandle highlighted) const {
    std::vector<GizmoShape> shapes;
    for (const Part& part : parts_) {
        shapes.push_back(part.shape);
        shapes.back().highlighted = highlighted != GizmoHandle::none && part.shape.handle == highlighted;
    }
    std::ranges::stable_sort(shapes, [](const GizmoShape& a, const GizmoShape& b) { return a.depth > b.depth; });
    return shapes;
}

std::optional<GizmoDrag> Gizmo::start_drag(GizmoHandle handle, Vec2 pointer) const {
    if (!visible() || handle == GizmoHandle::none || !finite(pointer)) return std::nullopt;
    return GizmoDrag(view_, frame_, handle, pointer, size_ / meters_);
}

}  // namespace weft::editor
