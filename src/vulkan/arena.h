// Many arrays in one device buffer. build() uploads the known data and fills the rest with zeros.
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
    /// Reserves an array and fills it with `data`. build() reads the data, so it must stay valid until then.
    Slot add(std::span<const std::byte> data);
    template <class Array>
    Slot add_array(const Array& array) {
        return add(std::as_bytes(std::span(array.data(), array.size())));
    }
    /// Reserves an array of zeros.
    Slot reserve(std::uint64_t bytes);

    /// `usage`: flags in addition to those that every buffer gets.
    Result<void> build(gpu::Device& device, const std::string& name, VkBufferUsageFlags usage = 0);

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

/// Copies through staging memory, in pieces if the data is large.
Result<void> upload(gpu::Device& device, const gpu::Buffer& to, std::uint64_t offset, std::span<const std::byte> data);
Result<void> download(gpu::Device& device, const gpu::Buffer& from, std::uint64_t offset, std::span<std::byte> data);

/// Replaces the first bytes of an array.
Result<void> upload(gpu::Device& device, const Arena& arena, Slot slot, std::span<const std::byte> data);
/// Returns exactly the bytes of the slot.
Result<std::vector<std::byte>> download(gpu::Device& device, const Arena& arena, Slot slot);

}  // namespace weft::vulkan
