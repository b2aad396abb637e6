// Animated glTF 2.0 in its binary container. The first frame is the mesh, every later frame is a morph target, and one
// animation of the weights plays them. Rigid objects are nodes whose poses the same animation moves. Section numbers
// refer to the glTF 2.0 specification (Khronos, 2021).
//
// During the run the binary data goes to an unnamed temporary file: memory holds only one frame, and a full disk is
// reported at the frame that fills it. If cloth has parted, vertices that earlier frames lack are appended when the
// data are copied from there to the .glb. tinygltf writes the JSON; this file writes the container, because tinygltf's
// own writer would hold the whole animation in memory twice.
#include "io/exports/constant_mesh.h"
#include "io/exports/export_format.h"
#include "io/exports/glb_buffer.h"
#include "io/exports/glb_material.h"
#include "io/exports/glb_solids.h"
#include "io/exports/glb_views.h"
#include "solver/state/frame.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#ifndef WEFT_VERSION
#define WEFT_VERSION "unknown"
#endif

namespace weft {
std::unique_ptr<Exporter> make_glb(const std::filesystem::path& path);

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

// The header of a .glb stores the length of the file in 32 bits (4.4.2).
constexpr double byte_limit = 4294967295.0;

// 4.4: "glTF" and the types of the two chunks.
constexpr std::uint32_t glb_magic = 0x46546c67, glb_version = 2, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr std::uint64_t header_bytes = 12, chunk_header_bytes = 8;

// Size of the JSON per cloth and frame: two accessors with their bounds and views, a target, a weight.
constexpr double json_bytes_per_target = 700;

struct FirstFrame {
    std::vector<Vec3> positions, normals;
};

/// Estimated bytes of an animation, rather too many than too few.
struct FilmSize {
    double pictures = 0;
    double solids = 0;  ///< meshes and nodes of rigid objects
    double base = 0;    ///< everything else but the poses, the morph targets and their weights
    double poses = 0;   ///< of rigid objects, per frame
    double target = 0;  ///< per frame after the first

    FilmSize() = default;
    FilmSize(const ExportFrame& start, const std::filesystem::path& folder)
        : pictures(static_cast<double>(GltfMaterials::most_picture_bytes(start.surfaces, folder))),
          solids(GlbSolids::mesh_bytes(start.solids)),
          poses(GlbSolids::pose_bytes(start.solids)) {}

    double of(double frames) const {
        return pictures + solids + base + frames * poses + (frames - 1) * target + frames * frames * sizeof(float);
    }

    void set_meshes(std::span<const ExportSurface> surfaces, std::size_t (*vertices_of)(const ExportSurface&));
};

std::size_t present_vertices(const ExportSurface& surface) {
    return surface.positions.size();
}

void FilmSize::set_meshes(std::span<const ExportSurface> surfaces, std::size_t (*vertices_of)(const ExportSurface&)) {
    base = target = 0;
    for (const ExportSurface& surface : surfaces) {
        const auto vertices = static_cast<double>(vertices_of(surface));
        const bool tangents = surface.material != nullptr &&
                              (surface.material->weave != Weave::smooth || !surface.material->normal_map.empty());
        const double vertex = 2 * sizeof(Vec3) +
                              (surface.uvs.empty() ? 0 : sizeof(Vec2) + (tangents ? sizeof(Vec4) : 0)) +
                              (surface.colors.empty() ? 0 : sizeof(Vec4));
        const double index = index_type(vertices_of(surface)) == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2 : 4;
        // The name is in the JSON, where a character may take six bytes; the rest of the JSON of a cloth is a few
        // lines.
        base += vertices * vertex + static_cast<double>(surface.triangles.size()) * 3 * index + 4096 +
                6 * static_cast<double>(surface.name.size());
        target += vertices * 2 * sizeof(Vec3) + json_bytes_per_target;
    }
}

class GlbExporter : public Exporter {
  public:
    explicit GlbExporter(std::filesystem::path path) : path_(std::move(path)) {}

    Result<ExportEstimate> estimate(const ExportInfo& info, const ExportFrame& start) const override;
    Result<void> begin(const ExportInfo& info) override;
    Result<void> write(const ExportFrame& frame) override;
    Result<void> finish() override;

  private:
    Result<void> add_first_frame(const ExportFrame& frame);
    Result<void> add_base(const ExportSurface& surface);
    Result<void> add_colors(const ExportSurface& surface, tinygltf::Primitive& primitive);
    Result<void> add_material(const ExportSurface& surface, tinygltf::Primitive& primitive);
    Result<void> add_target(std::size_t cloth, const ExportSurface& surface);
    Result<void> add_animation();
    Result<void> add_weights(int times, tinygltf::Animation& animation);
    template <class WriteBinary>
    Result<void> write_container(const std::string& json, std::uint64_t binary_bytes, WriteBinary&& write_binary);

    Result<void> check_order(const ExportFrame& frame) const;
    Result<void> check_size(const FilmSize& size, std::uint64_t frames) const;
    Result<std::string> json_text(std::uint64_t binary_bytes) const;
    Error error(std::string what) const { return {path_.string(), std::move(what)}; }

    std::filesystem::path path_;
    ExportInfo info_;
    tinygltf::Model model_;
    GlbBuffer buffer_{model_};
    GltfMaterials materials_{model_, [this](std::span<const std::byte> bytes) { return buffer_.add_picture(bytes); }};
    GlbSolids solids_{model_, buffer_, materials_};
    std::vector<float> times_;
    ConstantMeshes meshes_;
    std::vector<FirstFrame> first_;  ///< by cloth
    FilmSize size_;
    std::vector<Vec3> deltas_;
};

Result<ExportEstimate> GlbExporter::estimate(const ExportInfo& info, const ExportFrame& start) const {
    FilmSize size(start, info.folder);
    size.set_meshes(start.surfaces, present_vertices);
    if (Result<void> checked = check_size(size, info.frame_count); !checked) return checked.errors();
    // With all vertices that may be added, the limit may be passed. Whether it will be is only known then.
    size.set_meshes(start.surfaces, most_vertices);
    const double bytes = std::min(size.of(static_cast<double>(info.frame_count)), byte_limit);
    return ExportEstimate{{path_}, static_cast<std::uint64_t>(bytes)};
}

Result<void> GlbExporter::begin(const ExportInfo& info) {
    info_ = info;
    if (Result<void> writable = check_writable(path_); !writable) return writable;
    materials_.look_in(info.folder);
    return buffer_.open(path_);
}

Result<void> GlbExporter::write(const ExportFrame& frame) {
    // A frame of rigid objects alone is a film too.
    if (!frame.surfaces.empty() || frame.solids.empty()) {
        if (Result<void> checked = check_frame(frame, path_.string()); !checked) return checked;
    }
    const bool is_first = times_.empty();
    if (Result<void> checked = check_solids(frame, is_first, path_.string()); !checked) return checked;
    if (Result<void> checked = check_order(frame); !checked) return checked;
    if (std::string problem = meshes_.follow(frame); !problem.empty()) return error(std::move(problem));
    const ExportFrame shown{frame.index, frame.time, meshes_.surfaces(), frame.solids};
    if (is_first) {
        if (Result<void> added = add_first_frame(shown); !added) return added;
    } else {
        if (meshes_.have_grown()) size_.set_meshes(shown.surfaces, present_vertices);
        const std::uint64_t frames = std::max<std::uint64_t>(times_.size() + 1, info_.frame_count);
        if (Result<void> checked = check_size(size_, frames); !checked) return checked;
        for (std::size_t i = 0; i < first_.size(); ++i) {
            if (Result<void> added = add_target(i, shown.surfaces[i]); !added) return added;
        }
    }
    if (std::string problem = solids_.add_poses(frame.solids); !problem.empty())
        return error("frame " + std::to_string(frame.index) + ": " + problem);
    times_.push_back(static_cast<float>(frame.time));
    return {};
}

/// Key times must increase (3.11).
Result<void> GlbExporter::check_order(const ExportFrame& frame) const {
    const std::string which = "frame " + std::to_string(frame.index) + ": ";
    const auto time = static_cast<float>(frame.time);
    if (!std::isfinite(time) || time < 0)
        return error(which + "its time must be a finite number of seconds, at least 0");
    if (times_.empty()) return {};
    if (!(time > times_.back())) return error(which + "its time must be later than that of the frame before");
    return {};
}

/// Fails before any bytes are written if the file would exceed its limit.
Result<void> GlbExporter::check_size(const FilmSize& size, std::uint64_t frames) const {
    const double bytes = size.of(static_cast<double>(frames));
    if (bytes <= byte_limit) return {};
    char gib[32];
    std::snprintf(gib, sizeof gib, "%.1f", bytes / (1024.0 * 1024.0 * 1024.0));
    return error("would take " + std::string(gib) + " GiB for " + std::to_string(frames) +
                 " frames, but a .glb cannot be larger than 4 GiB; write fewer frames or a sequence");
}

Result<void> GlbExporter::add_first_frame(const ExportFrame& frame) {
    model_.asset.version = "2.0";
    model_.asset.generator = "weft " WEFT_VERSION;
    model_.scenes.emplace_back();
    model_.scenes.back().name = info_.scene_name;
    model_.defaultScene = 0;
    for (const ExportSurface& surface : frame.surfaces) {
        FirstFrame& first = first_.emplace_back();
        first.positions.assign(surface.positions.begin(), surface.positions.end());
        first.normals.reserve(surface.normals.size());
        for (const Vec3& normal : surface.normals) first.normals.push_back(unit_normal(normal));
    }
    size_ = FilmSize(frame, info_.folder);
    size_.set_meshes(frame.surfaces, present_vertices);
    if (Result<void> checked = check_size(size_, std::max<std::uint64_t>(1, info_.frame_count)); !checked) {
        return checked;
    }
    for (const ExportSurface& surface : frame.surfaces) {
        if (Result<void> added = add_base(surface); !added) return added;
    }
    return solids_.add_nodes(frame.solids);  // after the cloths: mesh i of the model is cloth i
}

Result<void> GlbExporter::add_base(const ExportSurface& surface) {
    const FirstFrame& first = first_[model_.meshes.size()];
    const std::size_t count = first.positions.size();
    const std::string name(surface.name);

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const Result<int> indices = buffer_.add_indices(surface.triangles, surface.positions.size());
    if (!indices) return indices.errors();
    primitive.indices = *indices;
    const Result<int> positions = buffer_.add_vectors(first.positions, WithBounds::yes);
    if (!positions) return positions.errors();
    primitive.attributes["POSITION"] = *positions;
    const Result<int> normals = buffer_.add_vectors(first.normals, WithBounds::no);
    if (!normals) return normals.errors();
    primitive.attributes["NORMAL"] = *normals;

    if (!surface.uvs.empty()) {
        std::vector<Vec2> uvs;
        uvs.reserve(count);
        for (const Vec2& uv : surface.uvs) uvs.push_back({uv.x, 1 - uv.y});  // v runs downward (3.8.3)
        buffer_.open_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, count, TINYGLTF_TARGET_ARRAY_BUFFER);
        primitive.attributes["TEXCOORD_0"] = buffer_.newest_accessor();
        if (Result<void> r = buffer_.append(std::as_bytes(std::span(uvs))); !r) return r;
    }
    if (Result<void> r = add_colors(surface, primitive); !r) return r;
    if (Result<void> r = add_material(surface, primitive); !r) return r;

    tinygltf::Node& node = model_.nodes.emplace_back();
    node.name = name;
    node.mesh = as_int(model_.meshes.size());
    model_.scenes.front().nodes.push_back(as_int(model_.nodes.size()) - 1);
    tinygltf::Mesh& gltf_mesh = model_.meshes.emplace_back();
    gltf_mesh.name = name;
    gltf_mesh.primitives.push_back(std::move(primitive));
    return {};
}

Result<void> GlbExporter::add_colors(const ExportSurface& surface, tinygltf::Primitive& primitive) {
    if (surface.colors.empty()) return {};
    const auto clamped = [](float c) { return std::isnan(c) ? 0.0f : std::clamp(c, 0.0f, 1.0f); };
    std::vector<Vec4> colors;
    colors.reserve(surface.colors.size());
    for (const Vec4& c : surface.colors) colors.push_back({clamped(c.x), clamped(c.y), clamped(c.z), clamped(c.w)});
    buffer_.open_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, colors.size(),
                          TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["COLOR_0"] = buffer_.newest_accessor();
    return buffer_.append(std::as_bytes(std::span(colors)));
}

/// Tangents are written only for single frames with a normal map. An animation has none: as morph targets they would
/// add half of its size, and some readers that load tangents do not morph them. Without tangents, readers compute them
/// in each frame from the UVs.
Result<void> GlbExporter::add_material(const ExportSurface& surface, tinygltf::Primitive& primitive) {
    const std::string name(surface.name);
    primitive.material = as_int(model_.materials.size());
    if (!surface.material) {
        model_.materials.push_back(plain_material(name, !surface.colors.empty()));
        return {};
    }
    if (Result<void> r = materials_.add(name, *surface.material, surface); !r) return r;
    if (info_.frame_count != 1 || model_.materials.back().normalTexture.index < 0) return {};
    const FirstFrame& first = first_[model_.meshes.size()];
    std::vector<Vec4> tangents;
    compute_tangents(surface.triangles, surface.uvs, first.positions, first.normals, tangents);
    buffer_.open_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, tangents.size(),
                          TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["TANGENT"] = buffer_.newest_accessor();
    return buffer_.append(std::as_bytes(std::span(tangents)));
}

Result<void> GlbExporter::add_target(std::size_t cloth, const ExportSurface& surface) {
    FirstFrame& first = first_[cloth];
    meshes_[cloth].widen(first.positions);
    meshes_[cloth].widen(first.normals);
    const std::size_t count = first.positions.size();
    deltas_.resize(count);
    for (std::size_t i = 0; i < count; ++i) deltas_[i] = surface.positions[i] - first.positions[i];
    const Result<int> positions = buffer_.add_vectors(deltas_, WithBounds::yes);
    if (!positions) return positions.errors();
    for (std::size_t i = 0; i < count; ++i) deltas_[i] = unit_normal(surface.normals[i]) - first.normals[i];
    const Result<int> normals = buffer_.add_vectors(deltas_, WithBounds::no);
    if (!normals) return normals.errors();
    model_.meshes[cloth].primitives.front().targets.push_back({{"POSITION", *positions}, {"NORMAL", *normals}});
    return {};
}

/// All objects share the keys, one per frame.
Result<void> GlbExporter::add_animation() {
    if (times_.size() < 2 || (first_.empty() && !solids_.have_moved())) return {};
    const Result<int> times = buffer_.add_keys(times_, TINYGLTF_TYPE_SCALAR);
    if (!times) return times.errors();
    tinygltf::Accessor& input = model_.accessors.back();
    input.minValues = {times_.front()};
    input.maxValues = {times_.back()};

    tinygltf::Animation animation;
    animation.name = info_.scene_name;
    if (!first_.empty()) {
        if (Result<void> r = add_weights(*times, animation); !r) return r;
    }
    if (Result<void> r = solids_.add_channels(*times, animation); !r) return r;
    model_.animations.push_back(std::move(animation));
    return {};
}

/// Key i shows only target i - 1, key 0 the first frame; between two keys their frames are blended.
Result<void> GlbExporter::add_weights(int times, tinygltf::Animation& animation) {
    const std::size_t keys = times_.size(), targets = keys - 1;
    buffer_.open_accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, keys * targets, 0);
    tinygltf::AnimationSampler sampler;
    sampler.interpolation = "LINEAR";
    sampler.input = times;
    sampler.output = buffer_.newest_accessor();
    std::vector<float> weights(targets, 0.0f);
    for (std::size_t key = 0; key < keys; ++key) {
        if (key > 0) weights[key - 1] = 1;
        if (Result<void> r = buffer_.append(std::as_bytes(std::span(weights))); !r) return r;
        if (key > 0) weights[key - 1] = 0;
    }
    animation.samplers.push_back(std::move(sampler));
    for (std::size_t cloth = 0; cloth < first_.size(); ++cloth) {
        model_.meshes[cloth].weights.assign(targets, 0.0);
        tinygltf::AnimationChannel& channel = animation.channels.emplace_back();
        channel.sampler = 0;
        channel.target_node = as_int(cloth);
        channel.target_path = "weights";
    }
    return {};
}

Result<void> GlbExporter::finish() {
    if (times_.empty()) return error("there is no frame to write");
    if (Result<void> r = add_animation(); !r) return r;
    if (!meshes_.have_grown()) {
        const Result<std::string> json = json_text(buffer_.size());
        if (!json) return json.errors();
        return write_container(*json, buffer_.size(), [&](BufferedFile& to) { return buffer_.file().move_to(to); });
    }
    const WideViews views(model_, meshes_, buffer_.size());
    const Result<std::string> json = json_text(views.bytes());
    if (!json) return json.errors();
    return write_container(*json, views.bytes(), [&](BufferedFile& to) { return views.write(buffer_.file(), to); });
}

Result<std::string> GlbExporter::json_text(std::uint64_t binary_bytes) const {
    std::ostringstream stream;
    try {
        // tinygltf throws if a name is not UTF-8.
        if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, false, false)) {
            return error("its JSON part cannot be written");
        }
    } catch (const std::exception& exception) {
        return error(std::string("its JSON part cannot be written: ") + exception.what());
    }
    std::string json = std::move(stream).str();
    json.erase(json.find_last_of('}') + 1);
    // tinygltf takes the length of a buffer from its bytes in memory, which are in the temporary file here.
    json.insert(1, "\"buffers\":[{\"byteLength\":" + std::to_string(binary_bytes) + "}],");
    json.append((4 - json.size() % 4) % 4, ' ');
    return json;
}

template <class WriteBinary>
Result<void> GlbExporter::write_container(const std::string& json, std::uint64_t binary_bytes,
                                          WriteBinary&& write_binary) {
    const std::uint64_t total = header_bytes + 2 * chunk_header_bytes + json.size() + binary_bytes;
    if (static_cast<double>(total) > byte_limit) {
        return error("would take more than 4 GiB, the limit of a .glb; write fewer frames or a sequence");
    }
    Result<AtomicFile> file = AtomicFile::create(path_);
    if (!file) return file.errors();
    const auto put = [&](std::initializer_list<std::uint64_t> numbers) -> Result<void> {
        std::vector<std::uint32_t> words;
        for (const std::uint64_t number : numbers) words.push_back(static_cast<std::uint32_t>(number));
        return file->write(std::as_bytes(std::span(words)));
    };
    if (Result<void> r = put({glb_magic, glb_version, total, json.size(), json_chunk}); !r) return r;
    if (Result<void> r = file->write(json); !r) return r;
    if (Result<void> r = put({binary_bytes, binary_chunk}); !r) return r;
    if (Result<void> r = write_binary(file->content()); !r) return r;
    return file->commit();
}

}  // namespace

std::unique_ptr<Exporter> make_glb(const std::filesystem::path& path) {
    return std::make_unique<GlbExporter>(path);
}

}  // namespace weft
