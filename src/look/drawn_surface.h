// One cloth as it is drawn, for exporters.
#pragma once

#include "look/material.h"

#include <weft/mesh.h>
#include <weft/vector.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace weft {

/// The render mesh of a cloth at one moment.
struct DrawnSurface {
    std::string_view name;
    std::span<const Vec3> positions;  ///< m
    std::span<const Vec3> normals;    ///< unit
    std::span<const Triangle> triangles;
    std::span<const Vec2> uvs;             ///< one per vertex, or none
    std::span<const Vec4> colors;          ///< likewise
    std::span<const Vec3> rest_positions;  ///< m, one per vertex: materials scale with them; without, `positions`
    std::uint64_t topology_version = 1;    ///< another number whenever `triangles` have changed
    const Material* material = nullptr;    ///< where a format has materials; without one, light gray and matte
};

}  // namespace weft
