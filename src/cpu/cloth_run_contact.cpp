// Contact of a cloth with colliders, worker by worker.
#include "cpu/cloth_run.h"

#include <cmath>

namespace weft::cpu {

// Lists made before a tile left its box may miss a collider, so each pass of contact begins with a check.
ColliderPart& ClothRun::cover_colliders(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const {
    ColliderPart& part = cloth_.near_colliders.part(worker.number);
    if (substep == 0 && pass.first_iteration) part.begin_frame({mine.begin, mine.end});
    const float left = static_cast<float>(plan_.substeps - substep), seconds = numbers_.h * left;
    part.cover(
        passes_, view_, *input_.places,
        {.fall = input_.gravity * (0.5f * seconds * seconds),
         .substeps = left,
         .margin = numbers_.half_thickness + model().mean_edge + (has_face_contact(plan_) ? widest_face(model()) : 0)});
    return part;
}

void ClothRun::run_contacts(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const {
    if (input_.colliders.empty()) return;
    ColliderPart& part = cover_colliders(pass, substep, mine, worker);
    const bool traces = !cloth_.account.empty();
    for (const ColliderRun& run : part.runs()) {
        for (const NearCollider& near : part.near(run)) {
            ContactView view = contact_view(near, substep);
            view.first_iteration = pass.first_iteration;
            view.sums = part.sums(near);
            view.moved = part.moved(near);
            view.turned = part.turned(near);
            const auto& loops = traces ? passes_.contact_traced : passes_.contact;
            loops[static_cast<std::uint32_t>(view.kind)](view_, view, {run.begin, run.end});
        }
    }
}

ContactView ClothRun::contact_view(const NearCollider& near, std::uint32_t substep) const {
    const Collider& collider = input_.colliders[near.collider];
    const auto [static_friction, kinetic_friction] = friction_between(model(), collider);
    return {.kind = static_cast<int>(collider.shape),
            .numbers = collider.numbers,
            .data = blocks_of(collider),
            .steepness = steepness_of(collider),
            .roundness = std::isfinite(collider.roundness) ? collider.roundness : 0,
            .now = input_.places->pose(near.collider, substep + 1),
            .before = input_.places->pose(near.collider, substep),
            .static_friction = static_friction,
            .kinetic_friction = kinetic_friction,
            .half_thickness = numbers_.half_thickness,
            .depenetration = numbers_.depenetration};
}

void ClothRun::run_face_contact(const Pass& pass, std::uint32_t substep, Worker worker) const {
    FaceContacts& contacts = cloth_.face_contacts;
    const float nearest = nearest_of_faces(numbers_.half_thickness);
    const bool last = pass.batch == face_sweeps;
    if (pass.kind == PassKind::find_faces) {
        contacts.begin(worker.number);
        if (input_.colliders.empty()) return;
        const ColliderPart& part = cloth_.near_colliders.part(worker.number);
        for (const ColliderRun& run : part.runs()) {
            for (const NearCollider& near : part.near(run)) {
                if (faces_touch(model(), input_.colliders[near.collider]))
                    contacts.find(passes_, worker.number, view_, *model().faces_by_tile, run, near.collider,
                                  contact_view(near, substep), nearest);
            }
        }
    } else if (pass.kind == PassKind::push_faces) {
        contacts.push(passes_, worker.number, view_, last, numbers_.depenetration, nearest);
    } else if (cloth_.account.empty()) {
        contacts.move(worker.number, view_, last);
    } else if (worker.number == 0) {
        // The log adds up floats, so one thread adds them in the order of the contacts.
        contacts.for_each_push(view_, last, [&](std::uint32_t particle, std::uint32_t collider, Vec3 by) {
            cloth_.near_colliders.trace(particle, collider, view_, by,
                                        input_.places->pose(collider, substep + 1).position);
        });
        for (unsigned other = 0; other < worker.count; ++other) contacts.move(other, view_, last);
    }
}

void ClothRun::count_contacts(Worker worker) const {
    if (cloth_.account.empty()) return;
    cloth_.account.count(worker.number, cloth_.near_colliders.part(worker.number), model().particle_count,
                         cloth_.now().position, 1.0f / numbers_.h);
}

}  // namespace weft::cpu
