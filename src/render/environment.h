// Light from all around, as shaders take it.
#pragma once

#include "base/image.h"
#include "look/light.h"

#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace weft::render {

struct Surroundings {
    /// Irradiance divided by pi, in spherical harmonics of the normal: 1, y, z, x, xy, yz, 3z²−1, xz, x²−y².
    std::array<glm::vec4, 9> around{};
    /// Equirectangular, its middle toward -z: what a mirror of GGX shows, of roughness 0 in the first level to 1 in the
    /// last, each of half the size. The first is that of `side` by `side`/2.
    std::vector<ImageF> mirrored;
};

/// Of the sky's colors, or of the picture that has been read of the environment; all strengths are in it.
Surroundings surroundings_of(const Lighting& light, const ImageF* environment);

/// Light that the sky sends from a direction.
Vec3 sky_toward(const Sky& sky, Vec3 direction);

}  // namespace weft::render
