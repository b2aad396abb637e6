// Small functions over pairs and particles that the passes of contact between cloths share.
#pragma once

#include "cpu/cloth_contact/contact_loops.h"
#include "physics/scalar.h"

#include <atomic>

namespace weft::cpu {

inline scalar::vec3 on_lane(Vec3 v) {
    return {v.x, v.y, v.z};
}
inline Vec3 to_vec3(scalar::vec3 v) {
    return {v.x, v.y, v.z};
}
inline float squared(Vec3 v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}
inline std::uint32_t to_integer(float quanta) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(quanta));
}
// Adds to a sum. `concurrent`: other threads may do so too.
inline void add_quanta(std::uint32_t& sum, std::uint32_t quanta, bool concurrent) {
    if (concurrent)
        std::atomic_ref(sum).fetch_add(quanta, std::memory_order_relaxed);
    else
        sum += quanta;
}
inline void set_place(Vec4& x, Vec3 place) {
    x = {place.x, place.y, place.z, x.w};
}

inline std::array<float, 4> weights_of(const NearPairs& near, std::uint32_t i) {
    return {near.weight[0][i], near.weight[1][i], near.weight[2][i], near.weight[3][i]};
}
inline Vec3 normal_of(const NearPairs& near, std::uint32_t i) {
    return {near.normal[0][i], near.normal[1][i], near.normal[2][i]};
}

}  // namespace weft::cpu
