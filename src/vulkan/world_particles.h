// The particles of all cloths on the device, in one address space.
#pragma once

#include "gpu/device.h"

#include <weft/result.h>
#include <weft/vector.h>

#include <cstdint>

namespace weft::vulkan {

/// Arrays of Vec4, one element per particle of the world. The fourth floats of positions are inverse masses; those of
/// start, velocity and carry are what rounding dropped from the velocity. The good ones are what a frame found, to go
/// back to.
enum class PointArray : std::uint32_t {
    position,
    start,
    velocity,
    carry,
    good_position,
    good_velocity,
    good_carry,
    normals,
};
inline constexpr std::uint32_t point_array_count = 8;

class WorldParticles {
  public:
    /// Room for particles up to `end`. What is there is kept, and lies elsewhere then: true if it does. Where the
    /// device has no room, all is as it was.
    Result<bool> make_room(gpu::Device& device, std::uint64_t end);

    const gpu::Buffer& buffer() const { return buffer_; }
    /// Bytes, of a particle in the buffer.
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
