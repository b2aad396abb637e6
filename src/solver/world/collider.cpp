#include "solver/world/collider.h"

#include "collide/body_features.h"
#include "physics/contact/shapes.def"
#include "physics/scalar.h"

namespace weft {
namespace {

#define WEFT_SHAPE(name, Name)                                    \
    void set_shape(Collider& collider, const Name##Desc& shape) { \
        collider.shape = ShapeKind::name;                         \
        collider.numbers = shape_numbers(shape);                  \
        collider.bounds = shape_bounds(shape);                    \
        collider.roundness = shape_roundness(shape);              \
        collider.width = shape_width(shape);                      \
    }
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE

}  // namespace

Pose pose_at(const Collider& collider, double time) {
    if (collider.motion.empty()) return collider.pose;
    const PoseKey key = key_at(collider.motion, time);
    return {rotation_from_degrees(key.rotation_degrees), key.position};
}

Collider make_collider(const ColliderDesc& desc, std::shared_ptr<const ShapeData> data) {
    Collider collider{.name = desc.name, .friction = desc.friction, .pose = {}, .motion = desc.motion, .next_pose = {}};
    std::visit([&](const auto& shape) { set_shape(collider, shape); }, desc.shape);
    if (data) {
        collider.bounds.min = collider.bounds.min + data->bounds.min;
        collider.bounds.max = collider.bounds.max + data->bounds.max;
        collider.width += data->width;
    }
    if (!std::holds_alternative<SolidMeshDesc>(desc.shape)) collider.features = features_of(desc.shape, data.get());
    collider.data = std::move(data);
    collider.pose = {rotation_from_degrees(desc.transform.rotation_degrees), desc.transform.position};
    collider.pose = pose_at(collider, 0);
    return collider;
}

void start_body(Collider& collider) {
    Body& body = *collider.body;
    body.state = body_state_at(collider.pose, body.mass, body.desc.velocity, body.desc.spin * radians_per_degree);
    collider.pose = pose_of(body.state, body.mass);
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
