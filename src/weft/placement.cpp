#include "weft/placement.h"

#include <algorithm>
#include <cmath>
#include <map>

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

void place_mesh(TriangleMesh& mesh, const MeshDesc& from, const TransformDesc& transform) {
    Mat3 turn;
    float scale = transform.scale;
    if (const auto* file = std::get_if<MeshFileDesc>(&from)) {
        turn = upright(file->up);
        scale *= file->scale;
    }
    turn = rotation_from_degrees(transform.rotation_degrees) * turn;
    for (Vec3& p : mesh.positions) p = turn * (p * scale) + transform.position;
    for (Vec3& n : mesh.normals) n = turn * n;
}

Result<Pinned> select_pins(const ClothDesc& cloth, const TriangleMesh& mesh, const Topology& topology,
                           std::span<const Collider> colliders, const std::string& pointer) {
    Pinned pinned;
    Errors errors;
    std::map<std::uint32_t, std::uint32_t> mover_of;  // particle -> mover, or `none`
    for (std::size_t i = 0; i < cloth.pins.size(); ++i) {
        const PinDesc& pin = cloth.pins[i];
        PinSelector selector(mesh, topology);
        const std::string where = pointer + "/pins/" + std::to_string(i);
        const Errors found = std::visit([&](const auto& pins) { return selector.select(pins, where); }, pin.select);
        errors.insert(errors.end(), found.begin(), found.end());

        std::uint32_t mover = none;
        if (!pin.attach.empty() || !pin.motion.empty()) {
            mover = static_cast<std::uint32_t>(pinned.holds.movers.size());
            const auto collider = std::ranges::find(colliders, pin.attach, &Collider::name);
            const bool attached = !pin.attach.empty() && collider != colliders.end();
            pinned.holds.movers.push_back(
                {attached ? static_cast<std::uint32_t>(collider - colliders.begin()) : none, pin.motion});
        }
        for (std::uint32_t particle : selector.chosen) mover_of[particle] = mover;
    }
    if (!errors.empty()) return errors;
    for (const auto& [particle, mover] : mover_of) {
        pinned.particles.push_back(particle);
        if (mover == none) continue;
        const std::uint32_t collider = pinned.holds.movers[mover].collider;
        const Vec3 at_rest = topology.rest_positions[particle];
        const Vec3 local = collider == none ? at_rest : to_local(colliders[collider].pose, at_rest);
        pinned.holds.particles.push_back({particle, mover, local});
    }
    return pinned;
}

}  // namespace weft
