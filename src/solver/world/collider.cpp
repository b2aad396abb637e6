#include "solver/world/collider.h"

#include "physics/contact/shapes.def"
#include "physics/scalar.h"

#include <algorithm>

namespace weft {
namespace {

#define WEFT_SHAPE(name, Name)                                    \
    void set_shape(Collider& collider, const Name##Desc& shape) { \
        collider.shape = ShapeKind::name;                         \
        collider.numbers = shape_numbers(shape);                  \
        collider.bounds = shape_bounds(shape);                    \
        collider.roundness = shape_roundness(shape);              \
    }
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE

// The keys before and after `time`, and the position between them, 0…1.
template <class Key>
struct Between {
    const Key &before, &after;
    float fraction;
};
template <class Key>
Between<Key> find_between(std::span<const Key> keys, double time) {
    const auto later = [](double at, const Key& key) { return at < static_cast<double>(key.time); };
    const auto after = static_cast<std::size_t>(std::upper_bound(keys.begin(), keys.end(), time, later) - keys.begin());
    if (after == 0) return {keys.front(), keys.front(), 0};
    if (after == keys.size()) return {keys.back(), keys.back(), 0};
    const double from = keys[after - 1].time, to = keys[after].time;
    return {keys[after - 1], keys[after], static_cast<float>((time - from) / (to - from))};
}

Vec3 mix(Vec3 a, Vec3 b, float fraction) {
    return a + (b - a) * fraction;
}

}  // namespace

Pose pose_at(const Collider& collider, double time) {
    if (collider.motion.empty()) return collider.pose;
    const PoseKey key = key_at(collider.motion, time);
    return {rotation_from_degrees(key.rotation_degrees), key.position};
}

PoseKey key_at(std::span<const PoseKey> keys, double time) {
    const auto [before, after, fraction] = find_between(keys, time);
    return {.time = static_cast<float>(time),
            .position = mix(before.position, after.position, fraction),
            .rotation_degrees = mix(before.rotation_degrees, after.rotation_degrees, fraction)};
}

Vec3 offset_at(std::span<const OffsetKey> keys, double time) {
    if (keys.empty()) return {};
    const auto [before, after, fraction] = find_between(keys, time);
    return mix(before.offset, after.offset, fraction);
}

Collider make_collider(const ColliderDesc& desc, std::shared_ptr<const ShapeData> data) {
    Collider collider{.name = desc.name, .friction = desc.friction, .pose = {}, .motion = desc.motion, .next_pose = {}};
    std::visit([&](const auto& shape) { set_shape(collider, shape); }, desc.shape);
    if (data) {
        collider.bounds.min = collider.bounds.min + data->bounds.min;
        collider.bounds.max = collider.bounds.max + data->bounds.max;
    }
    collider.data = std::move(data);
    collider.pose = {rotation_from_degrees(desc.transform.rotation_degrees), desc.transform.position};
    collider.pose = pose_at(collider, 0);
    return collider;
}

double signed_distance(const Collider& collider, Vec3 world) {
    Vec3 normal;
    return signed_distance(collider, world, normal);
}

double signed_distance(const Collider& collider, Vec3 world, Vec3& out) {
    const Vec3 local = to_local(collider.pose, world);
    const reference::vec3 p(local.x, local.y, local.z);
    const reference::ShapeNumbers numbers{collider.numbers[0], collider.numbers[1], collider.numbers[2],
                                          collider.numbers[3], blocks_of(collider)};
    reference::vec3 normal{0, 0, 0};
    double distance = 0;
    switch (collider.shape) {
#define WEFT_SHAPE(name, Name)                                     \
    case ShapeKind::name:                                          \
        distance = reference::distance_##name(p, numbers, normal); \
        break;
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    }
    out = collider.pose.rotation *
          Vec3{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)};
    return distance;
}

}  // namespace weft
