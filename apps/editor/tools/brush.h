// A brush that paints weights of vertices: pins, resistance, thickness or any other value.
#pragma once

#include "collide/closest_point.h"
#include "editor/tools/surface_distance.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace weft::editor {

enum class BrushMode : std::uint8_t { add, subtract, smooth, set };
enum class BrushFallOff : std::uint8_t {
    smooth,  ///< with a slope of 0 at the center and at the radius
    linear,
    none,  ///< 1 up to the radius
};

struct BrushSettings {
    BrushMode mode = BrushMode::add;
    float radius = 0.1f;     ///< m, over the surface
    float strength = 1;      ///< 0…1
    float value = 1;         ///< `set`: what is painted; `add`, `subtract`: the most that a stroke changes
    float min = 0, max = 1;  ///< of painted values
};

/// 1 at the center, 0 from the radius on.
float brush_fall_off(float distance, float radius, BrushFallOff kind = BrushFallOff::smooth);

struct BrushWeight {
    std::uint32_t vertex = 0;
    float weight = 0;  ///< 0…1
};

/// Weights under a brush whose center is at a point of the mesh, and at its mirror image if there is one; where both
/// reach a vertex, the larger weight. Distances run over the surface: the other side of a fold is farther away.
/// Ascending by vertex.
std::vector<BrushWeight> brush_weights(SurfaceDistance& distance, const MeshView& mesh, const MeshPlace& center,
                                       float radius, const std::optional<MeshPlace>& mirrored = std::nullopt,
                                       BrushFallOff fall_off = BrushFallOff::smooth);

enum class MirrorAxis : std::uint8_t { x, y, z };

/// Finds mirror images of points across a plane of a shape at rest: perpendicular to the axis, through the middle of
/// the shape's bounds.
class RestMirror {
  public:
    RestMirror(std::vector<Vec3> rest_positions, std::span<const Triangle> triangles, MirrorAxis axis = MirrorAxis::x);
    RestMirror(const RestMirror&) = delete;
    RestMirror& operator=(const RestMirror&) = delete;

    /// The point of the surface nearest to the mirror image. Nothing if it is farther away than `tolerance` (m), or if
    /// the place is not on a sound triangle.
    std::optional<MeshPlace> of(const MeshPlace& place, float tolerance) const;

  private:
    float Vec3::*axis_;
    float twice_middle_ = 0;  // m
    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;     // the sound ones
    std::vector<std::uint32_t> numbers_;  // of these in the mesh
    std::vector<std::uint32_t> place_;    // of the mesh's triangles among these, or `none`
    SurfaceSearch search_;
};

/// One stroke. Except with `smooth`, a vertex gets the largest weight that the stroke has had there: dabs that overlap
/// do not add up, and the result does not depend on how many there are.
class BrushStroke {
  public:
    /// `values`: one per vertex, before the stroke.
    BrushStroke(const BrushSettings& settings, std::vector<float> values);

    /// `distance`: knows the neighbors of vertices, which `smooth` averages.
    void dab(std::span<const BrushWeight> weights, const SurfaceDistance& distance);

    const std::vector<float>& values() const { return values_; }
    /// Vertices whose value has changed, ascending.
    std::vector<std::uint32_t> changed() const;

  private:
    void smooth(std::span<const BrushWeight> weights, const SurfaceDistance& distance);

    BrushSettings settings_;
    std::vector<float> before_, values_, weights_;
};

}  // namespace weft::editor
