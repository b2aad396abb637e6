#include "render/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::render {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;
// Just below 90 degrees, so that the up direction of the image stays defined.
constexpr float steepest = 89.9f * degree;
constexpr float height_turns = 180;  // degrees per drag over the window's height
constexpr float nearest = 0.01f, farthest = 1e5f;
constexpr float longest_pause = 0.1f;  // s: limits the move after a delayed frame

// A direction as angles and a length.
struct Polar {
    float right = 0, up = 0, length = 0;
};

Polar polar(Vec3 v) {
    const float across = std::hypot(v.x, v.z);
    return {across > 0 ? std::atan2(v.x, v.z) : 0, std::atan2(v.y, across), length(v)};
}

Vec3 vector(Polar p) {
    const float across = p.length * std::cos(p.up);
    return {across * std::sin(p.right), p.length * std::sin(p.up), across * std::cos(p.right)};
}

Vec3 swung(Vec3 v, float right, float up) {
    Polar p = polar(v);
    p.right += right * degree;
    p.up = std::clamp(p.up + up * degree, -steepest, steepest);
    return vector(p);
}

}  // namespace

Camera orbited(const Camera& camera, float right, float up) {
    Camera to = camera;
    to.position = camera.target + swung(camera.position - camera.target, right, up);
    return to;
}

Camera turned(const Camera& camera, float right, float up) {
    Camera to = camera;
    to.target = camera.position + swung(camera.target - camera.position, -right, up);
    return to;
}

Camera moved(const Camera& camera, float right, float up, float forward) {
    const Vec3 ahead = normalized(camera.target - camera.position);
    Vec3 side = normalized(cross(ahead, {0, 1, 0}));
    if (side == Vec3{}) side = {1, 0, 0};
    const Vec3 by = side * right + cross(side, ahead) * up + ahead * forward;
    Camera to = camera;
    to.position += by;
    to.target += by;
    return to;
}

Camera zoomed(const Camera& camera, float notches) {
    const Vec3 away = camera.position - camera.target;
    const float from = length(away);
    if (from <= 0) return camera;
    Camera to = camera;
    to.position = camera.target + away * (std::clamp(from * std::pow(0.9f, notches), nearest, farthest) / from);
    return to;
}

Camera steered(const Camera& camera, const WindowInput& input) {
    Camera to = camera;
    const float turn = height_turns / std::max(1.0f, input.height);
    const Vec2 around = input.shift ? Vec2{} : input.left;
    const Vec2 along = input.shift ? Vec2{input.middle.x + input.left.x, input.middle.y + input.left.y} : input.middle;
    // The scene follows the pointer.
    if (around != Vec2{}) to = orbited(to, -around.x * turn, around.y * turn);
    if (along != Vec2{}) {
        const float unit =
            2 * length(to.target - to.position) * std::tan(to.fov / 2 * degree) / std::max(1.0f, input.height);
        to = moved(to, -along.x * unit, along.y * unit, 0);
    }
    if (input.right != Vec2{}) to = turned(to, input.right.x * turn, -input.right.y * turn);
    if (input.scroll != 0) to = zoomed(to, input.scroll);

    const auto key = [&](char more, char less) {
        return static_cast<float>(input.held[static_cast<std::size_t>(more)]) -
               static_cast<float>(input.held[static_cast<std::size_t>(less)]);
    };
    const Vec3 go{key('D', 'A'), key('W', 'S'), key('E', 'Q')};
    if (go != Vec3{}) {  // one distance to the target per second
        const float step = length(to.target - to.position) * std::clamp(input.seconds, 0.0f, longest_pause);
        to = moved(to, go.x * step, go.y * step, go.z * step);
    }
    return to;
}

}  // namespace weft::render
