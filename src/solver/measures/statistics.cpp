#include "solver/measures/statistics.h"

#include "base/copies.h"
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

Intersections count_intersections(const Frame& frame, std::span<const Collider> colliders) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    enum class Side : std::uint8_t { cloth, cloth_that_meets_surfaces, surface };
    std::vector<Side> sides;  // by particle
    const auto add = [&](const TriangleView& more, Side side) {
        const auto first = static_cast<std::uint32_t>(sides.size());
        sides.resize(positions.size(), side);
        for (const auto& [a, b, c] : more) triangles.push_back({a + first, b + first, c + first});
    };
    for (const ClothFrame& cloth : frame.cloths) {
        for (const Vec4& p : cloth.positions) positions.push_back(p.xyz());
        add(cloth.triangles, cloth.model->collision.meets_surfaces() ? Side::cloth_that_meets_surfaces : Side::cloth);
    }
    for (const Collider& collider : colliders) {
        if (!collider.surface) continue;
        for (std::uint32_t p = 0; p < collider.surface->particle_count; ++p)
            positions.push_back(to_world(collider.pose, collider.surface->rest_position(p)));
        add(collider.surface->triangles(), Side::surface);
    }
    const auto can_cross = [&](std::uint32_t p, std::uint32_t q) {
        if (sides[p] != Side::surface && sides[q] != Side::surface) return true;
        return sides[p] != sides[q] && sides[p] != Side::cloth && sides[q] != Side::cloth;
    };
    const Crossings crossings = count_crossings(positions, triangles, can_cross);
    return {crossings.triangles, crossings.edges};
}

std::vector<SheetPose> sheet_poses(const Frame& frame) {
    std::vector<SheetPose> sheets;
    for (const ClothFrame& cloth : frame.cloths) {
        SheetPose& sheet = sheets.emplace_back();
        for (const Vec4& p : cloth.positions) sheet.positions.push_back(p.xyz());
        sheet.triangles.assign(cloth.triangles.begin(), cloth.triangles.end());
        sheet.copied_from.assign(cloth.model->copied_from.begin(), cloth.model->copied_from.end());
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
        thickness = std::max(thickness,
                             double{cloth.model->fabric.contact.thickness} * double{cloth.model->thickness_range[1]});
    }
    return 2 * edge + thickness;
}

double mean_displacement(std::span<const Vec3> from, std::span<const Vec3> to) {
    Tally mean;
    for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) mean.add(distance(from[i], to[i]));
    return mean.result().mean;
}

double mean_displacement(const Positions& from, const Frame& to) {
    std::vector<Vec3> before, now, of_cloth;
    for (std::size_t i = 0; i < to.cloths.size(); ++i) {
        const ClothFrame& cloth = to.cloths[i];
        of_cloth = from[i];
        append_copies(of_cloth, cloth.model->copied_from, cloth.positions.size());
        before.insert(before.end(), of_cloth.begin(), of_cloth.end());
    }
    collect_positions(to, now);
    return mean_displacement(before, now);
}

Positions positions_of(const Frame& frame) {
    Positions positions;
    for (const ClothFrame& cloth : frame.cloths) {
        std::vector<Vec3>& of_cloth = positions.emplace_back();
        for (const Vec4& p : cloth.positions) of_cloth.push_back(p.xyz());
    }
    return positions;
}

void collect_positions(const Frame& frame, std::vector<Vec3>& out) {
    out.clear();
    for (const ClothFrame& cloth : frame.cloths) {
        for (const Vec4& p : cloth.positions) out.push_back(p.xyz());
    }
}

}  // namespace weft
