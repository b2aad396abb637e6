// A mesh in host memory, copied to the device for drawing.
#pragma once

#include "gpu/commands.h"
#include "gpu/surface_buffers.h"

#include <weft/mesh.h>
#include <weft/vector.h>

#include <array>
#include <span>
#include <string>

namespace weft::render {

/// Constant data is copied once. Moving data is written directly to memory that the device reads, into two alternating
/// sets, because the previous frame may still read one of them.
class HostMesh {
  public:
    /// UVs and rest positions: one per vertex, or empty.
    static Result<HostMesh> create(gpu::Device& device, std::uint32_t vertices, std::span<const Triangle> triangles,
                                   std::span<const Vec2> uvs, std::span<const Vec3> rest, const std::string& name);

    /// One element per vertex; tangents may be empty. Overwrites the data of the second last update, so the device must
    /// have finished all frames that use it.
    Result<void> update(std::span<const Vec3> positions, std::span<const Vec3> normals, std::span<const Vec4> tangents);
    /// The buffers of the last update. They need no synchronization.
    gpu::SurfaceBuffers surface() const;
    gpu::BufferRange rest() const;

  private:
    struct Moving {
        gpu::Buffer buffer;  // positions, normals, tangents
    };

    gpu::Device* device_ = nullptr;
    std::string name_;
    std::uint32_t vertices_ = 0, triangles_ = 0;
    gpu::Buffer fixed_;  // triangles, UVs, rest
    std::uint64_t uvs_at_ = 0, rest_at_ = 0;
    bool has_uvs_ = false, has_rest_ = false, has_tangents_ = false;
    std::array<Moving, 2> moving_;
    std::uint32_t current_ = 0;
};

/// A part of a buffer.
gpu::BufferRange range_of(const gpu::Buffer& buffer, std::uint64_t offset, std::uint64_t size);

}  // namespace weft::render
