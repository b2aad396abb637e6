#include "vulkan/primitives/scan.h"

#include "vulkan/arena.h"

namespace weft::vulkan {
namespace {

Result<std::vector<std::uint32_t>> scan(gpu::Device& device, Programs& programs, std::span<const std::uint32_t> numbers,
                                        bool inclusive) {
    std::vector<std::uint32_t> sums(numbers.size());
    if (numbers.empty()) return sums;
    if (numbers.size() > most_elements) return too_many(numbers.size(), "numbers");
    const auto count = static_cast<std::uint32_t>(numbers.size());
    auto array = device.memory().buffer(numbers.size_bytes(), gpu::MemoryKind::device, "numbers");
    if (!array) return array.errors();
    auto scratch = device.memory().buffer(scan_scratch(count), gpu::MemoryKind::device, "sums of tiles");
    if (!scratch) return scratch.errors();
    if (auto up = upload(device, *array, 0, std::as_bytes(numbers)); !up) return up.errors();
    auto done = run_passes(device, programs, [&](Recorder& recorder) {
        record_scan(recorder, array->address(), array->address(), count, scratch->address(), inclusive);
    });
    if (!done) return done.errors();
    auto down = download(device, *array, 0, std::as_writable_bytes(std::span(sums)));
    if (!down) return down.errors();
    return sums;
}

}  // namespace

std::uint64_t scan_scratch(std::uint32_t count) {
    std::uint64_t words = 0;
    for (std::uint32_t tiles = tiles_of(count); tiles > 1; tiles = tiles_of(tiles)) words += tiles;
    return words * sizeof(std::uint32_t);
}

void record_scan(Recorder& recorder, std::uint64_t source, std::uint64_t result, std::uint32_t count,
                 std::uint64_t scratch, bool inclusive) {
    if (count == 0) return;
    ScanArgs args{.source = source, .result = result, .sums = 0, .count = count, .inclusive = inclusive};
    const std::uint32_t tiles = tiles_of(count);
    if (tiles > 1) {
        args.sums = scratch;
        recorder.run("reduce", args, tiles);
        record_scan(recorder, scratch, scratch, tiles, scratch + tiles * sizeof(std::uint32_t));
    }
    recorder.run("scan", args, tiles);
}

Result<std::vector<std::uint32_t>> exclusive_scan(gpu::Device& device, Programs& programs,
                                                  std::span<const std::uint32_t> numbers) {
    return scan(device, programs, numbers, false);
}

Result<std::vector<std::uint32_t>> inclusive_scan(gpu::Device& device, Programs& programs,
                                                  std::span<const std::uint32_t> numbers) {
    return scan(device, programs, numbers, true);
}

}  // namespace weft::vulkan
