// A mesh that the host has, brought to the device to be drawn.
#pragma once

#include "gpu/commands.h"
#include "gpu/surface_buffers.h"

#include <weft/mesh.h>
#include <weft/vector.h>

#include <array>
#include <span>
#include <string>

namespace weft::render {

/// What does not move is copied once; what moves is written where the device reads it, into two sets that take turns:
/// what a frame was drawn from may be still in use when the next one is written.
class HostMesh {
  public:
    /// UVs and rest positions may be empty; otherwise one a vertex.
    static Result<HostMesh> create(gpu::Device& device, std::uint32_t vertices, std::span<const Triangle> triangles,
                                   std::span<const Vec2> uvs, std::span<const Vec3> rest, const std::string& name);

    /// One a vertex; tangents may be empty. Of the two last calls' frames, the earlier one must have been drawn.
    Result<Done> update(std::span<const Vec3> positions, std::span<const Vec3> normals, std::span<const Vec4> tangents);
    /// As of the last update; nothing to wait for.
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
