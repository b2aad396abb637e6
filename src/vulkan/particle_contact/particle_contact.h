// Contact of cloth with itself and with other cloths by particles, on the device (law:
// physics/particle_contact/particle_contact.md). The lists outlive frames.
#pragma once

#include "gpu/commands.h"
#include "solver/plan/world_plan.h"
#include "solver/state/cloth_contact_counts.h"
#include "vulkan/arena.h"
#include "vulkan/cloth_state.h"
#include "vulkan/particle_contact/args.data.h"
#include "vulkan/programs.h"
#include "vulkan/seams.h"

#include <memory>
#include <span>
#include <string>

namespace weft::vulkan {

class ParticleContact {
  public:
    /// A cloth of the frame, with the addresses of its frame inputs and its report.
    struct Member {
        const ClothState* cloth = nullptr;
        std::uint64_t frame = 0, report = 0;
        const Seams* seams = nullptr;  ///< of its island; needed during create() only; null if there are none
    };

    /// `members`: all cloths of the frame. Those without contact between cloths do not take part. The list has room for
    /// `capacity` pairs, or for more if `first_capacity` (StepInput::list_capacity) asks for it. `records_marks`: see
    /// StepInput::contact_marks.
    static Result<std::unique_ptr<ParticleContact>> create(gpu::Device& device, Programs& programs,
                                                           std::span<const Member> members, std::uint32_t capacity,
                                                           std::uint32_t first_capacity, bool search_always,
                                                           bool records_marks, const std::string& name);

    /// Records a pass of contact between particles, for all cloths.
    Result<void> record(gpu::Commands& commands, const Pass& pass, std::uint32_t substep) const;
    /// Call at the end of a frame. Copies the counts and the marks back.
    void record_end(gpu::Commands& commands) const;

    /// Pairs.
    std::uint32_t capacity() const { return capacity_; }
    // Of the last finished frame:
    /// Pairs, including those that the list had no room for.
    std::uint32_t wanted() const { return counted().wanted; }
    ClothContactCounts counts() const;
    /// Adds the bits (ContactMark) of the particles from `base` on, which must be those of one cloth with contact
    /// between particles. None unless they were recorded.
    void add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const;

  private:
    ParticleContact(gpu::Device& device, Programs& programs) : device_(device), programs_(programs) {}
    Result<void> build(std::span<const Member> members, std::uint32_t first_capacity, bool search_always,
                       bool records_marks, const std::string& name);
    const SphereHead& counted() const { return back_.as<SphereHead>()[0]; }

    gpu::Device& device_;
    Programs& programs_;
    std::uint32_t tiles_ = 0, capacity_ = 0;
    Arena arena_, data_arena_;
    Slot head_, data_, pushes_;
    gpu::Buffer back_, pushes_back_;
};

}  // namespace weft::vulkan
