#include "io/meshes/mesh_file.h"

#include "base/temporary_folder.test.h"
#include "io/meshes/mesh_fixtures.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>
#include <random>

namespace weft {
namespace {

class MeshFileErrors : public testing::Test {
  protected:
    /// The problem with a file of that content; also checks what all errors have in common.
    std::string problem(const std::string& name, std::string_view content) {
        const std::filesystem::path path = folder_.write(name, content);
        testing::internal::CaptureStderr();
        testing::internal::CaptureStdout();
        const Result<TriangleMesh> mesh = load_mesh(path);
        EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
        if (mesh) return "none";
        EXPECT_EQ(mesh.error().where, path.string());
        EXPECT_EQ(mesh.error().what.find_first_of("\r\n"), std::string::npos) << mesh.error().what;
        return mesh.error().what;
    }

    TemporaryFolder folder_;
};

TEST_F(MeshFileErrors, WhatIsNoFile) {
    EXPECT_EQ(load_mesh("/no/such/file.obj").error().message(), "/no/such/file.obj: does not exist");
    EXPECT_EQ(load_mesh(folder_.path()).error().what, "is a folder, not a file");
    EXPECT_EQ(load_mesh("/dev/null").error().what, "is not a regular file");
    EXPECT_EQ(problem("a.obj", ""), "is empty");
    EXPECT_EQ(problem("a.usd", "x"), "has an unknown ending; known are .obj .ply .gltf .glb .fbx .stl .3ds");
    EXPECT_EQ(problem("mesh", "x"), "has an unknown ending; known are .obj .ply .gltf .glb .fbx .stl .3ds");
}

TEST_F(MeshFileErrors, AFileThatMayNotBeRead) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
    const std::filesystem::path path = folder_.write("a.obj", "v 0 0 0\n");
    ::chmod(path.c_str(), 0);
    EXPECT_EQ(load_mesh(path).error().what, "cannot be opened: Permission denied");
}

TEST_F(MeshFileErrors, NoTriangles) {
    EXPECT_EQ(problem("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "has no triangles");
    EXPECT_EQ(problem("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2\n"), "has no triangles");
    EXPECT_EQ(problem("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                      "property float z\nend_header\n0 0 0\n"),
              "has no triangles");
}

std::string obj(const std::string& last_lines) {
    return "v 0 0 0\nv 1 0 0\nv 1 1 0\n" + last_lines + "\n";
}

TEST_F(MeshFileErrors, ObjIndicesOutOfRange) {
    EXPECT_EQ(problem("a.obj", obj("f 1 2 999999")), "line 4: a face uses number 999999 of 3 vertices");
    EXPECT_EQ(problem("a.obj", obj("f 1 2 0")), "line 4: a face uses number 0 of 3 vertices");
    EXPECT_EQ(problem("a.obj", obj("f 1 2 -4")), "line 4: a face uses number -4 of 3 vertices");
    EXPECT_EQ(problem("a.obj", obj("\n\nf 1/1 2/1 3/1")), "line 6: a face uses number 1 of 0 texture coordinates");
    EXPECT_EQ(problem("a.obj", obj("vn 0 0 1\nf 1//1 2//1 3//2")), "line 5: a face uses number 2 of 1 normals");
    EXPECT_EQ(problem("a.obj", obj("f 1 2 99999999999999999999")),
              "line 4: '99999999999999999999' is not a corner of a face");
    EXPECT_EQ(problem("a.obj", obj("f 1 2 x")), "line 4: 'x' is not a corner of a face");
    EXPECT_EQ(problem("a.obj", obj("f 1 2 3/1/1/1")), "line 4: '3/1/1/1' is not a corner of a face");
}

TEST_F(MeshFileErrors, ObjVerticesThatAreNone) {
    EXPECT_EQ(problem("a.obj", obj("v 0 nan 0\nf 1 2 4")), "line 4: vertex 3 is not finite");
    EXPECT_EQ(problem("a.obj", obj("v 0 -inf 0\nf 1 2 4")), "line 4: vertex 3 is not finite");
    EXPECT_EQ(problem("a.obj", obj("v 0 1e39 0\nf 1 2 4")), "line 4: vertex 3 is not finite");
    EXPECT_EQ(problem("a.obj", obj("v 0 1e999 0\nf 1 2 4")), "line 4: vertex 3 is not finite");
    EXPECT_EQ(problem("a.obj", obj("v 0 1e-999 1e-60\nf 1 2 4")), "none") << "too small for a float is zero";
    EXPECT_EQ(problem("a.obj", obj("v 0 1\nf 1 2 3")), "line 4: a vertex needs three numbers, got 2");
    EXPECT_EQ(problem("a.obj", obj("v 0,5 1 2\nf 1 2 3")), "line 4: '0,5' is not a number");
    EXPECT_EQ(problem("a.obj", obj("v 0 1 2 3 4 5 6 7\nf 1 2 3")), "line 4: more than 7 numbers");
    EXPECT_EQ(problem("a.obj", obj("vt nan 0\nf 1/1 2/1 3/1")), "line 4: texture coordinate 0 is not finite");
}

TEST_F(MeshFileErrors, PlyThatAssimpWouldCrashOn) {
    const std::string ascii = fixtures::ply_ascii(), binary = fixtures::ply_binary(false);
    const std::size_t header = fixtures::ply_header("ascii").size();
    for (std::size_t size = 1; size < ascii.size() - 2; ++size) {
        EXPECT_NE(problem("a.ply", std::string_view(ascii).substr(0, size)), "none") << "cut to " << size << " bytes";
    }
    for (std::size_t size = header; size < binary.size(); ++size) {
        EXPECT_NE(problem("a.ply", std::string_view(binary).substr(0, size)), "none") << "cut to " << size << " bytes";
    }
    EXPECT_EQ(problem("a.ply", ascii.substr(0, header + 14)), "is cut short at vertex 2 of 5");
    EXPECT_EQ(problem("a.ply", fixtures::ply_header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n3 0 1 2\n0\n"),
              "face 1 has no corners");
    std::string huge = ascii;
    huge.replace(huge.find("vertex 5"), 8, "vertex 4000000000");
    EXPECT_EQ(problem("a.ply", huge), "has more values than properties at vertex 5");
}

// Each of these made Assimp read the file differently from the check before it, and abort or access memory out of
// bounds.
TEST_F(MeshFileErrors, PlyThatCanBeReadInTwoWays) {
    const std::string whole = fixtures::ply_ascii();
    ASSERT_EQ(problem("a.ply", whole), "none");
    const auto with = [&](const std::string& from, const std::string& to) {
        return problem("a.ply", std::string(whole).replace(whole.find(from), from.size(), to));
    };
    EXPECT_EQ(with("float x\nprop", "float x\vprop"), "has control characters in its header");
    EXPECT_EQ(with("element face", std::string("comment \0\nelement face", 22)),
              "has control characters in its header");
    EXPECT_EQ(with("5 5 5", "5\v5 5"), "has control characters");
    EXPECT_EQ(with("5 5 5", "5 dae 5"), "has 'dae' at vertex 1");
    EXPECT_EQ(with("5 5 5", "5 5 5 5"), "has more values than properties at vertex 1");
    EXPECT_EQ(with("5 5 5", "+5 5e0 -.5"), "none");
    EXPECT_EQ(with("3 3 0 2", "3 3 0 2.5"), "has '2.5' at face 0");
    EXPECT_EQ(with("element face", "element vertex 5\nelement face"), "bad header line 'element vertex 5'");
    EXPECT_EQ(with("element face", "element tristrips"), "bad header line 'element tristrips 2'");
    EXPECT_THAT(with("int vertex_ind", "float vertex_ind"), testing::StartsWith("bad header line 'property list"));
}

TEST_F(MeshFileErrors, PlyIndicesOutOfRangeAndCoordinatesThatAreNone) {
    EXPECT_EQ(problem("a.ply", fixtures::ply_binary(false, 99999)), "face 1 uses vertex 99999 of 5");
    EXPECT_EQ(problem("a.ply", fixtures::ply_binary(true, -1)), "face 1 uses vertex -1 of 5");
    std::string ascii = fixtures::ply_ascii();
    EXPECT_EQ(problem("a.ply", std::string(ascii).replace(ascii.rfind('4'), 1, "5")), "face 1 uses vertex 5 of 5");
    EXPECT_EQ(problem("a.ply", ascii.replace(ascii.find("5 5 5"), 5, "5 nan 5")), "vertex 1 is not finite");
}

TEST_F(MeshFileErrors, GltfIndicesOutOfRangeAndCoordinatesThatAreNone) {
    EXPECT_EQ(problem("a.gltf", fixtures::gltf({.indices = {0, 1, 2, 1, 9999, 2}})),
              "1 of 2 triangles use vertices that do not exist");
    EXPECT_NE(problem("a.gltf", fixtures::gltf({.indices = {7, 8, 9}})), "none");
    EXPECT_NE(problem("a.gltf", fixtures::gltf({.indices = {0, 1, 2}, .claimed = 30000})), "none");
    const std::string whole = fixtures::gltf({.indices = {0, 1, 2}});
    EXPECT_EQ(problem("a.gltf", whole.substr(0, whole.size() - 30)), "is damaged, or not what its ending says");
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(problem("a.gltf", fixtures::gltf({.indices = {0, 1, 2}, .first_x = infinity})), "vertex 0 is not finite");
}

TEST_F(MeshFileErrors, OtherFormatsWithIndicesOutOfRange) {
    EXPECT_EQ(problem("a.3ds", fixtures::three_ds({0, 1, 3})), "triangle 0 uses vertex 3 of 3");
    EXPECT_EQ(problem("a.fbx", fixtures::fbx_ascii("0,1,30,-4")), "has no triangles");
}

// Assimp follows each of these until the stack overflows, or for a very long time.
TEST_F(MeshFileErrors, PartsWithinPartsWithoutEnd) {
    const auto repeated = [](std::string_view text, int times) {
        std::string all;
        for (int i = 0; i < times; ++i) all += text;
        return all;
    };
    EXPECT_EQ(problem("a.gltf", R"({"asset":{"version":"2.0"},"extras":)" + repeated("[", 500000)),
              "has brackets nested more than 200 deep");
    EXPECT_EQ(problem("a.gltf", R"({"asset":{"version":"2.0"},"extras":"\")" + repeated("[", 500) + "\"}"),
              "cannot be read: GLTF: No scene")
        << "in a text they mean nothing";
    EXPECT_EQ(problem("a.fbx", "; FBX 7.4.0 project file\n" + repeated("A: {\n", 500000)),
              "has blocks nested more than 200 deep");

    const std::string head = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"meshes":[],"nodes":[)";
    const std::string circle = "has nodes that are their own descendants or have many parents";
    std::string chain, twice;
    for (int i = 1; i <= 100000; ++i) chain += "{\"children\":[" + std::to_string(i) + "]},";
    for (int i = 1; i <= 60; ++i) twice += "{\"children\":[" + std::to_string(i) + ',' + std::to_string(i) + "]},";
    EXPECT_EQ(problem("a.gltf", head + chain + "{}]}"), "has nodes nested more than 1000 deep");
    EXPECT_EQ(problem("a.gltf", head + twice + "{}]}"), circle);
    EXPECT_EQ(problem("a.gltf", head + R"({"children":[1]},{"children":[0]}]})"), circle);

    std::string text = fixtures::fbx_ascii("0,1,2,-4");
    ASSERT_EQ(problem("a.fbx", text), "none");
    const std::string link = "\tC: \"OO\",2000,0\n";
    EXPECT_EQ(problem("a.fbx", text.replace(text.find(link), 0, "\tC: \"OO\",2000,2000\n")), circle);
    EXPECT_EQ(problem("a.fbx", fixtures::fbx_binary({{1, 0}, {2, 1}, {3, 2}})), "none");
    EXPECT_EQ(problem("a.fbx", fixtures::fbx_binary({{1, 0}, {2, 1}, {1, 2}, {3, 2}})), circle);
    std::string deep = fixtures::fbx_binary({}).substr(0, 27);
    for (std::size_t level = 0; level < 100000; ++level) {  // each ends where its parent ends, minus the parent's zeros
        fixtures::append(deep, static_cast<std::uint32_t>(27 + 100000 * 27 - level * 13));
        deep.append(8, '\0').append("\1A");
    }
    EXPECT_EQ(problem("a.fbx", deep.append(100000 * 13, '\0')), "has blocks nested more than 200 deep");
}

TEST_F(MeshFileErrors, GlbThatClaimsMoreThanItHas) {
    std::string glb = "glTF";
    for (const std::uint32_t word : {2u, 40u, 0x7fffffffu, 0x4e4f534au}) fixtures::append(glb, word);
    EXPECT_EQ(problem("a.glb", glb + R"({"asset":{"version":"2.0"}})"),
              "is cut short: its text ends at byte 2147483667 of 47");
}

TEST_F(MeshFileErrors, EveryFormatCutShortOrDamaged) {
    const std::pair<const char*, std::string> files[] = {
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n"},
        {"a.gltf", fixtures::gltf({.indices = {0, 1, 2}})},
        {"a.fbx", fixtures::fbx_ascii("0,1,2,-4")},
        {"b.fbx", fixtures::fbx_binary({{1, 0}, {2, 1}, {3, 2}})},
        {"a.3ds", fixtures::three_ds({0, 1, 2})},
        {"a.stl", fixtures::stl_binary()},
        {"a.ply", fixtures::ply_binary(false)},
    };
    std::mt19937 random(2);
    for (const auto& [name, whole] : files) {
        for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 200)
            problem(name, std::string_view(whole).substr(0, size));
        for (int i = 0; i < 200; ++i) {
            std::string damaged = whole;
            for (int n = 0; n < 1 + i % 3; ++n) damaged[random() % whole.size()] = static_cast<char>(random());
            problem(name, damaged);
        }
    }
}

TEST_F(MeshFileErrors, StlCutShort) {
    const std::string ascii = fixtures::stl_ascii(), binary = fixtures::stl_binary();
    for (std::size_t size = 1; size < ascii.find("endsolid"); ++size) {
        EXPECT_NE(problem("a.stl", std::string_view(ascii).substr(0, size)), "none") << "cut to " << size << " bytes";
    }
    for (std::size_t size = 1; size < binary.size(); ++size) {
        EXPECT_NE(problem("a.stl", std::string_view(binary).substr(0, size)), "none") << "cut to " << size << " bytes";
    }
    EXPECT_EQ(problem("a.stl", ascii.substr(0, ascii.find("endsolid"))), "is cut short: it has no endsolid");
}

TEST_F(MeshFileErrors, GarbageInEveryFormat) {
    std::mt19937 random(1);
    for (std::string_view format : mesh_formats()) {
        for (std::size_t size : {1u, 17u, 5000u}) {
            std::string garbage(size, '\0');
            for (char& c : garbage) c = static_cast<char>(random());
            EXPECT_NE(problem("a" + std::string(format), garbage), "none") << format;
        }
    }
}

}  // namespace
}  // namespace weft
