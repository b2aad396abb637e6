// Reads .glb files in tests.
#pragma once

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <cstring>
#include <vector>

namespace weft::test {

/// The values of an accessor, which must be tightly packed.
template <class Value>
std::vector<Value> data_of(const tinygltf::Model& model, int accessor_index) {
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(accessor_index));
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    EXPECT_EQ(view.byteLength, accessor.count * sizeof(Value));
    std::vector<Value> result(accessor.count);
    std::memcpy(result.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
    return result;
}

}  // namespace weft::test
