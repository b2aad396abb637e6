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
    explicit PinSelector(const PinnedCloth& cloth)
        : mesh_(cloth.mesh),
          numbers_(cloth.numbers),
          rest_(cloth.rest_positions),
          positions_(cloth.positions),
          copied_from_(cloth.copied_from) {}

    Vec3 place(std::uint32_t p) const { return positions_.empty() ? rest_[p] : positions_[p].xyz(); }

    Errors select(const VertexPins& pins, const std::string& where) {
        const auto& particle = numbers_.of_welded;
        Errors errors;
        for (std::size_t i = 0; i < pins.vertices.size(); ++i) {
            const std::uint32_t vertex = pins.vertices[i];
            const auto problem = [&](const std::string& what) {
                errors.push_back({where + (pins.group.empty() ? "/vertices/" + std::to_string(i) : "/group"), what});
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
        add_copies();
        return errors;
    }

    Errors select(const BoxPins& pins, const std::string& where) {
        const std::size_t before = chosen.size();
        const auto count = numbers_.particle_count + static_cast<std::uint32_t>(copied_from_.size());
        for (std::uint32_t p = 0; p < count; ++p) {
            if (pins.box.contains(place(p))) chosen.push_back(p);
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
            if (matches && numbers_.of_vertex[v] != none) chosen.push_back(numbers_.of_vertex[v]);
        }
        if (chosen.size() == before) return {{where + "/color", "no vertex has such a color"}};
        add_copies();
        return {};
    }

    std::vector<std::uint32_t> chosen;

  private:
    void add_copies() {
        std::vector<bool> selected(numbers_.particle_count + copied_from_.size());
        for (const std::uint32_t p : chosen) selected[p] = true;
        for (std::size_t i = 0; i < copied_from_.size(); ++i) {
            if (!selected[copied_from_[i]]) continue;
            selected[numbers_.particle_count + i] = true;
            chosen.push_back(numbers_.particle_count + static_cast<std::uint32_t>(i));
        }
    }

    const TriangleMesh& mesh_;
    const ParticleNumbers& numbers_;
    std::span<const Vec3> rest_;
    std::span<const Vec4> positions_;
    std::span<const std::uint32_t> copied_from_;
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

namespace {

// How a particle is pinned: motion of its target (`none`: it does not move) and compliance in m/N.
struct PinOf {
    std::uint32_t motion = none;
    float compliance = 0;
};

}  // namespace

ColliderId find_collider(const World& world, std::string_view name) {
    const auto& all = world.colliders();
    const auto found = std::ranges::find(all, name, &Collider::name);
    return found == all.end() ? ColliderId{} : world.collider_id(static_cast<std::size_t>(found - all.begin()));
}

Result<std::vector<std::uint32_t>> select_particles(const std::variant<VertexPins, BoxPins, ColorPins>& select,
                                                    const PinnedCloth& cloth, const std::string& pointer) {
    PinSelector selector(cloth);
    if (Errors errors = std::visit([&](const auto& one) { return selector.select(one, pointer); }, select);
        !errors.empty())
        return errors;
    return std::move(selector.chosen);
}

Result<Pinned> select_pins(const std::vector<PinDesc>& pins, const PinnedCloth& cloth, const World& world,
                           const std::string& pointer) {
    Pinned pinned;
    Errors errors;
    std::map<std::uint32_t, PinOf> pin_of;  // by particle
    for (std::size_t i = 0; i < pins.size(); ++i) {
        const PinDesc& pin = pins[i];
        PinSelector selector(cloth);
        const std::string where = pointer + '/' + std::to_string(i);
        const Errors found = std::visit([&](const auto& select) { return selector.select(select, where); }, pin.select);
        errors.insert(errors.end(), found.begin(), found.end());

        PinOf held_by{.motion = none, .compliance = pin.compliance};
        if (!pin.attach.empty() || !pin.motion.empty()) {
            held_by.motion = static_cast<std::uint32_t>(pinned.targets.motions.size());
            pinned.targets.motions.push_back(
                {pin.attach.empty() ? ColliderId{} : find_collider(world, pin.attach), pin.motion});
        }
        for (std::uint32_t particle : selector.chosen) pin_of[particle] = held_by;
    }
    if (!errors.empty()) return errors;

    const PinSelector places(cloth);
    std::vector<KinematicTarget> anchors;
    for (const auto& [particle, held_by] : pin_of) {
        const Vec3 place = places.place(particle);
        std::uint32_t point = particle;
        if (held_by.compliance > 0) {
            point = cloth.numbers.first_anchor + static_cast<std::uint32_t>(pinned.pins.attachments.size());
            pinned.pins.attachments.push_back({particle, held_by.compliance, place});
        } else {
            pinned.pins.particles.push_back(particle);
        }
        if (held_by.motion == none) continue;
        const TargetMotion& motion = pinned.targets.motions[held_by.motion];
        const Vec3 local = motion.collider ? to_local(world.collider(motion.collider).pose, place)
                                           : place - offset_at(motion.offsets, cloth.time);
        (point == particle ? pinned.targets.particles : anchors).push_back({point, held_by.motion, local});
    }
    pinned.targets.particles.insert(pinned.targets.particles.end(), anchors.begin(), anchors.end());
    return pinned;
}

}  // namespace weft
