#include "gpu/commands.h"

#include "gpu/test_device.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <numeric>

namespace weft::gpu {
namespace {

using testing::HasSubstr;

struct Push {
    std::uint64_t from = 0, to = 0;
    std::uint32_t count = 0;
    float a = 0, b = 0;
};

class CommandsTest : public OnDevice {
  protected:
    void SetUp() override {
        OnDevice::SetUp();
        if (!IsSkipped()) open();
    }
    std::span<const std::byte> bytes_of(const Push& push) {
        return std::as_bytes(std::span(&push, 1)).first(push_bytes);
    }
    Result<void> run(const std::function<void(Commands&)>& work) { return run_once(*device, work); }

    static constexpr std::size_t push_bytes = 28;
};

TEST_F(CommandsTest, fills_and_copies) {
    const Buffer a = make(1000, MemoryKind::device), b = make(1000, MemoryKind::readback);
    ASSERT_TRUE(run([&](Commands& commands) {
        commands.fill(a, 7);
        commands.barrier();
        commands.fill(a, 9, 16, 8);
        commands.barrier();
        commands.copy(a, b, 0);
        commands.copy(a, b, 1000);
        commands.barrier();
        commands.copy(a, b, 4, 12, 996);
        commands.host_barrier();
    }));
    const auto got = b.as<std::uint32_t>();
    for (std::size_t i = 0; i < 250; ++i) EXPECT_EQ(got[i], (i >= 2 && i < 6) || i == 249 ? 9u : 7u) << i;
}

// Fills the last bytes too if the size is not a multiple of a word.
TEST_F(CommandsTest, a_whole_fill_reaches_the_end) {
    const Buffer a = make(18, MemoryKind::device), b = make(18, MemoryKind::readback);
    ASSERT_TRUE(run([&](Commands& commands) {
        commands.fill(a, 0x05050505);
        commands.barrier();
        commands.copy(a, b, 18);
        commands.host_barrier();
    }));
    for (const std::byte one : b.mapped()) EXPECT_EQ(one, std::byte{5});
}

TEST_F(CommandsTest, a_dispatch_computes_what_it_is_told_and_sees_what_was_written_before) {
    constexpr std::uint32_t count = 1000;
    const std::uint64_t bytes = count * sizeof(float);
    const Buffer up = make(bytes, MemoryKind::upload), a = make(bytes, MemoryKind::device),
                 b = make(bytes, MemoryKind::device), down = make(bytes, MemoryKind::readback);
    auto pipeline = Pipeline::create(*device, test_shader("arithmetic"), std::array{64u});
    ASSERT_TRUE(pipeline.ok()) << pipeline.error().message();
    EXPECT_EQ(pipeline->workgroup(), 64u);
    EXPECT_EQ(pipeline->push_constants(), push_bytes);
    auto commands = Commands::create(*device);
    ASSERT_TRUE(commands.ok());
    ASSERT_TRUE(commands->begin().ok());
    commands->copy(up, a, bytes);
    commands->barrier();
    commands->bind(*pipeline);
    for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        commands->push(bytes_of({from->address(), to->address(), count, 0.25f, 0.5f}));
        commands->dispatch((count + 63) / 64);
        commands->barrier();
    }
    commands->copy(a, down, bytes);
    commands->host_barrier();
    ASSERT_TRUE(commands->end().ok());
    // Submits the same commands repeatedly. The host writes new input before each submission.
    std::vector<float> first(count);
    for (const float shift : {0.0f, 1.0f, 0.0f}) {
        for (std::uint32_t i = 0; i < count; ++i) up.as<float>()[i] = shift + 0.001f * static_cast<float>(i);
        const auto value = commands->submit();
        ASSERT_TRUE(value.ok());
        ASSERT_TRUE(device->wait(*value).ok());
        const auto got = down.as<float>();
        for (std::uint32_t i = 0; i < count; ++i) ASSERT_TRUE(std::isfinite(got[i])) << i;
        if (first[0] == 0 && first[1] == 0) std::ranges::copy(got, first.begin());
        EXPECT_EQ(std::memcmp(first.data(), got.data(), bytes) == 0, shift == 0);
    }
}

TEST_F(CommandsTest, submits_are_done_in_order_and_values_ascend) {
    const Buffer a = make(4, MemoryKind::device), b = make(4, MemoryKind::readback);
    std::vector<Commands> all;
    std::uint64_t last = 0;
    for (std::uint32_t i = 0; i < 20; ++i) {
        auto commands = Commands::create(*device);
        ASSERT_TRUE(commands.ok());
        ASSERT_TRUE(commands->begin().ok());
        commands->fill(a, i);
        commands->barrier();
        commands->copy(a, b, 4);
        commands->host_barrier();
        ASSERT_TRUE(commands->end().ok());
        const auto value = commands->submit();
        ASSERT_TRUE(value.ok());
        EXPECT_GT(*value, last);
        EXPECT_EQ(*value, device->submitted());
        last = *value;
        all.push_back(std::move(*commands));
    }
    ASSERT_TRUE(device->wait(last).ok());
    EXPECT_EQ(b.as<std::uint32_t>()[0], 19u);
    EXPECT_TRUE(device->wait(0).ok()) << "long ago";
}

TEST_F(CommandsTest, intervals_are_times) {
    ASSERT_GT(device->limits().timestamp_bits, 0u);
    ASSERT_GT(device->limits().timestamp_period, 0);
    const Buffer a = make(std::uint64_t{64} << 20, MemoryKind::device);
    auto commands = Commands::create(*device, 3);
    ASSERT_TRUE(commands.ok());
    ASSERT_TRUE(commands->begin().ok());
    commands->stamp();
    for (std::uint32_t i = 0; i < 8; ++i) {
        commands->fill(a, i);
        commands->barrier();
    }
    commands->stamp();
    commands->stamp();
    commands->stamp();  // there is no room for this one
    ASSERT_TRUE(commands->end().ok());
    EXPECT_EQ(commands->stamp_count(), 3u);
    EXPECT_TRUE(commands->intervals().empty()) << "it has not run";
    for (int i = 0; i < 3; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        const auto value = commands->submit();
        ASSERT_TRUE(value.ok() && device->wait(*value).ok());
        const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        const std::vector<double> ms = commands->intervals();
        ASSERT_EQ(ms.size(), 2u);
        EXPECT_GT(ms[0], 0);
        EXPECT_GE(ms[1], 0);
        EXPECT_LT(ms[0] + ms[1], wall + 1) << "no longer than it took";
    }
    ASSERT_TRUE(commands->begin().ok());
    EXPECT_TRUE(commands->intervals().empty()) << "what was recorded is forgotten";
    ASSERT_TRUE(commands->end().ok());
}

TEST(Intervals, of_a_clock_that_begins_again) {
    const auto ms = [](std::vector<std::uint64_t> ticks, std::uint32_t bits) {
        return intervals_between(ticks, bits, 1000);
    };
    constexpr std::uint64_t end36 = std::uint64_t{1} << 36, noise = std::uint64_t{0xabc} << 36;
    EXPECT_THAT(ms({10, 2010, 2010}, 64), testing::ElementsAre(2, 0));
    EXPECT_THAT(ms({end36 - 1000, 500}, 36), testing::ElementsAre(1.5));
    EXPECT_THAT(ms({noise | 7, 1007}, 36), testing::ElementsAre(1)) << "the bits above mean nothing";
    EXPECT_THAT(ms({~std::uint64_t{0} - 499, 500}, 64), testing::ElementsAre(1));
    EXPECT_THAT(ms({5}, 64), testing::IsEmpty());
    EXPECT_THAT(ms({}, 64), testing::IsEmpty());
}

TEST_F(CommandsTest, without_stamps_there_are_no_intervals) {
    auto commands = Commands::create(*device);
    ASSERT_TRUE(commands.ok() && commands->begin().ok());
    commands->stamp();
    ASSERT_TRUE(commands->end().ok());
    const auto value = commands->submit();
    ASSERT_TRUE(value.ok() && device->wait(*value).ok());
    EXPECT_TRUE(commands->intervals().empty());
}

// --- Pipelines ---

TEST_F(CommandsTest, a_workgroup_is_set_by_the_constants_that_stand_for_it) {
    auto set = Pipeline::create(*device, test_shader("arithmetic"), std::array{32u});
    ASSERT_TRUE(set.ok());
    EXPECT_EQ(set->workgroup(), 32u);
    auto fixed = Pipeline::create(*device, test_shader("bindings"), std::array{7u});
    ASSERT_TRUE(fixed.ok()) << fixed.error().message();
    EXPECT_EQ(fixed->workgroup(), 8u) << "constant 0 is something else here";
}

TEST_F(CommandsTest, pipelines_are_compiled_when_they_are_bound_or_together) {
    const auto prepare = [&](std::uint32_t workgroup) {
        auto made = Pipeline::prepare(*device, test_shader("arithmetic"), std::array{workgroup});
        EXPECT_TRUE(made.ok());
        return std::move(*made);
    };
    const Pipeline bound = prepare(16), collected = prepare(32), other = prepare(64);
    EXPECT_EQ(collected.workgroup(), 32u) << "known before it is compiled";
    auto commands = Commands::create(*device);
    ASSERT_TRUE(commands.ok() && commands->begin().ok());
    commands->bind(bound);
    EXPECT_TRUE(bound.compiled());
    commands->collect_uncompiled();
    for (const Pipeline* one : {&collected, &bound, &other, &collected}) commands->bind(*one);
    EXPECT_FALSE(collected.compiled());
    EXPECT_THAT(commands->uncompiled(), testing::ElementsAre(&collected, &other, &collected));
    ASSERT_TRUE(commands->end().ok());
    ASSERT_TRUE(compile_together(commands->uncompiled()).ok());
    EXPECT_TRUE(collected.compiled() && other.compiled());
    ASSERT_TRUE(commands->begin().ok());
    EXPECT_THAT(commands->uncompiled(), testing::IsEmpty());
    EXPECT_TRUE(commands->end().ok());
}

TEST_F(CommandsTest, a_pipeline_that_cannot_be_compiled_is_an_error_of_the_recording) {
    open({.intercept = [](VolkDeviceTable& table) {
        table.vkCreateComputePipelines = [](VkDevice, VkPipelineCache, std::uint32_t,
                                            const VkComputePipelineCreateInfo*, const VkAllocationCallbacks*,
                                            VkPipeline*) -> VkResult { return VK_ERROR_OUT_OF_HOST_MEMORY; };
    }});
    auto pipeline = Pipeline::prepare(*device, test_shader("arithmetic"), std::array{64u});
    ASSERT_TRUE(pipeline.ok());
    const auto end = [&] {
        auto commands = Commands::create(*device);
        EXPECT_TRUE(commands.ok() && commands->begin().ok());
        commands->bind(*pipeline);
        commands->dispatch(1);
        return commands->end();
    };
    const auto ended = end();
    ASSERT_FALSE(ended.ok());
    EXPECT_THAT(ended.error().message(), HasSubstr("to compile 'arithmetic'"));
    const Pipeline* const one[] = {&*pipeline};
    EXPECT_FALSE(compile_together(one).ok());
    EXPECT_FALSE(pipeline->compiled());
    EXPECT_FALSE(Pipeline::create(*device, test_shader("arithmetic"), std::array{64u}).ok());
}

TEST_F(CommandsTest, what_the_device_has_not_is_an_error_before_it_is_asked) {
    const DeviceLimits& limits = device->limits();
    const auto error_of = [&](const char* name, std::span<const std::uint32_t> constants) {
        auto made = Pipeline::create(*device, test_shader(name), constants);
        EXPECT_FALSE(made.ok()) << name;
        if (made) return std::string();
        EXPECT_EQ(made.error().fault, Fault::machine);
        return made.error().what;
    };
    const std::array wide = {limits.workgroup_size[0] + 1};
    EXPECT_THAT(error_of("arithmetic", wide), HasSubstr("invocations along x, the device has"));
    EXPECT_THAT(error_of("arithmetic", std::array{0u}), HasSubstr("needs 0 invocations along x"));
    if (limits.push_constants < 1024) {
        EXPECT_THAT(error_of("wide", std::array{1u, 1u}), HasSubstr("needs 1024 bytes of push constants"));
    }
    if (limits.descriptor_sets < 61) {
        EXPECT_THAT(error_of("far", {}), HasSubstr("needs 61 descriptor sets"));
    }
    EXPECT_FALSE(Pipeline::create(*device, {"none", {}}).ok());
}

// --- The validation layer ---

// The absence of messages means something only if an error causes one.
TEST_F(CommandsTest, the_validation_layer_sees_what_is_wrong) {
    const Buffer a = make(64, MemoryKind::device);
    ASSERT_TRUE(run([&](Commands& commands) { commands.fill(a, 0); }));
    EXPECT_THAT(take_messages(), testing::IsEmpty()) << "a normal sequence";
    auto commands = Commands::create(*device);
    ASSERT_TRUE(commands.ok() && commands->begin().ok());
    commands->fill(a, 0, 6);  // not a multiple of a word
    ASSERT_TRUE(commands->end().ok());
    EXPECT_THAT(take_messages(), testing::Contains(HasSubstr("VUID-vkCmdFillBuffer-size")));
}

// A semaphore with a pending wait must not be signaled again. The validation layer checks this.
TEST_F(CommandsTest, work_goes_from_hand_to_hand_by_semaphores_without_values) {
    VkSemaphoreCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    ASSERT_EQ(device->vk().vkCreateSemaphore(device->handle(), &create, nullptr, &semaphore), VK_SUCCESS);
    const Buffer a = make(64, MemoryKind::readback);
    std::vector<Commands> all;
    for (std::uint32_t i = 0; i < 6; ++i) {
        auto commands = Commands::create(*device);
        ASSERT_TRUE(commands.ok() && commands->begin().ok());
        commands->fill(a, i);
        commands->host_barrier();
        ASSERT_TRUE(commands->end().ok());
        const bool gives = i % 2 == 0;
        const Moment before{i == 0 ? VK_NULL_HANDLE : device->timeline(), device->submitted()};
        const auto value = commands->submit(
            before, {.wait = gives ? VK_NULL_HANDLE : semaphore, .signal = gives ? semaphore : VK_NULL_HANDLE});
        ASSERT_TRUE(value.ok()) << value.error().message();
        EXPECT_EQ(*value, i + 1);
        all.push_back(std::move(*commands));
    }
    EXPECT_TRUE(device->wait(6).ok());
    EXPECT_EQ(a.as<std::uint32_t>()[0], 5u);
    device->vk().vkDestroySemaphore(device->handle(), semaphore, nullptr);
}

TEST_F(CommandsTest, the_validation_layer_sees_a_barrier_that_is_missing) {
    const Buffer a = make(64, MemoryKind::device), b = make(64, MemoryKind::device);
    for (const bool wrong : {false, true}) {
        auto commands = Commands::create(*device);
        ASSERT_TRUE(commands.ok() && commands->begin().ok());
        commands->fill(a, 1);
        if (!wrong) commands->barrier();
        commands->copy(a, b, 64);
        ASSERT_TRUE(commands->end().ok());
        const auto messages = take_messages();
        if (wrong) {
            EXPECT_THAT(messages, testing::Contains(HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE")));
        } else {
            EXPECT_THAT(messages, testing::IsEmpty());
        }
    }
}

}  // namespace
}  // namespace weft::gpu
