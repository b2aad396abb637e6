// Films and single frames of scenes with rigid bodies.

#include "base/temporary_folder.test.h"
#include "files/open_scene.h"
#include "io/exports/exporter.h"
#include "io/exports/glb_reading.test.h"
#include "mesh/procedural.h"
#include "weft/drawn_frame.h"
#include "weft/drawn_solids.h"
#include "weft/scene_world.h"

#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

ColliderDesc body_of(const std::string& name, decltype(ColliderDesc::shape) shape, Vec3 position) {
    return {.name = name,
            .shape = std::move(shape),
            .transform = {.position = position, .rotation_degrees = {20, 0, 35}},
            .body = BodyDesc{.mass = 0.1f, .velocity = {0.1f, 0, 0}, .spin = {300, 200, 100}}};
}

/// A body of each shape falls on a sheet, beside a box that stays, a ball with keys, and the ground.
SceneDesc scene_of_bodies() {
    SceneDesc scene;
    scene.name = "bodies";
    SceneCloth& sheet = scene.cloths.emplace_back();
    sheet.name = "sheet";
    sheet.mesh = GridDesc{.size = {2, 2}, .resolution = {12, 12}};
    sheet.pins = {{.select = VertexPins{.vertices = {0, 11, 132, 143}}}};
    const TriangleMesh box = make_box({0.2f, 0.1f, 0.15f}, {2, 2, 2}), ball = make_sphere(0.1f, 2);
    scene.colliders = {
        ColliderDesc{.name = "ground", .shape = PlaneDesc{}, .transform = {.position = {0, -2, 0}}},
        body_of("sphere", SphereDesc{.radius = 0.1f}, {-0.6f, 0.3f, 0}),
        body_of("box", BoxDesc{.half_extents = {0.1f, 0.05f, 0.08f}}, {-0.2f, 0.3f, 0}),
        body_of("capsule", CapsuleDesc{.radius = 0.05f, .half_height = 0.1f}, {0.2f, 0.3f, 0}),
        body_of("taper", TaperedCapsuleDesc{.radius = {0.1f, 0.05f}, .half_height = 0.1f}, {0.6f, 0.3f, 0}),
        body_of("hull", ConvexDesc{.mesh = box, .radius = 0.02f}, {-0.4f, 0.3f, 0.5f}),
        body_of("mesh", SolidMeshDesc{.mesh = ball, .resolution = 24}, {0.4f, 0.3f, 0.5f}),
        ColliderDesc{.name = "stays", .shape = BoxDesc{}, .transform = {.position = {3, 0, 0}}},
        ColliderDesc{.name = "keyed", .shape = SphereDesc{}}};
    scene.colliders.back().motion = {{.time = 0, .position = {5, 0, 0}},
                                     {.time = 1, .position = {5, 1, 0}, .rotation_degrees = {0, 90, 0}}};
    scene.colliders[1].material = SceneMaterial{};
    scene.colliders[1].material->values.color = {1, 0, 0};
    scene.colliders[1].material->values.weft_color = {1, 0, 0};
    return scene;
}

class Glb {
  public:
    explicit Glb(const std::filesystem::path& path) {
        std::string error, warning;
        EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path.string())) << error;
        EXPECT_EQ(error + warning, "");
    }

    template <class Value>
    std::vector<Value> data(int index) const {
        return test::data_of<Value>(model, index);
    }
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const tinygltf::Node& node : model.nodes) found.push_back(node.name);
        return found;
    }
    const tinygltf::Node& node(const std::string& name) const { return model.nodes.at(number(name)); }
    const tinygltf::Mesh& mesh(const std::string& name) const {
        return model.meshes.at(static_cast<std::size_t>(node(name).mesh));
    }
    bool is_animated(const std::string& name) const { return output(name, "translation") >= 0; }
    Pose pose(const std::string& name, std::size_t frame) const {
        Vec3 at;
        Vec4 turn;
        if (is_animated(name)) {
            at = data<Vec3>(output(name, "translation")).at(frame);
            turn = data<Vec4>(output(name, "rotation")).at(frame);
        } else {
            const auto number = [](double value) { return static_cast<float>(value); };
            const std::vector<double>&t = node(name).translation, &r = node(name).rotation;
            at = {number(t.at(0)), number(t.at(1)), number(t.at(2))};
            turn = {number(r.at(0)), number(r.at(1)), number(r.at(2)), number(r.at(3))};
        }
        const auto turned = [&](Vec3 v) { return v + 2 * cross(turn.xyz(), cross(turn.xyz(), v) + turn.w * v); };
        return {{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})}, at};
    }

    tinygltf::Model model;

  private:
    std::size_t number(const std::string& name) const {
        const auto found = std::ranges::find(model.nodes, name, &tinygltf::Node::name);
        if (found == model.nodes.end()) throw std::out_of_range("no node " + name);
        return static_cast<std::size_t>(found - model.nodes.begin());
    }
    int output(const std::string& name, const std::string& path) const {
        for (const tinygltf::Animation& animation : model.animations)
            for (const tinygltf::AnimationChannel& channel : animation.channels)
                if (channel.target_node == static_cast<int>(number(name)) && channel.target_path == path)
                    return animation.samplers.at(static_cast<std::size_t>(channel.sampler)).output;
        return -1;
    }
};

void expect_same(const Pose& shown, const Pose& wanted) {
    EXPECT_EQ(shown.position, wanted.position);
    const Mat3 &a = shown.rotation, &b = wanted.rotation;
    EXPECT_LT(length(a.x - b.x) + length(a.y - b.y) + length(a.z - b.z), 3e-6f);
}

class BodyExports : public testing::Test {
  protected:
    SceneWorld make_world() const {
        auto made = SceneWorld::create(scene, with_mesh_files({.backend = "cpu"}));
        EXPECT_TRUE(made.ok()) << made.error().message();
        return std::move(*made);
    }

    /// Poses of all colliders by name, one map per frame.
    std::vector<std::map<std::string, Pose>> film(SceneWorld& world, std::uint64_t frames, SolidChoice choice) const {
        std::vector<std::map<std::string, Pose>> poses;
        auto exporter = make_exporter(path);
        EXPECT_TRUE(exporter.ok() && (*exporter)->begin({"film", 60, frames}).ok());
        DrawnFrame cloths;
        DrawnSolids solids(choice);
        for (std::uint64_t f = 0; f < frames; ++f) {
            if (f > 0) world.step();
            cloths.update(world.world().frame(), world.scene().cloths);
            solids.update(world.world(), world.scene().colliders);
            auto& now = poses.emplace_back();
            for (const Collider& collider : world.world().colliders()) now[collider.name] = collider.pose;
            const auto written = (*exporter)->write(
                {f, static_cast<double>(f) / world.scene().frame_rate, cloths.surfaces(), solids.solids()});
            EXPECT_TRUE(written.ok()) << written.error().message();
        }
        EXPECT_TRUE((*exporter)->finish().ok());
        return poses;
    }

    TemporaryFolder folder;
    std::filesystem::path path = folder.path() / "film.glb";
    SceneDesc scene = scene_of_bodies();
};

TEST_F(BodyExports, a_film_shows_each_body_at_its_pose_in_each_frame) {
    constexpr std::uint64_t frames = 40;
    SceneWorld world = make_world();
    const auto poses = film(world, frames, SolidChoice::bodies);
    const Glb glb(path);
    EXPECT_THAT(glb.names(), ElementsAre("sheet", "sphere", "box", "capsule", "taper", "hull", "mesh"));
    for (const std::string name : {"sphere", "box", "capsule", "taper", "hull", "mesh"}) {
        SCOPED_TRACE(name);
        ASSERT_TRUE(glb.is_animated(name));
        for (std::size_t f = 0; f < frames; ++f) expect_same(glb.pose(name, f), poses[f].at(name));
        EXPECT_GT(length(poses[0].at(name).position - poses[frames - 1].at(name).position), 0.05f);
    }
    const auto color = [&](const std::string& name) {
        const int material = glb.mesh(name).primitives.at(0).material;
        return glb.model.materials.at(static_cast<std::size_t>(material)).pbrMetallicRoughness.baseColorFactor;
    };
    EXPECT_THAT(color("sphere"), ElementsAre(1, 0, 0, 1));
    EXPECT_NE(color("box"), color("sphere"));
}

// The farthest vertices lie on the true surface, none outside, and triangles face outward.
TEST_F(BodyExports, a_mesh_is_the_surface_of_its_shape) {
    SceneWorld world = make_world();
    film(world, 1, SolidChoice::colliders);
    const Glb glb(path);
    for (const Collider& collider : world.world().colliders()) {
        if (collider.shape == ShapeKind::plane) continue;
        SCOPED_TRACE(collider.name);
        const tinygltf::Primitive& primitive = glb.mesh(collider.name).primitives.at(0);
        const auto positions = glb.data<Vec3>(primitive.attributes.at("POSITION"));
        const auto normals = glb.data<Vec3>(primitive.attributes.at("NORMAL"));
        const auto indices = glb.data<std::uint16_t>(primitive.indices);
        ASSERT_EQ(positions.size(), normals.size());
        double farthest = -1;
        for (const Vec3 p : positions)
            farthest = std::max(farthest, signed_distance(collider, to_world(collider.pose, p)));
        const double cell = 0.2 / 24;  // the distance to a mesh is read from a field of such cells
        EXPECT_NEAR(farthest, 0, collider.shape == ShapeKind::mesh ? 0.1 * cell : 1e-4);
        for (const Vec3 n : normals) EXPECT_NEAR(length(n), 1, 1e-4f);
        ASSERT_GE(indices.size(), 36u);
        std::map<std::pair<std::uint16_t, std::uint16_t>, int> sides;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const auto [a, b, c] = std::array{indices[i], indices[i + 1], indices[i + 2]};
            ASSERT_LT(std::max({a, b, c}), positions.size());
            const Vec3 face = cross(positions[b] - positions[a], positions[c] - positions[a]);
            EXPECT_GT(dot(face, normals[a] + normals[b] + normals[c]), 0);
            for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) ++sides[{from, to}];
        }
        // A shape without edges has no seams either: each side of a triangle is shared with another one.
        if (collider.name == "box" || collider.name == "hull" || collider.name == "stays") continue;
        for (const auto& [side, count] : sides) {
            EXPECT_EQ(count, 1);
            EXPECT_TRUE(sides.contains({side.second, side.first}));
        }
    }
}

TEST_F(BodyExports, other_colliders_are_written_on_demand) {
    constexpr std::uint64_t frames = 5;
    SceneWorld world = make_world();
    const auto poses = film(world, frames, SolidChoice::colliders);
    const Glb glb(path);
    EXPECT_THAT(glb.names(),
                UnorderedElementsAre("sheet", "sphere", "box", "capsule", "taper", "hull", "mesh", "stays", "keyed"));
    EXPECT_TRUE(glb.is_animated("keyed"));
    EXPECT_FALSE(glb.is_animated("stays"));
    for (const std::string name : {"keyed", "stays"})
        for (std::size_t f = 0; f < frames; ++f) expect_same(glb.pose(name, f), poses[f].at(name));
    EXPECT_GT(poses[4].at("keyed").position.y, 0.05f);
}

TEST_F(BodyExports, objects_are_chosen_in_the_first_frame) {
    SceneWorld world = make_world();
    DrawnSolids solids;
    const auto names = [&] {
        std::vector<std::string> found;
        solids.update(world.world(), world.scene().colliders);
        for (const DrawnSolid& solid : solids.solids()) found.emplace_back(solid.name);
        return found;
    };
    const std::vector<std::string> first = names();
    EXPECT_EQ(first.size(), 6u);
    const auto id_of = [&](const std::string& name) {
        for (std::size_t i = 0; i < world.world().colliders().size(); ++i)
            if (world.world().colliders()[i].name == name) return world.world().collider_id(i);
        return ColliderId{};
    };
    // One ends being a body, another becomes one.
    world.step();
    ASSERT_TRUE(world.set_body(id_of("sphere"), std::nullopt).ok());
    ASSERT_TRUE(world.set_body(id_of("stays"), BodyDesc{.mass = 1}).ok());
    world.move(id_of("sphere"), {7, 7, 7}, {});
    world.step();
    EXPECT_EQ(names(), first);
    EXPECT_EQ(solids.solids()[0].pose.position, (Vec3{7, 7, 7}));
    world.remove(id_of("box"));
    EXPECT_EQ(names().size(), 5u);
}

TEST_F(BodyExports, a_saved_simulation_has_the_bodies_of_its_moment) {
    auto simulation = Simulation::create({}, with_mesh_files({.backend = "cpu"}));
    ASSERT_TRUE(simulation.ok());
    ASSERT_TRUE(simulation->add(body_of("alone", SphereDesc{.radius = 0.1f}, {0, 1, 0})).ok());
    ASSERT_TRUE(simulation->save(path).ok()) << "no cloth is needed";
    EXPECT_THAT(Glb(path).names(), ElementsAre("alone"));
    const auto sheet =
        simulation->add(ClothDesc{.name = "sheet", .mesh = GridDesc{.size = {1, 1}, .resolution = {4, 4}}});
    const auto box =
        simulation->add(ColliderDesc{.name = "box", .shape = BoxDesc{}, .transform = {.position = {3, 0, 0}}});
    ASSERT_TRUE(sheet.ok() && box.ok());
    for (int i = 0; i < 7; ++i) simulation->step();

    ASSERT_TRUE(simulation->save(path).ok());
    const Glb bodies(path);
    EXPECT_THAT(bodies.names(), ElementsAre("sheet", "alone"));
    EXPECT_THAT(bodies.model.animations, testing::IsEmpty());
    const BodyMotion motion = *simulation->body(simulation->find_collider("alone"));
    EXPECT_EQ(bodies.pose("alone", 0).position, motion.position);
    const std::vector<double>& turn = bodies.node("alone").rotation;
    const double cosine = motion.rotation.x * turn.at(0) + motion.rotation.y * turn.at(1) +
                          motion.rotation.z * turn.at(2) + motion.rotation.w * turn.at(3);
    EXPECT_NEAR(std::abs(cosine), 1, 1e-6);

    ASSERT_TRUE(simulation->save(path, {.colliders = true}).ok());
    EXPECT_THAT(Glb(path).names(), ElementsAre("sheet", "alone", "box"));
    ASSERT_TRUE(simulation->set_body(*box, BodyDesc{.mass = 1}).ok());
    ASSERT_TRUE(simulation->set_body(simulation->find_collider("alone"), std::nullopt).ok());
    ASSERT_TRUE(simulation->save(path).ok());
    EXPECT_THAT(Glb(path).names(), ElementsAre("sheet", "box"));
}

}  // namespace
}  // namespace weft
