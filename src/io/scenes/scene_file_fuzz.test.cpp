// Randomly damaged scenes: any text must give either a scene that passes its checks or errors.
#include "io/scenes/scene_file.h"
#include "scene/check.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace weft {
namespace {

constexpr std::string_view seed_scene = R"({
    "weft": 1, "name": "all", "gravity": [0, -1.62, 0.5], "frame_rate": 24, // moon
    "solver": { "method": "xpbd", "projection": "gauss-seidel", "substeps": 7, "iterations": 3 },
    "cloths": [
        { "name": "sheet", "mesh": { "grid": { "size": [2, 3], "resolution": [5, 9], "diagonal": "cross" } },
          "transform": { "position": [1, 2, 3], "rotation": [90, 0, -45], "scale": 2 },
          "material": "velvet", "fabric": { "preset": "denim", "density": 0.5, "stretch": [100, 200], "rest_angle": "mesh" },
          "pins": [ { "vertices": [0, 4] }, { "box": { "min": [-1, -2, -3], "max": [1, 2, 3] } } ] },
        { "mesh": { "sphere": { "radius": 0.5, "subdivisions": 2 } }, "fabric": { "bend_edges": "no-diagonals", "bend_model": "distance" },
          "render_mesh": { "box": { "size": [1, 1, 1], "resolution": [3, 4, 5] } },
          "material": { "preset": "silk", "weft_color": [1, 0, 0], "uv_tiling": [2, 3], "color_map": "a.png" } },
        { "mesh": { "file": "bunny.obj", "up": "z" }, "fabric": "silk", "pins": [ { "color": [1, 0, 0.5] } ] } ],
    "colliders": [ { "plane": { "normal": [0, 2, 0] }, "friction": 0.7,
                     "material": { "color": [0.5, 0.5, 0.5], "roughness": 0.4, "weave": "twill" } }, { "sphere": { "radius": 0.1 },
                     "motion": { "dynamic": { "mass": 2, "inertia": [1, 1, 1.5], "spin": [0, 90, 0], "reaction": false } } } ],
    "camera": { "position": [1, 2, 3], "target": [0, 1, 0], "fov": 30 },
    "light": { "sun": { "azimuth": 10, "color": [1, 1, 0.5] }, "sky": { "intensity": 0.5, "zenith": [0, 0, 1] },
               "environment": { "file": "hall.hdr", "rotation": 90, "visible": false }, "exposure": -1, "ambient_occlusion": 0.5 }
})";

constexpr std::array<std::string_view, 24> pieces = {
    "{",   "}",  "[",      "]",      ",",  ":",  "\"", "-1", "1e39",    "1e999", "null",        "true",
    "0.5", "64", "\"xx\"", "[1, 2]", "{}", "[]", "//", "/*", "\\u0000", "\xff",  "99999999999", "\"weft\"",
};

// <random> is not used, because its distributions give different numbers with different libraries.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::size_t below(std::size_t limit) {  // PCG's multiplier; the high bits are the output
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::size_t>(state_ >> 33) % limit;
    }

  private:
    std::uint64_t state_;
};

void damage(std::string& text, Random& random) {
    const std::size_t place = random.below(text.size() + 1);
    const std::size_t length = random.below(12);
    switch (random.below(6)) {
        case 0:
            text.insert(place, pieces[random.below(pieces.size())]);
            break;
        case 1:
            text.erase(place, length);
            break;
        case 2:
            text.replace(place, length, pieces[random.below(pieces.size())]);
            break;
        case 3:
            text.insert(place, text.substr(random.below(text.size() + 1), random.below(60)));
            break;
        case 4:
            if (place < text.size()) text[place] = "0123456789-.e"[random.below(13)];
            break;
        default:
            if (place < text.size()) text[place] = static_cast<char>(random.below(256));
            break;
    }
}

TEST(SceneFileFuzz, DamagedScenesLoadOrSayWhatIsWrong) {
    Random random(1);
    int loaded = 0;
    for (int round = 0; round < 6000; ++round) {
        std::string text(seed_scene);
        for (std::size_t i = random.below(3) + 1; i > 0; --i) damage(text, random);
        const Result<SceneDesc> scene = parse_scene(text, "fuzz");
        if (scene) {
            ++loaded;
            ASSERT_TRUE(check_scene(*scene).empty()) << text;
            continue;
        }
        ASSERT_FALSE(scene.errors().empty()) << text;
        for (const Error& error : scene.errors()) {
            ASSERT_FALSE(error.what.empty()) << text;
            ASSERT_EQ(error.message().find('\n'), std::string::npos) << text;
        }
    }
    EXPECT_GT(loaded, 100);  // enough damage passes the parser
}

// Replaces every value by a value of every other type.
TEST(SceneFileFuzz, EveryValueMayBeOfAnyType) {
    int rejected = 0;
    for (std::size_t place = seed_scene.find(": "); place != seed_scene.npos; place = seed_scene.find(": ", place + 1))
        for (const std::string_view piece :
             {"null", "true", "-1", "0.5", "1e38", "\"x\"", "[]", "[[]]", "{}", "[{}]"}) {
            std::string text(seed_scene.substr(0, place + 2));
            text += piece;
            // The rest of the object stays: the unknown key `_` gets the replaced value.
            text += ", \"_\": ";
            text += seed_scene.substr(place + 2);
            const Result<SceneDesc> scene = parse_scene(text, "fuzz");
            ASSERT_FALSE(scene) << text;
            rejected += static_cast<int>(scene.errors().size());
        }
    EXPECT_GT(rejected, 0);
}

}  // namespace
}  // namespace weft
