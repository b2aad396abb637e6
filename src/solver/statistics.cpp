#include "solver/statistics.h"

#include "collide/crossings.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

double distance(Vec3 a, Vec3 b) {
    const double x = static_cast<double>(a.x) - b.x, y = static_cast<double>(a.y) - b.y,
                 z = static_cast<double>(a.z) - b.z;
    return std::sqrt(x * x + y * y + z * z);
}

double speed2(const Vec4& v) {
    return static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z;
}

class Mean {
  public:
    void add(double value) {
        sum_ += value;
        count_ += 1;
        max_ = std::max(max_, value);
    }
    MeanMax result() const { return {count_ > 0 ? sum_ / count_ : 0, max_}; }

  private:
    double sum_ = 0, count_ = 0, max_ = 0;
};

}  // namespace

Strain measure_strain(const Frame& frame) {
    Mean stretch, shear;
    for (const ClothFrame& cloth : frame.cloths) {
        const ClothModel& model = *cloth.model;
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            const auto [a, b] = model.edges[e];
            const double rest = distance(model.rest_position(a), model.rest_position(b));
            if (rest <= 0) continue;
            const double now = distance(cloth.positions[a].xyz(), cloth.positions[b].xyz());
            (e < model.axial_edges ? stretch : shear).add(std::abs(now / rest - 1));
        }
    }
    return {stretch.result(), shear.result()};
}

double kinetic_energy(const Frame& frame) {
    double energy = 0;
    for (const ClothFrame& cloth : frame.cloths) {
        for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
            if (cloth.positions[p].w > 0) energy += 0.5 * cloth.model->mass[p] * speed2(cloth.velocities[p]);
        }
    }
    return energy;
}

double max_speed(const Frame& frame) {
    double fastest = 0;
    for (const ClothFrame& cloth : frame.cloths) {
        for (const Vec4& v : cloth.velocities) fastest = std::max(fastest, speed2(v));
    }
    return std::sqrt(fastest);
}

Penetration measure_penetration(const Frame& frame, std::span<const Collider> colliders) {
    constexpr double tolerance = 1e-6;  // m: rounding of float positions a few meters from the origin
    Penetration result;
    for (const ClothFrame& cloth : frame.cloths) {
        for (std::uint32_t t = 0; t < cloth.model->triangle_count; ++t) {
            const auto [ia, ib, ic] = cloth.model->triangle(t);
            const Vec3 a = cloth.positions[ia].xyz(), b = cloth.positions[ib].xyz(), c = cloth.positions[ic].xyz();
            const Vec3 samples[] = {a, b, c, (a + b) * 0.5f, (b + c) * 0.5f, (c + a) * 0.5f, (a + b + c) / 3.0f};
            double deepest = 0;
            for (const Collider& collider : colliders) {
                for (Vec3 p : samples) deepest = std::max(deepest, -signed_distance(collider, p));
            }
            result.max = std::max(result.max, deepest);
            result.count += deepest > tolerance;
        }
    }
    return result;
}

Intersections count_intersections(const Frame& frame) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const ClothFrame& cloth : frame.cloths) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const Vec4& p : cloth.positions) positions.push_back(p.xyz());
        for (std::uint32_t t = 0; t < cloth.model->triangle_count; ++t) {
            const auto [a, b, c] = cloth.model->triangle(t);
            triangles.push_back({a + first, b + first, c + first});
        }
    }
    const Crossings crossings = count_crossings(positions, triangles);
    return {crossings.triangles, crossings.edges};
}

bool all_finite(const Frame& frame) {
    for (const ClothFrame& cloth : frame.cloths) {
        for (const Vec4& p : cloth.positions) {
            if (!finite(p.xyz())) return false;
        }
        for (const Vec4& v : cloth.velocities) {
            if (!finite(v.xyz())) return false;
        }
    }
    return true;
}

double mean_displacement(std::span<const Vec3> from, std::span<const Vec3> to) {
    Mean mean;
    for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) mean.add(distance(from[i], to[i]));
    return mean.result().mean;
}

void collect_positions(const Frame& frame, std::vector<Vec3>& out) {
    out.clear();
    for (const ClothFrame& cloth : frame.cloths) {
        for (const Vec4& p : cloth.positions) out.push_back(p.xyz());
    }
}

}  // namespace weft
