#include "editor/tools/camera_moves.h"

#include "render/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::editor {
namespace {

constexpr float height_turns = 180;               // degrees per drag over the view's height
constexpr double closest = 0.01, farthest = 1e5;  // m, to the target
constexpr float faster = 4, slowest = 0.25f;
constexpr float longest_pause = 0.25f;  // s: limits the way after a delayed frame
constexpr float smallest_ball = 1e-3f;  // m

bool sound(const Camera& camera) {
    return finite(camera.position) && finite(camera.target) && std::isfinite(camera.fov);
}

// The first camera if something went beyond what floats can hold.
Camera checked(const Camera& before, const Camera& after) {
    return sound(after) ? after : before;
}

float turn_per_pixel(Vec2 view_size) {
    return height_turns / std::max(1.0f, view_size.y);
}

float held(const FlyInput& input, char more, char less) {
    return static_cast<float>(input.held[static_cast<std::size_t>(more)]) -
           static_cast<float>(input.held[static_cast<std::size_t>(less)]);
}

// To the right, up and ahead, each -1, 0 or 1.
Vec3 direction_of_keys(const FlyInput& input) {
    if (input.map == FlyKeys::source) return {held(input, 'D', 'A'), held(input, 'W', 'S'), held(input, 'E', 'Q')};
    return {held(input, 'D', 'A'), held(input, 'E', 'Q'), held(input, 'W', 'S')};
}

// From the target to the eye: angles in radians and the length.
struct Aim {
    double heading, tilt, distance;
};

Aim aim_of(const Camera& camera) {
    const Double3 v = exact(camera.position) - exact(camera.target);
    const double across = std::hypot(v.x, v.z);
    return {across > 0 ? std::atan2(v.x, v.z) : 0, across > 0 || v.y != 0 ? std::atan2(v.y, across) : 0, length(v)};
}

}  // namespace

Camera orbited_by(const Camera& camera, Vec2 by, Vec2 view_size) {
    if (!finite(by) || by == Vec2{}) return camera;
    const float turn = turn_per_pixel(view_size);
    return checked(camera, render::orbited(camera, -by.x * turn, by.y * turn));
}

Camera looked_by(const Camera& camera, Vec2 by, Vec2 view_size) {
    if (!finite(by) || by == Vec2{}) return camera;
    const float turn = turn_per_pixel(view_size);
    return checked(camera, render::turned(camera, by.x * turn, -by.y * turn));
}

Camera panned_by(const Camera& camera, Vec2 by, Vec2 view_size, std::optional<double> depth) {
    const Projection view(camera, view_size);
    if (!view.valid() || !finite(by) || (depth && !(*depth > 0))) return camera;
    const double at = depth.value_or(length(exact(camera.target) - exact(camera.position)));
    const Vec3 move = rounded(view.direction_to_world(Double3{-exact(by).x, -exact(by).y, 0} * (at / view.focal())));
    Camera to = camera;
    to.position += move;
    to.target += move;
    return checked(camera, to);
}

Camera dollied(const Camera& camera, float notches, Vec2 pointer, Vec2 view_size, std::optional<Vec3> under) {
    const Projection view(camera, view_size);
    if (!view.valid() || !std::isfinite(notches) || !finite(pointer) || (under && !finite(*under))) return camera;
    const Double3 eye = exact(camera.position), target = exact(camera.target);
    const double distance = length(target - eye);
    const Double3 toward = under ? exact(*under) : view.to_world(view.direction_at(exact(pointer)) * distance);
    const double least = std::min(closest, distance), most = std::max(farthest, distance);
    const double factor = std::clamp(distance * std::pow(0.9, static_cast<double>(notches)), least, most) / distance;
    Camera to = camera;
    to.position = rounded(toward + (eye - toward) * factor);
    to.target = rounded(toward + (target - toward) * factor);
    return to.position == to.target ? camera : checked(camera, to);
}

bool flies(const FlyInput& input) {
    return direction_of_keys(input) != Vec3{};
}

Camera flown(const Camera& camera, const FlyInput& input) {
    const Vec3 go = direction_of_keys(input);
    if (go == Vec3{} || !(input.seconds > 0)) return camera;
    const float radius = std::isfinite(input.scene_radius) ? std::max(0.0f, input.scene_radius) : 0.0f;
    const float speed = std::max(length(camera.target - camera.position), slowest * radius);
    const float way = speed * (input.fast ? faster : 1.0f) * std::min(input.seconds, longest_pause);
    return checked(camera, render::moved(camera, go.x * way, go.y * way, go.z * way));
}

Camera framed(const Camera& camera, const Bounds& box, Vec2 view_size) {
    if (box.empty() || !finite(box.min) || !finite(box.max) || !sound(camera)) return camera;
    if (!finite(view_size) || !(view_size.x > 0) || !(view_size.y > 0)) return camera;
    const double radius = std::max(0.5 * length(exact(box.max) - exact(box.min)), static_cast<double>(smallest_ball));
    const double half = static_cast<double>(camera.fov) * std::numbers::pi / 360;
    const double aspect = static_cast<double>(view_size.x) / static_cast<double>(view_size.y);
    const double narrow = std::atan(std::tan(half) * std::min(1.0, aspect));
    Double3 back = normalized(exact(camera.position) - exact(camera.target));
    if (!(length(back) > 0)) back = {0, 0, 1};
    Camera to = camera;
    to.target = rounded((exact(box.min) + exact(box.max)) * 0.5);
    to.position = rounded(exact(to.target) + back * (radius / std::sin(narrow)));
    return checked(camera, to);
}

Camera seen_from(const Camera& camera, ViewFrom side) {
    constexpr Vec3 sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    Camera to = camera;
    to.position = camera.target + sides[static_cast<std::size_t>(side)] * length(camera.position - camera.target);
    return checked(camera, to);
}

Camera camera_between(const Camera& from, const Camera& to, float fraction) {
    if (!(fraction > 0)) return from;
    if (fraction >= 1 || !sound(from) || !sound(to)) return to;
    const auto f = static_cast<double>(fraction);
    const double s = f * f * (3 - 2 * f);
    const Aim a = aim_of(from), b = aim_of(to);
    if (!(a.distance > 0) || !(b.distance > 0)) return to;
    // A camera that looks straight up or down counts as one with heading 0, as image_up() has it.
    const double turn = std::remainder(b.heading - a.heading, 2 * std::numbers::pi);
    const double heading = a.heading + turn * s, tilt = a.tilt + (b.tilt - a.tilt) * s;
    const double distance = a.distance * std::pow(b.distance / a.distance, s);
    Camera now = to;
    now.fov = static_cast<float>(static_cast<double>(from.fov) + (static_cast<double>(to.fov - from.fov)) * s);
    now.target = rounded(exact(from.target) + (exact(to.target) - exact(from.target)) * s);
    const Double3 offset{std::cos(tilt) * std::sin(heading), std::sin(tilt), std::cos(tilt) * std::cos(heading)};
    now.position = rounded(exact(now.target) + offset * distance);
    return checked(to, now);
}

}  // namespace weft::editor
