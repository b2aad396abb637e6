// Wavefront OBJ. Numbers are the shortest text that reads back as the same float.
#include "io/exports/export_format.h"
#include "io/files/whole_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

namespace weft {
Result<void> write_obj(const ExportFrame& frame, AtomicFile& file);
std::uint64_t size_obj(std::span<const ExportSurface> surfaces);
Result<StillVertices> read_obj(const std::filesystem::path& path);

namespace {

/// One line of text: a keyword and its numbers.
class Line {
  public:
    explicit Line(std::string_view keyword) { text_ = keyword; }

    template <class Number>
    Line& add(Number number, char separator = ' ') {
        std::array<char, 32> digits;
        const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
        text_ += separator;
        text_.append(digits.data(), end.ptr);
        return *this;
    }
    Line& slash() {
        text_ += '/';
        return *this;
    }
    std::string_view end() { return text_ += '\n'; }

  private:
    std::string text_;
};

/// Most readers end a name at white space.
std::string object_name(std::string_view name) {
    std::string safe(name.empty() ? "cloth" : name);
    for (char& c : safe) {
        if (static_cast<unsigned char>(c) <= ' ' || c == 0x7f) c = '_';
    }
    return safe;
}

/// Indices count from 1 through all objects of a file, separately for each kind of vertex data.
struct FirstIndex {
    std::uint64_t position = 1, uv = 1;
};

Result<void> write_vertices(const ExportSurface& surface, AtomicFile& file) {
    for (const Vec3& p : surface.positions) {
        if (Result<void> r = file.write(Line("v").add(p.x).add(p.y).add(p.z).end()); !r) return r;
    }
    for (const Vec2& uv : surface.uvs) {
        if (Result<void> r = file.write(Line("vt").add(uv.x).add(uv.y).end()); !r) return r;
    }
    for (const Vec3& given : surface.normals) {
        const Vec3 n = unit_normal(given);
        if (Result<void> r = file.write(Line("vn").add(n.x).add(n.y).add(n.z).end()); !r) return r;
    }
    return {};
}

Result<void> write_triangles(const ExportSurface& surface, FirstIndex first, AtomicFile& file) {
    const bool has_uvs = !surface.uvs.empty();
    for (const Triangle& triangle : surface.triangles) {
        Line line("f");
        for (const std::uint32_t vertex : triangle) {
            line.add(first.position + vertex);
            has_uvs ? line.add(first.uv + vertex, '/') : line.slash();
            line.add(first.position + vertex, '/');
        }
        if (Result<void> r = file.write(line.end()); !r) return r;
    }
    return {};
}

/// Reads the three numbers of a line after its keyword.
bool read_vector(std::string_view line, Vec3& vector) {
    for (float* number : {&vector.x, &vector.y, &vector.z}) {
        line.remove_prefix(std::min(line.find(' '), line.size()));
        if (line.empty()) return false;
        line.remove_prefix(1);
        if (std::from_chars(line.data(), line.data() + line.size(), *number).ec != std::errc()) return false;
    }
    return true;
}

}  // namespace

std::uint64_t size_obj(std::span<const ExportSurface> surfaces) {
    // A coordinate of a moving cloth takes all digits of a float, as in " -0.12345678".
    constexpr std::uint64_t number = 12, keyword = 3;
    std::uint64_t vertices = 0, bytes = 0;
    for (const ExportSurface& surface : surfaces) vertices += most_vertices(surface);
    const std::uint64_t index = 1 + std::to_string(vertices).size();  // with the space or the slash before it
    for (const ExportSurface& surface : surfaces) {
        bytes += keyword + surface.name.size();
        bytes += most_vertices(surface) * 2 * (keyword + 3 * number);
        bytes += (surface.uvs.empty() ? 0 : most_vertices(surface)) * (keyword + 2 * number);
        bytes += surface.triangles.size() * (keyword + 3 * 3 * index);
    }
    return bytes;
}

Result<void> write_obj(const ExportFrame& frame, AtomicFile& file) {
    FirstIndex first;
    for (const ExportSurface& surface : frame.surfaces) {
        if (Result<void> r = file.write("o " + object_name(surface.name) + "\n"); !r) return r;
        if (Result<void> r = write_vertices(surface, file); !r) return r;
        if (Result<void> r = write_triangles(surface, first, file); !r) return r;
        first.position += surface.positions.size();
        first.uv += surface.uvs.size();
    }
    return {};
}

Result<StillVertices> read_obj(const std::filesystem::path& path) {
    const Result<std::string> text = read_whole_file(path);
    if (!text) return text.errors();
    StillVertices vertices;
    for (std::string_view rest = *text; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        const bool is_normal = line.starts_with("vn ");
        if (!is_normal && !line.starts_with("v ")) continue;
        Vec3& vector = (is_normal ? vertices.normals : vertices.positions).emplace_back();
        if (!read_vector(line, vector)) return Error{path.string(), "has a line without three numbers"};
    }
    return vertices;
}

}  // namespace weft
