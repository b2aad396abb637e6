#include "io/exports/exporter.h"

#include "io/exports/constant_mesh.h"
#include "io/exports/export_format.h"
#include "io/files/file_pattern.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace fs = std::filesystem;

#define WEFT_STILL(name, ending, what)                                     \
    Result<void> write_##name(const ExportFrame& frame, AtomicFile& file); \
    std::uint64_t size_##name(std::span<const ExportSurface> surfaces);    \
    Result<StillVertices> read_##name(const fs::path& path);
#define WEFT_FILM(name, ending, what) std::unique_ptr<Exporter> make_##name(const fs::path& path);
#include "io/exports/exports.def"
#undef WEFT_STILL
#undef WEFT_FILM

namespace {

struct Writers {
    StillWriter still = nullptr;
    StillSize still_size = nullptr;
    StillReader still_reader = nullptr;
    FilmMaker film = nullptr;
};

constexpr std::array formats = {
#define WEFT_STILL(name, ending, what) ExportFormat{ending, what},
#define WEFT_FILM(name, ending, what) ExportFormat{ending, what},
#include "io/exports/exports.def"
#undef WEFT_STILL
#undef WEFT_FILM
};

constexpr std::array<Writers, formats.size()> writers = {{
#define WEFT_STILL(name, ending, what) {.still = write_##name, .still_size = size_##name, .still_reader = read_##name},
#define WEFT_FILM(name, ending, what) {.film = make_##name},
#include "io/exports/exports.def"
#undef WEFT_STILL
#undef WEFT_FILM
}};

Result<void> write_still(StillWriter writer, const ExportFrame& frame, const fs::path& path) {
    if (Result<void> checked = check_frame(frame, path.string()); !checked) return checked;
    return write_atomically(path, [&](AtomicFile& file) { return writer(frame, file); });
}

/// Keeps the newest frame and writes it in finish(), because the last frame is not known earlier.
class LastFrameExporter : public Exporter {
  public:
    LastFrameExporter(const Writers& format, fs::path path)
        : writer_(format.still), size_(format.still_size), path_(std::move(path)) {}

    Result<ExportEstimate> estimate(const ExportInfo&, const ExportFrame& start) const override {
        return ExportEstimate{{path_}, size_(start.surfaces)};
    }

    Result<void> begin(const ExportInfo&) override { return check_writable(path_); }

    Result<void> write(const ExportFrame& frame) override {
        index_ = frame.index;
        time_ = frame.time;
        surfaces_.resize(frame.surfaces.size());
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            const ExportSurface& from = frame.surfaces[i];
            Surface& to = surfaces_[i];
            to.name = from.name;
            to.positions.assign(from.positions.begin(), from.positions.end());
            to.normals.assign(from.normals.begin(), from.normals.end());
            if (to.topology_version == from.topology_version) continue;
            to.topology_version = from.topology_version;
            to.triangles.assign(from.triangles.begin(), from.triangles.end());
            to.uvs.assign(from.uvs.begin(), from.uvs.end());
            to.colors.assign(from.colors.begin(), from.colors.end());
        }
        return {};
    }

    Result<void> finish() override {
        std::vector<ExportSurface> views;
        for (const Surface& s : surfaces_) {
            views.push_back({.name = s.name,
                             .positions = s.positions,
                             .normals = s.normals,
                             .triangles = s.triangles,
                             .uvs = s.uvs,
                             .colors = s.colors,
                             .rest_positions = {}});
        }
        return write_still(writer_, {index_, time_, views}, path_);
    }

  private:
    struct Surface {
        std::string name;
        std::vector<Vec3> positions, normals;
        std::vector<Triangle> triangles;
        std::vector<Vec2> uvs;
        std::vector<Vec4> colors;
        std::uint64_t topology_version = 0;  ///< of the triangles, UVs and colors; 0: none yet
    };

    StillWriter writer_;
    StillSize size_;
    fs::path path_;
    std::uint64_t index_ = 0;
    double time_ = 0;
    std::vector<Surface> surfaces_;
};

/// Writes each frame at once. What parts later is not known then, so finish() appends the vertices to earlier files.
class SequenceExporter : public Exporter {
  public:
    SequenceExporter(const Writers& format, const fs::path& path, FilePattern pattern)
        : writer_(format.still),
          size_(format.still_size),
          reader_(format.still_reader),
          path_(path),
          folder_(folder_of(path)),
          pattern_(std::move(pattern)) {}

    Result<ExportEstimate> estimate(const ExportInfo& info, const ExportFrame& start) const override {
        return ExportEstimate{{path_}, info.frame_count * size_(start.surfaces)};
    }

    Result<void> begin(const ExportInfo&) override { return check_writable(folder_ / pattern_.name(0)); }

    Result<void> write(const ExportFrame& frame) override {
        const fs::path path = file_of(frame.index);
        if (Result<void> checked = check_frame(frame, path.string()); !checked) return checked;
        if (const bool is_other_cloth = !meshes_.follow(frame).empty(); is_other_cloth) {
            if (Result<void> finished = finish(); !finished) return finished;
            meshes_ = {};
            (void)meshes_.follow(frame);
        }
        Written written{frame.index, frame.time, {}};
        for (const ExportSurface& surface : meshes_.surfaces()) written.counts.push_back(surface.positions.size());
        written_.push_back(std::move(written));
        return write_still(writer_, {frame.index, frame.time, meshes_.surfaces()}, path);
    }

    Result<void> finish() override {
        for (const Written& written : written_) {
            bool is_complete = true;
            for (std::size_t i = 0; i < meshes_.size(); ++i)
                is_complete = is_complete && written.counts[i] == meshes_[i].vertex_count();
            if (is_complete) continue;
            if (Result<void> done = widen(written); !done) return done;
        }
        written_.clear();
        return {};
    }

  private:
    struct Written {
        std::uint64_t index = 0;
        double time = 0;
        std::vector<std::size_t> counts;  ///< vertices by cloth
    };

    fs::path file_of(std::uint64_t index) const { return folder_ / pattern_.name(index); }

    /// Writes a file again with the vertices and triangles of the last frame.
    Result<void> widen(const Written& written) const {
        const fs::path path = file_of(written.index);
        Result<StillVertices> vertices = reader_(path);
        if (!vertices) return vertices.errors();
        std::size_t expected = 0;
        for (const std::size_t count : written.counts) expected += count;
        if (vertices->positions.size() != expected || vertices->normals.size() != expected)
            return Error{path.string(), "was changed by another program before the run was complete"};

        std::vector<StillVertices> wide(meshes_.size());
        std::vector<ExportSurface> surfaces;
        std::size_t begin = 0;
        for (std::size_t i = 0; i < wide.size(); ++i) {
            const auto part = [&](const std::vector<Vec3>& all) {
                const auto from = all.begin() + static_cast<std::ptrdiff_t>(begin);
                std::vector<Vec3> values(from, from + static_cast<std::ptrdiff_t>(written.counts[i]));
                meshes_[i].widen(values);
                return values;
            };
            wide[i] = {part(vertices->positions), part(vertices->normals)};
            begin += written.counts[i];
            surfaces.push_back({.name = meshes_[i].name(),
                                .positions = wide[i].positions,
                                .normals = wide[i].normals,
                                .triangles = meshes_[i].triangles(),
                                .uvs = meshes_[i].uvs(),
                                .colors = meshes_[i].colors(),
                                .rest_positions = {}});
        }
        return write_still(writer_, {written.index, written.time, surfaces}, path);
    }

    StillWriter writer_;
    StillSize size_;
    StillReader reader_;
    fs::path path_, folder_;
    FilePattern pattern_;
    ConstantMeshes meshes_;
    std::vector<Written> written_;
};

/// The endings of the formats that can be written as sequences.
std::string list_still_endings() {
    std::vector<ExportFormat> still;
    for (std::size_t i = 0; i < formats.size(); ++i)
        if (writers[i].still) still.push_back(formats[i]);
    return list_endings(still);
}

Result<std::unique_ptr<Exporter>> make_sequence(const fs::path& path, const Writers& writer) {
    std::optional<FilePattern> pattern = parse_pattern(path.filename().string());
    if (!pattern) return Error{path.string(), pattern_rule};
    if (writer.still == nullptr) {
        return Error{path.string(), "a " + path.extension().string() +
                                        " holds the whole animation in one file; sequences are made of " +
                                        list_still_endings()};
    }
    return std::unique_ptr<Exporter>(std::make_unique<SequenceExporter>(writer, path, *std::move(pattern)));
}

}  // namespace

std::span<const ExportFormat> export_formats() {
    return formats;
}

Result<std::unique_ptr<Exporter>> make_exporter(const fs::path& path) {
    const auto format = std::ranges::find(formats, ending_of(path), &ExportFormat::ending);
    if (format == formats.end()) return unknown_ending(path, "known are " + list_endings(formats));
    const Writers& writer = writers[static_cast<std::size_t>(format - formats.begin())];

    std::unique_ptr<Exporter> exporter;
    if (has_pattern(path)) {
        Result<std::unique_ptr<Exporter>> sequence = make_sequence(path, writer);
        if (!sequence) return sequence;
        exporter = *std::move(sequence);
    } else if (writer.film != nullptr) {
        exporter = writer.film(path);
    } else {
        exporter = std::make_unique<LastFrameExporter>(writer, path);
    }

    if (auto made = make_folder_of(path); !made) return made.errors();
    return exporter;
}

}  // namespace weft
