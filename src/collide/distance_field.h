// The signed distance field of a triangle mesh: makes any mesh a solid that cloth can collide with.
//
// The field has fine cells near the surface and coarse ones elsewhere. physics/contact/mesh.kernel.h reads it and
// documents its layout.
#pragma once

#include "collide/shape_data.h"
#include "collide/thin_parts.h"
#include "mesh/triangle_mesh.h"

#include <weft/result.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace weft {

struct DistanceFieldOptions {
    static constexpr std::uint32_t fewest_cells = 4, most_cells = 1024;

    /// Along the longest side of the mesh's bounds. Twice as many cells need about four times the memory.
    std::uint32_t cells = 96;
    /// 0: as many as the machine has. The field does not depend on it.
    unsigned threads = 0;
    /// At most `largest_distance_field`.
    std::size_t largest_bytes = std::size_t{256} << 20;
};

/// Changes when the field of some mesh does, so that fields kept on disk are built again.
inline constexpr std::uint32_t distance_field_version = 3;

/// Kernels number blocks of 16 bytes by floats, which are exact up to 2^24.
inline constexpr std::size_t largest_distance_field = std::size_t{16} << 24;

/// ShapeData::width of a field: a part and the gap behind it that are in the field together take two cells.
constexpr float field_width(float cell) {
    return cell + cell;
}

/// Fine cells cover all points up to this far from the surface, on both sides. In cells.
inline constexpr double fine_band = 2;

struct DistanceField {
    ShapeData data;
    float cell = 0;                         ///< m
    std::array<std::uint32_t, 3> places{};  ///< cubes of 8 x 8 x 8 cells that the grid consists of, along x, y, z
    std::uint32_t bricks = 0;               ///< places that have fine cells
    std::uint32_t zero_area = 0;            ///< triangles left out
    std::uint32_t flipped = 0;              ///< triangles turned around to face the same way as their neighbors
    bool closed = false;                    ///< the surface has no holes
    bool is_sheet = false;                  ///< solid for two cells behind the side that its triangles face
    bool has_inside = false;                ///< false if the field pushes nothing out
    ThinParts thin;                         ///< parts thinner than two cells; lengths in m

    std::size_t bytes() const { return data.words.size() * sizeof(float); }
};

/// The distance to the nearest triangle, negative where the surface winds around the point more than half a time, in
/// either direction (winding_number.h). Therefore
///   - a mesh turned inside out is the same solid, and so are meshes some of whose triangles are;
///   - parts that overlap are one solid. If one of them is turned inside out as a whole, the overlap is outside;
///   - a closed part inside another one is a cavity if its orientation is the opposite, else part of the solid;
///   - a hole is closed by the surface on which the winding number is one half. There the value is an estimate of the
///     distance to that surface, so that it does not jump;
///   - half a shell is solid up to that surface, near the plane of its opening;
///   - a sheet, which encloses nothing, is solid for two cells behind the side that its triangles face
///     (SolidSurface::is_sheet()).
///
/// Interpolation cuts convex edges and tips off, by up to a third of a cell. Values there are lowered until the
/// surface, at points half a cell apart, is at most 0.02 cells outside the field's solid, as far as that makes no value
/// change faster along an axis than a distance does. So cloth on the field covers the mesh.
///
/// Interpolation can make fine values steeper than a distance: `ShapeData::steepness` is the greatest slope. Coarse
/// values outside are lowered (free_way.h). So from any point outside, the way to the surface of the field is at least
/// its value divided by the steepness.
///
/// Errors: no triangle has an area; a position is not finite; a triangle has an invalid corner; `cells` is out of
/// range; the mesh is too small, too large or too far from the origin for floats; the field needs more memory than
/// allowed. `where` is then the vertex or triangle, or empty.
Result<DistanceField> build_distance_field(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                           const DistanceFieldOptions& options = {});

}  // namespace weft
