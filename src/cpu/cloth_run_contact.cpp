// Contact of a cloth with colliders, worker by worker.
#include "cpu/cloth_run.h"
#include "cpu/moving_ball.h"
#include "physics/scalar.h"

#include <algorithm>
#include <ranges>

namespace weft::cpu {
namespace {

// Among so many colliders most are near few of the faces that are near one of them.
constexpr std::uint32_t least_colliders_to_narrow = 4;

scalar::ContactBody body_between(const Pose& before, const Pose& now) {
    const auto of = [](Vec3 v) { return scalar::vec3(v.x, v.y, v.z); };
    scalar::ContactBody body;
    body.rx = of(now.rotation.x), body.ry = of(now.rotation.y), body.rz = of(now.rotation.z);
    body.position = of(now.position);
    body.rx0 = of(before.rotation.x), body.ry0 = of(before.rotation.y), body.rz0 = of(before.rotation.z);
    body.position0 = of(before.position);
    return body;
}

}  // namespace

// Lists made before a tile left its box may miss a collider, so each pass of contact begins with a check.
ColliderPart& ClothRun::cover_colliders(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const {
    ColliderPart& part = cloth_.near_colliders.part(worker.number);
    const PassKind first = bodies_.empty() ? PassKind::contact : PassKind::count_touches;
    if (substep == 0 && pass.kind == first && pass.first_iteration)
        part.begin_frame({mine.begin, mine.end}, !model().collision.meets_surfaces());
    const float left = static_cast<float>(plan_.substeps - substep), seconds = numbers_.h * left;
    part.cover(passes_, view_, *input_.places, bodies_,
               {.fall = input_.gravity * (0.5f * seconds * seconds),
                .substeps = left,
                .margin = numbers_.tile_margin,
                .widest = widest_face(model()),
                .longest = cloth_.face_contacts.longest_edge()});
    return part;
}

void ClothRun::run_contacts(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const {
    if (input_.colliders.empty()) return;
    ColliderPart& part = cover_colliders(pass, substep, mine, worker);
    const bool traces = !cloth_.account.empty();
    if (bodies_.empty()) cloth_.face_contacts.clear_near({mine.begin, mine.end});
    for (const ColliderRun& run : part.runs()) {
        const bool presses = supports(part.near(run));
        for (const NearCollider& near : part.near(run)) {
            if (is_body(near)) continue;
            ContactView view = contact_view(near, substep);
            view.first_iteration = pass.first_iteration;
            view.sums = part.sums(near);
            view.moved = part.moved(near);
            view.turned = part.turned(near);
            if (presses) view.support = cloth_.support_view();
            mark_near_faces(run, near, view);
            const auto& loops = traces ? passes_.contact_traced : passes_.contact;
            loops[static_cast<std::uint32_t>(view.kind)](view_, view, {run.begin, run.end});
        }
        if (presses) cloth_.clear_taken({run.begin, run.end});
    }
}

// Whether bodies may press particles near these colliders on one of them.
bool ClothRun::supports(std::span<const NearCollider> near) const {
    const auto is_one = [this](const NearCollider& one) { return is_body(one); };
    return !bodies_.empty() && std::ranges::any_of(near, is_one) && !std::ranges::all_of(near, is_one);
}

// What lies behind the particles of a run in the substep.
void ClothRun::find_supports(const ColliderRun& run, std::span<const NearCollider> near, std::uint32_t substep) const {
    for (const NearCollider& one : near) {
        if (is_body(one)) continue;
        ContactView view = contact_view(one, substep);
        view.support = cloth_.support_view();
        passes_.find_support[static_cast<std::uint32_t>(view.kind)](view_, view, {run.begin, run.end});
    }
}

// Before the first sweep of an iteration particles are counted, or the sweep begins the marks of faces.
void ClothRun::run_body_contacts(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const {
    ColliderPart& part = cover_colliders(pass, substep, mine, worker);
    const bool traces = !cloth_.account.empty(), counts = pass.kind == PassKind::count_touches;
    if (counts) {
        for (const Range& pressed : part.pressed) cloth_.clear_supports(pressed);
        part.pressed.clear();
    }
    if (counts || !pass.first_iteration) cloth_.face_contacts.clear_near({mine.begin, mine.end});
    place_balls(part, substep);
    NearBalls balls{.balls = part.balls.data(),
                    .half_thickness = numbers_.half_thickness_range[1],
                    .nearest = nearest_of_faces(numbers_.half_thickness_range[1])};
    for (const ColliderRun& run : part.runs()) {
        const bool presses = supports(part.near(run));
        const Range range{run.begin, run.end};
        std::uint8_t* const touched = part.touched(run);
        if (!counts && pass.first_iteration) std::fill_n(touched, run.count, std::uint8_t{0});
        balls.numbers = part.bodies(run), balls.count = run.count;
        balls.always = counts ? nullptr : touched;
        balls.inside = presses ? numbers_.depenetration : 0;
        balls.faces = !counts && cloth_.face_contacts.near_faces(run);
        if (presses && counts) {
            find_supports(run, part.near(run), substep);
            part.pressed.push_back({run.begin, run.end});
        }
        const auto next = [&](std::uint32_t first) { return passes_.first_near(view_, balls, range, first); };
        for (std::uint32_t k = next(0); k < run.count; k = next(k + 1)) {
            const NearCollider& near = part.near(run)[k];
            ContactView view = contact_view(near, substep);
            const BodyView body = bodies_.view(bodies_.body_of(near.collider), worker.number);
            const auto kind = static_cast<std::uint32_t>(view.kind);
            if (presses) view.support = cloth_.support_view();
            if (counts) {
                passes_.count_touches[kind](view_, view, body, range);
                continue;
            }
            view.first_iteration = touched[k] == 0;
            touched[k] = 1;
            view.sums = part.sums(near);
            view.moved = traces ? part.moved(near) : nullptr;
            view.turned = traces ? part.turned(near) : nullptr;
            mark_near_faces(run, near, view);
            passes_.touch_body[kind](view_, view, body, range);
        }
    }
}

// Lets contact of the run mark particles whose faces the collider may touch. What faces do not touch only moves
// particles.
void ClothRun::mark_near_faces(const ColliderRun& run, const NearCollider& near, ContactView& view) const {
    view.near_faces = cloth_.face_contacts.near_faces(run);
    view.nearest = nearest_of_faces(numbers_.half_thickness_range[1]);
    view.widest = widest_to_touch(near.collider);
}

float ClothRun::widest_to_touch(std::uint32_t collider) const {
    const bool touches_faces = faces_touch(model(), input_.colliders[collider]);
    return touches_faces ? std::max(widest_face(model()), cloth_.face_contacts.longest_edge())
                         : -static_cast<float>(far_away);
}

MovingBall ClothRun::ball_of(std::uint32_t number, std::uint32_t substep) const {
    const Collider& collider = input_.colliders[number];
    const std::uint32_t body = bodies_.body_of(number);
    if (body != none)
        return moving_ball(collider, bodies_.ball_radius(body), bodies_.before(body), bodies_.now(body),
                           widest_to_touch(number));
    return moving_ball(collider, ball_radius(collider), input_.places->pose(number, substep),
                       input_.places->pose(number, substep + 1), widest_to_touch(number));
}

void ClothRun::place_balls(ColliderPart& part, std::uint32_t substep) const {
    part.balls.clear();
    for (std::uint32_t body = 0; body < bodies_.count(); ++body)
        part.balls.push_back(ball_of(bodies_.collider_of(body), substep));
}

ThicknessView ClothRun::thickness() const {
    const AlignedVector<float>& factors = cloth_.thickness_factors;
    return {.half = numbers_.half_thickness, .factors = factors.empty() ? nullptr : factors.data()};
}

ContactView ClothRun::contact_view(const NearCollider& near, std::uint32_t substep) const {
    const Collider& collider = input_.colliders[near.collider];
    const std::uint32_t body = bodies_.body_of(near.collider);
    const auto [static_friction, kinetic_friction] = friction_between(model(), collider);
    return {.kind = static_cast<int>(collider.shape),
            .numbers = collider.numbers,
            .data = blocks_of(collider),
            .steepness = steepness_of(collider),
            .roundness = roundness_of(collider),
            .width = width_of(collider),
            .now = body == none ? input_.places->pose(near.collider, substep + 1) : bodies_.now(body),
            .before = body == none ? input_.places->pose(near.collider, substep) : bodies_.before(body),
            .static_friction = static_friction,
            .kinetic_friction = kinetic_friction,
            .thickness = thickness(),
            .depenetration = numbers_.depenetration,
            .fall = input_.gravity * numbers_.h,
            .h = numbers_.h,
            .free = bodies_.empty() && cloth_.steady_parts.empty() ? nullptr : cloth_.weights().data(),
            .number = static_cast<float>(near.collider)};
}

// Calls collect(run) for runs near the same colliders, then visit(near) for each collider that their faces may touch,
// and so on. Many faces at a time leave few lanes empty.
template <class Collect, class Visit>
void ClothRun::for_each_near_face(const Pass& pass, std::uint32_t substep, Worker worker, Collect&& collect,
                                  Visit&& visit) const {
    if (input_.colliders.empty()) return;
    ColliderPart& part = cloth_.near_colliders.part(worker.number);
    FaceContacts& contacts = cloth_.face_contacts;
    place_balls(part, substep);
    const float nearest = pass.kind == PassKind::find_faces ? nearest_of_faces(numbers_.half_thickness_range[1]) : 0;
    const auto touches = [&](const NearCollider& near) {
        const std::uint32_t body = bodies_.body_of(near.collider);
        return body == none ? faces_touch(model(), input_.colliders[near.collider]) : part.balls[body].widest > 0;
    };
    const auto touched = [&](const ColliderRun& run) { return part.near(run) | std::views::filter(touches); };
    const auto alike = [&](const ColliderRun& a, const ColliderRun& b) {
        auto of_a = touched(a), of_b = touched(b);
        return std::ranges::equal(of_a, of_b, {}, &NearCollider::collider, &NearCollider::collider);
    };
    const ColliderRun* first = nullptr;  // of those collected
    const auto visit_collected = [&] {
        if (!first) return;
        const bool narrows = first->count >= least_colliders_to_narrow;
        for (const NearCollider& near : touched(*first)) {
            const std::uint32_t body = bodies_.body_of(near.collider);
            const auto may_touch = [&](const MovingBall& ball) {
                return contacts.narrow(passes_, worker.number, view_, *model().faces_by_tile, ball, nearest);
            };
            if (!narrows || may_touch(body == none ? ball_of(near.collider, substep) : part.balls[body])) visit(near);
        }
        contacts.drop_collected(worker.number);
        first = nullptr;
    };
    for (const ColliderRun& run : part.runs()) {
        if (touched(run).empty()) continue;
        if (first && !alike(*first, run)) visit_collected();
        if (!first) first = &run;
        collect(run);
    }
    visit_collected();
}

void ClothRun::run_face_contact(const Pass& pass, std::uint32_t substep, Worker worker) const {
    FaceContacts& contacts = cloth_.face_contacts;
    const FacesByTile& faces = *model().faces_by_tile;
    switch (pass.kind) {
        case PassKind::longest_edge:
            if (!input_.colliders.empty()) contacts.find_longest_edge(passes_, worker.number, view_, faces, substep);
            break;
        case PassKind::find_faces:
            contacts.begin(worker.number);
            for_each_near_face(
                pass, substep, worker, [&](const ColliderRun& run) { contacts.collect(worker.number, faces, run); },
                [&](const NearCollider& near) {
                    const bool moved = gives(near.collider);
                    const std::size_t found = contacts.find(passes_, worker.number, view_, faces, near.collider,
                                                            contact_view(near, substep), moved);
                    if (!moved) return;
                    bodies_.add_touches(worker.number, bodies_.body_of(near.collider),
                                        static_cast<std::uint32_t>(found));
                });
            break;
        case PassKind::push_faces:
            contacts.push(passes_, worker.number, view_, bodies_, pass.batch == face_sweeps, numbers_.depenetration,
                          thickness());
            break;
        case PassKind::move_faces:
            move_faces(pass.batch == face_sweeps, worker);
            break;
        case PassKind::hold_faces:
            if (contacts.any_fast()) hold_faces(pass, substep, worker);
            break;
        case PassKind::settle_faces:
            if (contacts.any_fast()) settle_faces(pass, substep, worker);
            break;
        default:  // finish_holds
            if (worker.number == 0) finish_holds(pass, substep, worker.count);
            break;
    }
}

void ClothRun::hold_faces(const Pass& pass, std::uint32_t substep, Worker worker) const {
    FaceContacts& contacts = cloth_.face_contacts;
    const FacesByTile& faces = *model().faces_by_tile;
    const bool last = pass.kind == PassKind::finish_holds;
    for_each_near_face(
        pass, substep, worker, [&](const ColliderRun& run) { contacts.collect_again(worker.number, faces, run, last); },
        [&](const NearCollider& near) {
            if (last && gives(near.collider)) return;
            contacts.hold(passes_, worker.number, view_, faces, near.collider, contact_view(near, substep),
                          last || pass.batch > 0);
        });
}

// Whether cloth moves the collider.
bool ClothRun::gives(std::uint32_t collider) const {
    const std::uint32_t body = bodies_.body_of(collider);
    return body != none && bodies_.feels_cloth(body);
}

// A particle that is held lets the faces around it pass, whose particles are held in turn, and so on. Few are left
// here, so one thread holds them all.
void ClothRun::finish_holds(const Pass& pass, std::uint32_t substep, unsigned workers) const {
    FaceContacts& contacts = cloth_.face_contacts;
    contacts.end_substep();
    for (std::uint32_t round = 0; round < most_hold_rounds && contacts.any_settled(); ++round) {
        for (unsigned worker = 0; worker < workers; ++worker) hold_faces(pass, substep, {worker, workers});
        contacts.forget_settled();
        for (unsigned worker = 0; worker < workers; ++worker) settle_faces_of(worker, substep, true);
    }
}

// The log of contacts adds up floats, so with a log one thread does this for all, in the order of the contacts. With
// bodies too, because they need to know how far each contact moves a particle before any of them is moved.
void ClothRun::move_faces(bool last, Worker worker) const {
    FaceContacts& contacts = cloth_.face_contacts;
    if (cloth_.account.empty() && !contacts.any_of_bodies()) return contacts.move(worker.number, view_);
    if (worker.number != 0) return;
    contacts.for_each_push(view_, last, [&](std::uint32_t particle, std::uint32_t collider, Vec3 by, Vec3 lever) {
        log_contact(particle, collider, by, lever);
        push_back(particle, collider, by);
    });
    for (unsigned other = 0; other < worker.count; ++other) contacts.move(other, view_);
}

void ClothRun::log_contact(std::uint32_t particle, std::uint32_t collider, Vec3 by, Vec3 lever) const {
    if (cloth_.account.empty()) return;
    const float heavier = scalar::mass_ratio(view_.position[4 * std::size_t{particle} + 3], cloth_.weights()[particle]);
    cloth_.near_colliders.trace(particle, collider, by * heavier, lever);
}

// The collider gets the opposite of what it did to a particle, if it is a body. One thread at a time.
void ClothRun::push_back(std::uint32_t particle, std::uint32_t collider, Vec3 by) const {
    if (!gives(collider)) return;
    const float* x = view_.position + 4 * std::size_t{particle};
    bodies_.add_push(0, bodies_.body_of(collider), by, Vec3{x[0], x[1], x[2]} + by, x[3]);
}

// Likewise.
void ClothRun::settle_faces(const Pass& pass, std::uint32_t substep, Worker worker) const {
    const bool logs = !cloth_.account.empty() || cloth_.face_contacts.any_of_bodies();
    if (logs && worker.number != 0) return;
    for (unsigned of = logs ? 0 : worker.number; of < (logs ? worker.count : worker.number + 1); ++of)
        settle_faces_of(of, substep, pass.batch + 1 == face_holds);
}

// Moves the particles that the worker has marked. What a body gave way to for a held particle is not known here, so
// that faces around it are not tried again.
void ClothRun::settle_faces_of(unsigned worker, std::uint32_t substep, bool last) const {
    cloth_.face_contacts.for_each_held(worker, last, [&](std::uint32_t p, std::uint32_t collider, float part) {
        float* x = view_.position + 4 * std::size_t{p};
        const float* start = view_.start + 4 * std::size_t{p};
        if (!(x[3] > 0)) return false;
        const std::uint32_t number = bodies_.body_of(collider);
        const Pose now = number == none ? input_.places->pose(collider, substep + 1) : bodies_.now(number);
        const scalar::ContactBody body =
            body_between(number == none ? input_.places->pose(collider, substep) : bodies_.before(number), now);
        const scalar::vec3 at{x[0], x[1], x[2]};
        const scalar::vec3 held =
            held_place(body, to_body_at_start(body, {start[0], start[1], start[2]}), to_body(body, at), part);
        const Vec3 place{held.x, held.y, held.z}, before{x[0], x[1], x[2]};
        if (place == before) return false;
        log_contact(p, collider, place - before, before - now.position);
        push_back(p, collider, place - before);
        x[0] = place.x, x[1] = place.y, x[2] = place.z;
        return !gives(collider);
    });
}

void ClothRun::count_contacts(Worker worker) const {
    if (cloth_.account.empty()) return;
    cloth_.account.count(worker.number, cloth_.near_colliders.part(worker.number), model().particle_count,
                         cloth_.now().position, 1.0f / numbers_.h);
}

}  // namespace weft::cpu
