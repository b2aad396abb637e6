#include "io/meshes/mesh_writer.h"

#include <bit>
#include <span>
#include <string>

namespace weft {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

std::string header(const TriangleMesh& mesh) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by weft\n";
    text += "element vertex " + std::to_string(mesh.positions.size()) + '\n';
    const auto floats = [&](bool there, std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (there) text += std::string("property float ") + name + '\n';
    };
    floats(true, {"x", "y", "z"});
    floats(!mesh.normals.empty(), {"nx", "ny", "nz"});
    floats(!mesh.uvs.empty(), {"s", "t"});
    floats(!mesh.colors.empty(), {"red", "green", "blue", "alpha"});
    text += "element face " + std::to_string(mesh.triangles.size()) + '\n';
    return text + "property list uchar uint vertex_indices\nend_header\n";
}

template <class Value>
Result<void> write(const Value& value, AtomicFile& file) {
    return file.write(std::as_bytes(std::span(&value, 1)));
}

Result<void> write_vertex(const TriangleMesh& mesh, std::size_t v, AtomicFile& file) {
    if (auto done = write(mesh.positions[v], file); !done) return done;
    if (!mesh.normals.empty()) {
        if (auto done = write(mesh.normals[v], file); !done) return done;
    }
    if (!mesh.uvs.empty()) {
        if (auto done = write(mesh.uvs[v], file); !done) return done;
    }
    return mesh.colors.empty() ? Result<void>() : write(mesh.colors[v], file);
}

}  // namespace

Result<void> write_mesh(const TriangleMesh& mesh, AtomicFile& file) {
    if (auto done = file.write(header(mesh)); !done) return done;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (auto done = write_vertex(mesh, v, file); !done) return done;
    for (const Triangle& triangle : mesh.triangles) {
        if (auto done = write(std::uint8_t{3}, file); !done) return done;
        if (auto done = write(triangle, file); !done) return done;
    }
    return {};
}

}  // namespace weft
