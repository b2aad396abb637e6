// Every scene of the repository, and every JSON sample of the pages, must be a scene, or a part of one, that the reader
// accepts.
#include "io/scenes/read_scene.test.h"
#include "scene/scene_keys.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace weft {
namespace {

struct Sample {
    std::string heading;  ///< the last heading before the sample, a place of a scene in docs/scene.md
    std::string text;
    std::size_t line = 0;
};

std::vector<Sample> samples_of(const std::string& page) {
    std::ifstream file(std::string(WEFT_SOURCE_DIR) + "/" + page);
    EXPECT_TRUE(file) << page;
    std::vector<Sample> samples;
    std::string line, heading;
    bool inside = false;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        if (line.starts_with("```")) {
            inside = line == "```jsonc";
            if (inside) samples.push_back({heading, {}, number});
        } else if (inside) {
            samples.back().text += line + '\n';
        } else if (line.starts_with("#")) {
            heading = line.substr(line.find_first_not_of("# "));
        }
    }
    return samples;
}

/// A scene with the keys of a sample in the object that its heading names. A sample of `cloths` or `colliders` replaces
/// the list.
std::string scene_with(const std::string& keys, const std::string& heading) {
    const bool has_cloths = keys.starts_with("\"cloths\""), has_colliders = keys.starts_with("\"colliders\"");
    const bool of_cloth = heading.starts_with("`/cloths/*") && !has_cloths;
    const bool of_collider = heading.starts_with("`/colliders/*") && !has_colliders;
    const std::string more = ", " + keys;
    std::string scene = R"({"weft": 1)";
    if (!has_cloths)
        scene += R"(, "cloths": [{"name": "front")" + (of_cloth ? more : std::string()) + R"(}, {"name": "back"}])";
    if (!has_colliders)
        scene += R"(, "colliders": [{"name": "ball", "sphere": {})" + (of_collider ? more : std::string()) + "}]";
    return scene + (of_cloth || of_collider ? "" : more) + "}";
}

std::vector<std::string> errors_of_sample(const Sample& sample) {
    if (sample.text.starts_with("{")) return errors_of(sample.text);
    std::vector<std::string> errors = errors_of(scene_with(sample.text, sample.heading));
    if (errors.empty()) return errors;
    // Lines that show alternatives for the same key.
    std::vector<std::string> of_lines;
    std::istringstream lines(sample.text);
    for (std::string line; std::getline(lines, line);) {
        const auto more = errors_of(scene_with(line + '\n', sample.heading));
        of_lines.insert(of_lines.end(), more.begin(), more.end());
    }
    return of_lines.empty() ? of_lines : errors;
}

TEST(SceneSamples, are_read_without_errors) {
    std::size_t count = 0;
    for (const std::string page : {"README.md", "docs/scene.md", "docs/cookbook.md"}) {
        for (Sample sample : samples_of(page)) {
            if (page == "docs/cookbook.md") sample.heading = "`/cloths/*`";       // its samples are keys of a cloth
            if (sample.text.find("json.schemas") != std::string::npos) continue;  // settings of an editor
            EXPECT_THAT(errors_of_sample(sample), testing::IsEmpty()) << page << ':' << sample.line << '\n'
                                                                      << sample.text;
            ++count;
        }
    }
    EXPECT_GE(count, 12u);
}

TEST(SceneSamples, begin_every_section_of_the_scene_reference) {
    std::set<std::string> with_sample;
    for (const Sample& sample : samples_of("docs/scene.md")) with_sample.insert(sample.heading);
    for (const SceneTable& table : scene_tables()) {
        const std::string place = table.place.empty() ? "/" : std::string(table.place);
        EXPECT_TRUE(with_sample.contains("`" + place + "`")) << place;
    }
}

TEST(Scenes, AllLoad) {
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(WEFT_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".json") continue;
        const Result<SceneDesc> scene = load_scene(entry.path());
        EXPECT_TRUE(scene) << scene.error().message();
        ++count;
    }
    EXPECT_GE(count, 3);
}

TEST(Scenes, ExampleOfTheReferenceLoads) {
    std::ifstream file(WEFT_SOURCE_DIR "/docs/scene.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string fence = "```jsonc\n";
    const std::size_t start = text.find(fence) + fence.size();
    const Result<SceneDesc> scene = parse_scene(text.substr(start, text.find("```", start) - start), "docs/scene.md");
    EXPECT_TRUE(scene) << scene.error().message();
}

}  // namespace
}  // namespace weft
