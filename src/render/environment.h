// Image-based light from all directions, in the form that shaders read.
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
    /// Equirectangular with the middle toward -z: the environment prefiltered for GGX mirrors, from roughness 0 in the
    /// first level to 1 in the last. The first level has `side` by `side`/2 pixels, each following one half the size.
    std::vector<ImageF> mirrored;
};

/// Computed from the sky's colors, or from `environment` if it is not null. Intensities are included.
Surroundings surroundings_of(const Lighting& light, const ImageF* environment);

/// Radiance of the sky from a direction.
Vec3 sky_toward(const Sky& sky, Vec3 direction);

}  // namespace weft::render
