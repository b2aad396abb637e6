// What a format must offer to stand in exports.def, and what the formats share.
#pragma once

#include "io/exports/exporter.h"
#include "io/files/atomic_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace weft {

/// A format of one instant. The caller has checked the frame and commits the file.
using StillWriter = Result<Done> (*)(const ExportFrame& frame, AtomicFile& file);

/// About how many bytes a StillWriter writes; rather too many than too few. Called before the run, when every surface
/// is there as it will be at the start.
using StillSize = std::uint64_t (*)(std::span<const ExportSurface> surfaces);

/// A format that holds the whole run.
using FilmMaker = std::unique_ptr<Exporter> (*)(const std::filesystem::path& path);

/// Whether a frame can be written: at least one cloth, each with triangles whose vertices exist, one finite position
/// and one normal per vertex, UVs and colors for all vertices or for none. `where` is the file's name.
Result<Done> check_frame(const ExportFrame& frame, const std::string& where);

/// Fails where `path` cannot be written, so that it is known before the run and not after it. Leaves nothing behind.
Result<Done> check_writable(const std::filesystem::path& path);

/// `normal` as readers of a file expect it: a vertex of degenerate triangles has none, and gets +y.
Vec3 unit_normal(Vec3 normal);

}  // namespace weft
