// Meshes of strips that are clamped at one end. The cases and the tests of tests/physics share them.
#pragma once

#include "mesh/procedural.h"

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace weft {

/// How a strip is cut and meshed. The strip itself always runs along x, except for `weft`.
enum class Cut {
    warp,         ///< a grid, along its x axis
    weft,         ///< a grid, along its z axis
    bias_along,   ///< a uniform grid turned by 45°: its diagonals run along the strip
    bias_across,  ///< the same turned the other way: its diagonals run across the strip
    irregular,    ///< a grid with its vertices moved by up to a quarter of a cell, and diagonals by chance
};

struct StripMesh {
    TriangleMesh mesh;
    double clamp = 0;  ///< m: particles up to here along the strip are held
    double root = 0;   ///< m: where the free length begins; the tip is 1 m from here
    double tip = 0;    ///< m
    bool along_z = false;

    double along(Vec3 p) const { return along_z ? p.z : p.x; }
};

// Tangents belong to the middles of cells. A clamp of two rows of particles therefore fixes position and slope halfway
// between them, and the free length begins there. Measured from the second row, the relative error would be twice the
// cell length over the length.
inline StripMesh make_strip(Cut cut, GridDiagonal diagonal, std::uint32_t cells, std::uint32_t across) {
    const double s = 1 / (cells - 0.5), length = cells * s;
    StripMesh strip{.mesh = {},
                    .clamp = -length / 2 + 1.01 * s,
                    .root = -length / 2 + s / 2,
                    .tip = length / 2,
                    .along_z = cut == Cut::weft};
    const std::array<float, 2> size{static_cast<float>(length), static_cast<float>(across * s)};
    if (cut == Cut::weft) {
        strip.mesh = make_grid({size[1], size[0]}, {across + 1, cells + 1}, diagonal);
        return strip;
    }
    if (cut == Cut::warp) {
        strip.mesh = make_grid(size, {cells + 1, across + 1}, diagonal);
        return strip;
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& x = strip.mesh.positions;
        if (cross(x[b] - x[a], x[c] - x[a]).y < 0) std::swap(b, c);
        strip.mesh.triangles.push_back({a, b, c});
    };
    if (cut == Cut::irregular) {
        strip.mesh = make_grid(size, {cells + 1, across + 1}, diagonal);
        strip.mesh.uvs.clear();
        strip.mesh.triangles.clear();
        std::mt19937 chance(7);
        const auto shift = [&] { return static_cast<float>(0.25 * s * (chance() / 2147483648.0 - 1)); };
        const std::uint32_t n = cells + 1;
        for (std::uint32_t iz = 0; iz <= across; ++iz) {
            for (std::uint32_t ix = 2; ix <= cells; ++ix) {
                Vec3& p = strip.mesh.positions[iz * n + ix];
                const float dx = shift(), dz = shift();
                if (ix < cells) p.x += dx;
                if (iz > 0 && iz < across) p.z += dz;
            }
        }
        for (std::uint32_t iz = 0; iz < across; ++iz) {
            for (std::uint32_t ix = 0; ix < cells; ++ix) {
                const std::uint32_t a = iz * n + ix, b = a + 1, c = a + n, d = c + 1;
                if (chance() % 2) {
                    add(a, c, d), add(a, d, b);
                } else {
                    add(a, c, b), add(b, c, d);
                }
            }
        }
        return strip;
    }
    // Lines of diagonals half a diagonal apart, every second one shifted by a half and filled up at its ends:
    //   o---o---o     q = 2
    //   o-o---o-o     q = 1
    //   o---o---o     q = 0   -> p
    const bool along = cut == Cut::bias_along;
    const std::uint32_t np = along ? cells : across, nq = 2 * (along ? across : cells);
    std::vector<std::vector<std::uint32_t>> lines(nq + 1);
    for (std::uint32_t q = 0; q <= nq; ++q) {
        const auto put = [&](double p) {
            const auto u = static_cast<float>((p - 0.5 * np) * s), v = static_cast<float>((0.5 * q - 0.25 * nq) * s);
            lines[q].push_back(static_cast<std::uint32_t>(strip.mesh.positions.size()));
            strip.mesh.positions.push_back(along ? Vec3{u, 0, v} : Vec3{v, 0, u});
        };
        if (q % 2) put(0);
        for (std::uint32_t p = 0; p < np + (q % 2 ? 0 : 1); ++p) put(p + (q % 2 ? 0.5 : 0.0));
        if (q % 2) put(np);
    }
    for (std::uint32_t q = 0; q < nq; ++q) {
        const auto& even = lines[q + q % 2];
        const auto& odd = lines[q + 1 - q % 2];
        for (std::uint32_t p = 0; p <= np; ++p) add(even[p], odd[p], odd[p + 1]);
        for (std::uint32_t p = 0; p < np; ++p) add(even[p], even[p + 1], odd[p + 1]);
    }
    return strip;
}

}  // namespace weft
