#include "io/exports/film_fixtures.test.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

namespace weft {
namespace {

using test::Cloth;
using test::export_film;
using test::Instant;
using test::make_cloth;
using test::read_text;
using test::TestFolder;

struct PlyVertex {
    Vec3 position, normal;
    Vec2 uv;
    std::array<std::uint8_t, 4> color{};
};

/// Takes sizes and order from the header, like any reader.
struct PlyFile {
    std::vector<std::string> properties;
    std::vector<PlyVertex> vertices;
    std::vector<Triangle> faces;
    std::size_t bytes_left = 0;

    explicit PlyFile(const std::string& text) {
        const std::string end = "end_header\n";
        const std::size_t body = text.find(end) + end.size();
        std::istringstream header(text.substr(0, body));
        std::size_t vertex_count = 0, face_count = 0;
        for (std::string line; std::getline(header, line);) {
            std::istringstream in(line);
            std::string a, b, c;
            in >> a >> b >> c;
            if (a == "element") (b == "vertex" ? vertex_count : face_count) = std::stoul(c);
            if (a == "property" && b != "list") properties.push_back(c);
        }
        const char* at = text.data() + body;
        const auto take = [&](auto& value) {
            std::memcpy(&value, at, sizeof value);
            at += sizeof value;
        };
        vertices.resize(vertex_count);
        for (PlyVertex& v : vertices) {
            for (const std::string& name : properties) {
                if (name == "x") take(v.position);
                if (name == "nx") take(v.normal);
                if (name == "s") take(v.uv);
                if (name == "red") take(v.color);
            }
        }
        faces.resize(face_count);
        for (Triangle& face : faces) {
            std::uint8_t corners = 0;
            take(corners);
            EXPECT_EQ(corners, 3);
            take(face);
        }
        bytes_left = static_cast<std::size_t>(text.data() + text.size() - at);
    }
};

TEST(PlyExport, ReadsBackEveryNumberOfTheLastFrame) {
    const TestFolder folder;
    std::vector<Cloth> cloths = {make_cloth("a", 5, 0, true), make_cloth("b", 7, 1)};
    ASSERT_TRUE(export_film(folder / "a.ply", cloths, 4).ok());
    const std::string text = read_text(folder / "a.ply");
    EXPECT_EQ(text.find("ply\nformat binary_little_endian 1.0\n"), 0u);
    const PlyFile ply(text);
    EXPECT_EQ(ply.properties,
              (std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz", "s", "t", "red", "green", "blue", "alpha"}));
    EXPECT_EQ(ply.bytes_left, 0u);

    Instant last(cloths, 3, 3.0 / 60);
    std::uint32_t vertex = 0;
    std::size_t face = 0;
    for (std::size_t c = 0; c < cloths.size(); ++c) {
        const TriangleMesh& mesh = cloths[c].mesh;
        for (const Triangle& t : mesh.triangles) {
            EXPECT_EQ(ply.faces.at(face++), (Triangle{vertex + t[0], vertex + t[1], vertex + t[2]}));
        }
        for (std::size_t i = 0; i < mesh.positions.size(); ++i, ++vertex) {
            const PlyVertex& v = ply.vertices.at(vertex);
            EXPECT_EQ(v.position, last.positions(c)[i]);
            EXPECT_EQ(v.normal, last.normals(c)[i]);
            EXPECT_EQ(v.uv, mesh.uvs[i]);
            const Vec4 color = mesh.colors.empty() ? Vec4{1, 1, 1, 1} : mesh.colors[i];
            EXPECT_NEAR(v.color[0], color.x * 255, 0.501);
            EXPECT_NEAR(v.color[1], color.y * 255, 0.501);
            EXPECT_NEAR(v.color[2], color.z * 255, 0.501);
            EXPECT_NEAR(v.color[3], color.w * 255, 0.501);
        }
    }
    EXPECT_EQ(ply.vertices.size(), vertex);
    EXPECT_EQ(ply.faces.size(), face);
}

TEST(PlyExport, WritesNoColumnsThatNoClothHas) {
    const TestFolder folder;
    std::vector<Cloth> cloths = {make_cloth("a", 3, 0)};
    cloths[0].mesh.uvs.clear();
    ASSERT_TRUE(export_film(folder / "a.ply", cloths, 1).ok());
    const PlyFile ply(read_text(folder / "a.ply"));
    EXPECT_EQ(ply.properties, (std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz"}));
    EXPECT_EQ(ply.bytes_left, 0u);
}

}  // namespace
}  // namespace weft
