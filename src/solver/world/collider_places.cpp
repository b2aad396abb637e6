#include "solver/world/collider_places.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Moving colliders that were neighbors when the tree was built may have parted.
constexpr std::uint32_t refits_per_build = 64;

bool is_bounded(const Bounds& box) {
    const auto finite = [](Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    return finite(box.min) && finite(box.max);
}

// Rounding of poses and boxes, with room to spare: floats have 24 bits.
Bounds with_rounding(Bounds box) {
    constexpr float part = 1e-5f;
    const auto size = [](Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    const float slack = part * std::max(size(box.min), size(box.max));
    const Vec3 by{slack, slack, slack};
    return {box.min - by, box.max + by};
}

float radius_about_origin(const Bounds& local) {
    const auto far = [](float a, float b) { return std::max(std::abs(a), std::abs(b)); };
    return length({far(local.min.x, local.max.x), far(local.min.y, local.max.y), far(local.min.z, local.max.z)});
}

}  // namespace

void ColliderPlaces::begin_frame(std::span<const Collider> colliders, double time, double dt, std::uint32_t substeps) {
    colliders_ = colliders;
    time_ = time;
    dt_ = dt;
    const auto moves_anew = [&](std::size_t i) { return colliders[i].next_pose && moving_place_[i] == none; };
    if (known_ && count_ == colliders.size()) {
        for (std::size_t i = 0; i < count_ && known_; ++i) known_ = !moves_anew(i);
    }
    const bool same = known_ && count_ == colliders.size() && substeps_ == substeps;
    substeps_ = substeps;
    if (!same) sort_by_motion();
    unbounded_moving_.clear();
    for (std::uint32_t place = 0; place < moving_.size(); ++place) {
        const Collider& collider = colliders_[moving_[place]];
        end_poses_[place] = pose_after(collider, substeps_);
        swept_[place] = swept(collider, end_poses_[place]);
        if (!is_bounded(swept_[place])) {
            swept_[place] = {};
            unbounded_moving_.push_back(moving_[place]);
        }
        ready_[place].store(false, std::memory_order_relaxed);
    }
    build_moving_tree();
}

// A collider counts as moving from its first motion on.
void ColliderPlaces::sort_by_motion() {
    ++order_;
    count_ = colliders_.size();
    moving_place_.assign(count_, none);
    moving_.clear(), resting_.clear(), unbounded_.clear();
    resting_poses_.resize(count_);
    std::vector<Bounds> boxes;
    for (std::uint32_t i = 0; i < count_; ++i) {
        const Collider& collider = colliders_[i];
        resting_poses_[i] = collider.pose;
        if (collider.body) continue;
        if (collider.next_pose || !collider.motion.empty()) {
            moving_place_[i] = static_cast<std::uint32_t>(moving_.size());
            moving_.push_back(i);
        } else if (const Bounds box = with_rounding(to_world(collider.pose, collider.bounds)); is_bounded(box)) {
            resting_.push_back(i);
            boxes.push_back(box);
        } else {
            unbounded_.push_back(i);
        }
    }
    resting_tree_ = Bvh(boxes);
    moving_tree_ = {};
    end_poses_.resize(moving_.size());
    swept_.resize(moving_.size());
    moving_poses_.resize(moving_.size() * (std::size_t{substeps_} + 1));
    ready_ = std::make_unique<std::atomic<bool>[]>(moving_.size());
    known_ = true;
}

Pose ColliderPlaces::pose_after(const Collider& collider, std::uint32_t substep) const {
    if (collider.next_pose) {
        const float fraction = static_cast<float>(substep) / static_cast<float>(substeps_);
        return between(collider.pose, *collider.next_pose, fraction);
    }
    return pose_at(collider, time_ + dt_ * substep / substeps_);
}

void ColliderPlaces::compute(std::size_t collider, std::uint32_t place) const {
    const std::lock_guard lock(computing_);
    if (ready_[place].load(std::memory_order_relaxed)) return;
    Pose* poses = &moving_poses_[std::size_t{place} * (substeps_ + 1)];
    for (std::uint32_t substep = 0; substep <= substeps_; ++substep)
        poses[substep] = pose_after(colliders_[collider], substep);
    ready_[place].store(true, std::memory_order_release);
}

// Positions are interpolated linearly, so they stay in the box of the ends and of the keys between them. Rotations may
// turn by any angle.
Bounds ColliderPlaces::swept(const Collider& collider, const Pose& end) const {
    Bounds origins;
    bool turns = true;
    origins.include(end.position);
    if (collider.next_pose) {
        origins.include(collider.pose.position);
        turns = !(end.rotation == collider.pose.rotation);
    } else if (collider.motion.empty()) {
        turns = false;
    } else {
        const auto after = [](double time, const PoseKey& key) { return time < static_cast<double>(key.time); };
        const auto first = std::upper_bound(collider.motion.begin(), collider.motion.end(), time_, after);
        const auto last = std::upper_bound(first, collider.motion.end(), time_ + dt_, after);
        for (auto key = first; key != last; ++key) origins.include(key->position);
        const PoseKey start = key_at(collider.motion, time_), stop = key_at(collider.motion, time_ + dt_);
        origins.include(start.position);
        turns = first != last || start.rotation_degrees != stop.rotation_degrees;
    }
    if (turns) {
        const float radius = radius_about_origin(collider.bounds);
        const Vec3 by{radius, radius, radius};
        return with_rounding({origins.min - by, origins.max + by});
    }
    const Bounds box = to_world({end.rotation, {}}, collider.bounds);
    return with_rounding({origins.min + box.min, origins.max + box.max});
}

void ColliderPlaces::build_moving_tree() {
    if (moving_tree_.size() == swept_.size() && refits_ < refits_per_build) {
        if (!swept_.empty()) moving_tree_.refit(swept_);
        ++refits_;
        return;
    }
    moving_tree_ = Bvh(swept_);
    refits_ = 0;
}

// Whether a collider that rests stays clear of the box. Only for shapes whose distance is exact.
bool ColliderPlaces::misses(std::uint32_t collider, const Bounds& box) const {
    if (moves(collider) || colliders_[collider].data) return false;
    const double radius = static_cast<double>(length(box.size())) * 0.5;
    return signed_distance(colliders_[collider], box.center()) > radius * (1 + 1e-4);
}

void ColliderPlaces::find(const Bounds& box, std::vector<std::uint32_t>& to, bool surfaces) const {
    if (box.empty()) return;
    const auto begin = static_cast<std::ptrdiff_t>(to.size());
    const auto add = [&](std::uint32_t collider) {
        if ((surfaces || !colliders_[collider].surface) && !misses(collider, box)) to.push_back(collider);
    };
    for (const std::uint32_t collider : unbounded_) add(collider);
    for (const std::uint32_t collider : unbounded_moving_) add(collider);
    resting_tree_.for_each_overlap(box, [&](std::uint32_t i) { add(resting_[i]); });
    moving_tree_.for_each_overlap(box, [&](std::uint32_t place) { add(moving_[place]); });
    std::sort(to.begin() + begin, to.end());
}

}  // namespace weft
