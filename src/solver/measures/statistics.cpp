#include "solver/measures/statistics.h"

#include "collide/crossings.h"

#include <algorithm>

namespace weft {

ClothMeasures measure(const Frame& frame) {
    MeasureSums sums;
    for (const ClothFrame& cloth : frame.cloths) sums.add(*cloth.model, cloth.positions, cloth.velocities);
    return sums.result();
}

Strain measure_strain(const Frame& frame) {
    return measure(frame).strain;
}

double kinetic_energy(const Frame& frame) {
    return measure(frame).kinetic_energy;
}

double max_speed(const Frame& frame) {
    return measure(frame).max_speed;
}

bool all_finite(const Frame& frame) {
    return measure(frame).finite;
}

Penetration measure_penetration(const Frame& frame, std::span<const Collider> colliders) {
    return PenetrationSearch().measure(frame, colliders);
}

Intersections count_intersections(const Frame& frame) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const ClothFrame& cloth : frame.cloths) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const Vec4& p : cloth.positions) positions.push_back(p.xyz());
        for (const auto& [a, b, c] : cloth.triangles) triangles.push_back({a + first, b + first, c + first});
    }
    const Crossings crossings = count_crossings(positions, triangles);
    return {crossings.triangles, crossings.edges};
}

std::vector<SheetPose> sheet_poses(const Frame& frame) {
    std::vector<SheetPose> sheets;
    for (const ClothFrame& cloth : frame.cloths) {
        SheetPose& sheet = sheets.emplace_back();
        for (const Vec4& p : cloth.positions) sheet.positions.push_back(p.xyz());
        sheet.triangles.assign(cloth.triangles.begin(), cloth.triangles.end());
    }
    return sheets;
}

double stack_distance(const Frame& frame) {
    double edge = 0, thickness = 0;
    for (const ClothFrame& cloth : frame.cloths) {
        Tally edges;
        for (const auto& [a, b, c] : cloth.triangles)
            for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
                edges.add(distance(cloth.positions[p].xyz(), cloth.positions[q].xyz()));
        edge = std::max(edge, edges.result().mean);
        thickness = std::max(thickness, double{cloth.model->fabric.contact.thickness});
    }
    return 2 * edge + thickness;
}

double mean_displacement(std::span<const Vec3> from, std::span<const Vec3> to) {
    Tally mean;
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
