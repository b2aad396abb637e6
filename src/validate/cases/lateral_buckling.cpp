// A strip that is clamped at one end with its width upright bends and twists sideways above a critical weight (lateral
// buckling; one of the tests of Romero et al. 2021).
#include "validate/sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace weft {

using namespace cases;
namespace {

constexpr double buckling_density = 0.2;

// The critical gamma = rho_A g L³/B of a strip of the width w = `ratio` L. Its sections stay straight: they move
// sideways by v and turn by θ. The moment M = rho_A g w (L − x)²/2 gives v'' = −M θ/(B w), so the energy over B w/L is
//     ½ ∫ 2 θ'² + ratio²/12 θ''² − gamma²/4 (1 − s)⁴ θ² ds.
// Without the second term, the warping that the clamp prevents, it is the classical 12.85 √(EI GJ) = rho_A g w L³
// (Timoshenko, Gere 1961, "Theory of Elastic Stability") with EI = B w and GJ = 2 B w. Here θ is a sum of
// 1 − cos((k + ½) π s). Sections of a plate bend a little: its critical gamma is lower by 0.1 % for the ratio 0.1, and
// by 0.5 % for 0.3.
double critical_gamma(double ratio) {
    constexpr int terms = 30, points = 2000;
    const auto wave = [](int k) { return (k + 0.5) * std::numbers::pi; };
    std::vector<double> stiffness(terms), load(terms * terms);
    for (int i = 0; i < terms; ++i) {
        const double a = wave(i) * wave(i);
        stiffness[i] = a + ratio * ratio / 24 * a * a;
    }
    for (int n = 0; n < points; ++n) {
        const double s = (n + 0.5) / points, weight = std::pow(1 - s, 4) / (4 * points);
        for (int i = 0; i < terms; ++i)
            for (int j = 0; j < terms; ++j)
                load[i * terms + j] += weight * (1 - std::cos(wave(i) * s)) * (1 - std::cos(wave(j) * s));
    }
    // Largest eigenvalue of stiffness⁻¹ load by repeated multiplication.
    std::vector<double> shape(terms, 1), next(terms);
    double eigenvalue = 0;
    for (int n = 0; n < 100; ++n) {
        for (int i = 0; i < terms; ++i) {
            next[i] = 0;
            for (int j = 0; j < terms; ++j) next[i] += load[i * terms + j] * shape[j] / stiffness[i];
        }
        eigenvalue = next[0];
        for (int i = 0; i < terms; ++i) shape[i] = next[i] / eigenvalue;
    }
    return 1 / std::sqrt(eigenvalue);
}

struct UprightStrip {
    double ratio;  ///< of its width to its length
    std::uint32_t cells, across;
    BendModel model = BendModel::moment;
    bool irregular = false;
};

// How fast a small sideways motion y of the tip grows: λ in y'' = λ y + c y', 1/s². It is 0 at the critical gamma.
double growth(const Validation& validation, const UprightStrip& strip, double gamma) {
    const double begins = begin_of_bending(strip.model), s = 1 / (strip.cells - begins), length = strip.cells * s;
    // It sags by a few thousandths in its plane.
    Fabric fabric = elastic_fabric(buckling_density * standard_gravity / 1e-4, buckling_density);
    fabric.stretch.shear = 0.5f * fabric.stretch.stretch[0];
    const auto b = static_cast<float>(buckling_density * standard_gravity / gamma);
    fabric.bend = {.bend = {b, b, b}, .model = strip.model};
    const std::uint32_t n = strip.cells + 1;
    const auto width = static_cast<float>(strip.ratio);
    TriangleMesh mesh =
        make_grid({static_cast<float>(length), width}, {n, strip.across + 1}, GridDiagonal::alternating);
    std::mt19937 random(5);
    for (Vec3& p : mesh.positions) {
        const auto offset = [&](double cell) {
            return static_cast<float>(0.25 * cell * (static_cast<double>(random() % 2001) / 1000 - 1));
        };
        const float x = offset(s), z = offset(strip.ratio / strip.across);
        const bool inner =
            double{p.x} > -length / 2 + 1.5 * s && double{p.x} < length / 2 - 0.5 * s && std::abs(p.z) < 0.499f * width;
        if (strip.irregular && inner) p.x += x, p.z += z;
    }
    WorldSettings settings{.solver = {.substeps = 10, .iterations = 60}};
    settings.solver.hierarchy = false;
    World world = validation.make_world(settings);
    add_sheet(world, {.mesh = std::move(mesh),
                      .fabric = fabric,
                      .place =
                          [](Vec3 p) {
                              return Vec3{p.x, p.z, 0};
                          },
                      .pinned = [=](Vec3 p) { return p.x < -length / 2 + 1.01 * s; }});
    constexpr double frame = 0.01;
    settle(world, 1, frame, 1e-3);
    Snapshot snapshot = world.save();
    for (auto* array : {&snapshot.cloths.back().position, &snapshot.cloths.back().start}) {
        for (Vec4& x : *array) {
            const double along = std::max(double{x.x} + length / 2 - begins * s, 0.0);
            if (x.w > 0) x.z = static_cast<float>(2e-3 * along * along);
        }
    }
    if (auto placed = world.restore(snapshot); !placed) throw std::runtime_error(placed.error().message());
    // Twisting is fast and comes to rest with the sideways motion held back.
    for (int i = 0; i < 100; ++i) {
        run(world, frame, frame);
        stop(world);
    }
    const auto tip = [&] {
        double sum = 0;
        for (std::uint32_t row = 0; row <= strip.across; ++row) sum += position(world, row * n + n - 1)[2];
        return sum / (strip.across + 1);
    };
    constexpr int frames = 5;  // per sample: rounding drowns second differences of single frames
    constexpr double dt = frames * frame;
    std::vector<double> y{tip()};
    for (int i = 0; i < 30; ++i) {
        run(world, dt, frame);
        y.push_back(tip());
    }
    double yy = 0, yv = 0, vv = 0, ya = 0, va = 0;
    for (std::size_t i = 1; i + 1 < y.size(); ++i) {
        const double v = (y[i + 1] - y[i - 1]) / (2 * dt), a = (y[i + 1] - 2 * y[i] + y[i - 1]) / (dt * dt);
        yy += y[i] * y[i], yv += y[i] * v, vv += v * v, ya += y[i] * a, va += v * a;
    }
    return (ya * vv - va * yv) / (yy * vv - yv * yv);
}

// The growth times gamma is nearly linear in gamma², so its zero follows from two values around `guess`.
double measured_gamma(const Validation& validation, const UprightStrip& strip, double guess) {
    const double low = 0.9 * guess, high = 1.1 * guess;
    const double below = growth(validation, strip, low) * low, above = growth(validation, strip, high) * high;
    return std::sqrt(low * low - below / (above - below) * (high * high - low * low));
}

}  // namespace

void validate_lateral_buckling(Validation& validation) {
    struct Named {
        const char* model;
        const char* mesh;
        UprightStrip strip;
        double known;
    };
    constexpr Named all[] = {
        {"moment", "alternating", {0.2, 14, 3}, 0.06},
        {"moment", "alternating", {0.2, 20, 4}, 0.04},
        {"moment", "alternating", {0.2, 28, 6}, 0},
        {"moment", "alternating", {0.1, 28, 3}, 0},
        {"moment", "alternating", {0.3, 28, 8}, 0},
        {"moment", "irregular", {0.2, 20, 4, BendModel::moment, true}, 0},
        {"plate", "alternating", {0.2, 20, 4, BendModel::plate}, 0.45},
        {"dihedral", "alternating", {0.2, 20, 4, BendModel::dihedral}, 0.45},
    };
    for (const auto& [model, mesh, strip, known] : all) {
        if (validation.quick() && &strip != &all[0].strip) continue;
        const double expected = critical_gamma(strip.ratio), first = measured_gamma(validation, strip, expected);
        const bool near = std::abs(first / expected - 1) < 0.1;
        char what[120];
        std::snprintf(what, sizeof what, "critical gamma, %s, %s, width over length %g, %u x %u cells", model, mesh,
                      strip.ratio, strip.cells, strip.across);
        validation.add_near(what, near ? first : measured_gamma(validation, strip, first), expected,
                            strip.irregular ? 0.05 : 0.02, "", known,
                            {{"model", model}, {"mesh", mesh}, {"ratio", strip.ratio}, {"cells", strip.cells}});
    }
}

}  // namespace weft
