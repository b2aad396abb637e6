// Worlds in which cloth falls on itself and on other cloth.
#pragma once

#include "sheet.h"

#include "collide/crossings.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace weft::physical {

/// Crossing pairs of triangles, over all cloths of the world.
inline std::uint64_t crossings(const World& world) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const ClothFrame& cloth : world.frame().cloths) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const Vec4& x : cloth.positions) positions.push_back(x.xyz());
        for (const Triangle t : cloth.triangles) triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return count_crossings(positions, triangles).triangles;
}

inline double mean_speed(const World& world) {
    double sum = 0;
    std::size_t count = 0;
    for (const ClothFrame& cloth : world.frame().cloths) {
        for (const Vec4& v : cloth.velocities) sum += std::hypot(v.x, v.y, v.z);
        count += cloth.velocities.size();
    }
    return sum / static_cast<double>(count);
}

/// Sum of the momenta in kg·m/s, and the sum of their lengths.
inline std::array<double, 4> momentum(const World& world) {
    std::array<double, 4> sum{};
    for (const ClothFrame& cloth : world.frame().cloths) {
        for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
            const double m = cloth.model->mass[p];
            const Vec4 v = cloth.velocities[p];
            sum[0] += m * v.x, sum[1] += m * v.y, sum[2] += m * v.z, sum[3] += m * std::hypot(v.x, v.y, v.z);
        }
    }
    return sum;
}

inline bool all_finite(const World& world) {
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const Vec4& x : cloth.positions)
            if (!(std::abs(x.x) + std::abs(x.y) + std::abs(x.z) < 1e3)) return false;
    return true;
}

struct Outcome {
    std::uint64_t worst = 0;    ///< crossings of any frame
    std::uint64_t limited = 0;  ///< particles sent back in the last second
    double speed = 0;           ///< m/s, mean at the end
    double highest = 0;         ///< m, of any particle at the end
};

inline Outcome fall(World& world, double seconds) {
    Outcome result;
    const int frames = static_cast<int>(std::lround(seconds * 60));
    for (int i = 0; i < frames; ++i) {
        world.step(1.0 / 60);
        result.worst = std::max(result.worst, crossings(world));
        if (i + 60 >= frames) result.limited += world.frame().cloth_contacts.limited;
    }
    result.speed = mean_speed(world);
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const Vec4& x : cloth.positions) result.highest = std::max(result.highest, double{x.y});
    return result;
}

inline void add_ground(World& world) {
    world.add(make_collider({.name = "ground", .shape = PlaneDesc{}, .friction = {0.6f, 0.5f}}));
}

/// A square meter that falls by one corner.
inline SheetDesc falling(std::uint32_t side, Vec3 rotation = {80, 20, 45}) {
    SheetDesc sheet{.resolution = {side, side},
                    .rotation_degrees = rotation,
                    .position = {0, 0.75f, 0},
                    .fabric = find_fabric("cotton")->fabric,
                    .layout = {.lines = true, .hierarchy = true},
                    .self_collision = SelfCollision::exact};
    sheet.fabric.contact.thickness = 0.2f / static_cast<float>(side - 1);
    return sheet;
}

inline World falling_world(const SheetDesc& sheet, std::uint32_t substeps = 20, CpuOptions options = {}) {
    World world = make_world({.solver = {.substeps = substeps}}, sheet, options);
    add_ground(world);
    return world;
}

/// Sheets one above the other, half a meter above the ground.
inline void add_stack(World& world, float speed, std::uint32_t sheets) {
    for (std::uint32_t i = 0; i < sheets; ++i) {
        SheetDesc sheet = falling(8, {0, 0, 0});
        sheet.fabric.contact.thickness = 0.004f;
        sheet.position = {0, 0.5f + 0.006f * static_cast<float>(i), 0};
        sheet.velocity = {0, speed, 0};
        world.add(make_sheet(sheet));
    }
    add_ground(world);
}

// --- Cloth that passes through cloth at the start ---

/// Two sheets that pass through each other in their middle, the second one turned by `rotation`.
inline void add_crossed_sheets(World& world, std::uint32_t side, Vec3 rotation, Vec3 offset = {},
                               std::array<std::uint32_t, 2> layers = {0, 0}) {
    SheetDesc one = falling(side, {0, 0, 0}), two = falling(side, rotation);
    one.layer = layers[0], two.layer = layers[1];
    one.position = {0, 0.6f, 0};
    two.position = one.position + Vec3{0.013f, 0.03f, 0.017f} + offset;
    world.add(make_sheet(one));
    world.add(make_sheet(two));
}

/// A sheet whose profile is a loop: it crosses itself along a line from rim to rim.
inline SheetDesc looped(std::uint32_t side) {
    SheetDesc sheet = falling(side, {0, 0, 0});
    sheet.position = {0, 0.6f, 0};
    sheet.shape = [](Vec3 p) {
        const float t = 2.8f * p.x;
        return Vec3{0.25f * t * t - 0.2f, 0.16f * (t * t * t - t), p.z};
    };
    return sheet;
}

/// A sheet, part of which is rolled by more than half a turn about an oblique axis, and passes through the rest.
inline SheetDesc folded_through_itself(std::uint32_t side) {
    SheetDesc sheet = falling(side, {0, 0, 0});
    sheet.position = {0, 0.6f, 0};
    sheet.shape = [](Vec3 p) {
        const float c = std::cos(0.3f), s = std::sin(0.3f), radius = 0.04f, turn = 3.6f;
        const float across = -s * p.x + c * p.z, along = c * p.x + s * p.z;
        const float rolled = std::max(0.0f, along + 0.1f), angle = std::min(rolled / radius, turn);
        const float straight = std::max(0.0f, rolled - radius * turn);
        const float x = std::min(along, -0.1f) + radius * std::sin(angle) + straight * std::cos(angle);
        const float y = radius * (1 - std::cos(angle)) + straight * std::sin(angle);
        return Vec3{c * x - s * across, y, s * x + c * across};
    };
    return sheet;
}

/// Pins press a sheet through the one below within `seconds`. Returns the model of the upper one.
inline std::shared_ptr<const ClothModel> add_pressed_sheets(World& world, float seconds) {
    SheetDesc lower = falling(6, {0, 0, 0}), upper = falling(6, {3, 10, 0});
    lower.pinned = upper.pinned = [](Vec3) { return true; };
    lower.position = {};
    upper.position = {0, 0.1f, 0};
    world.add(make_sheet(lower));
    auto model = make_sheet(upper);
    KinematicTargets targets;
    targets.motions.push_back({.collider = {}, .offsets = {{0, {}}, {seconds, {0, -0.3f, 0}}}});
    for (std::uint32_t p = 0; p < model->particle_count; ++p)
        targets.particles.push_back({.particle = p, .motion = 0, .local = model->start[p].xyz()});
    world.add(model, targets);
    return model;
}

/// A sheet whose middle is pushed through another one faster than contact can answer. The other one is held by two
/// edges.
inline void add_driven_sheets(World& world) {
    SheetDesc lower = falling(20, {0, 0, 0}), upper = falling(24, {2, 10, 0});
    const float edge = lower.size[0] / 2 - 1e-3f, middle = upper.size[0] / 6;
    lower.pinned = [edge](Vec3 x) { return std::abs(x.x) > edge; };
    upper.pinned = [middle](Vec3 x) { return std::abs(x.x) < middle && std::abs(x.z) < middle; };
    lower.position = {};
    upper.position = {0, 0.02f, 0};
    world.add(make_sheet(lower));
    auto model = make_sheet(upper);
    KinematicTargets targets;
    targets.motions.push_back({.collider = {}, .offsets = {{0, {}}, {0.1f, {0, -0.3f, 0}}}});
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        if (model->start[p].w > 0) continue;
        targets.particles.push_back({.particle = p, .motion = 0, .local = model->start[p].xyz()});
    }
    world.add(model, targets);
}

inline World stack(float speed, std::uint32_t sheets, CpuOptions options = {}) {
    World world = make_world({.solver = {.substeps = 20}}, options);
    add_stack(world, speed, sheets);
    return world;
}

inline std::string hash_after(World& world, int frames) {
    for (int i = 0; i < frames; ++i) world.step(1.0 / 60);
    return world.state_hash();
}

}  // namespace weft::physical
