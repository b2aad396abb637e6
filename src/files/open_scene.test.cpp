#include "files/open_scene.h"
#include "weft/drawn_frame.h"

#include "base/temporary_folder.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// A scene of one cloth above a plane, with mesh files in its folder.
class OpenScene : public testing::Test {
  protected:
    Result<SceneWorld> open(const std::string& cloth_keys) {
        return open_scene(folder.write("s.json", R"({"weft": 1, "cloths": [{"name": "it", )" + cloth_keys +
                                                     R"(}], "colliders": [{"plane": {"offset": -1}}]})"),
                          {.solver = {{"substeps", 5}}});
    }
    std::vector<std::string> errors_of(const std::string& cloth_keys) {
        std::vector<std::string> messages;
        if (const auto session = open(cloth_keys); !session)
            for (const Error& error : session.errors()) {
                const std::string message = error.message(), place = folder.path().string() + '/';
                messages.push_back(message.substr(message.starts_with(place) ? place.size() : 0));
            }
        return messages;
    }

    TemporaryFolder folder;
};

void expect_sound(const SceneWorld& session) {
    for (const ClothFrame& cloth : session.world().frame().cloths) {
        for (const Vec4& p : cloth.positions) ASSERT_TRUE(finite(p.xyz()));
        for (const Vec4& v : cloth.velocities) ASSERT_TRUE(finite(v.xyz()));
        for (const Vec4& n : cloth.normals) ASSERT_NEAR(length(n.xyz()), 1, 1e-4f);
    }
    DrawnFrame drawn;
    drawn.update(session.world().frame());
    for (const DrawnSurface& surface : drawn.surfaces()) {
        ASSERT_EQ(surface.positions.size(), surface.rest_positions.size());
        for (const Vec3 p : surface.positions) ASSERT_TRUE(finite(p));
        for (const Vec3 n : surface.normals) ASSERT_NEAR(length(n), 1, 1e-4f);
    }
}

/// Returns whether a vertex of the first cloth has moved.
bool run(SceneWorld& session, int frames = 30) {
    const auto positions = [&] { return session.world().frame().cloths[0].render_mesh().positions; };
    const std::vector<Vec3> before = positions();
    for (int i = 0; i < frames; ++i) {
        EXPECT_EQ(session.step().reports & report_non_finite, 0u) << "frame " << i;
        expect_sound(session);
    }
    return before != positions();
}

// Three triangles on one edge; a triangle given twice, and once more with opposite winding; triangles degenerate to a
// point and to a line; an unused vertex; and a triangle attached by a single corner.
constexpr std::string_view messy_obj = R"(
v 0 0 0
v 0 1 0
v 1 0.5 0
v -1 0.5 0.2
v 0 0.5 1
v 5 5 5
v 0 2 0
v 0.5 3 0
v -0.5 3 0.1
f 1 2 3
f 2 1 4
f 1 2 5
f 2 3 1
f 3 2 1
f 4 4 4
f 1 2 7
f 7 8 9
f 2 3 7
)";

TEST_F(OpenScene, survives_a_mesh_made_by_hand_and_tells_what_it_found) {
    folder.write("messy.obj", messy_obj);
    for (const char* more :
         {"", R"(, "fabric": {"bend_model": "dihedral", "bend_edges": "no-diagonals", "rest_angle": 0})",
          R"(, "tethers": "on",
                             "pins": [{"vertices": [0, 8]}])",
          R"(, "fabric": {"inextensible": true})", R"(, "fabric": {"bend_model": "plate"})",
          R"(, "fabric": {"bend_model": "distance"})"}) {
        auto session = open(R"("mesh": {"file": "messy.obj"})" + std::string(more));
        ASSERT_TRUE(session.ok()) << session.error().message();
        EXPECT_THAT(session->notes(),
                    UnorderedElementsAre("cloth 'it': 1 vertices that no triangle uses stay where they are",
                                         "cloth 'it': 2 triangles without an area left out",
                                         "cloth 'it': 2 doubled triangles left out",
                                         "cloth 'it': 1 edges with three or more triangles do not bend",
                                         "cloth 'it': 1 edges between triangles of opposite winding"));
        EXPECT_TRUE(run(*session)) << more;
        DrawnFrame drawn;
        drawn.update(session->world().frame());
        EXPECT_EQ(drawn.surfaces()[0].positions[5], (Vec3{5, 5, 5})) << "the vertex of no triangle stays";
    }
}

TEST_F(OpenScene, says_nothing_of_a_mesh_that_is_fine) {
    for (const char* mesh : {R"("grid": {})", R"("sphere": {})", R"("box": {})"}) {
        const auto session = open(R"("mesh": {)" + std::string(mesh) + "}");
        ASSERT_TRUE(session.ok()) << session.error().message();
        EXPECT_THAT(session->notes(), IsEmpty());
    }
}

TEST_F(OpenScene, refuses_a_mesh_of_nothing_but_rubbish) {
    folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n");
    EXPECT_THAT(errors_of(R"("mesh": {"file": "lines.obj"})"),
                ElementsAre(HasSubstr("must have at least one triangle with an area, got 2 without")));
}

TEST_F(OpenScene, has_tethers_by_itself_only_with_coarse_levels) {
    auto session = open(R"("mesh": {"grid": {"resolution": [33, 33]}}, "fabric": {"inextensible": true},
                           "pins": [{"vertices": [0, 32]}])");
    ASSERT_TRUE(session.ok()) << session.error().message();
    const auto tethers = [&] { return session->world().frame().cloths[0].model->table(ConstraintKind::tether).rows; };
    EXPECT_EQ(tethers(), 2u * (33 * 33 - 2));
    SolverDesc solver = session->scene().solver;
    solver.hierarchy = false;
    ASSERT_TRUE(session->set_solver(solver).ok());
    EXPECT_TRUE(run(*session));
    EXPECT_EQ(tethers(), 0u);
    solver.hierarchy = true;
    ASSERT_TRUE(session->set_solver(solver).ok());
    EXPECT_TRUE(run(*session));
    EXPECT_EQ(tethers(), 2u * (33 * 33 - 2));
}

TEST_F(OpenScene, drops_spheres_and_boxes) {
    auto sphere = open(R"("mesh": {"sphere": {"radius": 0.25, "subdivisions": 3}}, "transform": {"position": [1, 2, 3]},
                          "pins": [{"vertices": [641]}])");
    ASSERT_TRUE(sphere.ok()) << sphere.error().message();
    const ClothModel& ball = *sphere->world().frame().cloths[0].model;
    EXPECT_EQ(ball.particle_count, 642u);
    EXPECT_EQ(ball.pinned_count, 1u);
    for (std::uint32_t p = 0; p < ball.particle_count; ++p)
        EXPECT_NEAR(length(ball.rest_position(p) - Vec3{1, 2, 3}), 0.25f, 1e-6f);
    EXPECT_TRUE(run(*sphere));

    auto box = open(R"("mesh": {"box": {"size": [0.1, 0.2, 0.3], "resolution": [3, 4, 5]}})");
    ASSERT_TRUE(box.ok()) << box.error().message();
    EXPECT_EQ(box->world().frame().cloths[0].model->particle_count, 54u);
    EXPECT_TRUE(run(*box));
}

TEST_F(OpenScene, draws_a_fine_mesh_over_a_coarse_one) {
    auto session = open(R"("mesh": {"grid": {"resolution": [9, 9]}}, "render_mesh": {"grid": {"resolution": [65, 65]}},
                           "transform": {"position": [0, 1, 0], "rotation": [0, 30, 0]}, "pins": [{"vertices": [0, 8]}])");
    ASSERT_TRUE(session.ok()) << session.error().message();
    EXPECT_THAT(session->notes(), IsEmpty());
    EXPECT_EQ(session->world().frame().cloths[0].model->particle_count, 81u);
    EXPECT_TRUE(run(*session));

    DrawnFrame drawn;
    drawn.update(session->world().frame());
    const DrawnSurface& surface = drawn.surfaces()[0];
    ASSERT_EQ(surface.positions.size(), 65u * 65u);
    EXPECT_EQ(surface.uvs.size(), 65u * 65u);
    const auto particles = session->world().frame().cloths[0].positions;
    for (std::uint32_t z = 0; z < 9; ++z)
        for (std::uint32_t x = 0; x < 9; ++x) {
            const Vec3 at = surface.positions[8 * z * 65 + 8 * x];
            EXPECT_LT(length(at - particles[9 * z + x].xyz()), 1e-5f) << "where both have a vertex";
        }
    // The cloth hangs by two corners. No two neighboring vertices are far apart.
    for (std::uint32_t v = 0; v + 1 < 65 * 65; ++v) {
        if (v % 65 != 64) {
            EXPECT_LT(length(surface.positions[v] - surface.positions[v + 1]), 1.5f / 64);
        }
    }
}

TEST_F(OpenScene, takes_the_drawn_mesh_from_a_file_with_its_own_scale_and_axis) {
    // The same square in centimeters, in the file's xy plane, with z up.
    folder.write("fine.obj",
                 "v -50 50 0\nv 50 50 0\nv 50 -50 0\nv -50 -50 0\nv 0 0 1\n"
                 "f 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n");
    auto session = open(R"("mesh": {"grid": {"resolution": [4, 4]}}, "transform": {"position": [0, 3, 0], "scale": 2},
                           "render_mesh": {"file": "fine.obj", "scale": 0.01, "up": "z"})");
    ASSERT_TRUE(session.ok()) << session.error().message();
    EXPECT_THAT(session->notes(), IsEmpty());
    DrawnFrame drawn;
    drawn.update(session->world().frame());
    EXPECT_LT(length(drawn.surfaces()[0].positions[0] - Vec3{-1, 3, -1}), 1e-6f);
    EXPECT_LT(length(drawn.surfaces()[0].positions[4] - Vec3{0, 3.02f, 0}), 1e-6f);
    EXPECT_TRUE(run(*session));

    auto too_large = open(R"("mesh": {"grid": {"resolution": [4, 4]}}, "render_mesh": {"file": "fine.obj"})");
    ASSERT_TRUE(too_large.ok()) << too_large.error().message();
    EXPECT_THAT(too_large->notes(), ElementsAre(HasSubstr("cloth 'it': the render mesh lies up to 70.3")));
    EXPECT_THAT(errors_of(R"("render_mesh": {"file": "missing.obj"})"),
                ElementsAre(HasSubstr("s.json: /cloths/0/render_mesh/file")));
}

TEST_F(OpenScene, pins_the_simulated_mesh_and_not_the_drawn_one) {
    EXPECT_THAT(
        errors_of(R"("mesh": {"grid": {"resolution": [4, 4]}}, "render_mesh": {"grid": {"resolution": [40, 40]}},
                             "pins": [{"vertices": [15, 16]}])"),
        ElementsAre("s.json: /cloths/0/pins/0/vertices/1: must be less than 16, the number of particles, got 16"));
}

TEST_F(OpenScene, DrawsEachClothInItsMaterial) {
    const auto session = open(R"("mesh": {"grid": {"size": [1, 1], "resolution": [3, 3]}})");
    ASSERT_TRUE(session.ok());
    const auto material_in = [&](std::span<const SceneCloth> cloths) {
        DrawnFrame drawn;
        drawn.update(session->world().frame(), cloths);
        return drawn.surfaces().front().material;
    };
    std::vector<SceneCloth> cloths(2);
    cloths[0].name = "another", cloths[1].name = "it";
    for (SceneCloth& cloth : cloths) cloth.material.emplace();
    EXPECT_EQ(material_in(cloths), &cloths[1].material->values);
    cloths[1].material.reset();
    cloths[1].fabric_name = "silk";
    EXPECT_EQ(material_in(cloths), &find_material("silk")->material);
    EXPECT_EQ(material_in({}), &find_material("cotton")->material);
    EXPECT_EQ(session->folder(), folder.path());
}

TEST_F(OpenScene, ShowsTheColorsOfAMeshThatHasNoLook) {
    folder.write("a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
                 "property list uchar int vertex_indices\nend_header\n"
                 "0 0 0 255 0 0\n1 0 0 0 255 0\n0 0 1 0 0 255\n3 0 1 2\n");
    const auto session = open(R"("mesh": {"file": "a.ply"})");
    ASSERT_TRUE(session.ok());
    DrawnFrame drawn;
    drawn.update(session->world().frame());
    EXPECT_EQ(drawn.surfaces().front().material, nullptr);
}

}  // namespace
}  // namespace weft
