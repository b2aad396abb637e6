// Cameras, pointers and meshes for tests of tools.
#pragma once

#include "editor/tools/projection.h"
#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace weft::editor {

inline constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinite = std::numeric_limits<float>::infinity();
inline constexpr Vec2 usual_size{1280, 720};

class Dice {
  public:
    explicit Dice(unsigned seed) : random_(seed) {}
    float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    Vec3 point(float reach) {
        const float x = between(-reach, reach), y = between(-reach, reach);
        return {x, y, between(-reach, reach)};
    }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = point(1);
            if (length(v) > 0.1f && length(v) < 1) return normalized(v);
        }
    }
    Vec2 pixel(Vec2 size = usual_size) {
        const float x = between(0, size.x);
        return {x, between(0, size.y)};
    }
    /// Looks at a point near the origin.
    Camera camera() {
        Camera camera;
        camera.target = point(0.5f);
        camera.position = camera.target + direction() * between(1, 5);
        camera.fov = between(20, 80);
        return camera;
    }

  private:
    std::mt19937 random_;
};

inline void expect_close(Vec3 a, Vec3 b, float tolerance) {
    EXPECT_LE(length(a - b), tolerance) << a.x << ", " << a.y << ", " << a.z << " and " << b.x << ", " << b.y << ", "
                                        << b.z;
}

/// A grid whose vertices are moved at random, and waves.
inline TriangleMesh crumpled(std::uint32_t side, unsigned seed, float amount) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    Dice dice(seed);
    for (Vec3& p : mesh.positions) {
        p.y = amount * (std::sin(9 * p.x + static_cast<float>(seed)) + std::cos(7 * p.z));
        p += dice.point(amount / static_cast<float>(side));
    }
    return mesh;
}

}  // namespace weft::editor
