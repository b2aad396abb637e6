// Finds the edges to open for a cut.
#pragma once

#include "solver/model/cloth_edit.h"
#include "solver/model/cloth_model.h"

#include <weft/result.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Opens all edges between triangles of different groups. `group`: per triangle of the model. The model must have a
/// tear table. Here and below, edges that are open already are left out.
std::vector<Opening> openings_between(const ClothModel& model, std::span<const std::uint32_t> group);

/// Opens edges near a plane: a triangle belongs to the side on which the larger part of its extent along the normal is,
/// so the cut runs within 0.53 edges of the plane. `positions`: of the particles, m. `normal` need not have length 1.
std::vector<Opening> openings_along_plane(const ClothModel& model, std::span<const Vec4> positions, Vec3 point,
                                          Vec3 normal);

/// Opens a path of edges near a stroke: a polyline on the cloth, m. The path runs between the particles nearest to the
/// stroke's points, and prefers edges near the lines between these. Empty if all points have the same nearest particle.
std::vector<Opening> openings_along_stroke(const ClothModel& model, std::span<const Vec4> positions,
                                           std::span<const Vec3> stroke);
/// The same on the cloth as it was built, whatever is open now: the path depends on the mesh alone.
std::vector<Opening> openings_along_stroke_at_rest(const ClothModel& model, std::span<const Vec3> stroke);

/// The direction of the part of a polyline that is nearest to a place. `stroke` has at least two points.
Vec3 nearest_direction(std::span<const Vec3> stroke, Vec3 place);

/// The openings that have a closed edge.
std::vector<Opening> closed_ones(const ClothModel& model, std::span<const Opening> openings);
/// m: how far the middles of the edges are from the stroke at most. `positions`: of the particles.
double farthest_from(std::span<const Vec3> stroke, const ClothModel& model, std::span<const Vec4> positions,
                     std::span<const Opening> openings);

}  // namespace weft
