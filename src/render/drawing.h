// The input of a Renderer for one frame. Independent of the simulation.
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

/// Number of a material in a Renderer.
using MaterialId = std::uint32_t;

/// The kinds of shading/color_scale.h.
enum class ColorScale : std::int32_t {
    balance,  ///< diverging about a middle: less … none … more
    amount,   ///< sequential: none … much
};

/// A value per vertex, shown as a color in place of the material's color.
struct ScalarField {
    gpu::BufferRange values;    ///< a float per vertex; no buffer: none
    float least = 0, most = 1;  ///< values at the ends of the scale; beyond them, the color of the end
    ColorScale scale = ColorScale::balance;
};

/// Triangles on the device. Columns of `transform` take them to the world: rotation and scale, then position.
struct Object {
    gpu::SurfaceBuffers surface;
    gpu::BufferRange rest;  ///< optional: three floats per vertex, m; place the threads of meshes without UVs
    MaterialId material = 0;
    std::array<Vec3, 4> transform{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 0}};
    float uv_meters[2] = {1, 1};  ///< m of cloth per unit of u and of v
    ScalarField scalars = {};
    bool casts_shadow = true;
};

/// A line in the world, `width` pixels wide at any distance.
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

/// A corner of a triangle on top of the image.
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
    sky,          ///< colors of the sky, or the environment image
    transparent,  ///< none: alpha is the coverage; the ground shows only its shadows
};

/// The whole image. Spans are read only during the call, buffers until the frame is done.
struct Drawing {
    Camera camera;
    Lighting lighting;
    Background background = Background::sky;
    std::span<const Object> objects;
    std::span<const Ground> grounds;
    std::span<const Line> lines;         ///< hidden by objects in front of them
    std::span<const Line> lines_on_top;  ///< shown through everything
    std::span<const Point> points;       ///< shown through everything
    std::span<const FlatVertex> flat;    ///< three per triangle
    bool two_passes = false;             ///< draws front sides, then back sides: slower, same image
};

}  // namespace weft::render
