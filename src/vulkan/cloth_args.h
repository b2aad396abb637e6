// Addresses and arguments that the commands of a cloth have in common.
#pragma once

#include "vulkan/args.data.h"
#include "vulkan/compiled_plan.h"

namespace weft::vulkan {

class ClothArgs {
  protected:
    ClothArgs(const ClothState& cloth, const WorkBuffers& work, const FrameInput& input, const InputShape& shape,
              const WorldPlan& plan, const PlainStiffness& stiffness, const IslandPart& island)
        : cloth_(cloth),
          model_(cloth.model()),
          buffers_(cloth.buffers()),
          work_(work),
          input_(input),
          shape_(shape),
          plan_(plan),
          stiffness_(stiffness),
          island_(island) {}

    std::uint64_t state(Slot slot) const { return cloth_.address(slot); }
    std::uint64_t state(PointArray array) const { return cloth_.address(array); }
    std::uint64_t of_model(Slot slot) const { return buffers_.address(slot); }
    std::uint64_t work(Slot slot) const { return work_.arena.address(slot); }

    ParticleArgs particle_args() const;
    KeepArgs keep_args() const;
    SteadyArgs steady_args() const;
    TautArgs taut_args() const;
    CoupleArgs couple_args(ConstraintKind kind) const;
    LimitArgs limit_args() const;
    FaceArgs face_args() const;
    AroundArgs around_args() const;
    std::uint64_t lambda_of(ConstraintKind kind) const;
    std::uint64_t remainder() const;  ///< ParticleArgs
    std::uint64_t remainder_of_level(std::uint32_t level) const;
    std::uint64_t shifts_of(ConstraintKind kind) const;
    std::uint32_t use_of_lambda(const Pass& pass, std::uint32_t substep) const;
    RowArgs row_args(ConstraintKind kind) const;
    /// Sets the batch's range of constraints and returns the number of invocations.
    static std::uint32_t hand_out(RowArgs& args, const Batch& batch, std::uint64_t blocks);

    const ClothState& cloth_;
    const ClothModel& model_;
    const ModelBuffers& buffers_;
    const WorkBuffers& work_;
    const FrameInput& input_;
    const InputShape& shape_;
    const WorldPlan& plan_;
    const PlainStiffness& stiffness_;
    const IslandPart& island_;
};

}  // namespace weft::vulkan
