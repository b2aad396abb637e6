// Outlines of selected objects, drawn into a finished image by the processor. They show whole objects, also where
// others hide them.
#pragma once

#include "base/image.h"
#include "look/camera.h"

#include <weft/mesh.h>
#include <weft/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft::editor {

/// The pixels that triangles cover.
class Coverage {
  public:
    Coverage(const Camera& camera, std::uint32_t width, std::uint32_t height);

    /// Positions in the world. Parts behind the eye are left out. Each vertex covers its pixel, so that objects smaller
    /// than a pixel are not lost.
    void add(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    bool at(std::uint32_t x, std::uint32_t y) const { return covered_[std::size_t{y} * width_ + x] != 0; }

    /// Draws the outline around the covered pixels: a bright band with a dark rim, which differs from any background by
    /// its shape and its brightness.
    void outline(Image8& image) const;

  private:
    struct Projected {
        float x = 0, y = 0;  ///< pixels
        bool in_front = false;
    };
    Vec3 to_view(Vec3 p) const;
    Projected project(Vec3 in_view) const;
    void fill(const Projected& a, const Projected& b, const Projected& c);
    void fill_clipped(const Vec3& a, const Vec3& b, const Vec3& c);

    std::uint32_t width_, height_;
    Vec3 eye_, right_, up_, along_;
    float scale_ = 1, nearest_ = 0;  // pixels per unit of slope; m
    std::vector<std::uint8_t> covered_;
    std::vector<Vec3> in_view_;         // scratch
    std::vector<Projected> projected_;  // scratch
};

}  // namespace weft::editor
