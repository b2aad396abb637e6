#include "weft/placement.h"

#include <cmath>

namespace weft {
namespace {

Mat3 upright(UpAxis up) {
    switch (up) {
        case UpAxis::x:
            return rotation_from_degrees({0, 0, 90});
        case UpAxis::y:
            return {};
        case UpAxis::z:
            return rotation_from_degrees({-90, 0, 0});
    }
    return {};
}

class PinSelector {
  public:
    PinSelector(const TriangleMesh& mesh, const Topology& topology) : mesh_(mesh), topology_(topology) {}

    Errors select(const VertexPins& pins, const std::string& where) {
        const auto& particle = topology_.welded_to_particle;
        Errors errors;
        for (std::size_t i = 0; i < pins.vertices.size(); ++i) {
            const std::uint32_t vertex = pins.vertices[i];
            const auto problem = [&](const std::string& what) {
                errors.push_back({where + "/vertices/" + std::to_string(i), what});
            };
            if (vertex >= particle.size()) {
                problem("must be a vertex of the mesh, 0 to " + std::to_string(particle.size() - 1) + ", got " +
                        std::to_string(vertex));
            } else if (particle[vertex] == none) {
                problem("vertex " + std::to_string(vertex) + " belongs to no triangle and is not simulated");
            } else {
                chosen.push_back(particle[vertex]);
            }
        }
        return errors;
    }

    Errors select(const BoxPins& pins, const std::string& where) {
        const std::size_t before = chosen.size();
        for (std::uint32_t p = 0; p < topology_.particle_count; ++p) {
            if (pins.box.contains(topology_.rest_positions[p])) chosen.push_back(p);
        }
        if (chosen.size() == before) return {{where + "/box", "no vertex lies in it"}};
        return {};
    }

    Errors select(const ColorPins& pins, const std::string& where) {
        if (mesh_.colors.empty()) return {{where + "/color", "the mesh has no vertex colors"}};
        const std::size_t before = chosen.size();
        const auto near = [&](float a, float b) { return std::abs(a - b) <= pins.threshold; };
        for (std::size_t v = 0; v < mesh_.colors.size(); ++v) {
            const Vec4 c = mesh_.colors[v];
            const bool matches = near(c.x, pins.color.x) && near(c.y, pins.color.y) && near(c.z, pins.color.z);
            if (matches && topology_.vertex_to_particle[v] != none) chosen.push_back(topology_.vertex_to_particle[v]);
        }
        if (chosen.size() == before) return {{where + "/color", "no vertex has such a color"}};
        return {};
    }

    std::vector<std::uint32_t> chosen;

  private:
    const TriangleMesh& mesh_;
    const Topology& topology_;
};

}  // namespace

void place_mesh(TriangleMesh& mesh, const ClothDesc& cloth) {
    Mat3 turn;
    float scale = cloth.transform.scale;
    if (const auto* file = std::get_if<MeshFileDesc>(&cloth.mesh)) {
        turn = upright(file->up);
        scale *= file->scale;
    }
    turn = rotation_from_degrees(cloth.transform.rotation_degrees) * turn;
    for (Vec3& p : mesh.positions) p = turn * (p * scale) + cloth.transform.position;
    for (Vec3& n : mesh.normals) n = turn * n;
}

Result<std::vector<std::uint32_t>> select_pins(const ClothDesc& cloth, const TriangleMesh& mesh,
                                               const Topology& topology, const std::string& pointer) {
    PinSelector selector(mesh, topology);
    Errors errors;
    for (std::size_t i = 0; i < cloth.pins.size(); ++i) {
        const std::string where = pointer + "/pins/" + std::to_string(i);
        const Errors found =
            std::visit([&](const auto& pins) { return selector.select(pins, where); }, cloth.pins[i].select);
        errors.insert(errors.end(), found.begin(), found.end());
    }
    if (!errors.empty()) return errors;
    return std::move(selector.chosen);
}

}  // namespace weft
