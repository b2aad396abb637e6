#include "vulkan/world_particles.h"

#include "gpu/commands.h"

#include <algorithm>

namespace weft::vulkan {

Result<bool> WorldParticles::make_room(gpu::Device& device, std::uint64_t end) {
    if (end <= capacity_) return false;
    // The first allocation is exact. Later ones double the capacity, so that few of them copy the particles.
    WorldParticles larger;
    larger.capacity_ = capacity_ == 0 ? end : std::max(end, 2 * capacity_);
    auto buffer = device.memory().buffer(point_array_count * larger.capacity_ * sizeof(Vec4), gpu::MemoryKind::device,
                                         "particles of the world");
    if (!buffer && larger.capacity_ > end) {
        larger.capacity_ = end;
        buffer = device.memory().buffer(point_array_count * end * sizeof(Vec4), gpu::MemoryKind::device,
                                        "particles of the world");
    }
    if (!buffer) return buffer.errors();
    larger.buffer_ = std::move(*buffer);
    auto moved = gpu::run_once(device, [&](gpu::Commands& commands) {
        commands.fill(larger.buffer_, 0);
        if (capacity_ == 0) return;
        commands.barrier();
        for (std::uint32_t i = 0; i < point_array_count; ++i) {
            const auto array = static_cast<PointArray>(i);
            commands.copy(buffer_, larger.buffer_, capacity_ * sizeof(Vec4), offset(array, 0), larger.offset(array, 0));
        }
    });
    if (!moved) return moved.errors();
    *this = std::move(larger);
    return true;
}

}  // namespace weft::vulkan
