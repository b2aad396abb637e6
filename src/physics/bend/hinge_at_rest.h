// What a fabric makes of a hinge: the same for all that bends edge by edge.
#pragma once

#include "physics/bend/bend.data.h"
#include "physics/rest_shape.h"

namespace weft {

/// What its compliance follows from.
struct HingeShape {
    float across = 0;        ///< cos² of the angle between the warp and the direction across the edge
    float area = 0;          ///< m², of both triangles
    float edge_squared = 0;  ///< m²
};

/// How stiff hinges of a material are. Without branches on the hinge, so loops over many hinges run on lanes.
struct BendLaw {
    float warp, bias, weft;  ///< N·m

    explicit BendLaw(const BendMaterial& material)
        : warp(material.bend[0]), bias(material.bend[1]), weft(material.bend[2]) {}
    /// N·m. What has none has no row.
    float stiffness(float across) const { return directional(warp, bias, weft, across); }
    /// 1/(N·m): (A₁ + A₂) / (B ℓ²)
    static float compliance(float stiffness, float area, float edge_squared) {
        return area / (stiffness * edge_squared);
    }
};

/// Whether the hinge is one of the material's choice.
bool bends(const Topology& topology, const Hinge& hinge, HingeChoice choice);
HingeShape shape_of(const RestShape& rest, const Hinge& hinge);
/// rad, dihedral, at ease; 0 is flat
float angle_at_rest(const Topology& topology, const Hinge& hinge, const BendMaterial& material);

}  // namespace weft
