#include "gpu/memory.h"

#include "gpu/borrowed_functions.h"
#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

namespace weft::gpu {
namespace {

// Drivers may limit the number of allocations (the specification guarantees 4096), and each takes about a millisecond.
constexpr std::uint64_t block_size = std::uint64_t{64} << 20;  // bytes

std::string mebibytes(std::uint64_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MiB", static_cast<double>(bytes) / (1 << 20));
    return text;
}

constexpr std::uint64_t rounded_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

constexpr bool is_out_of_memory(VkResult result) {
    return result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY;
}

Error too_large(const Device& device, std::uint64_t bytes, const std::string& name) {
    return device.error("to allocate " + mebibytes(bytes) + " for '" + name + "' (at most " +
                            mebibytes(device.limits().largest_allocation) + " at once)",
                        VK_ERROR_OUT_OF_DEVICE_MEMORY);
}

}  // namespace

struct Memory::Block {
    struct Gap {
        std::uint64_t offset, size;
    };
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t size = 0;
    std::byte* mapped = nullptr;
    std::uint32_t type = 0;
    std::vector<Gap> gaps;  // sorted by offset; adjacent gaps are merged

    /// Has memory, but no buffer in it.
    bool empty() const { return memory != VK_NULL_HANDLE && gaps.size() == 1 && gaps.front().size == size; }
    std::optional<std::uint64_t> take(std::uint64_t bytes, std::uint64_t alignment) {
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            const Gap gap = gaps[i];
            const std::uint64_t begin = rounded_up(gap.offset, alignment);
            if (begin + bytes > gap.offset + gap.size) continue;
            const Gap before{gap.offset, begin - gap.offset},
                after{begin + bytes, gap.offset + gap.size - begin - bytes};
            gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(i));
            if (after.size > 0) gaps.insert(gaps.begin() + static_cast<std::ptrdiff_t>(i), after);
            if (before.size > 0) gaps.insert(gaps.begin() + static_cast<std::ptrdiff_t>(i), before);
            return begin;
        }
        return std::nullopt;
    }
    void give_back(std::uint64_t offset, std::uint64_t bytes) {
        auto next = std::ranges::lower_bound(gaps, offset, {}, &Gap::offset);
        if (next != gaps.end() && offset + bytes == next->offset) {
            bytes += next->size;
            next = gaps.erase(next);
        }
        if (next != gaps.begin() && (next - 1)->offset + (next - 1)->size == offset) {
            (next - 1)->size += bytes;
        } else {
            gaps.insert(next, {offset, bytes});
        }
    }
};

struct Memory::Pool {
    MemoryKind kind{};
    std::vector<Block> blocks;  // freed blocks stay as empty entries
};

Buffer::~Buffer() {
    if (!memory_) return;
    const Device& device = memory_->device_;
    device.vk().vkDestroyBuffer(device.handle(), buffer_, nullptr);
    if (piece_.size > 0) memory_->give_back(piece_);
}

void Buffer::swap(Buffer& other) {
    std::swap(memory_, other.memory_);
    std::swap(buffer_, other.buffer_);
    std::swap(size_, other.size_);
    std::swap(address_, other.address_);
    std::swap(mapped_, other.mapped_);
    std::swap(piece_, other.piece_);
}

Memory::Memory(const Device& device, std::uint64_t limit) : device_(device), limit_(limit) {
    {
        const BorrowedFunctions functions(device);
        vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties_);
    }
    for (const MemoryKind kind : {MemoryKind::device, MemoryKind::upload, MemoryKind::readback}) {
        pools_.push_back(std::make_unique<Pool>());
        pools_.back()->kind = kind;
    }
}

Memory::~Memory() {
    for (const auto& pool : pools_) {
        for (const Block& block : pool->blocks) {
            if (block.memory != VK_NULL_HANDLE) device_.vk().vkFreeMemory(device_.handle(), block.memory, nullptr);
        }
    }
}

Result<Buffer> Memory::buffer(std::uint64_t bytes, MemoryKind kind, const std::string& name, VkBufferUsageFlags usage) {
    // Fails early for impossible sizes, because some drivers create such buffers without an error.
    if (bytes > device_.limits().largest_allocation) return too_large(device_, bytes, name);
    Buffer buffer;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = rounded_up(std::max<std::uint64_t>(bytes, 1), 16);  // fill() writes whole words
    info.usage = usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const VkResult result = device_.vk().vkCreateBuffer(device_.handle(), &info, nullptr, &buffer.buffer_);
    if (result != VK_SUCCESS) return device_.error("to make the buffer '" + name + "' of " + mebibytes(bytes), result);
    buffer.memory_ = this;
    buffer.size_ = bytes;
    VkMemoryRequirements needs{};
    device_.vk().vkGetBufferMemoryRequirements(device_.handle(), buffer.buffer_, &needs);
    if (auto placed = place(buffer, needs, kind, name); !placed) return placed.errors();
    device_.name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer.buffer_), name);
    VkBufferDeviceAddressInfo address{};
    address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    address.buffer = buffer.buffer_;
    buffer.address_ = device_.vk().vkGetBufferDeviceAddress(device_.handle(), &address);
    return buffer;
}

Result<void> Memory::place(Buffer& buffer, const VkMemoryRequirements& needs, MemoryKind kind,
                           const std::string& name) {
    if (needs.size > device_.limits().largest_allocation) return too_large(device_, needs.size, name);
    Pool& pool = *pools_[static_cast<std::size_t>(kind)];
    std::optional<std::uint64_t> offset;
    std::uint32_t at = 0;
    for (; at < pool.blocks.size() && !offset; ++at) {
        Block& block = pool.blocks[at];
        if (block.memory == VK_NULL_HANDLE || !(needs.memoryTypeBits >> block.type & 1)) continue;
        offset = block.take(needs.size, needs.alignment);
        if (offset) break;
    }
    if (!offset) {
        auto added = add_block(pool, needs.size, needs);
        if (!added) {
            Errors errors = added.errors();
            errors.front().what += " (for '" + name + "')";
            return errors;
        }
        at = *added;
        offset = pool.blocks[at].take(needs.size, needs.alignment);
    }
    const Block& block = pool.blocks[at];
    buffer.piece_ = {kind, at, *offset, needs.size};
    if (block.mapped) buffer.mapped_ = block.mapped + *offset;
    const VkResult result = device_.vk().vkBindBufferMemory(device_.handle(), buffer.buffer_, block.memory, *offset);
    if (result != VK_SUCCESS) return device_.error("to bind '" + name + "'", result);
    return {};
}

Result<std::uint32_t> Memory::add_block(Pool& pool, std::uint64_t bytes, const VkMemoryRequirements& needs) {
    auto type = memory_type(pool.kind, needs.memoryTypeBits);
    if (!type) return type.errors();
    Block block;
    block.type = *type;
    // A large block holds a single buffer. On small devices, a block is never larger than the largest allocation.
    block.size = std::max(bytes, std::min(block_size, device_.limits().largest_allocation));
    VkResult result = allocate(block);
    if (is_out_of_memory(result)) {
        free_unused();
        result = allocate(block);
    }
    if (is_out_of_memory(result) && block.size > bytes) {
        block.size = bytes;
        result = allocate(block);
    }
    if (result != VK_SUCCESS) {
        std::string doing = "to allocate " + mebibytes(block.size);
        if (limit_ > 0) doing += " beside " + mebibytes(allocated()) + " (at most " + mebibytes(limit_) + " in all)";
        return device_.error(doing, result);
    }
    const auto& vk = device_.vk();
    if (pool.kind != MemoryKind::device) {
        void* mapped = nullptr;
        result = vk.vkMapMemory(device_.handle(), block.memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result != VK_SUCCESS) {
            vk.vkFreeMemory(device_.handle(), block.memory, nullptr);
            return device_.error("to map " + mebibytes(block.size), result);
        }
        block.mapped = static_cast<std::byte*>(mapped);
    }
    block.gaps = {{0, block.size}};
    const auto free =
        std::ranges::find(pool.blocks, VkDeviceMemory{VK_NULL_HANDLE}, &Block::memory) - pool.blocks.begin();
    if (free == std::ssize(pool.blocks)) pool.blocks.emplace_back();
    pool.blocks[static_cast<std::size_t>(free)] = std::move(block);
    return static_cast<std::uint32_t>(free);
}

VkResult Memory::allocate(Block& block) const {
    if (limit_ > 0 && block.size > limit_ - std::min(limit_, allocated())) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = &flags;
    info.allocationSize = block.size;
    info.memoryTypeIndex = block.type;
    return device_.vk().vkAllocateMemory(device_.handle(), &info, nullptr, &block.memory);
}

Result<VkDeviceMemory> Memory::allocate_dedicated(const VkMemoryRequirements& needs, const std::string& what) {
    if (needs.size > device_.limits().largest_allocation) return too_large(device_, needs.size, what);
    auto type = memory_type(MemoryKind::device, needs.memoryTypeBits);
    if (!type) return type.errors();
    Block block;
    block.type = *type;
    block.size = needs.size;
    VkResult result = allocate(block);
    if (is_out_of_memory(result)) {
        free_unused();
        result = allocate(block);
    }
    if (result != VK_SUCCESS) return device_.error("to allocate " + mebibytes(block.size) + " for " + what, result);
    dedicated_bytes_ += needs.size;
    return block.memory;
}

void Memory::free_dedicated(VkDeviceMemory memory, std::uint64_t bytes) {
    device_.vk().vkFreeMemory(device_.handle(), memory, nullptr);
    dedicated_bytes_ -= bytes;
}

// Frees the blocks that are kept for later buffers, so that an allocation can succeed.
void Memory::free_unused() {
    for (const auto& pool : pools_) {
        for (Block& block : pool->blocks) {
            if (!block.empty()) continue;
            device_.vk().vkFreeMemory(device_.handle(), block.memory, nullptr);
            block = {};
        }
    }
}

Result<std::uint32_t> Memory::memory_type(MemoryKind kind, std::uint32_t allowed) const {
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags seen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    // Memory types with these flags need additional features. Drivers list them after the usual ones.
    constexpr VkMemoryPropertyFlags special = VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
                                              VK_MEMORY_PROPERTY_PROTECTED_BIT |
                                              VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD;
    // Flags in order of preference.
    std::array<VkMemoryPropertyFlags, 2> wanted{};
    if (kind == MemoryKind::device) wanted = {local, 0};
    if (kind == MemoryKind::upload) wanted = {seen, seen};
    if (kind == MemoryKind::readback) wanted = {seen | cached, seen};
    for (const VkMemoryPropertyFlags flags : wanted) {
        for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
            const VkMemoryPropertyFlags has = properties_.memoryTypes[i].propertyFlags;
            if ((allowed >> i & 1) && (has & flags) == flags && !(has & special)) return i;
        }
    }
    return device_.error("to find memory of a suitable kind", VK_ERROR_FEATURE_NOT_PRESENT);
}

void Memory::give_back(const Piece& piece) {
    Pool& pool = *pools_[static_cast<std::size_t>(piece.kind)];
    Block& block = pool.blocks[piece.block];
    block.give_back(piece.offset, piece.size);
    // Blocks of the usual size are kept for later buffers.
    if (!block.empty() || block.size <= block_size) return;
    device_.vk().vkFreeMemory(device_.handle(), block.memory, nullptr);
    block = {};
}

std::uint64_t Memory::allocated() const {
    std::uint64_t bytes = dedicated_bytes_;
    for (const auto& pool : pools_)
        for (const Block& block : pool->blocks) bytes += block.size;
    return bytes;
}

std::uint64_t Memory::used() const {
    std::uint64_t bytes = allocated();
    for (const auto& pool : pools_)
        for (const Block& block : pool->blocks)
            for (const Block::Gap& gap : block.gaps) bytes -= gap.size;
    return bytes;
}

}  // namespace weft::gpu
