// Binary little-endian PLY: all cloths as one mesh, because the format has only one.
#include "io/exports/export_format.h"
#include "io/files/whole_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace weft {
Result<void> write_ply(const ExportFrame& frame, AtomicFile& file);
std::uint64_t size_ply(std::span<const ExportSurface> surfaces);
Result<StillVertices> read_ply(const std::filesystem::path& path);

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

struct Contents {
    std::uint64_t vertices = 0, triangles = 0;
    bool uvs = false, colors = false;  ///< if any cloth has them; the others get zeros and white
};

Contents contents_of(std::span<const ExportSurface> surfaces) {
    Contents contents;
    for (const ExportSurface& surface : surfaces) {
        contents.vertices += surface.positions.size();
        contents.triangles += surface.triangles.size();
        contents.uvs |= !surface.uvs.empty();
        contents.colors |= !surface.colors.empty();
    }
    return contents;
}

/// Of one vertex.
std::uint64_t record_bytes(const Contents& contents) {
    return 2 * sizeof(Vec3) + (contents.uvs ? sizeof(Vec2) : 0) + (contents.colors ? 4 : 0);
}

std::string header(const Contents& contents) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by weft\n";
    text += "element vertex " + std::to_string(contents.vertices) + "\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) text += std::string("property float ") + name + "\n";
    if (contents.uvs) text += "property float s\nproperty float t\n";
    if (contents.colors) {
        for (const char* name : {"red", "green", "blue", "alpha"}) text += std::string("property uchar ") + name + "\n";
    }
    text += "element face " + std::to_string(contents.triangles) + "\n";
    text += "property list uchar uint vertex_indices\nend_header\n";
    return text;
}

template <class Value>
void append(std::vector<std::byte>& bytes, const Value& value) {
    const std::span<const std::byte> raw = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/// Quantizes the linear value to eight bits: readers do not decode sRGB, weft's included.
std::uint8_t byte_color(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(std::isnan(value) ? 0 : value, 0.0f, 1.0f) * 255));
}

Result<void> write_vertices(const ExportSurface& surface, const Contents& contents, AtomicFile& file) {
    std::vector<std::byte> record;
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
        record.clear();
        append(record, surface.positions[i]);
        append(record, unit_normal(surface.normals[i]));
        if (contents.uvs) append(record, surface.uvs.empty() ? Vec2{} : surface.uvs[i]);
        if (contents.colors) {
            const Vec4 color = surface.colors.empty() ? Vec4{1, 1, 1, 1} : surface.colors[i];
            for (const float channel : {color.x, color.y, color.z, color.w}) append(record, byte_color(channel));
        }
        if (Result<void> r = file.write(record); !r) return r;
    }
    return {};
}

Result<void> write_triangles(const ExportSurface& surface, std::uint32_t first_vertex, AtomicFile& file) {
    std::vector<std::byte> record;
    for (const Triangle& triangle : surface.triangles) {
        record.clear();
        append(record, std::uint8_t{3});
        for (const std::uint32_t vertex : triangle) append(record, first_vertex + vertex);
        if (Result<void> r = file.write(record); !r) return r;
    }
    return {};
}

}  // namespace

std::uint64_t size_ply(std::span<const ExportSurface> surfaces) {
    Contents contents = contents_of(surfaces);
    for (const ExportSurface& surface : surfaces) contents.vertices += surface.spare_vertices;
    const std::uint64_t triangle = 1 + sizeof(Triangle);
    return header(contents).size() + contents.vertices * record_bytes(contents) + contents.triangles * triangle;
}

Result<void> write_ply(const ExportFrame& frame, AtomicFile& file) {
    const Contents contents = contents_of(frame.surfaces);
    if (contents.vertices > std::numeric_limits<std::uint32_t>::max()) {
        return Error{file.path().string(), "a .ply holds at most 4294967295 vertices"};
    }
    if (Result<void> r = file.write(header(contents)); !r) return r;
    for (const ExportSurface& surface : frame.surfaces) {
        if (Result<void> r = write_vertices(surface, contents, file); !r) return r;
    }
    std::uint32_t first_vertex = 0;
    for (const ExportSurface& surface : frame.surfaces) {
        if (Result<void> r = write_triangles(surface, first_vertex, file); !r) return r;
        first_vertex += static_cast<std::uint32_t>(surface.positions.size());
    }
    return {};
}

Result<StillVertices> read_ply(const std::filesystem::path& path) {
    const Result<std::string> text = read_whole_file(path);
    if (!text) return text.errors();
    constexpr std::string_view count_line = "element vertex ", last_line = "end_header\n";
    const std::size_t count_at = text->find(count_line), end = text->find(last_line);
    Contents contents;
    if (count_at < end && end != text->npos) {
        const char* digits = text->data() + count_at + count_line.size();
        std::from_chars(digits, text->data() + end, contents.vertices);
        contents.uvs = text->find("property float s\n") < end;
        contents.colors = text->find("property uchar red\n") < end;
    }
    const std::size_t record = record_bytes(contents), first = end + last_line.size();
    if (contents.vertices == 0 || (text->size() - first) / record < contents.vertices)
        return Error{path.string(), "is not a complete .ply of weft"};
    StillVertices vertices;
    for (std::size_t i = 0; i < contents.vertices; ++i) {
        std::array<Vec3, 2> values;
        std::memcpy(&values, text->data() + first + i * record, sizeof values);
        vertices.positions.push_back(values[0]);
        vertices.normals.push_back(values[1]);
    }
    return vertices;
}

}  // namespace weft
