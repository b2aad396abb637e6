// What a fabric makes of an edge.
#pragma once

#include "physics/rest_shape.h"
#include "physics/stretch/stretch.data.h"

namespace weft {

/// How stiff edges of a material are. Without branches on the edge, so loops over many edges run on lanes.
class StretchLaw {
  public:
    explicit StretchLaw(const StretchMaterial& material);

    /// m/N; a negative one says "no stiffness" to the kernel, which has no infinity.
    struct Compliances {
        float stretched, compressed;
        bool none() const { return stretched < 0 && compressed < 0; }
    };
    /// `strip`: the area at the edge over the square of its length.
    Compliances at(float cos2, float strip) const {
        if (inextensible_) return {0, 0};
        return {compliance(pull_, cos2, strip), compliance(push_, cos2, strip)};
    }

  private:
    struct Side {
        float warp, weft;  ///< N/m
        float least;       ///< N/m: what rounding may leave of no stiffness
    };
    static Side side_of(const float (&moduli)[2], float shear);
    float compliance(const Side& side, float cos2, float strip) const {
        const float stiffness = directional(side.warp, bias_, side.weft, cos2);
        const float value = 1 / (stiffness * strip);
        return stiffness <= side.least ? -1.0f : value;
    }

    Side pull_, push_;
    float bias_;  ///< N/m
    bool inextensible_;
};

}  // namespace weft
