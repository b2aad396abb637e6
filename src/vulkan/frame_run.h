// The frame of some cloths as one command buffer, recorded once and submitted every frame.
#pragma once

#include "gpu/commands.h"
#include "vulkan/cloth.h"
#include "vulkan/command_lists.h"
#include "vulkan/dispatches.h"
#include "vulkan/feedback/contact_readback.h"
#include "vulkan/frame_input.h"
#include "vulkan/lists/adhesion_list.h"

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
    streamed,  ///< a dispatch per pass, for all cloths
    grouped,   ///< the same, but one for as many passes as are together on coarse levels of few nodes
    fused,     ///< one for the whole frame, a workgroup to a cloth
};

/// Whether a workgroup can have all of the cloth at hand.
bool fits_fused(const gpu::Device& device, const ClothModel& model);

class FrameRun {
  public:
    struct Member {
        Cloth* cloth = nullptr;
        InputShape shape;
        PlainStiffness stiffness{};
        std::uint32_t island = 0;           ///< of the members of a run, those of one island follow one another
        const LinkTables* links = nullptr;  ///< of the island; valid while the run is made
    };

    /// `execution` is not automatic, and not fused where the plan has dynamic lists. `serial`: that of the plan
    /// (WorldStep), which is kept as a copy. `list_capacity`: rows of dynamic lists.
    static Result<std::unique_ptr<FrameRun>> create(gpu::Device& device, Programs& programs, const WorldPlan& plan,
                                                    std::uint64_t serial, std::span<const Member> members,
                                                    Execution execution, bool timings, std::uint32_t list_capacity);

    bool is_for(std::uint64_t serial, std::span<const Member> members, Execution execution) const {
        const auto same = [](const Member& a, const Member& b) {
            return a.cloth == b.cloth && a.shape == b.shape && a.island == b.island;
        };
        return serial == serial_ && execution == execution_ && std::ranges::equal(members, members_, same);
    }
    bool has(const Cloth* cloth) const { return std::ranges::find(members_, cloth, &Member::cloth) != members_.end(); }

    /// A step for each member. The device may still be at work when this returns. `again`: the same frame once more, of
    /// which a list was full.
    Result<std::uint64_t> submit(const StepInput& input, std::span<const ClothStep* const> steps, bool again = false);
    /// Of the frame that the device is done with: the rows that the list had room for, or none without a list. Where
    /// there were more, the state is as it was before the frame.
    const AdhesionList* adhesion() const { return adhesion_.get(); }
    bool list_was_full() const { return adhesion_ && adhesion_->wanted() > adhesion_->capacity(); }
    /// When the device is done with it.
    void finish(std::array<double, stage_count>& stage_ms);
    /// What is not finite in one cloth is reported of all cloths of its island.
    std::uint32_t report(std::size_t member) const;
    /// What contacts did to colliders, if its shape asks for it: see ContactReadback::read.
    std::uint32_t read_feedback(std::size_t member, ClothFeedback& to);
    /// After a frame in which the cloth was not finite: what did it. The state is that before the frame, before and
    /// after.
    Result<std::string> find_non_finite(std::size_t member, const StepInput& input, const ClothStep& step);

  private:
    struct Place {
        std::vector<Vec4> positions, velocities;
    };

    FrameRun(gpu::Device& device, Programs& programs, const WorldPlan& plan, std::uint64_t serial,
             std::span<const Member> members, Execution execution);
    Result<Done> compile_members();
    Result<Done> make_lists(std::uint32_t capacity);
    Result<Done> prepare_feedback();
    Result<Done> record_fused(bool timings);
    Result<Done> record_passes(bool timings);
    std::size_t first_of_island(std::size_t member) const;
    Result<Done> begin_recording(bool timings, std::size_t stages);
    Result<Done> end_recording();
    Result<Place> download_place(const Cloth& cloth) const;
    Result<std::string> replay(std::size_t member);
    Result<Done> run(const Command& command, std::uint32_t substep, std::size_t member);
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
    std::vector<std::uint32_t> first_command_;  ///< in it, by member
    std::unique_ptr<AdhesionList> adhesion_;    ///< none where nothing sticks
    CommandLists lists_;
    Dispatches dispatches_;
    std::optional<gpu::Commands> commands_;
    std::vector<std::uint32_t> stages_;          ///< between one stamp and the next
    std::unique_ptr<ContactReadback> contacts_;  ///< none without feedback
    std::vector<double> seconds_;                ///< lambda_seconds of the frame that runs, by member
};

}  // namespace weft::vulkan
