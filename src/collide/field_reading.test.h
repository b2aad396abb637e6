// Builds distance fields and reads them as the kernel does.
#pragma once

#include "collide/distance_field.h"
#include "physics/testing.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace weft {

using FieldRandom = testing_kernels::Random;

inline constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";

inline TriangleMesh read_bunny() {
    TriangleMesh mesh;
    std::ifstream in(bunny_file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Vec3& p = mesh.positions.emplace_back();
            words >> p.x >> p.y >> p.z;
        } else if (kind == "f") {
            Triangle& t = mesh.triangles.emplace_back();
            words >> t[0] >> t[1] >> t[2];
            for (std::uint32_t& corner : t) --corner;
        }
    }
    return mesh;
}

inline DistanceField field_of(const TriangleMesh& mesh, std::uint32_t cells = 48, unsigned threads = 1) {
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = cells, .threads = threads});
    EXPECT_TRUE(field.ok()) << field.error().message();
    return *std::move(field);
}

// What the kernel returns, in float as on the CPU.
struct Reading {
    float distance;
    Vec3 normal;
};
inline Reading read(const DistanceField& field, Vec3 p) {
    scalar::vec3 normal;
    const float distance = scalar::distance_mesh({p.x, p.y, p.z}, {0, 0, 0, 0, field.data.blocks()}, normal);
    return {distance, {normal.x, normal.y, normal.z}};
}

inline Vec3 random_direction(FieldRandom& random) {
    while (true) {
        const auto v = random.vector(1);
        const double n = testing_kernels::norm(v);
        if (n > 0.1 && n < 1) {
            return {static_cast<float>(v.x / n), static_cast<float>(v.y / n), static_cast<float>(v.z / n)};
        }
    }
}

}  // namespace weft
