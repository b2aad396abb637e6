// The particles of all cloths on the device, in one address space.
#pragma once

#include "gpu/device.h"

#include <weft/result.h>
#include <weft/vector.h>

#include <cstdint>

namespace weft::vulkan {

/// Arrays of Vec4, one element per particle of the world. The fourth floats of positions are inverse masses; those of
/// start, velocity and compensation are the velocity's compensation. The good_… arrays hold the state before the frame,
/// for a roll-back.
enum class PointArray : std::uint32_t {
    position,
    start,
    velocity,
    compensation,
    good_position,
    good_velocity,
    good_compensation,
    normals,
};
inline constexpr std::uint32_t point_array_count = 8;

class WorldParticles {
  public:
    /// Makes room for particles up to `end` and keeps the present ones. Returns true if their addresses have changed. A
    /// failure changes nothing.
    Result<bool> make_room(gpu::Device& device, std::uint64_t end);

    const gpu::Buffer& buffer() const { return buffer_; }
    /// Offset of a particle in the buffer, in bytes.
    std::uint64_t offset(PointArray array, std::uint64_t particle) const {
        return (static_cast<std::uint64_t>(array) * capacity_ + particle) * sizeof(Vec4);
    }
    std::uint64_t address(PointArray array, std::uint64_t particle) const {
        return buffer_.address() + offset(array, particle);
    }

  private:
    gpu::Buffer buffer_;
    std::uint64_t capacity_ = 0;  ///< particles
};

}  // namespace weft::vulkan
