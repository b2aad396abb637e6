#include "vulkan/contact_forces/contact_readback.h"

#include "solver/state/frame.h"
#include "vulkan/primitives/scan.h"

#include <algorithm>
#include <cstddef>

namespace weft::vulkan {
namespace {

constexpr std::uint64_t word = sizeof(std::uint32_t);

// Initial capacity of a list. Every particle often touches one collider, but all of them hardly ever touch three. The
// list grows if it is too short.
constexpr std::uint64_t contacts_per_particle = 2, least_room = 256;

// Sizes of the GLSL layout.
static_assert(sizeof(AccountIn) == 56 && sizeof(PacketIn) == 16 && sizeof(ContactListArgs) == 40);
static_assert(sizeof(ContactRecord) == WEFT_RECORD_WORDS * word && offsetof(ContactRecord, particle) == 3 * word &&
              offsetof(ContactRecord, impulse) == 4 * word && offsetof(ContactRecord, collider) == 7 * word);

}  // namespace

Result<std::unique_ptr<ContactReadback>> ContactReadback::create(gpu::Device& device, Programs& programs,
                                                                 std::span<const Member> members,
                                                                 const std::string& name) {
    auto self = std::unique_ptr<ContactReadback>(new ContactReadback(device, programs, members, name));
    if (auto made = self->make_arrays(); !made) return made.errors();
    return self;
}

Result<void> ContactReadback::make_arrays() {
    std::vector<PacketIn> packets;
    std::uint64_t elements = 0, points = 0;
    for (const Member& member : members_) {
        elements += std::uint64_t{member.colliders} * groups_of(member.account.particles, WEFT_GROUP) * WEFT_GROUP;
        points += member.account.particles;
    }
    if (elements > most_elements) return too_many(elements, "pairs of particles and colliders, for contact_forces");
    packets.reserve(elements / WEFT_GROUP);
    for (std::uint32_t m = 0; m < members_.size(); ++m) {
        first_sum_.push_back(sum_count_);
        sum_count_ += members_[m].colliders;
        for (std::uint32_t c = 0; c < members_[m].colliders; ++c) {
            for (std::uint32_t p = 0; p < members_[m].account.particles; p += WEFT_GROUP)
                packets.push_back({.cloth = m, .collider = c, .first = p, .unused = 0});
        }
    }
    packet_count_ = static_cast<std::uint32_t>(packets.size());
    wanted_ = static_cast<std::uint32_t>(std::max<std::uint64_t>(contacts_per_particle * points, least_room));

    accounts_ = arena_.reserve(members_.size() * sizeof(AccountIn));
    packets_ = arena_.add_array(packets);
    flags_ = arena_.reserve(elements * word);
    scratch_ = arena_.reserve(scan_scratch(static_cast<std::uint32_t>(elements)));
    sums_ = arena_.reserve(std::uint64_t{sum_count_} * WEFT_SUM_WORDS * word);
    if (auto built = arena_.build(device_, "contacts of " + name_); !built) return built;
    std::vector<AccountIn> accounts;
    for (std::size_t m = 0; m < members_.size(); ++m) {
        accounts.push_back(members_[m].account);
        accounts.back().sums = arena_.address(sums_) + first_sum_[m] * WEFT_SUM_WORDS * word;
    }
    return upload(device_, arena_, accounts_, std::as_bytes(std::span(accounts)));
}

std::uint64_t ContactReadback::head_bytes() const {
    return std::uint64_t{sum_count_} * WEFT_SUM_WORDS * word;
}

Result<ContactReadback::Slot> ContactReadback::make_slot() const {
    Slot slot;
    slot.room = wanted_;
    auto back = device_.memory().buffer(head_bytes() + std::uint64_t{slot.room} * sizeof(ContactRecord),
                                        gpu::MemoryKind::readback, "contacts of " + name_ + ", on their way");
    if (!back) return back.errors();
    slot.back = std::move(*back);
    auto commands = gpu::Commands::create(device_);
    if (!commands) return commands.errors();
    if (auto begun = commands->begin(); !begun) return begun.errors();
    commands->fill(arena_.buffer(), 0, sums_.bytes, sums_.offset);
    Recorder passes(device_, programs_, *commands);
    const ContactListArgs args{.accounts = arena_.address(accounts_),
                               .packets = arena_.address(packets_),
                               .flags = arena_.address(flags_),
                               .contacts = slot.back.address() + head_bytes(),
                               .count = packet_count_,
                               .room = slot.room};
    passes.run("count_contacts", args, packet_count_);
    record_scan(passes, args.flags, args.flags, packet_count_ * WEFT_GROUP, arena_.address(scratch_), true);
    passes.run("list_contacts", args, packet_count_);
    if (auto recorded = passes.end(); !recorded) return recorded.errors();
    commands->barrier();
    commands->copy(arena_.buffer(), slot.back, sums_.bytes, sums_.offset, 0);
    commands->host_barrier();
    if (auto ended = commands->end(); !ended) return ended.errors();
    slot.commands = std::move(*commands);
    return slot;
}

Result<void> ContactReadback::prepare() {
    turn_ ^= 1;
    Slot& slot = ring_[turn_];
    if (slot.room < wanted_) {
        auto made = make_slot();
        // Without memory for a longer list, the shorter one stays in use and is reported as full.
        if (!made && !slot.commands) return made.errors();
        if (made) slot = std::move(*made);
    }
    return {};
}

std::span<const std::uint32_t> ContactReadback::sums_of(std::size_t member, std::uint32_t collider) const {
    const std::size_t at = std::size_t{first_sum_[member] + collider} * WEFT_SUM_WORDS;
    return std::span<const std::uint32_t>(ring_[turn_].back.as<std::uint32_t>()).subspan(at, WEFT_SUM_WORDS);
}

std::uint32_t ContactReadback::read(std::size_t member, ClothContactLog& to) {
    std::uint64_t before = 0, mine = 0, all = 0;
    for (std::size_t m = 0; m < members_.size(); ++m) {
        for (std::uint32_t c = 0; c < members_[m].colliders; ++c) {
            const std::uint32_t contacts = sums_of(m, c)[WEFT_SUM_CONTACTS];
            all += contacts;
            (m < member ? before : mine) += m <= member ? contacts : 0;
        }
    }
    to.sums.assign(members_[member].colliders, {});
    for (std::uint32_t c = 0; c < members_[member].colliders; ++c) {
        const auto words = sums_of(member, c);
        const auto sum = [&](std::uint32_t at) { return words[at] | std::uint64_t{words[at + 1]} << 32; };
        to.sums[c] = {{sum(0), sum(2), sum(4)}, {sum(6), sum(8), sum(10)}, words[WEFT_SUM_CONTACTS]};
    }
    const Slot& slot = ring_[turn_];
    const std::uint64_t end = std::min<std::uint64_t>(before + mine, slot.room), begin = std::min(before, end);
    const auto* list = reinterpret_cast<const ContactRecord*>(slot.back.mapped().data() + head_bytes());
    to.contacts = std::span(list + begin, list + end);
    // The next list gets room for half as many again.
    if (all > slot.room)
        wanted_ = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(all + all / 2, std::uint64_t{packet_count_} * WEFT_GROUP));
    return before + mine > slot.room && mine > 0 ? report_contacts_full : report_none;
}

}  // namespace weft::vulkan
