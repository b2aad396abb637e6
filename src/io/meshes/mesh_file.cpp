#include "io/meshes/mesh_file.h"

#include "io/files/whole_file.h"
#include "io/meshes/mesh_checks.h"
#include "io/meshes/mesh_join.h"
#include "io/meshes/obj_source.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <exception>
#include <new>
#include <string>
#include <utility>

namespace weft {
namespace {

constexpr std::array<std::string_view, 7> endings{".obj", ".ply", ".gltf", ".glb", ".fbx", ".stl", ".3ds"};

// Normals are not generated where a file has none. Vertices are joined here, not by Assimp, which would also join those
// within 1e-5 of each other: whole panels of a small garment.
constexpr unsigned import_steps = aiProcess_Triangulate;

std::string lower_case_ending(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

/// Empty if files with that ending are supported.
std::string problem_of_ending(const std::filesystem::path& path) {
    if (std::ranges::find(endings, lower_case_ending(path)) != endings.end()) return {};
    std::string what = "has an unknown ending; known are";
    for (std::string_view format : endings) what.append(" ").append(format);
    return what;
}

/// All attributes that any part of the file has, one entry per vertex; parts without an attribute get a neutral value.
struct Parts {
    TriangleMesh mesh;
    bool has_uvs = false;
    bool has_colors = false;
    bool every_part_has_normals = true;
};

Vec3 to_vec3(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

void append_vertices(const aiMesh& part, const aiMatrix4x4& transform, Parts& parts) {
    aiMatrix3x3 normal_transform(transform);
    normal_transform.Inverse().Transpose();
    TriangleMesh& mesh = parts.mesh;
    const bool has_colors = part.HasVertexColors(0);
    parts.has_uvs |= part.HasTextureCoords(0);
    parts.has_colors |= has_colors;
    parts.every_part_has_normals &= part.HasNormals();
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
        mesh.positions.push_back(to_vec3(transform * part.mVertices[i]));
        mesh.normals.push_back(part.HasNormals() ? normalized(to_vec3(normal_transform * part.mNormals[i])) : Vec3{});
        const aiVector3D uv = part.HasTextureCoords(0) ? part.mTextureCoords[0][i] : aiVector3D();
        mesh.uvs.push_back({uv.x, uv.y});
        const aiColor4D color = has_colors ? part.mColors[0][i] : aiColor4D(1, 1, 1, 1);
        mesh.colors.push_back({color.r, color.g, color.b, color.a});
    }
}

/// Returns the problem, or an empty string.
std::string append_part(const aiMesh& part, const aiMatrix4x4& transform, Parts& parts) {
    const auto is_triangle = [](const aiFace& face) { return face.mNumIndices == 3; };
    if (std::none_of(part.mFaces, part.mFaces + part.mNumFaces, is_triangle)) return {};  // only points and lines
    const auto first = static_cast<std::uint32_t>(parts.mesh.positions.size());
    append_vertices(part, transform, parts);
    const bool mirrored = transform.Determinant() < 0;
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
        const aiFace& face = part.mFaces[f];
        if (!is_triangle(face)) continue;
        for (unsigned c = 0; c < 3; ++c) {
            if (face.mIndices[c] < part.mNumVertices) continue;
            return "triangle " + std::to_string(f) + " uses vertex " + std::to_string(face.mIndices[c]) + " of " +
                   std::to_string(part.mNumVertices);
        }
        Triangle triangle{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
        if (mirrored) std::swap(triangle[1], triangle[2]);
        parts.mesh.triangles.push_back(triangle);
    }
    return {};
}

std::string append_scene(const aiScene& scene, const aiMatrix4x4& to_file, Parts& parts) {
    struct Visit {
        const aiNode* node;
        aiMatrix4x4 parent;
    };
    std::vector<Visit> open;
    if (scene.mRootNode) open.push_back({scene.mRootNode, to_file});
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const aiMatrix4x4 transform = visit.parent * visit.node->mTransformation;
        for (unsigned m = 0; m < visit.node->mNumMeshes; ++m) {
            std::string problem = append_part(*scene.mMeshes[visit.node->mMeshes[m]], transform, parts);
            if (!problem.empty()) return problem;
        }
        for (unsigned c = visit.node->mNumChildren; c-- > 0;) open.push_back({visit.node->mChildren[c], transform});
    }
    return {};
}

/// Drops attributes that the file does not have, and normals unless there is one unit vector per vertex in use.
TriangleMesh without_missing_attributes(Parts parts) {
    TriangleMesh& mesh = parts.mesh;
    if (!parts.has_uvs) mesh.uvs.clear();
    if (!parts.has_colors) mesh.colors.clear();
    const auto is_unit = [&mesh](std::uint32_t vertex) { return std::abs(length(mesh.normals[vertex]) - 1) < 1e-3f; };
    const bool usable =
        parts.every_part_has_normals && std::ranges::all_of(mesh.triangles, [&is_unit](const Triangle& triangle) {
            return std::ranges::all_of(triangle, is_unit);
        });
    if (!usable) {
        mesh.normals.clear();
    } else {  // vertices without a triangle may have no normal
        for (std::uint32_t v = 0; v < mesh.normals.size(); ++v) {
            if (!is_unit(v)) mesh.normals[v] = {0, 1, 0};
        }
    }
    return std::move(mesh);
}

/// Returns the problem, or an empty string.
std::string check_finite(const TriangleMesh& mesh) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (!finite(mesh.positions[v])) return "vertex " + std::to_string(v) + " is not finite";
    }
    for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
        if (!std::isfinite(mesh.uvs[v].x) || !std::isfinite(mesh.uvs[v].y)) {
            return "texture coordinate of vertex " + std::to_string(v) + " is not finite";
        }
    }
    for (std::size_t v = 0; v < mesh.colors.size(); ++v) {
        const Vec4 color = mesh.colors[v];
        if (!finite(color.xyz()) || !std::isfinite(color.w)) {
            return "color of vertex " + std::to_string(v) + " is not finite";
        }
    }
    return {};
}

Result<TriangleMesh> collect(const aiScene* scene, const Assimp::Importer& importer, const std::string& file,
                             const aiMatrix4x4& to_file = {}) {
    if (!scene) {
        const std::string reason = first_line(importer.GetErrorString());
        if (reason.starts_with("No suitable reader")) return Error{file, "is damaged, or not what its ending says"};
        return Error{file, "cannot be read: " + reason};
    }
    Parts parts;
    std::string problem = append_scene(*scene, to_file, parts);
    if (!problem.empty()) return Error{file, std::move(problem)};
    if (parts.mesh.triangles.empty()) return Error{file, "has no triangles"};
    TriangleMesh mesh = without_missing_attributes(std::move(parts));
    problem = check_finite(mesh);
    if (!problem.empty()) return Error{file, std::move(problem)};
    return mesh;
}

/// Restores the order of the `v` lines of an OBJ file from Assimp's corners, with the positions and colors of the
/// lines, and adds vertices that no face uses.
Result<TriangleMesh> load_obj(std::string content, const std::string& file) {
    Result<ObjSource> source = read_obj_source(content, file);
    if (!source) return source.errors();
    std::string().swap(content);  // frees it, because Assimp makes many copies of a large file

    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFileFromMemory(source->tagged.data(), source->tagged.size(), import_steps, "obj");
    Result<TriangleMesh> corners = collect(scene, importer, file);
    importer.FreeScene();
    if (!corners) return corners;
    std::vector<std::uint32_t> lines;
    lines.reserve(corners->colors.size());
    for (Vec4 tag : corners->colors) lines.push_back(obj_vertex_from_tag(tag.x, tag.y));
    const auto exists = [&source](std::uint32_t line) { return line < source->positions.size(); };
    if (lines.empty() || !std::ranges::all_of(lines, exists)) {
        return Error{file, "cannot be read: Assimp did not keep its vertex numbers"};
    }
    return in_source_order(*corners, lines, source->positions, source->colors);
}

/// The transform from Assimp's axes back to those of the file: Assimp turns 3DS files, whose z axis points up. The
/// scene decides which axis is up, for this format as for all others.
aiMatrix4x4 to_axes_of_file(std::string_view ending) {
    return ending == ".3ds" ? aiMatrix4x4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1) : aiMatrix4x4();
}

/// Assimp opens the file again, because a glTF file refers to other files beside it.
Result<TriangleMesh> load_other(const std::filesystem::path& path, std::string_view content) {
    const std::string file = path.string();
    const std::string ending = lower_case_ending(path);
    std::string problem;
    if (ending == ".ply") problem = problem_of_ply(content);
    if (ending == ".3ds") problem = problem_of_3ds(content);
    if (ending == ".stl") problem = problem_of_stl(content);
    if (ending == ".gltf" || ending == ".glb") problem = problem_of_gltf(content);
    if (ending == ".fbx") problem = problem_of_fbx(content);
    if (!problem.empty()) return Error{file, std::move(problem)};

    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file, import_steps);
    Result<TriangleMesh> mesh = collect(scene, importer, file, to_axes_of_file(ending));
    if (!mesh) return mesh;
    if (ending == ".gltf" || ending == ".glb") {
        const std::uint64_t expected = gltf_triangle_count(content).value_or(mesh->triangles.size());
        if (expected > mesh->triangles.size()) {
            return Error{file, std::to_string(expected - mesh->triangles.size()) + " of " + std::to_string(expected) +
                                   " triangles use vertices that do not exist"};
        }
    }
    // STL stores one normal per triangle, which its corners imply; kept normals would split every vertex.
    if (ending == ".stl") mesh->normals.clear();
    return joined(*mesh);
}

}  // namespace

Result<TriangleMesh> load_mesh(const std::filesystem::path& path) {
    const std::string file = path.string();
    try {
        std::string problem = problem_of_path(path);
        if (problem.empty()) problem = problem_of_ending(path);
        if (!problem.empty()) return Error{file, std::move(problem)};
        Result<std::string> content = read_whole_file(path);
        if (!content) return content.errors();
        if (lower_case_ending(path) == ".obj") return load_obj(std::move(*content), file);
        return load_other(path, *content);
    } catch (const std::bad_alloc&) {
        return Error{file, "cannot be read: not enough memory"};
    } catch (const std::exception& exception) {
        return Error{file, "cannot be read: " + first_line(exception.what())};
    }
}

std::span<const std::string_view> mesh_formats() {
    return endings;
}

}  // namespace weft
