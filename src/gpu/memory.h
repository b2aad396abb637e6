// Buffers from a few large allocations.
#pragma once

#include "gpu/vulkan.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace weft::gpu {

class Device;

enum class MemoryKind {
    device,    ///< device-local; only the device reads and writes
    upload,    ///< written by the host, read by the device
    readback,  ///< written by the device, read by the host
};

/// An allocated range of a block.
struct Piece {
    MemoryKind kind{};
    std::uint32_t block = 0;
    std::uint64_t offset = 0, size = 0;
};

/// A storage buffer. The destructor frees its memory; the device must not use it any more then.
class Buffer {
  public:
    Buffer() = default;
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept {
        Buffer(std::move(other)).swap(*this);
        return *this;
    }
    ~Buffer();

    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
    VkBuffer handle() const { return buffer_; }
    std::uint64_t size() const { return size_; }        ///< bytes, as requested
    std::uint64_t address() const { return address_; }  ///< on the device
    /// The memory as mapped for the host; empty for MemoryKind::device.
    std::span<std::byte> mapped() const { return {mapped_, mapped_ ? static_cast<std::size_t>(size_) : 0}; }
    template <class T>
    std::span<T> as() const {
        return {reinterpret_cast<T*>(mapped_), mapped_ ? static_cast<std::size_t>(size_) / sizeof(T) : 0};
    }

  private:
    friend class Memory;
    void swap(Buffer& other);

    class Memory* memory_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    std::uint64_t size_ = 0, address_ = 0;
    std::byte* mapped_ = nullptr;
    Piece piece_;
};

class Memory {
  public:
    /// `limit`: largest number of bytes to allocate; 0: no limit.
    explicit Memory(const Device& device, std::uint64_t limit = 0);
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// The content is undefined. `usage`: in addition to storage, copies and an address. A failure changes nothing.
    Result<Buffer> buffer(std::uint64_t bytes, MemoryKind kind, const std::string& name, VkBufferUsageFlags usage = 0);
    /// Allocates device memory for a single image. Free it with free_dedicated().
    Result<VkDeviceMemory> allocate_dedicated(const VkMemoryRequirements& needs, const std::string& what);
    void free_dedicated(VkDeviceMemory memory, std::uint64_t bytes);
    /// Bytes allocated from the device.
    std::uint64_t allocated() const;
    /// The part of them in buffers and images.
    std::uint64_t used() const;

  private:
    friend class Buffer;
    struct Block;
    struct Pool;

    Result<void> place(Buffer& buffer, const VkMemoryRequirements& needs, MemoryKind kind, const std::string& name);
    Result<std::uint32_t> add_block(Pool& pool, std::uint64_t bytes, const VkMemoryRequirements& needs);
    VkResult allocate(Block& block) const;
    void free_unused();
    Result<std::uint32_t> memory_type(MemoryKind kind, std::uint32_t allowed) const;
    void give_back(const Piece& piece);

    const Device& device_;
    std::uint64_t limit_ = 0;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::vector<std::unique_ptr<Pool>> pools_;  // by kind
    std::uint64_t dedicated_bytes_ = 0;         // bytes of images
};

}  // namespace weft::gpu
