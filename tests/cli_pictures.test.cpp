// `weft render` with pictures that are missing or broken, names that are wrong, and places that cannot be written to.

#include "cli_fixture.h"

#include "io/images/image_file.h"

#include <gmock/gmock.h>

#ifdef WEFT_VULKAN

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using weft::Image8;
using weft::Outcome;
using weft::read_file;

class CliVulkanPictureFiles : public weft::Cli {
  protected:
    /// A level sheet that fills the picture, with this material and light.
    void write_scene(const std::string& material, const std::string& light = "{}") {
        write(
            "sheet.json",
            R"({ "weft": 1, "cloths": [{ "name": "sheet", "mesh": { "grid": { "size": [2, 2], "resolution": [8, 8] } },
                   "pins": [{ "vertices": [0, 7, 56, 63] }], "material": )" +
                material + R"( }],
                   "camera": { "position": [0, 1.2, 0.01], "target": [0, 0, 0], "fov": 40 },
                   "light": )" +
                light + " }");
    }
    Outcome render(const std::string& more = "", const std::string& before = "") {
        return weft("render sheet.json --quiet --frames 0 --size 64x36 --samples 1 --out a.png " + more, before);
    }
    Image8 picture() {
        auto image = weft::read_image(folder_ / "a.png");
        EXPECT_TRUE(image.ok());
        return image ? *image : Image8{};
    }
    /// Expects that the command left no new file.
    void expect_nothing_written(const fs::path& folder) {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            const std::string name = entry.path().filename();
            EXPECT_TRUE(name == "sheet.json" || name == "stdout.txt" || name == "stderr.txt") << entry.path();
        }
    }
    void expect_one_line(const Outcome& outcome) {
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
};

TEST_F(CliVulkanPictureFiles, a_texture_that_is_missing_is_checkered) {
    write_scene(R"({ "preset": "matte", "color": [1, 1, 1], "color_map": "nowhere.png" })");
    const Outcome outcome = render();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("warning: "));
    EXPECT_THAT(outcome.err, HasSubstr("nowhere.png"));
    EXPECT_THAT(outcome.err, HasSubstr("checkered"));
    expect_one_line(outcome);
    const Image8 image = picture();
    std::size_t light = 0, dark = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) (image.rgba[i] > 150 ? light : dark) += 1;
    EXPECT_GT(light, 500u);
    EXPECT_GT(dark, 500u);
}

// Derivatives of UVs that are wrong at the edges of triangles blur the map there, and show the mesh in mixed colors.
TEST_F(CliVulkanPictureFiles, a_color_map_shows_no_edges_of_triangles) {
    Image8 halves{256, 256, std::vector<std::uint8_t>(std::size_t{256} * 256 * 4, 255)};
    for (std::uint32_t y = 0; y < 256; ++y) {
        for (std::uint32_t x = 0; x < 256; ++x) {
            halves.at(x, y)[x < 128 ? 1 : 0] = 0;  // red on the left, green on the right, no blue
            halves.at(x, y)[2] = 0;
        }
    }
    const auto bytes = weft::png_bytes(halves);
    ASSERT_TRUE(bytes.ok());
    write("halves.png", {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    write_scene(R"({ "preset": "matte", "color": [1, 1, 1], "color_map": "halves.png" })");
    ASSERT_EQ(render().status, 0);
    const Image8 image = picture();
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (const std::uint32_t x : {2u, 9u, 16u, 23u, 28u, 36u, 41u, 48u, 55u, 61u}) {
            const std::uint8_t* pixel = image.at(x, y);
            const int one = pixel[x < 32 ? 0 : 1], other = pixel[x < 32 ? 1 : 0];
            EXPECT_GT(one, 2 * other) << x << ' ' << y;
        }
    }
}

// Labels: no-asan
TEST_F(CliVulkanPictureFiles, broken_ones_too) {
    write("broken.png", "\x89PNG and no more");
    write("empty.png", "");
    for (const char* file : {"broken.png", "empty.png", "sheet.json", "."}) {
        write_scene(std::string(R"({ "preset": "cotton", "color_map": ")") + file + "\" }");
        const Outcome outcome = render();
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("checkered")) << file;
        expect_one_line(outcome);
    }
    write_scene(R"({ "preset": "cotton", "normal_map": "nowhere.png" })");
    const Outcome outcome = render();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("its weave is drawn instead"));
    const std::string with = read_file(folder_ / "a.png");
    write_scene(R"("cotton")");
    EXPECT_EQ(render().err, "");
    EXPECT_EQ(read_file(folder_ / "a.png"), with);
}

TEST_F(CliVulkanPictureFiles, surroundings_that_are_missing_are_the_sky) {
    write_scene(R"("cotton")", R"({ "environment": { "file": "nowhere.hdr" } })");
    const Outcome outcome = render();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("warning: light: "));
    EXPECT_THAT(outcome.err, HasSubstr("nowhere.hdr"));
    expect_one_line(outcome);
    const std::string with = read_file(folder_ / "a.png");
    write_scene(R"("cotton")");
    EXPECT_EQ(render().err, "");
    EXPECT_EQ(read_file(folder_ / "a.png"), with);
}

TEST_F(CliVulkanPictureFiles, a_material_that_is_misspelled_is_told_the_nearest) {
    write_scene(R"("vellvet")");
    const Outcome outcome = render();
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("vellvet"));
    EXPECT_THAT(outcome.err, HasSubstr("\"velvet\""));
    EXPECT_THAT(outcome.err, HasSubstr("sheet.json"));
    expect_nothing_written(folder_);
}

TEST_F(CliVulkanPictureFiles, a_device_that_there_is_not_is_told_those_that_there_are) {
    write_scene(R"("cotton")");
    for (const char* backend : {"cpu", "auto", "vulkan"}) {
        const Outcome outcome = render(std::string("--device no_such_gpu --backend ") + backend);
        EXPECT_NE(outcome.status, 0) << backend;
        EXPECT_THAT(outcome.err, HasSubstr("no_such_gpu")) << backend;
        expect_nothing_written(folder_);
    }
}

TEST_F(CliVulkanPictureFiles, without_a_driver_it_says_what_to_install) {
    write_scene(R"("cotton")");
    const Outcome outcome = render("--backend cpu", "VK_ICD_FILENAMES=/nowhere.json VK_DRIVER_FILES=/nowhere.json");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("mesa-vulkan-drivers"));
    expect_nothing_written(folder_);
}

TEST_F(CliVulkanPictureFiles, a_folder_that_is_not_there_is_made_and_one_that_cannot_be_is_an_error) {
    write_scene(R"("cotton")");
    const std::string options = "render sheet.json --quiet --frames 0 --size 64x36 --samples 1 ";
    const Outcome made = weft(options + "--out new/deep/a.png");
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_TRUE(fs::exists(folder_ / "new/deep/a.png"));
    const Outcome refused = weft(options + "--out /proc/weft/a.png");
    EXPECT_NE(refused.status, 0);
    EXPECT_THAT(refused.err, HasSubstr("/proc/weft"));
    expect_one_line(refused);
}

TEST_F(CliVulkanPictureFiles, what_cannot_be_put_in_its_place_leaves_nothing) {
    write_scene(R"("cotton")");
    fs::create_directory(folder_ / "a.png");
    const Outcome outcome = render();
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("a.png"));
    expect_one_line(outcome);
    EXPECT_TRUE(fs::is_directory(folder_ / "a.png"));
    fs::remove(folder_ / "a.png");
    expect_nothing_written(folder_);
}

// Every write to /dev/full fails.
TEST_F(CliVulkanPictureFiles, a_full_device_is_an_error) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    write_scene(R"("cotton")");
    fs::create_symlink("/dev/full", folder_ / "full.png");
    const Outcome full = weft("render sheet.json --quiet --frames 0 --size 64x36 --samples 1 --out full.png");
    if (full.status == 0) {  // the image replaced the link
        EXPECT_TRUE(weft::read_image(folder_ / "full.png").ok());
        EXPECT_FALSE(fs::is_symlink(folder_ / "full.png"));
    } else {
        EXPECT_THAT(full.err, HasSubstr("full.png"));
    }
    EXPECT_TRUE(fs::exists("/dev/full"));
    for (const auto& entry : fs::directory_iterator(folder_))
        EXPECT_NE(entry.path().filename().string().rfind(".weft", 0), 0u) << entry.path();
}

}  // namespace

#endif
