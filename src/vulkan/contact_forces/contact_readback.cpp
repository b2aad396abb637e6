#include "vulkan/contact_forces/contact_readback.h"

#include "solver/state/frame.h"
#include "vulkan/primitives/radix_sort.h"
#include "vulkan/primitives/scan.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace weft::vulkan {
namespace {

constexpr std::uint64_t word = sizeof(std::uint32_t);

// Initial capacity of a list. Every particle often touches one collider, but all of them hardly ever touch three. The
// list grows if it is too short.
constexpr std::uint64_t contacts_per_particle = 2, least_room = 256;

// Sizes of the GLSL layout.
static_assert(sizeof(AccountIn) == 80 && sizeof(PacketIn) == 8 && sizeof(ContactListArgs) == 72);
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
    std::uint64_t slots = 0, points = 0, pairs = 0;
    std::uint32_t most_tiles = 0;
    for (std::uint32_t m = 0; m < members_.size(); ++m) {
        AccountIn& account = members_[m].account;
        account.first_slot = static_cast<std::uint32_t>(slots);
        account.first_pair = static_cast<std::uint32_t>(pairs);
        slots += members_[m].slots;
        pairs += members_[m].colliders;
        points += account.particles;
        most_tiles = std::max(most_tiles, account.tile_count);
        for (std::uint32_t tile = 0; tile < account.tile_count; tile += WEFT_GROUP) packets.push_back({m, tile});
    }
    const std::uint64_t places = slots * WEFT_COLLIDER_TILE;
    if (places > most_elements) return too_many(places, "pairs of particles and near colliders, for contact_forces");
    if (pairs >= most_elements) return too_many(pairs, "pairs of cloths and colliders, for contact_forces");
    slot_count_ = static_cast<std::uint32_t>(slots);
    pair_count_ = static_cast<std::uint32_t>(pairs);
    packet_count_ = static_cast<std::uint32_t>(packets.size());
    key_bits_ = bits_below(std::max(pair_count_ + 1, most_tiles));
    wanted_ = static_cast<std::uint32_t>(std::max<std::uint64_t>(contacts_per_particle * points, least_room));

    const SortScratch sort = sort_scratch(slot_count_);
    accounts_ = arena_.reserve(members_.size() * sizeof(AccountIn));
    packets_ = arena_.add_array(packets);
    keys_ = arena_.reserve(6 * slots * word);
    flags_ = arena_.reserve(places * word);
    scratch_ = arena_.reserve(scan_scratch(static_cast<std::uint32_t>(places)));
    sort_places_ = arena_.reserve(sort.places);
    sort_sums_ = arena_.reserve(sort.sums);
    sums_ = arena_.reserve(pairs * WEFT_SUM_WORDS * word);
    if (auto built = arena_.build(device_, "contacts of " + name_); !built) return built;
    std::vector<AccountIn> accounts;
    for (Member& member : members_) {
        member.account.sums = arena_.address(sums_) + std::uint64_t{member.account.first_pair} * WEFT_SUM_WORDS * word;
        accounts.push_back(member.account);
    }
    return upload(device_, arena_, accounts_, std::as_bytes(std::span(accounts)));
}

std::uint64_t ContactReadback::head_bytes() const {
    return std::uint64_t{pair_count_} * WEFT_SUM_WORDS * word;
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
    if (auto recorded = record(*commands, slot); !recorded) return recorded.errors();
    if (auto ended = commands->end(); !ended) return ended.errors();
    slot.commands = std::move(*commands);
    return slot;
}

Result<void> ContactReadback::record(gpu::Commands& commands, const Slot& slot) const {
    const std::uint64_t words = std::uint64_t{slot_count_} * word, keys = arena_.address(keys_);
    const auto arrays = [&](std::uint64_t at) { return KeyArrays{at, at + words, at + 2 * words}; };
    commands.fill(arena_.buffer(), 0, sums_.bytes, sums_.offset);
    // Slots that no list uses have the largest key and no number.
    const std::uint32_t last_key = static_cast<std::uint32_t>((std::uint64_t{1} << key_bits_) - 1);
    commands.fill(arena_.buffer(), last_key, words, keys_.offset);
    commands.fill(arena_.buffer(), 0, words, keys_.offset + words);
    commands.fill(arena_.buffer(), ~0u, words, keys_.offset + 2 * words);
    Recorder passes(device_, programs_, commands);
    const auto args = [&](const KeyArrays& sorted) {
        return ContactListArgs{.accounts = arena_.address(accounts_),
                               .packets = arena_.address(packets_),
                               .pairs = sorted.high,
                               .tiles = sorted.low,
                               .slots = sorted.value,
                               .flags = arena_.address(flags_),
                               .contacts = slot.back.address() + head_bytes(),
                               .cloths = static_cast<std::uint32_t>(members_.size()),
                               .packet_count = packet_count_,
                               .slot_count = slot_count_,
                               .room = slot.room};
    };
    passes.run("key_contacts", args(arrays(keys)), packet_count_);
    const ContactListArgs sorted =
        args(record_sort(passes, arrays(keys), arrays(keys + 3 * words), slot_count_, key_bits_,
                         {arena_.address(sort_places_), arena_.address(sort_sums_)}));
    const std::uint32_t places = slot_count_ * WEFT_COLLIDER_TILE, groups = groups_of(places, WEFT_GROUP);
    passes.run("count_contacts", sorted, groups);
    record_scan(passes, sorted.flags, sorted.flags, places, arena_.address(scratch_), true);
    passes.run("list_contacts", sorted, groups);
    if (auto recorded = passes.end(); !recorded) return recorded;
    commands.barrier();
    commands.copy(arena_.buffer(), slot.back, sums_.bytes, sums_.offset, 0);
    commands.host_barrier();
    return {};
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
    const std::size_t at = std::size_t{members_[member].account.first_pair + collider} * WEFT_SUM_WORDS;
    return std::span<const std::uint32_t>(ring_[turn_].back.as<std::uint32_t>()).subspan(at, WEFT_SUM_WORDS);
}

std::uint64_t ContactReadback::contacts_of(std::size_t member) const {
    std::uint64_t contacts = 0;
    for (std::uint32_t c = 0; c < members_[member].colliders; ++c) contacts += sums_of(member, c)[WEFT_SUM_CONTACTS];
    return contacts;
}

std::uint32_t ContactReadback::read(std::size_t member, ClothContactLog& to) {
    if (member == 0) {
        counts_.clear();
        for (std::size_t m = 0; m < members_.size(); ++m) counts_.push_back(contacts_of(m));
    }
    const auto before =
        std::accumulate(counts_.begin(), counts_.begin() + static_cast<std::ptrdiff_t>(member), std::uint64_t{0});
    const std::uint64_t mine = counts_[member], all = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
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
            std::min<std::uint64_t>(all + all / 2, std::uint64_t{slot_count_} * WEFT_COLLIDER_TILE));
    return before + mine > slot.room && mine > 0 ? report_contacts_full : report_none;
}

}  // namespace weft::vulkan
