#include "solver/collider.h"

#include "physics/scalar.h"

namespace weft {
namespace {

void set_shape(Collider& collider, const PlaneDesc& plane) {
    const Vec3 n = normalized(plane.normal);
    collider.shape = ShapeKind::plane;
    collider.numbers = {n.x, n.y, n.z, plane.offset};
}

void set_shape(Collider& collider, const SphereDesc& sphere) {
    collider.shape = ShapeKind::sphere;
    collider.numbers = {sphere.radius, 0, 0, 0};
}

}  // namespace

Collider make_collider(const ColliderDesc& desc) {
    Collider collider{.name = desc.name,
                      .friction = desc.friction,
                      .pose = {rotation_from_degrees(desc.transform.rotation_degrees), desc.transform.position}};
    std::visit([&](const auto& shape) { set_shape(collider, shape); }, desc.shape);
    return collider;
}

double signed_distance(const Collider& collider, Vec3 world) {
    const Vec3 local = to_local(collider.pose, world);
    const reference::vec3 p(local.x, local.y, local.z);
    const reference::ShapeNumbers numbers{collider.numbers[0], collider.numbers[1], collider.numbers[2],
                                          collider.numbers[3]};
    reference::vec3 normal;
    switch (collider.shape) {
#define WEFT_SHAPE(name, Name) \
    case ShapeKind::name:      \
        return reference::distance_##name(p, numbers, normal);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    }
    return 0;
}

}  // namespace weft
