// Contacts of a frame, as recorded by backends, and their conversion to the public ContactForces.
#pragma once

#include "solver/model/cloth_model.h"

#include <weft/contact_forces.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace weft {

/// One contact, in the layout that a device writes.
struct ContactRecord {
    Vec3 point;  ///< m, position of the particle at the end of the frame
    std::uint32_t particle = 0;
    Vec3 impulse;  ///< N·s, on the collider
    std::uint32_t collider = 0;
};
static_assert(sizeof(ContactRecord) == 32);

/// Sum of the impulses of a cloth on a collider, in the fixed-point units of contact_forces.kernel.h. 64-bit sums wrap.
struct ImpulseSum {
    std::array<std::uint64_t, 3> linear{}, angular{};
    std::uint64_t contacts = 0;

    void add(const ImpulseSum& other);
};

/// Contacts of a cloth in one frame.
struct ClothContactLog {
    /// Sorted by collider, then by particle. They point into the backend, and are valid until the step after the next
    /// one begins, or the cloth, its model or its plan changes.
    std::span<const ContactRecord> contacts;
    std::vector<ImpulseSum> sums;  ///< per collider; complete even if `contacts` is not (report_contacts_full)

    void clear();
};

/// Contacts of all cloths in a frame, as input of resolve().
struct ContactLog {
    struct Cloth {
        ClothId id;
        std::shared_ptr<const ClothModel> model;
        ClothContactLog contact_forces;
    };
    std::uint64_t frame = 0;
    double dt = 0;  ///< s
    std::vector<ColliderId> colliders;
    std::vector<Cloth> cloths;
};

/// Converts the contacts of a frame to SI units and ids. `vertices` is scratch.
void resolve(const ContactLog& from, ContactForces& to, std::vector<std::uint32_t>& vertices);

}  // namespace weft
