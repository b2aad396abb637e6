#include "io/exports/film_fixtures.test.h"
#include "io/exports/glb_reading.test.h"
#include "io/exports/torn_film.test.h"
#include "look/material.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <limits>
#include <optional>

namespace weft {
namespace {

using test::Cloth;
using test::data_of;
using test::Instant;
using test::make_cloth;
using test::TestFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const tinygltf::AnimationSampler* sampler_of(const tinygltf::Model& model, int node, const std::string& path) {
    const tinygltf::AnimationSampler* found = nullptr;
    for (const tinygltf::Animation& animation : model.animations) {
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            if (channel.target_node != node || channel.target_path != path) continue;
            EXPECT_EQ(found, nullptr) << path << " has two channels";
            found = &animation.samplers.at(static_cast<std::size_t>(channel.sampler));
        }
    }
    return found;
}

int node_called(const tinygltf::Model& model, const std::string& name) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (model.nodes[i].name == name) return static_cast<int>(i);
    ADD_FAILURE() << "no node " << name;
    return 0;
}

Mat3 matrix_of(Vec4 q) {
    const Vec3 axis = q.xyz();
    const auto turned = [&](Vec3 v) { return v + 2 * cross(axis, cross(axis, v) + q.w * v); };
    return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

float difference(const Mat3& a, const Mat3& b) {
    return length(a.x - b.x) + length(a.y - b.y) + length(a.z - b.z);
}

/// Two balls of one shape, of which one stays, and a pole that turns by 50° per frame. Names clash with each other and
/// with the cloth.
class GlbSolidFilm : public testing::Test {
  protected:
    GlbSolidFilm() { material.color = {0.25f, 0.5f, 1}; }

    Pose pole_at(std::uint64_t frame) const {
        const auto f = static_cast<float>(frame);
        return {rotation_from_degrees({50 * f, 20, 35 * f}), {0.1f * f, 1, -0.01f * f * f}};
    }
    Pose ball_at(std::uint64_t frame) const { return {{}, {1, 3 - 0.1f * static_cast<float>(frame), 0}}; }

    std::vector<ExportSolid> at(std::uint64_t frame) const {
        return {{.name = "c", .mesh = &ball, .pose = ball_at(frame), .material = &material},
                {.name = "pole", .mesh = &pole, .pose = pole_at(frame)},
                {.name = "c", .mesh = &ball, .pose = rest}};
    }

    Result<void> write(const std::string& name, std::uint64_t frames, const std::vector<Cloth>& cloths) {
        const auto exporter = make_exporter(folder / name);
        if (!exporter) return exporter.errors();
        const ExportInfo info{"film", 50, frames};
        for (std::uint64_t f = 0; f < frames; ++f) {
            const Instant instant(cloths, f, static_cast<double>(f) / 50);
            const std::vector<ExportSolid> solids = at(f);
            const ExportFrame frame{f, static_cast<double>(f) / 50, instant.surfaces, solids};
            if (f == 0) {
                const auto estimate = (*exporter)->estimate(info, frame);
                if (!estimate) return estimate.errors();
                bound = estimate->bytes;
                if (auto begun = (*exporter)->begin(info); !begun) return begun;
            }
            if (auto written = (*exporter)->write(frame); !written) return written;
        }
        return (*exporter)->finish();
    }

    tinygltf::Model load(const std::string& name) {
        tinygltf::Model model;
        std::string error, warning;
        EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, folder / name)) << error;
        EXPECT_EQ(error + warning, "");
        EXPECT_LE(std::filesystem::file_size(folder / name), bound);
        return model;
    }

    TestFolder folder;
    TriangleMesh ball = make_sphere(0.25f, 2), pole = make_sphere(0.5f, 1);
    Material material;
    Pose rest{rotation_from_degrees({10, 20, 30}), {-1, 0, 2}};
    std::uint64_t bound = 0;
};

TEST_F(GlbSolidFilm, has_a_node_with_mesh_and_material_for_each) {
    ASSERT_TRUE(write("a.glb", 3, {make_cloth("c", 4, 0)}).ok());
    const tinygltf::Model model = load("a.glb");
    ASSERT_EQ(model.nodes.size(), 4u);
    EXPECT_THAT(model.scenes.at(0).nodes, ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(model.nodes[0].name + model.nodes[1].name + model.nodes[2].name + model.nodes[3].name, "ccpolec");
    const std::vector<const TriangleMesh*> meshes = {&ball, &pole, &ball};
    for (std::size_t i = 0; i < 3; ++i) {
        const tinygltf::Mesh& mesh = model.meshes.at(static_cast<std::size_t>(model.nodes[i + 1].mesh));
        EXPECT_EQ(mesh.name, model.nodes[i + 1].name);
        EXPECT_THAT(mesh.weights, IsEmpty());
        const tinygltf::Primitive& primitive = mesh.primitives.at(0);
        EXPECT_EQ(data_of<Vec3>(model, primitive.attributes.at("POSITION")), meshes[i]->positions);
        const std::vector<Vec3> normals = data_of<Vec3>(model, primitive.attributes.at("NORMAL"));
        ASSERT_EQ(normals.size(), meshes[i]->positions.size());
        for (std::size_t v = 0; v < normals.size(); ++v) {
            EXPECT_NEAR(length(normals[v]), 1, 1e-5f);
            EXPECT_GT(dot(normals[v], meshes[i]->positions[v]), 0);
        }
        const std::vector<std::uint16_t> indices = data_of<std::uint16_t>(model, primitive.indices);
        ASSERT_EQ(indices.size(), 3 * meshes[i]->triangles.size());
        EXPECT_TRUE(std::equal(indices.begin(), indices.end(), meshes[i]->triangles.front().data()));
        const tinygltf::Material& shown = model.materials.at(static_cast<std::size_t>(primitive.material));
        const std::vector<double>& color = shown.pbrMetallicRoughness.baseColorFactor;
        EXPECT_NEAR(color.at(2), i == 0 ? 1 : 0.8, 1e-6);
    }
    // Objects of one shape share its data.
    EXPECT_EQ(model.meshes[1].primitives[0].attributes, model.meshes[3].primitives[0].attributes);
    EXPECT_NE(model.meshes[1].primitives[0].material, model.meshes[3].primitives[0].material);
}

TEST_F(GlbSolidFilm, moves_each_by_one_key_per_frame) {
    constexpr std::uint64_t frames = 12;
    ASSERT_TRUE(write("a.glb", frames, {make_cloth("cloth", 4, 0)}).ok());
    const tinygltf::Model model = load("a.glb");
    ASSERT_EQ(model.animations.size(), 1u);
    const int times = sampler_of(model, 0, "weights")->input;
    EXPECT_EQ(data_of<float>(model, times).size(), frames);
    for (const std::string name : {"c", "pole"}) {
        const int node = node_called(model, name);
        const auto pose = [&](std::uint64_t f) { return name == "c" ? ball_at(f) : pole_at(f); };
        const auto *translation = sampler_of(model, node, "translation"),
                   *rotation = sampler_of(model, node, "rotation");
        ASSERT_TRUE(translation && rotation);
        EXPECT_EQ(translation->input, times);
        EXPECT_EQ(rotation->input, times);
        EXPECT_EQ(translation->interpolation + rotation->interpolation, "LINEARLINEAR");
        const std::vector<Vec3> positions = data_of<Vec3>(model, translation->output);
        const std::vector<Vec4> turns = data_of<Vec4>(model, rotation->output);
        ASSERT_EQ(positions.size(), frames);
        ASSERT_EQ(turns.size(), frames);
        for (std::uint64_t f = 0; f < frames; ++f) {
            EXPECT_EQ(positions[f], pose(f).position);
            EXPECT_LT(difference(matrix_of(turns[f]), pose(f).rotation), 2e-6f) << name << ' ' << f;
            if (f == 0) continue;
            const Vec4 a = turns[f - 1], b = turns[f];
            EXPECT_GT(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w, 0) << name << ": the sign flips at " << f;
        }
        // Programs without animations show the start.
        const tinygltf::Node& shown = model.nodes[static_cast<std::size_t>(node)];
        EXPECT_THAT(shown.translation, ElementsAre(positions[0].x, positions[0].y, positions[0].z));
        EXPECT_THAT(shown.rotation, ElementsAre(turns[0].x, turns[0].y, turns[0].z, turns[0].w));
    }
    // What stays has no channels.
    EXPECT_EQ(sampler_of(model, 3, "translation"), nullptr);
    EXPECT_EQ(sampler_of(model, 3, "rotation"), nullptr);
    EXPECT_THAT(model.nodes[3].translation, ElementsAre(-1, 0, 2));
}

TEST_F(GlbSolidFilm, needs_no_cloth) {
    ASSERT_TRUE(write("a.glb", 3, {}).ok());
    const tinygltf::Model film = load("a.glb");
    EXPECT_EQ(film.nodes.size(), 3u);
    ASSERT_EQ(film.animations.size(), 1u);
    EXPECT_EQ(film.animations[0].channels.size(), 4u);
    ASSERT_TRUE(write("still.glb", 1, {}).ok());
    const tinygltf::Model still = load("still.glb");
    EXPECT_EQ(still.nodes.size(), 3u);
    EXPECT_THAT(still.animations, IsEmpty());
    EXPECT_THAT(still.nodes[1].translation, ElementsAre(0, 1, 0));
}

// The views of cloth that parts are rewritten; those of rigid objects must follow.
TEST_F(GlbSolidFilm, keeps_its_data_when_cloth_parts) {
    const test::TornFilm film(false);
    const auto exporter = make_exporter(folder / "a.glb");
    ASSERT_TRUE(exporter.ok() && (*exporter)->begin({"torn", 60, film.size()}).ok());
    bound = std::numeric_limits<std::uint64_t>::max();
    for (std::size_t f = 0; f < film.size(); ++f) {
        const auto instant = film.at(f);
        const std::vector<ExportSolid> solids = at(f);
        ASSERT_TRUE((*exporter)->write({f, static_cast<double>(f) / 60, instant->surfaces, solids}).ok());
    }
    ASSERT_TRUE((*exporter)->finish().ok());
    const tinygltf::Model model = load("a.glb");
    const int node = node_called(model, "pole");
    const tinygltf::Node& shown = model.nodes[static_cast<std::size_t>(node)];
    const tinygltf::Primitive& primitive = model.meshes.at(static_cast<std::size_t>(shown.mesh)).primitives.at(0);
    EXPECT_EQ(data_of<Vec3>(model, primitive.attributes.at("POSITION")), pole.positions);
    const std::vector<Vec3> positions = data_of<Vec3>(model, sampler_of(model, node, "translation")->output);
    ASSERT_EQ(positions.size(), film.size());
    for (std::size_t f = 0; f < film.size(); ++f) EXPECT_EQ(positions[f], pole_at(f).position);
}

TEST_F(GlbSolidFilm, refuses_what_no_file_can_hold) {
    const std::vector<Cloth> cloths = {make_cloth("cloth", 4, 0)};
    const auto problem = [&](auto&& change, std::uint64_t changed_frame) {
        const auto exporter = make_exporter(folder / "a.glb");
        EXPECT_TRUE(exporter.ok() && (*exporter)->begin({"s", 50, 2}).ok());
        for (std::uint64_t f = 0; f < 2; ++f) {
            const Instant instant(cloths, f, static_cast<double>(f));
            std::vector<ExportSolid> solids = at(f);
            if (f == changed_frame) change(solids);
            const Result<void> written = (*exporter)->write({f, static_cast<double>(f), instant.surfaces, solids});
            if (!written) return written.error().what;
        }
        return std::string("none");
    };
    using Solids = std::vector<ExportSolid>;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(problem([](Solids&) {}, 1), "none");
    EXPECT_EQ(problem([](Solids& s) { s[1].pose.position.y = nan; }, 1),
              "frame 1: collider \"pole\" has a pose that is not finite");
    EXPECT_EQ(problem([](Solids& s) { s[0].pose.rotation.z.x = nan; }, 0),
              "frame 0: collider \"c\" has a pose that is not finite");
    EXPECT_EQ(problem([](Solids& s) { s.pop_back(); }, 1),
              "frame 1: it has 2 colliders instead of the 3 of the first frame");
    EXPECT_EQ(problem([](Solids& s) { std::swap(s[0], s[1]); }, 1),
              "frame 1: it has the collider \"pole\" in place of \"c\" of the first frame");
    EXPECT_EQ(problem([](Solids& s) { s[0].mesh = nullptr; }, 0), "frame 0: collider \"c\" has no mesh");
    TriangleMesh bare = ball, wrong = ball;
    bare.normals.clear();
    wrong.triangles[0][0] = 9999;
    EXPECT_THAT(problem([&](Solids& s) { s[0].mesh = &bare; }, 0), HasSubstr("collider \"c\" has 162 positions but 0"));
    EXPECT_THAT(problem([&](Solids& s) { s[0].mesh = &wrong; }, 0), HasSubstr("a triangle on vertex 9999 of 162"));
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST_F(GlbSolidFilm, is_cloth_alone_in_other_formats) {
    const std::vector<Cloth> cloths = {make_cloth("cloth", 4, 0)};
    for (const char* name : {"a.obj", "a.ply", "b.pc2"}) {
        ASSERT_TRUE(write(name, 2, cloths).ok());
        EXPECT_EQ(test::read_text(folder / name).find("pole"), std::string::npos);
    }
}

}  // namespace
}  // namespace weft
