// The wind pass: the sum of all winds at each triangle.
#include "cpu/cloth_run.h"

namespace weft::cpu {

void ClothRun::run_winds(const AirView& air, Range mine, unsigned worker) const {
    bool first = true;
    for (const WindNow& wind : input_.winds) {
        const auto& blow = passes_.wind[static_cast<std::uint32_t>(wind.kind)];
        if (wind.shelter > 0 && !cloth_.sheltered.empty()) {
            AirView apart = air;
            apart.sheltered = &cloth_.sheltered[0].x;
            blow(apart, wind, first, mine);
            run_shelter(apart, wind.shelter, mine, worker);
            passes_.add_sheltered(apart, first, mine);
        } else {
            blow(air, wind, first, mine);
        }
        first = false;
    }
}

void ClothRun::run_shelter(const AirView& air, float reach, Range mine, unsigned worker) const {
    Bounds box;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        for (std::size_t t = mine.begin; t < mine.end; ++t) {
            const float* p = air.position + std::size_t{4} * air.faces[corner * air.stride + t];
            box.include(Vec3{p[0], p[1], p[2]});
        }
    }
    if (box.empty()) return;
    // Rounding must not hide a collider.
    const float room = reach * 1.001f + 1e-3f + 1e-5f * (length(box.min) + length(box.max));
    box.min = box.min - Vec3{room, room, room};
    box.max = box.max + Vec3{room, room, room};
    std::vector<std::uint32_t>& numbers = cloth_.sheltering[worker];
    numbers.clear();
    input_.places->find(box, numbers);
    for (const std::uint32_t number : numbers) {
        const Collider& collider = input_.colliders[number];
        const Pose& pose = input_.places->pose(number, 0);
        const ContactView view{.kind = static_cast<int>(collider.shape),
                               .numbers = collider.numbers,
                               .data = blocks_of(collider),
                               .steepness = steepness_of(collider),
                               .roundness = roundness_of(collider),
                               .width = width_of(collider),
                               .now = pose,
                               .before = pose,
                               .static_friction = 0,
                               .kinetic_friction = 0,
                               .thickness = {.half = 0},
                               .depenetration = 0};
        passes_.shelter(air, view, reach, mine);
    }
}

}  // namespace weft::cpu
