// Contacts of bodies with one another and with colliders.
#pragma once

#include "solver/state/body_kernels.h"
#include "solver/world/backend.h"

#include <weft/bounds.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

/// A body during a frame.
struct BodyInStep {
    std::uint32_t collider = 0;
    const Collider* of = nullptr;
    scalar::BodyMotion motion;
    scalar::BodyInertia inertia;
    float inverse_mass = 0;
    float radius = 0;       ///< m: of a ball around the center of mass that holds the shape
    float ball_radius = 0;  ///< ball_radius() of the collider
    Pose found;             ///< Bodies::found()
    Pose placed;            ///< Bodies::placed()
    Pose now, before;       ///< in the substep, and at its start
    scalar::vec3 v, rate;   ///< m/s and rad/s at the start of the substep, before contact
    Mat3 inverse_inertia;   ///< in world axes, at the start of the contacts of the substep
    float contacts = 0;     ///< of cloth, that share the body in this substep
};

/// Computes BodyInStep::now from the motion.
void place(BodyInStep& body);
/// Computes BodyInStep::inverse_inertia from `now`. Once a substep is enough: it only weighs contacts, and a body turns
/// little in a substep.
void turn_inertia(BodyInStep& body);
/// push_body() for a substep of h s.
void push(BodyInStep& body, const scalar::BodyPush& by, float h);
/// shift_body() likewise.
void shift(BodyInStep& body, const scalar::BodyPush& by, float h);

/// Pairs are searched once per frame, and again when a body leaves its box. Contacts are found in every substep, where
/// the bodies are then. No result depends on which pairs are listed besides those that touch.
class BodyContacts {
  public:
    /// Begins a frame. `bodies` must stay where they are.
    void begin_frame(const StepInput& input, std::span<BodyInStep> bodies, std::span<const std::uint32_t> body_of,
                     float h);
    /// `reach`: where each body is expected in the rest of the frame.
    void find_pairs(std::span<const Bounds> reach);
    /// Finds the contacts of a substep, after the bodies have been predicted. They begin with what they gave in the
    /// substep of the frame before.
    void find_contacts(std::uint32_t substep);
    bool empty() const { return rows_.empty(); }
    /// One sweep over the contacts, one after another.
    void project();
    /// Likewise for the velocities at the end of a substep.
    void bounce();
    /// Likewise for overlap from before the substep, after that.
    void lift();

  private:
    /// A body whose features meet the shape of a collider, body or not; or the other way around.
    struct Pair {
        std::uint32_t features, shape;  ///< colliders
        friend auto operator<=>(const Pair&, const Pair&) = default;
    };
    struct Row {
        std::uint32_t a, b;   ///< colliders
        std::uint32_t place;  ///< number of the place on the features where it may touch
        scalar::BodyTouch touch;
    };
    bool acts(const Row& row) const;
    float slow() const;
    /// m: how far the sides of a row are apart.
    float gap_of(const Row& row) const;
    scalar::BodySide side_of(std::uint32_t collider) const;
    /// The same with the velocities of now.
    scalar::BodySide side_now(std::uint32_t collider) const;
    BodyInStep* body_of(std::uint32_t collider) const;
    template <class Apply>
    void apply(const Row& row, scalar::vec3 touched, scalar::vec3 impulse, Apply&& to);
    void find_contacts(const Pair& pair);
    void go_on();

    const StepInput* input_ = nullptr;
    std::span<BodyInStep> bodies_;
    std::span<const std::uint32_t> body_of_;  ///< by collider
    scalar::Step step_{};
    std::uint32_t substep_ = 0;
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> found_;
    std::vector<Row> rows_, before_;  ///< of the substep, and of the one before it in the frame
};

}  // namespace weft::cpu
