#include "gpu/memory.h"

#include "gpu/test_device.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace weft::gpu {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;

// Counts calls and can make them fail. Global, because a table of functions has no room for a test's own data.
struct Calls {
    VolkDeviceTable real;
    int allocated = 0, freed = 0, made = 0, destroyed = 0;
    VkResult allocate = VK_SUCCESS, map = VK_SUCCESS, bind = VK_SUCCESS, make = VK_SUCCESS;
};
Calls calls;

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
    if (calls.allocate != VK_SUCCESS) return calls.allocate;
    const VkResult result = calls.real.vkAllocateMemory(device, info, callbacks, memory);
    calls.allocated += result == VK_SUCCESS;
    return result;
}
VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* callbacks) {
    ++calls.freed;
    calls.real.vkFreeMemory(device, memory, callbacks);
}
VKAPI_ATTR VkResult VKAPI_CALL make_buffer(VkDevice device, const VkBufferCreateInfo* info,
                                           const VkAllocationCallbacks* callbacks, VkBuffer* buffer) {
    if (calls.make != VK_SUCCESS) return calls.make;
    ++calls.made;
    return calls.real.vkCreateBuffer(device, info, callbacks, buffer);
}
VKAPI_ATTR void VKAPI_CALL destroy_buffer(VkDevice device, VkBuffer buffer, const VkAllocationCallbacks* callbacks) {
    ++calls.destroyed;
    calls.real.vkDestroyBuffer(device, buffer, callbacks);
}
VKAPI_ATTR VkResult VKAPI_CALL map_memory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                          VkDeviceSize size, VkMemoryMapFlags flags, void** data) {
    return calls.map != VK_SUCCESS ? calls.map : calls.real.vkMapMemory(device, memory, offset, size, flags, data);
}
VKAPI_ATTR VkResult VKAPI_CALL bind_memory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                           VkDeviceSize offset) {
    return calls.bind != VK_SUCCESS ? calls.bind : calls.real.vkBindBufferMemory(device, buffer, memory, offset);
}

void count_calls(VolkDeviceTable& table) {
    calls = {};
    calls.real = table;
    table.vkAllocateMemory = allocate;
    table.vkFreeMemory = free_memory;
    table.vkCreateBuffer = make_buffer;
    table.vkDestroyBuffer = destroy_buffer;
    table.vkMapMemory = map_memory;
    table.vkBindBufferMemory = bind_memory;
}

class MemoryTest : public OnDevice {
  protected:
    void TearDown() override {
        const bool opened = device != nullptr;
        device.reset();
        if (opened) {
            EXPECT_EQ(calls.allocated, calls.freed);
            EXPECT_EQ(calls.made, calls.destroyed);
        }
        OnDevice::TearDown();
    }
    void open_counting(std::uint64_t limit = 0) { open({.memory_limit = limit, .intercept = count_calls}); }
    Error error_of(std::uint64_t bytes, MemoryKind kind) {
        auto made = device->memory().buffer(bytes, kind, "test");
        EXPECT_FALSE(made.ok());
        return made ? Error{} : made.error();
    }
};

TEST_F(MemoryTest, many_buffers_share_an_allocation) {
    open_counting();
    if (!device) return;
    Memory& memory = device->memory();
    EXPECT_EQ(memory.allocated(), 0u);
    std::vector<Buffer> buffers;
    std::uint64_t asked = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
        buffers.push_back(make(1 + i * 37, MemoryKind::device));
        asked += buffers.back().size();
    }
    EXPECT_EQ(calls.allocated, 1);
    EXPECT_GE(memory.used(), asked);
    EXPECT_LE(memory.used(), asked + 500 * 256);
    EXPECT_EQ(memory.allocated(), 64 * mebibyte);
    // No two overlap, and all are aligned.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
    for (const Buffer& one : buffers) {
        EXPECT_NE(one.address(), 0u);
        EXPECT_EQ(one.address() % 16, 0u);
        EXPECT_TRUE(one.mapped().empty()) << "the host does not see it";
        ranges.emplace_back(one.address(), one.address() + one.size());
    }
    std::ranges::sort(ranges);
    for (std::size_t i = 1; i < ranges.size(); ++i) EXPECT_LE(ranges[i - 1].second, ranges[i].first);
    buffers.clear();
    EXPECT_EQ(memory.used(), 0u);
    EXPECT_EQ(calls.freed, 0) << "kept for the next cloth";
}

TEST_F(MemoryTest, pieces_come_back_and_join_in_any_order) {
    open_counting();
    if (!device) return;
    std::mt19937 random(5);
    for (int round = 0; round < 20; ++round) {
        std::vector<Buffer> buffers;
        for (int i = 0; i < 60; ++i) buffers.push_back(make(1 + random() % mebibyte, MemoryKind::upload));
        std::ranges::shuffle(buffers, random);
        buffers.resize(30);  // freed ranges are reused
        for (int i = 0; i < 30; ++i) buffers.push_back(make(1 + random() % mebibyte, MemoryKind::upload));
        std::ranges::shuffle(buffers, random);
        while (!buffers.empty()) buffers.pop_back();
        EXPECT_EQ(device->memory().used(), 0u);
        // The gaps are merged again; otherwise this would need another allocation.
        const int before = calls.allocated;
        const Buffer whole = make(64 * mebibyte, MemoryKind::upload);
        EXPECT_EQ(calls.allocated, before);
        EXPECT_EQ(device->memory().used(), 64 * mebibyte);
    }
}

TEST_F(MemoryTest, large_buffers_go_back_to_the_device) {
    open_counting();
    if (!device) return;
    for (int i = 0; i < 3; ++i) {
        const Buffer large = make(100 * mebibyte, MemoryKind::device);
        EXPECT_EQ(device->memory().allocated(), device->memory().used());
    }
    EXPECT_EQ(device->memory().allocated(), 0u);
    EXPECT_EQ(calls.freed, 3);
}

TEST_F(MemoryTest, the_host_sees_its_own_buffers_as_they_were_asked_for) {
    open_counting();
    if (!device) return;
    for (const MemoryKind kind : {MemoryKind::upload, MemoryKind::readback}) {
        const Buffer a = make(10, kind), b = make(0, kind), c = make(12, kind);
        EXPECT_EQ(a.mapped().size(), 10u);
        EXPECT_EQ(a.as<std::uint32_t>().size(), 2u);
        EXPECT_EQ(b.mapped().size(), 0u);
        std::ranges::fill(a.mapped(), std::byte{1});
        std::ranges::fill(c.mapped(), std::byte{2});
        EXPECT_TRUE(std::ranges::all_of(a.mapped(), [](std::byte x) { return x == std::byte{1}; }));
    }
    EXPECT_FALSE(Buffer());
}

TEST_F(MemoryTest, more_than_the_device_gives_at_once_is_an_error_that_says_so) {
    open_counting();
    if (!device) return;
    const std::uint64_t most = device->limits().largest_allocation;
    for (const std::uint64_t bytes : {most + 1, ~std::uint64_t{0}}) {
        const Error error = error_of(bytes, MemoryKind::device);
        EXPECT_EQ(error.fault, Fault::machine);
        EXPECT_EQ(error.where, info.name);
        EXPECT_THAT(error.what, HasSubstr("failed to allocate"));
        EXPECT_THAT(error.what, HasSubstr("for 'test'"));
        EXPECT_THAT(error.what, HasSubstr("VK_ERROR_OUT_OF_DEVICE_MEMORY"));
        EXPECT_THAT(error.what, HasSubstr("a smaller cloth"));
    }
    EXPECT_EQ(device->memory().allocated(), 0u);
    EXPECT_TRUE(make(100, MemoryKind::device)) << "and all goes on";
}

TEST_F(MemoryTest, a_limit_is_kept_and_unused_memory_is_freed_when_it_is_needed) {
    open_counting(100 * mebibyte);
    if (!device) return;
    Memory& memory = device->memory();
    Buffer first = make(mebibyte, MemoryKind::device);
    EXPECT_EQ(memory.allocated(), 64 * mebibyte);
    const Buffer second = make(mebibyte, MemoryKind::upload);
    EXPECT_EQ(memory.allocated(), 65 * mebibyte) << "no whole block, but what it needs";
    const Error error = error_of(70 * mebibyte, MemoryKind::device);
    EXPECT_EQ(error.fault, Fault::machine);
    EXPECT_THAT(error.what, HasSubstr("failed to allocate 70.0 MiB beside 65.0 MiB (at most 100.0 MiB in all)"));
    EXPECT_THAT(error.what, HasSubstr("VK_ERROR_OUT_OF_DEVICE_MEMORY"));
    EXPECT_THAT(error.what, HasSubstr("(for 'test')"));
    EXPECT_EQ(memory.used(), 2 * mebibyte) << "as it was";
    first = {};
    EXPECT_TRUE(make(70 * mebibyte, MemoryKind::device)) << "there is room now";
    EXPECT_LE(memory.allocated(), 100 * mebibyte);
}

TEST_F(MemoryTest, nothing_leaks_where_a_call_fails) {
    open_counting();
    if (!device) return;
    Memory& memory = device->memory();
    const Buffer kept = make(1000, MemoryKind::device);
    const std::uint64_t used = memory.used();
    const struct {
        VkResult Calls::*call;
        VkResult result;
        const char* what;
        bool needs_block;
    } failures[] = {{&Calls::make, VK_ERROR_OUT_OF_HOST_MEMORY, "to make the buffer 'test' of 0.0 MiB", false},
                    {&Calls::allocate, VK_ERROR_OUT_OF_DEVICE_MEMORY, "to allocate", true},
                    {&Calls::allocate, VK_ERROR_TOO_MANY_OBJECTS, "to allocate 64.0 MiB", true},
                    {&Calls::map, VK_ERROR_MEMORY_MAP_FAILED, "to map 64.0 MiB", true},
                    {&Calls::bind, VK_ERROR_OUT_OF_DEVICE_MEMORY, "to bind 'test'", false}};
    for (const auto& failure : failures) {
        calls.*failure.call = failure.result;
        const Error error = error_of(100, failure.needs_block ? MemoryKind::readback : MemoryKind::device);
        calls.*failure.call = VK_SUCCESS;
        EXPECT_THAT(error.what, HasSubstr(failure.what));
        EXPECT_THAT(error.what, HasSubstr(result_name(failure.result)));
        EXPECT_EQ(error.fault, Fault::machine);
        EXPECT_EQ(memory.used(), used) << failure.what;
        EXPECT_EQ(calls.allocated - calls.freed, 1) << failure.what;
        EXPECT_EQ(calls.made - calls.destroyed, 1) << failure.what;
    }
    EXPECT_TRUE(make(100, MemoryKind::readback)) << "and all goes on";
}

}  // namespace
}  // namespace weft::gpu
