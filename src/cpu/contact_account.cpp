#include "cpu/contact_account.h"

#include "base/flush_subnormals.h"
#include "physics/scalar.h"

#include <algorithm>

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

void ContactAccount::prepare(std::size_t colliders, unsigned workers) {
    parts_.resize(colliders > 0 ? workers : 0);
    if (parts_.empty()) lists_ = {};
    for (Part& part : parts_) part.sums.resize(colliders), part.near = nullptr, part.found = 0;
}

void ContactAccount::count(unsigned worker, const ColliderPart& near, std::uint32_t particles,
                           std::span<const Vec4> position, float inv_h) {
    Part& part = parts_[worker];
    part.near = &near;
    part.particles = particles;
    part.position = position;
    part.inv_h = inv_h;
    list(part);
}

// Counts and sums all contacts, and lists as many of them as there is room for.
void ContactAccount::list(Part& part) {
    part.found = 0;
    part.contacts.clear();
    std::ranges::fill(part.sums, ImpulseSum{});
    for (const ColliderRun& run : part.near->runs()) {
        for (const NearCollider& near : part.near->near(run)) {
            const std::span<const Vec4> all_moved = part.near->moved(near, run), turned = part.near->turned(near, run);
            for (std::uint32_t p = run.begin; p < std::min(run.end, part.particles); ++p) {
                const Vec4& moved = all_moved[p - run.begin];
                if (moved.x == 0 && moved.y == 0 && moved.z == 0) continue;  // most of a cloth touches nothing
                const Vec4& x = part.position[p];
                const float momentum = scalar::contact_momentum(x.w, part.inv_h);
                const Quanta linear = quanta_of(moved, momentum);
                if (linear == Quanta{}) continue;
                ImpulseSum& sum = part.sums[near.collider];
                add(sum.linear, linear);
                add(sum.angular, quanta_of(turned[p - run.begin], momentum));
                sum.contacts += 1;
                ++part.found;
                if (part.contacts.size() == part.contacts.capacity()) continue;
                const auto axis = [&](int k) { return scalar::from_impulse_quanta(linear[k]); };
                part.contacts.push_back({x.xyz(), p, {axis(0), axis(1), axis(2)}, near.collider});
            }
        }
    }
}

void ContactAccount::collect(ClothContactLog& to) {
    std::size_t all = 0;
    to.clear();
    next_.assign(to.sums.size(), 0);
    for (Part& part : parts_) {
        if (!part.near) continue;
        all += part.found;
        if (part.found != part.contacts.size()) {
            part.contacts.reserve(part.found + part.found / 2);  // a settling cloth gets more contacts every frame
            const FlushSubnormals flush;                         // as in the step
            list(part);
        }
        for (std::size_t c = 0; c < to.sums.size(); ++c) to.sums[c].add(part.sums[c]);
    }
    std::size_t place = 0;
    for (std::size_t c = 0; c < to.sums.size(); ++c) {
        next_[c] = place;
        place += to.sums[c].contacts;
    }
    turn_ ^= 1;
    std::vector<ContactRecord>& list = lists_[turn_];
    if (list.capacity() < all) list.reserve(all + all / 2);
    list.resize(all);
    // Workers, and the runs of a worker, are in the order of the particles.
    for (const Part& part : parts_) {
        if (!part.near) continue;
        for (const ContactRecord& contact : part.contacts) list[next_[contact.collider]++] = contact;
    }
    to.contacts = list;
}

}  // namespace weft::cpu
