// Thumbnails by the program weft, which the whole build makes.
#include "editor/app/thumbnails.h"

#include "editor/core/scene.test.h"
#include "io/images/image_file.h"

#include <gmock/gmock.h>

#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace weft::editor {
namespace {

using State = Thumbnails::State;

class ThumbnailsTest : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(std::filesystem::exists(program)) << program << " is not built";
        std::ofstream(scene) << R"({"weft": 1, "cloths": [{"mesh": {"grid": {"resolution": [8, 8]}}}]})";
        std::ofstream(broken) << R"({"weft": 1, "cloths": 3})";
    }
    Thumbnails::Options options() const {
        return {.folder = cache, .program = program, .width = 64, .height = 40, .frames = 2};
    }
    static void finish(Thumbnails& all) {
        for (int i = 0; i < 12000 && all.update(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::size_t cached() const {
        std::error_code none;
        std::size_t count = 0;
        for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(cache, none)) ++count;
        return count;
    }

    const std::filesystem::path program = std::filesystem::path(WEFT_BINARY_DIR) / "apps" / "cli" / "weft";
    ScratchFolder folder;
    const std::filesystem::path scene = folder / "sheet.json", broken = folder / "broken.json",
                                cache = folder / "cache";
};

TEST_F(ThumbnailsTest, are_rendered_once_and_then_read) {
    {
        Thumbnails all({scene, broken, folder / "missing.json"}, options());
        const auto begin = std::chrono::steady_clock::now();
        all.update();
        EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(500)) << "it does not wait";
        EXPECT_NE(all.state(0), State::ready);
        finish(all);
        ASSERT_EQ(all.state(0), State::ready);
        EXPECT_EQ(all.image(0).width, 64u);
        EXPECT_EQ(all.image(0).height, 40u);
        EXPECT_EQ(all.state(1), State::failed);
        EXPECT_EQ(all.state(2), State::failed);
    }
    EXPECT_EQ(cached(), 1u) << "and nothing else is left there";
    Thumbnails::Options without = options();
    without.program = "/no/such/program";
    {
        Thumbnails again({scene}, without);
        finish(again);
        EXPECT_EQ(again.state(0), State::ready) << "from the cache";
    }
    // Another content is another image.
    std::ofstream(scene, std::ios::app) << " ";
    Thumbnails changed({scene}, without);
    finish(changed);
    EXPECT_EQ(changed.state(0), State::failed);
}

TEST_F(ThumbnailsTest, are_shown_without_a_cache_that_can_be_written) {
    for (const std::filesystem::path& place :
         {std::filesystem::path(), std::filesystem::path("/proc/no/such/folder")}) {
        Thumbnails::Options none = options();
        none.folder = place;
        Thumbnails all({scene}, none);
        finish(all);
        EXPECT_EQ(all.state(0), State::ready) << place;
    }
    EXPECT_EQ(cached(), 0u);
}

TEST_F(ThumbnailsTest, a_damaged_one_is_made_again) {
    std::filesystem::create_directories(cache);
    std::ofstream(cache / thumbnail_name(scene, 64, 40)) << "no image";
    Thumbnails all({scene}, options());
    finish(all);
    ASSERT_EQ(all.state(0), State::ready);
    EXPECT_TRUE(read_image(cache / thumbnail_name(scene, 64, 40)));
}

TEST_F(ThumbnailsTest, one_that_takes_too_long_is_given_up) {
    Thumbnails::Options slow = options();
    slow.frames = 1000000;
    slow.patience = std::chrono::seconds(1);
    Thumbnails all({scene}, slow);
    finish(all);
    EXPECT_EQ(all.state(0), State::failed);
    EXPECT_EQ(cached(), 0u);
}

}  // namespace
}  // namespace weft::editor
