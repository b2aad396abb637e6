#include "solver/state/body_state.h"

#include "solver/state/body_kernels.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// After Shepperd 1978, "Quaternion from Rotation Matrix": the largest of the four numbers first.
Vec4 quaternion_of(const Mat3& r) {
    const float trace = r.x.x + r.y.y + r.z.z;
    const float largest = std::max({trace, r.x.x, r.y.y, r.z.z});
    Vec4 q;
    if (largest == trace) {
        q = {r.y.z - r.z.y, r.z.x - r.x.z, r.x.y - r.y.x, 1 + trace};
    } else if (largest == r.x.x) {
        q = {1 + 2 * r.x.x - trace, r.x.y + r.y.x, r.z.x + r.x.z, r.y.z - r.z.y};
    } else if (largest == r.y.y) {
        q = {r.x.y + r.y.x, 1 + 2 * r.y.y - trace, r.y.z + r.z.y, r.z.x - r.x.z};
    } else {
        q = {r.z.x + r.x.z, r.y.z + r.z.y, 1 + 2 * r.z.z - trace, r.x.y - r.y.x};
    }
    const float inv = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x * inv, q.y * inv, q.z * inv, q.w * inv};
}

Vec4 block(Vec3 v) {
    return {v.x, v.y, v.z, 0};
}

}  // namespace

BodyState body_state_at(const Pose& pose, const BodyMass& mass, Vec3 velocity, Vec3 rate) {
    using namespace scalar;
    BodyState state;
    state.place = block(to_world(pose, mass.center));
    state.turn = quaternion_of(pose.rotation);
    state.velocity = block(velocity);
    const BodyInertia inertia = inertia_of(mass);
    const Turn turn = turn_of(state.turn);
    const vec3 spin = turned(
        turn, times_symmetric(inertia.moments, inertia.products, turned_back(turn, vec3(rate.x, rate.y, rate.z))));
    state.spin = {spin.x, spin.y, spin.z, 0};
    return state;
}

Pose pose_of(const BodyState& state, const BodyMass& mass) {
    const Mat3 rotation = rotation_of(state.turn);
    return {rotation, state.place.xyz() - rotation * mass.center};
}

Vec3 rate_of(const BodyState& state, const BodyMass& mass) {
    const scalar::vec3 rate = scalar::rate_of(
        scalar::turn_of(state.turn), scalar::vec3(state.spin.x, state.spin.y, state.spin.z), scalar::inertia_of(mass));
    return {rate.x, rate.y, rate.z};
}

double kinetic_energy(const BodyState& state, const BodyMass& mass) {
    const Vec3 v = state.velocity.xyz(), spin = state.spin.xyz(), rate = rate_of(state, mass);
    const auto product = [](Vec3 a, Vec3 b) {
        return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z};
    };
    return 0.5 * (double{mass.mass} * product(v, v) + product(spin, rate));
}

bool is_finite(const BodyState& state) {
    const auto all = [](const Vec4& v) { return finite(v.xyz()) && std::isfinite(v.w); };
    return all(state.place) && all(state.turn) && all(state.velocity) && all(state.spin) && all(state.v_dropped) &&
           all(state.x_dropped);
}

}  // namespace weft
