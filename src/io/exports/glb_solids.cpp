#include "io/exports/glb_solids.h"

#include "io/exports/export_format.h"
#include "io/exports/glb_views.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace weft {
namespace {

constexpr std::size_t translation_floats = 3, rotation_floats = 4;

// JSON of an object: node, mesh, material, accessors with their views, two channels.
constexpr double json_bytes_per_solid = 4096;

template <std::size_t Count>
std::array<float, Count> last(const std::vector<float>& values) {
    std::array<float, Count> found{};
    for (std::size_t i = 0; i < Count; ++i) found[i] = values[values.size() - Count + i];
    return found;
}

template <class Values>
void append_all(std::vector<float>& to, const Values& values) {
    to.insert(to.end(), values.begin(), values.end());
}

}  // namespace

double GlbSolids::mesh_bytes(std::span<const ExportSolid> solids) {
    double bytes = 0;
    std::set<const TriangleMesh*> counted;
    for (const ExportSolid& solid : solids) {
        // In the JSON, a character of a name may take six bytes; node, mesh and material have it.
        bytes += json_bytes_per_solid + 3 * 6 * static_cast<double>(solid.name.size());
        if (!solid.mesh || !counted.insert(solid.mesh).second) continue;
        const auto vertices = static_cast<double>(solid.mesh->positions.size());
        bytes += vertices * 2 * sizeof(Vec3) + static_cast<double>(solid.mesh->triangles.size()) * sizeof(Triangle);
    }
    return bytes;
}

double GlbSolids::pose_bytes(std::span<const ExportSolid> solids) {
    return static_cast<double>(solids.size() * (translation_floats + rotation_floats) * sizeof(float));
}

Result<tinygltf::Primitive> GlbSolids::add_mesh(const TriangleMesh& mesh) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const Result<int> indices = buffer_.add_indices(mesh.triangles, mesh.positions.size());
    if (!indices) return indices.errors();
    primitive.indices = *indices;
    const Result<int> positions = buffer_.add_vectors(mesh.positions, WithBounds::yes);
    if (!positions) return positions.errors();
    primitive.attributes["POSITION"] = *positions;
    std::vector<Vec3> unit;
    unit.reserve(mesh.normals.size());
    for (const Vec3& normal : mesh.normals) unit.push_back(unit_normal(normal));
    const Result<int> normals = buffer_.add_vectors(unit, WithBounds::no);
    if (!normals) return normals.errors();
    primitive.attributes["NORMAL"] = *normals;
    return primitive;
}

Result<int> GlbSolids::add_material(const ExportSolid& solid) {
    const std::string name(solid.name);
    if (solid.material) {
        // Without UVs: renderers of weft show colliders without them too.
        const ExportSurface surface{.name = solid.name,
                                    .positions = solid.mesh->positions,
                                    .normals = solid.mesh->normals,
                                    .triangles = solid.mesh->triangles,
                                    .uvs = {},
                                    .colors = {},
                                    .rest_positions = {}};
        if (Result<void> r = materials_.add(name, *solid.material, surface); !r) return r.errors();
    } else {
        model_.materials.push_back(plain_material(name, false));
    }
    return as_int(model_.materials.size()) - 1;
}

Result<void> GlbSolids::add_nodes(std::span<const ExportSolid> solids) {
    std::map<const TriangleMesh*, tinygltf::Primitive> primitives;
    for (const ExportSolid& solid : solids) {
        if (!primitives.contains(solid.mesh)) {
            Result<tinygltf::Primitive> added = add_mesh(*solid.mesh);
            if (!added) return added.errors();
            primitives[solid.mesh] = *std::move(added);
        }
        const Result<int> material = add_material(solid);
        if (!material) return material.errors();

        const std::string name(solid.name);
        tinygltf::Mesh& mesh = model_.meshes.emplace_back();
        mesh.name = name;
        mesh.primitives.push_back(primitives[solid.mesh]);
        mesh.primitives.back().material = *material;
        tinygltf::Node& node = model_.nodes.emplace_back();
        node.name = name;
        node.mesh = as_int(model_.meshes.size()) - 1;
        const Vec3 at = solid.pose.position;
        const Vec4 turn = quaternion_from(solid.pose.rotation);
        node.translation = {at.x, at.y, at.z};
        node.rotation = {turn.x, turn.y, turn.z, turn.w};
        tracks_.push_back({name, as_int(model_.nodes.size()) - 1, {}, {}});
        model_.scenes.front().nodes.push_back(tracks_.back().node);
    }
    return {};
}

std::string GlbSolids::add_poses(std::span<const ExportSolid> solids) {
    if (solids.size() != tracks_.size()) {
        return "it has " + std::to_string(solids.size()) + " colliders instead of the " +
               std::to_string(tracks_.size()) + " of the first frame";
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
        Track& track = tracks_[i];
        if (solids[i].name != track.name) {
            return "it has the collider \"" + std::string(solids[i].name) + "\" in place of \"" + track.name +
                   "\" of the first frame";
        }
        const Vec3 at = solids[i].pose.position;
        Vec4 turn = quaternion_from(solids[i].pose.rotation);
        const bool is_first = track.translations.empty();
        // q and -q are the same rotation. Programs blend the numbers of two keys, so their signs must agree.
        if (!is_first) {
            const auto before = last<rotation_floats>(track.rotations);
            const float cosine = before[0] * turn.x + before[1] * turn.y + before[2] * turn.z + before[3] * turn.w;
            if (cosine < 0) turn = {-turn.x, -turn.y, -turn.z, -turn.w};
        }
        const std::array translation{at.x, at.y, at.z};
        const std::array rotation{turn.x, turn.y, turn.z, turn.w};
        if (!is_first && (translation != last<translation_floats>(track.translations) ||
                          rotation != last<rotation_floats>(track.rotations))) {
            track.has_moved = true;
        }
        append_all(track.translations, translation);
        append_all(track.rotations, rotation);
    }
    return {};
}

bool GlbSolids::have_moved() const {
    return std::ranges::any_of(tracks_, &Track::has_moved);
}

Result<void> GlbSolids::add_channels(int times, tinygltf::Animation& animation) const {
    for (const Track& track : tracks_) {
        if (!track.has_moved) continue;
        const auto add = [&](const char* path, const std::vector<float>& values, int type) -> Result<void> {
            const Result<int> output = buffer_.add_keys(values, type);
            if (!output) return output.errors();
            tinygltf::AnimationSampler& sampler = animation.samplers.emplace_back();
            sampler.interpolation = "LINEAR";
            sampler.input = times;
            sampler.output = *output;
            tinygltf::AnimationChannel& channel = animation.channels.emplace_back();
            channel.sampler = as_int(animation.samplers.size()) - 1;
            channel.target_node = track.node;
            channel.target_path = path;
            return {};
        };
        if (Result<void> r = add("translation", track.translations, TINYGLTF_TYPE_VEC3); !r) return r;
        if (Result<void> r = add("rotation", track.rotations, TINYGLTF_TYPE_VEC4); !r) return r;
    }
    return {};
}

}  // namespace weft
