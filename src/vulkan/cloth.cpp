#include "vulkan/cloth.h"

#include <algorithm>

namespace weft::vulkan {

Result<std::unique_ptr<Cloth>> Cloth::create(gpu::Device& device, Programs& programs,
                                             std::shared_ptr<ModelBuffers> buffers, const WorldParticles& world,
                                             std::uint32_t base) {
    auto self = std::unique_ptr<Cloth>(new Cloth(device, programs));
    auto state = ClothState::create(device, std::move(buffers), world, base);
    if (!state) return state.errors();
    self->state_ = std::move(*state);
    if (auto made = self->make_readable(); !made) return made.errors();
    if (auto done = self->update_normals(); !done) return done.errors();
    return self;
}

Result<void> Cloth::make_readable() {
    const std::uint64_t bytes = model().particle_count * sizeof(Vec4);
    auto readback =
        device_.memory().buffer(3 * bytes, gpu::MemoryKind::readback, "what the host reads of " + model().name);
    if (!readback) return readback.errors();
    readback_ = std::move(*readback);
    auto commands = gpu::Commands::create(device_);
    if (!commands) return commands.errors();
    if (auto begun = commands->begin(); !begun) return begun;
    std::uint64_t to = 0;
    for (const PointArray array : {PointArray::position, PointArray::velocity, PointArray::normals}) {
        commands->copy(state_->world().buffer(), readback_, bytes, state_->offset(array), to);
        to += bytes;
    }
    commands->host_barrier();
    if (auto ended = commands->end(); !ended) return ended;
    read_commands_ = std::move(*commands);
    return {};
}

Result<void> Cloth::update_normals() {
    auto surface = compile_surface(programs_, *state_);
    if (!surface) return surface.errors();
    auto done = gpu::run_once(device_, [&](gpu::Commands& commands) {
        for (const Command& command : *surface) record(commands, command, 0, device_.limits());
    });
    changed(done.ok());
    return done;
}

Result<void> Cloth::particles_moved() {
    if (auto made = make_readable(); !made) return made;
    return surface_ ? surface_->particles_moved() : Result<void>();
}

Result<void> Cloth::follow(std::shared_ptr<ModelBuffers> buffers) {
    const bool longer = buffers->model()->particle_count != model().particle_count;
    const auto before = state_->shared_buffers();
    state_->set_buffers(std::move(buffers));
    auto done = longer ? make_readable() : Result<void>();
    if (done) done = update_normals();
    if (!done) {
        state_->set_buffers(before);
        return done;
    }
    surface_ = nullptr;
    torn = false;
    return {};
}

Result<void> Cloth::make_surface(std::shared_ptr<const DrawnMesh> mesh) {
    auto made = DrawnSurface::create(device_, programs_, *state_, std::move(mesh));
    if (!made) return made.errors();
    surface_ = std::move(*made);
    return {};
}

Result<gpu::SurfaceBuffers> Cloth::surface(gpu::Moment before) {
    if (normals_stale_)
        if (auto updated = update_normals(); !updated) return updated.errors();
    return surface_->update(changes_, before);
}

Result<void> Cloth::read() {
    auto value = read_commands_->submit();
    if (!value) return value.errors();
    return device_.wait(*value);
}

std::span<const Vec4> Cloth::read_array(std::uint32_t which) const {
    const std::size_t count = model().particle_count;
    return std::span<const Vec4>(readback_.as<Vec4>()).subspan(which * count, count);
}

Result<void> Cloth::restore(const ClothSnapshot& snapshot) {
    if (auto done = state_->restore(device_, snapshot); !done) return done;
    return update_normals();
}

void Cloth::measure(MeasureSums& sums) {
    if (const auto found = vulkan::measure(device_, programs_, *state_); found && *found) return sums.add(**found);
    (void)read();  // if it fails, the arrays keep what was read last
    sums.add(model(), positions(), velocities());
    const auto points = state_->download_points(device_, PointArray::position);
    const auto kept = state_->download_kept(device_);
    if (points && kept) sums.add_residual(model(), stretch_residual(model(), *points, *kept, state_->substep_seconds));
}

void Cloth::hash(StateHash& hash) const {
    const auto position = state_->download_points(device_, PointArray::position);
    const auto velocity = state_->download_points(device_, PointArray::velocity);
    const auto compensation = state_->download_points(device_, PointArray::compensation);
    const auto start = state_->download_points(device_, PointArray::start);
    if (!position || !velocity || !compensation || !start) return;
    for (std::uint32_t p = 0; p < model().particle_count; ++p) {
        for (const Vec4& v : {(*position)[p], (*velocity)[p], (*compensation)[p]}) {
            hash.add(v.x), hash.add(v.y), hash.add(v.z), hash.add(v.w);
        }
        hash.add((*start)[p].w);
    }
}

}  // namespace weft::vulkan
