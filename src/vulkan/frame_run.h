// The frame of several cloths as one command buffer, recorded once and submitted every frame.
#pragma once

#include "gpu/commands.h"
#include "vulkan/bodies/bodies.h"
#include "vulkan/cloth.h"
#include "vulkan/cloth_contact/cloth_contact.h"
#include "vulkan/command_lists.h"
#include "vulkan/contact_forces/contact_readback.h"
#include "vulkan/dispatches.h"
#include "vulkan/frame_input.h"
#include "vulkan/lists/adhesion_list.h"
#include "vulkan/particle_contact/particle_contact.h"
#include "vulkan/tear/tearing.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

/// How passes become dispatches.
enum class Execution {
    automatic,
    streamed,  ///< one dispatch per pass for all cloths
    grouped,   ///< the same, but one dispatch for consecutive passes on coarse levels with few nodes
    fused,     ///< one dispatch for the whole frame, one workgroup per cloth
};

/// Whether a workgroup can keep all particles of the cloth in shared memory.
bool fits_fused(const gpu::Device& device, const ClothModel& model);

class FrameRun {
  public:
    struct Member {
        Cloth* cloth = nullptr;
        InputShape shape;
        PlainStiffness stiffness{};
        std::uint32_t island = 0;           ///< members of one island are consecutive
        const LinkTables* links = nullptr;  ///< if it is the first of stitched cloths; needed during create() only
        const Seams* seams = nullptr;       ///< likewise
    };

    /// Sizes of lists that are found on the device, and the colliders that they are about.
    struct Lists {
        std::uint64_t colliders = 0;       ///< address of the world's colliders
        std::uint32_t first_capacity = 0;  ///< StepInput::list_capacity
        std::uint32_t adhesion = 0;        ///< constraints
        ClothContactRoom cloth_contact{};
        std::uint32_t particle_pairs = 0;
        Bodies* bodies = nullptr;    ///< of the world; null if there are none
        bool search_always = false;  ///< see VulkanOptions
        bool records_marks = false;  ///< StepInput::contact_marks
    };

    /// `execution` must not be automatic, and not fused if the plan has dynamic lists or contact between cloths. Keeps
    /// a copy of the plan. `serial`: that of the plan (WorldStep).
    static Result<std::unique_ptr<FrameRun>> create(gpu::Device& device, Programs& programs, const WorldPlan& plan,
                                                    std::uint64_t serial, std::span<const Member> members,
                                                    Execution execution, bool timings, const Lists& lists);

    /// Whether it was recorded for such a frame. `tangle`: see StepInput.
    bool is_for(std::uint64_t serial, std::span<const Member> members, Execution execution,
                const Tangle* tangle) const {
        if (cloth_contact_ && !cloth_contact_->room().holds(tangle)) return false;
        if (bodies_ && bodies_->serial() != bodies_serial_) return false;
        const auto same = [](const Member& a, const Member& b) {
            return a.cloth == b.cloth && a.shape == b.shape && a.island == b.island;
        };
        return serial == serial_ && execution == execution_ && std::ranges::equal(members, members_, same);
    }
    bool has(const Cloth* cloth) const { return std::ranges::find(members_, cloth, &Member::cloth) != members_.end(); }

    /// Submits a step for each member and returns without waiting for the device. `again`: repeats a frame of which a
    /// list was full.
    Result<std::uint64_t> submit(const StepInput& input, std::span<const ClothStep* const> steps, bool again = false);
    /// The adhesion list of the last finished frame; null without a list. If the list was full, the state is the one
    /// before the frame.
    const AdhesionList* adhesion() const { return adhesion_.get(); }
    /// Likewise for contact between cloths.
    const ClothContact* cloth_contact() const { return cloth_contact_.get(); }
    const ParticleContact* particle_contact() const { return particle_contact_.get(); }
    const Tearing* tearing() const { return tearing_.get(); }
    Bodies* bodies() const { return bodies_; }
    /// Whether a cloth had too few slots for its lists of near colliders in the last finished frame. Then the state is
    /// undefined until roll_back_and_grow().
    bool near_list_was_full() const;
    /// Restores all cloths to the start of the last frame, and gives those whose lists were full more slots, which the
    /// next run that is recorded has.
    Result<void> roll_back_and_grow();
    bool list_was_full() const {
        return near_list_was_full() || (adhesion_ && adhesion_->wanted() > adhesion_->capacity()) ||
               (particle_contact_ && particle_contact_->wanted() > particle_contact_->capacity()) ||
               (bodies_ && bodies_->list_was_full()) ||
               (cloth_contact_ && !cloth_contact_->room().holds(cloth_contact_->wanted()));
    }
    /// Call when the device has finished the frame. Adds the stages' times to `stage_ms`.
    void finish(std::array<double, stage_count>& stage_ms);
    /// Reports of the member. A non-finite number in one cloth is reported for all cloths of its island.
    std::uint32_t report(std::size_t member) const;
    /// ClothStep::pulls of the member.
    void read_pulls(std::size_t member, std::span<Vec4> pulls) const { buffers_.read_pulls(member, pulls); }
    /// Contacts of the member if InputShape::contact_forces is set: see ContactReadback::read.
    std::uint32_t read_contact_forces(std::size_t member, ClothContactLog& to);
    /// Adds the bits (ContactMark) of a cloth of the last finished frame.
    void add_contact_marks(const Cloth& cloth, std::span<std::uint32_t> marks) const;
    /// Call after a frame in which the cloth was not finite. Returns the cause. Expects the state from before the frame
    /// and leaves it unchanged.
    Result<std::string> find_non_finite(std::size_t member, const StepInput& input, const ClothStep& step);

  private:
    struct Place {
        std::vector<Vec4> positions, velocities;
    };

    FrameRun(gpu::Device& device, Programs& programs, const WorldPlan& plan, std::uint64_t serial,
             std::span<const Member> members, Execution execution);
    Result<void> compile_members(const Lists& lists);
    Result<void> make_lists(const Lists& lists);
    Result<void> make_adhesion(const Lists& lists);
    Result<void> make_cloth_contact(const Lists& lists);
    Result<void> make_particle_contact(const Lists& lists);
    Result<void> make_bodies(const Lists& lists);
    Result<void> make_tearing();
    Result<void> record_for_all(gpu::Commands& commands, const Pass& pass, std::uint32_t substep,
                                std::uint32_t member = none) const;
    Result<void> prepare_contact_forces();
    Result<void> record_fused(bool timings);
    Result<void> record_passes(bool timings);
    Result<void> record_passes(const SharedPlan& shared, std::span<const std::uint32_t> lists);
    std::size_t first_of_island(std::size_t member) const;
    /// `record`: Result<void>(). Called twice if pipelines must be compiled, which happens between the calls.
    template <class Record>
    Result<void> record_frame(bool timings, std::size_t stages, Record&& record);
    Result<void> begin_recording(bool timings, std::size_t stages);
    Result<void> end_recording();
    Result<Place> download_place(const Cloth& cloth) const;
    Result<std::string> replay(std::size_t member);
    Result<void> run(const Command& command, std::uint32_t substep, std::size_t member);
    const std::string& name() const { return members_.front().cloth->model().name; }

    gpu::Device& device_;
    Programs& programs_;
    WorldPlan plan_;
    std::uint64_t serial_;
    std::vector<Member> members_;
    Execution execution_;
    FrameBuffers buffers_;
    std::vector<WorkBuffers> work_;
    std::vector<LinkBuffers> links_;
    std::vector<CompiledPlan> plans_;
    CommandMemory memory_;
    std::vector<std::uint32_t> first_command_;           ///< number in `memory_`, by member
    std::unique_ptr<AdhesionList> adhesion_;             ///< null if nothing sticks
    std::unique_ptr<ClothContact> cloth_contact_;        ///< null if no cloth collides exactly
    std::unique_ptr<ParticleContact> particle_contact_;  ///< null if no cloth collides by particles
    std::unique_ptr<Tearing> tearing_;                   ///< null if no cloth tears
    Bodies* bodies_ = nullptr;                           ///< of the world; null if there are none
    std::uint64_t bodies_serial_ = 0;                    ///< at which the commands were recorded
    std::uint64_t colliders_ = 0;                        ///< address of the world's colliders
    CommandLists lists_;
    Dispatches dispatches_;
    std::optional<gpu::Commands> commands_;
    std::vector<std::uint32_t> stages_;          ///< stage between each stamp and the next
    std::unique_ptr<ContactReadback> contacts_;  ///< null without contact forces
    std::vector<double> seconds_;                ///< lambda_seconds() of the submitted frame, by member
};

}  // namespace weft::vulkan
