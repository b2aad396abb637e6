// Finds what is under the pointer in the last picture of the simulation.
#pragma once

#include "editor/app/cards.h"
#include "editor/app/picture.h"
#include "editor/tools/picking.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace weft::editor {

/// Trees are made and moved only when somebody asks.
class PickTrees {
  public:
    /// The surfaces of a picture; valid until the next call. Hidden and locked objects cannot be picked.
    PickScene scene(const Picture& picture, const ViewMarks& marks);
    /// The triangles of a cloth as they are in the picture.
    static MeshView mesh_of_cloth(const Picture& picture, std::size_t cloth);
    /// After scene().
    const TriangleTree* tree_of_cloth(std::size_t cloth) const { return cloths_[cloth].tree; }

    static std::string name_of_cloth(const Picture& picture, std::size_t cloth);
    static std::string name_of_collider(const Picture& picture, std::size_t collider);

  private:
    std::map<std::string, SurfaceTree> cloth_trees_;
    std::map<std::uint64_t, std::unique_ptr<TriangleTree>> collider_trees_;  ///< by id
    std::vector<PickSurface> cloths_, colliders_;
};

}  // namespace weft::editor
