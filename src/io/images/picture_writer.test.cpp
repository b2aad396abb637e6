#include "io/images/picture_writer.h"

#include "io/exports/film_fixtures.test.h"
#include "io/images/pictures.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

namespace weft {
namespace {

using test::pattern_picture;
using test::read_text;
using test::TestFolder;
using test::write_pictures;
using test::write_text;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(PictureWriter, UnknownEndingNamesTheKnownOnes) {
    const TestFolder folder;
    for (const char* name : {"a.jpg", "a", ".png", "a.png.zip", "a.glb"}) {
        const auto made = make_picture_writer(folder / name);
        ASSERT_FALSE(made.ok()) << name;
        EXPECT_EQ(made.error().where, (folder / name).string());
        for (const PictureFormat& format : picture_formats())
            EXPECT_THAT(made.error().what, HasSubstr(std::string(format.ending)));
    }
    EXPECT_TRUE(make_picture_writer(folder / "UPPER.PNG").ok());
    for (const char* name : {"%s.png", "%d_%d.png", "100%.png"})
        EXPECT_THAT(make_picture_writer(folder / name).error().what, HasSubstr("%04d")) << name;
    EXPECT_THAT(make_picture_writer(folder / "%d.mp4").error().what, HasSubstr("in one file"));
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(PictureWriter, APngIsTheLastPicture) {
    const TestFolder folder;
    const auto made = make_picture_writer(folder / "new/a.png");
    ASSERT_TRUE(made.ok() && (*made)->begin({.width = 20, .height = 10}).ok());
    EXPECT_TRUE((*made)->keeps_last_only());
    ASSERT_TRUE((*made)->write(pattern_picture(20, 10, 1)).ok());
    EXPECT_FALSE(std::filesystem::exists(folder / "new/a.png"));
    ASSERT_TRUE((*made)->write(pattern_picture(20, 10, 2)).ok());
    ASSERT_TRUE((*made)->finish().ok());
    ASSERT_TRUE(write_pictures(folder / "alone.png", {pattern_picture(20, 10, 2)}).ok());
    ASSERT_TRUE(write_pictures(folder / "other.png", {pattern_picture(20, 10, 1)}).ok());
    EXPECT_EQ(read_text(folder / "new/a.png"), read_text(folder / "alone.png"));
    EXPECT_NE(read_text(folder / "new/a.png"), read_text(folder / "other.png"));
}

TEST(PictureWriter, ASequenceIsAPngEach) {
    const TestFolder folder;
    const auto made = make_picture_writer(folder / "%03d.png");
    ASSERT_TRUE(made.ok() && (*made)->begin({.width = 8, .height = 8}).ok());
    EXPECT_FALSE((*made)->keeps_last_only());
    EXPECT_THAT(folder.names(), IsEmpty());
    for (int i = 0; i < 3; ++i) ASSERT_TRUE((*made)->write(pattern_picture(8, 8, i)).ok());
    EXPECT_THAT(folder.names(), ElementsAre("000.png", "001.png", "002.png"));
    ASSERT_TRUE(write_pictures(folder / "alone.png", {pattern_picture(8, 8, 1)}).ok());
    EXPECT_EQ(read_text(folder / "001.png"), read_text(folder / "alone.png"));
}

// The header has width, height, and the color type: 2 for red, green, blue or 6 with alpha.
TEST(PictureWriter, APngHasItsSizeAndAlphaWhereThereIsAny) {
    const TestFolder folder;
    Image8 picture = pattern_picture(300, 2, 0);
    ASSERT_TRUE(write_pictures(folder / "opaque.png", {picture}).ok());
    picture.at(1, 1)[3] = 254;
    ASSERT_TRUE(write_pictures(folder / "alpha.png", {picture}).ok());
    const std::string opaque = read_text(folder / "opaque.png"), alpha = read_text(folder / "alpha.png");
    using namespace std::string_literals;
    EXPECT_EQ(opaque.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(opaque.substr(12, 14), "IHDR\0\0\x01\x2c\0\0\0\x02\x08\x02"s);
    EXPECT_EQ(alpha.substr(12, 14), "IHDR\0\0\x01\x2c\0\0\0\x02\x08\x06"s);
    EXPECT_EQ(opaque.substr(opaque.size() - 8, 4), "IEND");
}

TEST(PictureWriter, DestroyedEarlyLeavesWhatWasThere) {
    const TestFolder folder;
    write_text(folder / "a.png", "earlier");
    {
        const auto made = make_picture_writer(folder / "a.png");
        ASSERT_TRUE(made.ok() && (*made)->begin({.width = 8, .height = 8}).ok());
        ASSERT_TRUE((*made)->write(pattern_picture(8, 8, 0)).ok());
    }
    EXPECT_EQ(read_text(folder / "a.png"), "earlier");
    EXPECT_THAT(folder.names(), ElementsAre("a.png"));
    const auto none = make_picture_writer(folder / "b.png");
    ASSERT_TRUE(none.ok() && (*none)->begin({.width = 8, .height = 8}).ok());
    EXPECT_THAT((*none)->finish().error().what, HasSubstr("no image"));
    EXPECT_THAT(folder.names(), ElementsAre("a.png"));
}

TEST(PictureWriter, APictureOfAnotherSizeIsRefused) {
    const TestFolder folder;
    for (const char* name : {"a.png", "%d.png"}) {
        const auto made = make_picture_writer(folder / name);
        ASSERT_TRUE(made.ok() && (*made)->begin({.width = 8, .height = 8}).ok());
        EXPECT_THAT((*made)->write(pattern_picture(8, 6, 0)).error().what, HasSubstr("8x6")) << name;
        Image8 torn = pattern_picture(8, 8, 0);
        torn.rgba.pop_back();
        EXPECT_FALSE((*made)->write(torn).ok()) << name;
    }
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(PictureWriter, APlaceThatCannotBeWrittenIsKnownBeforehand) {
    const TestFolder folder;
    std::filesystem::create_directory(folder / "folder.png");
    write_text(folder / "file", "");
    const auto begun = [&](const std::filesystem::path& path) {
        const auto made = make_picture_writer(path);
        return (*made)->begin({.width = 8, .height = 8});
    };
    EXPECT_THAT(begun(folder / "folder.png").error().what, HasSubstr("it is a folder"));
    EXPECT_THAT(begun(folder / "file/a.png").error().what, HasSubstr("folder cannot be made"));
    EXPECT_THAT(begun("/proc/weft/%d.png").error().message(),
                AllOf(HasSubstr("/proc/weft/0.png"), HasSubstr("folder")));
    EXPECT_THAT(begun("/dev/full/a.png").error().what, HasSubstr("folder cannot be made"));
}

#if !defined(__SANITIZE_THREAD__)  // TSan writes its own file and is killed by the limit
TEST(PictureWriter, AFullDiskIsToldAndLeavesNothing) {
    const TestFolder folder;
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{512, before.rlim_max};
    for (const char* name : {"a.png", "%d.png"}) {
        ::setrlimit(RLIMIT_FSIZE, &small);
        const Result<void> done = write_pictures(folder / name, {pattern_picture(64, 64, 0)});
        ::setrlimit(RLIMIT_FSIZE, &before);
        ASSERT_FALSE(done.ok()) << name;
        EXPECT_THAT(done.error().what, HasSubstr("File too large"));
    }
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(folder.names(), IsEmpty());
}
#endif

}  // namespace
}  // namespace weft
