#include "io/meshes/mesh_checks.h"

#include <algorithm>

namespace weft {
namespace {

// Autodesk, "3D-Studio File Format (.3ds)", 1996: a tree of chunks, each with a 2-byte kind and a 4-byte length.
constexpr std::uint32_t main_chunk = 0x4d4d, editor = 0x3d3d, object = 0x4000, mesh = 0x4100;
constexpr std::uint32_t vertex_list = 0x4110, face_list = 0x4120;
constexpr std::size_t header_size = 6;

std::uint32_t read(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t b = 0; b < size && at + b < bytes.size(); ++b) {
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + b])) << (8 * b);
    }
    return value;
}

template <class Visit>
void for_each_chunk(std::string_view bytes, Visit&& visit) {
    while (bytes.size() >= header_size) {
        const std::size_t length = std::clamp<std::size_t>(read(bytes, 2, 4), header_size, bytes.size());
        visit(read(bytes, 0, 2), bytes.substr(header_size, length - header_size));
        bytes.remove_prefix(length);
    }
}

std::string problem_of_mesh(std::string_view body) {
    std::uint32_t vertices = 0;
    std::string_view faces;
    for_each_chunk(body, [&](std::uint32_t kind, std::string_view chunk) {
        if (kind == vertex_list) vertices = read(chunk, 0, 2);
        if (kind == face_list) faces = chunk;
    });
    const std::uint32_t count = read(faces, 0, 2);
    for (std::uint32_t face = 0; face < count; ++face) {
        for (std::size_t corner = 0; corner < 3; ++corner) {  // the fourth number holds flags
            const std::uint32_t index = read(faces, 2 + 8 * std::size_t{face} + 2 * corner, 2);
            if (index >= vertices) {
                return "triangle " + std::to_string(face) + " uses vertex " + std::to_string(index) + " of " +
                       std::to_string(vertices);
            }
        }
    }
    return {};
}

void visit(std::uint32_t kind, std::string_view body, std::string& problem) {
    if (!problem.empty()) return;
    if (kind == object) body.remove_prefix(std::min(body.find('\0'), body.size() - 1) + 1);  // skips its name
    if (kind == mesh) problem = problem_of_mesh(body);
    if (kind != main_chunk && kind != editor && kind != object) return;
    for_each_chunk(body, [&](std::uint32_t inner, std::string_view chunk) {
        const bool one_level_down = (kind == main_chunk && inner == editor) || (kind == editor && inner == object) ||
                                    (kind == object && inner == mesh);
        if (one_level_down) visit(inner, chunk, problem);
    });
}

}  // namespace

std::string problem_of_3ds(std::string_view content) {
    std::string problem;
    for_each_chunk(content, [&](std::uint32_t kind, std::string_view chunk) {
        if (kind == main_chunk) visit(kind, chunk, problem);
    });
    return problem;
}

}  // namespace weft
