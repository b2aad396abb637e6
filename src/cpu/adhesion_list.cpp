#include "cpu/adhesion_list.h"

#include "physics/scalar.h"

namespace weft::cpu {
namespace {

scalar::vec3 lane(Vec3 v) {
    return {v.x, v.y, v.z};
}

float distance(const Collider& collider, scalar::vec3 local) {
    const scalar::ShapeNumbers numbers{collider.numbers[0], collider.numbers[1], collider.numbers[2],
                                       collider.numbers[3], blocks_of(collider)};
    scalar::vec3 normal(0.0f);
    switch (collider.shape) {
#define WEFT_SHAPE(name, Name) \
    case ShapeKind::name:      \
        return scalar::distance_##name(local, numbers, normal);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    }
    return 0;
}

// The particles that a worker processes: the same as in all other passes, so that consecutive passes that access only
// their own particles need no barrier between them.
Share particles_of(const ClothState& cloth, Worker worker) {
    Share share = worker.of(padded(cloth.model->point_count()));
    share.end = std::min(share.end, cloth.model->particle_count);
    return share;
}

}  // namespace

void AdhesionList::prepare(const ListContext& context) {
    std::uint32_t items = 0;
    first_item_.clear();
    const ClothState& first = *context.cloths.front();
    first_dummy_ = first.base + first_dummy(first.model->room());
    for (const ClothState* cloth : context.cloths) {
        first_item_.push_back(items);
        items += cloth->model->particle_count;
    }
    wanted_capacity_ = std::max(wanted_capacity_, first_list_capacity(context.step.input.list_capacity));
    rows_.prepare(ConstraintKind::adhesion, items, wanted_capacity_);
    targets_.resize(wanted_capacity_);
}

void AdhesionList::run(const ListContext& context, const Pass& pass, std::uint32_t substep, Worker worker) {
    switch (pass.kind) {
        case PassKind::find:
            return find(context, worker);
        case PassKind::place:
            if (worker.number == 0) rows_.place(first_dummy_);
            return;
        case PassKind::list:
            return list(context, worker);
        case PassKind::aim:
            return aim(context, substep, worker);
        case PassKind::correct:
            return correct(context, pass, substep, worker);
        default:
            return average(context, worker);
    }
}

template <class Visit>
void AdhesionList::for_each_target(const ListContext& context, const ClothState& cloth, std::uint32_t particle,
                                   const FrameNumbers& numbers, Visit&& visit) {
    const StepInput& input = context.step.input;
    const Vec4 x = cloth.now().position[particle];
    const AlignedVector<float>& factors = cloth.thickness_factors;
    const float half_thickness = factors.empty() ? numbers.half_thickness : numbers.half_thickness * factors[particle];
    for (std::uint32_t c = 0; c < input.colliders.size(); ++c) {
        const Collider& collider = input.colliders[c];
        if (!collider.adhesion || !shape_acts_on(collider, *cloth.model)) continue;
        const Pose& pose = input.places->pose(c, 0);  // at the start of the frame
        const auto& [rx, ry, rz] = pose.rotation;
        const scalar::vec3 local = scalar::unrotate(lane(rx), lane(ry), lane(rz), lane(x.xyz()) - lane(pose.position));
        const float gap = distance(collider, local) - half_thickness;
        if (scalar::adheres(gap, collider.adhesion->distance, x.w)) visit(c, Vec3{local.x, local.y, local.z});
    }
}

void AdhesionList::find(const ListContext& context, Worker worker) {
    for (std::size_t i = 0; i < context.cloths.size(); ++i) {
        const ClothState& cloth = *context.cloths[i];
        const FrameNumbers numbers = frame_numbers(*cloth.model, *context.step.plan, context.step.input.dt);
        const Share mine = particles_of(cloth, worker);
        for (std::uint32_t p = mine.begin; p < mine.end; ++p) {
            std::uint32_t count = 0;
            for_each_target(context, cloth, p, numbers, [&](std::uint32_t, Vec3) { ++count; });
            rows_.found()[first_item_[i] + p] = count;
        }
    }
}

void AdhesionList::list(const ListContext& context, Worker worker) {
    for (std::size_t i = 0; i < context.cloths.size(); ++i) {
        const ClothState& cloth = *context.cloths[i];
        const FrameNumbers numbers = frame_numbers(*cloth.model, *context.step.plan, context.step.input.dt);
        const Share mine = particles_of(cloth, worker);
        for (std::uint32_t p = mine.begin; p < mine.end; ++p) {
            const std::uint32_t item = first_item_[i] + p, end = rows_.first_row(item + 1);
            std::uint32_t row = rows_.first_row(item);
            if (row == end) continue;
            for_each_target(context, cloth, p, numbers, [&](std::uint32_t collider, Vec3 local) {
                if (row == end) return;  // the list is full
                rows_.put(row, cloth.base + p);
                rows_.set(row, 3, context.step.input.colliders[collider].adhesion->compliance);
                targets_[row++] = {local, collider};
            });
        }
    }
}

void AdhesionList::aim(const ListContext& context, std::uint32_t substep, Worker worker) {
    const StepInput& input = context.step.input;
    const Share mine = worker.of(padded(rows_.rows()));
    for (std::uint32_t row = mine.begin; row < std::min(mine.end, rows_.rows()); ++row) {
        const auto& [local, collider] = targets_[row];
        const Pose& pose = input.places->pose(collider, substep + 1);
        const auto& [rx, ry, rz] = pose.rotation;
        const scalar::vec3 target = scalar::rotate(lane(rx), lane(ry), lane(rz), lane(local)) + lane(pose.position);
        rows_.set(row, 0, target.x), rows_.set(row, 1, target.y), rows_.set(row, 2, target.z);
    }
}

void AdhesionList::correct(const ListContext& context, const Pass& pass, std::uint32_t substep, Worker worker) {
    const Share mine = worker.of(padded(rows_.rows()));
    WorldArrays& world = context.cloths.front()->world;
    const WorldPlan& plan = *context.step.plan;
    const float h = frame_numbers(*context.cloths.front()->model, plan, context.step.input.dt).h;
    const RowView view{rows_.stride(), rows_.particles(), rows_.fields(), rows_.lambda()};
    // Fabrics have no plain stiffness for adhesion, so plain position-based dynamics uses 1.
    const CorrectionView out{.blocks = rows_.corrections(),
                             .share = context.step.plan->method == Method::pbd ? nullptr : rows_.share(),
                             .stiffness = {1, 1}};
    context.passes.correct[static_cast<std::uint32_t>(pass.constraint)](
        world.range(0, world.size()).view(), view, out, {mine.begin, mine.end}, h,
        lambda_use(plan, pass, substep, rounds_of_links(plan)));
}

void AdhesionList::average(const ListContext& context, Worker worker) {
    for (std::size_t i = 0; i < context.cloths.size(); ++i) {
        const ClothState& cloth = *context.cloths[i];
        const Share mine = particles_of(cloth, worker);
        const GatherView gather{.blocks = rows_.corrections(),
                                .offsets = rows_.places() + first_item_[i],
                                .items = rows_.items(),
                                .mean = context.step.plan->method == Method::pbd,
                                .fixed = false};
        if (mine.begin < mine.end) context.passes.average(cloth.now().view(), gather, {mine.begin, mine.end});
    }
}

}  // namespace weft::cpu
