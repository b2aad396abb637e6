#include "solver/measures/passages.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr std::size_t samples_of_surface = 256, most_along = 64, most_across = 16;

std::size_t steps(float size, float step, std::size_t most) {
    if (!(size > 0) || !(step > 0)) return 1;
    return 1 + static_cast<std::size_t>(std::clamp(std::ceil(size / step), 1.0f, static_cast<float>(most - 1)));
}

float part_of(std::size_t i, std::size_t count, float half) {
    return count == 1 ? 0 : half * (2 * static_cast<float>(i) / static_cast<float>(count - 1) - 1);
}

std::vector<Vec3> points_of_axis(float half, float radius) {
    const std::size_t count = steps(2 * half, radius, most_along);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({0, part_of(i, count, half), 0});
    return points;
}

std::vector<Vec3> points_of_box(const std::array<float, 4>& half) {
    std::array<std::size_t, 3> by_size{0, 1, 2};
    std::ranges::sort(by_size, {}, [&](std::size_t k) { return half[k]; });
    const float least = half[by_size[0]], u = half[by_size[1]] - least, v = half[by_size[2]] - least;
    const std::size_t across = steps(2 * u, least, most_across);
    const std::size_t along = steps(2 * v, least, across == 1 ? most_along : most_across);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < across; ++i) {
        for (std::size_t j = 0; j < along; ++j) {
            float at[3] = {0, 0, 0};
            at[by_size[1]] = part_of(i, across, u), at[by_size[2]] = part_of(j, along, v);
            points.push_back({at[0], at[1], at[2]});
        }
    }
    return points;
}

// The middle of the straight way through the shape from a point of its surface: each step is as long as the depth.
std::optional<Vec3> middle_of_way(const Collider& shape, TrueSurfaces& surfaces, Vec3 from, Vec3 along, float size) {
    const float begin = 1e-4f * size;
    float way = begin;
    for (int step = 0; step < 64 && way < 2 * size; ++step) {
        const double depth = -surfaces.distance(shape, from + along * way);
        if (!(depth > 0.2 * double{begin})) break;
        way += static_cast<float>(depth);
    }
    if (way <= begin) return std::nullopt;
    const Vec3 middle = from + along * (0.5f * way);
    if (!(surfaces.distance(shape, middle) < 0)) return std::nullopt;
    return middle;
}

std::vector<Vec3> points_of_surface(const Collider& shape, TrueSurfaces& surfaces) {
    std::vector<Vec3> points;
    if (!shape.data) return points;
    const TriangleMesh& mesh = shape.data->surface;
    const float size = length(shape.data->bounds.size());
    const auto normal_of = [&](const Triangle& t) {
        return cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
    };
    double area = 0;
    for (const Triangle& t : mesh.triangles) area += double{length(normal_of(t))};
    if (!(area > 0) || !std::isfinite(area)) return points;
    const double spacing = area / samples_of_surface;
    double due = 0.5 * spacing, passed = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 normal = normal_of(t);
        const float twice = length(normal);
        for (passed += double{twice}; due < passed; due += spacing) {
            // The additive sequence of the golden and the silver ratio spreads points evenly.
            const auto number = static_cast<double>(points.size());
            float u = static_cast<float>(std::fmod(0.5 + number * 0.7548776662466927, 1.0));
            float v = static_cast<float>(std::fmod(0.5 + number * 0.5698402909980532, 1.0));
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const Vec3 a = mesh.positions[t[0]];
            const Vec3 from = a + (mesh.positions[t[1]] - a) * u + (mesh.positions[t[2]] - a) * v;
            const Vec3 inward = normal * (-1 / twice);
            auto middle = middle_of_way(shape, surfaces, from, inward, size);
            if (!middle) middle = middle_of_way(shape, surfaces, from, -inward, size);
            points.push_back(middle.value_or(from));
        }
    }
    return points;
}

}  // namespace

std::vector<Vec3> middle_points(const Collider& collider, TrueSurfaces& surfaces) {
    const auto& numbers = collider.numbers;
    switch (collider.shape) {
        case ShapeKind::plane:
            return {};
        case ShapeKind::sphere:
            return {{0, 0, 0}};
        case ShapeKind::box:
            return points_of_box(numbers);
        case ShapeKind::capsule:
            return points_of_axis(numbers[1], numbers[0]);
        case ShapeKind::tapered_capsule:
            return points_of_axis(numbers[2], std::min(numbers[0], numbers[1]));
        case ShapeKind::convex:
        case ShapeKind::mesh:
            break;
    }
    Collider shape = collider;
    shape.pose = {};
    return points_of_surface(shape, surfaces);
}

}  // namespace weft
