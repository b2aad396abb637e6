// Compares the state hash of every scene after a few frames with tests/golden/scene_hashes.txt. After an intended
// change of the physics, write new hashes with scripts/golden and note it in the changelog. An unintended change is a
// bug.
#include "cpu/cpu_backend.h"

#include <gtest/gtest.h>
#include <weft/simulation.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace weft {
namespace {

namespace fs = std::filesystem;

const fs::path table_file = fs::path(WEFT_SOURCE_DIR) / "tests" / "golden" / "scene_hashes.txt";

// More than one, because coarse levels use the tension of the frame before.
constexpr int frames = 3;

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

/// Hash by "banner default" or "banner own": with the default solver settings, or with those of the scene.
using Table = std::map<std::string, std::string>;

Table read_table() {
    Table table;
    std::ifstream in(table_file);
    std::string line, scene, solver, hash;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        if (!line.starts_with('#') && words >> scene >> solver >> hash) table[scene + ' ' + solver] = hash;
    }
    return table;
}

class SceneHash : public testing::TestWithParam<std::string> {
  protected:
    static void SetUpTestSuite() { table() = read_table(); }

    static void TearDownTestSuite() {
        if (!writes()) return;
        std::ofstream out(table_file);
        out << "# State hash of each scene after " << frames
            << " frames, by its solver. scripts/golden writes this file.\n";
        for (const auto& [run, hash] : table()) out << run << ' ' << hash << '\n';
        EXPECT_TRUE(out.flush()) << table_file;
    }

    static bool writes() { return std::getenv("WEFT_WRITE_GOLDEN") != nullptr; }
    static Table& table() {
        static Table all;
        return all;
    }

    static std::string hash_of(const Options& options) {
        auto simulation = Simulation::load(fs::path(WEFT_SOURCE_DIR) / "scenes" / (GetParam() + ".json"), options);
        if (!simulation) {
            ADD_FAILURE() << simulation.error().message();
            return {};
        }
        for (int i = 0; i < frames; ++i) simulation->step();
        return simulation->state_hash();
    }

    static void expect_golden(const std::string& solver, Options options) {
        options.backend = "cpu";
        const std::string run = GetParam() + ' ' + solver;
        if (writes()) {
            table()[run] = hash_of(options);
            return;
        }
        ASSERT_TRUE(table().contains(run)) << "scripts/golden adds what is missing to " << table_file;
        for (const std::string_view isa : cpu_instruction_sets()) {
            options.isa = isa;
            EXPECT_EQ(hash_of(options), table()[run]) << isa;
        }
        options.isa.clear();
        options.threads = 3;
        EXPECT_EQ(hash_of(options), table()[run]) << "three threads";
    }
};

// Labels: no-asan
TEST_P(SceneHash, of_the_default_solver) {
    expect_golden("default", {.solver = {{"method", "xpbd"}, {"projection", "auto"}, {"hierarchy", true}}});
}

// Labels: no-asan
TEST_P(SceneHash, of_its_own_solver) {
    const auto text = [] {
        std::ifstream in(fs::path(WEFT_SOURCE_DIR) / "scenes" / (GetParam() + ".json"));
        return std::string(std::istreambuf_iterator<char>(in), {});
    }();
    const auto names = [&](const char* key) { return text.find('"' + std::string(key) + '"') != std::string::npos; };
    if (!names("method") && !names("projection") && !names("hierarchy")) GTEST_SKIP() << "it has the default solver";
    expect_golden("own", {});
}

INSTANTIATE_TEST_SUITE_P(Golden, SceneHash, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(SceneHashes, belong_to_scenes) {
    const auto names = scene_names();
    for (const auto& [run, hash] : read_table()) {
        EXPECT_TRUE(std::ranges::count(names, run.substr(0, run.find(' ')))) << run << " in " << table_file;
    }
}

}  // namespace
}  // namespace weft
