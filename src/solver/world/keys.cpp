#include "solver/world/keys.h"

#include <algorithm>
#include <cstddef>

namespace weft {
namespace {

// The keys before and after `time`, and the position between them, 0…1.
template <class Key>
struct Between {
    const Key &before, &after;
    float fraction;
};
template <class Key>
Between<Key> find_between(std::span<const Key> keys, double time) {
    const auto later = [](double at, const Key& key) { return at < static_cast<double>(key.time); };
    const auto after = static_cast<std::size_t>(std::upper_bound(keys.begin(), keys.end(), time, later) - keys.begin());
    if (after == 0) return {keys.front(), keys.front(), 0};
    if (after == keys.size()) return {keys.back(), keys.back(), 0};
    const double from = keys[after - 1].time, to = keys[after].time;
    return {keys[after - 1], keys[after], static_cast<float>((time - from) / (to - from))};
}

template <class Value>
Value mix(Value a, Value b, float fraction) {
    return a + (b - a) * fraction;
}

}  // namespace

PoseKey key_at(std::span<const PoseKey> keys, double time) {
    const auto [before, after, fraction] = find_between(keys, time);
    return {.time = static_cast<float>(time),
            .position = mix(before.position, after.position, fraction),
            .rotation_degrees = mix(before.rotation_degrees, after.rotation_degrees, fraction)};
}

WindKey key_at(std::span<const WindKey> keys, double time) {
    const auto [before, after, fraction] = find_between(keys, time);
    return {.time = static_cast<float>(time),
            .position = mix(before.position, after.position, fraction),
            .rotation_degrees = mix(before.rotation_degrees, after.rotation_degrees, fraction),
            .strength = mix(before.strength, after.strength, fraction)};
}

Vec3 offset_at(std::span<const OffsetKey> keys, double time) {
    if (keys.empty()) return {};
    const auto [before, after, fraction] = find_between(keys, time);
    return mix(before.offset, after.offset, fraction);
}

}  // namespace weft
