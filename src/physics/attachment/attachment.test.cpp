#include "mesh/procedural.h"
#include "physics/constraint.h"
#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::AttachmentRow;

TEST(Attachment, at_its_anchor_is_at_rest) {
    vec3 x(1, 2, 3), anchor = x;
    double lambda = 0;
    reference::project_attachment(x, anchor, 2, 0, lambda, {1e-3}, make_step(0.01));
    EXPECT_EQ(norm(x - anchor), 0);
    EXPECT_EQ(lambda, 0);
}

TEST(Attachment, moves_along_the_gradient_and_leaves_the_anchor) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const vec3 before = random.vector(1), place = random.vector(1);
        vec3 x = before, anchor = place;
        const double w = random.number(0.1, 9), compliance = random.number(1e-6, 1e-2);
        const reference::Step step = make_step(0.01);
        double lambda = 0;
        reference::project_attachment(x, anchor, w, 0, lambda, {compliance}, step);
        EXPECT_EQ(norm(anchor - place), 0);
        vec3 points[1] = {before};
        const vec3 gradients[1] = {(x - before) * (1 / (w * lambda))};
        expect_gradient(
            points, gradients, [&] { return norm(points[0] - place); }, 1e-8);
        EXPECT_NEAR(lambda, -norm(before - place) / (w + compliance * step.inv_h2), 1e-12);
    }
}

TEST(Attachment, keeps_the_momentum_of_particle_and_anchor) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const vec3 before = random.vector(1), place = random.vector(1);
        vec3 x = before, anchor = place;
        const double w = random.number(0.1, 9), anchor_w = random.number(0.1, 9),
                     compliance = random.number(1e-6, 1e-2);
        const reference::Step step = make_step(0.01);
        double lambda = 0;
        for (int k = 0; k < 3; ++k) {
            reference::project_attachment(x, anchor, w, anchor_w, lambda, {compliance}, step);
            EXPECT_LT(norm((x - before) * (1 / w) + (anchor - place) * (1 / anchor_w)), 1e-12);
        }
        EXPECT_NEAR(-lambda * step.inv_h2, norm(x - anchor) / compliance, 1e-6 * norm(x - anchor) / compliance);
    }
}

TEST(Attachment, pulls_with_the_force_of_its_spring) {
    vec3 x(0, -0.02, 0), anchor(0.0);
    double lambda = 0;
    const reference::Step step = make_step(0.01);
    for (int i = 0; i < 50; ++i) reference::project_attachment(x, anchor, 3, 0, lambda, {1e-3}, step);
    EXPECT_NEAR(-lambda * step.inv_h2, norm(x) / 1e-3, 1e-6);
}

TEST(Attachment, survives_degenerate_input) {
    using namespace scalar;
    const Step step = step_without_limits(1e-3f, 1e3f, 1e6f);
    for (const float w : {0.0f, 1.0f, 1e30f}) {
        for (const float gap : {0.0f, 1e-30f, 1e-12f, 1e12f}) {
            for (const float compliance : {1e-30f, 1.0f, 1e6f, 1e30f}) {
                scalar::vec3 x(gap, 0, 0), anchor(0.0f);
                float lambda = 0;
                project_attachment(x, anchor, w, 0.0f, lambda, {compliance}, step);
                EXPECT_TRUE(std::isfinite(x.x) && std::isfinite(lambda)) << w << ' ' << gap << ' ' << compliance;
            }
        }
    }
}

TEST(AttachmentRows, tie_each_particle_to_an_anchor_of_its_own) {
    const TriangleMesh mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::alternating);
    const auto topology = build_topology(mesh);
    RestShape rest = make_rest_shape(mesh, *topology);
    rest.attachments = {{4, 0.5f}, {7, 0.25f}};
    const RowList rows = build_attachment(rest);
    EXPECT_EQ(rows.particles, (std::vector<std::uint32_t>{4, 9, 7, 10}));
    EXPECT_EQ(rows.fields, (std::vector<float>{0.5f, 0.25f}));
}

}  // namespace
}  // namespace weft
