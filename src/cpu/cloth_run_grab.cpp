// The passes of grabs. There are few, so one thread runs them one after another.
#include "cpu/cloth_run.h"
#include "physics/scalar.h"

#include <array>

namespace weft::cpu {
namespace {

scalar::vec3 lane(Vec3 v) {
    return {v.x, v.y, v.z};
}
scalar::vec3 lane(const Vec4& v) {
    return {v.x, v.y, v.z};
}
Vec4 block(const scalar::vec3& v, float w) {
    return {v.x, v.y, v.z, w};
}

}  // namespace

// Calls visit(grab, corners) for each grab whose triangle has not been removed.
template <class Visit>
void ClothRun::for_each_grab(Visit&& visit) const {
    for (std::size_t i = 0; i < step_.grabs.size(); ++i) {
        std::array<std::uint32_t, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = cloth_.faces()[k * model().face_stride + step_.grabs[i].triangle];
        if (corners[0] != corners[1]) visit(i, corners);
    }
}

void ClothRun::run_grabs(const Pass& pass, std::uint32_t substep) const {
    const float h = numbers_.h, per_substep = 1.0f / static_cast<float>(plan_.substeps);
    const scalar::Step step = scalar::step_without_limits(h, 1.0f / h, 1.0f / h / h);
    const Particles now = cloth_.now();
    const std::span<const float> weights = cloth_.weights();
    const auto row_of = [&](const GrabStep& grab) {
        const float left = static_cast<float>(plan_.substeps - 1 - substep);
        const scalar::vec3 from = lane(grab.from), to = lane(grab.to);
        return scalar::GrabRow{.target = scalar::grab_target(from, to, left, per_substep),
                               .way = (to - from) * per_substep,
                               .c0 = grab.weights.x,
                               .c1 = grab.weights.y,
                               .c2 = grab.weights.z,
                               .max_force = grab.spring.max_force,
                               .compliance = grab.spring.compliance,
                               .damping = grab.spring.damping,
                               .reach = numbers_.hand_reach};
    };
    if (pass.kind == PassKind::grab) {
        const std::span pulls = step_.pulls.subspan(substep * step_.grabs.size(), step_.grabs.size());
        if (pass.first_iteration) std::ranges::fill(pulls, Vec4{});
        for_each_grab([&](std::size_t i, const std::array<std::uint32_t, 3>& p) {
            Vec4 &a = now.position[p[0]], &b = now.position[p[1]], &c = now.position[p[2]];
            scalar::vec3 x[3] = {lane(a), lane(b), lane(c)}, lambda = lane(pulls[i]);
            scalar::project_grab(x[0], x[1], x[2], lane(now.start[p[0]]), lane(now.start[p[1]]), lane(now.start[p[2]]),
                                 a.w, b.w, c.w, lambda, row_of(step_.grabs[i]), step);
            a = block(x[0], a.w), b = block(x[1], b.w), c = block(x[2], c.w);
            pulls[i] = block(lambda, 0);
        });
        return;
    }
    const bool hides = pass.kind == PassKind::hide_grabs;
    for_each_grab([&](std::size_t, const std::array<std::uint32_t, 3>& corners) {
        for (const std::uint32_t p : corners) now.position[p].w = hides ? 0 : weights[p];
    });
    if (pass.kind != PassKind::hold_grabs) return;
    const scalar::vec3 gravity = lane(pass.first_iteration ? input_.gravity : Vec3{});
    for_each_grab([&](std::size_t i, const std::array<std::uint32_t, 3>& p) {
        const scalar::GrabRow row = row_of(step_.grabs[i]);
        const float shares[3] = {row.c0, row.c1, row.c2};
        for (std::size_t k = 0; k < 3; ++k) {
            Vec4& at = now.position[p[k]];
            scalar::vec3 x = lane(at);
            float w = at.w;
            scalar::take_hold(x, w, weights[p[k]], shares[k], gravity, row, step);
            at = block(x, w);
        }
    });
}

}  // namespace weft::cpu
