// A scene that is written and read again must be the same scene.
#include "io/scenes/scene_writer.h"

#include "io/scenes/json_writer.h"
#include "io/scenes/random_scene.test.h"
#include "io/scenes/read_scene.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <set>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string written(const SceneDesc& scene) {
    auto text = write_scene(scene);
    EXPECT_TRUE(text.ok()) << text.error().message();
    return text ? std::move(*text) : std::string();
}

std::string rewritten(const std::string& text) {
    return written(read(text));
}

void expect_round_trip(const SceneDesc& scene) {
    const std::string text = written(scene);
    const SceneDesc again = read(text);
    EXPECT_TRUE(again == scene) << text;
    // Bitwise, because == treats -0 as 0.
    EXPECT_EQ(written(again), text);
}

TEST(SceneWriter, EverySceneOfTheLibraryComesBack) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(WEFT_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".json") continue;
        SCOPED_TRACE(entry.path().filename().string());
        const auto scene = load_scene(entry.path());
        ASSERT_TRUE(scene.ok()) << scene.error().message();
        expect_round_trip(*scene);
        ++scenes;
    }
    EXPECT_GE(scenes, 9);
}

TEST(SceneWriter, AnySceneComesBack) {
    for (std::uint64_t seed = 1; seed <= 500 && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        const SceneDesc scene = RandomScene(seed).draw();
        const Errors problems = check_scene(scene);
        ASSERT_TRUE(problems.empty()) << problems.front().message();
        expect_round_trip(scene);
    }
}

// Random scenes have every key, so a key that is never written is one that the writer does not support.
TEST(SceneWriter, WritesThePointsOfAHull) {
    SceneDesc scene;
    scene.cloths.resize(1);
    SceneCollider stone;
    stone.name = "stone";
    ConvexDesc hull{.scale = {1, -2, 1}, .radius = 0.01f};
    hull.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}, {0, 0, 1}};
    stone.shape = hull;
    scene.colliders = {stone};
    const auto text = write_scene(scene);
    ASSERT_TRUE(text.ok()) << text.error().message();
    const auto back = parse_scene(*text, "s.json");
    ASSERT_TRUE(back.ok()) << back.error().message();
    EXPECT_EQ(back->colliders[0].shape, stone.shape);
}

TEST(SceneWriter, NoKeyIsForgotten) {
    std::set<std::string> written_keys;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const std::string text = written(RandomScene(seed).draw());
        for (const SceneTable& table : scene_tables())
            for (const Parameter& p : table.keys)
                if (text.find('"' + std::string(p.key) + "\":") != text.npos) written_keys.emplace(p.key);
    }
    for (const SceneTable& table : scene_tables())
        for (const Parameter& p : table.keys) {
            const bool has_another_value = p.kind != ParameterKind::choice || choice_names(p).size() > 1;
            EXPECT_EQ(written_keys.contains(std::string(p.key)), has_another_value) << p.key;
        }
}

TEST(SceneWriter, WritesSelfCollisionAsAWord) {
    EXPECT_EQ(rewritten(R"({"weft": 1, "cloths": [{"self_collision": true}, {"self_collision": "fast"},
                                                {"self_collision": false}]})"),
              R"({
    "weft": 1,
    "cloths": [{ "self_collision": "exact" }, { "self_collision": "fast" }, {}]
}
)");
}

TEST(SceneWriter, SaysOnlyWhatDiffersFromDefaults) {
    EXPECT_EQ(rewritten(R"({"weft": 1, "cloths": [{}]})"), R"({
    "weft": 1,
    "cloths": [{}]
}
)");
    EXPECT_EQ(rewritten(R"({ // a comment
        "gravity": [0, -9.81, 0], "frame_rate": 60.0, "name": "n", "weft": 1,
        "solver": {"iterations": 1, "substeps": 5},
        "colliders": [{"friction": [0.2, 0.2], "name": "collider 0", "plane": {"offset": 0}}, {"sphere": {}, "name": "ball", "material": {"preset": "matte"}}],
        "cloths": [
            {"fabric": {"preset": "denim"}, "pins": [{"threshold": 0.5, "color": [0, 0, 0]}], "mesh": {"file": "a.obj"},
             "material": {"color": [1, 0, 0]}},
            {"fabric": {"stretch": 100}, "mesh": {"grid": {"resolution": [64, 64]}}, "name": "b", "material": "silk"}]
    })"),
              R"({
    "weft": 1,
    "name": "n",
    "solver": { "substeps": 5 },
    "cloths": [
        {
            "mesh": { "file": "a.obj" },
            "fabric": "denim",
            "pins": [{ "color": [0, 0, 0] }],
            "material": { "color": [1, 0, 0] }
        },
        { "name": "b", "fabric": { "stretch": 100 }, "material": "silk" }
    ],
    "colliders": [
        { "plane": {}, "friction": 0.2 },
        { "name": "ball", "sphere": {}, "material": "matte" }
    ]
}
)");
}

TEST(SceneWriter, KeepsACompressionThatIsNotTheStretch) {
    const SceneDesc scene =
        read(R"({"weft": 1, "cloths": [{"fabric": {"preset": "denim", "stretch": 7, "compression": [411, 2028]}},
                                       {"fabric": {"preset": "denim", "compression": 7}}]})");
    EXPECT_THAT(written(scene), HasSubstr(R"({ "preset": "denim", "stretch": 7, "compression": [411, 2028] })"));
    expect_round_trip(scene);
    // In the order of the reference, even though the values depend on two keys.
    EXPECT_THAT(written(read(R"({"weft": 1, "cloths": [{"fabric": {"stretch": 7, "compression": 8, "shear": 9}}]})")),
                HasSubstr(R"({ "stretch": 7, "compression": 8, "shear": 9 })"));
}

TEST(SceneWriter, FillsLinesWithLongLists) {
    SceneDesc scene;
    scene.cloths.emplace_back().name = "cloth 0";
    VertexPins all;
    for (std::uint32_t i = 0; i < 500; ++i) all.vertices.push_back(i);
    scene.cloths[0].pins = {{.select = all}};
    expect_round_trip(scene);
    const std::string text = written(scene);
    EXPECT_LT(std::ranges::count(text, '\n'), 45) << text;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = text.find('\n', start);
        EXPECT_LE(end - start, 112u) << text.substr(start, end - start);
        start = end + 1;
    }
}

TEST(SceneWriter, RefusesWhatAFileCannotSay) {
    SceneDesc scene;
    scene.cloths.resize(2);
    scene.cloths[0].mesh = TriangleMesh{};
    scene.cloths[1].render_mesh = TriangleMesh{};
    scene.cloths[1].name = "\xff";
    const auto text = write_scene(scene);
    ASSERT_FALSE(text.ok());
    std::vector<std::string> messages;
    for (const Error& error : text.errors()) messages.push_back(error.message());
    EXPECT_THAT(messages,
                ElementsAre("/cloths/0/mesh: is a mesh in memory, for which a scene file must name a file",
                            "/cloths/1/name: must be UTF-8 to be written to a file",
                            "/cloths/1/render_mesh: is a mesh in memory, for which a scene file must name a file"));
}

TEST(SceneWriter, NumbersKeepTheirBits) {
    const auto back = [](float x) {
        const std::string text = JsonNode::number(x).pretty();
        return parse_scene("{\"weft\": 1, \"gravity\": [" + text + ", 0, 0], \"cloths\": [{}]}", "text");
    };
    RandomScene random(7);
    for (int i = 0; i < 20000; ++i) {
        const float x = std::bit_cast<float>(random.below(1u << 31) | (i % 2 ? 0x80000000u : 0u));
        if (!(std::abs(x) <= 1e6f)) continue;
        const auto scene = back(x);
        ASSERT_TRUE(scene.ok());
        ASSERT_EQ(std::bit_cast<std::uint32_t>(scene->gravity.x), std::bit_cast<std::uint32_t>(x)) << x;
    }
    EXPECT_EQ(JsonNode::number(0.14f).pretty(), "0.14\n");
    EXPECT_EQ(JsonNode::number(-0.0f).pretty(), "-0.0\n");
    EXPECT_EQ(JsonNode::number(1e-5f).pretty(), "1e-5\n");
}

}  // namespace
}  // namespace weft
