#include "vulkan/shape_buffers.h"

#include "vulkan/arena.h"

namespace weft::vulkan {

Result<void> ShapeBuffers::hold(gpu::Device& device, std::span<const Collider> colliders) {
    // Nobody else has it if no collider has it.
    std::erase_if(entries_, [](const auto& entry) { return entry.second.data.use_count() == 1; });
    for (const Collider& collider : colliders) {
        if (!collider.data || address(collider.data.get()) != 0) continue;
        const auto bytes = std::as_bytes(std::span(collider.data->words));
        auto buffer =
            device.memory().buffer(bytes.size(), gpu::MemoryKind::device, "shape of collider '" + collider.name + "'");
        if (!buffer) return buffer.errors();
        if (auto done = upload(device, *buffer, 0, bytes); !done) return done;
        entries_[collider.data.get()] = {collider.data, std::move(*buffer)};
    }
    return {};
}

std::uint64_t ShapeBuffers::address(const ShapeData* data) const {
    if (!data) return 0;
    const auto entry = entries_.find(data);
    return entry == entries_.end() ? 0 : entry->second.buffer.address();
}

}  // namespace weft::vulkan
