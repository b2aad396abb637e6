// A rigid shape that cloth touches.
#pragma once

#include "base/transform.h"
#include "scene/scene_desc.h"

#include <array>
#include <string>

namespace weft {

enum class ShapeKind : std::uint32_t {
#define WEFT_SHAPE(name, Name) name,
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
};

#define WEFT_SHAPE(name, Name) +1
inline constexpr std::uint32_t shape_kind_count = 0
#include "physics/contact/shapes.def"
    ;
#undef WEFT_SHAPE

struct Collider {
    std::string name;
    ShapeKind shape{};
    std::array<float, 4> numbers{};             ///< as the shape's kernel file states
    std::array<float, 2> friction{0.4f, 0.3f};  ///< static, kinetic
    Pose pose;
};

Collider make_collider(const ColliderDesc& desc);

/// m: distance of a world point to the collider's true surface, negative inside.
double signed_distance(const Collider& collider, Vec3 world);

}  // namespace weft
