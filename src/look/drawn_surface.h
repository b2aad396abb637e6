// The render mesh of one cloth in one frame, as exporters read it.
#pragma once

#include "look/material.h"

#include <weft/mesh.h>
#include <weft/vector.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace weft {

/// The render mesh of a cloth in one frame.
struct DrawnSurface {
    std::string_view name;
    std::span<const Vec3> positions;  ///< m
    std::span<const Vec3> normals;    ///< unit
    /// A cloth keeps the number and order of its triangles; a removed one has the same corner three times.
    std::span<const Triangle> triangles;
    std::span<const Vec2> uvs;             ///< one per vertex, or none
    std::span<const Vec4> colors;          ///< one per vertex, or empty
    std::span<const Vec3> rest_positions;  ///< m, one per vertex; sets the scale of materials; empty: `positions`
    std::uint64_t topology_version = 1;    ///< changes whenever `triangles` change
    const Material* material = nullptr;    ///< for formats with materials; nullptr: light gray, matte
    std::size_t spare_vertices = 0;        ///< most that can still be added while the cloth moves
};

}  // namespace weft
