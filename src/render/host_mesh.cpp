#include "render/host_mesh.h"

#include <cstring>

namespace weft::render {
namespace {

constexpr std::uint64_t aligned(std::uint64_t bytes) {
    return (bytes + 255) / 256 * 256;
}

void put(std::span<std::byte> into, std::span<const Vec3> values, float w) {
    auto* out = reinterpret_cast<Vec4*>(into.data());
    for (const Vec3& v : values) *out++ = {v.x, v.y, v.z, w};
}

}  // namespace

gpu::BufferRange range_of(const gpu::Buffer& buffer, std::uint64_t offset, std::uint64_t size) {
    return {buffer.handle(), offset, size, buffer.address() + offset};
}

Result<HostMesh> HostMesh::create(gpu::Device& device, std::uint32_t vertices, std::span<const Triangle> triangles,
                                  std::span<const Vec2> uvs, std::span<const Vec3> rest, const std::string& name) {
    HostMesh self;
    self.device_ = &device;
    self.name_ = name;
    self.vertices_ = vertices;
    self.triangles_ = static_cast<std::uint32_t>(triangles.size());
    self.has_uvs_ = !uvs.empty();
    self.has_rest_ = !rest.empty();
    self.uvs_at_ = aligned(triangles.size_bytes());
    self.rest_at_ = self.uvs_at_ + aligned(uvs.size_bytes());
    const std::uint64_t bytes = self.rest_at_ + aligned(rest.size_bytes());
    auto fixed = device.memory().buffer(bytes, gpu::MemoryKind::device, name, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    if (!fixed) return fixed.errors();
    auto staging = device.memory().buffer(bytes, gpu::MemoryKind::upload, "upload of " + name);
    if (!staging) return staging.errors();
    const auto put_at = [&](std::uint64_t offset, std::span<const std::byte> data) {
        if (!data.empty()) std::memcpy(staging->mapped().data() + offset, data.data(), data.size());
    };
    put_at(0, std::as_bytes(triangles));
    put_at(self.uvs_at_, std::as_bytes(uvs));
    put_at(self.rest_at_, std::as_bytes(rest));
    const auto done = gpu::run_once(device, [&](gpu::Commands& commands) { commands.copy(*staging, *fixed, bytes); });
    if (!done) return done.errors();
    self.fixed_ = std::move(*fixed);
    return self;
}

Result<void> HostMesh::update(std::span<const Vec3> positions, std::span<const Vec3> normals,
                              std::span<const Vec4> tangents) {
    const std::uint64_t each = aligned(std::uint64_t{vertices_} * sizeof(Vec4));
    current_ = 1 - current_;
    gpu::Buffer& buffer = moving_[current_].buffer;
    if (!buffer) {
        auto made = device_->memory().buffer(3 * each, gpu::MemoryKind::upload, name_ + ", moving");
        if (!made) return made.errors();
        buffer = std::move(*made);
    }
    put(buffer.mapped(), positions, 1);
    put(buffer.mapped().subspan(each), normals, 0);
    has_tangents_ = !tangents.empty();
    if (has_tangents_) std::memcpy(buffer.mapped().data() + 2 * each, tangents.data(), tangents.size_bytes());
    return {};
}

gpu::SurfaceBuffers HostMesh::surface() const {
    const gpu::Buffer& buffer = moving_[current_].buffer;
    const std::uint64_t bytes = std::uint64_t{vertices_} * sizeof(Vec4), each = aligned(bytes);
    gpu::SurfaceBuffers surface;
    surface.positions = range_of(buffer, 0, bytes);
    surface.normals = range_of(buffer, each, bytes);
    if (has_tangents_) surface.tangents = range_of(buffer, 2 * each, bytes);
    if (has_uvs_) surface.uvs = range_of(fixed_, uvs_at_, std::uint64_t{vertices_} * sizeof(Vec2));
    surface.triangles = range_of(fixed_, 0, std::uint64_t{triangles_} * sizeof(Triangle));
    surface.vertex_count = vertices_;
    surface.triangle_count = triangles_;
    return surface;
}

gpu::BufferRange HostMesh::rest() const {
    return has_rest_ ? range_of(fixed_, rest_at_, std::uint64_t{vertices_} * sizeof(Vec3)) : gpu::BufferRange{};
}

}  // namespace weft::render
