// Writing what was simulated: one interface for every format, chosen by a file name's ending.
#pragma once

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

/// Spans are read during write alone.
using ExportSurface = DrawnSurface;

/// A mesh as a surface, in its place or with other positions and normals.
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

/// Everything at one instant. The same cloths in the same order in every frame of a run. Formats that hold a whole film
/// in one file hold one topology: they fail on a frame whose topology versions are not those of the first one.
struct ExportFrame {
    std::uint64_t index = 0;
    double time = 0;  ///< s
    std::span<const ExportSurface> surfaces;
};

struct ExportInfo {
    std::string scene_name;
    double frame_rate = 60;
    std::uint64_t frame_count = 0;      ///< frames that will be written, the start included
    std::filesystem::path folder = {};  ///< where pictures that materials name are looked for, as in find_asset
};

/// What an export will leave on the disk.
struct ExportEstimate {
    std::vector<std::filesystem::path> files;  ///< a sequence: the name with its `%d`
    std::uint64_t bytes = 0;                   ///< of all of them together; rather too many than too few
};

/// begin, then write once per frame, then finish. Nothing appears under the final name before finish (a sequence:
/// before its frame is whole); an exporter destroyed early leaves nothing behind, a sequence its whole frames. After an
/// error an exporter is only good for being destroyed.
class Exporter {
  public:
    virtual ~Exporter() = default;
    /// Before the run, from the cloths as they start. Fails where the format cannot hold what is announced.
    virtual Result<ExportEstimate> estimate(const ExportInfo& info, std::span<const ExportSurface> surfaces) const = 0;
    virtual Result<Done> begin(const ExportInfo& info) = 0;
    virtual Result<Done> write(const ExportFrame& frame) = 0;
    virtual Result<Done> finish() = 0;
};

/// By the ending of `path`: `.glb`, `.pc2` (animated), `.obj`, `.ply` (the last frame), or a sequence where the file
/// name holds one `%d` or `%0Nd` (`frames/%04d.obj`). Fails on an unknown ending or a folder that cannot be made.
Result<std::unique_ptr<Exporter>> make_exporter(const std::filesystem::path& path);

struct ExportFormat {
    std::string_view ending;  ///< with the dot
    std::string_view what;
};
std::span<const ExportFormat> export_formats();

}  // namespace weft
