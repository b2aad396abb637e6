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
    /// including alignment. `usage`: of the upload buffer, in addition to storage and uniforms; the same each time.
    /// Returns whether the buffer is another one than before.
    Result<bool> begin(gpu::Device& device, std::uint64_t bytes, VkBufferUsageFlags usage = 0) {
        if (!commands) {
            auto made = gpu::Commands::create(device);
            if (!made) return made.errors();
            commands.emplace(std::move(*made));
        }
        const bool grows = !upload_ || upload_.size() < bytes;
        if (grows) {
            auto made = device.memory().buffer(bytes + bytes / 2, gpu::MemoryKind::upload, "frame",
                                               usage | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
            if (!made) return made.errors();
            upload_ = std::move(*made);
        }
        used_ = 0;
        if (auto begun = commands->begin(); !begun) return begun.errors();
        return grows;
    }

    /// Copies the values and returns their address on the device.
    template <class Value>
    std::uint64_t put(std::span<const Value> values) {
        const std::uint64_t at = room_for(used_);
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

    /// The same for a value that shaders read as a uniform buffer. Returns its offset in `buffer()`.
    template <class Value>
    std::uint32_t put_uniform(const Value& value) {
        const std::uint64_t at = (used_ + uniform_alignment - 1) / uniform_alignment * uniform_alignment;
        std::memcpy(upload_.mapped().data() + at, &value, sizeof value);
        used_ = at + sizeof value;
        return static_cast<std::uint32_t>(at);
    }
    template <class Value>
    static constexpr std::uint64_t room_for_uniform() {
        return sizeof(Value) + uniform_alignment;
    }
    const gpu::Buffer& buffer() const { return upload_; }

    std::optional<gpu::Commands> commands;
    gpu::DescriptorSet uniforms;  ///< in the buffer
    gpu::Framebuffer target;      ///< of the image that the frame draws into
    std::uint64_t submitted = 0;  ///< value of the device's timeline when the frame is done; 0: never submitted

  private:
    static constexpr std::uint64_t uniform_alignment = 256;  // the largest that a device may ask for

    gpu::Buffer upload_;
    std::uint64_t used_ = 0;
};

}  // namespace weft::render
