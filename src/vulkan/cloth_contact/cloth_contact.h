// Contact of cloth with itself and with other cloths on the device (law: physics/cloth_contact/cloth_contact.md). The
// device searches for pairs when it must, within the recorded commands of a frame. The lists outlive frames.
#pragma once

#include "collide/tangle.h"
#include "gpu/commands.h"
#include "solver/plan/world_plan.h"
#include "solver/state/cloth_contact_counts.h"
#include "vulkan/arena.h"
#include "vulkan/cloth_contact/args.data.h"
#include "vulkan/cloth_state.h"
#include "vulkan/programs.h"
#include "vulkan/seams.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace weft::vulkan {

/// Numbers of elements that the lists have room for.
struct ClothContactRoom {
    std::uint32_t tile_pairs = 0, listed = 0, near = 0;
    std::uint32_t tangled = 0, tangle_near = 0;  ///< both are 0 while nothing is tangled

    /// The room to begin with, for cloths of these sizes. `list_capacity`: see StepInput.
    static ClothContactRoom for_cloths(std::uint64_t tiles, std::uint64_t particles, std::uint32_t list_capacity);
    /// The larger of both, by element.
    ClothContactRoom with(const ClothContactRoom& other) const;
    /// Room after a frame that needed `wanted`, if that was too much.
    ClothContactRoom grown(const ClothContactRoom& wanted) const;
    /// The same room otherwise, for this tangle; null: for none.
    ClothContactRoom for_tangle(const Tangle* tangle) const;
    bool holds(const Tangle* tangle) const {
        if (!tangle) return tangled == 0;
        return tangle->pairs.size() <= tangled && tangle->near.size() <= tangle_near;
    }
    bool holds(const ClothContactRoom& wanted) const {
        return wanted.tile_pairs <= tile_pairs && wanted.listed <= listed && wanted.near <= near;
    }
};

class ClothContact {
  public:
    /// A cloth of the frame, with the addresses of its frame inputs and its report.
    struct Member {
        const ClothState* cloth = nullptr;
        std::uint64_t frame = 0, report = 0;
        std::uint64_t poses = 0;       ///< of a surface that moves; else 0
        const Seams* seams = nullptr;  ///< of its island; needed during create() only; null if there are none
    };

    /// `members`: all cloths of the frame. Those without contact between cloths do not take part.
    /// `records_marks`: see StepInput::contact_marks.
    static Result<std::unique_ptr<ClothContact>> create(gpu::Device& device, Programs& programs,
                                                        std::span<const Member> members, const ClothContactRoom& room,
                                                        std::uint32_t list_capacity, bool search_always,
                                                        bool records_marks, const std::string& name);

    /// Call before a frame is submitted. The room must hold the tangle.
    void set_tangle(const Tangle* tangle);
    /// Call at the start of a frame. Uploads the tangle.
    void record_begin(gpu::Commands& commands) const;
    /// Records a pass of contact between cloths, for all cloths.
    Result<void> record(gpu::Commands& commands, const Pass& pass, std::uint32_t substep) const;
    /// Call at the end of a frame. Copies the counts and the marks back.
    Result<void> record_end(gpu::Commands& commands) const;

    const ClothContactRoom& room() const { return room_; }
    // Of the last finished frame:
    /// Including elements that the lists had no room for.
    ClothContactRoom wanted() const;
    ClothContactCounts counts() const;
    /// Adds the bits (ContactMark) of the particles from `base` on, which must be those of one cloth with contact
    /// between cloths. None unless they were recorded.
    void add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const;

  private:
    ClothContact(gpu::Device& device, Programs& programs) : device_(device), programs_(programs) {}
    /// Buffers for the counts and, if they are recorded, the marks.
    Result<void> make_readback(const std::string& name);
    Result<void> make_tangle(ContactData& data, std::uint64_t particles, const std::string& name);
    Result<void> build(std::span<const Member> members, std::uint32_t list_capacity, bool search_always,
                       bool records_marks, const std::string& name);

    gpu::Device& device_;
    Programs& programs_;
    ClothContactRoom room_;
    std::uint32_t tiles_ = 0, groups_ = 0;
    Arena arena_, data_arena_;
    Slot head_, data_, marks_;
    gpu::Buffer back_, marks_back_;
    // The tangle of a frame: its number of pairs, the pairs, `first` and `near`.
    gpu::Buffer tangle_upload_, tangle_;
    std::uint64_t tangle_first_ = 0, tangle_near_ = 0;  // offsets
};

}  // namespace weft::vulkan
