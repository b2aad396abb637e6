#include "view/framing.h"

#include "solver/world/collider_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

constexpr float framing_fov = 32;         // degrees: a short telephoto lens, as for portraits
constexpr float smallest_radius = 1e-3f;  // m
constexpr float omega = 8;                // 1/s, of the spring: it covers 95 % of a distance in 0.6 s
constexpr float aim_margin = 1.1f;        // initial radius of the aim over that of the subject
constexpr float loosest = 1.25f;          // largest radius of the aim over that of the subject

Ball ball_around(const Bounds& bounds) {
    return {bounds.center(), std::max(0.5f * length(bounds.size()), smallest_radius)};
}

Bounds bounds_of_cloths(const Frame& frame) {
    Bounds bounds;
    for (const ClothFrame& cloth : frame.cloths)
        for (const Vec4& p : cloth.positions)
            if (finite(p.xyz())) bounds.include(p.xyz());
    return bounds;
}

Bounds common_part(const Bounds& a, const Bounds& b) {
    const auto larger = [](Vec3 x, Vec3 y) { return Vec3{std::max(x.x, y.x), std::max(x.y, y.y), std::max(x.z, y.z)}; };
    const auto smaller = [](Vec3 x, Vec3 y) {
        return Vec3{std::min(x.x, y.x), std::min(x.y, y.y), std::min(x.z, y.z)};
    };
    return {larger(a.min, b.min), smaller(a.max, b.max)};
}

/// One step of a critically damped spring towards a goal that moves at a constant speed. The exact solution for the
/// error e, e(t) = (e₀ + (ė₀ + ω e₀) t) exp(-ω t), is stable for any step.
template <class Value>
void spring(Value& at, Value& speed, const Value& goal_before, const Value& goal, float seconds) {
    const Value goal_speed = (goal - goal_before) * (1 / seconds);
    const Value left = at - goal_before, closing = speed - goal_speed;
    const Value c = closing + left * omega;
    const float decay = std::exp(-omega * seconds);
    at = goal + (left + c * seconds) * decay;
    speed = goal_speed + (closing - c * (omega * seconds)) * decay;
}

}  // namespace

Subject subject_of(const WorldFrame& world) {
    const Bounds cloths = bounds_of_cloths(world.frame());
    Bounds all = cloths;
    Bounds reach = cloths;
    if (!cloths.empty()) {
        const float diagonal = std::max(length(cloths.size()), smallest_radius);
        const Vec3 around{diagonal, diagonal, diagonal};
        reach = {cloths.min - around, cloths.max + around};
    }
    for (const Collider& collider : world.colliders()) {
        const Bounds solid = bounds_of(collider);
        if (solid.empty()) continue;
        if (cloths.empty()) {
            all.include(solid);
        } else if (solid.overlaps(reach)) {
            all.include(common_part(solid, reach));
        }
    }
    if (all.empty()) all = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
    return {ball_around(cloths.empty() ? all : cloths), ball_around(all)};
}

Camera framing(const Ball& ball, float aspect) {
    const float half = framing_fov / 360 * std::numbers::pi_v<float>;
    const float narrow = std::atan(std::tan(half) * std::min(1.0f, aspect));
    const Vec3 from = normalized(Vec3{0.45f, 0.35f, 1});
    return {ball.center + from * (ball.radius / std::sin(narrow)), ball.center, framing_fov};
}

FollowingCamera::FollowingCamera(const Subject& subject, float aspect) : aspect_(aspect) {
    cut_to(subject);
    before_ = shown_;
}

void FollowingCamera::cut_to(const Subject& subject) {
    before_ = shown_;
    aim_ = {subject.all.center, aim_margin * subject.all.radius};
    shown_ = aim_;
    velocity_ = {};
    growth_ = 0;
}

void FollowingCamera::follow(const Subject& subject, float seconds) {
    before_ = shown_;
    if (!(seconds > 0)) return;
    const Ball aim_before = aim_;
    const Ball& all = subject.all;
    aim_.radius = std::clamp(aim_.radius, all.radius, loosest * all.radius);
    const Vec3 off = all.center - aim_.center;
    const float slack = aim_.radius - all.radius, distance = length(off);
    if (distance > slack) aim_.center += off * (1 - slack / distance);

    spring(shown_.center, velocity_, aim_before.center, aim_.center, seconds);
    spring(shown_.radius, growth_, aim_before.radius, aim_.radius, seconds);
    const float needed = length(subject.cloths.center - shown_.center) + subject.cloths.radius;
    if (shown_.radius < needed) {
        shown_.radius = needed;
        growth_ = std::max(growth_, (needed - before_.radius) / seconds);
    }
}

Camera FollowingCamera::moved_along(const Camera& camera) const {
    const float scale = shown_.radius / before_.radius;
    Camera to = camera;
    to.target = shown_.center + (camera.target - before_.center) * scale;
    to.position = to.target + (camera.position - camera.target) * scale;
    return to;
}

}  // namespace weft
