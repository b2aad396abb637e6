#include "mesh/procedural.h"

#include <cassert>
#include <cstddef>

namespace weft {
namespace {

struct Sheet {
    std::array<float, 2> size;
    std::array<std::uint32_t, 2> cells;

    /// `x` and `z` in cells from the corner; halves are allowed.
    void add_vertex(TriangleMesh& mesh, float x, float z) const {
        const Vec2 uv{x / static_cast<float>(cells[0]), z / static_cast<float>(cells[1])};
        mesh.positions.push_back({(uv.x - 0.5f) * size[0], 0, (uv.y - 0.5f) * size[1]});
        mesh.uvs.push_back(uv);
        mesh.normals.push_back({0, 1, 0});
    }
};

void reserve(TriangleMesh& mesh, std::size_t vertices, std::size_t triangles) {
    mesh.positions.reserve(vertices);
    mesh.uvs.reserve(vertices);
    mesh.normals.reserve(vertices);
    mesh.triangles.reserve(triangles);
}

}  // namespace

TriangleMesh make_grid(std::array<float, 2> size, std::array<std::uint32_t, 2> resolution, GridDiagonal diagonal) {
    assert(size[0] > 0 && size[1] > 0);
    assert(resolution[0] >= 2 && resolution[1] >= 2);
    const auto [nx, nz] = resolution;
    const Sheet sheet{size, {nx - 1, nz - 1}};
    const bool cross = diagonal == GridDiagonal::cross;
    const std::size_t vertex_count = std::size_t{nx} * nz;
    const std::size_t cell_count = std::size_t{nx - 1} * (nz - 1);
    assert(vertex_count + (cross ? cell_count : 0) < none);

    TriangleMesh mesh;
    reserve(mesh, vertex_count + (cross ? cell_count : 0), cell_count * (cross ? 4 : 2));
    for (std::uint32_t iz = 0; iz < nz; ++iz)
        for (std::uint32_t ix = 0; ix < nx; ++ix)
            sheet.add_vertex(mesh, static_cast<float>(ix), static_cast<float>(iz));

    //   a---b  -> x      seen from +y, z down the page
    //   | m |
    //   c---d
    for (std::uint32_t cz = 0; cz + 1 < nz; ++cz)
        for (std::uint32_t cx = 0; cx + 1 < nx; ++cx) {
            const std::uint32_t a = cz * nx + cx, b = a + 1, c = a + nx, d = c + 1;
            const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
                mesh.triangles.push_back({i, j, k});
            };
            if (cross) {
                const auto m = static_cast<std::uint32_t>(mesh.positions.size());
                sheet.add_vertex(mesh, static_cast<float>(cx) + 0.5f, static_cast<float>(cz) + 0.5f);
                add(a, c, m), add(c, d, m), add(d, b, m), add(b, a, m);
            } else if (diagonal == GridDiagonal::uniform || (cx + cz) % 2 == 0) {
                add(a, c, d), add(a, d, b);
            } else {
                add(a, c, b), add(b, c, d);
            }
        }
    return mesh;
}

}  // namespace weft
