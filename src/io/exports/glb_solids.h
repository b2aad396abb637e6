// Rigid objects in a .glb: each is a node with a mesh that keeps its shape, and a pose per frame.
#pragma once

#include "io/exports/exporter.h"
#include "io/exports/glb_buffer.h"
#include "io/exports/glb_material.h"

#include <weft/result.h>

#include <tiny_gltf.h>

#include <span>
#include <string>
#include <vector>

namespace weft {

/// Adds rigid objects to a model. Of each frame only the poses are kept, seven floats per object.
class GlbSolids {
  public:
    GlbSolids(tinygltf::Model& model, GlbBuffer& buffer, GltfMaterials& materials)
        : model_(model), buffer_(buffer), materials_(materials) {}

    /// Upper bounds for the file: of the meshes and nodes, and of the poses in one frame.
    static double mesh_bytes(std::span<const ExportSolid> solids);
    static double pose_bytes(std::span<const ExportSolid> solids);

    /// Adds the nodes of the first frame, at their poses in it.
    Result<void> add_nodes(std::span<const ExportSolid> solids);
    /// Keeps the poses of a frame. Returns an empty text, or why these are not the objects of the first frame: "it …".
    std::string add_poses(std::span<const ExportSolid> solids);

    bool empty() const { return tracks_.empty(); }
    /// Whether any object has moved since the first frame.
    bool have_moved() const;
    /// Adds a translation and a rotation to each object that has moved, with one key per frame. `times`: the accessor
    /// of the keys' times.
    Result<void> add_channels(int times, tinygltf::Animation& animation) const;

  private:
    struct Track {
        std::string name;
        int node = 0;
        std::vector<float> translations, rotations;  ///< three and four floats per frame
        bool has_moved = false;
    };
    Result<tinygltf::Primitive> add_mesh(const TriangleMesh& mesh);
    Result<int> add_material(const ExportSolid& solid);

    tinygltf::Model& model_;
    GlbBuffer& buffer_;
    GltfMaterials& materials_;
    std::vector<Track> tracks_;
};

}  // namespace weft
