#include "editor/tools/picking.h"

#include "look/view_limits.h"

#include <algorithm>
#include <cmath>

namespace weft::editor {
namespace {

Ray to_own_frame(const Pose& pose, const Ray& ray) {
    return {to_local(pose, ray.origin), transposed(pose.rotation) * ray.direction};
}

// Where the ray meets the plane, m; negative if it does not.
double plane_distance(const PlaneDesc& plane, const Ray& own) {
    const Double3 normal = exact(plane.normal);
    const double toward = dot(normal, exact(own.direction));
    const double height = dot(normal, exact(own.origin)) - static_cast<double>(plane.offset);
    return toward != 0 ? -height / toward : -1;
}

Vec3 facing(Vec3 normal, const Ray& ray) {
    return dot(normal, ray.direction) > 0 ? -normal : normal;
}

std::uint32_t nearest_corner(const TriangleTree& tree, const SurfaceHit& hit) {
    std::uint32_t best = none;
    float least = std::numeric_limits<float>::infinity();
    for (const std::uint32_t corner : hit.corners) {
        const float d = length(tree.position(corner) - hit.point);
        if (d < least) least = d, best = corner;
    }
    return best;
}

void pick_surface_along(const Ray& ray, const PickSurface& surface, Pick found, float from, Pick& best) {
    const Ray own = to_own_frame(surface.pose, ray);
    if (surface.plane) {
        const double d = plane_distance(*surface.plane, own);
        if (!(d >= static_cast<double>(from)) || !(d < static_cast<double>(best.distance))) return;
        found.distance = static_cast<float>(d);
        found.normal = facing(surface.pose.rotation * surface.plane->normal, ray);
    } else if (surface.tree) {
        const auto hit = surface.tree->nearest(own, from, best.distance);
        if (!hit || !(hit->distance < best.distance)) return;
        const auto [a, b, c] = hit->corners;
        const Vec3 p = surface.tree->position(a);
        const Vec3 normal = cross(surface.tree->position(b) - p, surface.tree->position(c) - p);
        found.distance = hit->distance;
        found.normal = facing(surface.pose.rotation * normalized(normal), ray);
        found.triangle = hit->triangle, found.weights = hit->weights;
        found.vertex = nearest_corner(*surface.tree, *hit);
    } else {
        return;
    }
    found.point = rounded(exact(ray.origin) + exact(ray.direction) * static_cast<double>(found.distance));
    best = found;
}

bool blocked_by(const Ray& ray, const PickSurface& surface, float from, float to) {
    const Ray own = to_own_frame(surface.pose, ray);
    if (surface.plane) {
        const double d = plane_distance(*surface.plane, own);
        return d >= static_cast<double>(from) && d <= static_cast<double>(to);
    }
    return surface.tree && surface.tree->blocks(own, from, to);
}

// The distance from the eye at which the near plane cuts a ray.
float nearest_along(const Projection& view, const Ray& ray) {
    const double slant = dot(exact(ray.direction), exact(view.ahead()));
    return static_cast<float>(view.nearest_depth() / std::max(slant, 1e-6));
}

// The renderer fades a plane out around the camera's target.
bool ground_is_drawn(const Projection& view, Vec3 point) {
    const Camera& camera = view.camera();
    const float distance = std::max(length(camera.target - camera.position), least_target_distance);
    return length(point - camera.target) <= ground_ends * distance;
}

}  // namespace

PickSurface pick_surface(const Collider& collider, const TriangleTree* tree) {
    PickSurface surface{.tree = tree, .pose = collider.pose};
    if (collider.shape != ShapeKind::plane) return surface;
    const auto& [x, y, z, offset] = collider.numbers;
    surface.tree = nullptr;
    surface.plane = PlaneDesc{{x, y, z}, offset};
    return surface;
}

Pick pick_along(const Ray& ray, const PickScene& scene, float from, float to) {
    Pick best{.distance = to, .point = {}, .normal = {}, .weights = {}};
    const auto search = [&](PickKind kind, std::span<const PickSurface> surfaces) {
        for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
            const Pick found{.kind = kind, .index = i, .point = {}, .normal = {}, .weights = {}};
            pick_surface_along(ray, surfaces[i], found, from, best);
        }
    };
    search(PickKind::cloth, scene.cloths);
    search(PickKind::collider, scene.colliders);
    return best.kind == PickKind::nothing ? Pick{} : best;
}

bool is_visible(const Projection& view, Vec3 point, const PickScene& scene, float tolerance) {
    const auto seen = view.project(point);
    if (!seen) return false;
    const Double3 way = exact(point) - view.eye();
    const Ray ray{rounded(view.eye()), rounded(normalized(way))};
    constexpr double rounding = 1e-6;
    const auto to = static_cast<float>(length(way) * (1 - rounding) - static_cast<double>(tolerance));
    const float from = nearest_along(view, ray);
    const auto hides = [&](const PickSurface& surface) { return blocked_by(ray, surface, from, to); };
    return !std::ranges::any_of(scene.cloths, hides) && !std::ranges::any_of(scene.colliders, hides);
}

Pick pick_at(const Projection& view, Vec2 pixel, const PickScene& scene) {
    const auto ray = view.ray(pixel);
    if (!ray) return {};
    Pick best;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t i = 0; i < scene.markers.size(); ++i) {
        const PickMarker& marker = scene.markers[i];
        const auto seen = view.project(marker.place);
        if (!seen) continue;
        const auto off = static_cast<float>(length(exact(seen->pixel) - exact(pixel)));
        const float distance = length(marker.place - ray->origin);
        if (off > marker.radius || off > least || (off == least && distance >= best.distance)) continue;
        if (!marker.through && !is_visible(view, marker.place, scene)) continue;
        least = off;
        best = {.kind = PickKind::marker,
                .index = i,
                .distance = distance,
                .point = marker.place,
                .normal = {},
                .weights = {}};
    }
    if (best.kind == PickKind::marker) return best;
    const float from = nearest_along(view, *ray);
    best = pick_along(*ray, scene, from);
    const bool is_plane = best.kind == PickKind::collider && scene.colliders[best.index].plane;
    if (!is_plane || ground_is_drawn(view, best.point)) return best;
    return {};  // a plane hides what lies behind it even where it has faded into the background
}

}  // namespace weft::editor
