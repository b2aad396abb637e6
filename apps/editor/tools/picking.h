// What is under the pointer.
#pragma once

#include "base/transform.h"
#include "editor/tools/projection.h"
#include "editor/tools/triangle_tree.h"
#include "solver/world/collider.h"

#include <cstdint>
#include <optional>
#include <span>

namespace weft::editor {

/// A cloth (without a pose) or a collider. What has neither a tree nor a plane is never met: an object that is hidden
/// or locked keeps its place in the list.
struct PickSurface {
    const TriangleTree* tree = nullptr;  ///< in its own frame
    Pose pose = {};
    std::optional<PlaneDesc> plane = {};  ///< a unit normal and the offset in m, in its own frame
};

/// `tree`: of mesh_of(collider); not used for a plane.
PickSurface pick_surface(const Collider& collider, const TriangleTree* tree);

/// A symbol of constant size: a wind source, a stitch, a pin.
struct PickMarker {
    Vec3 place;           ///< m
    float radius = 8;     ///< pixels
    bool through = true;  ///< drawn over surfaces: can be picked behind them
};

struct PickScene {
    std::span<const PickSurface> cloths = {}, colliders = {};
    std::span<const PickMarker> markers = {};
};

enum class PickKind { nothing, cloth, collider, marker };

struct Pick {
    PickKind kind = PickKind::nothing;
    std::uint32_t index = 0;  ///< in the list of its kind
    float distance = 0;       ///< m, from the eye
    Vec3 point;               ///< m, in the world
    Vec3 normal;              ///< unit, toward the eye; zero for a marker
    // Of a cloth or of a collider's mesh:
    std::uint32_t triangle = none;
    Vec3 weights;                 ///< barycentric
    std::uint32_t vertex = none;  ///< the corner nearest to `point`
};

/// The nearest surface along the ray. `from`, `to`: limits of the distance, m. Planes have both sides.
Pick pick_along(const Ray& ray, const PickScene& scene, float from = 0,
                float to = std::numeric_limits<float>::infinity());

/// The marker nearest to the pointer, within its radius, else the nearest surface that is drawn: nothing nearer than
/// the near plane, and a plane only as far as its ground reaches. Nothing if the pointer is not finite.
Pick pick_at(const Projection& view, Vec2 pixel, const PickScene& scene);

/// Whether no surface hides the point. Surfaces within `tolerance` in m in front of it do not count: the point's own
/// triangles, and cloth that lies on a collider.
bool is_visible(const Projection& view, Vec3 point, const PickScene& scene, float tolerance = 1e-3f);

}  // namespace weft::editor
