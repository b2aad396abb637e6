#include "solver/model/collider_surface.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace weft {
namespace {

// Without stiffness there are no constraints. The density has no effect, because all particles are pinned.
Fabric fabric_of_surface(std::array<float, 2> friction) {
    Fabric fabric;
    fabric.body.density = 1;
    fabric.body.damping = 0;
    fabric.contact = {.thickness = 0, .friction = {friction[0], friction[1]}};
    for (int k = 0; k < 2; ++k) fabric.stretch.stretch[k] = fabric.stretch.compression[k] = 0;
    fabric.stretch.shear = 0;
    for (float& bend : fabric.bend.bend) bend = 0;
    fabric.tether.use = Tethers::off;
    return fabric;
}

}  // namespace

Result<ColliderSurface> build_collider_surface(const std::string& name, const TriangleMesh& mesh,
                                               std::array<float, 2> friction) {
    auto topology = build_topology(mesh);
    if (!topology) return topology.errors();
    ColliderSurface surface{.model = {}, .report = topology->report};
    std::vector<std::uint32_t> all(topology->particle_count);
    std::iota(all.begin(), all.end(), 0u);
    auto built = build_cloth_model({.name = name,
                                    .mesh = {.positions = mesh.positions, .triangles = mesh.triangles},
                                    .fabric = fabric_of_surface(friction),
                                    .pins = {.particles = std::move(all)}},
                                   std::move(*topology));
    if (!built) return built.errors();
    auto model = std::make_shared<ClothModel>(**built);
    model->collision = {.with_cloth = SelfCollision::exact, .surface = true};
    model->make_tiles_if_needed();
    surface.model = std::move(model);
    return surface;
}

std::shared_ptr<const ClothModel> with_friction(const ClothModel& surface, std::array<float, 2> friction) {
    auto model = std::make_shared<ClothModel>(surface);
    std::ranges::copy(friction, model->fabric.contact.friction);
    return model;
}

}  // namespace weft
