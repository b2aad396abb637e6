// What a picture is made of: everything that a Renderer takes for one frame. Nothing here knows what a cloth is.
#pragma once

#include "gpu/surface_buffers.h"
#include "look/camera.h"
#include "look/light.h"

#include <weft/bounds.h>
#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::render {

/// A number of materials' places in a Renderer.
using MaterialId = std::uint32_t;

/// The kinds of shading/color_scale.h.
enum class ColorScale : std::int32_t {
    balance,  ///< about a middle: less … none … more
    amount,   ///< none … much
};

/// A value per vertex shown as color, in place of the material's.
struct ScalarField {
    gpu::BufferRange values;    ///< a float a vertex; no buffer: none
    float least = 0, most = 1;  ///< what the ends of the scale stand for; beyond them, the color of the end
    ColorScale scale = ColorScale::balance;
};

/// Triangles on the device. Columns of `transform` take them to the world: rotation and scale, then position.
struct Object {
    gpu::SurfaceBuffers surface;
    gpu::BufferRange rest;  ///< three floats a vertex, m: where threads are laid where there are no UVs; may be missing
    MaterialId material = 0;
    std::array<Vec3, 4> transform{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 0}};
    float uv_meters[2] = {1, 1};  ///< m of cloth that a unit of u and of v is long
    ScalarField scalars = {};
    bool casts_shadow = true;
};

/// Drawn in the world, as wide as `width` pixels at any distance.
struct Line {
    Vec3 from, to;  ///< m
    Vec4 color;     ///< sRGB, 0…1, and opacity
    float width = 1.5f;
};

/// A disc that faces the viewer.
struct Point {
    Vec3 position;   ///< m
    Vec4 color;      ///< sRGB, 0…1, and opacity
    float size = 6;  ///< pixels across
};

/// A corner of a triangle on top of the picture.
struct FlatVertex {
    float x = 0, y = 0;  ///< pixels, from the upper left corner
    Vec4 color;          ///< sRGB, 0…1, and opacity
};

/// An endless plane that receives shadows and fades into the background.
struct Ground {
    Vec3 normal{0, 1, 0};
    float offset = 0;  ///< m: normal · x = offset
    MaterialId material = 0;
};

enum class Background {
    sky,          ///< colors of the light around, or the environment
    transparent,  ///< none: alpha says what is covered; the ground is there by its shadows alone
};

/// The whole picture. Spans are read during the call alone, buffers until the frame is done.
struct Drawing {
    Camera camera;
    Lighting lighting;
    Background background = Background::sky;
    std::span<const Object> objects;
    std::span<const Ground> grounds;
    std::span<const Line> lines;         ///< hidden by what stands before them
    std::span<const Line> lines_on_top;  ///< shown through everything
    std::span<const Point> points;       ///< shown through everything
    std::span<const FlatVertex> flat;    ///< three a triangle
    bool two_passes = false;             ///< front sides first, then back sides: as slow as it is old; looks the same
};

}  // namespace weft::render
