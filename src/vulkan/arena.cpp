#include "vulkan/arena.h"

#include <algorithm>
#include <cstring>

namespace weft::vulkan {
namespace {

// Largest storage buffer alignment that Vulkan lets a device require, and at least a cache line on most devices.
constexpr std::uint64_t alignment = 256;

// Uploads go through staging memory of at most this size, one after another.
constexpr std::uint64_t staging_bytes = std::uint64_t{32} << 20;

Result<void> copy_up(gpu::Device& device, const gpu::Buffer& to, std::uint64_t offset, std::span<const std::byte> data,
                     gpu::Buffer& staging) {
    for (std::size_t at = 0; at < data.size();) {
        const std::size_t bytes = std::min<std::size_t>(data.size() - at, staging.size());
        std::memcpy(staging.mapped().data(), data.data() + at, bytes);
        auto done =
            gpu::run_once(device, [&](gpu::Commands& commands) { commands.copy(staging, to, bytes, 0, offset + at); });
        if (!done) return done;
        at += bytes;
    }
    return {};
}

}  // namespace

Slot Arena::add(std::span<const std::byte> data) {
    const Slot slot = reserve(data.size());
    if (!data.empty()) uploads_.push_back({slot, data});
    return slot;
}

Slot Arena::reserve(std::uint64_t bytes) {
    const Slot slot{size_, bytes};
    size_ += (bytes + alignment - 1) / alignment * alignment;
    return slot;
}

Result<void> Arena::build(gpu::Device& device, const std::string& name, VkBufferUsageFlags usage) {
    auto buffer = device.memory().buffer(size_, gpu::MemoryKind::device, name, usage);
    if (!buffer) return buffer.errors();
    buffer_ = std::move(*buffer);
    auto cleared = gpu::run_once(device, [&](gpu::Commands& commands) { commands.fill(buffer_, 0); });
    if (!cleared) return cleared;
    // Adjacent arrays are copied in one go.
    std::uint64_t total = 0;
    for (const Upload& one : uploads_) total += one.slot.bytes + alignment;
    if (total == 0) return {};
    auto staging = device.memory().buffer(std::min(total, staging_bytes), gpu::MemoryKind::upload, "staging");
    if (!staging) return staging.errors();
    std::uint64_t begin = 0, end = 0;  // range of the buffer that staging memory holds
    const auto flush = [&]() -> Result<void> {
        if (begin == end) return {};
        return gpu::run_once(device,
                             [&](gpu::Commands& commands) { commands.copy(*staging, buffer_, end - begin, 0, begin); });
    };
    for (const Upload& one : uploads_) {
        const std::uint64_t last = one.slot.offset + one.slot.bytes;
        if (begin == end || last - begin > staging->size()) {
            if (auto flushed = flush(); !flushed) return flushed;
            begin = end = one.slot.offset;
        }
        if (one.slot.bytes > staging->size()) {
            if (auto copied = copy_up(device, buffer_, one.slot.offset, one.data, *staging); !copied) return copied;
            begin = end = 0;
            continue;
        }
        std::byte* at = staging->mapped().data() + (one.slot.offset - begin);
        std::memset(staging->mapped().data() + (end - begin), 0, one.slot.offset - end);
        std::memcpy(at, one.data.data(), one.data.size());
        end = last;
    }
    if (auto flushed = flush(); !flushed) return flushed;
    uploads_.clear();
    return {};
}

Result<void> upload(gpu::Device& device, const gpu::Buffer& to, std::uint64_t offset, std::span<const std::byte> data) {
    if (data.empty()) return {};
    auto staging =
        device.memory().buffer(std::min<std::uint64_t>(data.size(), staging_bytes), gpu::MemoryKind::upload, "staging");
    if (!staging) return staging.errors();
    return copy_up(device, to, offset, data, *staging);
}

Result<void> download(gpu::Device& device, const gpu::Buffer& from, std::uint64_t offset, std::span<std::byte> data) {
    if (data.empty()) return {};
    auto staging = device.memory().buffer(std::min<std::uint64_t>(data.size(), staging_bytes),
                                          gpu::MemoryKind::readback, "staging");
    if (!staging) return staging.errors();
    for (std::size_t at = 0; at < data.size();) {
        const std::size_t bytes = std::min<std::size_t>(data.size() - at, staging->size());
        auto done = gpu::run_once(device, [&](gpu::Commands& commands) {
            commands.copy(from, *staging, bytes, offset + at);
            commands.host_barrier();
        });
        if (!done) return done;
        std::memcpy(data.data() + at, staging->mapped().data(), bytes);
        at += bytes;
    }
    return {};
}

Result<void> upload(gpu::Device& device, const Arena& arena, Slot slot, std::span<const std::byte> data) {
    return upload(device, arena.buffer(), slot.offset, data);
}

Result<std::vector<std::byte>> download(gpu::Device& device, const Arena& arena, Slot slot) {
    std::vector<std::byte> data(slot.bytes);
    auto done = download(device, arena.buffer(), slot.offset, data);
    if (!done) return done.errors();
    return data;
}

}  // namespace weft::vulkan
