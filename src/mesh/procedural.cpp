#include "mesh/procedural.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace weft {
namespace {

struct Sheet {
    std::array<float, 2> size;
    std::array<std::uint32_t, 2> cells;

    /// `x` and `z` in cells from the corner; halves are allowed.
    void add_vertex(TriangleMesh& mesh, float x, float z) const {
        const float u = x / static_cast<float>(cells[0]), down = z / static_cast<float>(cells[1]);
        mesh.positions.push_back({(u - 0.5f) * size[0], 0, (down - 0.5f) * size[1]});
        mesh.uvs.push_back({u, 1 - down});
        mesh.normals.push_back({0, 1, 0});
    }
};

void reserve(TriangleMesh& mesh, std::size_t vertices, std::size_t triangles) {
    mesh.positions.reserve(vertices);
    mesh.uvs.reserve(vertices);
    mesh.normals.reserve(vertices);
    mesh.triangles.reserve(triangles);
}

/// In doubles, so that every subdivision places its vertices on the sphere with the same accuracy.
struct Direction {
    double x, y, z;
};

Direction between(const Direction& a, const Direction& b) {
    const double x = a.x + b.x, y = a.y + b.y, z = a.z + b.z;
    const double scale = 1 / std::sqrt(x * x + y * y + z * z);
    return {x * scale, y * scale, z * scale};
}

struct UnitSphere {
    std::vector<Direction> corners;
    std::vector<Triangle> triangles;
};

UnitSphere make_icosahedron() {
    UnitSphere sphere;
    // Two rings of five corners between the poles, the lower one turned by 36°. Cosines and sines of multiples of 36°
    // come from square roots, which give the same bits on every machine.
    const double root5 = std::sqrt(5.0), height = 1 / root5, radius = 2 * height;
    const double cos36 = (root5 + 1) / 4, cos72 = (root5 - 1) / 4;
    const double sin36 = std::sqrt(10 - 2 * root5) / 4, sin72 = std::sqrt(10 + 2 * root5) / 4;
    const double upper_ring[5][2] = {{1, 0}, {cos72, sin72}, {-cos36, sin36}, {-cos36, -sin36}, {cos72, -sin72}};
    const double lower_ring[5][2] = {{cos36, sin36}, {-cos72, sin72}, {-1, 0}, {-cos72, -sin72}, {cos36, -sin36}};
    sphere.corners.push_back({0, 1, 0});
    for (const auto& [x, z] : upper_ring) sphere.corners.push_back({radius * x, height, -radius * z});
    for (const auto& [x, z] : lower_ring) sphere.corners.push_back({radius * x, -height, -radius * z});
    sphere.corners.push_back({0, -1, 0});
    for (std::uint32_t i = 0; i < 5; ++i) {
        const std::uint32_t next = (i + 1) % 5;
        const std::uint32_t upper = 1 + i, upper_next = 1 + next, lower = 6 + i, lower_next = 6 + next;
        sphere.triangles.push_back({0, upper, upper_next});
        sphere.triangles.push_back({upper, lower, upper_next});
        sphere.triangles.push_back({upper_next, lower, lower_next});
        sphere.triangles.push_back({11, lower_next, lower});
    }
    return sphere;
}

/// Cuts every triangle into four at the midpoints of its sides and moves the midpoints onto the sphere.
void subdivide(UnitSphere& sphere) {
    std::unordered_map<std::uint64_t, std::uint32_t> middles;  // only looked up, so its order does not matter
    middles.reserve(sphere.triangles.size() * 3 / 2);
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint64_t side = a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
        const auto [entry, added] = middles.try_emplace(side, static_cast<std::uint32_t>(sphere.corners.size()));
        if (added) sphere.corners.push_back(between(sphere.corners[a], sphere.corners[b]));
        return entry->second;
    };
    std::vector<Triangle> cut;
    cut.reserve(sphere.triangles.size() * 4);
    for (const auto& [a, b, c] : sphere.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        cut.insert(cut.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sphere.triangles = std::move(cut);
}

/// Numbers the points of a box's lattice that lie on its surface.
class BoxShell {
  public:
    explicit BoxShell(std::array<std::uint32_t, 3> cells) : cells_(cells) {}

    template <class Visit>
    void for_each(Visit&& visit) const {
        const auto [nx, ny, nz] = cells_;
        for (std::uint32_t y = 0; y <= ny; ++y)
            for (std::uint32_t z = 0; z <= nz; ++z) {
                const bool inside = y > 0 && y < ny && z > 0 && z < nz;
                for (std::uint32_t x = 0; x <= nx; x += inside ? nx : 1) visit(x, y, z);
            }
    }

    /// In the order of for_each.
    std::uint32_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        const auto [nx, ny, nz] = cells_;
        const std::uint32_t row = nx + 1, layer = row * (nz + 1), ring = 2 * (nx + nz);
        if (y == 0) return z * row + x;
        const std::uint32_t first = layer + (y - 1) * ring;
        if (y == ny) return first + z * row + x;
        if (z == 0) return first + x;
        return first + row + (z - 1) * 2 + (z == nz ? x : (x == nx ? 1 : 0));
    }

  private:
    std::array<std::uint32_t, 3> cells_;
};

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

TriangleMesh make_sphere(float radius, std::uint32_t subdivisions) {
    assert(radius > 0 && subdivisions <= 12);
    UnitSphere sphere = make_icosahedron();
    for (std::uint32_t i = 0; i < subdivisions; ++i) subdivide(sphere);

    TriangleMesh mesh;
    mesh.positions.reserve(sphere.corners.size());
    mesh.normals.reserve(sphere.corners.size());
    const auto rounded = [](const Direction& d, double length) {
        return Vec3{static_cast<float>(d.x * length), static_cast<float>(d.y * length),
                    static_cast<float>(d.z * length)};
    };
    for (const Direction& d : sphere.corners) {
        mesh.positions.push_back(rounded(d, static_cast<double>(radius)));
        mesh.normals.push_back(rounded(d, 1));
    }
    mesh.triangles = std::move(sphere.triangles);
    return mesh;
}

TriangleMesh make_box(std::array<float, 3> size, std::array<std::uint32_t, 3> resolution) {
    assert(size[0] > 0 && size[1] > 0 && size[2] > 0);
    assert(resolution[0] >= 2 && resolution[1] >= 2 && resolution[2] >= 2);
    const std::array cells{resolution[0] - 1, resolution[1] - 1, resolution[2] - 1};
    const BoxShell shell(cells);
    TriangleMesh mesh;
    const auto place = [&](std::uint32_t i, std::size_t axis) {
        return (static_cast<float>(i) / static_cast<float>(cells[axis]) - 0.5f) * size[axis];
    };
    shell.for_each([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        mesh.positions.push_back({place(x, 0), place(y, 1), place(z, 2)});
    });

    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool far_side : {false, true}) {
            // The cross product of the two axes points out of the box.
            const std::size_t u = (axis + (far_side ? 1 : 2)) % 3, v = (axis + (far_side ? 2 : 1)) % 3;
            const auto corner = [&](std::uint32_t i, std::uint32_t j) {
                std::array<std::uint32_t, 3> point;
                point[axis] = far_side ? cells[axis] : 0;
                point[u] = i, point[v] = j;
                return shell.number(point[0], point[1], point[2]);
            };
            for (std::uint32_t j = 0; j < cells[v]; ++j)
                for (std::uint32_t i = 0; i < cells[u]; ++i) {
                    const std::uint32_t a = corner(i, j), b = corner(i + 1, j);
                    const std::uint32_t c = corner(i + 1, j + 1), d = corner(i, j + 1);
                    if ((i + j) % 2 == 0)
                        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
                    else
                        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
                }
        }
    return mesh;
}

}  // namespace weft
