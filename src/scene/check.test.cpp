#include "scene/check.h"

#include "scene/scene_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace weft {
namespace {

using testing::ElementsAre;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

SceneDesc valid_scene() {
    SceneDesc scene;
    scene.cloths.resize(2);
    scene.cloths[0].pins = {{VertexPins{{0, 63}}}, {BoxPins{{{-1, -1, -1}, {1, 1, 1}}}}};
    scene.cloths[1].mesh = MeshFileDesc{.file = "bunny.obj"};
    scene.cloths[1].pins = {{ColorPins{.color = {1, 0, 0}}}};
    scene.colliders = {ColliderDesc{.name = "ground", .shape = PlaneDesc{}},
                       ColliderDesc{.name = "ball", .shape = SphereDesc{}}};
    return scene;
}

std::vector<std::string> problems_after(const std::function<void(SceneDesc&)>& change) {
    SceneDesc scene = valid_scene();
    change(scene);
    std::vector<std::string> messages;
    for (const Error& error : check_scene(scene)) messages.push_back(error.message());
    return messages;
}

GridDesc& grid(SceneDesc& scene) {
    return std::get<GridDesc>(scene.cloths[0].mesh);
}

TEST(CheckScene, PassesWhatIsFine) {
    EXPECT_THAT(problems_after([](SceneDesc&) {}), ElementsAre());
}

TEST(CheckScene, DoesNotSplitClothThatJacobiProjects) {
    const auto with = [](Tearing tearing) {
        return problems_after([&](SceneDesc& s) {
            s.solver.projection = Projection::jacobi;
            s.cloths[0].tearing = tearing;
        });
    };
    for (const Tearing tearing : {Tearing::split, Tearing::erode})
        EXPECT_THAT(
            with(tearing),
            ElementsAre("/cloths/0/tearing: \"split\" and \"erode\" cannot be used with the projection \"jacobi\""));
    EXPECT_THAT(with(Tearing::cuts), ElementsAre());
}

TEST(CheckScene, LeavesDiagonalsToHinges) {
    for (const BendModel model : {BendModel::moment, BendModel::dihedral, BendModel::plate, BendModel::distance}) {
        const auto problems = problems_after([&](SceneDesc& s) {
            s.cloths[0].fabric.bend.model = model;
            s.cloths[0].fabric.bend.edges = BendEdges::no_diagonals;
        });
        if (model == BendModel::dihedral || model == BendModel::distance) {
            EXPECT_THAT(problems, ElementsAre());
        } else {
            EXPECT_THAT(problems, ElementsAre("/cloths/0/fabric/bend_edges: needs \"bend_model\": \"dihedral\" or "
                                              "\"distance\" for \"no-diagonals\""));
        }
    }
}

TEST(CheckScene, OpensMembranes) {
    for (const Tearing tearing : {Tearing::off, Tearing::cuts, Tearing::split, Tearing::erode}) {
        EXPECT_THAT(problems_after([&](SceneDesc& s) {
                        s.cloths[0].fabric.stretch.model = StretchModel::membrane;
                        s.cloths[0].tearing = tearing;
                    }),
                    ElementsAre());
    }
}

TEST(CheckScene, NeedsACloth) {
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths.clear(); }),
                ElementsAre("/cloths: must hold at least one cloth"));
}

TEST(CheckScene, HoldsEveryTableToItsRange) {
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.frame_rate = 0; }),
                ElementsAre("/frame_rate: must be > 0 frames/s, got 0"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.frame_rate = 100001; }),
                ElementsAre("/frame_rate: must be ≤ 100000 frames/s, got 100001"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.gravity.y = nan; }),
                ElementsAre("/gravity/1: must be a finite number, got nan"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.solver = {.substeps = 0, .iterations = 10001}; }),
                ElementsAre("/solver/substeps: must be ≥ 1, got 0", "/solver/iterations: must be ≤ 10000, got 10001"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.solver.method = static_cast<Method>(7); }),
                ElementsAre("/solver/method: is not one of its enumerators"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[1].transform.scale = 0; }),
                ElementsAre("/cloths/1/transform/scale: must be > 0, got 0"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.colliders[0].transform.rotation_degrees.z = infinity; }),
                ElementsAre("/colliders/0/transform/rotation/2: must be a finite number, got infinity"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { std::get<SphereDesc>(s.colliders[1].shape).radius = -0.5f; }),
                ElementsAre("/colliders/1/sphere/radius: must be > 0 m, got -0.5"));
}

TEST(CheckScene, KnowsCutsThatCannotBe) {
    const auto with = [](CutDesc cut) {
        return problems_after([&](SceneDesc& s) { s.cloths[0].tearing = Tearing::cuts, s.cloths[0].cuts = {cut}; });
    };
    const PathCut path{{{0, 0, 0}, {0, 1, 0}}};
    EXPECT_THAT(with({.time = 3, .along = path}), ElementsAre());
    EXPECT_THAT(with({.time = nan, .along = path}),
                ElementsAre("/cloths/0/cuts/0/time: must be a finite number, got nan"));
    EXPECT_THAT(with({.time = -1, .along = path}), ElementsAre("/cloths/0/cuts/0/time: must be ≥ 0 s, got -1"));
    EXPECT_THAT(with({.along = PathCut{{{0, 0, 0}}}}),
                ElementsAre("/cloths/0/cuts/0/points: must hold at least two points, got 1"));
    EXPECT_THAT(with({.along = PathCut{{{0, 0, 0}, {0, nan, 2e6f}}}}),
                ElementsAre("/cloths/0/cuts/0/points/1/1: must be a finite number, got nan",
                            "/cloths/0/cuts/0/points/1/2: must be ≤ 1000000 m, got 2000000"));
    EXPECT_THAT(with({.along = PlaneCut{{0, 1e-20f, 0}, infinity}}),
                ElementsAre("/cloths/0/cuts/0/plane/offset: must be a finite number, got infinity",
                            "/cloths/0/cuts/0/plane/normal: must not be zero"));
    EXPECT_THAT(problems_after([&](SceneDesc& s) { s.cloths[1].cuts = {{.along = path}}; }),
                ElementsAre("/cloths/1/cuts: needs \"tearing\": \"cuts\", \"split\" or \"erode\" in this cloth"));
}

TEST(CheckScene, KnowsSeamsAndResistanceThatCannotBe) {
    const auto with = [](SeamDesc seam, Tearing tearing = Tearing::split) {
        return problems_after([&](SceneDesc& s) { s.cloths[0].tearing = tearing, s.cloths[0].seams = {seam}; });
    };
    const PathCut path{{{0, 0, 0}, {0, 1, 0}}};
    EXPECT_THAT(with({.strength = 5, .tear_energy = 0, .along = path}), ElementsAre());
    EXPECT_THAT(with({.strength = 0, .tear_energy = -1, .along = path}),
                ElementsAre("/cloths/0/seams/0/strength: must be > 0 N/m, got 0",
                            "/cloths/0/seams/0/tear_energy: must be ≥ 0 J/m, got -1"));
    EXPECT_THAT(with({.strength = nan, .along = PlaneCut{{0, 0, 0}, 0}}),
                ElementsAre("/cloths/0/seams/0/strength: must be a finite number, got nan",
                            "/cloths/0/seams/0/plane/normal: must not be zero"));
    for (const Tearing tearing : {Tearing::off, Tearing::cuts, Tearing::erode})
        EXPECT_THAT(with({.strength = 5, .along = path}, tearing),
                    ElementsAre("/cloths/0/seams: needs \"tearing\": \"split\" in this cloth"));

    const auto painted = [](ResistanceDesc resistance, Tearing tearing = Tearing::split) {
        return problems_after(
            [&](SceneDesc& s) { s.cloths[0].tearing = tearing, s.cloths[0].resistance = {resistance}; });
    };
    const BoxPins box{{{-1, -1, -1}, {1, 1, 1}}};
    EXPECT_THAT(painted({.factor = 0.5f, .select = box}), ElementsAre());
    EXPECT_THAT(painted({.factor = 0.5f, .select = box}, Tearing::erode), ElementsAre());
    EXPECT_THAT(painted({.factor = 0, .select = box}),
                ElementsAre("/cloths/0/resistance/0/factor: must be ≥ 0.001, got 0"));
    EXPECT_THAT(painted({.factor = nan, .select = PaintedChannel{}}),
                ElementsAre("/cloths/0/resistance/0/factor: must be a finite number, got nan",
                            "/cloths/0/resistance/0/channel: needs a mesh with vertex colors, which a grid has not"));
    EXPECT_THAT(painted({.select = VertexPins{}}),
                ElementsAre("/cloths/0/resistance/0/vertices: must name at least one vertex"));
    EXPECT_THAT(painted({.select = box}, Tearing::cuts),
                ElementsAre("/cloths/0/resistance: needs \"tearing\": \"split\" or \"erode\" in this cloth"));
}

TEST(CheckScene, HoldsFabricsToTheirRange) {
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[0].fabric.body.density = -1; }),
                ElementsAre("/cloths/0/fabric/density: must be > 0 kg/m², got -1"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[0].fabric.stretch.stretch[1] = -4; }),
                ElementsAre("/cloths/0/fabric/stretch/1: must be ≥ 0 N/m, got -4"));
    // One number for both directions is reported once.
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    s.cloths[0].fabric.stretch.stretch[0] = s.cloths[0].fabric.stretch.stretch[1] = -4;
                }),
                ElementsAre("/cloths/0/fabric/stretch: must be ≥ 0 N/m, got -4"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[0].fabric.bend.rest_angle = 181; }),
                ElementsAre("/cloths/0/fabric/rest_angle: must be ≤ 180 °, got 181"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[0].fabric.bend.rest_angle = nan; }), ElementsAre());
}

TEST(CheckScene, LimitsGrids) {
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    grid(s).resolution = {1, 4097};
                    s.cloths[0].pins = {{VertexPins{{5000}}}};  // unchecked: the vertex count is unknown
                }),
                ElementsAre("/cloths/0/mesh/grid/resolution/0: must be ≥ 2, got 1",
                            "/cloths/0/mesh/grid/resolution/1: must be ≤ 4096, got 4097"));
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    grid(s).size = {0, nan};
                }),
                ElementsAre("/cloths/0/mesh/grid/size/0: must be > 0 m, got 0",
                            "/cloths/0/mesh/grid/size/1: must be a finite number, got nan"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { grid(s).resolution = {4096, 4096}; }), ElementsAre());
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    grid(s) = {.resolution = {4096, 4096}, .diagonal = GridDiagonal::cross};
                }),
                ElementsAre("/cloths/0/mesh/grid/resolution: must give at most 16777216 particles, got 33546241"));
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    grid(s).resolution = {4096, 4096};
                    s.cloths[1] = {};
                }),
                ElementsAre("/cloths: must have at most 16777216 particles together, got 16781312"));
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    s.cloths[1].render_mesh = GridDesc{.resolution = {4096, 4096}};
                }),
                ElementsAre("/cloths: must have at most 16777216 particles and drawn vertices together, got 16781312"));
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    s.cloths[1].mesh = BoxMeshDesc{.resolution = {4096, 4096, 4096}};
                }),
                ElementsAre("/cloths/1/mesh/box/resolution: must give at most 16777216 particles, got 100614152"));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[1].mesh = SphereMeshDesc{.subdivisions = 4000000000}; }),
                ElementsAre("/cloths/1/mesh/sphere/subdivisions: must be ≤ 7, got 4000000000"));
}

TEST(CheckScene, KnowsTheParticlesOfAGrid) {
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    s.cloths[0].pins = {{VertexPins{{4095, 4096}}}};
                }),
                ElementsAre("/cloths/0/pins/0/vertices/1: must be less than 4096, the number of particles, got 4096"));
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    grid(s).diagonal = GridDiagonal::cross;
                    s.cloths[0].pins = {{VertexPins{{8064}}}};  // 64² + 63² = 8065 vertices
                }),
                ElementsAre());
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[0].pins = {{ColorPins{}}}; }),
                ElementsAre("/cloths/0/pins/0/color: needs a mesh with vertex colors, which a grid has not"));
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    s.cloths[0].mesh = SphereMeshDesc{.subdivisions = 1};
                    s.cloths[0].pins = {{VertexPins{{41, 42}}}, {ColorPins{}}};
                }),
                ElementsAre("/cloths/0/pins/0/vertices/1: must be less than 42, the number of particles, got 42",
                            "/cloths/0/pins/1/color: needs a mesh with vertex colors, which a sphere has not"));
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    s.cloths[0].mesh = BoxMeshDesc{.resolution = {2, 3, 4}};
                    s.cloths[0].pins = {{VertexPins{{23, 24}}}};
                }),
                ElementsAre("/cloths/0/pins/0/vertices/1: must be less than 24, the number of particles, got 24"));
    // The number of vertices of a mesh file is not known yet.
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[1].pins = {{VertexPins{{1000000000}}}}; }), ElementsAre());
}

TEST(CheckScene, ChecksBoxesAndNormals) {
    EXPECT_THAT(problems_after([](SceneDesc& s) {
                    s.cloths[0].pins = {{BoxPins{{{0, 2, 0}, {1, 1, 1}}}}};
                }),
                ElementsAre("/cloths/0/pins/0/box/min/1: must not be greater than the same element of \"max\", 1, "
                            "got 2"));
    EXPECT_EQ(problems_after([](SceneDesc& s) { s.cloths[0].pins = {{BoxPins{}}}; }).size(), 6u);
    EXPECT_THAT(problems_after([](SceneDesc& s) { std::get<PlaneDesc>(s.colliders[0].shape).normal = {}; }),
                ElementsAre("/colliders/0/plane/normal: must not be zero"));
}

TEST(CheckScene, ChecksBodies) {
    const auto with = [](const ColliderDesc& collider) {
        return problems_after([&](SceneDesc& s) { s.colliders[1] = collider; });
    };
    EXPECT_THAT(with({.name = "a", .shape = SphereDesc{}, .body = BodyDesc{.mass = 3}}), ElementsAre());
    EXPECT_THAT(with({.name = "a", .shape = PlaneDesc{}, .body = BodyDesc{}}),
                ElementsAre("/colliders/1/motion/dynamic: must not stand beside \"plane\": a plane has no volume, so "
                            "it cannot be a body"));
    EXPECT_THAT(with({.name = "a", .shape = SphereDesc{}, .motion = {{.time = 1}}, .body = BodyDesc{}}),
                ElementsAre("/colliders/1/motion/dynamic: must not stand beside \"keys\": a body moves by forces, not "
                            "by keys"));
    EXPECT_THAT(with({.name = "a",
                      .shape = SolidMeshDesc{.file = "a.obj", .contact = MeshContact::surface},
                      .body = BodyDesc{}}),
                ElementsAre("/colliders/1/mesh/contact: must not be \"surface\" with a \"dynamic\" motion: bodies are "
                            "solids"));
    EXPECT_THAT(with({.name = "a",
                      .shape = SphereDesc{},
                      .body = BodyDesc{.mass = -1, .density = 0, .velocity = {0, 2e4f, 0}, .restitution = 2}}),
                ElementsAre("/colliders/1/motion/dynamic/mass: must be ≥ 0 kg, got -1",
                            "/colliders/1/motion/dynamic/density: must be > 0 kg/m³, got 0",
                            "/colliders/1/motion/dynamic/velocity/1: must be ≤ 10000 m/s, got 20000",
                            "/colliders/1/motion/dynamic/restitution: must be ≤ 1, got 2"));
    const auto with_moments = [&](Vec3 moments) {
        return with({.name = "a", .shape = SphereDesc{}, .body = BodyDesc{.inertia = moments}});
    };
    EXPECT_THAT(with_moments({1, 2, 3}), ElementsAre());
    EXPECT_THAT(with_moments({1, 2, 3.1f}),
                ElementsAre("/colliders/1/motion/dynamic/inertia: must hold moments that a body can have: each at most "
                            "the sum of the other two, got [1, 2, 3.1]"));
    EXPECT_THAT(with_moments({1, 0, 1}), ElementsAre("/colliders/1/motion/dynamic/inertia: must hold three moments > 0 "
                                                     "kg·m², or all 0, got [1, 0, 1]"));
    EXPECT_THAT(with_moments({1, nan, 1}),
                ElementsAre("/colliders/1/motion/dynamic/inertia/1: must be a finite number, got nan"));
}

TEST(CheckScene, ChecksNamesAndFiles) {
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[0].name = s.cloths[1].name = "sheet"; }),
                ElementsAre("/cloths/1/name: is taken: another before it is called \"sheet\""));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.colliders[1].name = "ground"; }),
                ElementsAre("/colliders/1/name: is taken: another before it is called \"ground\""));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[0].name = "ground"; }), ElementsAre());
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.name = "two\nlines"; }),
                ElementsAre("/name: must not hold control characters, got \"two\\u000alines\""));
    EXPECT_THAT(problems_after([](SceneDesc& s) { s.cloths[1].mesh = MeshFileDesc{}; }),
                ElementsAre("/cloths/1/mesh/file: must name a file"));
}

TEST(NameUnnamed, GivesFreeNames) {
    SceneDesc scene = valid_scene();
    scene.cloths.resize(4);
    scene.cloths[1].name = "cloth 2";
    scene.colliders.emplace_back();
    name_unnamed(scene);
    std::vector<std::string> names;
    for (const SceneCloth& cloth : scene.cloths) names.push_back(cloth.name);
    EXPECT_THAT(names, ElementsAre("cloth 0", "cloth 2", "cloth 3", "cloth 4"));
    EXPECT_EQ(scene.colliders[0].name, "ground");
    EXPECT_EQ(scene.colliders[2].name, "collider 2");
    EXPECT_TRUE(check_scene(scene).empty());
}

TEST(ChoiceNames, StandInTheOrderOfTheEnum) {
    EXPECT_THAT(choice_names(grid_keys[2]), ElementsAre("uniform", "alternating", "cross"));
    EXPECT_THAT(choice_names({}), ElementsAre());
}

}  // namespace
}  // namespace weft
