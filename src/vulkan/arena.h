// Many arrays in one buffer on the device: what is known goes up with it, the rest is zero.
#pragma once

#include "gpu/commands.h"
#include "gpu/device.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

/// An array in an arena. An empty one has the address 0.
struct Slot {
    std::uint64_t offset = 0, bytes = 0;
};

class Arena {
  public:
    /// To be filled: the data is read when the arena is built.
    Slot add(std::span<const std::byte> data);
    template <class Array>
    Slot add_array(const Array& array) {
        return add(std::as_bytes(std::span(array.data(), array.size())));
    }
    /// Zeros.
    Slot reserve(std::uint64_t bytes);

    /// `usage`: beside what every buffer is for.
    Result<Done> build(gpu::Device& device, const std::string& name, VkBufferUsageFlags usage = 0);

    std::uint64_t address(Slot slot) const { return slot.bytes == 0 ? 0 : buffer_.address() + slot.offset; }
    const gpu::Buffer& buffer() const { return buffer_; }
    std::uint64_t size() const { return size_; }

  private:
    struct Upload {
        Slot slot;
        std::span<const std::byte> data;
    };
    std::vector<Upload> uploads_;
    std::uint64_t size_ = 0;
    gpu::Buffer buffer_;
};

/// Through staging memory, piece by piece if it is much.
Result<Done> upload(gpu::Device& device, const gpu::Buffer& to, std::uint64_t offset, std::span<const std::byte> data);
Result<Done> download(gpu::Device& device, const gpu::Buffer& from, std::uint64_t offset, std::span<std::byte> data);

/// Replaces part of an array.
Result<Done> upload(gpu::Device& device, const Arena& arena, Slot slot, std::span<const std::byte> data);
/// Appends nothing, skips nothing: the bytes of the slot.
Result<std::vector<std::byte>> download(gpu::Device& device, const Arena& arena, Slot slot);

}  // namespace weft::vulkan
