// A rigid shape that cloth touches.
#pragma once

#include "base/transform.h"
#include "scene/scene_desc.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

/// Particles that are within `distance` of the surface where a frame begins are held during that frame to where they
/// are on the collider, each by a spring.
struct Adhesion {
    float distance = 0;    ///< m, >= 0: between the surfaces of cloth and collider
    float compliance = 0;  ///< m/N, >= 0: inverse stiffness of a particle's spring
};

struct Collider {
    std::string name;
    ShapeKind shape{};
    std::array<float, 4> numbers{};             ///< as the shape's kernel file states
    std::array<float, 2> friction{0.4f, 0.3f};  ///< static, kinetic
    std::optional<Adhesion> adhesion = {};      ///< nothing sticks to it without
    Pose pose;                                  ///< where it is now
    std::vector<PoseKey> motion = {};           ///< by ascending time; empty: it stays
    std::optional<Pose> next_pose = {};         ///< where it goes in the next frame, if it is moved from outside
};

Collider make_collider(const ColliderDesc& desc);

/// Where the collider is at a time: between two keys on the straight way, angles likewise; before the first and after
/// the last it stays with them.
Pose pose_at(const Collider& collider, double time);
Vec3 offset_at(std::span<const OffsetKey> keys, double time);

/// m: distance of a world point to the collider's true surface, negative inside.
double signed_distance(const Collider& collider, Vec3 world);
/// And which way is out, unit, in the world.
double signed_distance(const Collider& collider, Vec3 world, Vec3& normal);

}  // namespace weft
