// A simulation that is saved as a scene and loaded again begins at the same start.
#include "base/temporary_folder.test.h"
#include "files/open_scene.h"
#include "io/exports/scene_export.h"
#include "io/scenes/random_scene.test.h"

#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace weft {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

std::string hash_of(const fs::path& scene, int frames, const Options& options = {.backend = "cpu"}) {
    auto simulation = Simulation::load(scene, options);
    if (!simulation) return simulation.error().what;
    for (int i = 0; i < frames; ++i) simulation->step();
    return simulation->state_hash();
}

// Labels: no-asan
TEST(SaveScene, EverySceneOfTheLibraryRunsTheSame) {
    TemporaryFolder folder;
    const fs::path copy = folder.path() / "copy.json";
    int scenes = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".json") continue;
        SCOPED_TRACE(entry.path().filename().string());
        auto simulation = Simulation::load(entry.path(), {.backend = "cpu"});
        ASSERT_TRUE(simulation.ok()) << simulation.error().message();
        const auto saved = simulation->save_scene(copy);
        ASSERT_TRUE(saved.ok()) << saved.error().message();
        for (int i = 0; i < 3; ++i) simulation->step();
        EXPECT_EQ(hash_of(copy, 3), simulation->state_hash());
        ++scenes;
    }
    EXPECT_GE(scenes, 9);
}

// Labels: no-asan
TEST(SaveScene, RandomScenesRunTheSame) {
    TemporaryFolder folder;
    const fs::path path = folder.path() / "s.json", copy = folder.path() / "b" / "s.json";
    fs::create_directories(copy.parent_path());
    int ran = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        SCOPED_TRACE(seed);
        const SceneDesc scene = RandomScene(seed).draw();
        auto direct = SceneWorld::create(scene, {.backend = "cpu"});
        ASSERT_TRUE(export_scene(scene, folder.path(), path).ok());
        ASSERT_TRUE(export_scene(scene, folder.path(), copy).ok());
        if (!direct) {  // a pin that selects nothing, a missing file
            EXPECT_FALSE(Simulation::load(path, {.backend = "cpu"}).ok());
            continue;
        }
        for (int i = 0; i < 2; ++i) direct->advance();
        EXPECT_EQ(hash_of(path, 2), direct->world().state_hash());
        EXPECT_EQ(hash_of(copy, 2), direct->world().state_hash());
        ++ran;
    }
    EXPECT_GT(ran, 15);
}

TEST(SaveScene, KeepsWhatAProgramHasChanged) {
    TemporaryFolder folder;
    auto made = Simulation::create({.solver = {.substeps = 3}}, {.backend = "cpu"});
    ASSERT_TRUE(made.ok());
    Simulation& simulation = *made;
    const fs::path path = folder.path() / "saved.json";
    EXPECT_THAT(simulation.save_scene(path).error().message(), HasSubstr("must hold at least one cloth"));
    const ColliderId ball = *simulation.add(ColliderDesc{.name = "ball", .shape = SphereDesc{0.3f}});
    const ColliderId gone = *simulation.add(ColliderDesc{.name = "gone", .shape = BoxDesc{}});
    // Values that are not round, to compare bits; vertex colors; duplicate vertices at a seam.
    const TriangleMesh mesh{
        .positions = {{0, 0.1f, 0}, {0, 0, 0.7f}, {1, 0, 0}, {1, 1e-7f, 0}, {0, 0, 0.7f}, {1, 0, 1.1f}},
        .uvs = {{0, 0}, {0, 1}, {1, 0}, {0.5f, 0}, {0.5f, 1}, {1, 1}},
        .colors = {{1, 0, 0.123f, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 1, 1}, {0, 0.3f, 0, 1}, {0, 0, 0, 1}},
        .triangles = {{0, 1, 2}, {3, 4, 5}}};
    const ClothId cloth = *simulation.add({.mesh = mesh,
                                           .transform = {.position = {0, 0.5f, 0}},
                                           .pins = {{.select = ColorPins{{1, 0, 0.123f}, 0.001f}}}});
    ASSERT_TRUE(simulation
                    .add({.name = "grid",
                          .mesh = GridDesc{.resolution = {9, 9}},
                          .pins = {{.select = VertexPins{{0}}, .attach = "gone"}}})
                    .ok());
    for (int i = 0; i < 5; ++i) simulation.step();
    ASSERT_TRUE(simulation.set_fabric(cloth, FabricDesc("silk").set("density", 0.1).set("strength", {7, 8})).ok());
    ASSERT_TRUE(simulation.set_gravity({0, -5, 0}).ok());
    ASSERT_TRUE(simulation.move(ball, {0.5f, 0, 0.5f}, {0, 10, 0}).ok());
    ASSERT_TRUE(simulation.remove(gone).ok());
    simulation.step();
    const auto saved = simulation.save_scene(path);
    ASSERT_TRUE(saved.ok()) << saved.error().message();
    std::ifstream written(path);
    const std::string text(std::istreambuf_iterator<char>(written), {});
    EXPECT_NE(text.find("\"strength\""), std::string::npos) << text;

    auto loaded = Simulation::load(path, {.backend = "cpu"});
    ASSERT_TRUE(loaded.ok()) << loaded.error().message();
    EXPECT_EQ(loaded->surface(loaded->find_cloth("cloth 0")).positions.size(), 6u);
    auto fresh = Simulation::create({.gravity = {0, -5, 0}, .solver = {.substeps = 3}}, {.backend = "cpu"});
    ASSERT_TRUE(fresh.ok());
    ASSERT_TRUE(fresh
                    ->add(ColliderDesc{.name = "ball",
                                       .shape = SphereDesc{0.3f},
                                       .transform = {.position = {0.5f, 0, 0.5f}, .rotation_degrees = {0, 10, 0}}})
                    .ok());
    ASSERT_TRUE(fresh
                    ->add({.mesh = mesh,
                           .transform = {.position = {0, 0.5f, 0}},
                           .fabric = FabricDesc("silk").set("density", 0.1),
                           .pins = {{.select = ColorPins{{1, 0, 0.123f}, 0.001f}}}})
                    .ok());
    ASSERT_TRUE(
        fresh->add({.name = "grid", .mesh = GridDesc{.resolution = {9, 9}}, .pins = {{.select = VertexPins{{0}}}}})
            .ok());
    EXPECT_EQ(loaded->state_hash(), fresh->state_hash());
    for (int i = 0; i < 10; ++i) loaded->step(), fresh->step();
    EXPECT_EQ(loaded->state_hash(), fresh->state_hash());
    // Save again, from a scene whose meshes are in files.
    const fs::path again = folder.path() / "deep" / "again.json";
    fs::create_directories(again.parent_path());
    ASSERT_TRUE(loaded->save_scene(again).ok());
    EXPECT_EQ(hash_of(again, 10), fresh->state_hash());
}

TEST(SaveScene, ReadsMeshFilesForAProgramThatAsksForIt) {
    TemporaryFolder folder;
    const std::string file = folder.write("t.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n").string();
    auto with = Simulation::create({}, {.backend = "cpu", .read_mesh = read_mesh_file});
    ASSERT_TRUE(with.ok());
    EXPECT_TRUE(with->add({.mesh = MeshFileDesc{.file = file}}).ok());
}

}  // namespace
}  // namespace weft
