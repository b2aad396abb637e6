// `weft render` as a user runs it: errors before the run, and the images that it writes.

#include "cli_fixture.h"

#include "io/images/image_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using weft::Image8;
using weft::Outcome;
using weft::read_file;

class CliRender : public weft::Cli {
  protected:
    void expect_no_pictures() {
        for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
            const std::string name = entry.path().filename();
            EXPECT_NE(entry.path().extension(), ".png") << name;
            EXPECT_NE(entry.path().extension(), ".mp4") << name;
            EXPECT_NE(name.rfind(".weft", 0), 0u) << name;
        }
    }
};

#ifdef WEFT_VULKAN

TEST_F(CliRender, wrong_usage_is_one_line_and_status_2) {
    const auto refused = [&](const std::string& options, const std::string& says) {
        expect_usage_error("render sheet.json --out a.png --frames 1 " + options, says);
    };
    expect_usage_error("render", "scene");
    expect_usage_error("render sheet.json", "--out");
    expect_usage_error("render nowhere.json --out a.png", "nowhere.json");
    for (const char* size : {"0x720", "720", "axb", "1280x", "x720", "16385x1", "-1x5", "1280x720x3", "12.5x3",
                             "99999999999x1", "''", "'12 x 13'"})
        refused(std::string("--size ") + size, "--size: must be width x height, each from 1 to 16384");
    refused("--size 16384x16384", "at most 134217728 pixels");
    for (const char* samples : {"0", "3", "-4", "512"})
        refused(std::string("--samples ") + samples, "--samples: must be");
    refused("--samples many", "--samples");
    for (const char* camera :
         {"1,2,3", "1,2,3,4,5", "1,2,3,4,5,6,7,8", "a,2,3,4,5,6", "1,2,3,4,5,nan", "1,,3,4,5,6", "1,2,3,4,5,6,"})
        refused(std::string("--camera ") + camera, "--camera: must be six or seven numbers");
    refused("--camera 1,2,3,1,2,3", "must differ");
    refused("--camera 1,2,3,0,0,0,180", "--camera: fov must be from 1 to 150 °, got 180");
    refused("--orbit nan", "--orbit: must be from -36000 to 36000");
    refused("--orbit round", "--orbit");
    refused("--fps 0", "--fps: must be more than 0 and at most 60");
    refused("--fps 61", "--fps: must be more than 0 and at most 60");
    refused("--fps nan", "--fps");
    refused("--overlay no_such_overlay", "--overlay: ");
    expect_usage_error("render sheet.json --out a.png --frames 1.5", "whole number");
    refused("--out b.gif", "unknown ending \".gif\"; images are written as .png, .mp4");
    refused("--out ./a.png", "two --out options");
    refused("--out %s.png", "%04d");
    refused("--out %d.mp4", "in one file");
    refused("--out sheet.json/b.png", "its folder cannot be made");
    refused("--out film.mp4 --transparent", "no transparency");
    refused("--out film.mp4 --size 65x37", "use 66x38");
    refused("--seconds 1", "--frames");
    expect_no_pictures();
}

TEST_F(CliRender, an_overlay_that_is_misspelled_is_told_the_nearest) {
    const Outcome help = weft("render --help");
    const std::string before = "draw on top; may be repeated: ";
    ASSERT_NE(help.out.find(before), std::string::npos) << help.out;
    std::string name = help.out.substr(help.out.find(before) + before.size());
    name = name.substr(0, name.find_first_of(", \n"));
    expect_usage_error("render sheet.json --out a.png --overlay " + name + "x", "\"" + name + "\"");
}

TEST_F(CliRender, without_a_vulkan_device_it_says_what_to_install) {
    const Outcome outcome =
        weft("render sheet.json --out a.png --frames 1 --backend cpu", "VK_ICD_FILENAMES=/none VK_DRIVER_FILES=/none");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("mesa-vulkan-drivers"));
    EXPECT_THAT(outcome.err, HasSubstr("whatever the backend"));
    expect_no_pictures();
}

TEST_F(CliRender, without_ffmpeg_it_says_what_to_install) {
    fs::create_directory(folder_ / "bin");
    const Outcome outcome = weft("render sheet.json --out a.mp4 --frames 1 --size 64x36", "PATH=bin");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("install ffmpeg (Debian: ffmpeg)"));
    EXPECT_EQ(outcome.err.find("rendering"), std::string::npos) << "before anything runs";
    expect_no_pictures();
}

/// Uses the default device; without a GPU it is lavapipe.
class CliPictures : public CliRender {
  protected:
    Outcome render(const std::string& options) {
        Outcome outcome =
            weft("render sheet.json --quiet --size 64x36 --samples 1 --camera 0,0.9,1.6,0,0.3,0 " + options);
        EXPECT_EQ(outcome.status, 0) << options << ": " << outcome.err;
        EXPECT_EQ(outcome.out, "") << "--quiet";
        return outcome;
    }
    Image8 picture(const std::string& name) {
        auto image = weft::read_image(folder_ / name);
        EXPECT_TRUE(image.ok()) << name;
        return image ? *image : Image8{};
    }
    /// How many pixels differ.
    static std::size_t difference(const Image8& a, const Image8& b) {
        EXPECT_EQ(a.rgba.size(), b.rgba.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i + 3 < std::min(a.rgba.size(), b.rgba.size()); i += 4)
            count += !std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]);
        return count;
    }
};

TEST_F(CliPictures, a_picture_a_sequence_and_a_film_in_one_run) {
    const Outcome outcome =
        weft("render sheet.json --frames 4 --size 64x36 --samples 1 --out last.png --out new/%02d.png");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("wrote last.png\nwrote new/%02d.png\n"));
    EXPECT_THAT(outcome.err, HasSubstr("rendering 4/4"));
    for (int i = 0; i <= 4; ++i) {
        const Image8 image = picture("new/0" + std::to_string(i) + ".png");
        EXPECT_EQ(image.width, 64u);
        EXPECT_EQ(image.height, 36u);
    }
    EXPECT_FALSE(fs::exists(folder_ / "new/05.png"));
    EXPECT_EQ(read_file(folder_ / "new/04.png"), read_file(folder_ / "last.png"));
}

// Labels: no-asan
TEST_F(CliPictures, the_cloth_is_seen_and_moves) {
    render("--frames 20 --out all/%02d.png");
    const Image8 start = picture("all/00.png"), end = picture("all/20.png");
    EXPECT_GT(difference(start, Image8{64, 36, std::vector<std::uint8_t>(start.rgba.size(), 0)}), 0u);
    EXPECT_GT(difference(start, end), 64u * 36 / 50);
    render("--frames 20 --out last.png");
    EXPECT_EQ(read_file(folder_ / "all/20.png"), read_file(folder_ / "last.png")) << "whether others are drawn or not";
    render("--frames 0 --out start.png");
    EXPECT_EQ(read_file(folder_ / "all/00.png"), read_file(folder_ / "start.png"));
}

TEST_F(CliPictures, without_a_camera_what_falls_stays_in_the_picture) {
    write("falls.json", R"({ "weft": 1, "cloths": [{ "name": "sheet", "transform": { "rotation": [50, 20, 0] },
        "mesh": { "grid": { "size": [1, 1], "resolution": [9, 9] } } }] })");
    const std::string render = "render falls.json --quiet --seconds 1.5 --size 64x36 --samples 1 --transparent --out ";
    ASSERT_EQ(weft(render + "last.png").status, 0);
    ASSERT_EQ(weft(render + "film/%d.png --out film_last.png --fps 2").status, 0);
    for (const char* name : {"last.png", "film/0.png", "film/1.png", "film/2.png", "film/3.png"}) {
        const Image8 image = picture(name);
        std::size_t covered = 0;
        for (std::size_t i = 3; i < image.rgba.size(); i += 4) covered += image.rgba[i] > 127;
        EXPECT_GT(covered, 64u * 36 / 12) << name;
        EXPECT_LT(covered, 64u * 36 / 2) << name;
    }
    EXPECT_EQ(read_file(folder_ / "film/3.png"), read_file(folder_ / "film_last.png")) << "one camera for a run";
}

// Labels: no-asan
TEST_F(CliPictures, fewer_pictures_a_second_are_those_nearest_in_time) {
    render("--frames 6 --out all/%d.png");
    render("--frames 6 --fps 30 --out half/%d.png");
    render("--frames 6 --fps 24 --out film/%d.png");
    for (const int i : {0, 1, 2, 3})
        EXPECT_EQ(read_file(folder_ / ("half/" + std::to_string(i) + ".png")),
                  read_file(folder_ / ("all/" + std::to_string(2 * i) + ".png")));
    EXPECT_FALSE(fs::exists(folder_ / "half/4.png"));
    // Every 2.5th frame: 0, 2.5, 5.
    EXPECT_EQ(read_file(folder_ / "film/1.png"), read_file(folder_ / "all/3.png"));
    EXPECT_EQ(read_file(folder_ / "film/2.png"), read_file(folder_ / "all/5.png"));
    EXPECT_FALSE(fs::exists(folder_ / "film/3.png"));
}

// Labels: no-asan
TEST_F(CliPictures, the_camera_goes_around) {
    render("--frames 4 --out still/%d.png");
    render("--frames 4 --orbit 80 --out orbit/%d.png");
    EXPECT_EQ(read_file(folder_ / "orbit/0.png"), read_file(folder_ / "still/0.png"));
    EXPECT_GT(difference(picture("orbit/2.png"), picture("still/2.png")), 64u * 36 / 50);
    render("--frames 4 --orbit 80 --out last.png");
    EXPECT_EQ(read_file(folder_ / "orbit/4.png"), read_file(folder_ / "last.png"));
    render("--frames 4 --orbit -80 --out other.png");
    EXPECT_NE(read_file(folder_ / "orbit/4.png"), read_file(folder_ / "other.png"));
}

TEST_F(CliPictures, without_a_background_alpha_says_where_something_is) {
    write("sheet.json", R"({ "weft": 1, "cloths": [{ "mesh": { "grid": { "size": [1, 1], "resolution": [8, 8] } },
                             "transform": { "position": [0, 0.3, 0] }, "pins": [{ "vertices": [0, 7, 56, 63] }] }] })");
    render("--frames 0 --transparent --out clear.png");
    render("--frames 0 --out full.png");
    const Image8 clear = picture("clear.png"), full = picture("full.png");
    EXPECT_EQ(clear.at(0, 0)[3], 0);
    EXPECT_EQ(clear.at(32, 18)[3], 255) << "the middle of the sheet";
    EXPECT_EQ(full.at(0, 0)[3], 255);
}

// Labels: no-asan
TEST_F(CliPictures, both_backends_give_the_same_picture_but_for_rounding) {
    render("--frames 5 --backend cpu --out cpu.png");
    render("--frames 5 --backend vulkan --out vulkan.png");
    const Image8 cpu = picture("cpu.png"), vulkan = picture("vulkan.png");
    std::size_t far = 0;
    for (std::size_t i = 0; i < std::min(cpu.rgba.size(), vulkan.rgba.size()); ++i)
        far += std::abs(cpu.rgba[i] - vulkan.rgba[i]) > 4;
    EXPECT_LE(far, cpu.rgba.size() / 200);
    const std::string missing = " render sheet.json --backend cpu --device no_such_gpu --frames 0 --out a.png";
    EXPECT_THAT(weft(missing).err, HasSubstr("no_such_gpu"));
}

TEST_F(CliPictures, a_film_has_every_picture) {
    if (std::system("ffprobe -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    render("--frames 6 --fps 30 --out film.mp4");
    const std::string command =
        "cd " + folder_.string() + " && ffprobe -v error -count_frames -show_streams film.mp4 >probe.txt";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string probe = read_file(folder_ / "probe.txt");
    for (const char* line : {"nb_read_frames=4\n", "width=64\n", "height=36\n", "r_frame_rate=30/1\n"})
        EXPECT_THAT(probe, HasSubstr(line));
}

TEST_F(CliPictures, every_overlay_can_be_asked_for) {
    const std::string help = weft("render --help").out;
    std::string names = help.substr(help.find("repeated: ", help.find("--overlay")) + 10);
    names = names.substr(0, names.find("--"));
    std::erase_if(names, [](unsigned char c) { return std::isspace(c); });
    render("--frames 30 --out plain.png");
    render("--frames 30 --out all.png --overlay " + names);
    EXPECT_GT(difference(picture("plain.png"), picture("all.png")), 0u) << names;
}

TEST_F(CliPictures, ended_early_it_leaves_what_was_whole) {
    // As soon as pictures come. What the shell starts beside itself would not hear of SIGINT.
    std::ofstream(folder_ / "when_drawn") << "env --default-signal=INT \"$@\" & program=$!\n"
                                             "until [ -e s/01.png ] || ! kill -0 $program; do sleep 0.05; done\n"
                                             "kill -s $SIGNAL $program; wait $program\n";
    for (const char* signal : {"INT", "TERM"}) {
        const Outcome outcome = weft(
            "render sheet.json --quiet --frames 1000000 --size 64x36 --samples 1 --out s/%02d.png --out film.mp4 --out "
            "a.png",
            std::string("SIGNAL=") + signal + " timeout -k 9 120 sh ./when_drawn");
        EXPECT_EQ(outcome.status, 1) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("interrupted at frame "));
        EXPECT_FALSE(fs::exists(folder_ / "film.mp4"));
        EXPECT_FALSE(fs::exists(folder_ / "a.png"));
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            EXPECT_NE(entry.path().filename().string().rfind(".weft", 0), 0u) << entry.path();
        fs::remove_all(folder_ / "s");
    }
}

#if !defined(__SANITIZE_THREAD__)  // the sanitizer writes a file of its own, which the limit forbids
TEST_F(CliPictures, a_full_disk_is_status_1_and_leaves_nothing) {
    const Outcome full = weft("render sheet.json --quiet --frames 1 --size 640x360 --out a.png", "ulimit -f 1;");
    EXPECT_EQ(full.status, 1);
    EXPECT_THAT(full.err, HasSubstr("File too large"));
    expect_no_pictures();
}
#endif

#else

TEST_F(CliRender, without_vulkan_it_says_so) {
    const Outcome outcome = weft("render sheet.json --out a.png");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("this build has no Vulkan"));
    expect_no_pictures();
}

#endif

}  // namespace
