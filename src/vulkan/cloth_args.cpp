#include "vulkan/cloth_args.h"

#include "solver/plan/tension.h"

#include <algorithm>

namespace weft::vulkan {

ParticleArgs ClothArgs::particle_args() const {
    return {.position = state(PointArray::position),
            .start = state(PointArray::start),
            .velocity = state(PointArray::velocity),
            .compensation = state(PointArray::compensation),
            .frame = input_.frame(),
            .report = input_.report(),
            .steady_parts = work_.steady_parts.bytes > 0 ? work(work_.steady_parts) : 0,
            .remainder = remainder(),
            .count = model_.point_count(),
            .unused = 0};
}

SteadyArgs ClothArgs::steady_args() const {
    return {.position = state(PointArray::position),
            .weights = state(cloth_.weights),
            .steadiness = of_model(buffers_.steadiness),
            .pins = of_model(buffers_.pins),
            .parts = work(work_.steady_parts),
            .frame = input_.frame(),
            .count = model_.point_count(),
            .unused = 0};
}

KeepArgs ClothArgs::keep_args() const {
    return {.position = state(PointArray::position),
            .start = state(PointArray::start),
            .velocity = state(PointArray::velocity),
            .compensation = state(PointArray::compensation),
            .good_position = state(PointArray::good_position),
            .good_velocity = state(PointArray::good_velocity),
            .good_compensation = state(PointArray::good_compensation),
            .weights = state(cloth_.weights),
            .kept = state(cloth_.kept),
            .good_kept = work_.good_kept.bytes > 0 ? work(work_.good_kept) : 0,
            .remainder = remainder(),
            .report = input_.report(),
            .island_report = island_.report,
            .count = model_.point_count(),
            .kept_count = static_cast<std::uint32_t>(model_.kept_floats()),
            .first_shift = static_cast<std::uint32_t>(model_.first_shift()),
            .unused = 0};
}

CoupleArgs ClothArgs::couple_args(ConstraintKind kind) const {
    const auto index = static_cast<std::uint32_t>(kind);
    const TableBuffers& buffers = buffers_.tables[index];
    const std::uint32_t stride = model_.constraints[index].stride;
    return {.lambda = lambda_of(kind),
            .shifts = shifts_of(kind),
            .rows = of_model(buffers.coupled),
            .numbers = of_model(buffers.coupling),
            .frame = input_.frame(),
            .stride = stride,
            .count = stride};
}

std::uint64_t ClothArgs::shifts_of(ConstraintKind kind) const {
    if (!model_.table(kind).is_coupled()) return 0;
    return state(cloth_.kept) + model_.first_shift() * sizeof(float);
}

TautArgs ClothArgs::taut_args() const {
    return {.position = state(PointArray::position),
            .start = state(PointArray::start),
            .sums = work(work_.taut),
            .weights = state(cloth_.weights),
            .count = model_.point_count(),
            .unused = 0};
}

LimitArgs ClothArgs::limit_args() const {
    const ConstraintTable& table = model_.table(ConstraintKind::stretch);
    const TableBuffers& rows = buffers_.tables[static_cast<std::uint32_t>(ConstraintKind::stretch)];
    const StretchMaterial material = softest_stretch(model_);
    const double softest = std::min(material.stretch[0], material.stretch[1]);
    const Elasticity& elastic = model_.elasticity;
    return {.position = state(PointArray::position),
            .particles = of_model(rows.particles),
            .fields = of_model(rows.fields),
            .lambda = state(cloth_.kept),
            .span_ends = of_model(buffers_.span_ends),
            .span_lengths = of_model(buffers_.span_lengths),
            .limits = state(cloth_.limits),
            .frame = input_.frame(),
            .rows = table.stride,
            .first_dummy = table.first_dummy,
            .stride = table.stride,
            .spans = static_cast<std::uint32_t>(model_.pin_spans.size()),
            .softest = static_cast<float>(softest),
            .model_tension = static_cast<float>(elastic.tension),
            .stretched = static_cast<float>(std::max(elastic.warp, elastic.weft)),
            .straight_strain = straight_strain(material),
            .straight = static_cast<float>(std::min(elastic.straight, 1e30)),
            .unused0 = 0,
            .unused1 = 0,
            .unused2 = 0};
}

FaceArgs ClothArgs::face_args() const {
    return {.position = state(PointArray::position),
            .velocity = state(PointArray::velocity),
            .faces = of_model(buffers_.faces),
            .mass = of_model(buffers_.face_mass),
            .wind = work(work_.wind),
            .by_face = state(cloth_.by_face),
            .normals = state(PointArray::normals),
            .frame = input_.frame(),
            .winds = input_.winds(),
            .colliders = island_.colliders,
            .stride = model_.face_stride,
            .count = model_.face_stride};
}

AroundArgs ClothArgs::around_args() const {
    return {.by_face = state(cloth_.by_face),
            .offsets = of_model(buffers_.around_offsets),
            .items = of_model(buffers_.around_items),
            .normals = state(PointArray::normals),
            .position = state(PointArray::position),
            .start = state(PointArray::start),
            .velocity = state(PointArray::velocity),
            .compensation = state(PointArray::compensation),
            .count = model_.particle_count,
            .unused = 0};
}

std::uint64_t ClothArgs::remainder() const {
    return work_.remainder.bytes > 0 ? work(work_.remainder) : 0;
}

std::uint64_t ClothArgs::remainder_of_level(std::uint32_t level) const {
    const Slot& slot = work_.levels[level].remainder;
    return slot.bytes > 0 ? work(slot) : 0;
}

std::uint64_t ClothArgs::lambda_of(ConstraintKind kind) const {
    return kind == ConstraintKind::stretch ? state(cloth_.kept) : work(work_.lambda[static_cast<std::uint32_t>(kind)]);
}

std::uint32_t ClothArgs::use_of_lambda(const Pass& pass, std::uint32_t substep) const {
    const bool links = pass.source == RowSource::links;
    return number_of(links ? lambda_use(plan_, pass, substep, rounds_of_links(plan_))
                           : lambda_use(plan_, model_, pass, substep));
}

RowArgs ClothArgs::row_args(ConstraintKind kind) const {
    const auto index = static_cast<std::uint32_t>(kind);
    const TableBuffers& rows = buffers_.tables[index];
    return {.position = state(PointArray::position),
            .moves = remainder(),
            .particles = of_model(rows.particles),
            .fields = of_model(rows.fields),
            .lambda = lambda_of(kind),
            .corrections = 0,
            .sums = 0,
            .share = 0,
            .blocks = 0,
            .frame = input_.frame(),
            .limits = state(cloth_.limits),
            .shifts = shifts_of(kind),
            .plain_positive = stiffness_[index][0],
            .plain_negative = stiffness_[index][1],
            .stride = model_.constraints[index].stride,
            .begin = 0,
            .count = 0,
            .modes = WEFT_LAMBDA_DISCARD | WEFT_ROWS_SINGLE};
}

std::uint32_t ClothArgs::hand_out(RowArgs& args, const Batch& batch, std::uint64_t blocks) {
    args.begin = batch.begin;
    args.count = batch.rows;
    if (batch.serial) {
        args.modes |= WEFT_ROWS_SERIAL;
        return 1;
    }
    if (batch.blocks == 0) return batch.rows;
    args.modes |= WEFT_ROWS_LINES;
    args.blocks = blocks + std::uint64_t{batch.first_block} * 2 * sizeof(std::uint32_t);
    args.count = batch.blocks;
    return batch.blocks * lane_padding;
}

}  // namespace weft::vulkan
