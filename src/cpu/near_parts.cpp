#include "cpu/near_parts.h"

#include "collide/bvh.h"
#include "solver/plan/cloth_contact_numbers.h"
#include "solver/plan/particle_contact_numbers.h"

#include <algorithm>
#include <cmath>

namespace weft::cpu {
namespace {

// The guess allows for motion that velocities do not tell: so many mean edges, and a part of the fastest motion.
constexpr float guessed_edges = 2, guessed_part = 0.5f;

// How far from the places that it looks at the contact of a cloth can act, m. Of two cloths, the sum counts.
float reach_of(const ClothModel& model, float surface_motion) {
    if (model.collision.surface) return 0;
    float reach = 0;
    if (model.along_curve) reach = 0.5f * particle_diameter(model);
    if (model.tiles) {
        // Sweeps and the limit move particles by a cap and a part of it.
        reach = std::max(reach, 0.5f * pair_thickness(model) + 1.5f * carried_cap(contact_cap(model), surface_motion));
    }
    return reach;
}

Bounds widened(Bounds box, float by) {
    const Vec3 more{by, by, by};
    return {box.min - more, box.max + more};
}

bool is_finite(const Bounds& box) {
    const Vec3 sum = box.min + box.max;
    return std::isfinite(sum.x + sum.y + sum.z);
}

// Where the particles are now, and where they will be if they keep their velocities.
Bounds guessed_box(const ClothState& cloth, float dt) {
    const Particles now = cloth.now();
    Bounds box = cloth.bounds(), moved;
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) moved.include(now.velocity[p].xyz() * dt);
    if (moved.empty()) return box;
    const Vec3 fastest{std::max(std::fabs(moved.min.x), std::fabs(moved.max.x)),
                       std::max(std::fabs(moved.min.y), std::fabs(moved.max.y)),
                       std::max(std::fabs(moved.min.z), std::fabs(moved.max.z))};
    box.include(Bounds{box.min + moved.min, box.max + moved.max});
    return widened(box, guessed_edges * cloth.model->mean_edge + guessed_part * length(fastest));
}

// Around the surface of a collider at the end of all substeps.
Bounds swept_surface(const ClothState& surface, const ClothStep& step) {
    Bounds box = surface.bounds(), local;
    if (step.targets.empty()) return box;
    for (const KinematicTarget& target : step.targets) local.include(target.local);
    for (const Pose& pose : step.motion_poses) box.include(to_world(pose, local));
    return box;
}

}  // namespace

void NearParts::begin(const IslandStep& step, std::span<ClothState* const> cloths, const StepInput& input) {
    cloths_ = {};
    swept_.clear();
    if (step.parts.size() == 1) return;
    cloths_ = cloths;
    surface_motion_ = input.surface_motion;
    swept_.resize(cloths.size());
    part_of_.resize(cloths.size());
    grouped_ = DisjointSets(static_cast<std::uint32_t>(step.parts.size()));
    for (std::uint32_t part = 0; part < step.parts.size(); ++part)
        for (std::uint32_t i = step.parts[part].begin; i < step.parts[part].end; ++i) part_of_[i] = part;
    std::vector<Bounds> guess;
    for (std::size_t i = 0; i < cloths.size(); ++i) {
        const bool surface = cloths[i]->model->collision.surface;
        if (surface) swept_[i] = swept_surface(*cloths[i], step.cloths[i]);
        guess.push_back(surface ? swept_[i] : guessed_box(*cloths[i], static_cast<float>(input.dt)));
    }
    (void)merge(guess);
}

bool NearParts::merge() {
    return !swept_.empty() && merge(swept_);
}

bool NearParts::merge(std::span<const Bounds> boxes) {
    std::vector<Bounds> reached;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        // A frame with such a box is taken back.
        const bool counts = !boxes[i].empty() && is_finite(boxes[i]);
        reached.push_back(counts ? widened(boxes[i], reach_of(*cloths_[i]->model, surface_motion_)) : Bounds{});
    }
    bool any = false;
    Bvh(reached).for_each_pair([&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t one = part_of_[a], two = part_of_[b];
        if (grouped_.first_of(one) == grouped_.first_of(two)) return;
        if (!can_collide(cloths_[a]->model->collision, cloths_[b]->model->collision)) return;
        grouped_.merge(one, two);
        any = true;
    });
    return any;
}

}  // namespace weft::cpu
