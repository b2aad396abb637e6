#include "vulkan/surface/drawn_surface.h"

#include "vulkan/primitives/recorder.h"
#include "vulkan/surface/args.data.h"

#include <algorithm>
#include <vector>

namespace weft::vulkan {

Result<std::unique_ptr<DrawnSurface>> DrawnSurface::create(gpu::Device& device, Programs& programs,
                                                           const ClothState& cloth,
                                                           std::shared_ptr<const DrawnMesh> mesh) {
    auto self = std::unique_ptr<DrawnSurface>(new DrawnSurface(device, programs, cloth, std::move(mesh)));
    for (Set& set : self->sets_) {
        if (auto made = self->make(set); !made) return made.errors();
        if (auto recorded = self->record(set); !recorded) return recorded.errors();
    }
    return self;
}

DrawnSurface::~DrawnSurface() {
    (void)device_.wait(std::max(sets_[0].written, sets_[1].written));
}

Result<void> DrawnSurface::particles_moved() {
    for (Set& set : sets_) {
        if (auto idle = device_.wait(set.written); !idle) return idle;
        if (auto recorded = record(set); !recorded) return recorded;
    }
    return {};
}

Result<void> DrawnSurface::make(Set& set) {
    const ClothModel& model = *mesh_->model;
    const std::uint64_t bytes = mesh_->vertex_count() * sizeof(Vec4);
    // Vertices without a triangle keep their initial positions, because no pass writes them.
    std::vector<Vec4> still_positions, still_normals;
    if (std::ranges::find(model.vertex_to_particle, none) != model.vertex_to_particle.end()) {
        for (const Vec3 p : model.mesh().positions) still_positions.push_back({p.x, p.y, p.z, 1});
        still_normals.assign(still_positions.size(), {0, 1, 0, 0});
        set.positions = set.arena.add_array(still_positions);
        set.normals = set.arena.add_array(still_normals);
    } else {
        set.positions = set.arena.reserve(bytes);
        set.normals = set.arena.reserve(bytes);
    }
    if (mesh_->uvs.bytes > 0) set.tangents = set.arena.reserve(bytes);
    return set.arena.build(device_, "surface of " + model.name, drawn_usage);
}

Result<void> DrawnSurface::record(Set& set) {
    auto commands = gpu::Commands::create(device_);
    if (!commands) return commands.errors();
    if (auto begun = commands->begin(); !begun) return begun;
    commands->wait_for_all();
    Recorder passes(device_, programs_, *commands);
    const std::uint32_t count = mesh_->vertex_count();
    const auto run = [&](const char* program, const auto& args) {
        const auto pipeline = programs_.get(program);
        passes.run(program, args, pipeline ? groups_of(count, (*pipeline)->workgroup()) : 0);
    };
    const std::uint64_t position = cloth_.address(PointArray::position), normals = cloth_.address(PointArray::normals);
    const std::uint64_t to_position = set.arena.address(set.positions), to_normal = set.arena.address(set.normals);
    if (mesh_->model->binding.empty()) {
        run("drawn_welded", WeldedArgs{.position = position,
                                       .normals = normals,
                                       .particle = mesh_->address(mesh_->particle),
                                       .to_position = to_position,
                                       .to_normal = to_normal,
                                       .count = count,
                                       .unused = 0});
    } else {
        run("drawn_bound", BoundArgs{.position = position,
                                     .normals = normals,
                                     .particles = mesh_->address(mesh_->bound_particles),
                                     .shape = mesh_->address(mesh_->bound_shape),
                                     .to_position = to_position,
                                     .to_normal = to_normal,
                                     .count = count,
                                     .unused = 0});
    }
    if (set.tangents.bytes > 0) {
        run("drawn_tangents", TangentArgs{.position = to_position,
                                          .normal = to_normal,
                                          .triangles = mesh_->address(mesh_->triangles),
                                          .uvs = mesh_->address(mesh_->uvs),
                                          .offsets = mesh_->address(mesh_->around_offsets),
                                          .items = mesh_->address(mesh_->around_items),
                                          .to_tangent = set.arena.address(set.tangents),
                                          .count = count,
                                          .unused = 0});
    }
    if (auto recorded = passes.end(); !recorded) return recorded;
    if (auto ended = commands->end(); !ended) return ended;
    set.commands = std::move(*commands);
    return {};
}

gpu::SurfaceBuffers DrawnSurface::buffers(const Set& set) const {
    return {.positions = range_of(set.arena, set.positions),
            .normals = range_of(set.arena, set.normals),
            .tangents = range_of(set.arena, set.tangents),
            .uvs = range_of(mesh_->arena(), mesh_->uvs),
            .triangles = range_of(mesh_->arena(), mesh_->triangles),
            .vertex_count = mesh_->vertex_count(),
            .triangle_count = static_cast<std::uint32_t>(mesh_->model->mesh().triangles.size()),
            .topology_version = cloth_.model().topology_version,
            .ready = {device_.timeline(), set.written}};
}

Result<gpu::SurfaceBuffers> DrawnSurface::update(std::uint64_t change, gpu::Moment before) {
    if (change_ == change) return buffers(sets_[current_]);
    const std::size_t next = (current_ + 1) % sets_.size();
    Set& set = sets_[next];
    // A command buffer must not be submitted again while it is pending.
    if (auto idle = device_.wait(set.written); !idle) return idle.errors();
    auto value = set.commands->submit(before);
    if (!value) return value.errors();
    set.written = *value;
    current_ = next;
    change_ = change;
    return buffers(set);
}

}  // namespace weft::vulkan
