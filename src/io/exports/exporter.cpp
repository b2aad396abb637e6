#include "io/exports/exporter.h"

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
    std::uint64_t size_##name(std::span<const ExportSurface> surfaces);
#define WEFT_FILM(name, ending, what) std::unique_ptr<Exporter> make_##name(const fs::path& path);
#include "io/exports/exports.def"
#undef WEFT_STILL
#undef WEFT_FILM

namespace {

struct Writers {
    StillWriter still = nullptr;
    StillSize still_size = nullptr;
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
#define WEFT_STILL(name, ending, what) {.still = write_##name, .still_size = size_##name},
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

    Result<ExportEstimate> estimate(const ExportInfo&, std::span<const ExportSurface> surfaces) const override {
        return ExportEstimate{{path_}, size_(surfaces)};
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

class SequenceExporter : public Exporter {
  public:
    SequenceExporter(const Writers& format, const fs::path& path, FilePattern pattern)
        : writer_(format.still),
          size_(format.still_size),
          path_(path),
          folder_(folder_of(path)),
          pattern_(std::move(pattern)) {}

    Result<ExportEstimate> estimate(const ExportInfo& info, std::span<const ExportSurface> surfaces) const override {
        return ExportEstimate{{path_}, info.frame_count * size_(surfaces)};
    }

    Result<void> begin(const ExportInfo&) override { return check_writable(folder_ / pattern_.name(0)); }

    Result<void> write(const ExportFrame& frame) override {
        return write_still(writer_, frame, folder_ / pattern_.name(frame.index));
    }

    Result<void> finish() override { return {}; }

  private:
    StillWriter writer_;
    StillSize size_;
    fs::path path_, folder_;
    FilePattern pattern_;
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
