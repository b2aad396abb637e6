// Cusick's drape test (BS 5058): a round specimen of 30 cm lies on a disc of 18 cm, and hangs over its rim.
#include "validate/sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace weft {

using namespace cases;
namespace {

constexpr double specimen = 0.15, disc = 0.09;  // m, radii

// Rings of six times as many vertices as the ring has steps from the center.
TriangleMesh round_mesh(std::uint32_t rings) {
    TriangleMesh mesh;
    mesh.positions.push_back({});
    const auto first = [](std::uint32_t ring) { return ring == 0 ? 0u : 1 + 3 * ring * (ring - 1); };
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        for (std::uint32_t i = 0; i < 6 * ring; ++i) {
            const double r = specimen * ring / rings, angle = 2 * std::numbers::pi * i / (6.0 * ring);
            mesh.positions.push_back(
                {static_cast<float>(r * std::cos(angle)), 0, static_cast<float>(r * std::sin(angle))});
        }
    }
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        for (std::uint32_t sector = 0; sector < 6; ++sector) {
            for (std::uint32_t k = 0; k < ring; ++k) {
                const auto outer = [&](std::uint32_t i) { return first(ring) + (sector * ring + i) % (6 * ring); };
                const auto inner = [&](std::uint32_t i) {
                    return ring == 1 ? 0u : first(ring - 1) + (sector * (ring - 1) + i) % (6 * (ring - 1));
                };
                mesh.triangles.push_back({outer(k), inner(k), outer(k + 1)});
                if (k + 1 < ring) mesh.triangles.push_back({inner(k), inner(k + 1), outer(k + 1)});
            }
        }
    }
    return mesh;
}

struct Draped {
    double coefficient = 0;  ///< %
    int folds = 0;
    std::vector<std::array<double, 2>> rim = {};  ///< m, from above
    double ms_per_frame = 0;
};

Draped drape(const Validation& validation, const Fabric& fabric, std::uint32_t rings, std::uint32_t substeps) {
    World world = validation.make_world({.solver = {.substeps = substeps}, .air = AirDesc{}});
    Fabric damped = fabric;
    damped.body.damping = 2;
    // Ripples of a micrometer, so that folds can begin.
    add_sheet(world, {.mesh = round_mesh(rings),
                      .fabric = damped,
                      .place =
                          [](Vec3 p) {
                              const float angle = std::atan2(p.z, p.x);
                              return Vec3{p.x, 1e-5f * (std::sin(5 * angle) + std::sin(7 * angle + 1)), p.z};
                          },
                      .pinned = [](Vec3 p) { return dot(p, p) < static_cast<float>(disc * disc) * 1.0001f; }});
    const double ms = timed_run(world, 4);
    // The shadow from above, from the triangles, on a raster of half a millimeter.
    constexpr int pixels = 640;
    constexpr double pixel = 5e-4;
    std::vector<std::uint8_t> shadow(pixels * pixels);
    const ClothFrame& cloth = world.frame().cloths.front();
    const auto mesh = round_mesh(rings);
    for (const auto& [a, b, c] : mesh.triangles) {
        double x[3], y[3];
        const std::uint32_t corners[3] = {a, b, c};
        for (int k = 0; k < 3; ++k) {
            x[k] = double{cloth.positions[corners[k]].x} / pixel + pixels / 2;
            y[k] = double{cloth.positions[corners[k]].z} / pixel + pixels / 2;
        }
        const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        if (area == 0) continue;
        const auto low = [](const double(&v)[3]) {
            return std::max(0, static_cast<int>(std::min({v[0], v[1], v[2]})));
        };
        const auto high = [](const double(&v)[3]) {
            return std::min(pixels - 1, static_cast<int>(std::max({v[0], v[1], v[2]})) + 1);
        };
        for (int j = low(y); j <= high(y); ++j) {
            for (int i = low(x); i <= high(x); ++i) {
                const double px = i + 0.5, py = j + 0.5;
                const auto side = [&](int k, int l) {
                    return ((x[l] - x[k]) * (py - y[k]) - (px - x[k]) * (y[l] - y[k])) / area;
                };
                if (side(0, 1) >= 0 && side(1, 2) >= 0 && side(2, 0) >= 0)
                    shadow[static_cast<std::size_t>(j * pixels + i)] = 1;
            }
        }
    }
    const double covered = static_cast<double>(std::ranges::count(shadow, 1)) * pixel * pixel;
    const double inner = std::numbers::pi * disc * disc, outer = std::numbers::pi * specimen * specimen;
    Draped draped{.coefficient = 100 * (covered - inner) / (outer - inner), .ms_per_frame = ms};
    // Folds: how often the rim changes from nearer to farther than its mean distance from the axis.
    const std::uint32_t count = 6 * rings, first = 1 + 3 * rings * (rings - 1);
    std::vector<double> distance(count);
    double mean = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec4 p = cloth.positions[first + i];
        distance[i] = std::hypot(double{p.x}, double{p.z});
        mean += distance[i] / count;
        draped.rim.push_back({double{p.x}, double{p.z}});
    }
    for (std::uint32_t i = 0; i < count; ++i)
        if (distance[i] < mean && distance[(i + 1) % count] >= mean) ++draped.folds;
    return draped;
}

}  // namespace

// Ranges of the drape coefficient of woven cloths of these kinds, from tables of textile testing. The fabrics have the
// stiffness that was measured on other cloths of the kind.
void validate_drape(Validation& validation) {
    struct Range {
        const char* fabric;
        double low, high;  // %
        double known[2];   // %, in few and in many substeps
    };
    constexpr Range ranges[] = {{"silk", 20, 40, {21, 33}},
                                {"wool", 40, 70, {0, 0}},
                                {"cotton", 60, 76, {17, 0}},
                                {"denim", 70, 90, {33, 24}},
                                {"leather", 47, 70, {0, 34}}};
    // Few substeps leave part of the stiffness (src/physics/sweep.md), many nearly all.
    constexpr std::uint32_t few = 20, many = 160;
    for (const Range& range : ranges) {
        if (validation.quick() && std::string_view(range.fabric) != "cotton") continue;
        for (const std::uint32_t substeps : {few, many}) {
            if (validation.quick() && substeps == many) continue;
            const Draped draped =
                drape(validation, find_fabric(range.fabric)->fabric, validation.quick() ? 20 : 40, substeps);
            validation.add({.what = std::string(range.fabric) + ", coefficient with " + std::to_string(draped.folds) +
                                    " folds, " + std::to_string(substeps) + " substeps",
                            .unit = "%",
                            .measured = draped.coefficient,
                            .expected = 0.5 * (range.low + range.high),
                            .tolerance = 0.5 * (range.high - range.low),
                            .known = range.known[substeps == many ? 1 : 0],
                            .settings = {{"fabric", range.fabric}, {"substeps", substeps}},
                            .ms_per_frame = draped.ms_per_frame,
                            .outline = draped.rim});
        }
    }
}

}  // namespace weft
