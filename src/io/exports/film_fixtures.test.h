// Small animations for the tests of the exporters: waving cloths with all kinds of vertex data.
#pragma once

#include "base/temporary_folder.test.h"
#include "io/exports/exporter.h"
#include "mesh/procedural.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft::test {

class TestFolder : public TemporaryFolder {
  public:
    std::filesystem::path operator/(const std::string& name) const { return path() / name; }
    /// Names of all files in it, including hidden ones.
    std::set<std::string> names() const {
        std::set<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(path())) found.insert(entry.path().filename());
        return found;
    }
};

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

struct Cloth {
    std::string name;
    TriangleMesh mesh;
    float phase = 0;

    /// A wave with the exact normals of its surface y(x, t).
    std::pair<std::vector<Vec3>, std::vector<Vec3>> at(double time) const {
        std::vector<Vec3> positions = mesh.positions, normals(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const float angle = 9 * positions[i].x + 6 * static_cast<float>(time) + phase;
            positions[i].y = phase + 0.1f * std::sin(angle);
            normals[i] = normalized({-0.9f * std::cos(angle), 1, 0});
        }
        return {positions, normals};
    }
};

inline Cloth make_cloth(std::string name, std::uint32_t resolution, float phase, bool colors = false) {
    Cloth cloth{std::move(name), make_grid({1, 1}, {resolution, resolution}, GridDiagonal::alternating), phase};
    for (std::size_t i = 0; colors && i < cloth.mesh.positions.size(); ++i) {
        const float u = cloth.mesh.uvs[i].x, v = cloth.mesh.uvs[i].y;
        cloth.mesh.colors.push_back({u, v, 0.25f, 1});
    }
    return cloth;
}

/// One frame and the memory that its spans refer to.
class Instant {
  public:
    Instant(const std::vector<Cloth>& cloths, std::uint64_t index, double time) : index_(index), time_(time) {
        data_.reserve(cloths.size());
        for (const Cloth& cloth : cloths) {
            const auto& [positions, normals] = data_.emplace_back(cloth.at(time));
            surfaces.push_back(surface_of(cloth.name, cloth.mesh, positions, normals));
        }
    }
    Instant(const Instant&) = delete;
    Instant& operator=(const Instant&) = delete;

    ExportFrame frame() const { return {index_, time_, surfaces}; }
    std::vector<Vec3>& positions(std::size_t cloth) { return data_[cloth].first; }
    std::vector<Vec3>& normals(std::size_t cloth) { return data_[cloth].second; }

    std::vector<ExportSurface> surfaces;

  private:
    std::uint64_t index_;
    double time_;
    std::vector<std::pair<std::vector<Vec3>, std::vector<Vec3>>> data_;
};

/// Calls begin(), writes `count` frames at `rate` per second, calls finish().
inline Result<void> export_film(const std::filesystem::path& path, const std::vector<Cloth>& cloths,
                                std::uint64_t count, double rate = 60) {
    Result<std::unique_ptr<Exporter>> made = make_exporter(path);
    if (!made) return made.errors();
    Exporter& exporter = **made;
    if (Result<void> begun = exporter.begin({"waves", rate, count}); !begun) return begun;
    for (std::uint64_t i = 0; i < count; ++i) {
        const Instant instant(cloths, i, static_cast<double>(i) / rate);
        if (Result<void> written = exporter.write(instant.frame()); !written) return written;
    }
    return exporter.finish();
}

}  // namespace weft::test
