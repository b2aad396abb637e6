// Errors of weft's collider shapes, and of simpler methods for the same task:
//   - a box whose nearest face is chosen by ratios,
//   - a mesh as a grid of correction vectors, with as much memory as the distance field,
//   - a mesh as a union of balls.
// Usage: weft_bench_baselines <mesh.obj>. The mesh is scaled so that its longest side is 0.3 m.
#include "base/workers.h"
#include "collide/closest_point.h"
#include "collide/distance_field.h"
#include "collide/solid_surface.h"
#include "physics/scalar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace weft;
using reference::to_double;
using reference::vec3;

constexpr int sample_count = 200'000;

// The same numbers on every machine.
class Numbers {
  public:
    double next() { return static_cast<double>(engine_()) / 4294967296.0; }
    double between(double low, double high) { return low + (high - low) * next(); }

  private:
    std::mt19937 engine_{1};
};

struct Errors {
    std::vector<double> all = {};
    double sum = 0, largest = 0;

    void add(double error) {
        all.push_back(error);
        sum += error;
        largest = std::max(largest, error);
    }
    int count() const { return static_cast<int>(all.size()); }
    double mean() const { return sum / static_cast<double>(all.size()); }
    /// 99 % of the errors are at most this.
    double most() const {
        std::vector<double> sorted = all;
        const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 99 / 100);
        std::ranges::nth_element(sorted, at);
        return *at;
    }
};

Vec3 narrow(vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
double norm(vec3 v) {
    return std::sqrt(reference::dot(v, v));
}
double degrees_between(vec3 a, vec3 b) {
    return std::acos(std::clamp(reference::dot(a, b), -1.0, 1.0)) * 180 / std::numbers::pi;
}

// Boxes

// The face with the largest |coordinate| / half extent is taken as the nearest one.
double distance_by_ratio(vec3 p, vec3 half, vec3& normal) {
    const double at[3] = {p.x, p.y, p.z}, extent[3] = {half.x, half.y, half.z};
    int face = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(at[axis]) / extent[axis] > std::abs(at[face]) / extent[face]) face = axis;
    double n[3] = {0, 0, 0};
    n[face] = at[face] < 0 ? -1 : 1;
    normal = {n[0], n[1], n[2]};
    return std::abs(at[face]) - extent[face];
}

// Points within `band` of the surface, inside or outside.
void compare_boxes(const char* name, vec3 half, double band, bool inside) {
    Numbers random;
    Errors distance, angle;
    int wrong_normals = 0;
    while (distance.count() < sample_count) {
        const vec3 p = {random.between(-half.x - band, half.x + band), random.between(-half.y - band, half.y + band),
                        random.between(-half.z - band, half.z + band)};
        vec3 exact_normal, normal;
        const double exact = reference::distance_box(p, {half.x, half.y, half.z, 0, {}}, exact_normal);
        if (std::abs(exact) > band || (exact < 0) != inside) continue;
        distance.add(std::abs(distance_by_ratio(p, half, normal) - exact));
        angle.add(degrees_between(normal, exact_normal));
        if (angle.all.back() > 1) ++wrong_normals;
    }
    std::printf("| %s | %s | %.3f | %.2f | %.1f | %.2f |\n", name, inside ? "inside" : "outside", 1e3 * distance.mean(),
                1e3 * distance.largest, angle.largest, 100.0 * wrong_normals / sample_count);
}

// Meshes

struct Body {
    TriangleMesh mesh;
    Bounds bounds;
    std::vector<double> area_up_to;  // of the triangles up to each

    struct Sample {
        vec3 at, normal;
    };
    Sample on_surface(Numbers& random) const {
        const auto found = std::ranges::lower_bound(area_up_to, random.next() * area_up_to.back());
        const auto [a, b, c] = mesh.triangles[static_cast<std::size_t>(found - area_up_to.begin())];
        double u = random.next(), v = random.next();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const vec3 o = to_double(mesh.positions[a]), e = to_double(mesh.positions[b]) - o,
                   f = to_double(mesh.positions[c]) - o;
        const vec3 normal = reference::cross(e, f);
        return {o + e * u + f * v, normal * (1 / norm(normal))};
    }
};

Body read_body(const std::string& file) {
    Body body;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind, corner;
        words >> kind;
        if (kind == "v") {
            Vec3& p = body.mesh.positions.emplace_back();
            words >> p.x >> p.y >> p.z;
        } else if (kind == "f") {
            Triangle& t = body.mesh.triangles.emplace_back();
            for (std::uint32_t& index : t) {
                words >> corner;
                index = static_cast<std::uint32_t>(std::stoul(corner)) - 1;
            }
        }
    }
    if (body.mesh.triangles.empty()) return body;
    const Vec3 size = bounds_of(body.mesh.positions).size();
    const float scale = 0.3f / std::max({size.x, size.y, size.z});
    for (Vec3& p : body.mesh.positions) p = p * scale;
    body.bounds = bounds_of(body.mesh.positions);
    double area = 0;
    for (const auto& [a, b, c] : body.mesh.triangles) {
        const vec3 o = to_double(body.mesh.positions[a]);
        area +=
            norm(reference::cross(to_double(body.mesh.positions[b]) - o, to_double(body.mesh.positions[c]) - o)) / 2;
        body.area_up_to.push_back(area);
    }
    return body;
}

class Exact {
  public:
    Exact(const Body& body, WorkerTeam& team)
        : body_(body),
          search_(body.mesh.positions, body.mesh.triangles),
          solid_(body.mesh.positions, orient_triangles(body.mesh.positions, body.mesh.triangles), team) {}
    vec3 nearest(vec3 p) const {
        const SurfacePoint found = search_.closest(narrow(p));
        vec3 at = {0, 0, 0};
        for (std::size_t i = 0; i < 3; ++i)
            at = at + to_double(body_.mesh.positions[body_.mesh.triangles[found.triangle][i]]) * found.weights[i];
        return at;
    }
    double distance(vec3 p) const { return search_.closest(narrow(p)).distance; }
    bool inside(vec3 p) const { return solid_.inside(narrow(p)); }

  private:
    const Body& body_;
    SurfaceSearch search_;
    SolidSurface solid_;
};

// Each cell has the vector from its center to the nearest point of the surface, as three numbers of 16 bits.
class VectorGrid {
  public:
    VectorGrid(const Body& body, const Exact& exact, std::size_t bytes) : origin_(to_double(body.bounds.min)) {
        const vec3 size = to_double(body.bounds.size());
        const double cells = static_cast<double>(bytes) / 6;
        cell = std::cbrt(size.x * size.y * size.z / cells);
        const auto along = [&](double length) { return std::max(1, static_cast<int>(std::ceil(length / cell))); };
        count_[0] = along(size.x), count_[1] = along(size.y), count_[2] = along(size.z);
        for (int z = 0; z < count_[2]; ++z)
            for (int y = 0; y < count_[1]; ++y)
                for (int x = 0; x < count_[0]; ++x) {
                    const vec3 center = origin_ + vec3{x + 0.5, y + 0.5, z + 0.5} * cell;
                    vectors_.push_back(exact.nearest(center) - center);
                }
    }
    // The vector of the cell that the point is in.
    vec3 of_cell(vec3 p) const {
        const vec3 q = (p - origin_) * (1 / cell);
        return at(static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
                  static_cast<int>(std::floor(q.z)));
    }
    // Trilinear between the centers of eight cells.
    vec3 interpolated(vec3 p) const {
        const vec3 q = (p - origin_) * (1 / cell) - vec3{0.5, 0.5, 0.5};
        const int x = static_cast<int>(std::floor(q.x)), y = static_cast<int>(std::floor(q.y)),
                  z = static_cast<int>(std::floor(q.z));
        const double f = q.x - x, g = q.y - y, h = q.z - z;
        vec3 sum = {0, 0, 0};
        for (int i = 0; i < 8; ++i)
            sum = sum + at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)) *
                            ((i & 1 ? f : 1 - f) * (i & 2 ? g : 1 - g) * (i & 4 ? h : 1 - h));
        return sum;
    }
    double cell = 0;  // m

  private:
    vec3 at(int x, int y, int z) const {
        x = std::clamp(x, 0, count_[0] - 1), y = std::clamp(y, 0, count_[1] - 1), z = std::clamp(z, 0, count_[2] - 1);
        return vectors_[static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x)];
    }
    vec3 origin_;
    int count_[3] = {};
    std::vector<vec3> vectors_;
};

void print_errors(const char* name, const Errors& errors) {
    std::printf("| %s | %.4f | %.3f | %.3f |\n", name, 1e3 * errors.mean(), 1e3 * errors.most(), 1e3 * errors.largest);
}

// Pushes points out that are inside, up to a cell deep. The error is how far from the surface they end up.
void compare_grids(const Body& body, const Exact& exact, const DistanceField& field) {
    const VectorGrid grid(body, exact, field.bytes()), small(body, exact, std::size_t{240'000} * 6);
    Numbers random;
    Errors of_field, of_cell, of_small_cell, interpolated;
    while (of_field.count() < sample_count) {
        const Body::Sample sample = body.on_surface(random);
        const vec3 p = sample.at - sample.normal * (random.next() * double{field.cell});
        if (!exact.inside(p)) continue;
        vec3 normal;
        const double depth = reference::distance_mesh(p, {0, 0, 0, 0, field.data.blocks()}, normal);
        of_field.add(exact.distance(p - normal * depth));
        of_cell.add(exact.distance(p + grid.of_cell(p)));
        of_small_cell.add(exact.distance(p + small.of_cell(p)));
        interpolated.add(exact.distance(p + grid.interpolated(p)));
    }
    std::printf("\nPushing out of the mesh: %.1f MB, cells %.2f mm (field) and %.2f mm (vectors)\n",
                static_cast<double>(field.bytes()) / 1e6, 1e3 * double{field.cell}, 1e3 * grid.cell);
    std::puts("| method | mean error, mm | 99 % below, mm | largest error, mm |\n|---|---|---|---|");
    print_errors("distance field", of_field);
    print_errors("vector of the cell", of_cell);
    print_errors("vector of the cell, 240,000 cells", of_small_cell);
    print_errors("interpolated vectors", interpolated);
}

struct Ball {
    vec3 center;
    double radius;
};

// Repeatedly adds the inner ball that brings the surface of all balls closest to that of the mesh, on average.
std::vector<Ball> inner_balls(const Body& body, const Exact& exact, std::size_t count) {
    Numbers random;
    std::vector<Ball> candidates;
    const vec3 low = to_double(body.bounds.min), size = to_double(body.bounds.size());
    while (candidates.size() < 4000) {
        const vec3 p = low + vec3{size.x * random.next(), size.y * random.next(), size.z * random.next()};
        if (exact.inside(p)) candidates.push_back({p, exact.distance(p)});
    }
    std::vector<vec3> surface;
    while (surface.size() < 2000) surface.push_back(body.on_surface(random).at);
    std::vector<double> beyond(surface.size(), 1e30);
    std::vector<Ball> balls;
    while (balls.size() < count) {
        const Ball* best = nullptr;
        double least = 1e300;
        for (const Ball& ball : candidates) {
            double sum = 0;
            for (std::size_t i = 0; i < surface.size(); ++i)
                sum += std::min(beyond[i], norm(surface[i] - ball.center) - ball.radius);
            if (sum < least) least = sum, best = &ball;
        }
        balls.push_back(*best);
        for (std::size_t i = 0; i < surface.size(); ++i)
            beyond[i] = std::min(beyond[i], norm(surface[i] - best->center) - best->radius);
    }
    return balls;
}

double distance_to_balls(const std::vector<Ball>& balls, vec3 p) {
    double least = 1e30;
    for (const Ball& ball : balls) least = std::min(least, norm(p - ball.center) - ball.radius);
    return least;
}

// How far the surface of each shape is from points of the mesh's surface.
void compare_balls(const Body& body, const Exact& exact, const DistanceField& field) {
    std::vector<Ball> balls = inner_balls(body, exact, 20);
    Numbers random;
    std::vector<double> beyond;
    Errors of_field, inner, grown;
    for (int i = 0; i < sample_count; ++i) {
        const vec3 p = body.on_surface(random).at;
        vec3 normal;
        of_field.add(std::abs(reference::distance_mesh(p, {0, 0, 0, 0, field.data.blocks()}, normal)));
        beyond.push_back(distance_to_balls(balls, p));
        inner.add(std::abs(beyond.back()));
    }
    // With all radii larger by the median, the mean error is the smallest.
    std::vector<double> sorted = beyond;
    std::ranges::nth_element(sorted, sorted.begin() + sample_count / 2);
    const double growth = sorted[sample_count / 2];
    for (const double distance : beyond) grown.add(std::abs(distance - growth));
    std::printf("\nSurface of the shape: %zu balls\n", balls.size());
    std::puts("| method | mean error, mm | 99 % below, mm | largest error, mm |\n|---|---|---|---|");
    print_errors("distance field", of_field);
    print_errors("balls inside the mesh", inner);
    print_errors("balls, radii enlarged for the least mean error", grown);
}

}  // namespace

int main(int argc, char** argv) {
    std::puts("Box, points within 5 mm of the surface");
    std::puts(
        "| half extents, m | points | mean error, mm | largest error, mm | largest error of the normal, ° | normals "
        "wrong by more than 1°, % |\n|---|---|---|---|---|---|");
    for (const bool inside : {false, true}) {
        compare_boxes("0.1, 0.1, 0.1", {0.1, 0.1, 0.1}, 0.005, inside);
        compare_boxes("0.4, 0.1, 0.1", {0.4, 0.1, 0.1}, 0.005, inside);
        compare_boxes("0.5, 0.02, 0.3", {0.5, 0.02, 0.3}, 0.005, inside);
    }
    if (argc != 2) return 0;
    const Body body = read_body(argv[1]);
    const auto field = build_distance_field(body.mesh.positions, body.mesh.triangles, {});
    if (!field) {
        std::fprintf(stderr, "%s: %s\n", argv[1], field.errors().front().message().c_str());
        return 1;
    }
    WorkerTeam team;
    const Exact exact(body, team);
    compare_grids(body, exact, *field);
    compare_balls(body, exact, *field);
}
