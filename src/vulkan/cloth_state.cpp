#include "vulkan/cloth_state.h"

#include "vulkan/args.data.h"

#include <algorithm>
#include <cstring>

namespace weft::vulkan {
namespace {

template <class T>
Result<std::vector<T>> download_as(gpu::Device& device, const Arena& arena, Slot slot) {
    auto bytes = download(device, arena, slot);
    if (!bytes) return bytes.errors();
    std::vector<T> values(bytes->size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes->data(), bytes->size());
    return values;
}

bool has(const std::vector<Pass>& passes, PassKind kind) {
    return std::ranges::find(passes, kind, &Pass::kind) != passes.end();
}

}  // namespace

Result<WorkBuffers> WorkBuffers::create(gpu::Device& device, const ClothModel& model, const StepPlan& plan,
                                        const InputShape& shape) {
    constexpr std::uint64_t block = sizeof(Vec4);
    WorkBuffers work;
    if (has(plan.frame_begin, PassKind::wind)) work.wind = work.arena.reserve(model.face_stride * block);
    std::vector<std::vector<Vec4>> nodes;
    nodes.reserve(model.hierarchy.size());
    if (has(plan.substep, PassKind::spread)) {
        for (const CoarseLevel& coarse : model.hierarchy) {
            auto& start = nodes.emplace_back(coarse.capacity());
            for (std::uint32_t node = 0; node < coarse.count; ++node) start[node].w = coarse.weight[node];
            const std::uint64_t bytes = coarse.capacity() * block;
            work.levels.push_back({.position = work.arena.add_array(start),
                                   .origin = work.arena.reserve(bytes),
                                   .displacement = work.arena.reserve(bytes),
                                   .lambda = work.arena.reserve(coarse.reach.stride * sizeof(float))});
        }
    }
    for (const ConstraintTable& table : model.constraints) {
        if (plan.iterations > 1 && table.kind != ConstraintKind::stretch)
            work.lambda[static_cast<std::uint32_t>(table.kind)] =
                work.arena.reserve(table.lambda_count() * sizeof(float));
    }
    if (plan.iterations > 1)
        work.contact_sums = work.arena.reserve(std::uint64_t{shape.colliders} * model.capacity() * block);
    if (shape.feedback) work.felt = work.arena.reserve(2 * std::uint64_t{shape.colliders} * model.capacity() * block);
    const ConstraintTable& stretch = model.table(ConstraintKind::stretch);
    if (plan.projection == Projection::lines && !stretch.blocks.empty())
        work.line_scratch = work.arena.reserve(2 * std::uint64_t{stretch.stride} * block);
    JacobiGather gather;
    if (plan.projection == Projection::jacobi) {
        gather = build_gather(model);
        const bool fixed = plan.accumulate == Accumulate::fixed_point;
        if (fixed) {
            work.sums = work.arena.reserve(model.capacity() * block);
        } else {
            work.corrections = work.arena.reserve(gather.blocks * block);
        }
        work.gather_offsets = work.arena.add_array(gather.offsets);
        work.gather_items = work.arena.add_array(gather.items);
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            work.share[kind] = work.arena.add_array(gather.share[kind]);
            const ConstraintTable& table = model.constraints[kind];
            if (fixed) continue;
            work.corrections_of[kind] = {work.corrections.offset + gather.first[kind] * block,
                                         std::uint64_t{table.stride} * table.arity * block};
        }
    }
    if (work.arena.size() == 0) return work;
    if (auto built = work.arena.build(device, "work of " + model.name); !built) return built.errors();
    return work;
}

Result<std::unique_ptr<ClothState>> ClothState::create(gpu::Device& device,
                                                       std::shared_ptr<const ModelBuffers> buffers) {
    auto self = std::unique_ptr<ClothState>(new ClothState(std::move(buffers)));
    const ClothModel& model = self->model();
    const std::uint64_t points = std::uint64_t{model.capacity()} * sizeof(Vec4);
    Arena& arena = self->arena_;
    self->position = arena.add_array(model.start);
    for (Slot* slot : {&self->start, &self->velocity, &self->carry, &self->good_position, &self->good_velocity,
                       &self->good_carry, &self->normals})
        *slot = arena.reserve(points);
    self->by_face = arena.reserve((std::uint64_t{model.face_stride} + 1) * sizeof(Vec4));
    self->lambda = arena.reserve(model.table(ConstraintKind::stretch).lambda_count() * sizeof(float));
    const std::array none = {0.0f, 1.0f};  // no tension, nothing more allowed
    self->limits = arena.add_array(none);
    if (auto built = arena.build(device, "state of " + model.name); !built) return built.errors();
    return self;
}

Result<std::vector<Vec4>> ClothState::download_points(gpu::Device& device, Slot slot) const {
    return download_as<Vec4>(device, arena_, {slot.offset, model().point_count() * sizeof(Vec4)});
}

Result<std::vector<float>> ClothState::download_lambda(gpu::Device& device) const {
    return download_as<float>(device, arena_, lambda);
}

Result<ClothSnapshot> ClothState::save(gpu::Device& device) const {
    ClothSnapshot snapshot;
    snapshot.substep_seconds = substep_seconds;
    for (const auto& [slot, to] : {std::pair{position, &snapshot.position}, std::pair{start, &snapshot.start},
                                   std::pair{velocity, &snapshot.velocity}, std::pair{carry, &snapshot.carry}}) {
        auto array = download_points(device, slot);
        if (!array) return array.errors();
        *to = std::move(*array);
    }
    for (Vec4& p : snapshot.position) p.w = 0;
    auto multipliers = download_lambda(device);
    if (!multipliers) return multipliers.errors();
    snapshot.lambda = std::move(*multipliers);
    return snapshot;
}

Result<Done> ClothState::restore(gpu::Device& device, const ClothSnapshot& snapshot) {
    std::vector<Vec4> positions = snapshot.position;
    for (std::size_t p = 0; p < positions.size(); ++p) positions[p].w = model().start[p].w;
    const auto put = [&](Slot slot, const std::vector<Vec4>& from) {
        return upload(device, arena_, slot, std::as_bytes(std::span(from)));
    };
    if (auto done = put(position, positions); !done) return done;
    if (auto done = put(start, snapshot.start); !done) return done;
    if (auto done = put(velocity, snapshot.velocity); !done) return done;
    if (auto done = put(carry, snapshot.carry); !done) return done;
    substep_seconds = snapshot.substep_seconds;
    return upload(device, arena_, lambda, std::as_bytes(std::span(snapshot.lambda)));
}

}  // namespace weft::vulkan
