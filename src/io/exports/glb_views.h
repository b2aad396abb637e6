// The binary part of a .glb in which cloth has parted: its views get the vertices that were appended during the run.
#pragma once

#include "io/exports/constant_mesh.h"
#include "io/files/buffered_file.h"

#include <weft/result.h>

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Component type of the indices of a primitive with so many vertices.
int index_type(std::size_t vertices);
/// The indices as a view holds them, padded to four bytes.
std::vector<std::byte> index_bytes(std::span<const Triangle> triangles, std::size_t vertices);

/// Views of the model whose data were collected in one file, without gaps, when some vertices did not exist yet.
class WideViews {
  public:
    /// Gives the views and accessors of `model` the final number of vertices. Mesh i of the model shows mesh i of
    /// `meshes`. `collected`: bytes of the file.
    WideViews(tinygltf::Model& model, const ConstantMeshes& meshes, std::uint64_t collected);

    std::uint64_t bytes() const { return bytes_; }
    /// Appends the data of all views to `to`.
    Result<void> write(BufferedFile& collected, BufferedFile& to) const;

  private:
    struct View {
        std::uint64_t collected = 0;         ///< bytes
        const ConstantMesh* mesh = nullptr;  ///< null: the data stay as they are
        std::size_t value_bytes = 0;         ///< of a vertex; 0: indices
    };
    void show_mesh(tinygltf::Model& model, int accessor_index, const ConstantMesh& mesh);

    std::vector<View> views_;
    std::uint64_t bytes_ = 0;
};

}  // namespace weft
