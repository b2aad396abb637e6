// Small files in every format that load_mesh() reads, made in memory.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::fixtures {

template <class T>
void append(std::string& out, T value, bool big_endian = false) {
    const std::string_view bytes(reinterpret_cast<const char*>(&value), sizeof value);
    out.append(big_endian ? std::string(bytes.rbegin(), bytes.rend()) : std::string(bytes));
}

inline std::string ply_header(std::string_view format) {
    return "ply\nformat " + std::string(format) +
           " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
}

/// Five vertices, the second in no face, and two triangles: 3 0 2 and 2 4 3.
inline std::string ply_ascii() {
    return ply_header("ascii") + "0 0 0\n5 5 5\n1 0 0\n0 1 0\n1 1 0\n3 3 0 2\n3 2 4 3\n";
}

inline std::string ply_binary(bool big_endian, std::int32_t last_index = 3) {
    std::string out = ply_header(big_endian ? "binary_big_endian" : "binary_little_endian");
    for (float x : {0, 0, 0, 5, 5, 5, 1, 0, 0, 0, 1, 0, 1, 1, 0}) append(out, x, big_endian);
    for (const std::vector<std::int32_t>& face : {std::vector{3, 0, 2}, std::vector{2, 4, last_index}}) {
        append(out, static_cast<std::uint8_t>(face.size()));
        for (std::int32_t index : face) append(out, index, big_endian);
    }
    return out;
}

/// The unit square in two facets.
inline std::string stl_ascii() {
    return "solid square\n"
           "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
           "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
           "endsolid square\n";
}

inline std::string stl_binary() {
    std::string out(80, ' ');
    append(out, std::uint32_t{2});
    for (const std::vector<float>& facet : {std::vector<float>{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0},
                                            std::vector<float>{0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0}}) {
        for (float x : facet) append(out, x);
        append(out, std::uint16_t{0});
    }
    return out;
}

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t b = 0; b < 3; ++b) {
            group = group << 8 | (i + b < bytes.size() ? static_cast<unsigned char>(bytes[i + b]) : 0u);
        }
        for (int d = 3; d >= 0; --d) out.push_back(digits[group >> (6 * d) & 63]);
    }
    if (bytes.size() % 3 > 0)
        out.replace(out.size() - (3 - bytes.size() % 3), std::string::npos, 3 - bytes.size() % 3, '=');
    return out;
}

struct Gltf {
    std::vector<std::uint16_t> indices;
    int instances = 1;        ///< each 10 further along x
    bool mirrored = false;    ///< scale -1 along x, without rotation and doubling
    std::size_t claimed = 0;  ///< the number of indices that the accessor states; 0: the true one
    float first_x = 0;
};

/// Five vertices: the unit square's, and one above it that no test uses in a face.
inline std::string gltf(const Gltf& options) {
    std::string buffer;
    for (float x : {options.first_x, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f, 0.f, 0.f, 3.f})
        append(buffer, x);
    for (std::uint16_t index : options.indices) append(buffer, index);
    std::string nodes, roots;
    for (int i = 0; i < options.instances; ++i) {
        const std::string x = std::to_string(10 * (i + 1));
        nodes += std::string(i > 0 ? "," : "") + R"({"mesh":0,"matrix":)" +
                 (options.mirrored ? "[-1,0,0,0, 0,1,0,0, 0,0,1,0, " : "[0,2,0,0, -2,0,0,0, 0,0,2,0, ") + x +
                 ",0,0,1]}";
        roots += (i > 0 ? "," : "") + std::to_string(i);
    }
    const std::size_t count = options.claimed > 0 ? options.claimed : options.indices.size();
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" + nodes +
           R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" +
           R"("buffers":[{"byteLength":)" + std::to_string(buffer.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64(buffer) + R"("}],)" +
           R"("bufferViews":[{"buffer":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":)" +
           std::to_string(2 * options.indices.size()) + R"(}],)" +
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},)" +
           R"({"bufferView":1,"componentType":5123,"count":)" + std::to_string(count) + R"(,"type":"SCALAR"}]})";
}

/// The unit square as one polygon, moved by 10 along x; the last index of a polygon is its complement.
inline std::string fbx_ascii(std::string_view polygon) {
    return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
           "Objects:  {\n\tGeometry: 1000, \"Geometry::\", \"Mesh\" {\n\t\tVertices: *12 {\n"
           "\t\t\ta: 0,0,0,1,0,0,1,1,0,0,1,0\n\t\t}\n\t\tPolygonVertexIndex: *4 {\n\t\t\ta: " +
           std::string(polygon) +
           "\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n\tModel: 2000, \"Model::sheet\", \"Mesh\" {\n\t\tVersion: 232\n"
           "\t\tProperties70:  {\n\t\t\tP: \"Lcl Translation\", \"Lcl Translation\", \"\", "
           "\"A\",10,0,0\n\t\t}\n\t}\n}\n"
           "Connections:  {\n\tC: \"OO\",2000,0\n\tC: \"OO\",1000,2000\n}\n";
}

/// A node of a binary FBX file of version 7.4; its properties in binary form.
struct FbxRecord {
    std::string name, properties;
    std::uint32_t count = 0;  ///< of the properties
    std::vector<FbxRecord> within = {};

    std::string bytes(std::size_t at) const {
        std::string out, inner;
        const std::size_t begin = at + 13 + name.size() + properties.size();
        for (const FbxRecord& record : within) inner += record.bytes(begin + inner.size());
        if (!within.empty()) inner.append(13, '\0');
        append(out, static_cast<std::uint32_t>(begin + inner.size()));
        append(out, count);
        append(out, static_cast<std::uint32_t>(properties.size()));
        out.push_back(static_cast<char>(name.size()));
        return out + name + properties + inner;
    }
};

inline std::string fbx_text(std::string_view text) {
    std::string out = "S";
    append(out, static_cast<std::uint32_t>(text.size()));
    return out.append(text);
}

inline std::string fbx_number(std::int64_t number) {
    std::string out = "L";
    append(out, number);
    return out;
}

template <class T>
std::string fbx_array(char type, const std::vector<T>& values) {
    std::string out(1, type);
    for (const std::size_t head : {values.size(), std::size_t{0}, sizeof(T) * values.size()})
        append(out, static_cast<std::uint32_t>(head));
    for (const T value : values) append(out, value);
    return out;
}

/// Two models, 1 and 2, and a triangle, 3, connected by the pairs: child, parent. 0 is the root.
inline std::string fbx_binary(const std::vector<std::pair<int, int>>& connections) {
    const auto integer = [](const char* name, std::int32_t value) {
        std::string property = "I";
        append(property, value);
        return FbxRecord{name, property, 1};
    };
    const auto object = [](const char* kind, int number, std::vector<FbxRecord> within) {
        const std::string name = std::string("part\0\x01", 6) + kind;
        return FbxRecord{kind, fbx_number(number) + fbx_text(name) + fbx_text("Mesh"), 3, std::move(within)};
    };
    FbxRecord head{"FBXHeaderExtension", "", 0, {integer("FBXHeaderVersion", 1003), integer("FBXVersion", 7400)}};
    FbxRecord objects{"Objects", "", 0, {}}, pairs{"Connections", "", 0, {}};
    for (const int model : {1, 2}) objects.within.push_back(object("Model", model, {integer("Version", 232)}));
    const std::vector<double> corners{0, 0, 0, 1, 0, 0, 1, 1, 0};
    objects.within.push_back(object("Geometry", 3,
                                    {{"Vertices", fbx_array('d', corners), 1},
                                     {"PolygonVertexIndex", fbx_array('i', std::vector<std::int32_t>{0, 1, -3}), 1},
                                     integer("GeometryVersion", 124)}));
    for (const auto& [below, above] : connections)
        pairs.within.push_back({"C", fbx_text("OO") + fbx_number(below) + fbx_number(above), 3});
    std::string out("Kaydara FBX Binary  \0\x1a\0", 23);
    append(out, std::uint32_t{7400});
    for (const FbxRecord& record : {head, objects, pairs}) out += record.bytes(out.size());
    return out.append(13, '\0');
}

inline std::string three_ds_chunk(std::uint16_t kind, std::string_view body) {
    std::string out;
    append(out, kind);
    append(out, static_cast<std::uint32_t>(body.size() + 6));
    return out.append(body);
}

/// One triangle of three vertices, without normals or UVs.
inline std::string three_ds(const std::vector<std::uint16_t>& triangle) {
    std::string vertices, faces;
    append(vertices, std::uint16_t{3});
    for (float x : {0, 0, 0, 1, 0, 0, 0, 2, 3}) append(vertices, x);
    append(faces, std::uint16_t{1});
    for (std::uint16_t index : triangle) append(faces, index);
    append(faces, std::uint16_t{7});
    const std::string mesh = three_ds_chunk(0x4100, three_ds_chunk(0x4110, vertices) + three_ds_chunk(0x4120, faces));
    const std::string object = three_ds_chunk(0x4000, std::string("sheet\0", 6) + mesh);
    return three_ds_chunk(0x4d4d, three_ds_chunk(0x3d3d, object));
}

}  // namespace weft::fixtures
