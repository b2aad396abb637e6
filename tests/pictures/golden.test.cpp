// Compares images of scenes with the reviewed ones in tests/golden. If one differs, the test writes the new image and
// the difference to golden/ in the build folder. scripts/golden writes all of them again.

#include "measure.h"
#include "scenes.h"

#include "io/images/image_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace weft {
namespace {

namespace fs = std::filesystem;

const fs::path golden_folder = fs::path(WEFT_SOURCE_DIR) / "tests" / "golden";
const fs::path left_folder = fs::path(WEFT_BINARY_DIR) / "golden";

void write_picture(const fs::path& path, const Image8& image) {
    fs::create_directories(path.parent_path());
    const auto bytes = png_bytes(image);
    ASSERT_TRUE(bytes.ok()) << bytes.error().message();
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
    ASSERT_TRUE(out.flush()) << path;
}

class Golden : public PictureTest, public testing::WithParamInterface<PictureScene> {};

TEST_P(Golden, looks_as_it_did) {
    if (info.type != gpu::DeviceType::cpu) GTEST_SKIP() << "golden pictures are of lavapipe, not of " << info.name;
    const PictureScene& scene = GetParam();
    const Image8 image = drawn(scene);
    if (HasFailure()) return;
    const fs::path golden = golden_folder / (scene.name + ".png");
    if (std::getenv("WEFT_WRITE_GOLDEN")) return write_picture(golden, image);

    const fs::path got = left_folder / (scene.name + "_got.png"),
                   differs = left_folder / (scene.name + "_difference.png");
    fs::remove(got);
    fs::remove(differs);
    const auto expected = read_image(golden);
    if (!expected) write_picture(got, image);
    ASSERT_TRUE(expected.ok()) << expected.error().message() << "\nwhat came out is " << got
                               << "\nscripts/golden makes all of them";
    const PictureDistance distance = distance_of(*expected, image);
    if (alike(distance)) return;
    write_picture(got, image);
    if (distance.width > 0) write_picture(differs, picture_of(distance, *expected));
    ADD_FAILURE() << scene.name << " differs from " << golden << ": ΔE is " << distance.mean << " on the mean ("
                  << mean_allowed << " allowed), and beyond " << distance.worst << " in a pixel of a hundred ("
                  << worst_allowed << " allowed)\nwhat came out is " << got << "\nwhere it differs, " << differs
                  << "\nIf it is right, scripts/golden makes all of them anew";
}

// All scenes run the same code. Under a sanitizer an image takes long, so only one in five is tested.
std::vector<PictureScene> compared_scenes() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    std::vector<PictureScene> some;
    for (std::size_t i = 0; i < picture_scenes().size(); i += 5) some.push_back(picture_scenes()[i]);
    return some;
#else
    return {picture_scenes().begin(), picture_scenes().end()};
#endif
}

INSTANTIATE_TEST_SUITE_P(Vulkan, Golden, testing::ValuesIn(compared_scenes()),
                         [](const auto& one) { return one.param.name; });

// Negative controls: visible changes of a scene exceed the tolerance.
class VulkanGoldenCatches : public PictureTest {
  protected:
    void expect_caught(const PictureScene& good, const PictureScene& changed) {
        const PictureDistance distance = distance_of(drawn(good), drawn(changed));
        EXPECT_FALSE(alike(distance)) << distance.mean << " " << distance.worst;
    }
};

// Labels: slow no-asan
TEST_F(VulkanGoldenCatches, brighter_by_5_percent) {
    expect_caught({.name = "as_it_is"}, {.name = "brighter", .light = R"({ "exposure": 0.0704 })"});
}
// Labels: slow no-asan
TEST_F(VulkanGoldenCatches, other_normals) {
    const auto knit = [](const std::string& relief) {
        return PictureScene{.name = "knit",
                            .look = R"({ "preset": "ribknit", "thread_spacing": 30, "weave_depth": )" + relief + " }"};
    };
    expect_caught(knit("1"), knit("0.5"));
}
// Labels: slow no-asan
TEST_F(VulkanGoldenCatches, light_from_elsewhere) {
    expect_caught({.name = "as_it_is"}, {.name = "elsewhere", .light = R"({ "sun": { "azimuth": -30 } })"});
}
// Labels: slow no-asan
TEST_F(VulkanGoldenCatches, no_occlusion) {
    expect_caught({.name = "sky_alone", .light = R"({ "sun": { "intensity": 0 } })"},
                  {.name = "not_occluded", .light = R"({ "sun": { "intensity": 0 }, "ambient_occlusion": 0 })"});
}
// Labels: slow no-asan
TEST_F(VulkanGoldenCatches, another_material) {
    expect_caught({.name = "silk", .look = "\"silk\""},
                  {.name = "rougher_silk", .look = R"({ "preset": "silk", "roughness": [0.4, 0.5] })"});
}

TEST(GoldenPictures, are_those_of_the_scenes_and_no_others) {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(golden_folder)) {
        if (entry.path().extension() != ".png") continue;
        ++count;
        const auto named = [&](const PictureScene& scene) { return scene.name == entry.path().stem(); };
        EXPECT_TRUE(std::ranges::any_of(picture_scenes(), named)) << entry.path() << " belongs to no scene";
    }
    EXPECT_EQ(count, picture_scenes().size()) << "scripts/golden makes them";
}

}  // namespace
}  // namespace weft
