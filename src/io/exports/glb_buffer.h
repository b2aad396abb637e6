// The binary part of a .glb while it is collected. Section numbers refer to the glTF 2.0 specification.
#pragma once

#include "io/files/buffered_file.h"

#include <weft/mesh.h>
#include <weft/result.h>
#include <weft/vector.h>

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace weft {

inline int as_int(std::size_t value) {
    return static_cast<int>(value);
}

enum class WithBounds { no, yes };

/// Collects the data in a nameless file and describes them by views and accessors of a model.
class GlbBuffer {
  public:
    explicit GlbBuffer(tinygltf::Model& model) : model_(model) {}

    /// Opens the nameless file in the folder of `path`, which is its name in error messages.
    Result<void> open(const std::filesystem::path& path);
    BufferedFile& file() { return file_; }
    std::uint64_t size() const { return file_.size(); }

    /// Opens a view at the end of the data, and an accessor for the whole view. The caller appends the values.
    tinygltf::Accessor& open_accessor(int component, int type, std::size_t count, int target);
    int newest_accessor() const { return as_int(model_.accessors.size()) - 1; }
    Result<void> append(std::span<const std::byte> bytes) { return file_.write(bytes); }

    /// Each adds a view and an accessor, and returns the number of the accessor.
    Result<int> add_vectors(std::span<const Vec3> values, WithBounds bounds);
    Result<int> add_indices(std::span<const Triangle> triangles, std::size_t vertices);
    /// For an animation: values without a target.
    Result<int> add_keys(std::span<const float> values, int type);

    /// Adds a view without an accessor, for an image. Returns its number.
    Result<int> add_picture(std::span<const std::byte> bytes);

  private:
    tinygltf::Model& model_;
    BufferedFile file_;
};

}  // namespace weft
