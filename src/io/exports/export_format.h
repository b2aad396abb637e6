// What a format in exports.def must implement, and helpers that the formats share.
#pragma once

#include "io/exports/exporter.h"
#include "io/files/atomic_file.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace weft {

/// Writes one frame to `file`. The caller has checked the frame and commits the file.
using StillWriter = Result<void> (*)(const ExportFrame& frame, AtomicFile& file);

/// An upper bound of the bytes that a StillWriter writes in any frame. Called before the run with the surfaces as they
/// are at the start.
using StillSize = std::uint64_t (*)(std::span<const ExportSurface> surfaces);

/// What a StillReader reads: one value per vertex, all cloths one after another.
struct StillVertices {
    std::vector<Vec3> positions, normals;
};
/// Reads a file of the StillWriter back, with the same bits.
using StillReader = Result<StillVertices> (*)(const std::filesystem::path& path);

/// Makes an exporter that writes the whole run to one file.
using FilmMaker = std::unique_ptr<Exporter> (*)(const std::filesystem::path& path);

/// Whether a frame can be written: at least one cloth, each with triangles whose vertices exist, one finite position
/// and one normal per vertex, UVs and colors for all vertices or for none. `where` is the file name for error messages.
Result<void> check_frame(const ExportFrame& frame, const std::string& where);

/// Whether the rigid objects of a frame can be written: finite poses and, of the first frame, meshes with triangles
/// whose vertices exist, and one finite position and one normal per vertex.
Result<void> check_solids(const ExportFrame& frame, bool is_first, const std::string& where);

/// Fails if `path` cannot be written, so that the error is reported before the run. Leaves no file behind.
Result<void> check_writable(const std::filesystem::path& path);

/// The most vertices that the surface can have during the run.
inline std::size_t most_vertices(const ExportSurface& surface) {
    return surface.positions.size() + surface.spare_vertices;
}

/// The unit normal for an exported file: `normal` normalized, or +y for vertices of degenerate triangles.
Vec3 unit_normal(Vec3 normal);

}  // namespace weft
