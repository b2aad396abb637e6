#include "io/exports/film_fixtures.test.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <sstream>

namespace weft {
namespace {

using test::Cloth;
using test::export_film;
using test::Instant;
using test::make_cloth;
using test::read_text;
using test::TestFolder;

struct Corner {
    std::size_t position = 0, uv = 0, normal = 0;
};

/// Reads only what the exporter writes.
struct ObjText {
    std::vector<std::string> names;
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::array<Corner, 3>> faces;

    explicit ObjText(const std::string& text) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream in(line);
            std::string keyword, x, y, z;
            in >> keyword >> x >> y >> z;
            if (keyword == "o") names.push_back(line.substr(2));
            if (keyword == "v") positions.push_back({std::stof(x), std::stof(y), std::stof(z)});
            if (keyword == "vn") normals.push_back({std::stof(x), std::stof(y), std::stof(z)});
            if (keyword == "vt") uvs.push_back({std::stof(x), std::stof(y)});
            if (keyword == "f") faces.push_back({corner(x), corner(y), corner(z)});
        }
    }
    static Corner corner(const std::string& text) {
        const std::size_t a = text.find('/'), b = text.rfind('/');
        Corner c{std::stoul(text), 0, std::stoul(text.substr(b + 1))};
        if (b > a + 1) c.uv = std::stoul(text.substr(a + 1));
        return c;
    }
};

TEST(ObjExport, ReadsBackTheSameFloatsWithIndicesThroughAllCloths) {
    const TestFolder folder;
    std::vector<Cloth> cloths = {make_cloth("plain", 5, 0), make_cloth("left sleeve\n", 7, 1),
                                 make_cloth("right", 4, 0.3f)};
    cloths[0].mesh.uvs.clear();
    ASSERT_TRUE(export_film(folder / "a.obj", cloths, 3).ok());
    const ObjText obj(read_text(folder / "a.obj"));
    EXPECT_EQ(obj.names, (std::vector<std::string>{"plain", "left_sleeve_", "right"}));

    Instant last(cloths, 2, 2.0 / 60);
    std::size_t vertex = 0, uv = 0, face = 0;
    for (std::size_t c = 0; c < cloths.size(); ++c) {
        const TriangleMesh& mesh = cloths[c].mesh;
        for (const Triangle& triangle : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Corner& corner = obj.faces.at(face)[k];
                EXPECT_EQ(corner.position, vertex + triangle[k] + 1);
                EXPECT_EQ(corner.normal, corner.position);
                EXPECT_EQ(corner.uv, mesh.uvs.empty() ? 0 : uv + triangle[k] + 1);
            }
            ++face;
        }
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_EQ(obj.positions.at(vertex + i), last.positions(c)[i]);
            EXPECT_EQ(obj.normals.at(vertex + i), last.normals(c)[i]);
            if (!mesh.uvs.empty()) {
                EXPECT_EQ(obj.uvs.at(uv + i), mesh.uvs[i]);
            }
        }
        vertex += mesh.positions.size();
        uv += mesh.uvs.size();
    }
    EXPECT_EQ(obj.faces.size(), face);
    EXPECT_EQ(obj.positions.size(), vertex);
    EXPECT_EQ(obj.uvs.size(), uv);
}

TEST(ObjExport, ExtremeFloatsSurvive) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("c", 2, 0)};
    Instant instant(cloths, 0, 0);
    instant.positions(0)[0] = {FLT_MIN, -FLT_MAX, 0.1f};
    instant.positions(0)[1] = {1.0f / 3, 16777216.0f, -1e-7f};
    instant.normals(0)[0] = {};
    const auto exporter = make_exporter(folder / "a.obj");
    ASSERT_TRUE(exporter.ok() && (*exporter)->begin({}).ok());
    ASSERT_TRUE((*exporter)->write(instant.frame()).ok() && (*exporter)->finish().ok());
    const ObjText obj(read_text(folder / "a.obj"));
    EXPECT_EQ(obj.positions[0], instant.positions(0)[0]);
    EXPECT_EQ(obj.positions[1], instant.positions(0)[1]);
    EXPECT_EQ(obj.normals[0], (Vec3{0, 1, 0}));
}

}  // namespace
}  // namespace weft
