// A small animation in which cloth parts and loses a triangle.
#pragma once

#include "io/exports/film_fixtures.test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace weft::test {

/// Two cloths. The first one is whole in frames 0 and 1, is cut along a column of vertices in frame 2, loses a triangle
/// in frame 3, and one of the copied vertices is copied again in frame 4. Copies move away from their originals.
class TornFilm {
  public:
    static constexpr std::uint32_t side = 4;
    static constexpr std::uint32_t removed = 8;  ///< triangle; others use all its corners

    explicit TornFilm(bool removes = true) : removes_(removes) {
        std::vector<Cloth> cloths = {make_cloth("torn", side, 0, true), make_cloth("whole", 3, 1)};
        add_frame(cloths, 1);
        add_frame(cloths, 1);
        cut(cloths[0].mesh);
        add_frame(cloths, 2);
        if (removes_) {
            Triangle& triangle = cloths[0].mesh.triangles[removed];
            triangle = {triangle[0], triangle[0], triangle[0]};
        }
        add_frame(cloths, 3);
        copy_again(cloths[0].mesh);
        add_frame(cloths, 4);
        add_frame(cloths, 4);
    }

    std::size_t size() const { return frames_.size(); }
    const std::vector<Cloth>& cloths(std::size_t frame) const { return frames_[frame].first; }
    const TriangleMesh& torn(std::size_t frame) const { return frames_[frame].first[0].mesh; }
    /// Vertices of the torn cloth at the end; each corner but one of the removed triangle has one of its own.
    std::size_t vertices() const { return side * side + side + 1 + (removes_ ? 2 : 0); }

    std::unique_ptr<Instant> at(std::size_t frame) const {
        auto instant = std::make_unique<Instant>(frames_[frame].first, frame, static_cast<double>(frame) / 60);
        for (std::size_t v = side * side; v < instant->positions(0).size(); ++v) {
            instant->positions(0)[v] += Vec3{0, 0, 0.02f * static_cast<float>(frame + v)};
            instant->normals(0)[v] = normalized({static_cast<float>(v), 1, 2});
        }
        instant->surfaces[0].topology_version = frames_[frame].second;
        return instant;
    }

    Result<void> write(const std::filesystem::path& path) const {
        Result<std::unique_ptr<Exporter>> made = make_exporter(path);
        if (!made) return made.errors();
        if (Result<void> begun = (*made)->begin({"torn", 60, size()}); !begun) return begun;
        for (std::size_t f = 0; f < size(); ++f)
            if (Result<void> written = (*made)->write(at(f)->frame()); !written) return written;
        return (*made)->finish();
    }

  private:
    void add_frame(const std::vector<Cloth>& cloths, std::uint64_t version) { frames_.emplace_back(cloths, version); }

    static std::uint32_t append(TriangleMesh& mesh, std::uint32_t vertex) {
        mesh.positions.push_back(Vec3(mesh.positions[vertex]));
        mesh.uvs.push_back(Vec2(mesh.uvs[vertex]));
        mesh.colors.push_back(Vec4(mesh.colors[vertex]));
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }

    /// Triangles to the right of the column get copies of its vertices.
    static void cut(TriangleMesh& mesh) {
        const std::vector<Vec3> at = mesh.positions;
        std::vector<float> columns;
        for (const Vec3& p : at) columns.push_back(p.x);
        std::ranges::sort(columns);
        const float column = columns[side];  // the second one
        std::vector<std::uint32_t> copy(at.size(), none);
        for (std::uint32_t v = 0; v < at.size(); ++v)
            if (at[v].x == column) copy[v] = append(mesh, v);
        for (Triangle& triangle : mesh.triangles) {
            if (std::ranges::none_of(triangle, [&](std::uint32_t v) { return at[v].x > column; })) continue;
            for (std::uint32_t& v : triangle)
                if (copy[v] != none) v = copy[v];
        }
    }

    /// One of the triangles at a copied vertex gets a copy of it.
    static void copy_again(TriangleMesh& mesh) {
        const std::uint32_t copied = side * side + 1;
        for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
            const auto corner = std::ranges::find(mesh.triangles[t], copied);
            if (t == removed || corner == mesh.triangles[t].end()) continue;
            *corner = append(mesh, copied);
            return;
        }
    }

    bool removes_;
    std::vector<std::pair<std::vector<Cloth>, std::uint64_t>> frames_;  ///< with the topology version
};

/// Expects that the constant triangles, whose vertices have these values, show the triangles of the surface.
inline void expect_shows(const std::vector<Triangle>& constant, const std::vector<Vec3>& values,
                         const std::vector<Triangle>& surface, const std::vector<Vec3>& expected, std::size_t frame) {
    ASSERT_EQ(constant.size(), surface.size());
    for (std::size_t t = 0; t < surface.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(values.at(constant[t][k]), expected.at(surface[t][k]))
                << "frame " << frame << ", triangle " << t << ", corner " << k;
}

}  // namespace weft::test
