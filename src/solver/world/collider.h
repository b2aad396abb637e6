// A rigid shape that cloth collides with.
#pragma once

#include "base/transform.h"
#include "collide/shape_data.h"
#include "scene/scene_desc.h"
#include "solver/model/cloth_model.h"
#include "solver/world/body.h"
#include "solver/world/keys.h"

#include <algorithm>
#include <array>
#include <memory>
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

/// Adhesion: each particle within `distance` of the surface at the start of a frame is held during that frame by a
/// spring to its position relative to the collider.
struct Adhesion {
    float distance = 0;    ///< m, >= 0: between the surfaces of cloth and collider
    float compliance = 0;  ///< m/N, >= 0: inverse stiffness of a particle's spring
};

struct Collider {
    std::string name;
    ShapeKind shape{};
    std::array<float, 4> numbers{};              ///< defined in the shape's kernel file
    std::shared_ptr<const ShapeData> data = {};  ///< null if the numbers say everything
    Bounds bounds = {};                          ///< m: box of the shape in its own frame
    float roundness = 0;                         ///< m: the least radius to which the surface is curved outward
    float width = 0;                             ///< m: what passes through it moves at least this far
    std::array<float, 2> friction{0.4f, 0.3f};   ///< static, kinetic
    std::optional<Adhesion> adhesion = {};       ///< nullopt: cloth does not stick
    Pose pose;                                   ///< current pose
    std::vector<PoseKey> motion = {};            ///< by ascending time; empty: no motion by keys
    std::optional<Pose> next_pose = {};          ///< pose at the end of the next frame, set by World::move()
    std::optional<Body> body = {};               ///< nullopt: it moves as it is told
    BodyFeatures features = {};                  ///< what touches bodies first; none of a plane or of a mesh at rest
    /// If not null, cloths that meet surfaces (ClothCollision) meet these triangles instead of the shape.
    std::shared_ptr<const ClothModel> surface = {};
};

/// Whether the shape of the collider acts on a cloth.
inline bool shape_acts_on(const Collider& collider, const ClothModel& cloth) {
    return !collider.surface || !cloth.collision.meets_surfaces();
}

/// The most that the distance to the shape changes per meter.
inline float steepness_of(const Collider& collider) {
    return collider.data ? collider.data->steepness : 1.0f;
}

/// Its roundness, finite: a plane counts as a ball that is as large as any collider.
inline float roundness_of(const Collider& collider) {
    return std::min(collider.roundness, static_cast<float>(far_away));
}

/// Its width, finite.
inline float width_of(const Collider& collider) {
    return std::min(collider.width, static_cast<float>(far_away));
}

/// What the shape's kernel reads besides the numbers.
inline ShapeBlocks blocks_of(const Collider& collider) {
    return collider.data ? collider.data->blocks() : ShapeBlocks{};
}

/// Without a body, and without the features of a mesh (weft/body_building.h). `data`: of the shape, if its kernel reads
/// any.
Collider make_collider(const ColliderDesc& desc, std::shared_ptr<const ShapeData> data = {});

/// Puts a body at the collider's pose, with the velocity and the spin that its description begins with.
void start_body(Collider& collider);

/// Pose of the collider at a time in s. Positions and angles are interpolated linearly between keys, and constant
/// before the first and after the last key.
Pose pose_at(const Collider& collider, double time);

/// Distance in m of a world point to the collider's exact surface, negative inside.
double signed_distance(const Collider& collider, Vec3 world);
/// Also returns the outward unit normal in world space.
double signed_distance(const Collider& collider, Vec3 world, Vec3& normal);

}  // namespace weft
