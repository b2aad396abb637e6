// PC2 point cache: the positions of every vertex in every frame, and beside it the mesh that they move, as .obj.
//
//     "POINTCACHE2\0", int32 version = 1, int32 points, float32 first frame, float32 frames per sample, int32 samples,
//     then float32 x, y, z of every point of every sample; all little-endian
//
// All cloths form one mesh, one after another, because the format has a single list of points. Readers match it to the
// mesh only by the number and order of vertices, and readers of .obj drop vertices that no face uses: both files leave
// them out. Both files have the coordinates of the scene.
//
// During the run the samples go to an unnamed temporary file. If cloth has parted, vertices that earlier samples lack
// are appended when they are copied from there to the .pc2.
#include "io/exports/constant_mesh.h"
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

/// The vertices that faces use, ascending. Readers of .obj skip triangles that are no faces.
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

/// What of a cloth is in both files.
struct KeptCloth {
    std::vector<std::uint32_t> vertices;   ///< of the constant mesh, ascending; the appended ones are all used
    std::vector<Vec3> positions, normals;  ///< of all vertices, in the first frame

    /// Appends the vertices that have been added to the mesh.
    void follow(const ConstantMesh& mesh);
    /// Appends the values that an earlier sample lacks, one per kept vertex.
    void widen(const ConstantMesh& mesh, std::vector<Vec3>& values) const;
};

void KeptCloth::follow(const ConstantMesh& mesh) {
    for (std::size_t v = positions.size(); v < mesh.vertex_count(); ++v)
        vertices.push_back(static_cast<std::uint32_t>(v));
    mesh.widen(positions);
    mesh.widen(normals);
}

void KeptCloth::widen(const ConstantMesh& mesh, std::vector<Vec3>& values) const {
    for (std::size_t i = values.size(); i < vertices.size(); ++i) {
        const auto parent = std::ranges::lower_bound(vertices, mesh.parent(vertices[i]));
        values.push_back(values[static_cast<std::size_t>(parent - vertices.begin())]);
    }
}

class Pc2Exporter : public Exporter {
  public:
    explicit Pc2Exporter(std::filesystem::path path)
        : path_(std::move(path)), rest_path_(std::filesystem::path(path_).replace_extension(".obj")) {}

    Result<ExportEstimate> estimate(const ExportInfo& info, const ExportFrame& start) const override;
    Result<void> begin(const ExportInfo& info) override;
    Result<void> write(const ExportFrame& frame) override;
    Result<void> finish() override;

  private:
    Result<void> check_counts(std::uint64_t points, std::uint64_t samples) const;
    void keep(const ExportFrame& frame);
    TriangleMesh rest_mesh() const;
    Result<void> write_samples(BufferedFile& to);
    Error error(std::string what) const { return {path_.string(), std::move(what)}; }

    std::filesystem::path path_, rest_path_;
    std::string name_;
    ConstantMeshes meshes_;
    std::vector<KeptCloth> kept_;  ///< by cloth
    BufferedFile spool_;
    std::vector<std::vector<std::size_t>> samples_;  ///< vertices by cloth
    std::vector<Vec3> sample_;
};

Result<void> Pc2Exporter::check_counts(std::uint64_t points, std::uint64_t samples) const {
    if (points <= most && samples <= most) return {};
    return error("would take " + std::to_string(samples) + " frames of " + std::to_string(points) +
                 " vertices, but a .pc2 can have at most " + std::to_string(most) + " of each");
}

Result<ExportEstimate> Pc2Exporter::estimate(const ExportInfo& info, const ExportFrame& start) const {
    std::uint64_t points = 0;
    for (const ExportSurface& surface : start.surfaces) points += most_vertices(surface);
    if (Result<void> checked = check_counts(points, info.frame_count); !checked) return checked.errors();
    return ExportEstimate{{path_, rest_path_},
                          sizeof(Header) + info.frame_count * points * sizeof(Vec3) + size_obj(start.surfaces)};
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

void Pc2Exporter::keep(const ExportFrame& frame) {
    if (kept_.empty()) {
        if (name_.empty()) name_ = frame.surfaces.front().name;
        for (const ExportSurface& surface : frame.surfaces) {
            kept_.push_back({.vertices = used_vertices(surface),
                             .positions = {surface.positions.begin(), surface.positions.end()},
                             .normals = {surface.normals.begin(), surface.normals.end()}});
        }
    }
    for (std::size_t i = 0; i < kept_.size(); ++i) kept_[i].follow(meshes_[i]);
}

Result<void> Pc2Exporter::write(const ExportFrame& frame) {
    if (Result<void> checked = check_frame(frame, path_.string()); !checked) return checked;
    if (std::string problem = meshes_.follow(frame); !problem.empty()) return error(std::move(problem));
    keep(frame);
    sample_.clear();
    std::vector<std::size_t>& counts = samples_.emplace_back();
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        counts.push_back(kept_[i].vertices.size());
        for (const std::uint32_t v : kept_[i].vertices) sample_.push_back(meshes_.surfaces()[i].positions[v]);
    }
    if (sample_.empty()) return error("no triangle has three different corners");
    if (Result<void> checked = check_counts(sample_.size(), samples_.size()); !checked) return checked;
    return spool_.write(std::as_bytes(std::span(sample_)));
}

/// All cloths as one mesh, without what readers drop.
TriangleMesh Pc2Exporter::rest_mesh() const {
    TriangleMesh rest;
    bool with_uvs = false;
    for (std::size_t i = 0; i < kept_.size(); ++i) with_uvs = with_uvs || !meshes_[i].uvs().empty();
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        const KeptCloth& kept = kept_[i];
        const ConstantMesh& mesh = meshes_[i];
        std::vector<std::uint32_t> renumbered(mesh.vertex_count(), none);
        for (const std::uint32_t v : kept.vertices) {
            renumbered[v] = static_cast<std::uint32_t>(rest.positions.size());
            rest.positions.push_back(kept.positions[v]);
            rest.normals.push_back(kept.normals[v]);
            if (with_uvs) rest.uvs.push_back(mesh.uvs().empty() ? Vec2{} : mesh.uvs()[v]);
        }
        for (const Triangle& t : mesh.triangles())
            if (is_face(t)) rest.triangles.push_back({renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]});
    }
    return rest;
}

Result<void> Pc2Exporter::write_samples(BufferedFile& to) {
    if (!meshes_.have_grown()) return spool_.move_to(to);
    std::vector<Vec3> values;
    for (const std::vector<std::size_t>& counts : samples_) {
        for (std::size_t i = 0; i < kept_.size(); ++i) {
            values.resize(counts[i]);
            if (Result<void> r = spool_.take(std::as_writable_bytes(std::span(values))); !r) return r;
            kept_[i].widen(meshes_[i], values);
            if (Result<void> r = to.write(std::as_bytes(std::span(values))); !r) return r;
        }
    }
    return {};
}

Result<void> Pc2Exporter::finish() {
    if (samples_.empty()) return error("there is no frame to write");
    const TriangleMesh mesh = rest_mesh();
    Result<AtomicFile> cache = AtomicFile::create(path_);
    if (!cache) return cache.errors();
    const Header header{.points = static_cast<std::int32_t>(mesh.positions.size()),
                        .samples = static_cast<std::int32_t>(samples_.size())};
    if (Result<void> r = cache->write(std::as_bytes(std::span(&header, 1))); !r) return r;
    if (Result<void> r = write_samples(cache->content()); !r) return r;
    if (Result<void> r = cache->prepare(); !r) return r;

    Result<AtomicFile> rest = AtomicFile::create(rest_path_);
    if (!rest) return rest.errors();
    const ExportSurface surface = surface_of(name_, mesh, mesh.positions, mesh.normals);
    if (Result<void> r = write_obj({0, 0, std::span(&surface, 1)}, *rest); !r) return r;
    if (Result<void> r = rest->prepare(); !r) return r;

    if (Result<void> r = rest->commit(); !r) return r;
    return cache->commit();
}

}  // namespace

std::unique_ptr<Exporter> make_pc2(const std::filesystem::path& path) {
    return std::make_unique<Pc2Exporter>(path);
}

}  // namespace weft
