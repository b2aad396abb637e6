// Helpers for kernel tests: random vectors, and a gradient checked against finite differences. Tests only.
#pragma once

#include "physics/scalar.h"

#include <gtest/gtest.h>

#include <random>
#include <span>

namespace weft::testing_kernels {

using reference::vec3;

inline double norm(vec3 v) {
    return std::sqrt(reference::dot(v, v));
}

/// The same numbers on every run and machine.
class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    /// In [low, high).
    double number(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    vec3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
    std::uint32_t index(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }

  private:
    std::mt19937 engine_;
};

/// Compares gradients with central differences of `c`, a function of the same points.
template <class C>
void expect_gradient(std::span<vec3> points, std::span<const vec3> gradients, C&& c, double tolerance) {
    const double step = 1e-5;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double expected[3] = {gradients[i].x, gradients[i].y, gradients[i].z};
        double* coordinate[3] = {&points[i].x, &points[i].y, &points[i].z};
        for (int k = 0; k < 3; ++k) {
            const double at = *coordinate[k];
            *coordinate[k] = at + step;
            const double above = c();
            *coordinate[k] = at - step;
            const double below = c();
            *coordinate[k] = at;
            EXPECT_NEAR((above - below) / (2 * step), expected[k], tolerance) << "point " << i << ", axis " << k;
        }
    }
}

inline reference::Step make_step(double h) {
    return reference::step_without_limits(h, 1 / h, 1 / (h * h));
}

}  // namespace weft::testing_kernels
