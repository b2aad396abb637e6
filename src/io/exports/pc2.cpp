// PC2 point cache: the positions of every vertex in every frame, and beside it the mesh that they move, as .obj.
//
//     "POINTCACHE2\0", int32 version = 1, int32 points, float32 first frame, float32 frames per sample, int32 samples,
//     then float32 x, y, z of every point of every sample; all little-endian
//
// All cloths form one mesh, one after another, because the format has a single list of points. Readers match it to the
// mesh only by the number and order of vertices, and readers of .obj drop vertices that no face uses: both files leave
// them out. Both files have the coordinates of the scene.
#include "io/exports/export_format.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace weft {
std::unique_ptr<Exporter> make_pc2(const std::filesystem::path& path);
Result<void> write_obj(const ExportFrame& frame, AtomicFile& file);
std::uint64_t size_obj(std::span<const ExportSurface> surfaces);

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

struct Header {
    std::array<char, 12> signature{'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', '\0'};
    std::int32_t version = 1;
    std::int32_t points = 0;
    float first_frame = 0;
    float frames_per_sample = 1;
    std::int32_t samples = 0;
};
static_assert(sizeof(Header) == 32);

constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();

/// Whether a triangle has three different corners. Readers of .obj skip other faces.
bool is_face(const Triangle& t) {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

/// The vertices that faces use, ascending.
std::vector<std::uint32_t> used_vertices(const ExportSurface& surface) {
    const std::size_t vertex_count = surface.positions.size();
    std::vector<bool> used(vertex_count);
    for (const Triangle& triangle : surface.triangles) {
        if (!is_face(triangle)) continue;
        for (const std::uint32_t vertex : triangle) used[vertex] = true;
    }
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        if (used[v]) vertices.push_back(v);
    }
    return vertices;
}

/// The numbers of vertices and triangles, and the topology version.
std::array<std::uint64_t, 3> shape_of(const ExportSurface& surface) {
    return {surface.positions.size(), surface.triangles.size(), surface.topology_version};
}

/// All cloths as one mesh, without what readers drop.
struct RestMesh {
    TriangleMesh mesh;
    std::vector<std::vector<std::uint32_t>> kept;     ///< per cloth: its vertices that are in `mesh`, ascending
    std::vector<std::array<std::uint64_t, 3>> shape;  ///< per cloth

    void add(const ExportSurface& surface, bool with_uvs);
};

void RestMesh::add(const ExportSurface& surface, bool with_uvs) {
    const std::vector<std::uint32_t>& vertices = kept.emplace_back(used_vertices(surface));
    shape.push_back(shape_of(surface));
    std::vector<std::uint32_t> renumbered(surface.positions.size(), none);
    for (const std::uint32_t v : vertices) {
        renumbered[v] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(surface.positions[v]);
        mesh.normals.push_back(surface.normals[v]);
        if (with_uvs) mesh.uvs.push_back(surface.uvs.empty() ? Vec2{} : surface.uvs[v]);
    }
    for (const Triangle& t : surface.triangles) {
        if (is_face(t)) mesh.triangles.push_back({renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]});
    }
}

class Pc2Exporter : public Exporter {
  public:
    explicit Pc2Exporter(std::filesystem::path path)
        : path_(std::move(path)), rest_path_(std::filesystem::path(path_).replace_extension(".obj")) {}

    Result<ExportEstimate> estimate(const ExportInfo& info, std::span<const ExportSurface> surfaces) const override;
    Result<void> begin(const ExportInfo& info) override;
    Result<void> write(const ExportFrame& frame) override;
    Result<void> finish() override;

  private:
    Result<void> check_counts(std::uint64_t points, std::uint64_t samples) const;
    Result<void> check_shape(const ExportFrame& frame) const;
    void keep_rest_mesh(const ExportFrame& frame);
    Result<void> write_rest_mesh(AtomicFile& file) const;
    Error error(std::string what) const { return {path_.string(), std::move(what)}; }

    std::filesystem::path path_, rest_path_;
    std::string name_;
    RestMesh rest_;
    BufferedFile spool_;
    std::uint64_t samples_ = 0;
    std::vector<Vec3> sample_;
};

Result<void> Pc2Exporter::check_counts(std::uint64_t points, std::uint64_t samples) const {
    if (points <= most && samples <= most) return {};
    return error("would take " + std::to_string(samples) + " frames of " + std::to_string(points) +
                 " vertices, but a .pc2 can have at most " + std::to_string(most) + " of each");
}

Result<ExportEstimate> Pc2Exporter::estimate(const ExportInfo& info, std::span<const ExportSurface> surfaces) const {
    std::uint64_t points = 0;
    for (const ExportSurface& surface : surfaces) points += surface.positions.size();
    if (Result<void> checked = check_counts(points, info.frame_count); !checked) return checked.errors();
    return ExportEstimate{{path_, rest_path_},
                          sizeof(Header) + info.frame_count * points * sizeof(Vec3) + size_obj(surfaces)};
}

Result<void> Pc2Exporter::begin(const ExportInfo& info) {
    name_ = info.scene_name;
    for (const std::filesystem::path& path : {path_, rest_path_}) {
        if (Result<void> writable = check_writable(path); !writable) return writable;
    }
    Result<BufferedFile> spool = BufferedFile::open_nameless(folder_of(path_), path_.string());
    if (!spool) return spool.errors();
    spool_ = *std::move(spool);
    return {};
}

Result<void> Pc2Exporter::check_shape(const ExportFrame& frame) const {
    const std::string which = "frame " + std::to_string(frame.index) + ": ";
    if (frame.surfaces.size() != rest_.shape.size()) {
        return error(which + "it does not have the cloths of the first frame");
    }
    for (std::size_t i = 0; i < rest_.shape.size(); ++i) {
        const ExportSurface& surface = frame.surfaces[i];
        if (rest_.shape[i] == shape_of(surface)) continue;
        return error(which + "cloth \"" + std::string(surface.name) +
                     "\" has other vertices or triangles than in the first frame, which a .pc2 cannot hold; " +
                     "write a sequence instead");
    }
    return {};
}

void Pc2Exporter::keep_rest_mesh(const ExportFrame& frame) {
    const bool with_uvs =
        std::ranges::any_of(frame.surfaces, [](const ExportSurface& surface) { return !surface.uvs.empty(); });
    for (const ExportSurface& surface : frame.surfaces) rest_.add(surface, with_uvs);
    if (name_.empty()) name_ = frame.surfaces.front().name;
}

Result<void> Pc2Exporter::write(const ExportFrame& frame) {
    if (Result<void> checked = check_frame(frame, path_.string()); !checked) return checked;
    if (samples_ == 0) keep_rest_mesh(frame);
    if (Result<void> checked = check_shape(frame); !checked) return checked;
    if (Result<void> checked = check_counts(rest_.mesh.positions.size(), samples_ + 1); !checked) return checked;
    if (rest_.mesh.triangles.empty()) return error("no triangle has three different corners");
    sample_.clear();
    for (std::size_t i = 0; i < frame.surfaces.size(); ++i) {
        for (const std::uint32_t v : rest_.kept[i]) sample_.push_back(frame.surfaces[i].positions[v]);
    }
    ++samples_;
    return spool_.write(std::as_bytes(std::span(sample_)));
}

Result<void> Pc2Exporter::write_rest_mesh(AtomicFile& file) const {
    const ExportSurface surface = surface_of(name_, rest_.mesh, rest_.mesh.positions, rest_.mesh.normals);
    return write_obj({0, 0, std::span(&surface, 1)}, file);
}

Result<void> Pc2Exporter::finish() {
    if (samples_ == 0) return error("there is no frame to write");
    Result<AtomicFile> cache = AtomicFile::create(path_);
    if (!cache) return cache.errors();
    const Header header{.points = static_cast<std::int32_t>(rest_.mesh.positions.size()),
                        .samples = static_cast<std::int32_t>(samples_)};
    if (Result<void> r = cache->write(std::as_bytes(std::span(&header, 1))); !r) return r;
    if (Result<void> r = spool_.move_to(cache->content()); !r) return r;
    if (Result<void> r = cache->prepare(); !r) return r;

    Result<AtomicFile> rest = AtomicFile::create(rest_path_);
    if (!rest) return rest.errors();
    if (Result<void> r = write_rest_mesh(*rest); !r) return r;
    if (Result<void> r = rest->prepare(); !r) return r;

    if (Result<void> r = rest->commit(); !r) return r;
    return cache->commit();
}

}  // namespace

std::unique_ptr<Exporter> make_pc2(const std::filesystem::path& path) {
    return std::make_unique<Pc2Exporter>(path);
}

}  // namespace weft
