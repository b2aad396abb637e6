#include "io/exports/export_format.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Tolerance of a normal's squared length around 1: ten times the rounding error of a float normalization, a hundredth
// of the error limit of the glTF validator.
constexpr float unit_tolerance = 1e-5f;

std::string problem_of(const ExportSurface& surface) {
    const std::size_t count = surface.positions.size();
    if (surface.triangles.empty()) return "has no triangles";
    if (surface.normals.size() != count) {
        return "has " + std::to_string(count) + " positions but " + std::to_string(surface.normals.size()) + " normals";
    }
    if (!surface.rest_positions.empty() && surface.rest_positions.size() != count)
        return "does not have one rest position per vertex";
    if (!surface.uvs.empty() && surface.uvs.size() != count) return "does not have one UV per vertex";
    if (!surface.colors.empty() && surface.colors.size() != count) return "does not have one color per vertex";
    for (std::size_t i = 0; i < count; ++i) {
        if (!finite(surface.positions[i])) return "has a position that is not finite at vertex " + std::to_string(i);
    }
    for (const Triangle& triangle : surface.triangles) {
        const std::uint32_t highest = std::ranges::max(triangle);
        if (highest >= count) {
            return "has a triangle on vertex " + std::to_string(highest) + " of " + std::to_string(count);
        }
    }
    return {};
}

std::string problem_of(const ExportSolid& solid, bool is_first) {
    const Pose& pose = solid.pose;
    const Mat3& turn = pose.rotation;
    if (!finite(pose.position) || !finite(turn.x) || !finite(turn.y) || !finite(turn.z))
        return "has a pose that is not finite";
    if (!is_first) return {};
    if (!solid.mesh) return "has no mesh";
    return problem_of(surface_of(solid.name, *solid.mesh, solid.mesh->positions, solid.mesh->normals));
}

}  // namespace

Result<void> check_frame(const ExportFrame& frame, const std::string& where) {
    if (frame.surfaces.empty()) return Error{where, "there is no cloth to write"};
    for (const ExportSurface& surface : frame.surfaces) {
        const std::string problem = problem_of(surface);
        if (problem.empty()) continue;
        return Error{
            where, "frame " + std::to_string(frame.index) + ": cloth \"" + std::string(surface.name) + "\" " + problem};
    }
    return {};
}

Result<void> check_solids(const ExportFrame& frame, bool is_first, const std::string& where) {
    for (const ExportSolid& solid : frame.solids) {
        const std::string problem = problem_of(solid, is_first);
        if (problem.empty()) continue;
        return Error{where, "frame " + std::to_string(frame.index) + ": collider \"" + std::string(solid.name) + "\" " +
                                problem};
    }
    return {};
}

Result<void> check_writable(const std::filesystem::path& path) {
    const Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return file.errors();
    return {};
}

Vec3 unit_normal(Vec3 normal) {
    const float squared = dot(normal, normal);
    if (std::abs(squared - 1) <= unit_tolerance) return normal;
    const Vec3 scaled = normalized(normal);
    const float remaining = dot(scaled, scaled);  // not 1 for zero, denormal and non-finite input
    return std::abs(remaining - 1) <= unit_tolerance ? scaled : Vec3{0, 1, 0};
}

}  // namespace weft
