#include "cpu/contact_account.h"

#include "base/flush_subnormals.h"
#include "physics/scalar.h"

namespace weft::cpu {
namespace {

using Quanta = std::array<float, 3>;

Quanta quanta_of(const Vec4& v, float factor) {
    return {scalar::to_impulse_quanta(v.x * factor), scalar::to_impulse_quanta(v.y * factor),
            scalar::to_impulse_quanta(v.z * factor)};
}

// Quanta are integers below 2^63 (WEFT_LARGEST_IMPULSE).
void add(std::array<std::uint64_t, 3>& sum, const Quanta& quanta) {
    for (int axis = 0; axis < 3; ++axis)
        sum[axis] += static_cast<std::uint64_t>(static_cast<std::int64_t>(quanta[axis]));
}

}  // namespace

void ContactAccount::prepare(std::size_t colliders, std::size_t capacity, unsigned workers) {
    if (colliders * capacity != moved_.size()) {
        moved_ = AlignedVector<Vec4>(colliders * capacity);
        turned_ = AlignedVector<Vec4>(colliders * capacity);
        if (moved_.empty()) parts_ = {}, lists_ = {};
    }
    capacity_ = capacity;
    if (moved_.empty()) return;
    parts_.resize(workers);
    for (Part& part : parts_) {
        part.begin.resize(colliders + 1);
        part.sums.resize(colliders);
    }
}

void ContactAccount::count(unsigned worker, Share mine, std::span<const Vec4> position, float inv_h) {
    Part& part = parts_[worker];
    part.mine = mine;
    part.position = position;
    part.inv_h = inv_h;
    list(part);
}

// Counts and sums all contacts, and lists as many of them as there is room for.
void ContactAccount::list(Part& part) const {
    const std::span<const Vec4> position = part.position;
    std::size_t found = 0;
    part.contacts.clear();
    for (std::uint32_t c = 0; c < part.sums.size(); ++c) {
        part.begin[c] = found;
        part.sums[c] = {};
        for (std::uint32_t p = part.mine.begin; p < part.mine.end; ++p) {
            const Vec4& moved = moved_[c * capacity_ + p];
            if (moved.x == 0 && moved.y == 0 && moved.z == 0) continue;  // most of a cloth touches nothing
            const float momentum = scalar::contact_momentum(position[p].w, part.inv_h);
            const Quanta linear = quanta_of(moved, momentum);
            if (linear == Quanta{}) continue;
            add(part.sums[c].linear, linear);
            add(part.sums[c].angular, quanta_of(turned_[c * capacity_ + p], momentum));
            part.sums[c].contacts += 1;
            ++found;
            if (part.contacts.size() == part.contacts.capacity()) continue;
            const auto axis = [&](int k) { return scalar::from_impulse_quanta(linear[k]); };
            part.contacts.push_back({position[p].xyz(), p, {axis(0), axis(1), axis(2)}, c});
        }
    }
    part.begin[part.sums.size()] = found;
}

void ContactAccount::collect(ClothContactLog& to) {
    std::size_t all = 0;
    for (Part& part : parts_) {
        const std::size_t found = part.begin.back();
        all += found;
        if (found == part.contacts.size()) continue;
        part.contacts.reserve(found + found / 2);  // a settling cloth gets more contacts every frame
        const FlushSubnormals flush;               // as in the step
        list(part);
    }
    turn_ ^= 1;
    std::vector<ContactRecord>& list = lists_[turn_];
    list.clear();
    if (list.capacity() < all) list.reserve(all + all / 2);
    to.clear();
    for (std::size_t c = 0; c < to.sums.size(); ++c) {
        for (const Part& part : parts_) {
            const auto first = part.contacts.begin();
            list.insert(list.end(), first + static_cast<std::ptrdiff_t>(part.begin[c]),
                        first + static_cast<std::ptrdiff_t>(part.begin[c + 1]));
            to.sums[c].add(part.sums[c]);
        }
    }
    to.contacts = list;
}

}  // namespace weft::cpu
