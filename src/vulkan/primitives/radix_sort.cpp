#include "vulkan/primitives/radix_sort.h"

#include "vulkan/arena.h"
#include "vulkan/primitives/scan.h"

#include <bit>
#include <utility>

namespace weft::vulkan {

SortScratch sort_scratch(std::uint32_t count) {
    const std::uint32_t places = WEFT_DIGITS * tiles_of(count);
    return {places * sizeof(std::uint32_t), scan_scratch(places)};
}

std::uint32_t bits_below(std::uint32_t end) {
    return end == 0 ? 0 : static_cast<std::uint32_t>(std::bit_width(end - 1));
}

KeyArrays record_sort(Recorder& recorder, KeyArrays keys, KeyArrays spare, std::uint32_t count, std::uint32_t bits,
                      SortScratch addresses) {
    if (count == 0) return keys;
    const std::uint32_t tiles = tiles_of(count);
    for (std::uint32_t shift = 0; shift < 2 * bits; shift += WEFT_DIGIT_BITS) {
        const SortArgs args{
            .high = keys.high,
            .low = keys.low,
            .value = keys.value,
            .to_high = spare.high,
            .to_low = spare.low,
            .to_value = spare.value,
            .places = addresses.places,
            .count = count,
            .tiles = tiles,
            .shift = shift,
            .bits = bits,
        };
        recorder.run("count_digits", args, tiles);
        record_scan(recorder, addresses.places, addresses.places, WEFT_DIGITS * tiles, addresses.sums);
        recorder.run("scatter", args, tiles);
        std::swap(keys, spare);
    }
    return keys;
}

Result<std::vector<KeyedValue>> sort_keys(gpu::Device& device, Programs& programs, std::span<const KeyedValue> keys,
                                          std::uint32_t bits) {
    if (keys.size() > most_elements) return too_many(keys.size(), "keys");
    const auto count = static_cast<std::uint32_t>(keys.size());
    const std::uint64_t bytes = count * sizeof(std::uint32_t);
    // Six arrays: high, low and value, then the same again as the destination.
    auto buffer = device.memory().buffer(6 * bytes, gpu::MemoryKind::device, "keys");
    if (!buffer) return buffer.errors();
    const SortScratch sizes = sort_scratch(count);
    auto scratch = device.memory().buffer(sizes.places + sizes.sums, gpu::MemoryKind::device, "places of digits");
    if (!scratch) return scratch.errors();

    std::vector<std::uint32_t> words(3 * keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        words[i] = keys[i].high;
        words[keys.size() + i] = keys[i].low;
        words[2 * keys.size() + i] = keys[i].value;
    }
    if (auto up = upload(device, *buffer, 0, std::as_bytes(std::span(words))); !up) return up.errors();
    const auto arrays = [&](std::uint64_t at) { return KeyArrays{at, at + bytes, at + 2 * bytes}; };
    KeyArrays sorted;
    auto done = run_passes(device, programs, [&](Recorder& recorder) {
        sorted = record_sort(recorder, arrays(buffer->address()), arrays(buffer->address() + 3 * bytes), count, bits,
                             {scratch->address(), scratch->address() + sizes.places});
    });
    if (!done) return done.errors();
    auto down = download(device, *buffer, sorted.high - buffer->address(), std::as_writable_bytes(std::span(words)));
    if (!down) return down.errors();

    std::vector<KeyedValue> result(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        result[i] = {words[i], words[keys.size() + i], words[2 * keys.size() + i]};
    return result;
}

}  // namespace weft::vulkan
