#include "vulkan/cloth_state.h"

#include "solver/state/list_counts.h"
#include "vulkan/args.data.h"

#include <algorithm>
#include <cstddef>
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

// What a tile usually touches at most.
constexpr std::uint32_t usual_colliders = 4;

}  // namespace

std::uint32_t near_tiles_of(const ClothModel& model) {
    return (model.point_count() + WEFT_COLLIDER_TILE - 1) / WEFT_COLLIDER_TILE;
}

std::uint32_t first_near_slots(const ClothModel& model, std::uint32_t colliders, std::uint32_t list_capacity) {
    const double usual = static_cast<double>(near_tiles_of(model)) * std::min(colliders, usual_colliders);
    const double part = std::min(1.0, static_cast<double>(list_capacity) / default_list_capacity);
    return static_cast<std::uint32_t>(std::clamp(usual * part, 1.0, static_cast<double>(most_near_slots)));
}

Result<WorkBuffers> WorkBuffers::create(gpu::Device& device, const ClothModel& model, const WorldPlan& plan,
                                        const InputShape& shape, std::uint32_t slots) {
    constexpr std::uint64_t block = sizeof(Vec4);
    WorkBuffers work;
    if (has(plan.frame_begin, PassKind::wind)) work.wind = work.arena.reserve(model.face_stride * block);
    std::vector<std::vector<Vec4>> nodes;
    nodes.reserve(model.hierarchy.size());
    if (has(plan.substep, PassKind::prolongation)) {
        for (const CoarseLevel& coarse : model.hierarchy) {
            auto& start = nodes.emplace_back(coarse.capacity());  // zeros, for constraints that pad
            const std::uint64_t bytes = coarse.capacity() * block;
            work.levels.push_back({.position = work.arena.add_array(start),
                                   .origin = work.arena.reserve(bytes),
                                   .displacement = work.arena.reserve(bytes),
                                   .lambda = work.arena.reserve(coarse.limits.stride * sizeof(float)),
                                   .remainder = plan.compensated ? work.arena.reserve(bytes) : Slot{}});
        }
    }
    for (const ConstraintTable& table : model.constraints) {
        if (stores_lambda(plan, table, model) && table.kind != ConstraintKind::stretch)
            work.lambda[static_cast<std::uint32_t>(table.kind)] =
                work.arena.reserve(table.lambda_count() * sizeof(float));
    }
    if (plan.steadies && model.has_pin_loads())
        work.steady_parts = work.arena.reserve(model.capacity() * sizeof(float));
    if (plan.compensated) work.remainder = work.arena.reserve(model.capacity() * block);
    if (plan.weighs_taut) work.taut = work.arena.reserve(model.capacity() * block);
    if (plan.reads_kept) work.good_kept = work.arena.reserve(model.kept_floats() * sizeof(float));
    if (shape.colliders > 0) {
        const std::uint64_t sums = std::uint64_t{slots} * WEFT_COLLIDER_TILE * block;
        work.slot_count = slots;
        work.near_tiles = work.arena.reserve(near_tiles_of(model) * sizeof(NearTileIn));
        work.near_slots = work.arena.reserve(slots * sizeof(std::uint32_t));
        if (rounds_of(plan, model) > 1 || has(plan.substep, PassKind::touch_bodies))
            work.contact_sums = work.arena.reserve(sums);
        if (has(plan.substep, PassKind::touch_bodies))
            work.supports = work.arena.reserve(std::uint64_t{model.point_count()} * WEFT_SUPPORT_BLOCKS * block);
        if (shape.contact_forces) work.contact_log = work.arena.reserve(2 * sums);
        if (has_face_contact(plan)) {
            const std::uint64_t blocks = WEFT_FACE_CONTACT_BLOCKS + (shape.contact_forces ? 1 : 0);
            work.face_contacts =
                work.arena.reserve(std::uint64_t{slots} * model.faces_by_tile->most_in_tile * blocks * block);
            work.face_sums = work.arena.reserve(
                (std::uint64_t{WEFT_FACE_SUM + 2} * model.particle_count + WEFT_FACE_WORDS) * sizeof(std::uint32_t));
        }
    }
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

Result<std::unique_ptr<ClothState>> ClothState::create(gpu::Device& device, std::shared_ptr<ModelBuffers> buffers,
                                                       const WorldParticles& world, std::uint32_t base) {
    auto self = std::unique_ptr<ClothState>(new ClothState(std::move(buffers), world, base));
    const ClothModel& model = self->model();
    Arena& arena = self->arena_;
    std::vector<float> weights;
    for (const Vec4& start : model.start) weights.push_back(start.w);
    self->weights = arena.add_array(weights);
    if (!model.thickness_factors.empty()) self->thickness = arena.add_array(model.thickness_factors);
    self->by_face = arena.reserve((std::uint64_t{model.face_stride} + 1) * sizeof(Vec4));
    self->kept = arena.reserve(model.kept_floats() * sizeof(float));
    const std::array none = {0.0f, 1.0f};  // tension and allowed (LimitsIn)
    self->limits = arena.add_array(none);
    if (auto built = arena.build(device, "state of " + model.name); !built) return built.errors();
    // The range may still hold the particles of a removed cloth.
    const std::vector<Vec4> velocities = start_velocities(model), zeros(model.capacity());
    for (std::uint32_t i = 0; i < point_array_count; ++i) {
        const auto array = static_cast<PointArray>(i);
        std::span<const Vec4> values = zeros;
        if (array == PointArray::position) values = model.start;
        if (array == PointArray::velocity) values = velocities;
        if (auto done = upload(device, world.buffer(), self->offset(array), std::as_bytes(values)); !done)
            return done.errors();
    }
    return self;
}

Result<std::vector<Vec4>> ClothState::download_points(gpu::Device& device, PointArray array) const {
    std::vector<Vec4> points(model().point_count());
    auto done = download(device, world_.buffer(), offset(array), std::as_writable_bytes(std::span(points)));
    if (!done) return done.errors();
    return points;
}

Result<std::vector<float>> ClothState::download_kept(gpu::Device& device) const {
    return download_as<float>(device, arena_, kept);
}

// The changed weights are few and scattered: one submission copies each of them.
Result<void> ClothState::set_weights(gpu::Device& device, std::span<const ParticleWeight> changed) {
    if (changed.empty()) return {};
    std::vector<float> values;
    for (const ParticleWeight& one : changed) values.push_back(one.weight);
    auto staging = device.memory().buffer(values.size() * sizeof(float), gpu::MemoryKind::upload, "inverse masses");
    if (!staging) return staging.errors();
    std::memcpy(staging->mapped().data(), values.data(), values.size() * sizeof(float));
    return gpu::run_once(device, [&](gpu::Commands& commands) {
        for (std::size_t i = 0; i < changed.size(); ++i) {
            const std::uint64_t p = changed[i].particle, from = i * sizeof(float);
            commands.copy(*staging, arena_.buffer(), sizeof(float), from, weights.offset + p * sizeof(float));
            commands.copy(*staging, world_.buffer(), sizeof(float), from,
                          offset(PointArray::position) + p * sizeof(Vec4) + offsetof(Vec4, w));
        }
    });
}

// Inverse masses are stored twice: in `weights` and as w of the positions.
Result<void> ClothState::set_masses(gpu::Device& device, const ClothModel& other) {
    auto inverse = download_as<float>(device, arena_, weights);
    if (!inverse) return inverse.errors();
    auto position = download_points(device, PointArray::position);
    if (!position) return position.errors();
    for (std::uint32_t p = 0; p < other.particle_count; ++p)
        (*inverse)[p] = (*position)[p].w = (*inverse)[p] > 0 ? 1 / other.mass[p] : 0;
    if (auto done = upload(device, arena_, weights, std::as_bytes(std::span(*inverse))); !done) return done;
    return upload(device, world_.buffer(), offset(PointArray::position), std::as_bytes(std::span(*position)));
}

Result<void> ClothState::set_material(gpu::Device& device, std::shared_ptr<const ClothModel> other) {
    const auto before = buffers_->model();
    if (auto done = buffers_->set_material(device, std::move(other)); !done) return done;
    if (model().mass.shares(before->mass)) return {};
    auto done = set_masses(device, model());
    if (!done) {
        (void)buffers_->set_material(device, before);
        (void)set_masses(device, *before);
    }
    return done;
}

Result<void> ClothState::set_material(gpu::Device& device, std::shared_ptr<ModelBuffers> buffers) {
    if (!buffers->model()->mass.shares(model().mass)) {
        if (auto done = set_masses(device, *buffers->model()); !done) {
            (void)set_masses(device, model());
            return done;
        }
    }
    buffers_ = std::move(buffers);
    return {};
}

Result<void> ClothState::place_points(gpu::Device& device, std::uint32_t first, std::span<const Vec3> places) {
    std::vector<Vec4> at;
    for (const Vec3& place : places) at.push_back({place.x, place.y, place.z, 0});
    std::vector<Vec4> zeros(at.size());
    const std::uint64_t skipped = first * sizeof(Vec4);
    for (const auto& [array, values] :
         {std::pair{PointArray::position, &at}, std::pair{PointArray::start, &at},
          std::pair{PointArray::velocity, &zeros}, std::pair{PointArray::compensation, &zeros}}) {
        auto done = upload(device, world_.buffer(), offset(array) + skipped, std::as_bytes(std::span(*values)));
        if (!done) return done;
    }
    const std::vector<float> weightless(at.size());
    return upload(device, arena_.buffer(), weights.offset + first * sizeof(float),
                  std::as_bytes(std::span(weightless)));
}

Result<ClothSnapshot> ClothState::save(gpu::Device& device) const {
    ClothSnapshot snapshot;
    snapshot.substep_seconds = substep_seconds;
    for (const auto& [which, to] :
         {std::pair{PointArray::position, &snapshot.position}, std::pair{PointArray::start, &snapshot.start},
          std::pair{PointArray::velocity, &snapshot.velocity},
          std::pair{PointArray::compensation, &snapshot.compensation}}) {
        auto array = download_points(device, which);
        if (!array) return array.errors();
        *to = std::move(*array);
    }
    auto inverse_masses = download_as<float>(device, arena_, {weights.offset, model().point_count() * sizeof(float)});
    if (!inverse_masses) return inverse_masses.errors();
    for (std::size_t p = 0; p < snapshot.position.size(); ++p) snapshot.position[p].w = (*inverse_masses)[p];
    auto floats = download_kept(device);
    if (!floats) return floats.errors();
    snapshot.kept = std::move(*floats);
    return snapshot;
}

Result<void> ClothState::restore(gpu::Device& device, const ClothSnapshot& snapshot) {
    std::vector<float> inverse_masses;
    for (const Vec4& p : snapshot.position) inverse_masses.push_back(p.w);
    if (auto done = upload(device, arena_, weights, std::as_bytes(std::span(inverse_masses))); !done) return done;
    const auto put = [&](PointArray array, const std::vector<Vec4>& from) {
        return upload(device, world_.buffer(), offset(array), std::as_bytes(std::span(from)));
    };
    if (auto done = put(PointArray::position, snapshot.position); !done) return done;
    if (auto done = put(PointArray::start, snapshot.start); !done) return done;
    if (auto done = put(PointArray::velocity, snapshot.velocity); !done) return done;
    if (auto done = put(PointArray::compensation, snapshot.compensation); !done) return done;
    substep_seconds = snapshot.substep_seconds;
    return upload(device, arena_, kept, std::as_bytes(std::span(snapshot.kept)));
}

}  // namespace weft::vulkan
