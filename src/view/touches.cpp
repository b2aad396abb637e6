#include "view/touches.h"

#include "mesh/grouping.h"
#include "solver/plan/frame_numbers.h"
#include "solver/world/collider_solid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <utility>

namespace weft {
namespace {

// What touches comes to rest at its distance from the surface, up to what later pushes change: half a thickness for
// particles, nearest_of_faces() for triangles. Limits between them, in half thicknesses of the place.
constexpr double farthest_particle = 1.25, farthest_face = 0.75;

/// The contacts of one cloth.
class ClothTouches {
  public:
    ClothTouches(const ClothFrame& cloth, std::vector<Touch>& touches)
        : cloth_(cloth),
          touches_(touches),
          by_place_(cloth.positions.size()),
          faces_(group_items<std::uint32_t>(static_cast<std::uint32_t>(cloth.positions.size()),
                                            [&](auto put) {
                                                for (std::uint32_t t = 0; t < cloth.triangles.size(); ++t)
                                                    for (const std::uint32_t corner : cloth.triangles[t])
                                                        put(corner, t);
                                            })),
          touch_of_face_(cloth.triangles.size(), not_looked_at) {
        for (std::uint32_t p = 0; p < by_place_.size(); ++p) by_place_[p] = p;
        std::ranges::sort(by_place_, [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    }

    /// `contacts`: with this collider.
    void add(std::span<const Contact> contacts, const Collider& collider) {
        const bool faces = faces_touch(*cloth_.model, collider);
        for (const Contact& contact : contacts) {
            const std::uint32_t particle = faces ? particle_at(contact.point) : none;
            const std::vector<std::size_t> of_faces =
                particle == none ? std::vector<std::size_t>{} : faces_touching(particle, collider);
            if (of_faces.empty() || touches_itself(particle, contact.point, collider)) {
                touches_.push_back({contact.point, -contact.impulse});
                continue;
            }
            const float share = 1 / static_cast<float>(of_faces.size());
            for (const std::size_t touch : of_faces) touches_[touch].impulse -= contact.impulse * share;
        }
        for (const std::uint32_t face : looked_at_) touch_of_face_[face] = not_looked_at;
        looked_at_.clear();
    }

  private:
    static constexpr std::size_t not_looked_at = ~std::size_t{0}, is_apart = not_looked_at - 1;

    // Bits, which can be sorted even if the position is not finite.
    static std::array<std::uint32_t, 3> bits_of(Vec3 p) {
        return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                std::bit_cast<std::uint32_t>(p.z)};
    }
    std::array<std::uint32_t, 3> place(std::uint32_t particle) const {
        return bits_of(cloth_.positions[particle].xyz());
    }
    std::uint32_t particle_at(Vec3 point) const {
        const auto wanted = bits_of(point);
        const auto found = std::ranges::lower_bound(by_place_, wanted, {}, [&](std::uint32_t p) { return place(p); });
        return found != by_place_.end() && place(*found) == wanted ? *found : none;
    }
    double half_thickness(std::uint32_t particle) const {
        const ClothModel& model = *cloth_.model;
        const float factor = model.thickness_factors.empty() ? 1 : model.thickness_factors[particle];
        return 0.5 * double{model.fabric.contact.thickness * factor};
    }
    bool touches_itself(std::uint32_t particle, Vec3 point, const Collider& collider) const {
        return signed_distance(collider, point) < farthest_particle * half_thickness(particle);
    }

    /// Numbers of the touches of the faces around a particle. Adds those that are new.
    std::vector<std::size_t> faces_touching(std::uint32_t particle, const Collider& collider) {
        std::vector<std::size_t> touching;
        for (std::uint32_t i = faces_.offsets[particle]; i < faces_.offsets[particle + 1]; ++i) {
            const std::uint32_t face = faces_.items[i];
            std::size_t& touch = touch_of_face_[face];
            if (touch == not_looked_at) {
                looked_at_.push_back(face);
                touch = is_apart;
                if (const auto point = touching_point(face, collider)) {
                    touch = touches_.size();
                    touches_.push_back({*point, {}, true});
                }
            }
            if (touch != is_apart) touching.push_back(touch);
        }
        return touching;
    }

    std::optional<Vec3> touching_point(std::uint32_t face, const Collider& collider) const {
        const auto [a, b, c] = cloth_.triangles[face];
        const auto corner = [&](std::uint32_t p) { return cloth_.positions[p].xyz(); };
        const auto local = [&](std::uint32_t p) { return reference::to_double(to_local(collider.pose, corner(p))); };
        const reference::Solid solid = solid_of(collider);
        const reference::Corners x{local(a), local(b), local(c)};
        const double thinnest = std::min({half_thickness(a), half_thickness(b), half_thickness(c)});
        const double enough = farthest_face * thinnest;
        const auto least = least_on_face(solid, x, face_point(solid, x, reference::center_weights()), enough);
        const auto& w = least.weights;
        if (!(least.distance < enough) || !is_beside_corners(w)) return std::nullopt;
        return corner(a) * static_cast<float>(w.x) + corner(b) * static_cast<float>(w.y) +
               corner(c) * static_cast<float>(w.z);
    }

    const ClothFrame& cloth_;
    std::vector<Touch>& touches_;
    std::vector<std::uint32_t> by_place_;     // particles, sorted by position
    Groups<std::uint32_t> faces_;             // of each particle
    std::vector<std::size_t> touch_of_face_;  // with the present collider
    std::vector<std::uint32_t> looked_at_;    // faces
};

}  // namespace

bool has_contacts_of(const WorldFrame& world, const Frame& frame) {
    const ContactForces& forces = world.contact_forces();
    return forces.frame > 0 && forces.frame == frame.index;
}

std::vector<Touch> touches_of(const WorldFrame& world, const Frame& frame) {
    std::vector<Touch> touches;
    if (!has_contacts_of(world, frame)) return touches;
    const std::span<const Contact> contacts = world.contact_forces().contacts;
    // Sorted by cloth, then by collider.
    const auto run = [&](std::size_t begin, auto member) {
        std::size_t end = begin;
        while (end < contacts.size() && contacts[end].*member == contacts[begin].*member &&
               contacts[end].cloth == contacts[begin].cloth)
            ++end;
        return contacts.subspan(begin, end - begin);
    };
    for (std::size_t at = 0; at < contacts.size();) {
        const auto of_cloth = run(at, &Contact::cloth);
        const auto cloth = std::ranges::find(frame.cloths, of_cloth.front().cloth, &ClothFrame::id);
        if (cloth != frame.cloths.end()) {
            ClothTouches found(*cloth, touches);
            for (std::size_t i = at; i < at + of_cloth.size();) {
                const auto of_collider = run(i, &Contact::collider);
                const ColliderId id = of_collider.front().collider;
                if (world.contains(id)) found.add(of_collider, world.collider(id));
                i += of_collider.size();
            }
        }
        at += of_cloth.size();
    }
    return touches;
}

}  // namespace weft
