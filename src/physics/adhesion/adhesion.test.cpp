#include "physics/constraint.h"
#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::AdhesionRow;

AdhesionRow to(vec3 target, double compliance) {
    return {target.x, target.y, target.z, compliance};
}

TEST(AdhesionKernel, at_its_target_is_at_rest) {
    vec3 x(1, 2, 3);
    double lambda = 0;
    reference::project_adhesion(x, 2, lambda, to(x, 1e-3), make_step(0.01));
    EXPECT_EQ(norm(x - vec3(1, 2, 3)), 0);
    EXPECT_EQ(lambda, 0);
}

TEST(AdhesionKernel, moves_along_the_gradient) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const vec3 before = random.vector(1), target = random.vector(1);
        vec3 x = before;
        const double w = random.number(0.1, 9), compliance = random.number(1e-6, 1e-2);
        const reference::Step step = make_step(0.01);
        double lambda = 0;
        reference::project_adhesion(x, w, lambda, to(target, compliance), step);
        vec3 points[1] = {before};
        const vec3 gradients[1] = {(x - before) * (1 / (w * lambda))};
        expect_gradient(
            points, gradients, [&] { return norm(points[0] - target); }, 1e-8);
        EXPECT_NEAR(lambda, -norm(before - target) / (w + compliance * step.inv_h2), 1e-12);
    }
}

TEST(AdhesionKernel, without_compliance_puts_the_particle_on_its_target) {
    vec3 x(0.3, -0.1, 0.2);
    const vec3 target(0.1, 0.1, 0.1);
    double lambda = 0;
    reference::project_adhesion(x, 5, lambda, to(target, 0), make_step(0.01));
    EXPECT_LT(norm(x - target), 1e-15);
}

TEST(AdhesionKernel, leaves_what_has_no_weight) {
    vec3 x(0.3, -0.1, 0.2);
    double lambda = 0;
    reference::project_adhesion(x, 0, lambda, to(vec3(0.0), 1e-3), make_step(0.01));
    EXPECT_EQ(norm(x - vec3(0.3, -0.1, 0.2)), 0);
    EXPECT_EQ(lambda, 0);
    EXPECT_FALSE(reference::adheres(-1, 0.01, 0));
    EXPECT_TRUE(reference::adheres(0.009, 0.01, 1));
    EXPECT_FALSE(reference::adheres(0.01, 0.01, 1));
}

}  // namespace
}  // namespace weft
