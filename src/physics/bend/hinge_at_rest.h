// Rest shape and stiffness of hinges, shared by the constraints that bend edge by edge.
#pragma once

#include "physics/bend/bend.data.h"
#include "physics/constraint.h"
#include "physics/rest_shape.h"

namespace weft {

/// The geometry from which a hinge's compliance is computed.
struct HingeShape {
    float across = 0;        ///< cos² of the angle between the warp and the direction across the edge
    float area = 0;          ///< m², of both triangles, over their weight
    float edge_squared = 0;  ///< m²
};

/// Stiffness of a material's hinges. Has no branches on the hinge, so loops over hinges vectorize.
struct BendLaw {
    float warp, bias, weft;  ///< N·m

    explicit BendLaw(const BendMaterial& material)
        : warp(material.bend[0]), bias(material.bend[1]), weft(material.bend[2]) {}
    /// N·m. Hinges without stiffness get no constraint.
    float stiffness(float across) const { return directional(warp, bias, weft, across); }
    /// 1/(N·m): (A₁ + A₂) / (B ℓ²)
    static float compliance(float stiffness, float area, float edge_squared) {
        return area / (stiffness * edge_squared);
    }
};

/// Whether `choice` includes the hinge.
bool bends(const Topology& topology, const Hinge& hinge, BendEdges choice);
HingeShape shape_of(const RestShape& rest, const Hinge& hinge);
/// Dihedral angle at rest, rad; 0 is flat.
float angle_at_rest(const Topology& topology, const Hinge& hinge, const BendMaterial& material);

/// Calls visit(hinge, shape, stiffness) for each hinge that gets a constraint. Adds the direction of each hinge without
/// stiffness to `rows.left_out`.
template <class Visit>
void for_each_stiff_hinge(const RestShape& rest, const BendMaterial& material, RowList& rows, Visit&& visit) {
    const BendLaw law(material);
    for (const Hinge& hinge : rest.topology.hinges) {
        if (!bends(rest.topology, hinge, material.edges)) continue;
        const HingeShape shape = shape_of(rest, hinge);
        if (const float stiffness = law.stiffness(shape.across); stiffness > 0) {
            visit(hinge, shape, stiffness);
        } else {
            rows.left_out.push_back(shape.across);
        }
    }
}

}  // namespace weft
