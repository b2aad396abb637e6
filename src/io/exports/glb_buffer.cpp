#include "io/exports/glb_buffer.h"

#include "io/exports/glb_views.h"
#include "io/files/atomic_file.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace weft {
namespace {

/// Bounds per component; 3.6.2.5 requires them rounded like the stored values.
void set_bounds(tinygltf::Accessor& accessor, std::span<const Vec3> values) {
    Vec3 low = values.front(), high = values.front();
    for (const Vec3& v : values) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    accessor.minValues = {low.x, low.y, low.z};
    accessor.maxValues = {high.x, high.y, high.z};
}

}  // namespace

Result<void> GlbBuffer::open(const std::filesystem::path& path) {
    Result<BufferedFile> file = BufferedFile::open_nameless(folder_of(path), path.string());
    if (!file) return file.errors();
    file_ = *std::move(file);
    return {};
}

tinygltf::Accessor& GlbBuffer::open_accessor(int component, int type, std::size_t count, int target) {
    assert(file_.size() % 4 == 0);
    tinygltf::BufferView& view = model_.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = file_.size();
    view.byteLength = count * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(std::uint32_t(component))) *
                      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(std::uint32_t(type)));
    view.target = target;
    tinygltf::Accessor& accessor = model_.accessors.emplace_back();
    accessor.bufferView = as_int(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    return accessor;
}

Result<int> GlbBuffer::add_vectors(std::span<const Vec3> values, WithBounds bounds) {
    tinygltf::Accessor& accessor =
        open_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, values.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    if (bounds == WithBounds::yes) set_bounds(accessor, values);
    if (Result<void> r = append(std::as_bytes(values)); !r) return r.errors();
    return newest_accessor();
}

Result<int> GlbBuffer::add_indices(std::span<const Triangle> triangles, std::size_t vertices) {
    open_accessor(index_type(vertices), TINYGLTF_TYPE_SCALAR, triangles.size() * 3,
                  TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    if (Result<void> r = append(index_bytes(triangles, vertices)); !r) return r.errors();
    return newest_accessor();
}

Result<int> GlbBuffer::add_keys(std::span<const float> values, int type) {
    const auto components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(std::uint32_t(type)));
    open_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, type, values.size() / components, 0);
    if (Result<void> r = append(std::as_bytes(values)); !r) return r.errors();
    return newest_accessor();
}

Result<int> GlbBuffer::add_picture(std::span<const std::byte> bytes) {
    tinygltf::BufferView& view = model_.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = file_.size();
    view.byteLength = bytes.size();
    if (Result<void> r = append(bytes); !r) return r.errors();
    constexpr std::byte zeros[3] = {};  // the next view must be aligned to four bytes (3.6.2.4)
    if (Result<void> r = append(std::span(zeros).first((4 - bytes.size() % 4) % 4)); !r) return r.errors();
    return as_int(model_.bufferViews.size()) - 1;
}

}  // namespace weft
