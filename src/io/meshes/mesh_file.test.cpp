// Tests of reading valid meshes; mesh_file_errors.test.cpp tests invalid ones.
#include "io/meshes/mesh_file.h"

#include <weft/bounds.h>
#include "base/temporary_folder.test.h"
#include "io/meshes/mesh_fixtures.test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace weft {
namespace {

class MeshFile : public testing::Test {
  protected:
    TriangleMesh load(const std::string& name, std::string_view content) {
        Result<TriangleMesh> mesh = load_mesh(folder_.write(name, content));
        if (!mesh) ADD_FAILURE() << mesh.error().message();
        return mesh ? *mesh : TriangleMesh{};
    }
    TemporaryFolder folder_;
};

const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> square_triangles{{0, 1, 2}, {0, 2, 3}};

TEST_F(MeshFile, ObjVerticesComeInTheOrderOfTheirLinesWhateverFacesUseFirst) {
    const TriangleMesh mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 4 1 3\nf 3 1 2\n");
    EXPECT_EQ(mesh.positions, square);
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{3, 0, 2}, {2, 0, 1}}));
    EXPECT_TRUE(mesh.uvs.empty());
    EXPECT_TRUE(mesh.normals.empty()) << "none in the file, none made up";
    EXPECT_TRUE(mesh.colors.empty());
}

TEST_F(MeshFile, ObjKeepsLinesThatNoFaceUses) {
    const TriangleMesh mesh = load("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 8 8 8\nv 1 1 0\nv 7 7 7\nf 2 3 5\n");
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {8, 8, 8}, {1, 1, 0}, {7, 7, 7}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{1, 2, 4}}));
}

TEST_F(MeshFile, ObjLinesAtOnePlaceStayApart) {
    const TriangleMesh mesh = load("a.obj",
                                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 1 0\nv 0 0 0\nv 0 1 0\n"
                                   "f 4 6 5\nf 1 2 3\n");
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{3, 5, 4}, {0, 1, 2}}));
}

TEST_F(MeshFile, ObjVerticesSplitOnlyWhereUvsOrNormalsDiffer) {
    const TriangleMesh mesh = load("a.obj",
                                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                   "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\n"
                                   "f 1/1/1 2/2/1 3/3/1\nf 1/5/1 3/3/1 4/4/1\n");
    ASSERT_EQ(mesh.positions.size(), 5u) << "vertex 0 has two UVs, the others one";
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0, 0}, {0.5f, 0.5f}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(mesh.normals, std::vector<Vec3>(5, {0, 0, 1}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 2, 3}, {1, 3, 4}}));
}

TEST_F(MeshFile, ObjColorsOfVertexLines) {
    const TriangleMesh mesh = load("a.obj", "v 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0 0 1 0.25 0.5\nf 1 2 3\n");
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    EXPECT_EQ(mesh.colors, (std::vector<Vec4>{{1, 1, 1, 1}, {1, 0, 0, 1}, {0, 1, 0.25f, 0.5f}}));
}

TEST_F(MeshFile, ObjInItsManySpellings) {
    const std::string spellings[] = {
        "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3\r\nf 1 3 4\r\n",
        "# C:\\models\\\nmtllib no such.mtl\n  v 0 0 0\n\tv  1 0 0\nv 1\t1 0\nv 0 1 0 # last\no a\ng b\nf 1 2 3\nf 1 3 "
        "4",
        "v 0 0 \\\n0\nv 1 \\\r\n 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n3\nf 1 3 4\n",
        "v +0 0. 0e0 2\nv 1.0 .0 0 1\nv 1e0 1 0\nv 0 10E-1 0\nf -4 -3 -2\nf -4 -2 -1\n",
        "f 1 2 3\nf 1 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3\np 1\nl 1 2\no second\nusemtl b\ns 1\nf 1 3 4\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
    };
    for (const std::string& text : spellings) {
        const TriangleMesh mesh = load("a.obj", text);
        EXPECT_EQ(mesh.positions, square) << text;
        EXPECT_EQ(mesh.triangles, square_triangles) << text;
    }
}

TEST_F(MeshFile, ConcavePolygonsAreCutInside) {
    const TriangleMesh mesh = load("a.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nf 1 2 3 4\n");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    float area = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        area += 0.5f * cross(b - a, c - a).z;
        EXPECT_GT(cross(b - a, c - a).z, 0) << "no piece is turned over";
    }
    EXPECT_FLOAT_EQ(area, 4);
}

TEST_F(MeshFile, CloseVerticesAreNotJoined) {
    const TriangleMesh mesh = load("a.obj", "v 0 0 0\nv 1e-6 0 0\nv 0 1e-6 0\nv 1e-6 1e-6 0\nf 1 2 3\nf 2 4 3\n");
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1e-6f, 0, 0}, {0, 1e-6f, 0}, {1e-6f, 1e-6f, 0}}));
}

TEST_F(MeshFile, ObjWithMoreVerticesThanOneChannelOfTheNumberHolds) {
    std::string text;
    for (int i = 0; i < (1 << 20) + 10; ++i) text += "v " + std::to_string(i) + " 0 0\n";
    const TriangleMesh mesh = load("a.obj", text + "v 0 1 0\nf 1048580 2 -1\n");
    ASSERT_EQ(mesh.positions.size(), (1u << 20) + 11);
    for (std::uint32_t i = 0; i < (1u << 20) + 10; i += 4097) EXPECT_EQ(mesh.positions[i].x, float(i));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{1048579, 1, 1048586}}));
}

TEST_F(MeshFile, BunnyIsItsVertexLinesInOrder) {
    const std::filesystem::path path = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs glmark2-data";
    std::vector<Vec3> expected;
    std::ifstream file(path);
    for (std::string word; file >> word;) {
        std::string x, y, z;
        if (word == "v" && file >> x >> y >> z) {
            expected.push_back(
                {std::strtof(x.c_str(), nullptr), std::strtof(y.c_str(), nullptr), std::strtof(z.c_str(), nullptr)});
        }
    }
    const Result<TriangleMesh> mesh = load_mesh(path);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(expected.size(), 34835u);
    EXPECT_EQ(mesh->positions, expected);
    EXPECT_EQ(mesh->triangles.size(), 69666u);
}

TEST_F(MeshFile, PlyInEveryEncodingKeepsItsOrderAndItsUnusedVertices) {
    const std::vector<Vec3> expected{{0, 0, 0}, {5, 5, 5}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    for (const std::string& content :
         {fixtures::ply_ascii(), fixtures::ply_binary(false), fixtures::ply_binary(true)}) {
        const TriangleMesh mesh = load("a.ply", content);
        EXPECT_EQ(mesh.positions, expected);
        EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{3, 0, 2}, {2, 4, 3}}));
        EXPECT_TRUE(mesh.normals.empty());
    }
}

TEST_F(MeshFile, PlyColorsAndPolygons) {
    const TriangleMesh mesh = load("a.PLY",
                                   "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
                                   "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
                                   "property uchar blue\nelement face 1\nproperty list uchar int vertex_index\n"
                                   "end_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 255 255 255\n"
                                   "4 0 1 2 3\n");
    EXPECT_EQ(mesh.positions, square);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.colors, (std::vector<Vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}}));
}

TEST_F(MeshFile, StlJoinsTheCornersOfItsFacets) {
    for (const std::string& content : {fixtures::stl_ascii(), fixtures::stl_binary()}) {
        const TriangleMesh mesh = load("a.stl", content);
        EXPECT_EQ(mesh.positions, square);
        EXPECT_EQ(mesh.triangles, square_triangles);
        EXPECT_TRUE(mesh.normals.empty()) << "one per facet would split every vertex of a curved surface";
    }
}

TEST_F(MeshFile, GltfKeepsItsOrderAndAppliesItsNodes) {
    const TriangleMesh mesh = load("a.gltf", fixtures::gltf({.indices = {0, 3, 1, 0, 2, 3}}));
    // The node turns x to y, doubles and moves by 10 along x. Vertex 4 is in no face.
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{10, 0, 0}, {10, 2, 0}, {8, 0, 0}, {8, 2, 0}, {10, 0, 6}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 3, 1}, {0, 2, 3}}));
}

TEST_F(MeshFile, GltfInstancesOfOneMeshAllCome) {
    const TriangleMesh mesh = load("a.gltf", fixtures::gltf({.indices = {0, 1, 2}, .instances = 3}));
    EXPECT_EQ(mesh.triangles.size(), 3u);
    const Bounds bounds = bounds_of(mesh.positions);
    EXPECT_FLOAT_EQ(bounds.max.x, 30);
}

TEST_F(MeshFile, MirroredNodesKeepTrianglesFacingOutward) {
    const TriangleMesh mesh = load("a.gltf", fixtures::gltf({.indices = {0, 1, 2}, .mirrored = true}));
    ASSERT_EQ(mesh.triangles.size(), 1u);
    const Triangle t = mesh.triangles[0];
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    EXPECT_GT(cross(b - a, c - a).z, 0) << "a mirror across x does not turn a front that looks along z";
}

TEST_F(MeshFile, FbxAppliesItsTransforms) {
    const TriangleMesh mesh = load("a.fbx", fixtures::fbx_ascii("0,1,2,-4"));
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{10, 0, 0}, {11, 0, 0}, {11, 1, 0}, {10, 1, 0}}));
    EXPECT_EQ(mesh.triangles, square_triangles);
    EXPECT_TRUE(mesh.normals.empty());
}

TEST_F(MeshFile, ThreeDsKeepsItsAxes) {
    const TriangleMesh mesh = load("a.3ds", fixtures::three_ds({0, 1, 2}));
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 3}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST_F(MeshFile, ReadsWhatItClaimsToRead) {
    EXPECT_EQ(mesh_formats().size(), 7u);
    for (std::string_view format : mesh_formats()) {
        const auto missing = load_mesh(folder_.path() / ("no" + std::string(format)));
        EXPECT_EQ(missing.error().what, "does not exist");
        const auto one_byte = load_mesh(folder_.write("x" + std::string(format), "x"));
        ASSERT_FALSE(one_byte.ok());
        EXPECT_EQ(one_byte.error().what.find("ending that is none"), std::string::npos) << format;
    }
}

}  // namespace
}  // namespace weft
