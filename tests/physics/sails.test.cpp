// Sails in a steady wind: a kite on its line, and the section of a spinnaker between two masts.

#include "sheet.h"

#include "solver/measures/tension.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace weft::physical {
namespace {

constexpr double sail_air = 1.225;  // kg/m³

// --- Kite ---

// A sheet of 0.4 m on two lines to the ground, which keep it from rolling over, all of one mesh. Each line ends in a
// knot with bridles to two corners. The wind blows along x.
struct Kite {
    TriangleMesh mesh;
    std::vector<std::uint32_t> ground, line;  // pinned particles; from the lines' last two cells
};

Kite make_kite(double line_angle, double incidence, std::array<double, 2> knot) {
    constexpr std::uint32_t n = 9, cells = 10;
    constexpr float size = 0.4f, width = 0.01f, length = 1;
    Kite kite;
    auto& x = kite.mesh.positions;
    auto& t = kite.mesh.triangles;
    const auto direction = [](double angle) {
        return Vec3{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0};
    };
    const Vec3 up = direction(line_angle), chord = direction(std::numbers::pi - incidence);  // to the leading edge
    const Vec3 front = cross(Vec3{0, 0, 1}, chord);  // the side that faces the wind and the ground
    const Vec3 knot_place = up * length;
    const Vec3 center = knot_place - chord * static_cast<float>(knot[0]) - front * static_cast<float>(knot[1]);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k)
            x.push_back(center + chord * (size * (static_cast<float>(i) / (n - 1) - 0.5f)) +
                        Vec3{0, 0, size * (static_cast<float>(k) / (n - 1) - 0.5f)});
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
        for (std::uint32_t k = 0; k + 1 < n; ++k) {
            const std::uint32_t a = i * n + k, b = a + 1, c = a + n, d = c + 1;
            if ((i + k) % 2) {
                t.insert(t.end(), {{a, b, d}, {a, d, c}});
            } else {
                t.insert(t.end(), {{a, b, c}, {b, d, c}});
            }
        }
    }
    for (const std::uint32_t side : {0u, n - 2}) {
        const Vec3 aside{0, 0, side == 0 ? -0.5f * size : 0.5f * size};
        const auto knot_particle = static_cast<std::uint32_t>(x.size());
        x.push_back(knot_place + aside);
        for (const std::uint32_t corner : {side, (n - 1) * n + side}) t.push_back({corner, corner + 1, knot_particle});
        std::uint32_t above[2] = {knot_particle, knot_particle};
        for (std::uint32_t i = 1; i <= cells; ++i) {
            const auto a = static_cast<std::uint32_t>(x.size()), b = a + 1;
            const Vec3 middle = up * (length * (1 - static_cast<float>(i) / cells)) + aside;
            x.push_back(middle - Vec3{0, 0, width / 2});
            x.push_back(middle + Vec3{0, 0, width / 2});
            t.push_back({above[0], a, b});
            if (i > 1) t.push_back({above[0], b, above[1]});
            above[0] = a, above[1] = b;
            if (i + 1 >= cells) kite.line.push_back(a);
        }
        kite.ground.insert(kite.ground.end(), {above[0], above[1]});
    }
    return kite;
}

// N: of the air on all triangles that can move, by the law of air.md, and of weight.
std::array<double, 3> load_on_kite(const ClothFrame& cloth, Vec3 wind) {
    const AirMaterial& air = cloth.model->fabric.air;
    std::array<double, 3> force{};
    for (std::uint32_t i = 0; i < cloth.model->triangle_count; ++i) {
        const Triangle t = cloth.model->triangles()[i];
        Vec3 v = wind * -1.0f;
        for (const std::uint32_t p : t) v = v + cloth.velocities[p].xyz() * (1 / 3.0f);
        Vec3 n = cross(cloth.positions[t[1]].xyz() - cloth.positions[t[0]].xyz(),
                       cloth.positions[t[2]].xyz() - cloth.positions[t[0]].xyz());
        const double area = 0.5 * double{length(n)}, speed = double{length(v)};
        n = normalized(n);
        const Vec3 along = normalized(v);
        if (dot(along, n) < 0) n = n * -1.0f;
        const double pressure = 0.5 * sail_air * speed * speed * area * double{dot(along, n)};
        const Vec3 lift = cross(cross(n, along), along);
        const Vec3 f = along * static_cast<float>(-pressure * double{air.drag}) +
                       lift * static_cast<float>(pressure * double{air.lift});
        force[0] += double{f.x}, force[1] += double{f.y}, force[2] += double{f.z};
    }
    for (const float mass : cloth.model->mass) force[1] -= 9.81 * double{mass};
    return force;
}

TEST(Kite, pulls_its_line_where_air_and_weight_pull_the_kite) {
    for (const float speed : {4.0f, 6.0f, 9.0f}) {
        Kite kite = make_kite(0.6, 0.6, {0.09, 0.25});
        const std::vector<std::uint32_t> line = kite.line;
        ClothModelDesc desc{.name = "kite",
                            .fabric = find_fabric("ripstop")->fabric,
                            .pins = {.particles = kite.ground},
                            .layout = {.lines = true}};
        desc.fabric.body.density = 0.1f;
        desc.fabric.air.lift = 1.2f;
        desc.fabric.bend.bend[0] = desc.fabric.bend.bend[1] = desc.fabric.bend.bend[2] =
            10;  // as stiff as with battens
        auto topology = build_topology(kite.mesh, {.reorder = false});
        desc.mesh = std::move(kite.mesh);
        auto model = build_cloth_model(std::move(desc), std::move(*topology));
        ASSERT_TRUE(model.ok());
        const Vec3 wind{speed, 0, 0};
        World world =
            make_world({.solver = {.substeps = 40, .hierarchy = false}, .air = AirDesc{.wind = {{.velocity = wind}}}});
        world.add(*model);
        run(world, 6);
        double angle[2] = {}, swing[2] = {10, -10}, force = 0;
        std::array<double, 3> sum{};
        Vec3 along{};
        constexpr int frames = 120;
        for (int i = 0; i < frames; ++i) {
            world.step(1.0 / 60);
            const ClothFrame& cloth = world.frame().cloths[0];
            const std::array<double, 3> load = load_on_kite(cloth, wind);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += load[c] / frames;
            const Vec3 up = cloth.positions[line[0]].xyz() - cloth.positions[line[1]].xyz();
            along = along + up * (1.0f / frames);
            const double now = std::atan2(double{up.y}, double{up.x});
            swing[0] = std::min(swing[0], now), swing[1] = std::max(swing[1], now);
        }
        const double degrees = 180 / std::numbers::pi;
        angle[0] = std::atan2(double{along.y}, double{along.x}) * degrees;
        angle[1] = std::atan2(sum[1], sum[0]) * degrees;
        force = std::hypot(sum[0], sum[1], sum[2]);
        std::printf("  kite at %.0f m/s: line at %.2f° (%.2f … %.2f), balance %.2f°, pull %.2f N, aside %.4f N\n",
                    double{speed}, angle[0], swing[0] * degrees, swing[1] * degrees, angle[1], force, sum[2]);
        EXPECT_NEAR(angle[0], angle[1], 1.1);
        EXPECT_GT(angle[0], 5) << "it flies";
    }
}

// --- Spinnaker ---

struct SailDesc {
    double slack = 1;  // length over the distance between the masts
    std::uint32_t substeps = 80;
    bool hierarchy = false;
};

struct Sail {
    double depth = 0, parabola = 0;    // m
    double tension = 0, expected = 0;  // N/m, in the middle
    double off = 0;                    // m: the farthest from the parabola
};

// Without lift the air pushes each part along the wind, by the area that the part shows to it. So a sail between two
// masts is a parabola, and the tension in its middle is H = q d²/(8 f), with the pressure q, the distance d and the
// depth f.
Sail blow(const SailDesc& desc) {
    SheetDesc sheet{.size = {1, 0.25f},
                    .resolution = {65, 17},
                    .rotation_degrees = {90, 0, 0},
                    .fabric = find_fabric("ripstop")->fabric,
                    .layout = {.lines = true, .hierarchy = desc.hierarchy},
                    .pinned = [](Vec3 p) { return std::abs(p.x) > 0.499f; }};
    sheet.fabric.air.lift = 0;
    const double d = 1 / desc.slack, q = 0.5 * sail_air * 1.28 * 36, k = double{sheet.fabric.stretch.stretch[0]};
    // m: the length at rest of a parabola of this depth, whose tension is H √(1 + slope²).
    const auto length_at_rest = [&](double f) {
        const double u = 4 * f / d;
        return 0.5 * d * (std::sqrt(1 + u * u) + std::asinh(u) / u) - q * d * d / (8 * f) / k * d * (1 + u * u / 3);
    };
    double low = 1e-3, high = 1;
    for (int i = 0; i < 60; ++i) (length_at_rest(0.5 * (low + high)) < 1 ? low : high) = 0.5 * (low + high);
    Sail sail{.parabola = low, .expected = q * d * d / (8 * low)};

    const auto flat = make_sheet(sheet);
    KinematicTargets targets;
    for (const float way : {-1.0f, 1.0f})
        targets.motions.push_back({.offsets = {{0, {}}, {1, {way * (static_cast<float>(d) - 1) / 2, 0, 0}}}});
    for (std::uint32_t p = 0; p < flat->particle_count; ++p) {
        const Vec3 x = flat->rest_position(p);
        if (std::abs(x.x) > 0.499f) targets.particles.push_back({p, x.x > 0 ? 1u : 0u, x});
    }
    World world =
        make_world({.gravity = {},
                    .solver = {.substeps = desc.substeps, .projection = Projection::lines, .hierarchy = desc.hierarchy},
                    .air = AirDesc{.wind = {{.velocity = {0, 0, 6}}}}});
    world.add(flat, targets);
    run(world, 2.5);
    const ClothFrame& cloth = world.frame().cloths[0];
    const ClothTension tension = measure_tension(make_stress_table(*cloth.model, cloth.triangles), cloth.positions);
    double count = 0;
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
        const Vec3 x = cloth.positions[p].xyz();
        const double along = 2 * double{x.x} / d;
        sail.depth = std::max(sail.depth, double{x.z});
        sail.off = std::max(sail.off, std::abs(double{x.z} - sail.parabola * (1 - along * along)));
        if (std::abs(cloth.model->rest_position(p).x) < 0.05f) sail.tension += tension.tension[p], ++count;
    }
    sail.tension /= count;
    std::printf(
        "  sail of %.2f times the distance, %2u substeps%s: depth %.4f m (parabola %.4f), off by at most %.1f mm, "
        "tension "
        "%.2f N/m, expected %.2f (%+.1f %%), speed %.3f m/s\n",
        desc.slack, desc.substeps, desc.hierarchy ? " and coarse levels" : "", sail.depth, sail.parabola,
        1000 * sail.off, sail.tension, sail.expected, 100 * (sail.tension / sail.expected - 1),
        max_speed(world.frame()));
    return sail;
}

// Labels: slow no-asan
TEST(Spinnaker, is_a_parabola_whose_tension_carries_the_pressure) {
    for (const double slack : {1.05, 1.2, 1.5}) {
        const Sail sail = blow({.slack = slack});
        EXPECT_NEAR(sail.depth, sail.parabola, 0.01 * sail.parabola);
        EXPECT_LT(sail.off, 1e-3);
        EXPECT_NEAR(sail.tension, sail.expected, 0.03 * sail.expected);
    }
}

// Known error: stretch of a stiff and light cloth under load has not converged with few substeps.
TEST(Spinnaker, is_too_deep_with_few_substeps) {
    for (const std::uint32_t substeps : {20u, 40u}) {
        const Sail sail = blow({.slack = 1.05, .substeps = substeps, .hierarchy = true});
        EXPECT_GT(sail.depth, sail.parabola);
        EXPECT_LT(sail.depth, 1.25 * sail.parabola);
    }
}

}  // namespace
}  // namespace weft::physical
