// What a frame's contacts did, as backends leave it and as a world hands it out.
#pragma once

#include "solver/model/cloth_model.h"

#include <weft/feedback.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace weft {

/// As a device writes it.
struct ContactRecord {
    Vec3 point;  ///< m, the particle's place at the end of the frame
    std::uint32_t particle = 0;
    Vec3 impulse;  ///< N·s, on the collider
    std::uint32_t collider = 0;
};
static_assert(sizeof(ContactRecord) == 32);

/// What a cloth did to a collider, in the quanta of feedback.kernel.h. Sums of 64 bits go round.
struct ImpulseSum {
    std::array<std::uint64_t, 3> linear{}, angular{};
    std::uint64_t contacts = 0;

    void add(const ImpulseSum& other);
};

/// Of a cloth, in one frame.
struct ClothFeedback {
    /// Collider by collider, and of each by particle. They lie with the backend, until the step after the next one
    /// begins, or the cloth, its model or its plan changes.
    std::span<const ContactRecord> contacts;
    std::vector<ImpulseSum> sums;  ///< per collider; complete where `contacts` is not (report_contacts_full)

    void clear();
};

/// Of a frame, not yet made out.
struct FrameFeedback {
    struct Cloth {
        ClothId id;
        std::shared_ptr<const ClothModel> model;
        ClothFeedback feedback;
    };
    std::uint64_t frame = 0;
    double dt = 0;  ///< s
    std::vector<ColliderId> colliders;
    std::vector<Cloth> cloths;
};

/// `vertices` is scratch.
void make_out(const FrameFeedback& from, Feedback& to, std::vector<std::uint32_t>& vertices);

}  // namespace weft
