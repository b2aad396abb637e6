// Strips that bend and hang. How far clamped strips sag is a case of `weft validate`.

#include "specimen.h"
#include "validate/strip_mesh.h"

#include <cstdio>
#include <numbers>

namespace weft::physical {
namespace {

Fabric strip_fabric(double bend, BendModel model) {
    constexpr double density = 0.2;
    const auto b = static_cast<float>(bend);
    // A thousandth of strain under its own weight: what that adds to the drop is a thousandth too, and a stiffer strip
    // would be no better solved.
    const auto k = static_cast<float>(density * Specimen::gravity / 1e-3);
    Fabric fabric;
    fabric.body = {.density = static_cast<float>(density), .damping = 0};
    fabric.stretch = {.stretch = {k, k}, .compression = {k, k}, .shear = 0.5f * k};
    fabric.bend = {.bend = {b, b, b}, .model = model};
    return fabric;
}

struct Resolution {
    std::uint32_t cells;
    double h;  ///< s: short enough that h² B/(ρ_A s⁴), the stiffness of a bend row against its mass, is solved
    std::uint32_t iterations;
};

/// Drop over reach of the tip.
double cantilever(const StripMesh& strip, BendModel bend, double gamma, const Resolution& resolution) {
    constexpr double density = 0.2;
    // Triangles that are pinned by all corners are rigid to moments, so the free length begins at the last pinned row.
    double root = strip.root;
    if (bend == BendModel::moment)
        for (const Vec3 p : strip.mesh.positions)
            if (strip.along(p) < strip.clamp) root = std::max(root, strip.along(p));
    const double length = strip.tip - root;
    const Fabric fabric = strip_fabric(density * Specimen::gravity * length * length * length / gamma, bend);
    const auto model = make_specimen(strip.mesh, fabric, [&](Vec3 p) { return strip.along(p) < strip.clamp; });
    Specimen cloth(model, {.dt = 10 * resolution.h, .substeps = 10, .iterations = resolution.iterations});
    // Twice the lowest frequency is critical damping.
    const double frequency = 3.516 * std::sqrt(Specimen::gravity / std::min(gamma, 10.0));
    cloth.settle(2 * frequency, 3e-4, 3);
    double drop = 0, reach = 0, count = 0;
    for (std::uint32_t p = 0; p < cloth.size(); ++p) {
        if (strip.along(model->rest_position(p)) < strip.tip - 1e-3) continue;
        drop -= cloth.position(p).y;
        reach += strip.along(cloth.position(p)) - root;
        count += 1;
    }
    EXPECT_EQ(cloth.reports(), report_none);
    EXPECT_GE(count, 2);
    return drop / reach;
}

const char* name_of(GridDiagonal diagonal) {
    return diagonal == GridDiagonal::uniform ? "uniform" : diagonal == GridDiagonal::cross ? "cross" : "alternating";
}

const char* name_of(BendModel model) {
    return model == BendModel::plate ? "plate" : model == BendModel::moment ? "moment" : "hinges";
}

// Drop over reach with gamma 1, over that of the elastica (`weft validate --case cantilever`), minus 1.
double cantilever_error(GridDiagonal diagonal, BendModel bend, const Resolution& resolution) {
    return cantilever(make_strip(Cut::warp, diagonal, resolution.cells, 2), bend, 1, resolution) / 0.12456 - 1;
}

// One sweep leaves bending softer by half the weight of its constraints unless the projection leaves that half out
// (src/physics/sweep.md). Without, the errors are +22 % (moment) and more.
TEST(CantileverInOneSweep, sags_as_far_as_with_many) {
    for (const BendModel model : {BendModel::moment, BendModel::dihedral, BendModel::plate}) {
        constexpr double h = 1.0 / 2000;
        const double one = cantilever_error(GridDiagonal::alternating, model, {10, h, 1}),
                     many = cantilever_error(GridDiagonal::alternating, model, {10, h, 8});
        EXPECT_NEAR(one, many, 0.03) << name_of(model);
    }
}

// Substeps in which the weight of the moments on this grid is near their compliance.
TEST(CantileverInOneSweep, comes_to_rest_on_a_cross_grid) {
    for (const double h : {1.0 / 4000, 1.0 / 8000, 1.0 / 16000}) {
        EXPECT_NEAR(cantilever_error(GridDiagonal::cross, BendModel::moment, {10, h, 1}), 0, 0.1) << h;
    }
}

// Moments follow the angles by a few substeps, which damps as a viscosity would (moment.md). Implicit Euler alone has
// the loss factor 2π f h.
TEST(VibratingStrip, of_moments_loses_little_more_than_the_step) {
    constexpr double density = 0.2, stiffness = density * Specimen::gravity, pi = std::numbers::pi;
    const StripMesh strip = make_strip(Cut::warp, GridDiagonal::alternating, 14, 2);
    for (const BendModel model : {BendModel::dihedral, BendModel::moment}) {
        Specimen cloth(make_specimen(strip.mesh, strip_fabric(stiffness, model),
                                     [&](Vec3 p) { return strip.along(p) < strip.clamp; }),
                       {.dt = 1.0 / 240, .substeps = 5, .iterations = 10});
        // The lowest mode of a clamped beam.
        cloth.place([&](Vec3 p) {
            const double x = 1.8751 * std::max(0.0, strip.along(p) - strip.root);
            const double height = std::cosh(x) - std::cos(x) - 0.73410 * (std::sinh(x) - std::sin(x));
            return Vec3{p.x, static_cast<float>(0.01 * height), p.z};
        });
        std::uint32_t tip = 0;
        for (std::uint32_t p = 0; p < cloth.size(); ++p)
            if (strip.along(cloth.model().rest_position(p)) > strip.tip - 1e-3) tip = p;
        std::vector<double> peaks, times;
        std::array<double, 3> last{};
        for (int frame = 0; frame < 720; ++frame) {
            cloth.step_without_gravity();
            last = {last[1], last[2], std::abs(double{cloth.position(tip).y})};
            if (frame > 10 && last[1] > last[0] && last[1] >= last[2] && last[1] > 1e-3)
                peaks.push_back(last[1]), times.push_back(frame / 240.0);
        }
        ASSERT_GE(peaks.size(), 6u);
        for (std::size_t i = 2; i < peaks.size(); ++i) EXPECT_LT(peaks[i], peaks[i - 2]);
        peaks.resize(peaks.size() / 2 * 2 - 1), times.resize(peaks.size());  // from one side to the same one
        const double halves = static_cast<double>(peaks.size()) - 1,
                     frequency = 0.5 * halves / (times.back() - times.front()),
                     loss = std::log(peaks.front() / peaks.back()) / (halves * pi / 2);
        const double step = 2 * pi * frequency / 1200;
        std::printf("  vibrating strip  %-6s  %.3f Hz, loss factor %.4f, of the step alone %.4f\n", name_of(model),
                    frequency, loss, step);
        EXPECT_NEAR(loss / step, model == BendModel::moment ? 1.5 : 1, 0.3);
        EXPECT_NEAR(frequency, 3.516 / (2 * pi) * std::sqrt(Specimen::gravity), 0.2);
        EXPECT_EQ(cloth.reports(), report_none);
    }
}

// A fine irregular mesh that shakes comes to rest, whatever its triangles and its stiffness.
TEST(VibratingStrip, of_moments_gains_nothing) {
    for (const double gamma : {0.1, 10.0, 1e4}) {
        const StripMesh strip = make_strip(Cut::irregular, GridDiagonal::alternating, 20, 4);
        Specimen cloth(make_specimen(strip.mesh, strip_fabric(0.2 * Specimen::gravity / gamma, BendModel::moment),
                                     [&](Vec3 p) { return strip.along(p) < strip.clamp; }),
                       {.dt = 1.0 / 60, .substeps = 20, .iterations = 1});
        std::mt19937 chance(3);
        cloth.place([&](Vec3 p) {
            const double height = 2e-3 * (chance() / 2147483648.0 - 1);
            return Vec3{p.x, strip.along(p) < strip.clamp ? 0 : static_cast<float>(height), p.z};
        });
        const auto speed = [&] {
            double sum = 0;
            for (std::uint32_t p = 0; p < cloth.size(); ++p) sum += double{dot(cloth.velocity(p), cloth.velocity(p))};
            return std::sqrt(sum / cloth.size());
        };
        double first = 0, before = 1e3;
        for (int second = 0; second < 4; ++second) {
            double fastest = 0;
            for (int frame = 0; frame < 60; ++frame) {
                cloth.step_without_gravity();
                fastest = std::max(fastest, speed());
            }
            EXPECT_LT(fastest, before) << gamma << ", second " << second;
            before = fastest;
            if (second == 0) first = fastest;
        }
        std::printf("  shaken strip  gamma %g  speed %.4f m/s in the first second, %.5f in the fourth\n", gamma, first,
                    before);
        EXPECT_LT(before, 0.2 * first);
    }
}

/// Bending energy of a sheet laid onto a cylinder, over B/(2R²) per area, away from the borders. `turn` in degrees is
/// the angle between the x axis and the direction that curves.
double rolled_energy(GridDiagonal diagonal, BendModel bend_model, double turn) {
    constexpr std::uint32_t n = 41;
    constexpr double radius = 0.5, stiffness = 1e-5;
    const Fabric fabric = strip_fabric(stiffness, bend_model);
    const auto model = make_specimen(make_grid({1, 1}, {n, n}, diagonal), fabric, [](Vec3) { return false; });
    const double c = std::cos(turn * std::numbers::pi / 180), s = std::sin(turn * std::numbers::pi / 180);
    const auto rest = [&](std::uint32_t particle) { return model->rest_position(particle); };
    const auto rolled = [&](std::uint32_t particle) {
        const Vec3 p = rest(particle);
        const double u = c * p.x + s * p.z, v = -s * p.x + c * p.z;
        const double x = radius * std::sin(u / radius), y = radius * std::cos(u / radius);
        return reference::vec3(c * x - s * v, y, s * x + c * v);
    };
    // Hinges on the border of this square count half; the other half belongs to the next square.
    const auto share = [](float x) { return std::abs(x) < 0.2499f ? 1.0 : std::abs(x) < 0.2501f ? 0.5 : 0.0; };
    double energy = 0;
    const ConstraintTable& bend = model->table(ConstraintKind::bend);
    for (std::uint32_t r = 0; r < bend.stride; ++r) {
        if (!bend.is_real(r)) continue;
        const auto at = [&](std::uint32_t slot) { return bend.particles[slot * bend.stride + r]; };
        const Vec3 middle = (rest(at(0)) + rest(at(1))) * 0.5f;
        const double theta = reference::hinge_angle(rolled(at(0)), rolled(at(1)), rolled(at(2)), rolled(at(3))).theta;
        energy += share(middle.x) * share(middle.z) * 0.5 * theta * theta / bend.fields[bend.stride + r];
    }
    const ConstraintTable& plate = model->table(ConstraintKind::plate);
    for (std::uint32_t r = 0; r < plate.stride; ++r) {
        if (!plate.is_real(r)) continue;
        const auto corner = [&](std::uint32_t k) { return rest(plate.particles[(3 + k) * plate.stride + r]); };
        const Vec3 middle = (corner(0) + corner(1) + corner(2)) * (1.0f / 3);
        energy += share(middle.x) * share(middle.z) * plate_energy(plate, r, rolled);
    }
    return energy / (0.25 * stiffness / (2 * radius * radius));
}

TEST(RolledSheet, stores_what_its_bending_stiffness_says) {
    for (const BendModel model : {BendModel::dihedral, BendModel::plate}) {
        for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating}) {
            EXPECT_NEAR(rolled_energy(diagonal, model, 0), 1, 2e-3) << "along the warp, " << name_of(diagonal);
            EXPECT_NEAR(rolled_energy(diagonal, model, 90), 1, 2e-3) << "along the weft, " << name_of(diagonal);
        }
        for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross}) {
            for (const double turn : {0.0, 45.0, 90.0, 135.0}) {
                std::printf("  rolled sheet  %-6s  %-12s curved at %3.0f degrees to the warp: %.3f of B/(2R^2)\n",
                            name_of(model), name_of(diagonal), turn, rolled_energy(diagonal, model, turn));
            }
        }
    }
}

/// Sag over span of a limp strip, L/d = `ratio`, hung by its ends at equal height.
double sag_over_span(double ratio) {
    constexpr std::uint32_t cells = 32, across = 2;
    constexpr double span = 1;
    const double length = ratio * span;
    Fabric fabric;
    fabric.body = {.density = 0.2f, .damping = 0};
    fabric.stretch.inextensible = true;
    fabric.bend = {.bend = {0, 0, 0}};
    const auto end = static_cast<float>(0.4999 * length);
    const auto model =
        make_specimen(make_grid({static_cast<float>(length), static_cast<float>(across * length / cells)},
                                {cells + 1, across + 1}, GridDiagonal::alternating),
                      fabric, [&](Vec3 p) { return std::abs(p.x) > end; });
    // Starts as an arc of a circle: sin a/a = d/L.
    double a = 1;
    for (int i = 0; i < 60; ++i) a -= (std::sin(a) - a / ratio) / (std::cos(a) - 1 / ratio);
    const double radius = length / (2 * a);
    Specimen cloth(model, {.dt = 0.01, .substeps = 20, .iterations = 20});
    cloth.place([&](Vec3 p) {
        const double at = p.x / radius;
        return Vec3{static_cast<float>(radius * std::sin(at)),
                    static_cast<float>(radius * (std::cos(a) - std::cos(at))), p.z};
    });
    cloth.settle(8, 0, 4);
    // Rounding keeps a limp strip in slight motion, so the depth is a mean over a second.
    double depth = 0, count = 0;
    for (int i = 0; i < 100; ++i) {
        cloth.settle(8, 0, 0.01);
        for (std::uint32_t p = 0; p < cloth.size(); ++p) {
            if (std::abs(model->rest_position(p).x) < 1e-4f) depth -= cloth.position(p).y, count += 1;
        }
    }
    EXPECT_EQ(cloth.reports(), report_none);
    return depth / count / span;
}

// Labels: slow no-asan
TEST(Catenary, hangs_as_deep_as_its_length_says) {
    // y = c cosh(x/c) with L = 2c sinh(d/2c), solved for sag = c (cosh(d/2c) - 1).
    constexpr double table[][2] = {{1.05, .13930}, {1.1, .20030}, {1.2, .29234}, {1.5, .50263}, {2, .79639}};
    for (const auto& [ratio, expected] : table) {
        const double sag = sag_over_span(ratio);
        std::printf("  catenary  L/d %.2f  sag/d %.5f, %+.2f %%\n", ratio, sag, 100 * (sag / expected - 1));
        EXPECT_NEAR(sag / expected, 1, 0.005) << "L/d = " << ratio;
    }
}

}  // namespace
}  // namespace weft::physical
