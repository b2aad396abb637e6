#include "io/exports/scene_export.h"

#include "base/temporary_folder.test.h"
#include "io/meshes/mesh_file.h"
#include "io/scenes/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

constexpr const char* triangle = "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n";

TriangleMesh mesh_in_memory() {
    return {.positions = {{0, 0.1f, 0}, {0, 0, 1e-9f}, {1, 0, 0}, {1, 0, 1}},
            .uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 0.3f}},
            .normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0.6f, 0.8f, 0}},
            .colors = {{1, 0, 0.123f, 1}, {0.5f, 0.2f, 0.1f, 1}, {0, 0, 0, 1}, {1, 1, 1, 0.7f}},
            .triangles = {{0, 1, 2}, {2, 1, 3}}};
}

SceneDesc one_cloth(MeshDesc mesh) {
    SceneDesc scene;
    SceneCloth& cloth = scene.cloths.emplace_back();
    cloth.name = "cloth 0";
    cloth.mesh = std::move(mesh);
    return scene;
}

std::string file_of(const MeshDesc& mesh) {
    return std::get<MeshFileDesc>(mesh).file;
}

class SceneExport : public testing::Test {
  protected:
    /// The name of the mesh file in a scene that was in a/ and is written to `to`.
    std::string name_in(const fs::path& to, const std::string& name) {
        const auto written = export_scene(one_cloth(MeshFileDesc{.file = name}), folder.path() / "a", to);
        EXPECT_TRUE(written.ok()) << written.error().message();
        const auto scene = load_scene(to);
        EXPECT_TRUE(scene.ok());
        return file_of(scene->cloths[0].mesh);
    }

    TemporaryFolder folder;
};

TEST_F(SceneExport, FilesAreFoundFromTheNewFolder) {
    folder.write("a/m.obj", triangle);
    folder.write("a/deep/n.obj", triangle);
    folder.write("b/other.txt", "");
    const fs::path here = folder.path();
    EXPECT_EQ(name_in(here / "a/s.json", "m.obj"), "m.obj");
    EXPECT_EQ(name_in(here / "b/s.json", "m.obj"), "../a/m.obj");
    EXPECT_EQ(name_in(here / "a/deep/s.json", "deep/n.obj"), "n.obj");
    EXPECT_EQ(name_in(here / "b/s.json", "missing.obj"), "missing.obj");
    const std::string absolute = (here / "a/m.obj").string();
    EXPECT_EQ(name_in(here / "b/s.json", absolute), absolute);
    // The target folder has another file of that name.
    folder.write("b/m.obj", triangle);
    EXPECT_EQ(name_in(here / "b/s.json", "m.obj"), "../a/m.obj");
}

TEST_F(SceneExport, PicturesMoveWithTheSceneToo) {
    folder.write("a/hall.hdr", "x");
    folder.write("a/cloth.png", "x");
    folder.write("b/other.txt", "");
    SceneDesc scene = one_cloth(GridDesc{});
    scene.light.environment.file = "hall.hdr";
    scene.cloths[0].material = {.preset = "cotton", .values = find_material("cotton")->material};
    scene.colliders = {ColliderDesc{.name = "ball"}};
    scene.colliders[0].material = scene.cloths[0].material;
    scene.cloths[0].material->values.color_map = "cloth.png";
    scene.colliders[0].material->values.normal_map = "cloth.png";
    ASSERT_TRUE(export_scene(scene, folder.path() / "a", folder.path() / "b/s.json").ok());
    const auto again = load_scene(folder.path() / "b/s.json");
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->light.environment.file, "../a/hall.hdr");
    EXPECT_EQ(again->cloths[0].material->values.color_map, "../a/cloth.png");
    EXPECT_EQ(again->colliders[0].material->values.normal_map, "../a/cloth.png");
}

TEST_F(SceneExport, MeshesInMemoryGoIntoFilesBesideIt) {
    SceneDesc scene = one_cloth(mesh_in_memory());
    scene.cloths[0].render_mesh = mesh_in_memory();
    SceneCloth& other = scene.cloths.emplace_back();
    other.name = "cloth 1";
    other.mesh = MeshFileDesc{.file = "s-mesh1.ply"};
    const fs::path path = folder.path() / "s.json";
    const auto written = export_scene(scene, folder.path(), path);
    ASSERT_TRUE(written.ok()) << written.error().message();
    EXPECT_THAT(*written, ElementsAre(path, folder.path() / "s-mesh0.ply", folder.path() / "s-mesh2.ply"))
        << "the second belongs to another cloth";
    const auto again = load_scene(path);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(file_of(again->cloths[0].mesh), "s-mesh0.ply");
    EXPECT_EQ(file_of(*again->cloths[0].render_mesh), "s-mesh2.ply");
    const auto mesh = load_mesh(folder.path() / "s-mesh0.ply");
    ASSERT_TRUE(mesh.ok()) << mesh.error().message();
    EXPECT_TRUE(*mesh == mesh_in_memory());
}

TEST_F(SceneExport, WhatFailsLeavesNothingBehind) {
    SceneDesc scene = one_cloth(mesh_in_memory());
    fs::create_directories(folder.path() / "s-mesh0.ply");
    const auto written = export_scene(scene, folder.path(), folder.path() / "s.json");
    ASSERT_FALSE(written.ok());
    EXPECT_THAT(written.error().message(), HasSubstr("s-mesh0.ply: cannot be written: it is a folder"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
    EXPECT_FALSE(export_scene(scene, folder.path(), folder.path() / "none" / "s.json").ok());
    scene.cloths.clear();
    EXPECT_THAT(export_scene(scene, folder.path(), folder.path() / "s.json").error().message(),
                HasSubstr("/cloths: must hold at least one cloth"));
}

}  // namespace
}  // namespace weft
