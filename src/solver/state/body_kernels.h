// The numbers of a body as its kernels take them, on one lane.
#pragma once

#include "physics/scalar.h"
#include "solver/state/body_state.h"

namespace weft::scalar {

#include "physics/body/faces.kernel.h"
#include "physics/body/pairs.kernel.h"

inline vec3 vector_of(Vec3 v) {
    return {v.x, v.y, v.z};
}
inline Vec3 vector_of(vec3 v) {
    return {v.x, v.y, v.z};
}

inline Turn turn_of(const Vec4& q) {
    return {q.x, q.y, q.z, q.w};
}

inline BodyInertia inertia_of(const BodyMass& mass) {
    const auto first = [](const std::array<float, 6>& a) { return vec3(a[0], a[1], a[2]); };
    const auto last = [](const std::array<float, 6>& a) { return vec3(a[3], a[4], a[5]); };
    return {first(mass.inertia), last(mass.inertia), first(mass.inverse_inertia), last(mass.inverse_inertia)};
}

inline BodyMotion motion_of(const BodyState& state) {
    const auto of = [](const Vec4& v) { return vec3(v.x, v.y, v.z); };
    return {of(state.place), turn_of(state.turn), of(state.velocity),
            of(state.spin),  of(state.v_dropped), of(state.x_dropped)};
}

inline BodyState state_of(const BodyMotion& m) {
    const auto of = [](vec3 v) { return Vec4{v.x, v.y, v.z, 0}; };
    return {of(m.place),    {m.turn.x, m.turn.y, m.turn.z, m.turn.w}, of(m.v), of(m.spin), of(m.v_dropped),
            of(m.x_dropped)};
}

/// The columns of the rotation.
inline Mat3 columns_of(const Turn& turn) {
    return {vector_of(turned(turn, vec3(1, 0, 0))), vector_of(turned(turn, vec3(0, 1, 0))),
            vector_of(turned(turn, vec3(0, 0, 1)))};
}

}  // namespace weft::scalar

namespace weft {

inline Mat3 rotation_of(const Vec4& turn) {
    return scalar::columns_of(scalar::turn_of(turn));
}

}  // namespace weft
