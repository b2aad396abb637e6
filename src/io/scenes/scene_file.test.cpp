#include "io/scenes/read_scene.test.h"

#include "io/scenes/json_text.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view full_scene = R"({
    // every key
    "weft": 1, "name": "all", "gravity": [0, -1.62, 0.5], "frame_rate": 24,
    "solver": { "method": "xpbd", "projection": "gauss-seidel", "substeps": 7, "iterations": 3 },
    "cloths": [
        { "name": "sheet",
          "mesh": { "grid": { "size": [2, 3], "resolution": [5, 9], "diagonal": "cross" } },
          "transform": { "position": [1, 2, 3], "rotation": [90, 0, -45], "scale": 2 },
          "fabric": { "preset": "denim", "density": 0.5, "damping": 0.2, "stretch": [100, 200], "compression": 50,
                      "shear": 12, "inextensible": true, "strength": [90, 80],
                      "tear_energy": 2.5, "tear_ratio": 1.25, "bend": 2e-5, "rest_angle": 30, "thickness": 0.001,
                      "friction": [0.6, 0.5] },
          "pins": [ { "vertices": [0, 4] }, { "box": { "min": [-1, -2, -3], "max": [1, 2, 3] } } ] },
        { "mesh": { "file": "models/../bunny.obj", "scale": 0.01, "up": "z" }, "fabric": "silk",
          "pins": [ { "color": [1, 0, 0.5], "threshold": 0.25 } ] } ],
    /* what they fall on */
    "colliders": [
        { "name": "ground", "plane": { "normal": [0, 2, 0], "offset": -1 }, "friction": 0.7 },
        { "sphere": { "radius": 0.1 }, "transform": { "position": [0, 1, 0], "rotation": [0, 90, 0] },
          "friction": [0.9, 0.8] } ]
})";

/// A scene whose first cloth has `keys`.
std::string cloth(const std::string& keys) {
    return R"({"weft": 1, "cloths": [{)" + keys + "}]}";
}
std::string scene(const std::string& keys) {
    return R"({"weft": 1, "cloths": [{}], )" + keys + "}";
}

TEST(SceneFile, ReadsEveryKeyOfAScene) {
    const Result<SceneDesc> result = parse_scene(full_scene, "s.json");
    ASSERT_TRUE(result) << result.error().message();
    const SceneDesc& s = *result;
    EXPECT_EQ(s.name, "all");
    EXPECT_EQ(s.gravity, (Vec3{0, -1.62f, 0.5f}));
    EXPECT_EQ(s.frame_rate, 24);
    EXPECT_EQ(s.solver.substeps, 7u);
    EXPECT_EQ(s.solver.iterations, 3u);
    ASSERT_EQ(s.cloths.size(), 2u);
    ASSERT_EQ(s.colliders.size(), 2u);

    const auto& plane = std::get<PlaneDesc>(s.colliders[0].shape);
    EXPECT_EQ(s.colliders[0].name, "ground");
    EXPECT_EQ(plane.normal, (Vec3{0, 2, 0}));
    EXPECT_EQ(plane.offset, -1);
    EXPECT_THAT(s.colliders[0].friction, ElementsAre(0.7f, 0.7f));
    EXPECT_EQ(s.colliders[1].name, "collider 1");
    EXPECT_EQ(std::get<SphereDesc>(s.colliders[1].shape).radius, 0.1f);
    EXPECT_EQ(s.colliders[1].transform.position, (Vec3{0, 1, 0}));
    EXPECT_EQ(s.colliders[1].transform.rotation_degrees, (Vec3{0, 90, 0}));
    EXPECT_THAT(s.colliders[1].friction, ElementsAre(0.9f, 0.8f));
}

TEST(SceneFile, ReadsEveryKeyOfACloth) {
    const Result<SceneDesc> result = parse_scene(full_scene, "s.json");
    ASSERT_TRUE(result) << result.error().message();
    const SceneCloth& sheet = result->cloths[0];
    const auto& grid = std::get<GridDesc>(sheet.mesh);
    EXPECT_EQ(sheet.name, "sheet");
    EXPECT_THAT(grid.size, ElementsAre(2.0f, 3.0f));
    EXPECT_THAT(grid.resolution, ElementsAre(5u, 9u));
    EXPECT_EQ(grid.diagonal, GridDiagonal::cross);
    EXPECT_EQ(sheet.transform.position, (Vec3{1, 2, 3}));
    EXPECT_EQ(sheet.transform.rotation_degrees, (Vec3{90, 0, -45}));
    EXPECT_EQ(sheet.transform.scale, 2);
    ASSERT_EQ(sheet.pins.size(), 2u);
    EXPECT_THAT(std::get<VertexPins>(sheet.pins[0].select).vertices, ElementsAre(0u, 4u));
    const Bounds& box = std::get<BoxPins>(sheet.pins[1].select).box;
    EXPECT_EQ(box.min, (Vec3{-1, -2, -3}));
    EXPECT_EQ(box.max, (Vec3{1, 2, 3}));

    const SceneCloth& bunny = result->cloths[1];
    const auto& mesh = std::get<MeshFileDesc>(bunny.mesh);
    EXPECT_EQ(bunny.name, "cloth 1");
    EXPECT_EQ(mesh.file, "models/../bunny.obj");
    EXPECT_EQ(mesh.scale, 0.01f);
    EXPECT_EQ(mesh.up, UpAxis::z);
    const auto& red = std::get<ColorPins>(bunny.pins.at(0).select);
    EXPECT_EQ(red.color, (Vec3{1, 0, 0.5f}));
    EXPECT_EQ(red.threshold, 0.25f);
    EXPECT_EQ(bunny.fabric.body.density, 0.0625f);
}

TEST(SceneFile, ReadsEveryKeyOfAFabric) {
    const Result<SceneDesc> result = parse_scene(full_scene, "s.json");
    ASSERT_TRUE(result) << result.error().message();
    const Fabric& f = result->cloths[0].fabric;
    EXPECT_EQ(f.body.density, 0.5f);
    EXPECT_EQ(f.body.damping, 0.2f);
    EXPECT_THAT(f.stretch.stretch, ElementsAre(100.0f, 200.0f));
    EXPECT_THAT(f.stretch.compression, ElementsAre(50.0f, 50.0f));
    EXPECT_EQ(f.stretch.shear, 12);
    EXPECT_TRUE(f.stretch.inextensible);
    EXPECT_EQ(f.tear.strength[0], 90);
    EXPECT_EQ(f.tear.strength[1], 80);
    EXPECT_EQ(f.tear.tear_energy, 2.5f);
    EXPECT_EQ(f.tear.tear_ratio, 1.25f);
    EXPECT_THAT(f.bend.bend, ElementsAre(2e-5f, 2e-5f, 2e-5f));
    EXPECT_EQ(f.bend.rest_angle, 30);
    EXPECT_EQ(f.contact.thickness, 0.001f);
    EXPECT_THAT(f.contact.friction, ElementsAre(0.6f, 0.5f));
}

TEST(SceneFile, NeedsLittle) {
    const Result<SceneDesc> result = parse_scene(R"({"weft":1,"cloths":[{}]})", "s.json");
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->frame_rate, 60);
    EXPECT_EQ(result->solver.substeps, 20u);
    EXPECT_EQ(result->cloths[0].name, "cloth 0");
    EXPECT_THAT(std::get<GridDesc>(result->cloths[0].mesh).resolution, ElementsAre(64u, 64u));
    EXPECT_EQ(result->cloths[0].fabric.body.density, 0.14f);
}

TEST(SceneFile, PresetsCanBeOverridden) {
    const auto fabric = [](const std::string& text) {
        const Result<SceneDesc> result = parse_scene(cloth("\"fabric\": " + text), "s.json");
        EXPECT_TRUE(result) << result.error().message();
        return result->cloths[0].fabric;
    };
    EXPECT_EQ(fabric(R"("rib-knit")").stretch.shear, 41);
    EXPECT_EQ(fabric(R"({"preset": "rib-knit", "density": 1})").stretch.shear, 41);
    EXPECT_EQ(fabric(R"({"density": 1})").stretch.shear, 40);
    // Compression equals stretch unless it is given.
    EXPECT_THAT(fabric(R"({"stretch": [10, 20]})").stretch.compression, ElementsAre(10.0f, 20.0f));
    EXPECT_THAT(fabric(R"({"stretch": [10, 20], "compression": 5})").stretch.compression, ElementsAre(5.0f, 5.0f));
    EXPECT_THAT(fabric(R"({"preset": "silk"})").stretch.compression, ElementsAre(2000.0f, 2000.0f));
    EXPECT_TRUE(std::isnan(fabric(R"({"rest_angle": "mesh"})").bend.rest_angle));
    EXPECT_EQ(fabric(R"({"bend_edges": "no-diagonals", "bend_model": "distance"})").bend.edges,
              BendEdges::no_diagonals);
    EXPECT_EQ(fabric(R"("silk")").bend.edges, BendEdges::all);
    EXPECT_EQ(fabric(R"({"bend_model": "plate"})").bend.model, BendModel::plate);
    EXPECT_EQ(fabric(R"({"bend_model": "distance"})").bend.model, BendModel::distance);
    EXPECT_EQ(fabric(R"("silk")").bend.model, BendModel::moment);
}

TEST(SceneFile, ReadsSpheresAndBoxes) {
    const Result<SceneDesc> result = parse_scene(R"({"weft": 1, "cloths": [
        {"mesh": {"sphere": {"radius": 0.2, "subdivisions": 0}}},
        {"mesh": {"box": {"size": [1, 2, 3], "resolution": [2, 3, 4]}}},
        {"mesh": {"sphere": {}}}, {"mesh": {"box": {}}}]})",
                                                 "s.json");
    ASSERT_TRUE(result) << result.error().message();
    const auto& sphere = std::get<SphereMeshDesc>(result->cloths[0].mesh);
    EXPECT_EQ(sphere.radius, 0.2f);
    EXPECT_EQ(sphere.subdivisions, 0u);
    const auto& box = std::get<BoxMeshDesc>(result->cloths[1].mesh);
    EXPECT_THAT(box.size, ElementsAre(1, 2, 3));
    EXPECT_THAT(box.resolution, ElementsAre(2u, 3u, 4u));
    EXPECT_EQ(std::get<SphereMeshDesc>(result->cloths[2].mesh).subdivisions, 4u);
    EXPECT_THAT(std::get<BoxMeshDesc>(result->cloths[3].mesh).resolution, ElementsAre(32u, 32u, 32u));
}

TEST(SceneFile, ReadsADrawnMeshBesideTheSimulatedOne) {
    const Result<SceneDesc> result = parse_scene(R"({"weft": 1, "cloths": [
        {"mesh": {"grid": {"resolution": [8, 8]}}, "render_mesh": {"file": "fine.obj", "scale": 0.1, "up": "z"}},
        {"render_mesh": {"grid": {"resolution": [200, 200]}}}, {}]})",
                                                 "s.json");
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_THAT(std::get<GridDesc>(result->cloths[0].mesh).resolution, ElementsAre(8u, 8u));
    const auto& fine = std::get<MeshFileDesc>(result->cloths[0].render_mesh.value());
    EXPECT_EQ(fine.file, "fine.obj");
    EXPECT_EQ(fine.scale, 0.1f);
    EXPECT_EQ(fine.up, UpAxis::z);
    EXPECT_THAT(std::get<GridDesc>(result->cloths[1].render_mesh.value()).resolution, ElementsAre(200u, 200u));
    EXPECT_FALSE(result->cloths[2].render_mesh);
}

struct Bad {
    std::string text;
    std::vector<std::string> messages;
};

void expect_each(const std::vector<Bad>& cases) {
    for (const Bad& bad : cases) EXPECT_THAT(errors_of(bad.text), testing::ElementsAreArray(bad.messages)) << bad.text;
}

TEST(SceneFile, NamesWrongValues) {
    expect_each({
        {cloth(R"("fabric": {"density": -1})"), {"s.json: /cloths/0/fabric/density: must be > 0 kg/m², got -1"}},
        {cloth(R"("fabric": {"density": 1e39})"),
         {"s.json: /cloths/0/fabric/density: must be ≤ 10000 kg/m², got 1e39"}},
        {cloth(R"("fabric": {"stretch": -5})"), {"s.json: /cloths/0/fabric/stretch: must be ≥ 0 N/m, got -5"}},
        {cloth(R"("fabric": {"strength": [100, -1]})"),
         {"s.json: /cloths/0/fabric/strength/1: must be ≥ 0 N/m, got -1"}},
        {cloth(R"("fabric": {"tear_energy": -2})"), {"s.json: /cloths/0/fabric/tear_energy: must be ≥ 0 J/m, got -2"}},
        {cloth(R"("fabric": {"tear_ratio": 0.5})"), {"s.json: /cloths/0/fabric/tear_ratio: must be 0 or ≥ 1, got 0.5"}},
        {cloth(R"("fabric": {"tear_ratio": -1})"), {"s.json: /cloths/0/fabric/tear_ratio: must be 0 or ≥ 1, got -1"}},
        {cloth(R"("fabric": {"tear_ratio": 1001})"), {"s.json: /cloths/0/fabric/tear_ratio: must be ≤ 1000, got 1001"}},
        {cloth(R"("fabric": {"bend": [1, -2, 3]})"), {"s.json: /cloths/0/fabric/bend/1: must be ≥ 0 N·m, got -2"}},
        {cloth(R"("transform": {"position": [0, 1e300, 0]})"),
         {"s.json: /cloths/0/transform/position/1: must be ≤ 1000000 m, got 1e300"}},
        {cloth(R"("transform": {"rotation": [0, -1e300, 0]})"),
         {"s.json: /cloths/0/transform/rotation/1: must be a finite number, got -1e300"}},
        {cloth(R"("mesh": {"grid": {"resolution": [1, 5000]}})"),
         {"s.json: /cloths/0/mesh/grid/resolution/0: must be ≥ 2, got 1",
          "s.json: /cloths/0/mesh/grid/resolution/1: must be ≤ 4096, got 5000"}},
        {cloth(R"("mesh": {"grid": {"resolution": [4096, 4096], "diagonal": "cross"}})"),
         {"s.json: /cloths/0/mesh/grid/resolution: must give at most 16777216 particles, got 33546241"}},
        {cloth(R"("mesh": {"sphere": {"radius": 0, "subdivisions": 8}})"),
         {"s.json: /cloths/0/mesh/sphere/radius: must be > 0 m, got 0",
          "s.json: /cloths/0/mesh/sphere/subdivisions: must be ≤ 7, got 8"}},
        {cloth(R"("mesh": {"box": {"size": [1, -1, 1], "resolution": [2, 2, 1]}})"),
         {"s.json: /cloths/0/mesh/box/size/1: must be > 0 m, got -1",
          "s.json: /cloths/0/mesh/box/resolution/2: must be ≥ 2, got 1"}},
        {cloth(R"("mesh": {"file": ""})"), {"s.json: /cloths/0/mesh/file: must name a file"}},
        {cloth(R"("render_mesh": {"file": ""})"), {"s.json: /cloths/0/render_mesh/file: must name a file"}},
        {cloth(R"("render_mesh": {"grid": {"size": [0, 1]}})"),
         {"s.json: /cloths/0/render_mesh/grid/size/0: must be > 0 m, got 0"}},
        {cloth(R"("pins": [{"vertices": [1, -1]}])"), {"s.json: /cloths/0/pins/0/vertices/1: must be ≥ 0, got -1"}},
        {cloth(R"("pins": [{"vertices": [4096]}])"),
         {"s.json: /cloths/0/pins/0/vertices/0: must be less than 4096, the number of particles, got 4096"}},
        {cloth(R"("pins": [{"vertices": [99999999999]}])"),
         {"s.json: /cloths/0/pins/0/vertices/0: must be ≤ 4294967295, got 99999999999"}},
        {cloth(R"("pins": [{"box": {"min": [0, 0, 1], "max": [1, 1, 0]}}])"),
         {"s.json: /cloths/0/pins/0/box/min/2: must not be greater than the same element of \"max\", 0, got 1"}},
        {scene(R"("solver": {"substeps": 0, "iterations": -1})"),
         {"s.json: /solver/iterations: must be ≥ 1, got -1", "s.json: /solver/substeps: must be ≥ 1, got 0"}},
        {scene(R"("solver": {"substeps": 10001})"), {"s.json: /solver/substeps: must be ≤ 10000, got 10001"}},
        {scene(R"("frame_rate": 0)"), {"s.json: /frame_rate: must be > 0 frames/s, got 0"}},
        {scene(R"("frame_rate": 1e6)"), {"s.json: /frame_rate: must be ≤ 100000 frames/s, got 1000000"}},
        {scene(R"("colliders": [{"plane": {"normal": [0, 0, 0]}}])"),
         {"s.json: /colliders/0/plane/normal: must not be zero"}},
        {scene(R"("colliders": [{"sphere": {"radius": 0}}])"),
         {"s.json: /colliders/0/sphere/radius: must be > 0 m, got 0"}},
        {scene(R"("colliders": [{"plane": {}, "friction": -1}])"),
         {"s.json: /colliders/0/friction: must be ≥ 0, got -1"}},
    });
}

TEST(SceneFile, NamesWrongTypes) {
    expect_each({
        {"[]", {"s.json: must be an object, got a list of 0"}},
        {"3", {"s.json: must be an object, got 3"}},
        {"null", {"s.json: must be an object, got null"}},
        {R"({"weft": 1, "cloths": {}})", {"s.json: /cloths: must be a list, got an object"}},
        {R"({"weft": 1, "cloths": [3]})", {"s.json: /cloths/0: must be an object, got 3"}},
        {R"({"weft": "1", "cloths": [{}]})", {"s.json: /weft: must be a whole number, got \"1\""}},
        {scene(R"("gravity": -9.81)"), {"s.json: /gravity: must be a list of 3 numbers, got -9.81"}},
        {scene(R"("gravity": [0, -9.81])"), {"s.json: /gravity: must be a list of 3 numbers, got a list of 2"}},
        {scene(R"("gravity": [0, "down", 0])"), {"s.json: /gravity/1: must be a number, got \"down\""}},
        {scene(R"("name": 5)"), {"s.json: /name: must be a text in quotes, got 5"}},
        {scene(R"("frame_rate": [60])"), {"s.json: /frame_rate: must be a number, got a list of 1"}},
        {scene(R"("solver": [])"), {"s.json: /solver: must be an object, got a list of 0"}},
        {scene(R"("solver": {"substeps": 1.5})"), {"s.json: /solver/substeps: must be a whole number, got 1.5"}},
        {scene(R"("solver": {"substeps": true})"), {"s.json: /solver/substeps: must be a whole number, got true"}},
        {cloth(R"("mesh": {"grid": {"resolution": 64}})"),
         {"s.json: /cloths/0/mesh/grid/resolution: must be a list of 2 whole numbers, got 64"}},
        {cloth(R"("mesh": {"grid": {"resolution": [64, 2.5]}})"),
         {"s.json: /cloths/0/mesh/grid/resolution/1: must be a whole number, got 2.5"}},
        {cloth(R"("fabric": 3)"), {"s.json: /cloths/0/fabric: must be the name of a fabric or an object, got 3"}},
        {cloth(R"("fabric": {"stretch": [1, 2, 3]})"),
         {"s.json: /cloths/0/fabric/stretch: must be a number or a list of 2 numbers, got a list of 3"}},
        {cloth(R"("fabric": {"stretch": null})"),
         {"s.json: /cloths/0/fabric/stretch: must be a number or a list of 2 numbers, got null"}},
        {cloth(R"("fabric": {"inextensible": 1})"),
         {"s.json: /cloths/0/fabric/inextensible: must be true or false, got 1"}},
        {cloth(R"("fabric": {"rest_angle": "flat"})"),
         {"s.json: /cloths/0/fabric/rest_angle: must be a number or \"mesh\", got \"flat\""}},
        {cloth(R"("velocity": -15)"), {"s.json: /cloths/0/velocity: must be a list of 3 numbers, got -15"}},
        {cloth(R"("pins": {"vertices": [1]})"), {"s.json: /cloths/0/pins: must be a list, got an object"}},
        {cloth(R"("pins": [{"vertices": 1}])"), {"s.json: /cloths/0/pins/0/vertices: must be a list, got 1"}},
        {cloth(R"("pins": [{"vertices": [1.5, "a"]}])"),
         {"s.json: /cloths/0/pins/0/vertices/0: must be a whole number, got 1.5",
          "s.json: /cloths/0/pins/0/vertices/1: must be a whole number, got \"a\""}},
        {cloth(R"("pins": [{"box": [[0, 0, 0], [1, 1, 1]]}])"),
         {"s.json: /cloths/0/pins/0/box: must be an object, got a list of 2"}},
        {scene(R"("colliders": [{"sphere": 0.5}])"), {"s.json: /colliders/0/sphere: must be an object, got 0.5"}},
    });
}

TEST(SceneFile, NamesUnknownKeysAndChoices) {
    expect_each({
        {cloth(R"("fabric": {"densty": 1})"),
         {"s.json: /cloths/0/fabric/densty: unknown key \"densty\"; did you mean \"density\"?"}},
        {cloth(R"("drawn": {"grid": {}})"),
         {"s.json: /cloths/0/drawn: unknown key \"drawn\"; this is called \"render_mesh\" now"}},
        {cloth(R"("fabric": {"bend_model": "hinges"})"),
         {"s.json: /cloths/0/fabric/bend_model: must be \"moment\", \"dihedral\", \"plate\" or \"distance\", got "
          "\"hinges\"; this "
          "is "
          "called \"dihedral\" now"}},
        {scene(R"("clots": [])"), {"s.json: /clots: unknown key \"clots\"; did you mean \"cloths\"?"}},
        {scene(R"("a/b\n": 1)"),
         {"s.json: /a~1b\\u000a: unknown key \"a/b\\u000a\"; known are \"weft\", \"name\", "
          "\"gravity\", \"frame_rate\", \"solver\", \"air\", \"cloths\", \"colliders\", \"stitches\", \"camera\" "
          "and \"light\""}},
        {scene(R"("colliders": [{"plane": {}, "transform": {"scale": 2}}])"),
         {"s.json: /colliders/0/transform/scale: unknown key \"scale\"; known are \"position\" and \"rotation\""}},
        {scene(R"("solver": {"method": "pdb"})"), {"s.json: /solver/method: must be \"xpbd\" or \"pbd\", got \"pdb\""}},
        {scene(R"("solver": {"projection": "jakobi"})"),
         {"s.json: /solver/projection: must be \"auto\", \"lines\", \"gauss-seidel\" or \"jacobi\", got \"jakobi\""}},
        {cloth(R"("mesh": {"grid": {"diagonal": "both"}})"),
         {"s.json: /cloths/0/mesh/grid/diagonal: must be \"uniform\", \"alternating\" or \"cross\", got \"both\""}},
        {cloth(R"("mesh": {"file": "a.obj", "up": 1})"),
         {"s.json: /cloths/0/mesh/up: must be \"x\", \"y\" or \"z\", got 1"}},
        {cloth(R"("fabric": "coton")"),
         {"s.json: /cloths/0/fabric: unknown fabric \"coton\"; did you mean \"cotton\"?"}},
        {cloth(R"("fabric": {"preset": "linnen"})"),
         {"s.json: /cloths/0/fabric/preset: unknown fabric \"linnen\"; known are \"trouser\", \"denim\", "
          "\"tablecloth\", "
          "\"tshirt\", \"jacket\", \"swimsuit\", \"ponte-roma\", \"rib-knit\", \"blanket\", \"cotton\", \"silk\", "
          "\"chiffon\", \"wool\", \"ripstop\", \"leather\" and \"rubber\""}},
    });
}

TEST(SceneFile, NamesWhatIsMissingOrTooMuch) {
    expect_each({
        {"{}", {"s.json: /weft: is missing", "s.json: /cloths: is missing"}},
        {R"({"cloths": [{}]})", {"s.json: /weft: is missing"}},
        {R"({"weft": 2, "cloths": [{}]})", {"s.json: /weft: must be 1, the only format this version reads, got 2"}},
        {R"({"weft": 1})", {"s.json: /cloths: is missing"}},
        {R"({"weft": 1, "cloths": []})", {"s.json: /cloths: must hold at least one cloth"}},
        {cloth(R"("mesh": {})"),
         {"s.json: /cloths/0/mesh: must have one of \"grid\", \"sphere\", \"box\" or \"file\""}},
        {cloth(R"("mesh": {"grid": {}, "file": "a.obj"})"),
         {"s.json: /cloths/0/mesh: must have one of \"grid\", \"sphere\", \"box\" or \"file\", got 2"}},
        {cloth(R"("render_mesh": {"sphere": {}, "box": {}})"),
         {"s.json: /cloths/0/render_mesh: must have one of \"grid\", \"sphere\", \"box\" or \"file\", got 2"}},
        {cloth(R"("mesh": {"grid": {}, "scale": 2})"),
         {"s.json: /cloths/0/mesh/scale: belongs to \"file\", which is absent"}},
        {cloth(R"("pins": [{}])"),
         {"s.json: /cloths/0/pins/0: must have one of \"vertices\", \"group\", \"box\" or \"color\""}},
        {cloth(R"("groups": [{"name": "hem", "vertices": [0]}], "pins": [{"group": "hme"}])"),
         {"s.json: /cloths/0/pins/0/group: unknown group \"hme\"; did you mean \"hem\"?"}},
        {cloth(R"("groups": [{"name": "hem", "vertices": [0]}, {"name": "hem", "vertices": [4096]}])"),
         {"s.json: /cloths/0/groups/1/vertices/0: must be less than 4096, the number of particles, got 4096",
          "s.json: /cloths/0/groups/1/name: is taken: another before it is called \"hem\""}},
        {cloth(R"("groups": [{"name": "", "vertices": []}])"),
         {"s.json: /cloths/0/groups/0/name: must not be empty",
          "s.json: /cloths/0/groups/0/vertices: must name at least one vertex"}},
        {cloth(R"("tearing": "split", "resistance": [{"vertices": [0, 1], "factors": [1]}])"),
         {"s.json: /cloths/0/resistance/0/factors: must hold a number per vertex, 2, got 1"}},
        {cloth(R"("weights": [{"of": "mass", "vertices": [0]}, {"vertices": [0]}])"),
         {R"(s.json: /cloths/0/weights/0/of: must be "density", "stretch", "bend" or "thickness", got "mass")",
          "s.json: /cloths/0/weights/1/of: is missing"}},
        {cloth(
             R"("weights": [{"of": "bend", "vertices": [0, 1], "factors": [1]}, {"of": "bend", "factor": 0, "vertices": [0]}])"),
         {"s.json: /cloths/0/weights/0/factors: must hold a number per vertex, 2, got 1",
          "s.json: /cloths/0/weights/1/factor: must be ≥ 0.001, got 0"}},
        {cloth(R"("tearing": "split", "resistance": [{"vertices": [0], "factors": [0]}])"),
         {"s.json: /cloths/0/resistance/0/factors/0: must be ≥ 0.001, got 0"}},
        {cloth(R"("tearing": "split", "groups": [{"name": "hem", "vertices": [0]}],
                  "resistance": [{"group": "hem", "factors": [1]}])"),
         {"s.json: /cloths/0/resistance/0/factors: belongs to \"vertices\", which is absent"}},
        {cloth(R"("pins": [{"vertices": [0], "threshold": 1}])"),
         {"s.json: /cloths/0/pins/0/threshold: belongs to \"color\", which is absent"}},
        {cloth(R"("pins": [{"vertices": []}])"), {"s.json: /cloths/0/pins/0/vertices: must name at least one vertex"}},
        {cloth(R"("pins": [{"box": {"max": [1, 1, 1]}}])"), {"s.json: /cloths/0/pins/0/box/min: is missing"}},
        {cloth(R"("pins": [{"color": [1, 0, 0]}])"),
         {"s.json: /cloths/0/pins/0/color: needs a mesh with vertex colors, which a grid has not"}},
        {scene(R"("colliders": [{"convex": {}}])"),
         {"s.json: /colliders/0/convex/file: must name a file, unless there are `points`"}},
        {scene(
             R"("colliders": [{"convex": {"file": "a.obj", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}}])"),
         {"s.json: /colliders/0/convex: must have one of \"file\" or \"points\", got 2"}},
        {scene(R"("colliders": [{"convex": {"points": [[0, 0, 0], [1, 0], [0, "1", 0], [0, 0, 1e9]]}}])"),
         {"s.json: /colliders/0/convex/points/1: must be 3 numbers, got a list of 2",
          "s.json: /colliders/0/convex/points/2/1: must be a number, got \"1\"",
          "s.json: /colliders/0/convex/points/3/2: must be ≤ 1000000, got 1e9"}},
        {scene(R"("colliders": [{}])"), {"s.json: /colliders/0: must have one of " + alternatives(shape_keys)}},
        {scene(R"("colliders": [{"plane": {}, "sphere": {}}])"),
         {"s.json: /colliders/0: must have one of " + alternatives(shape_keys) + ", got 2"}},
        {R"({"weft": 1, "cloths": [{"name": "a"}, {"name": "a"}]})",
         {"s.json: /cloths/1/name: is taken: another before it is called \"a\""}},
        {scene(R"("colliders": [{"name": "a", "plane": {}}, {"name": "a", "plane": {}}])"),
         {"s.json: /colliders/1/name: is taken: another before it is called \"a\""}},
    });
}

TEST(SceneFile, ReadsWhatMoves) {
    const auto read = parse_scene(R"({"weft": 1,
        "cloths": [{"tethers": "on", "tether_slack": 0.1, "velocity": [0, -15, 0.5], "pins": [
            {"vertices": [0], "attach": "drum"},
            {"vertices": [1], "motion": [{"time": 1}, {"time": 2, "offset": [1, 2, 3]}]}]}],
        "colliders": [
            {"name": "drum", "capsule": {"radius": 0.2, "half_height": 0.4}, "transform": {"rotation": [90, 0, 0]},
             "motion": {"keys": [{"time": 0}, {"time": 1, "position": [0, 1, 0]}]}},
            {"box": {"half_extents": [1, 2, 3]}, "motion": "static"}]})",
                                  "s.json");
    ASSERT_TRUE(read.ok()) << read.error().message();
    const SceneCloth& cloth = read->cloths[0];
    EXPECT_EQ(cloth.tethers, Tethers::on);
    EXPECT_EQ(cloth.tether_slack, 0.1f);
    EXPECT_EQ(cloth.velocity, Vec3(0, -15, 0.5f));
    EXPECT_EQ(cloth.pins[0].attach, "drum");
    ASSERT_EQ(cloth.pins[1].motion.size(), 2u);
    EXPECT_EQ(cloth.pins[1].motion[1].offset, Vec3(1, 2, 3));
    ASSERT_EQ(read->colliders[0].motion.size(), 2u);
    EXPECT_EQ(read->colliders[0].motion[1].position, Vec3(0, 1, 0));
    EXPECT_EQ(read->colliders[0].motion[1].rotation_degrees, Vec3(90, 0, 0)) << "as the transform has it";
    EXPECT_EQ(std::get<BoxDesc>(read->colliders[1].shape).half_extents, Vec3(1, 2, 3));
    EXPECT_TRUE(read->colliders[1].motion.empty());
}

TEST(SceneFile, ReadsSelfCollision) {
    const auto read = parse_scene(R"({"weft": 1, "cloths": [{}, {"self_collision": "off"}, {"self_collision": false},
                                      {"self_collision": "exact"}, {"self_collision": true},
                                      {"self_collision": "fast"}]})",
                                  "s.json");
    ASSERT_TRUE(read.ok()) << read.error().message();
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_EQ(read->cloths[i].self_collision, i < 3 ? SelfCollision::off : SelfCollision::exact) << i;
    EXPECT_EQ(read->cloths[5].self_collision, SelfCollision::fast);
    expect_each({
        {cloth(R"("self_collision": "exakt")"),
         {"s.json: /cloths/0/self_collision: must be \"off\", \"fast\" or \"exact\", or true or false, got \"exakt\""}},
        {cloth(R"("self_collision": 1)"),
         {"s.json: /cloths/0/self_collision: must be \"off\", \"fast\" or \"exact\", or true or false, got 1"}},
        {cloth(R"("tethers": true)"), {"s.json: /cloths/0/tethers: must be \"auto\", \"on\" or \"off\", got true"}},
    });
}

TEST(SceneFile, KnowsWhatCannotMove) {
    const auto collider = [](const std::string& motion) {
        return errors_of(R"({"weft": 1, "cloths": [{}], "colliders": [{"plane": {}, "motion": )" + motion + "}]}");
    };
    EXPECT_THAT(
        collider("3"),
        ElementsAre("s.json: /colliders/0/motion: must be \"static\" or an object with \"keys\" or \"dynamic\", "
                    "got 3"));
    EXPECT_THAT(collider("{}"), ElementsAre("s.json: /colliders/0/motion: must have one of \"keys\" or \"dynamic\""));
    EXPECT_THAT(collider(R"({"keys": []})"),
                ElementsAre("s.json: /colliders/0/motion/keys: must hold at least one key"));
    EXPECT_THAT(
        collider(R"({"keys": [{"time": 1}, {"time": 1}]})"),
        ElementsAre("s.json: /colliders/0/motion/keys/1/time: must be later than that of the key before, 1, got 1"));
    EXPECT_THAT(collider(R"({"keys": [{"time": -1}]})"),
                ElementsAre("s.json: /colliders/0/motion/keys/0/time: must be ≥ 0 s, got -1"));

    const auto pin = [](const std::string& members) {
        return errors_of(R"({"weft": 1, "cloths": [{"pins": [{"vertices": [0], )" + members +
                         R"(}]}], "colliders": [{"name": "ball", "sphere": {}}]})");
    };
    EXPECT_THAT(pin(R"("attach": "bal")"),
                ElementsAre("s.json: /cloths/0/pins/0/attach: unknown collider \"bal\"; did you mean \"ball\"?"));
    EXPECT_THAT(
        pin(R"("attach": "ball", "motion": [{"time": 0}])"),
        ElementsAre("s.json: /cloths/0/pins/0/motion: must not stand beside \"attach\": the collider moves the pin"));
    EXPECT_THAT(
        pin(R"("motion": [{"time": 2}, {"time": 1}])"),
        ElementsAre("s.json: /cloths/0/pins/0/motion/1/time: must be later than that of the key before, 2, got 1"));
}

TEST(SceneFile, ReportsAllAtOnce) {
    EXPECT_THAT(errors_of(R"({"weft": 1, "gravty": 0, "frame_rate": -1,
                              "cloths": [{"fabric": {"density": -1, "shear": "x"}, "mesh": {"grid": {"size": [0, 1]}}}],
                              "colliders": [{"sphere": {"radius": -1}, "moton": 3}]})"),
                ElementsAre("s.json: /cloths/0/fabric/shear: must be a number, got \"x\"",
                            "s.json: /colliders/0/moton: unknown key \"moton\"; did you mean \"motion\"?",
                            "s.json: /gravty: unknown key \"gravty\"; did you mean \"gravity\"?",
                            "s.json: /frame_rate: must be > 0 frames/s, got -1",
                            "s.json: /cloths/0/mesh/grid/size/0: must be > 0 m, got 0",
                            "s.json: /cloths/0/fabric/density: must be > 0 kg/m², got -1",
                            "s.json: /colliders/0/sphere/radius: must be > 0 m, got -1"));
}

// A value that could not be read has its default, which is not reported.
TEST(SceneFile, ReportsNoConsequences) {
    expect_each({
        {cloth(R"("mesh": {"grid": {"resolution": [100, "x"]}}, "pins": [{"vertices": [5000]}])"),
         {"s.json: /cloths/0/mesh/grid/resolution/1: must be a whole number, got \"x\""}},
        {cloth(R"("mesh": {"fiel": "a.obj"}, "pins": [{"color": [1, 0, 0]}])"),
         {"s.json: /cloths/0/mesh: must have one of \"grid\", \"sphere\", \"box\" or \"file\"",
          "s.json: /cloths/0/mesh/fiel: unknown key \"fiel\"; did you mean \"file\"?"}},
        {cloth(R"("fabric": {"stretch": [-1, "x"]})"),
         {"s.json: /cloths/0/fabric/stretch/1: must be a number, got \"x\"",
          "s.json: /cloths/0/fabric/stretch/0: must be ≥ 0 N/m, got -1"}},
    });
}

TEST(SceneFile, NamesKeysThatStandTwice) {
    expect_each({
        {R"({"weft": 1, "weft": 1, "cloths": [{}]})", {"s.json: /weft: appears twice in the same object"}},
        {cloth(R"("fabric": {"shear": 1, "density": 1, "shear": 2})"),
         {"s.json: /cloths/0/fabric/shear: appears twice in the same object"}},
        {R"({"weft": 1, "cloths": [{}, {"mesh": {"grid": {}}, "mesh": {"grid": {}}}]})",
         {"s.json: /cloths/1/mesh: appears twice in the same object"}},
    });
}

TEST(SceneFile, SyntaxErrorsSayLineAndColumn) {
    expect_each({
        {"", {"s.json: is empty"}},
        {" \n\t ", {"s.json: is empty"}},
        {"\xef\xbb\xbf", {"s.json: is empty"}},
        {"// only a comment\n",
         {"s.json: line 2, column 1: syntax error while parsing value: unexpected end of input; "
          "expected '[', '{', or a literal"}},
        {"{\n  \"weft\": 1,\n}",
         {"s.json: line 3, column 1: syntax error while parsing object key: unexpected '}'; expected string literal"}},
        {"{\"é\" 1}",
         {"s.json: line 1, column 6: syntax error while parsing object separator: unexpected number literal; "
          "expected ':'"}},
        {"{\"weft\": tru}", {"s.json: line 1, column 13: syntax error while parsing value: invalid literal"}},
        {"{\"weft\": NaN}", {"s.json: line 1, column 10: syntax error while parsing value: invalid literal"}},
        {"{\"weft\": 1e999}", {"s.json: line 1, column 14: number overflow parsing '1e999'"}},
        {"{} {}",
         {"s.json: line 1, column 4: syntax error while parsing value: unexpected '{'; expected end of input"}},
        {"{\"weft",
         {"s.json: line 1, column 6: syntax error while parsing object key: invalid string: missing closing "
          "quote; expected string literal"}},
        {"{ /* no end",
         {"s.json: line 1, column 11: syntax error while parsing object key: invalid comment; missing "
          "closing '*/'; expected string literal"}},
        {std::string("\x7f\x45LF\x00\x01\xff", 7),
         {"s.json: line 1, column 1: syntax error while parsing value: invalid literal"}},
        {"{\"\xff\xfe\": 1}",
         {"s.json: line 1, column 3: syntax error while parsing object key: invalid string: "
          "ill-formed UTF-8 byte; expected string literal"}},
    });
}

TEST(SceneFile, ToleratesAByteOrderMark) {
    EXPECT_THAT(errors_of("\xef\xbb\xbf" + cloth("")), ElementsAre());
}

TEST(SceneFile, SurvivesDepth) {
    EXPECT_THAT(errors_of(std::string(1000000, '[')), ElementsAre(HasSubstr("is nested more than 64 deep")));
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    EXPECT_THAT(errors_of(objects), ElementsAre(HasSubstr("is nested more than 64 deep")));
}

TEST(SceneFile, SurvivesSize) {
    std::string values = "[";
    for (std::size_t i = 0; i < max_json_values; ++i) values += "0,";
    EXPECT_THAT(errors_of(values), ElementsAre("s.json: holds more than 8388608 values"));
    EXPECT_THAT(errors_of(std::string(max_json_bytes + 1, ' ')), ElementsAre("s.json: is longer than 64 MiB"));

    std::string bad = "\"pins\": [{\"vertices\": [0";
    for (int i = 0; i < 100000; ++i) bad += ",-1";
    const std::vector<std::string> messages = errors_of(cloth(bad + "]}]"));
    ASSERT_EQ(messages.size(), 101u);
    EXPECT_EQ(messages.back(), "s.json: and 99900 more");

    const std::string long_key(1 << 20, 'k');
    for (const std::string& message : errors_of(scene('"' + long_key + "\": 1"))) EXPECT_LT(message.size(), 1000u);
}

class SceneFolder : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::path(testing::TempDir()) /
                  ("weft_scene_file_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
};

TEST_F(SceneFolder, LoadsAFile) {
    const std::filesystem::path path = folder_ / "flag.json";
    std::ofstream(path, std::ios::binary) << cloth(R"("fabric": {"density": -1})");
    const Result<SceneDesc> scene = load_scene(path);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().where, path.string() + ": /cloths/0/fabric/density");
    EXPECT_EQ(scene.error().what, "must be > 0 kg/m², got -1");

    std::ofstream(path, std::ios::binary) << full_scene;
    EXPECT_TRUE(load_scene(path));
}

TEST_F(SceneFolder, SaysWhatIsNoFile) {
    EXPECT_EQ(load_scene(folder_ / "none.json").error().message(),
              (folder_ / "none.json").string() + ": cannot be opened: No such file or directory");
    EXPECT_EQ(load_scene(folder_).error().message(), folder_.string() + ": is a folder, not a scene file");
    EXPECT_FALSE(load_scene(""));
    EXPECT_FALSE(load_scene(std::string("a\0b", 3)));
    std::ofstream(folder_ / "empty.json").close();
    EXPECT_EQ(load_scene(folder_ / "empty.json").error().what, "is empty");
}

}  // namespace
}  // namespace weft
