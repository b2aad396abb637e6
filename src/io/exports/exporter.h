// Export of simulation results: one interface for all formats, which are chosen by the ending of the file name.
#pragma once

#include "look/drawn_solid.h"
#include "look/drawn_surface.h"
#include "mesh/triangle_mesh.h"

#include <weft/result.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// The spans are read only during write().
using ExportSurface = DrawnSurface;

/// A collider, for formats that hold rigid objects. The mesh is read only in the first frame.
using ExportSolid = DrawnSolid;

/// A surface of `mesh`, optionally with other positions and normals.
inline ExportSurface surface_of(std::string_view name, const TriangleMesh& mesh, std::span<const Vec3> positions,
                                std::span<const Vec3> normals) {
    return {.name = name,
            .positions = positions,
            .normals = normals,
            .triangles = mesh.triangles,
            .uvs = mesh.uvs,
            .colors = mesh.colors,
            .rest_positions = mesh.positions};
}

/// All cloths and the exported colliders in one frame. Every frame of a run has the same cloths and the same colliders
/// in the same order; formats of cloth alone ignore the colliders. Cloth may part and triangles
/// may be removed: all frames of an animation still have the same vertices and triangles (constant_mesh.h). Other
/// changes of the triangles are an error of the formats that hold a whole animation in one file.
struct ExportFrame {
    std::uint64_t index = 0;
    double time = 0;  ///< s
    std::span<const ExportSurface> surfaces;
    std::span<const ExportSolid> solids = {};
};

struct ExportInfo {
    std::string scene_name;
    double frame_rate = 60;
    std::uint64_t frame_count = 0;      ///< frames that will be written, including the start
    std::filesystem::path folder = {};  ///< where the image files of materials are searched, as in find_asset
};

/// The files that an export will write, and their size.
struct ExportEstimate {
    std::vector<std::filesystem::path> files;  ///< for a sequence: the name with its `%d`
    std::uint64_t bytes = 0;  ///< of all files together; an upper bound, with all vertices that cloth may still get
};

/// Call begin(), then write() once per frame, then finish(). A file gets its final name only in finish(), the files of
/// a sequence as soon as their frame is complete. If cloth has parted, finish() writes the earlier files of a sequence
/// again, with the vertices and triangles of the last frame. An exporter destroyed before finish() leaves nothing
/// behind, except the complete files of a sequence. After an error an exporter can only be destroyed.
class Exporter {
  public:
    virtual ~Exporter() = default;
    /// Called before the run with everything as it starts. Fails if the format cannot hold the announced run.
    virtual Result<ExportEstimate> estimate(const ExportInfo& info, const ExportFrame& start) const = 0;
    virtual Result<void> begin(const ExportInfo& info) = 0;
    virtual Result<void> write(const ExportFrame& frame) = 0;
    virtual Result<void> finish() = 0;
};

/// The ending of `path` selects the format: `.glb`, `.pc2` (animated), `.obj`, `.ply` (the last frame). A `%d` or
/// `%0Nd` in the file name selects a sequence (`frames/%04d.obj`). Fails on an unknown ending, or if the folder cannot
/// be made.
Result<std::unique_ptr<Exporter>> make_exporter(const std::filesystem::path& path);

struct ExportFormat {
    std::string_view ending;  ///< including the dot
    std::string_view what;
};
std::span<const ExportFormat> export_formats();

}  // namespace weft
