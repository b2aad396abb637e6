#include "io/exports/glb_views.h"

#include <cstring>
#include <limits>

namespace weft {
namespace {

std::uint64_t aligned_to_four(std::uint64_t bytes) {
    return (bytes + 3) / 4 * 4;
}

/// Appends to each vertex that was added later the value of its parent.
void widen_bytes(std::vector<std::byte>& values, std::size_t value_bytes, const ConstantMesh& mesh) {
    std::size_t vertex = values.size() / value_bytes;
    values.resize(mesh.vertex_count() * value_bytes);
    for (; vertex < mesh.vertex_count(); ++vertex)
        std::memcpy(&values[vertex * value_bytes], &values[mesh.parent(vertex) * value_bytes], value_bytes);
}

}  // namespace

// The highest value of either type restarts a primitive and is not allowed as an index (3.7.2.1).
int index_type(std::size_t vertices) {
    return vertices <= std::numeric_limits<std::uint16_t>::max() ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                                                 : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::vector<std::byte> index_bytes(std::span<const Triangle> triangles, std::size_t vertices) {
    const auto bytes_of = [](const auto& indices) {
        const std::span<const std::byte> raw = std::as_bytes(std::span(indices));
        return std::vector<std::byte>(raw.begin(), raw.end());
    };
    if (index_type(vertices) == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return bytes_of(triangles);
    std::vector<std::uint16_t> narrow;
    narrow.reserve(triangles.size() * 3 + 1);
    for (const Triangle& triangle : triangles)
        for (const std::uint32_t index : triangle) narrow.push_back(static_cast<std::uint16_t>(index));
    if (narrow.size() % 2 != 0) narrow.push_back(0);  // the next view must be aligned to four bytes (3.6.2.4)
    return bytes_of(narrow);
}

WideViews::WideViews(tinygltf::Model& model, const ConstantMeshes& meshes, std::uint64_t collected)
    : views_(model.bufferViews.size()) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const std::uint64_t end = i + 1 < views_.size() ? model.bufferViews[i + 1].byteOffset : collected;
        views_[i].collected = end - model.bufferViews[i].byteOffset;
    }
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const tinygltf::Primitive& primitive = model.meshes[i].primitives.front();
        show_mesh(model, primitive.indices, meshes[i]);
        for (const auto& [name, accessor] : primitive.attributes) show_mesh(model, accessor, meshes[i]);
        for (const auto& target : primitive.targets)
            for (const auto& [name, accessor] : target) show_mesh(model, accessor, meshes[i]);
    }
    for (tinygltf::BufferView& view : model.bufferViews) {
        view.byteOffset = bytes_;
        bytes_ += aligned_to_four(view.byteLength);
    }
}

/// Bounds stay right, because appended vertices repeat values.
void WideViews::show_mesh(tinygltf::Model& model, int accessor_index, const ConstantMesh& mesh) {
    tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(accessor_index)];
    tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const bool is_indices = view.target == TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    const std::size_t value_bytes = view.byteLength / accessor.count;
    views_[static_cast<std::size_t>(accessor.bufferView)].mesh = &mesh;
    if (is_indices) {
        accessor.componentType = index_type(mesh.vertex_count());
        view.byteLength =
            accessor.count *
            static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType)));
    } else {
        views_[static_cast<std::size_t>(accessor.bufferView)].value_bytes = value_bytes;
        accessor.count = mesh.vertex_count();
        view.byteLength = accessor.count * value_bytes;
    }
}

Result<void> WideViews::write(BufferedFile& collected, BufferedFile& to) const {
    std::vector<std::byte> bytes;
    for (const View& view : views_) {
        bytes.resize(view.collected);
        if (Result<void> taken = collected.take(bytes); !taken) return taken;
        if (view.mesh != nullptr) {
            if (view.value_bytes > 0) {
                widen_bytes(bytes, view.value_bytes, *view.mesh);
            } else {
                bytes = index_bytes(view.mesh->triangles(), view.mesh->vertex_count());
            }
        }
        if (Result<void> written = to.write(bytes); !written) return written;
    }
    return {};
}

}  // namespace weft
