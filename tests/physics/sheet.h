// Small worlds for the physical tests.
#pragma once

#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "solver/measures/statistics.h"
#include "solver/world/world.h"

#include <gtest/gtest.h>

#ifdef WEFT_VULKAN
#include "../vulkan/vulkan_fixture.h"
#endif

#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace weft::physical {

struct SheetDesc {
    std::array<float, 2> size{1, 1};
    std::array<std::uint32_t, 2> resolution{9, 9};
    GridDiagonal diagonal = GridDiagonal::alternating;
    Vec3 rotation_degrees = {};
    Vec3 position = {};
    Vec3 velocity = {};  ///< m/s, at the start
    Fabric fabric = {};
    ClothLayout layout = {};
    SelfCollision self_collision = SelfCollision::off;
    CollisionFilter filter = {};
    std::uint32_t layer = 0;
    // Called with positions in the flat sheet, before rotation and translation:
    std::function<bool(Vec3 at_rest)> pinned = {};
    std::function<float(Vec3 at_rest)> spring = {};  ///< m/N: holds a particle where it starts; 0 for none
    std::function<Vec3(Vec3 at_rest)> shape = {};    ///< bends the sheet at rest
    // Factors on values of the fabric:
    std::function<float(Vec3 at_rest)> density = {}, stretch = {}, bend = {}, thickness = {};
    ClothReserve reserve = {};
};

inline ClothWeights::Factors factors_of(const std::function<float(Vec3)>& at, const std::vector<Vec3>& flat,
                                        const Topology& topology) {
    ClothWeights::Factors factors;
    if (!at) return factors;
    factors.of_particles.resize(topology.particle_count);
    for (std::uint32_t v = 0; v < flat.size(); ++v) factors.of_particles[topology.vertex_to_particle[v]] = at(flat[v]);
    for (const auto& [a, b, c] : topology.triangles)
        factors.of_triangles.push_back((factors.of_particles[a] + factors.of_particles[b] + factors.of_particles[c]) /
                                       3);
    return factors;
}

inline std::shared_ptr<const ClothModel> make_sheet(const SheetDesc& desc) {
    TriangleMesh mesh = make_grid(desc.size, desc.resolution, desc.diagonal);
    const auto flat = mesh.positions;
    const Mat3 turn = rotation_from_degrees(desc.rotation_degrees);
    for (Vec3& p : mesh.positions) p = turn * (desc.shape ? desc.shape(p) : p) + desc.position;
    auto topology = build_topology(mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    ClothModelDesc model{.name = "sheet",
                         .mesh = std::move(mesh),
                         .start_velocity = desc.velocity,
                         .fabric = desc.fabric,
                         .weights = {.density = factors_of(desc.density, flat, *topology),
                                     .stretch = factors_of(desc.stretch, flat, *topology),
                                     .bend = factors_of(desc.bend, flat, *topology),
                                     .thickness = factors_of(desc.thickness, flat, *topology)},
                         .collision = {desc.self_collision, desc.filter, desc.layer},
                         .layout = desc.layout,
                         .reserve = desc.reserve};
    for (std::uint32_t v = 0; v < flat.size(); ++v) {
        const std::uint32_t p = topology->vertex_to_particle[v];
        if (desc.pinned && desc.pinned(flat[v])) model.pins.particles.push_back(p);
        const float compliance = desc.spring ? desc.spring(flat[v]) : 0;
        if (compliance > 0) model.pins.attachments.push_back({p, compliance, model.mesh.positions[v]});
    }
    auto built = build_cloth_model(std::move(model), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

/// A grid turned upright into the plane z = 0, moved by `center` along x. `pinned`: called with positions in the flat
/// grid.
inline std::shared_ptr<const ClothModel> make_upright(ClothModelDesc desc, TriangleMesh grid,
                                                      const std::function<bool(Vec3)>& pinned, float center = 0) {
    for (std::uint32_t p = 0; p < grid.positions.size(); ++p) {
        Vec3& x = grid.positions[p];
        if (pinned(x)) desc.pins.particles.push_back(p);
        x = {x.x + center, -x.z, 0};
    }
    auto topology = build_topology(grid, {.reorder = false});
    desc.mesh = std::move(grid);
    auto built = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

/// A square meter that hangs by two corners, not quite upright.
inline SheetDesc hung_by_corners(std::uint32_t side, const ClothLayout& layout) {
    return {.resolution = {side, side}, .rotation_degrees = {84.3f, 0, 0}, .layout = layout, .pinned = [](Vec3 p) {
                return p.z < -0.49f && std::abs(p.x) > 0.49f;
            }};
}

/// A square meter of 17 by 17 particles that hangs upright by two corners.
inline SheetDesc hung_upright(const ClothLayout& layout = {}) {
    return {.resolution = {17, 17}, .rotation_degrees = {90, 0, 0}, .layout = layout, .pinned = [](Vec3 p) {
                return p.z < -0.49f && std::abs(p.x) > 0.49f;
            }};
}

/// An elastic sheet, 1 m long, that hangs by its upper edge at y = 0. `stiffness` and `shear` in N/m.
inline SheetDesc hanging_strip(std::array<std::uint32_t, 2> resolution, float stiffness, float shear) {
    SheetDesc sheet{.size = {0.25f, 1},
                    .resolution = resolution,
                    .rotation_degrees = {90, 0, 0},
                    .position = {0, -0.5f, 0},
                    .pinned = [](Vec3 p) { return p.z < -0.49f; }};
    sheet.fabric.body = {.density = 0.2f, .damping = 0.2f};
    sheet.fabric.stretch = {.stretch = {stiffness, stiffness}, .compression = {stiffness, stiffness}, .shear = shear};
    return sheet;
}

/// Sag of the lower edge of such a strip, m.
inline double sag(const World& world) {
    double lowest = 0;
    for (const Vec4& p : world.frame().cloths[0].positions) lowest = std::min(lowest, double{p.y});
    return -1 - lowest;
}

inline Result<void> set_fabric(World& world, ClothId id, const Fabric& fabric) {
    auto model = with_fabric(*world.model(id), fabric);
    EXPECT_TRUE(model.ok() && *model);
    return world.set_material(id, std::move(*model));
}

/// All threads share small sheets too, so that tests of sharing need no large ones.
inline World make_world(const WorldSettings& settings, CpuOptions options) {
    options.smallest_shared = 0;
    auto backend = make_cpu_backend(options);
    EXPECT_TRUE(backend.ok());
    return World(std::move(*backend), settings);
}

/// On the CPU, or on the backend that the environment variable WEFT_TEST_BACKEND names.
inline World make_world(const WorldSettings& settings) {
    const char* backend = std::getenv("WEFT_TEST_BACKEND");
    if (!backend || std::string_view(backend) != "vulkan") return make_world(settings, CpuOptions{});
#ifdef WEFT_VULKAN
    return World(checked_vulkan_backend(), settings);
#else
    throw std::runtime_error("this build has no Vulkan");
#endif
}

inline World make_world(const WorldSettings& settings, const SheetDesc& sheet) {
    World world = make_world(settings);
    world.add(make_sheet(sheet));
    return world;
}

inline World make_world(const WorldSettings& settings, const SheetDesc& sheet, const CpuOptions& options) {
    World world = make_world(settings, options);
    world.add(make_sheet(sheet));
    return world;
}

inline void run(World& world, double seconds, double frame_rate = 60) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds * frame_rate)); ++i) world.step(1 / frame_rate);
}

/// Mass-weighted, pinned particles included.
inline Vec3 center_of_mass(const ClothFrame& cloth) {
    double x = 0, y = 0, z = 0, m = 0;
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
        const double mass = cloth.model->mass[p];
        x += mass * cloth.positions[p].x, y += mass * cloth.positions[p].y, z += mass * cloth.positions[p].z, m += mass;
    }
    return {static_cast<float>(x / m), static_cast<float>(y / m), static_cast<float>(z / m)};
}

}  // namespace weft::physical
