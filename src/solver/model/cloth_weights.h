// Factors on the values of the fabric at places of the cloth.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace weft {

struct ClothWeights {
    /// Above 0; both empty: 1 everywhere.
    struct Factors {
        std::vector<float> of_particles = {};
        std::vector<float> of_triangles = {};  ///< means of the corners

        bool empty() const { return of_triangles.empty(); }
        float at(std::uint32_t triangle) const { return empty() ? 1.0f : of_triangles[triangle]; }
        float least() const { return empty() ? 1.0f : *std::ranges::min_element(of_triangles); }
        float most() const { return empty() ? 1.0f : *std::ranges::max_element(of_triangles); }
    };
    Factors density = {};
    Factors stretch = {};  ///< on the stiffness against stretch, shear and compression
    Factors bend = {};     ///< on the stiffness against bending
    /// On the thickness; those of particles alone. An edge or a triangle is as thick as at its thinnest corner.
    Factors thickness = {};
};

}  // namespace weft
