#include "editor/tools/gizmo_drag.h"

#include "base/transform.h"
#include "editor/tools/euler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::editor {
namespace {

constexpr double end_on = 0.1;      // sine of the angle to the line of sight
constexpr double depth_range = 20;  // of a drag, over the depth of its start
constexpr double least_factor = 0.01;
constexpr double handle_end = 1.2;  // in sizes of the gizmo: nothing of a handle that moves is farther from the center
constexpr double drag_degree = 180 / std::numbers::pi;

bool between(GizmoHandle handle, GizmoHandle first, GizmoHandle last) {
    return handle >= first && handle <= last;
}

std::size_t number_of(GizmoHandle handle, GizmoHandle first) {
    return static_cast<std::size_t>(handle) - static_cast<std::size_t>(first);
}

double in_steps(double value, float step) {
    const auto s = static_cast<double>(step);
    return s > 0 ? std::round(value / s) * s + 0.0 : value;  // no -0
}

// In pixels, the way of a point of the view's frame that moves.
Double2 image_of(const Projection& view, Double3 at, Double3 way) {
    return Double2{way.x * at.z - at.x * way.z, way.y * at.z - at.y * way.z} * (view.focal() / (at.z * at.z));
}

Double2 unit(Double2 v) {
    const double l = length(v);
    return l > 0 ? v * (1 / l) : Double2{};
}

}  // namespace

GizmoDragFrame gizmo_frame(const GizmoPlace& place, GizmoKind kind, GizmoAxes axes) {
    GizmoDragFrame frame{place, {Double3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (kind == GizmoKind::scale || axes == GizmoAxes::local) {
        const Mat3 rotation = rotation_from_degrees(place.rotation_degrees);
        frame.axes = {exact(rotation.x), exact(rotation.y), exact(rotation.z)};
    }
    return frame;
}

GizmoDrag::GizmoDrag(const Projection& view, const GizmoDragFrame& frame, GizmoHandle handle, Vec2 pointer, double size)
    : view_(view), frame_(frame), handle_(handle), pointer_(exact(pointer)), size_(size) {
    center_ = view.to_view(exact(frame.place.position));
    for (std::size_t i = 0; i < 3; ++i) axes_[i] = view.direction_to_view(frame.axes[i]);
    if (between(handle, GizmoHandle::turn_x, GizmoHandle::turn_view)) start_turn(pointer_);
}

// Finds the point of the ring nearest to the pointer on the half that faces the eye, and the direction in which it
// moves on the image.
void GizmoDrag::start_turn(Double2 pointer) {
    const Double3 toward_eye = normalized(center_ * -1);
    Double3 axis = toward_eye;
    around_ = view_.direction_to_world(axis);
    radius_ = size_ * outer_ring;
    if (handle_ != GizmoHandle::turn_view) {
        const std::size_t i = number_of(handle_, GizmoHandle::turn_x);
        axis = axes_[i], around_ = frame_.axes[i], radius_ = size_;
    }
    Double3 nearest_to_eye = toward_eye - axis * dot(axis, toward_eye);
    const bool whole = length(nearest_to_eye) < ring_front;
    if (whole) nearest_to_eye = cross(axis, std::abs(axis.x) < 0.7 ? Double3{1, 0, 0} : Double3{0, 1, 0});
    const Double3 u = normalized(nearest_to_eye), v = cross(axis, u);
    const double radius = radius_ * center_.z / view_.focal();
    constexpr int steps = 360;
    const int reach = whole ? steps / 2 : steps / 4;
    double least = 0;
    Double3 grabbed = u, way = v;
    for (int i = -reach; i <= reach; ++i) {
        const double angle = i * 2 * std::numbers::pi / steps;
        const Double3 direction = u * std::cos(angle) + v * std::sin(angle);
        const Double3 at = center_ + direction * radius;
        const double off = length(view_.pixel_of(at) - pointer);
        if (i > -reach && off >= least) continue;
        least = off, grabbed = direction, way = cross(axis, direction);
    }
    // A ring seen end on has no tangent near its ends.
    constexpr double short_tangent = 0.3;
    Double2 tangent = image_of(view_, center_ + grabbed * radius, way * radius);
    if (length(tangent) < short_tangent * radius_) tangent = image_of(view_, center_ + u * radius, v * radius);
    tangent_ = unit(tangent);
}

// A point of the axis at s meters from the center c is at the pixel c + w · u(s), with
//     u(s) = F k s / (z + a s),
// where w is the direction of the axis on the image, k its length at depth 1, z the depth of the center and a the
// axis' part along the view. So s = u z / (F k - a u), and the depth there is z F k / (F k - a u).
//
// The handle was grabbed at g meters from the center. The gizmo keeps its size on the image, so at the depth z' the
// grabbed point is at g z'/z meters from the center. If the pointer is over the point q of the axis, the center has
// moved by s with q = s + g (1 + a s / z).
double GizmoDrag::moved_along(Double3 axis, Double2 way) const {
    const double z = center_.z, focal = view_.focal();
    const Double2 across{axis.x - center_.x / z * axis.z, axis.y - center_.y / z * axis.z};
    const double k = length(across);
    const double sine = length(cross(axis, normalized(center_)));
    if (sine < end_on) {
        const Double2 along = k > 1e-3 ? across * (1 / k) : Double2{0, axis.z > 0 ? -1.0 : 1.0};
        double s = dot(way, along) * z / focal;
        const double depth = std::clamp(z + s * axis.z, z / depth_range, z * depth_range);
        if (depth != z + s * axis.z) s = (depth - z) / axis.z;
        return s;
    }
    const double slope = axis.z / (focal * k);  // z over the depth is 1 - slope · u
    const auto point = [&](double u, double nearness) { return u * z / (focal * k * nearness); };
    const double longest = handle_end * size_ * z / focal;
    double from = dot(pointer_ - view_.pixel_of(center_), across) / k;
    const double near_pointer = 1 - slope * from;
    const double g = near_pointer > 0 ? std::clamp(point(from, near_pointer), -longest, longest) : 0;
    from = focal * k * g / (z + axis.z * g);
    const double start = 1 - slope * from, to = from + dot(way, across) / k;
    const double wanted = (1 - slope * to) / start, nearness = std::clamp(wanted, 1 / depth_range, depth_range);
    if (nearness != wanted) return z * (1 / nearness - 1) / axis.z;
    return (point(to, 1 - slope * to) - point(from, start)) / (1 + axis.z * g / z);
}

// The inverse of the depth changes linearly over the image of a plane, so a drag ends where it reaches its limits.
std::array<double, 2> GizmoDrag::moved_within(Double3 u, Double3 v, Double2 way) const {
    const Double3 normal = cross(u, v);
    const double height = dot(normal, center_);
    if (std::abs(height) < end_on * length(center_)) {
        // Seen end on, the plane is a line on the image: the way along it follows the pointer, the way across it
        // moves the object away from the eye and back.
        const Double3 level = normalized(cross(normal, normalized(center_)));
        const Double3 away = cross(level, normal);
        const double sign = dot(away, center_) < 0 ? -1 : 1;
        const Double2 along = unit(image_of(view_, center_, level));
        const Double2 across = unit({along.y, -along.x});
        const double up = across.y <= 0 ? dot(way, across) : -dot(way, across);
        const double meters = center_.z / view_.focal();
        const double deepest = (depth_range - 1) * center_.z, nearest = (1 / depth_range - 1) * center_.z;
        const double s = moved_along(level, along * dot(way, along)), t = std::clamp(up * meters, nearest, deepest);
        const Double3 move = level * s + away * (sign * t);
        return {dot(move, u), dot(move, v)};
    }
    const auto nearness_at = [&](Double2 pixel) { return dot(normal, view_.direction_at(pixel)) / height; };
    const auto point = [&](Double2 pixel) { return view_.direction_at(pixel) * (1 / nearness_at(pixel)); };
    // Where the square was grabbed, from the center: at another depth it is larger with the gizmo.
    Double3 grabbed = nearness_at(pointer_) > 0 ? point(pointer_) - center_ : Double3{};
    const double longest = handle_end * size_ * center_.z / view_.focal();
    if (length(grabbed) > longest) grabbed = grabbed * (longest / length(grabbed));
    const Double2 from = view_.pixel_of(center_ + grabbed);
    const double n0 = nearness_at(from), n1 = nearness_at(from + way);
    double part = 1;
    if (n1 < n0 / depth_range) part = (n0 / depth_range - n0) / (n1 - n0);
    if (n1 > n0 * depth_range) part = (n0 * depth_range - n0) / (n1 - n0);
    const Double3 way_in_plane = point(from + way * part) - point(from);
    const Double3 growth = grabbed * (1 / center_.z);  // per meter of depth
    const Double3 move = way_in_plane - growth * (way_in_plane.z / (1 + growth.z));
    return {dot(move, u), dot(move, v)};
}

// Meters along the three axes.
Vec3 GizmoDrag::moved(Double2 way) const {
    std::array<double, 3> amount{};
    if (between(handle_, GizmoHandle::move_x, GizmoHandle::move_z)) {
        const std::size_t i = number_of(handle_, GizmoHandle::move_x);
        amount[i] = moved_along(axes_[i], way);
    } else if (handle_ == GizmoHandle::move_view) {
        const Double3 move = Double3{way.x, way.y, 0} * (center_.z / view_.focal());
        for (std::size_t i = 0; i < 3; ++i) amount[i] = dot(move, axes_[i]);
    } else {
        const std::size_t i = number_of(handle_, GizmoHandle::move_yz), u = (i + 1) % 3, v = (i + 2) % 3;
        const auto within = moved_within(axes_[u], axes_[v], way);
        amount[u] = within[0], amount[v] = within[1];
    }
    return rounded(Double3{amount[0], amount[1], amount[2]});
}

double GizmoDrag::turned(Double2 way) const {
    return dot(way, tangent_) / radius_ * drag_degree;
}

Vec3 GizmoDrag::scaled(Double2 way) const {
    if (handle_ == GizmoHandle::scale_all) {
        const auto f = static_cast<float>(std::max(1 + (way.x - way.y) / size_, least_factor));
        return {f, f, f};
    }
    const std::size_t i = number_of(handle_, GizmoHandle::scale_x);
    const double meters = size_ * center_.z / view_.focal();
    Double2 handle = image_of(view_, center_, axes_[i] * meters);
    constexpr double shortest = 0.3;  // of the gizmo's size: seen end on, a small way is no large factor
    if (!(length(handle) > 1e-3 * size_)) handle = {0, -1};
    const double at = std::max(length(handle), shortest * size_);
    std::array<double, 3> factor{1, 1, 1};
    factor[i] = std::max(1 + dot(way, unit(handle)) / at, least_factor);
    return rounded(Double3{factor[0], factor[1], factor[2]});
}

GizmoChange GizmoDrag::by(Vec3 amount) const {
    GizmoChange change{.place = frame_.place, .amount = amount};
    if (!finite(amount)) return {.place = frame_.place, .amount = {}};
    if (between(handle_, GizmoHandle::move_x, GizmoHandle::move_view)) {
        const Double3 by = exact(amount);
        const Double3 move = frame_.axes[0] * by.x + frame_.axes[1] * by.y + frame_.axes[2] * by.z;
        change.place.position = rounded(exact(frame_.place.position) + move);
    } else if (between(handle_, GizmoHandle::turn_x, GizmoHandle::turn_view)) {
        change.place.rotation_degrees =
            turned_angles(frame_.place.rotation_degrees, rounded(around_), static_cast<double>(amount.x));
    } else if (between(handle_, GizmoHandle::scale_x, GizmoHandle::scale_all)) {
        const auto factor = [](float f) { return std::max(f, static_cast<float>(least_factor)); };
        change.scale = {factor(amount.x), factor(amount.y), factor(amount.z)};
    }
    return change;
}

GizmoChange GizmoDrag::at(Vec2 pointer, const GizmoSnap& snap) const {
    const Double2 way = exact(pointer) - pointer_;
    const GizmoChange unchanged{.place = frame_.place, .amount = {}};
    if (!finite(pointer) || handle_ == GizmoHandle::none) return unchanged;
    const auto stepped = [](Vec3 v, float step, double from) {
        const auto one = [&](float x) {
            return static_cast<float>(from + in_steps(static_cast<double>(x) - from, step));
        };
        return Vec3{one(v.x), one(v.y), one(v.z)};
    };
    if (between(handle_, GizmoHandle::move_x, GizmoHandle::move_view)) return by(stepped(moved(way), snap.length, 0));
    if (between(handle_, GizmoHandle::turn_x, GizmoHandle::turn_view))
        return by({static_cast<float>(in_steps(turned(way), snap.angle)), 0, 0});
    return by(stepped(scaled(way), snap.factor, 1));
}

}  // namespace weft::editor
