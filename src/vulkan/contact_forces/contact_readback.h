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
        AccountIn account;  ///< without what create() sets: sums, first_slot, first_pair
        std::uint32_t colliders = 0;
        std::uint32_t slots = 0;  ///< of the lists of near colliders
    };

    static Result<std::unique_ptr<ContactReadback>> create(gpu::Device& device, Programs& programs,
                                                           std::span<const Member> members, const std::string& name);

    /// Call before each frame. Makes room for its contacts.
    Result<void> prepare();
    /// Call after the submission of the frame's own commands.
    Result<std::uint64_t> submit() { return ring_[turn_].commands->submit(); }
    /// Reads the last frame, which the device must have finished. `to` stays valid until the second call of prepare()
    /// from here. Returns flags to report. Members must be read in their order.
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
    Result<void> record(gpu::Commands& commands, const Slot& slot) const;
    /// Bytes of a slot before its list.
    std::uint64_t head_bytes() const;
    std::span<const std::uint32_t> sums_of(std::size_t member, std::uint32_t collider) const;
    std::uint64_t contacts_of(std::size_t member) const;

    gpu::Device& device_;
    Programs& programs_;
    std::vector<Member> members_;
    std::string name_;
    std::uint32_t pair_count_ = 0;  ///< pairs of a cloth and a collider
    std::uint32_t slot_count_ = 0, packet_count_ = 0;
    std::uint32_t key_bits_ = 0;
    Arena arena_;
    vulkan::Slot accounts_, packets_, keys_, flags_, scratch_, sort_places_, sort_sums_, sums_;
    std::vector<std::uint64_t> counts_;  ///< contacts of each member in the last frame
    std::uint32_t wanted_ = 0;           ///< contacts that a list should have room for
    std::array<Slot, 2> ring_;
    std::uint32_t turn_ = 0;
};

}  // namespace weft::vulkan
