// Distances and normals of the shapes without data, at random and at degenerate places.
#include "physics/testing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace weft {
namespace {

using reference::vec3;
using testing_kernels::norm;
using testing_kernels::Random;

using ShapeDistance = double (*)(vec3, reference::ShapeNumbers, vec3&);
using ScalarDistance = float (*)(scalar::vec3, scalar::ShapeNumbers, scalar::vec3&);

struct PlainShape {
    const char* name;
    ShapeDistance distance;
    ScalarDistance in_float;
    std::array<double, 4> numbers;  // for a size of 1
};

const PlainShape plain_shapes[] = {
    {"sphere", reference::distance_sphere, scalar::distance_sphere, {1, 0, 0, 0}},
    {"box", reference::distance_box, scalar::distance_box, {1, 0.5, 0.25, 0}},
    {"capsule", reference::distance_capsule, scalar::distance_capsule, {0.5, 1, 0, 0}},
};

TEST(ShapeDistances, normals_are_gradients) {
    for (const PlainShape& shape : plain_shapes) {
        SCOPED_TRACE(shape.name);
        const auto [a, b, c, d] = shape.numbers;
        Random random(3);
        int compared = 0;
        for (int i = 0; i < 2000; ++i) {
            vec3 p[1] = {random.vector(2)};
            vec3 normal, other;
            const auto at = [&] { return shape.distance(p[0], {a, b, c, d, {}}, other); };
            shape.distance(p[0], {a, b, c, d, {}}, normal);
            // Next to an edge, or where two faces are equally near, the gradient changes suddenly.
            bool smooth = true;
            const vec3 here = p[0];
            for (int k = 0; k < 8; ++k) {
                p[0] = here + vec3(k & 1 ? 1e-3 : -1e-3, k & 2 ? 1e-3 : -1e-3, k & 4 ? 1e-3 : -1e-3);
                at();
                smooth &= norm(other - normal) < 0.1;
            }
            p[0] = here;
            if (!smooth) continue;
            ++compared;
            testing_kernels::expect_gradient(p, std::span<const vec3>(&normal, 1), at, 2e-3);
        }
        EXPECT_GT(compared, 1500);
    }
}

TEST(ShapeDistances, are_finite_with_unit_normals_in_float_and_agree_with_double) {
    for (const PlainShape& shape : plain_shapes) {
        for (const double size : {1.0, 1e-6, 1e6}) {
            const auto float_of = [&](int i) {
                return static_cast<float>(shape.numbers[static_cast<std::size_t>(i)] * size);
            };
            const float n[4] = {float_of(0), float_of(1), float_of(2), float_of(3)};
            const float s = static_cast<float>(size);
            const float places[] = {0, -0.0f, s, -s, s / 2, -s / 2, s / 4, 3 * s, 1e-40f, -1e-40f, 1e-20f, 1e6f, -1e6f};
            for (const float x : places)
                for (const float y : places)
                    for (const float z : places) {
                        SCOPED_TRACE(std::string(shape.name) + " of size " + std::to_string(size) + " at " +
                                     std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z));
                        scalar::vec3 normal;
                        const float distance = shape.in_float({x, y, z}, {n[0], n[1], n[2], n[3], {}}, normal);
                        const vec3 wide(double{normal.x}, double{normal.y}, double{normal.z});
                        ASSERT_TRUE(std::isfinite(distance));
                        ASSERT_NEAR(norm(wide), 1, 1e-5);
                        vec3 unused;
                        const double expected =
                            shape.distance({double{x}, double{y}, double{z}},
                                           {double{n[0]}, double{n[1]}, double{n[2]}, double{n[3]}, {}}, unused);
                        const double largest =
                            std::max({std::abs(double{x}), std::abs(double{y}), std::abs(double{z}), size});
                        ASSERT_NEAR(double{distance}, expected, 1e-6 * largest);
                    }
        }
    }
}

}  // namespace
}  // namespace weft
