// The commands and the upload buffer of one frame in flight.
#pragma once

#include "gpu/commands.h"

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

namespace weft::render {

class FrameSlot {
  public:
    /// Begins a new frame. The device must have finished the previous one of this slot. Makes room for `bytes`,
    /// including alignment. `usage`: of the upload buffer, in addition to storage; the same each time.
    Result<void> begin(gpu::Device& device, std::uint64_t bytes, VkBufferUsageFlags usage = 0) {
        if (!commands) {
            auto made = gpu::Commands::create(device);
            if (!made) return made.errors();
            commands.emplace(std::move(*made));
        }
        if (!upload_ || upload_.size() < bytes) {
            auto made = device.memory().buffer(bytes + bytes / 2, gpu::MemoryKind::upload, "frame", usage);
            if (!made) return made.errors();
            upload_ = std::move(*made);
        }
        used_ = 0;
        return commands->begin();
    }

    /// Copies the values and returns their address on the device.
    template <class Value>
    std::uint64_t put(std::span<const Value> values) {
        const std::uint64_t at = used_;
        if (!values.empty()) std::memcpy(upload_.mapped().data() + at, values.data(), values.size_bytes());
        used_ = at + room_for(values.size_bytes());
        return upload_.address() + at;
    }
    template <class Value>
    std::uint64_t put(const Value& value) {
        return put(std::span<const Value>(&value, 1));
    }
    /// The range of the upload buffer at an address that put() returned.
    gpu::BufferRange range(std::uint64_t address) const { return {upload_.handle(), address - upload_.address()}; }
    static constexpr std::uint64_t room_for(std::uint64_t bytes) { return (bytes + 15) / 16 * 16; }

    std::optional<gpu::Commands> commands;
    gpu::Framebuffer target;      ///< of the image that the frame draws into
    std::uint64_t submitted = 0;  ///< value of the device's timeline when the frame is done; 0: never submitted

  private:
    gpu::Buffer upload_;
    std::uint64_t used_ = 0;
};

}  // namespace weft::render
