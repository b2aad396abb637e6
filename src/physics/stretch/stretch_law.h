// Stiffness of edges in a fabric.
#pragma once

#include "physics/rest_shape.h"
#include "physics/stretch/stretch.data.h"

#include <array>
#include <vector>

namespace weft {

/// Stiffness of a material's edges. Has no branches on the edge, so loops over edges vectorize.
class StretchLaw {
  public:
    explicit StretchLaw(const StretchMaterial& material);

    /// m/N; negative for no stiffness, because kernels have no infinity.
    struct Compliances {
        float stretched, compressed;
        bool none() const { return stretched < 0 && compressed < 0; }
    };
    /// `strip`: the area at the edge over the square of its length.
    Compliances at(float cos2, float strip) const {
        if (inextensible_) return {0, 0};
        return {compliance(pull_, cos2, strip), compliance(push_, cos2, strip)};
    }

    /// m: how much longer than at rest an edge is when its threads are straight. `rest`: m, its length then.
    float play(float cos2, float rest) const {
        const float inverse = cos2 * inverse_limit_[0] + (1 - cos2) * inverse_limit_[1];
        const float longer = rest / inverse;
        return inverse > 0 && longer < never_straight ? longer : never_straight;
    }

    /// N/m: the softer one of the springs along warp and weft. Diagonals carry the rest of the fabric's stiffness.
    double softest_spring() const { return pull_.warp < pull_.weft ? pull_.warp : pull_.weft; }

  private:
    struct Side {
        float warp, weft;  ///< N/m
        float least;       ///< N/m: stiffness up to this is rounding error
    };
    static Side side_of(const float (&moduli)[2], float shear);
    float compliance(const Side& side, float cos2, float strip) const {
        const float stiffness = directional(side.warp, bias_, side.weft, cos2);
        const float value = 1 / (stiffness * strip);
        return stiffness <= side.least ? -1.0f : value;
    }

    static constexpr auto never_straight = static_cast<float>(WEFT_NEVER_STRAIGHT);

    Side pull_, push_;
    float bias_;              ///< N/m
    float inverse_limit_[2];  ///< 0: none
    bool inextensible_;
};

/// Whether triangles have membranes beside their springs.
inline bool has_membranes(const StretchMaterial& material) {
    return material.model == StretchModel::membrane && !material.inextensible;
}

/// Of the springs of each triangle of a membrane, the edge opposite corner i at index i.
std::vector<std::array<StretchLaw::Compliances, 3>> springs_of_membrane(const RestShape& rest,
                                                                        const StretchMaterial& material);

}  // namespace weft
