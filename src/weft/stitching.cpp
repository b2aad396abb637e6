#include "weft/stitching.h"

namespace weft {
namespace {

class EndReader {
  public:
    EndReader(const SewnCloth& cloth, std::string pointer) : cloth_(cloth), pointer_(std::move(pointer)) {}

    std::vector<StitchPoint> read(const StitchEnd& end) {
        std::vector<StitchPoint> points;
        for (std::size_t i = 0; i < end.vertices.size(); ++i)
            points.push_back(at_vertex(end.vertices[i], "/vertices/" + std::to_string(i)));
        for (std::size_t i = 0; i < end.points.size(); ++i)
            points.push_back(in_triangle(end.points[i], "/points/" + std::to_string(i)));
        return points;
    }
    Errors errors;

  private:
    StitchPoint at_vertex(std::uint32_t vertex, const std::string& where) {
        const auto& particle = cloth_.source.numbers->of_welded;
        if (vertex >= particle.size()) {
            fail(where, "must be a vertex of the mesh, 0 to " + std::to_string(particle.size() - 1) + ", got " +
                            std::to_string(vertex));
        } else if (particle[vertex] == none) {
            fail(where, "vertex " + std::to_string(vertex) + " belongs to no triangle and is not simulated");
        } else {
            return {.particles = {particle[vertex], 0, 0}};
        }
        return {};
    }

    StitchPoint in_triangle(const MeshPoint& point, const std::string& where) {
        const auto& triangles = simulated_mesh(cloth_.model, cloth_.source).triangles;
        if (point.triangle >= triangles.size()) {
            fail(where + "/triangle", "must be a triangle of the mesh, 0 to " + std::to_string(triangles.size() - 1) +
                                          ", got " + std::to_string(point.triangle));
            return {};
        }
        StitchPoint result;
        // The sum is 1 up to rounding in the file.
        const float sum = point.weights.x + point.weights.y + point.weights.z;
        result.shares = {point.weights.x / sum, point.weights.y / sum, point.weights.z / sum};
        for (std::size_t k = 0; k < 3; ++k) {
            result.particles[k] = cloth_.source.numbers->of_vertex[triangles[point.triangle][k]];
            if (result.particles[k] != none) continue;
            fail(where + "/triangle", "triangle " + std::to_string(point.triangle) + " is not simulated");
            return {};
        }
        return result;
    }

    void fail(const std::string& where, std::string what) { errors.push_back({pointer_ + where, std::move(what)}); }

    const SewnCloth& cloth_;
    std::string pointer_;
};

}  // namespace

Result<std::vector<Stitch>> make_stitches(const StitchDesc& row, const SewnCloth& a, const SewnCloth& b,
                                          const std::string& pointer) {
    EndReader first(a, pointer + "/a"), second(b, pointer + "/b");
    const auto from = first.read(row.a), to = second.read(row.b);
    Errors errors = std::move(first.errors);
    errors.insert(errors.end(), second.errors.begin(), second.errors.end());
    if (!errors.empty()) return errors;
    std::vector<Stitch> stitches;
    for (std::size_t i = 0; i < from.size(); ++i)
        stitches.push_back({a.id, b.id, from[i], to[i], row.gap, row.compliance});
    return stitches;
}

}  // namespace weft
