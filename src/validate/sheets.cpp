#include "validate/sheets.h"

#include "collide/body_features.h"
#include "collide/body_mass.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace weft::cases {

ClothId add_sheet(World& world, SheetOf sheet) {
    ClothModelDesc desc{.name = "sheet", .mesh = std::move(sheet.mesh), .fabric = sheet.fabric};
    desc.layout = world.settings().layout();
    const std::vector<Vec3> rest = desc.mesh.positions;
    auto topology = build_topology(desc.mesh, {.reorder = false});
    if (!topology) throw std::runtime_error(topology.error().message());
    if (topology->particle_count != rest.size()) throw std::runtime_error("the mesh has unused vertices");
    for (std::uint32_t p = 0; p < rest.size(); ++p)
        if (sheet.pinned && sheet.pinned(rest[p])) desc.pins.particles.push_back(p);
    desc.pins.attachments = std::move(sheet.springs);
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    if (!model) throw std::runtime_error(model.error().message());
    auto id = world.try_add(std::move(*model), std::move(sheet.targets));
    if (!id) throw std::runtime_error(id.error().message());
    if (sheet.place) {
        Snapshot snapshot = world.save();
        for (auto* array : {&snapshot.cloths.back().position, &snapshot.cloths.back().start}) {
            for (std::uint32_t p = 0; p < rest.size(); ++p) {
                const Vec3 x = sheet.place(rest[p]);
                (*array)[p] = {x.x, x.y, x.z, (*array)[p].w};
            }
        }
        if (auto placed = world.restore(snapshot); !placed) throw std::runtime_error(placed.error().message());
    }
    return *id;
}

ColliderId add_body(World& world, const ColliderShape& shape, const BodyDesc& body, Vec3 position) {
    ColliderDesc desc{.name = "body", .shape = shape, .body = body};
    desc.transform.position = position;
    Collider collider = make_collider(desc);
    const auto mass = body_mass_of(body, shape, nullptr);
    if (!mass) throw std::runtime_error(mass.error().message());
    collider.body = Body{.mass = *mass, .state = {}, .desc = body};
    collider.features = features_of(shape, nullptr);
    return world.add(std::move(collider));
}

Fabric elastic_fabric(double stiffness, double density) {
    const auto k = static_cast<float>(stiffness);
    Fabric fabric;
    fabric.body = {.density = static_cast<float>(density), .damping = 0};
    fabric.stretch = {.stretch = {k, k}, .compression = {k, k}, .shear = 0};
    fabric.bend = {.bend = {0, 0, 0}};
    return fabric;
}

void run(World& world, double seconds, double frame_seconds) {
    const long frames = std::lround(seconds / frame_seconds);
    for (long i = 0; i < frames; ++i) world.step(frame_seconds);
    if (world.frame().reports & report_non_finite) throw std::runtime_error("the state became non-finite");
}

double timed_run(World& world, double seconds) {
    const auto begin = std::chrono::steady_clock::now();
    run(world, seconds);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
    return taken.count() / std::round(60 * seconds);
}

void settle(World& world, double seconds, double frame_seconds, double slow) {
    const long frames = std::lround(seconds / frame_seconds);
    double before = 0;
    for (long i = 0; i < frames; ++i) {
        run(world, frame_seconds, frame_seconds);
        double now = 0, fastest = 0;
        for (const ClothFrame& cloth : world.frame().cloths) {
            for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
                const Vec3 v = cloth.velocities[p].xyz();
                const double squared = double{dot(v, v)};
                now += double{cloth.model->mass[p]} * squared;
                fastest = std::max(fastest, squared);
            }
        }
        if (i > 10 && fastest < slow * slow) return;
        if (now >= before) {
            before = now;
            continue;
        }
        before = 0;
        stop(world);
    }
}

void stop(World& world) {
    Snapshot snapshot = world.save();
    for (ClothSnapshot& cloth : snapshot.cloths) {
        std::ranges::fill(cloth.velocity, Vec4{});
        std::ranges::fill(cloth.compensation, Vec4{});
    }
    if (auto restored = world.restore(snapshot); !restored) throw std::runtime_error(restored.error().message());
}

std::vector<Vec4> places(const World& world) {
    const auto& x = world.frame().cloths.front().positions;
    return {x.begin(), x.end()};
}

double rms_distance(const std::vector<Vec4>& a, const std::vector<Vec4>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 d = a[i].xyz() - b[i].xyz();
        sum += double{dot(d, d)};
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
}

void compare_with_converged(Validation& validation, RestingShape shape, double (*known)(std::uint32_t substeps)) {
    const std::uint32_t side = validation.quick() ? 17 : 33;
    const auto converged = shape(validation, side, 300, false).places;
    for (const std::uint32_t substeps : {5u, 10u, 20u, 60u}) {
        if (validation.quick() && substeps != 20) continue;
        const Rest rest = shape(validation, side, substeps, true);
        validation.add({.what = "distance from the converged sheet (RMS), " + std::to_string(side) + "², " +
                                std::to_string(substeps) + " substeps, default solver",
                        .unit = "m",
                        .measured = rms_distance(rest.places, converged),
                        .expected = 0.003,
                        .bound = Bound::at_most,
                        .known = known(substeps),
                        .settings = {{"side", side}, {"substeps", substeps}},
                        .ms_per_frame = rest.ms_per_frame});
    }
}

std::array<double, 3> momentum(const World& world) {
    std::array<double, 3> sum{};
    for (const ClothFrame& cloth : world.frame().cloths) {
        for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
            const double m = cloth.model->mass[p];
            const Vec4 v = cloth.velocities[p];
            sum[0] += m * double{v.x}, sum[1] += m * double{v.y}, sum[2] += m * double{v.z};
        }
    }
    return sum;
}

std::array<double, 3> position(const World& world, std::uint32_t particle) {
    const Vec4 x = world.frame().cloths.front().positions[particle];
    return {double{x.x}, double{x.y}, double{x.z}};
}

std::array<double, 3> center_of_mass(const World& world) {
    const ClothFrame& cloth = world.frame().cloths.front();
    std::array<double, 3> sum{};
    double mass = 0;
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
        const double m = cloth.model->mass[p];
        const std::array<double, 3> x = position(world, p);
        for (std::size_t i = 0; i < 3; ++i) sum[i] += m * x[i];
        mass += m;
    }
    for (double& x : sum) x /= mass;
    return sum;
}

}  // namespace weft::cases
