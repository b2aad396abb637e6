// What runs a StepPlan: the CPU with its lanes and threads, a GPU with its passes.
#pragma once

#include "base/hash.h"
#include "solver/collider.h"
#include "solver/frame.h"
#include "solver/holds.h"

#include <memory>
#include <span>
#include <string>

namespace weft {

struct ClothId {
    std::uint32_t value = 0;  ///< 0 is none
    friend bool operator==(ClothId, ClothId) = default;
};

struct StepInput {
    double dt = 0;  ///< s, > 0: length of the frame
    Vec3 gravity;   ///< m/s²
    std::span<const Collider> colliders;
    /// Where each collider is at the start of the frame and after every substep: [substep · colliders + collider],
    /// substeps + 1 times.
    std::span<const Pose> poses;
    std::span<const HeldParticle> held = {};
    /// Likewise for what carries the held particles: [substep · movers + mover].
    std::span<const Pose> mover_poses = {};
    std::uint32_t movers = 0;
};

/// What the solver left of stretch, its material set aside: |C + α̃λ| / rest length over the rows.
struct Residual {
    double mean = 0, max = 0;
};

class Backend {
  public:
    virtual ~Backend() = default;

    virtual std::string_view name() const = 0;  ///< as on the command line
    virtual std::string device() const = 0;     ///< for a human
    virtual unsigned threads() const = 0;

    virtual ClothId add_cloth(std::shared_ptr<const ClothModel> model) = 0;
    /// Advances one cloth by a frame.
    virtual void step(ClothId cloth, const StepPlan& plan, const StepInput& input, ClothFrame& frame,
                      std::array<double, stage_count>& stage_ms) = 0;
    /// The cloth as it is.
    virtual void read(ClothId cloth, ClothFrame& frame) const = 0;
    /// Of the last substep.
    virtual Residual stretch_residual(ClothId cloth) const = 0;
    /// Adds everything that decides what the cloth does next.
    virtual void hash(ClothId cloth, StateHash& hash) const = 0;
};

}  // namespace weft
