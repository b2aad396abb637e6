// The mass of a body, from its description and its shape.
#pragma once

#include "collide/body_features.h"
#include "physics/body/body_mass.h"

#include <weft/result.h>
#include <weft/scene.h>

#include <span>
#include <string>

namespace weft {

struct ShapeData;

/// Mass, center and inertia of a body in the collider's frame. `data`: of the shape, null if it has none.
///
///   - Sphere, box, capsule, tapered capsule and convex hull, its rounding included, have exact values.
///   - A mesh has those of the solid that its triangles enclose, turned around as for the distance field. A part within
///     another one counts once; a cavity counts as empty; where parts overlap only in part, the overlap counts twice.
///   - A mesh that has holes, or that encloses nothing, has no volume. It needs BodyDesc::mass, and is then a shell:
///   its
///     center and inertia are those of its triangles, with equal mass per area.
///   - BodyDesc::center moves the center of mass. The moments about the moved center are those that the shape has about
///     its own.
///   - BodyDesc::inertia gives the moments about the center of mass.
///
/// Errors: a plane; a shape without volume and BodyDesc::mass; a value out of range or not finite; moments of which one
/// is larger than the sum of the other two, which no body has; mass or inertia beyond what floats hold with a margin
/// (1e-30 … 1e30). `where` is then the value's place in a body's part of a scene file: "/inertia"; or empty.
///
/// `note`: if not null, is set to a warning if the mass is that of a shell, else to an empty text.
Result<BodyMass> body_mass_of(const BodyDesc& body, const ColliderShape& shape, const ShapeData* data,
                              std::string* note = nullptr);

/// A mass at a place in the frame of a body.
struct PointMass {
    Vec3 place;      ///< m
    float mass = 0;  ///< kg
};

/// The body together with such points. `body` itself if there are none, or if the values do not fit into floats.
BodyMass with_points(const BodyMass& body, std::span<const PointMass> points);

}  // namespace weft
