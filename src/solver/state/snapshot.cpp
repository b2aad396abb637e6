#include "solver/state/snapshot.h"

#include "base/hash.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>

namespace weft {
namespace {

// "weft" and the format version. On a machine of the other byte order neither matches.
constexpr std::uint32_t magic = 0x74666577, version = 7;

std::uint64_t checksum(std::span<const std::byte> bytes) {
    StateHash hash;
    for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
        std::uint32_t word;
        std::memcpy(&word, bytes.data() + i, 4);
        hash.add(word);
    }
    return hash.value();
}

class Writer {
  public:
    template <class T>
    void one(const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
        const auto* from = reinterpret_cast<const std::byte*>(&value);
        bytes.insert(bytes.end(), from, from + sizeof(T));
    }
    template <class T>
    void list(const std::vector<T>& values) {
        one<std::uint64_t>(values.size());
        const auto raw = std::as_bytes(std::span(values));
        bytes.insert(bytes.end(), raw.begin(), raw.end());
    }

    std::vector<std::byte> bytes;
};

class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <class T>
    T one() {
        T value{};
        if (!take(&value, sizeof(T))) return {};
        return value;
    }
    template <class T>
    std::vector<T> list() {
        const auto count = one<std::uint64_t>();
        if (count > rest_.size() / sizeof(T)) return short_ = true, std::vector<T>{};
        std::vector<T> values(count);
        take(values.data(), count * sizeof(T));
        return values;
    }
    bool ended_well() const { return !short_ && rest_.empty(); }
    bool too_short() const { return short_; }

  private:
    bool take(void* to, std::size_t size) {
        if (short_ || size > rest_.size()) return !(short_ = true);
        if (size > 0) std::memcpy(to, rest_.data(), size);
        rest_ = rest_.subspan(size);
        return true;
    }

    std::span<const std::byte> rest_;
    bool short_ = false;
};

}  // namespace

std::vector<std::byte> to_bytes(const Snapshot& snapshot) {
    Writer out;
    out.one(snapshot.frame);
    out.one(snapshot.time);
    out.list(snapshot.colliders);
    out.list(snapshot.grabs);
    out.list(snapshot.bodies);
    out.one<std::uint64_t>(snapshot.cloths.size());
    for (const ClothSnapshot& cloth : snapshot.cloths) {
        out.list(cloth.position);
        out.list(cloth.start);
        out.list(cloth.velocity);
        out.list(cloth.compensation);
        out.list(cloth.kept);
        out.one(cloth.substep_seconds);
        out.list(cloth.targets.particles);
        out.one<std::uint64_t>(cloth.targets.motions.size());
        for (const SavedMotion& motion : cloth.targets.motions) {
            out.one(motion.collider);
            out.list(motion.offsets);
        }
        out.one<std::uint64_t>(cloth.edits.size());
        for (const ClothEdit& edit : cloth.edits) {
            out.list(edit.appended);
            out.list(edit.triangles);
            out.list(edit.openings);
            out.list(edit.rows);
            out.list(edit.added);
            out.one(edit.pruned_frames);
        }
    }
    Writer file;
    file.one(magic);
    file.one(version);
    file.one(checksum(out.bytes));
    file.bytes.insert(file.bytes.end(), out.bytes.begin(), out.bytes.end());
    return std::move(file.bytes);
}

Result<Snapshot> snapshot_from_bytes(std::span<const std::byte> bytes) {
    Reader in(bytes);
    if (in.one<std::uint32_t>() != magic) return Error{"state", "is not a saved state of weft"};
    if (const auto found = in.one<std::uint32_t>(); found != version)
        return Error{"state", "has version " + std::to_string(found) + ", this weft reads " + std::to_string(version)};
    const auto sum = in.one<std::uint64_t>();
    if (in.too_short() || sum != checksum(bytes.subspan(16)))
        return Error{"state", "is damaged: its checksum does not fit"};

    Snapshot snapshot;
    snapshot.frame = in.one<std::uint64_t>();
    snapshot.time = in.one<double>();
    snapshot.colliders = in.list<Pose>();
    snapshot.grabs = in.list<SavedGrab>();
    snapshot.bodies = in.list<SavedBody>();
    const auto cloths = in.one<std::uint64_t>();
    for (std::uint64_t i = 0; i < cloths && !in.too_short(); ++i) {
        ClothSnapshot& cloth = snapshot.cloths.emplace_back();
        cloth.position = in.list<Vec4>();
        cloth.start = in.list<Vec4>();
        cloth.velocity = in.list<Vec4>();
        cloth.compensation = in.list<Vec4>();
        cloth.kept = in.list<float>();
        cloth.substep_seconds = in.one<double>();
        cloth.targets.particles = in.list<KinematicTarget>();
        const auto motions = in.one<std::uint64_t>();
        for (std::uint64_t m = 0; m < motions && !in.too_short(); ++m) {
            SavedMotion& motion = cloth.targets.motions.emplace_back();
            motion.collider = in.one<std::uint32_t>();
            motion.offsets = in.list<OffsetKey>();
        }
        const auto edits = in.one<std::uint64_t>();
        for (std::uint64_t e = 0; e < edits && !in.too_short(); ++e) {
            ClothEdit& edit = cloth.edits.emplace_back();
            edit.appended = in.list<std::uint32_t>();
            edit.triangles = in.list<TriangleEdit>();
            edit.openings = in.list<Opening>();
            edit.rows = in.list<RowEdit>();
            edit.added = in.list<RowEdit>();
            edit.pruned_frames = in.one<std::uint32_t>();
        }
    }
    if (!in.ended_well()) return Error{"state", "is damaged: its parts do not fit together"};
    return snapshot;
}

namespace {

// Largest absolute value: its square still fits in a float.
constexpr float largest = 1e18f;

bool sound(const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= largest && finite(v);
}
bool sound(const Vec4& v) {
    return sound(v.xyz()) && std::abs(v.w) <= largest;  // false for what is not finite
}
// Lambdas of heavy cloth can exceed `largest`; they are never squared.
bool sound(float lambda) {
    return std::isfinite(lambda);
}
bool is_unit(const Vec3& v) {
    return std::abs(dot(v, v) - 1) < 1e-3f;
}
bool sound(const Pose& pose) {
    return sound(pose.position) && is_unit(pose.rotation.x) && is_unit(pose.rotation.y) && is_unit(pose.rotation.z);
}
bool sound(const KinematicTarget& target) {
    return sound(target.local);
}
bool sound(const OffsetKey& key) {
    return std::isfinite(key.time) && sound(key.offset);
}
bool sound(const SavedGrab& grab) {
    const GrabStep& step = grab.step;
    const float least = std::min({step.weights.x, step.weights.y, step.weights.z});
    const float sum = step.weights.x + step.weights.y + step.weights.z;
    return sound(step.from) && sound(step.to) && least >= 0 && std::abs(sum - 1) <= 1e-3f &&
           step.spring.max_force > 0 && step.spring.max_force <= largest_grab_force && step.spring.compliance >= 0 &&
           step.spring.compliance <= largest && step.spring.damping >= 0 && step.spring.damping <= largest &&
           grab.id < none;
}
bool sound(const SavedBody& body) {
    const BodyState& state = body.state;
    const Vec4& q = state.turn;
    return sound(state.place) && sound(state.velocity) && sound(state.spin) && sound(state.v_dropped) &&
           sound(state.x_dropped) && std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-3f;
}
bool sound_time(double seconds) {
    return seconds >= 0 && std::isfinite(seconds);
}

template <class T>
std::optional<std::size_t> first_unsound(const std::vector<T>& values) {
    const auto it = std::ranges::find_if(values, [](const T& value) { return !sound(value); });
    if (it == values.end()) return std::nullopt;
    return static_cast<std::size_t>(it - values.begin());
}

}  // namespace

Result<void> check_numbers(const Snapshot& snapshot) {
    if (!sound_time(snapshot.time)) return Error{"state", "its time must be finite and ≥ 0 s"};
    if (const auto i = first_unsound(snapshot.colliders))
        return Error{"state", "collider " + std::to_string(*i) + " must have a rotation and a finite position"};
    if (const auto i = first_unsound(snapshot.grabs))
        return Error{"state",
                     "grab " + std::to_string(*i) + " must have finite places, weights that sum to 1 and a force"};
    if (const auto i = first_unsound(snapshot.bodies))
        return Error{"state",
                     "body " + std::to_string(*i) + " must have a rotation and finite numbers of at most 1e18"};
    for (std::size_t i = 0; i < snapshot.grabs.size(); ++i)
        if (std::ranges::count(snapshot.grabs, snapshot.grabs[i].id, &SavedGrab::id) > 1)
            return Error{"state", "grab " + std::to_string(i) + " has the id of another one"};
    for (std::size_t c = 0; c < snapshot.cloths.size(); ++c) {
        const ClothSnapshot& cloth = snapshot.cloths[c];
        const std::string of_cloth = "cloth " + std::to_string(c) + ": ";
        for (const auto* array : {&cloth.position, &cloth.start, &cloth.velocity, &cloth.compensation}) {
            if (const auto i = first_unsound(*array))
                return Error{"state",
                             of_cloth + "particle " + std::to_string(*i) + " must have finite numbers of at most 1e18"};
        }
        for (const Vec4& particle : cloth.position)
            if (particle.w < 0) return Error{"state", of_cloth + "inverse masses must be ≥ 0"};
        bool sound_targets = !first_unsound(cloth.targets.particles);
        for (const SavedMotion& motion : cloth.targets.motions)
            sound_targets = sound_targets && !first_unsound(motion.offsets) &&
                            std::ranges::is_sorted(motion.offsets, {}, &OffsetKey::time);
        if (!sound_targets)
            return Error{"state", of_cloth + "the targets of its pins must be finite, with keys in ascending time"};
        if (const auto i = first_unsound(cloth.kept))
            return Error{"state", of_cloth + "constraint " + std::to_string(*i) + " must be finite"};
        if (!sound_time(cloth.substep_seconds))
            return Error{"state", of_cloth + "its substep must be finite and ≥ 0 s"};
    }
    return {};
}

}  // namespace weft
