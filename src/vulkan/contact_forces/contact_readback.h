// Contacts of the cloths of one frame. The device adds them up and lists them; the host reads them later.
#pragma once

#include "gpu/commands.h"
#include "solver/state/contact_forces.h"
#include "vulkan/arena.h"
#include "vulkan/contact_forces/args.data.h"
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
        AccountIn account;  ///< without the address of its sums
        std::uint32_t colliders = 0;
    };

    static Result<std::unique_ptr<ContactReadback>> create(gpu::Device& device, Programs& programs,
                                                           std::span<const Member> members, const std::string& name);

    /// Call before each frame. Makes room for its contacts.
    Result<void> prepare();
    /// Call after the submission of the frame's own commands.
    Result<std::uint64_t> submit() { return ring_[turn_].commands->submit(); }
    /// Reads the last frame, which the device must have finished. `to` stays valid until the second call of prepare()
    /// from here. Returns flags to report.
    std::uint32_t read(std::size_t member, ClothContactLog& to);

  private:
    // The device writes one slot while the host still reads the other.
    struct Slot {
        gpu::Buffer back;
        std::optional<gpu::Commands> commands;
        std::uint32_t room = 0;  ///< contacts in its list
    };

    ContactReadback(gpu::Device& device, Programs& programs, std::span<const Member> members, std::string name)
        : device_(device), programs_(programs), members_(members.begin(), members.end()), name_(std::move(name)) {}
    Result<void> make_arrays();
    Result<Slot> make_slot() const;
    /// Bytes of a slot before its list.
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
