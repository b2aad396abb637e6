#include "solver/state/contact_forces.h"

#include "physics/scalar.h"

namespace weft {
namespace {

Vec3 in_units(const std::array<std::uint64_t, 3>& quanta) {
    const auto axis = [&](int k) {
        return static_cast<float>(static_cast<double>(static_cast<std::int64_t>(quanta[k])) /
                                  WEFT_IMPULSE_QUANTA_PER_UNIT);
    };
    return {axis(0), axis(1), axis(2)};
}

// Finds the first vertex of the render mesh for each particle.
void first_vertices(const ClothModel& model, std::vector<std::uint32_t>& vertices) {
    vertices.assign(model.particle_count, Contact::no_vertex);
    for (auto v = static_cast<std::uint32_t>(model.vertex_to_particle.size()); v-- > 0;) {
        if (const std::uint32_t particle = model.vertex_to_particle[v]; particle != none) vertices[particle] = v;
    }
}

}  // namespace

void ImpulseSum::add(const ImpulseSum& other) {
    for (int axis = 0; axis < 3; ++axis) {
        linear[axis] += other.linear[axis];
        angular[axis] += other.angular[axis];
    }
    contacts += other.contacts;
}

void ClothContactLog::clear() {
    contacts = {};
    for (ImpulseSum& sum : sums) sum = {};
}

void resolve(const ContactLog& from, ContactForces& to, std::vector<std::uint32_t>& vertices) {
    to.frame = from.frame;
    to.contacts.clear();
    to.colliders.resize(from.colliders.size());
    const auto inv_dt = static_cast<float>(1 / from.dt);
    for (std::size_t c = 0; c < from.colliders.size(); ++c) {
        ImpulseSum all;
        for (const ContactLog::Cloth& cloth : from.cloths)
            if (c < cloth.contact_forces.sums.size()) all.add(cloth.contact_forces.sums[c]);
        ColliderForce& load = to.colliders[c];
        load.collider = from.colliders[c];
        load.impulse = in_units(all.linear);
        load.angular_impulse = in_units(all.angular);
        load.force = load.impulse * inv_dt;
        load.torque = load.angular_impulse * inv_dt;
        load.contacts = static_cast<std::uint32_t>(all.contacts);
    }
    for (const ContactLog::Cloth& cloth : from.cloths) {
        if (cloth.contact_forces.contacts.empty()) continue;
        first_vertices(*cloth.model, vertices);
        for (const ContactRecord& record : cloth.contact_forces.contacts) {
            to.contacts.push_back({.cloth = cloth.id,
                                   .collider = from.colliders[record.collider],
                                   .vertex = vertices[record.particle],
                                   .point = record.point,
                                   .impulse = record.impulse});
        }
    }
}

}  // namespace weft
