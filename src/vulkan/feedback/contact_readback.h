// Contacts of the cloths that a frame takes together: added up and listed on the device, read by the host later.
#pragma once

#include "gpu/commands.h"
#include "solver/state/feedback.h"
#include "vulkan/arena.h"
#include "vulkan/feedback/args.data.h"
#include "vulkan/programs.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

class ContactReadback {
  public:
    struct Member {
        AccountIn account;  ///< but for where its sums lie
        std::uint32_t colliders = 0;
    };

    static Result<std::unique_ptr<ContactReadback>> create(gpu::Device& device, Programs& programs,
                                                           std::span<const Member> members, const std::string& name);

    /// Before each frame: room for what comes of it.
    Result<Done> prepare();
    /// After the frame's own commands.
    Result<std::uint64_t> submit() { return ring_[turn_].commands->submit(); }
    /// Of the last one, when the device is done with it. What `to` shows stays until the prepare() after the next.
    /// Returns what is to be reported.
    std::uint32_t read(std::size_t member, ClothFeedback& to);

  private:
    // One is written by the device while the host still reads the other.
    struct Slot {
        gpu::Buffer back;
        std::optional<gpu::Commands> commands;
        std::uint32_t room = 0;  ///< contacts in its list
    };

    ContactReadback(gpu::Device& device, Programs& programs, std::span<const Member> members, std::string name)
        : device_(device), programs_(programs), members_(members.begin(), members.end()), name_(std::move(name)) {}
    Result<Done> make_arrays();
    Result<Slot> make_slot() const;
    /// Bytes of a slot in front of its list.
    std::uint64_t head_bytes() const;
    std::span<const std::uint32_t> sums_of(std::size_t member, std::uint32_t collider) const;

    gpu::Device& device_;
    Programs& programs_;
    std::vector<Member> members_;
    std::string name_;
    std::vector<std::uint32_t> first_sum_;  ///< of each member
    std::uint32_t sum_count_ = 0;           ///< pairs of a cloth and a collider
    std::uint32_t packet_count_ = 0;
    Arena arena_;
    vulkan::Slot accounts_, packets_, flags_, scratch_, sums_;
    std::uint32_t wanted_ = 0;  ///< contacts that a list should have room for
    std::array<Slot, 2> ring_;
    std::uint32_t turn_ = 0;
};

}  // namespace weft::vulkan
