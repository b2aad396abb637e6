#include "validate/weaves.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace weft::cases {

const char* name_of(PullMesh mesh) {
    switch (mesh) {
        case PullMesh::alternating:
            return "alternating";
        case PullMesh::uniform:
            return "uniform";
        case PullMesh::cross:
            return "cross";
        case PullMesh::irregular:
            return "irregular";
    }
    return "";
}

TriangleMesh pulled_mesh(PullMesh kind, std::uint32_t columns, std::uint32_t rows) {
    const std::array<float, 2> size{static_cast<float>(columns) / 8, static_cast<float>(rows) / 8};
    const GridDiagonal diagonal = kind == PullMesh::uniform ? GridDiagonal::uniform
                                  : kind == PullMesh::cross ? GridDiagonal::cross
                                                            : GridDiagonal::alternating;
    TriangleMesh mesh = make_grid(size, {columns + 1, rows + 1}, diagonal);
    if (kind != PullMesh::irregular) return mesh;
    std::mt19937 random(7);
    const auto offset = [&] { return 0.04f * (static_cast<float>(random() % 2001) / 1000 - 1); };
    for (Vec3& p : mesh.positions) {
        const float x = offset(), z = offset();
        if (std::abs(p.x) < size[0] / 2 - 0.01f && std::abs(p.z) < size[1] / 2 - 0.01f) p.x += x, p.z += z;
    }
    return mesh;
}

void turn_warp(TriangleMesh& mesh, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    mesh.uvs.clear();
    for (const Vec3& p : mesh.positions)
        mesh.uvs.push_back({static_cast<float>(c * p.x + s * p.z), static_cast<float>(c * p.z - s * p.x)});
}

double along_bias(double warp, double weft, double shear) {
    const double mean = (warp + weft) / 4, half_difference = (warp - weft) / 4;
    return mean + shear - half_difference * half_difference / mean;
}

}  // namespace weft::cases
