#include "solver/model/stress_table.h"

#include "mesh/edges.h"
#include "physics/membrane/membrane_split.h"
#include "physics/stretch/stretch_law.h"
#include "solver/model/tear_paint.h"
#include "solver/model/tear_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

using reference::vec3;

vec3 unit(vec3 v) {
    const double length = std::sqrt(dot(v, v));
    return length > 0 ? v * (1 / length) : vec3(0, 0, 0);
}

bool has_direction(vec3 unit_vector) {
    return dot(unit_vector, unit_vector) > 0.5;
}

// A triangle at rest. `warp` is a unit vector in its plane, and 0 if the triangle is degenerate.
struct RestTriangle {
    std::array<vec3, 3> corners;
    vec3 normal, warp;
};

// `wound`: the same corners, perhaps in the other direction.
RestTriangle at_rest(const ClothModel& model, const Triangle& triangle, const Triangle& wound, std::uint32_t t) {
    const auto place = [&](std::uint32_t p) { return reference::to_double(model.rest_position(p)); };
    const vec3 side = place(triangle[1]) - place(triangle[0]);
    const vec3 normal = unit(cross(side, place(triangle[2]) - place(triangle[0])));
    RestTriangle rest{};
    for (std::size_t k = 0; k < 3; ++k) rest.corners[k] = place(wound[k]);
    rest.normal = wound[1] == triangle[1] ? normal : -normal;
    if (!has_direction(normal)) return rest;
    const double angle = model.face_warp[t];
    rest.warp = unit(side) * std::cos(angle) + cross(normal, unit(side)) * std::sin(angle);
    return rest;
}

double stiffness(float compliance) {
    return compliance > 0 ? 1 / static_cast<double>(compliance) : 0;
}

// `weight`: factor on the stiffness.
reference::TearSide make_side(const StretchLaw& law, const RestTriangle& rest, std::size_t k, float weight) {
    const vec3 along = rest.corners[(k + 1) % 3] - rest.corners[k];
    const double length = std::sqrt(dot(along, along));
    const double x = dot(along, rest.warp) / length, y = dot(along, cross(rest.normal, rest.warp)) / length;
    const StretchLaw::Compliances at = law.at(static_cast<float>(std::min(1.0, x * x)), weight);
    const double play = law.play(static_cast<float>(std::min(1.0, x * x)), 1);
    return {.rest = length,
            .pull = stiffness(at.stretched),
            .push = stiffness(at.compressed),
            .x = x,
            .y = y,
            .play = play};
}

// Gives the sides the springs of the membrane. `rest` has an area.
void add_membrane(StressTable::Face& face, const RestTriangle& rest, const StretchMaterial& material, double weight) {
    const auto opposite = [](std::size_t k) { return (k + 2) % 3; };  // corner of side k
    MembraneShape shape;
    for (std::size_t k = 0; k < 3; ++k) {
        const reference::TearSide& side = face.sides[k];
        shape.along_warp[opposite(k)] = side.x * side.rest, shape.along_weft[opposite(k)] = side.y * side.rest;
    }
    const MembraneSplit split = split_membrane(shape, material, weight);
    for (std::size_t k = 0; k < 3; ++k) {
        const double rest2 = face.sides[k].rest * face.sides[k].rest;
        face.sides[k].pull = split.stretched[opposite(k)] * rest2 / face.area;
        face.sides[k].push = split.compressed[opposite(k)] * rest2 / face.area;
        for (std::size_t l = 0; l < 3; ++l)
            face.coupling[k][l] =
                split.remainder[opposite(k)][opposite(l)] * rest2 * face.sides[l].rest * face.sides[l].rest / face.area;
    }
}

double angle_at(const RestTriangle& rest, std::size_t k) {
    const vec3 a = rest.corners[(k + 1) % 3] - rest.corners[k], b = rest.corners[(k + 2) % 3] - rest.corners[k];
    const vec3 n = cross(a, b);
    return std::atan2(std::sqrt(dot(n, n)), dot(a, b));
}

// The vector after the shortest rotation that brings its plane's normal to `normal`.
vec3 laid_over(vec3 v, vec3 from_normal, vec3 normal) {
    const double cosine = 1 + dot(from_normal, normal);
    if (cosine < 1e-9) return v;
    return v - (from_normal + normal) * (dot(normal, v) / cosine);
}

struct Corner {
    std::uint32_t face = 0, place = 0;  // place in StressTable::faces, corner of it
    vec3 normal, warp;
};

// The axes of a particle are the mean warp of its triangles, weighted by area, and what is perpendicular to it. A
// tensor has no sign of direction, so the mean is that of twice the angle.
void turn_corners(StressTable& table, const std::vector<Corner>& around, vec3 normal, std::array<vec3, 2>& axes) {
    if (!has_direction(normal)) normal = around.front().normal;
    const vec3 x = unit(laid_over(around.front().warp, around.front().normal, normal)), y = cross(normal, x);
    double mean_c2 = 0, mean_s2 = 0;
    for (const Corner& corner : around) {
        const vec3 warp = laid_over(corner.warp, corner.normal, normal);
        const double c = dot(warp, x), s = dot(warp, y);
        auto& turn = table.faces[corner.face].turns[corner.place];
        turn = {c * c - s * s, 2 * c * s};
        mean_c2 += table.faces[corner.face].area * turn[0], mean_s2 += table.faces[corner.face].area * turn[1];
    }
    const double size = std::sqrt(mean_c2 * mean_c2 + mean_s2 * mean_s2);
    const double angle = size > 0 ? 0.5 * std::atan2(mean_s2, mean_c2) : 0;
    axes = {x * std::cos(angle) + y * std::sin(angle), y * std::cos(angle) - x * std::sin(angle)};
    if (!(size > 0)) return;
    mean_c2 /= size, mean_s2 /= size;
    for (const Corner& corner : around) {
        auto& [c2, s2] = table.faces[corner.face].turns[corner.place];
        const double turned = c2 * mean_c2 + s2 * mean_s2;
        s2 = s2 * mean_c2 - c2 * mean_s2;
        c2 = turned;
    }
}

std::vector<std::uint8_t> rim_of(const std::vector<Edge>& edges, std::uint32_t particle_count) {
    std::vector<std::uint8_t> rim(particle_count);
    for (const Edge& edge : edges)
        if (edge.triangle1 == none) rim[edge.a] = rim[edge.b] = 1;
    return rim;
}

bool winds(const Triangle& triangle, const Edge& edge) {
    for (std::size_t k = 0; k < 3; ++k)
        if (triangle[k] == edge.a && triangle[(k + 1) % 3] == edge.b) return true;
    return false;
}

// Turns triangles over so that neighbors wind their edge in opposite directions. Where that is impossible (a Möbius
// strip), some neighbors do not.
void wind_alike(std::vector<Triangle>& triangles, const std::vector<Edge>& edges) {
    struct Neighbor {
        std::uint32_t triangle = none;
        bool turned = false;
    };
    std::vector<std::array<Neighbor, 3>> neighbors(triangles.size());
    std::vector<std::uint8_t> used(triangles.size());
    for (const Edge& edge : edges) {
        if (edge.triangle1 == none) continue;
        const bool turned = winds(triangles[edge.triangle0], edge) == winds(triangles[edge.triangle1], edge);
        neighbors[edge.triangle0][used[edge.triangle0]++] = {edge.triangle1, turned};
        neighbors[edge.triangle1][used[edge.triangle1]++] = {edge.triangle0, turned};
    }
    std::vector<std::uint8_t> seen(triangles.size());
    std::vector<std::uint32_t> next;
    std::vector<std::uint8_t> turn(triangles.size());
    for (std::uint32_t first = 0; first < triangles.size(); ++first) {
        if (seen[first]) continue;
        seen[first] = 1;
        next.push_back(first);
        while (!next.empty()) {
            const std::uint32_t t = next.back();
            next.pop_back();
            for (const Neighbor& neighbor : neighbors[t]) {
                if (neighbor.triangle == none || seen[neighbor.triangle]) continue;
                seen[neighbor.triangle] = 1;
                turn[neighbor.triangle] = turn[t] != static_cast<std::uint8_t>(neighbor.turned);
                next.push_back(neighbor.triangle);
            }
        }
    }
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (turn[t]) std::swap(triangles[t][1], triangles[t][2]);
}

// Takes over what is painted. `triangles`: the current ones.
void add_paint(StressTable& table, const ClothModel& model, const TriangleView& triangles) {
    const TearTable& tears = *model.tears;
    const TearPaint& paint = *model.tear_paint;
    const auto particle_at = [&](std::uint32_t corner) {
        return triangles[corner % model.face_stride][corner / model.face_stride];
    };
    if (!paint.resistance.empty()) {
        table.inverse_resistance.assign(model.particle_count, 1.0);
        for (const TearTable::Entry& entry : tears.entries)
            table.inverse_resistance[particle_at(entry.corner)] = 1 / double{paint.resistance[entry.vertex]};
    }
    std::vector<const TearPaint::Link*> last(tears.entries.size());
    for (const TearPaint::Link& link : paint.seams) last[link.link] = &link;
    for (const TearPaint::Link* link : last) {
        if (!link) continue;
        const TearTable::Entry& entry = tears.entries[link->link];
        const std::uint32_t p = particle_at(entry.corner), far = particle_at(entry.far);
        const bool closed = p == particle_at(tears.entries[entry.next].corner) && far == particle_at(entry.next_far);
        if (!closed || p == far) continue;
        const vec3 along =
            reference::to_double(model.rest_position(far)) - reference::to_double(model.rest_position(p));
        const double x = dot(along, table.axes[p][0]), y = dot(along, table.axes[p][1]),
                     size = std::sqrt(x * x + y * y);
        if (size > 0)
            table.seams.push_back({p, -y / size, x / size, 1 / double{link->strength}, double{link->tear_energy}});
    }
}

}  // namespace

std::array<double, 2> seam_normal(const TearPaint::Link& seam, const std::array<vec3, 2>& axes, vec3 edge) {
    const vec3 across = reference::to_double(seam.across);
    double x = dot(across, axes[0]), y = dot(across, axes[1]), size = std::sqrt(x * x + y * y);
    if (!(size > 0)) {
        x = -dot(edge, axes[1]), y = dot(edge, axes[0]), size = std::sqrt(x * x + y * y);
        if (!(size > 0)) return {1, 0};
    }
    return {x / size, y / size};
}

StressTable make_stress_table(const ClothModel& model, const TriangleView& triangles) {
    const Fabric& fabric = model.fabric;
    StressTable table;
    table.inextensible = fabric.stretch.inextensible;
    for (std::size_t i = 0; i < 2; ++i)
        table.inverse_strength[i] = fabric.tear.strength[i] > 0 ? 1 / static_cast<double>(fabric.tear.strength[i]) : 0;
    table.tear_energy = fabric.tear.tear_energy;
    table.tear_ratio = fabric.tear.tear_ratio;
    table.membranes = has_membranes(fabric.stretch);

    const StretchLaw law(fabric.stretch);
    std::vector<std::vector<Corner>> around(model.particle_count);
    std::vector<vec3> normals(model.particle_count, vec3(0, 0, 0));
    std::vector<double> angles(model.particle_count), lengths(model.particle_count), sides(model.particle_count);
    std::vector<Triangle> alive;
    std::vector<std::uint32_t> numbers;  // of `alive`, in `triangles`
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (model.face_area[t] > 0) alive.push_back(triangles[t]), numbers.push_back(t);
    const std::vector<Edge> edges = build_edges(alive, model.particle_count).edges;
    wind_alike(alive, edges);
    table.area.resize(model.particle_count);
    table.cut_end.resize(model.particle_count);
    table.axes.assign(model.particle_count, {vec3(1, 0, 0), vec3(0, 0, 1)});
    for (std::size_t i = 0; i < alive.size(); ++i) {
        const Triangle triangle = alive[i];
        const double area = model.face_area[numbers[i]];
        const float weight = model.weights->stretch.at(numbers[i]);
        const RestTriangle rest = at_rest(model, triangles[numbers[i]], triangle, numbers[i]);
        if (!has_direction(rest.warp)) continue;
        StressTable::Face face{
            .triangle = numbers[i], .corners = {triangle[0], triangle[1], triangle[2]}, .area = area};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = triangle[k];
            face.sides[k] = make_side(law, rest, k, weight);
            around[p].push_back({static_cast<std::uint32_t>(table.faces.size()), static_cast<std::uint32_t>(k),
                                 rest.normal, rest.warp});
            normals[p] = normals[p] + rest.normal * area;
            angles[p] += angle_at(rest, k);
            table.area[p] += area;
            for (const std::uint32_t end : {p, triangle[(k + 1) % 3]}) lengths[end] += face.sides[k].rest, ++sides[end];
        }
        if (table.membranes) add_membrane(face, rest, fabric.stretch, double{weight});
        table.faces.push_back(face);
    }
    const std::vector<std::uint8_t> rim = rim_of(edges, model.particle_count);
    constexpr double three_quarters = 1.5 * std::numbers::pi + 1e-3;  // room for rounding
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        if (around[p].empty()) continue;
        turn_corners(table, around[p], unit(normals[p]), table.axes[p]);
        if (rim[p] && angles[p] > three_quarters) table.cut_end[p] = lengths[p] / sides[p];
    }
    if (model.tear_paint) add_paint(table, model, triangles);
    return table;
}

}  // namespace weft
