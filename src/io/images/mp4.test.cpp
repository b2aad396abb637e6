// Tests of videos, with programs in place of ffmpeg that fail in every way, and with ffmpeg itself if it is installed.

#include "io/exports/film_fixtures.test.h"
#include "io/images/pictures.test.h"

#include <dirent.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace weft {
namespace {

using test::pattern_picture;
using test::plain_picture;
using test::read_text;
using test::TestFolder;
using test::write_pictures;
using test::write_text;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// While it exists, PATH has this shell script as ffmpeg. It succeeds in the trial run before the video.
class FakeFfmpeg {
  public:
    explicit FakeFfmpeg(const std::string& script) : before_(std::getenv("PATH")) {
        write_text(folder_ / "ffmpeg",
                   "#!/bin/sh\ncase \"$*\" in *' null '*) cat >/dev/null; exit 0 ;; esac\n" + script);
        ::chmod((folder_ / "ffmpeg").c_str(), 0755);
        ::setenv("PATH", (folder_.path().string() + ":" + before_).c_str(), 1);
    }
    FakeFfmpeg(const FakeFfmpeg&) = delete;
    FakeFfmpeg& operator=(const FakeFfmpeg&) = delete;
    ~FakeFfmpeg() { ::setenv("PATH", before_.c_str(), 1); }

  private:
    TestFolder folder_;
    std::string before_;
};

std::size_t open_descriptors() {
    std::size_t count = 0;
    DIR* folder = ::opendir("/proc/self/fd");
    while (::readdir(folder)) ++count;
    ::closedir(folder);
    return count;
}

/// Writes twenty images, more data than a socket holds. In any case no file, process or descriptor must remain.
Error failure(const std::string& script) {
    const TestFolder folder;
    write_text(folder / "film.mp4", "earlier");
    const FakeFfmpeg fake(script);
    const std::size_t descriptors = open_descriptors();
    const Result<void> done =
        write_pictures(folder / "film.mp4", std::vector<Image8>(20, pattern_picture(320, 180, 0)));
    EXPECT_FALSE(done.ok()) << script;
    EXPECT_EQ(read_text(folder / "film.mp4"), "earlier") << script;
    EXPECT_THAT(folder.names(), ElementsAre("film.mp4")) << script;
    EXPECT_EQ(open_descriptors(), descriptors) << script;
    errno = 0;
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << script;
    EXPECT_EQ(errno, ECHILD) << script;
    if (done.ok()) return {};
    EXPECT_EQ(done.error().where, (folder / "film.mp4").string());
    EXPECT_EQ(done.error().fault, Fault::machine);
    return done.error();
}

TEST(Film, WithoutFfmpegSaysWhatToInstallBeforeAnythingRuns) {
    const TestFolder folder;
    const std::string before = std::getenv("PATH");
    ::setenv("PATH", folder.path().c_str(), 1);
    const auto made = make_picture_writer(folder / "film.mp4");
    const Result<void> begun = (*made)->begin({.width = 8, .height = 8});
    ::setenv("PATH", before.c_str(), 1);
    ASSERT_FALSE(begun.ok());
    EXPECT_THAT(begun.error().what, AllOf(HasSubstr("install ffmpeg"), HasSubstr("Debian: ffmpeg")));
    EXPECT_EQ(begun.error().fault, Fault::machine);
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Film, TheLastThatFfmpegSaysIsInTheError) {
    EXPECT_THAT(failure("head -c 500000 >/dev/null; echo first >&2; echo 'disk on fire' >&2; exit 3").what,
                AllOf(HasSubstr("ended with status 3"), HasSubstr("first disk on fire")));
    EXPECT_THAT(failure("cat >/dev/null; echo at the end >&2; exit 1").what,
                AllOf(HasSubstr("status 1"), HasSubstr("at the end")));
    EXPECT_THAT(failure("head -c 500000 >/dev/null; kill -11 $$").what, HasSubstr("signal 11"));
    EXPECT_THAT(failure("exec <&-; i=0; while [ $i -lt 20000 ]; do echo line $i >&2; i=$((i+1)); done; exit 1").what,
                AllOf(HasSubstr("line 19999"), Not(HasSubstr("line 19000"))));
}

// Labels: no-asan
TEST(Film, FfmpegThatReadsNothingOrEndsAtOnceIsAnError) {
    EXPECT_THAT(failure("exit 0").what, HasSubstr("before it had read all of its input"));
    EXPECT_THAT(failure("exec <&-; sleep 0.2; exit 7").what, HasSubstr("status 7"));
    EXPECT_THAT(failure("cat >/dev/null; exit 0").what, HasSubstr("has not written the complete video"));
    EXPECT_THAT(failure("cat >/dev/null; echo lost >&2; printf '\\0\\0\\0\\011moov' >&3").what,
                HasSubstr("video: lost"));
}

// Labels: no-asan
TEST(Film, FfmpegThatHangsUpAndStaysIsEnded) {
    EXPECT_THAT(failure("echo bye >&2; exec <&-; exec sleep 1000").what,
                AllOf(HasSubstr("stopped reading its input"), HasSubstr("bye")));
}

// Labels: no-asan
TEST(Film, FfmpegThatTalksMuchDoesNotStopTheFilm) {
    const TestFolder folder;
    // More than a pipe holds, before it reads.
    const FakeFfmpeg fake("head -c 300000 /dev/zero | tr '\\0' x >&2; cat >/dev/null; printf '\\0\\0\\0\\010moov' >&3");
    const std::vector<Image8> pictures(20, pattern_picture(320, 180, 0));
    const Result<void> done = write_pictures(folder / "film.mp4", pictures);
    ASSERT_TRUE(done.ok()) << done.error().message();
    using namespace std::string_literals;
    EXPECT_EQ(read_text(folder / "film.mp4"), "\0\0\0\x08moov"s);
}

// Labels: no-asan
TEST(Film, FfmpegThatCannotDoItIsFoundOutBeforehand) {
    const TestFolder folder;
    const FakeFfmpeg fake("");
    write_text(folder / "ffmpeg", "#!/bin/sh\necho \"Unknown encoder 'libx264'\" >&2\nexit 1\n");
    ::chmod((folder / "ffmpeg").c_str(), 0755);
    const std::string before = std::getenv("PATH");
    ::setenv("PATH", (folder.path().string() + ":" + before).c_str(), 1);
    const auto made = make_picture_writer(folder / "film.mp4");
    const Result<void> begun = (*made)->begin({.width = 320, .height = 180});
    ::setenv("PATH", before.c_str(), 1);
    ASSERT_FALSE(begun.ok());
    EXPECT_THAT(begun.error().what, HasSubstr("Unknown encoder"));
    EXPECT_THAT(folder.names(), ElementsAre("ffmpeg"));
}

TEST(Film, DestroyedEarlyEndsFfmpegAndLeavesNothing) {
    const TestFolder folder;
    const FakeFfmpeg fake("echo $$ >'" + (folder / "pid").string() + "'; exec sleep 1000");
    {
        const auto made = make_picture_writer(folder / "film.mp4");
        ASSERT_TRUE(made.ok() && (*made)->begin({.width = 8, .height = 8}).ok());
        while (read_text(folder / "pid").find('\n') == std::string::npos) ::usleep(1000);
        ASSERT_TRUE((*made)->write(pattern_picture(8, 8, 0)).ok());
    }
    const int process = std::stoi(read_text(folder / "pid"));
    EXPECT_EQ(::kill(process, 0), -1);
    EXPECT_THAT(folder.names(), ElementsAre("pid"));
}

TEST(Film, TransparencyAndOddSizesAreRefused) {
    const TestFolder folder;
    const auto begun = [&](const PictureInfo& info) {
        const auto made = make_picture_writer(folder / "new/film.mp4");
        return (*made)->begin(info);
    };
    EXPECT_THAT(begun({.width = 8, .height = 8, .transparent = true}).error().what, HasSubstr("no transparency"));
    EXPECT_THAT(begun({.width = 641, .height = 361}).error().what, AllOf(HasSubstr("641x361"), HasSubstr("642x362")));
    EXPECT_THAT(begun({.width = 642, .height = 361}).error().what, HasSubstr("642x362"));
    EXPECT_THAT(folder.names(), IsEmpty());
}

class RealFilm : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    }
    static std::string said(const std::string& command) {
        std::string text;
        FILE* pipe = ::popen(command.c_str(), "r");
        char block[4096];
        while (const std::size_t count = std::fread(block, 1, sizeof block, pipe)) text.append(block, count);
        ::pclose(pipe);
        return text;
    }
    TestFolder folder_;
};

TEST_F(RealFilm, HasEveryPictureItsSizeRateAndColors) {
    std::vector<Image8> pictures(7, plain_picture(64, 36, 200, 40, 90));
    pictures.back() = plain_picture(64, 36, 20, 220, 60);
    const std::string film = (folder_ / "film.mp4").string();
    const Result<void> done = write_pictures(film, pictures, 25);
    ASSERT_TRUE(done.ok()) << done.error().message();
    const std::string streams = said("ffprobe -v error -count_frames -show_streams '" + film + "'");
    for (const char* line : {"codec_name=h264", "width=64", "height=36", "pix_fmt=yuv420p", "nb_read_frames=7",
                             "r_frame_rate=25/1", "color_space=bt709", "color_range=tv", "color_primaries=bt709"})
        EXPECT_THAT(streams, HasSubstr(std::string(line) + "\n"));
    const std::string file = read_text(film);
    EXPECT_LT(file.find("moov"), file.find("mdat")) << "the index comes first";

    const std::string pixels = said("ffmpeg -v error -i '" + film + "' -pix_fmt rgb24 -f rawvideo -");
    ASSERT_EQ(pixels.size(), 7u * 64 * 36 * 3);
    const auto near = [&](std::size_t at, int red, int green, int blue) {
        const int wanted[] = {red, green, blue};
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(static_cast<unsigned char>(pixels[at + i]), wanted[i], 4) << at;
    };
    near(0, 200, 40, 90);
    near(pixels.size() - 3, 20, 220, 60);
}

TEST_F(RealFilm, IsTheSameFileForTheSamePictures) {
    std::vector<Image8> pictures;
    for (int i = 0; i < 5; ++i) pictures.push_back(pattern_picture(64, 36, i));
    ASSERT_TRUE(write_pictures(folder_ / "a.mp4", pictures).ok());
    ASSERT_TRUE(write_pictures(folder_ / "b.mp4", pictures).ok());
    EXPECT_EQ(read_text(folder_ / "a.mp4"), read_text(folder_ / "b.mp4"));
}

TEST_F(RealFilm, TakesNamesThatLookLikeSomethingElse) {
    ASSERT_TRUE(write_pictures(folder_ / "-y http:%20.d/-a b'\"$x.mp4", {pattern_picture(8, 8, 0)}).ok());
    EXPECT_GT(std::filesystem::file_size(folder_ / "-y http:%20.d/-a b'\"$x.mp4"), 100u);
}

#if !defined(__SANITIZE_THREAD__)  // TSan writes its own file and is killed by the limit
TEST_F(RealFilm, AFullDiskIsToldAndLeavesNothing) {
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t limit : {1000u, 60000u}) {
        const rlimit small{limit, before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
        std::vector<Image8> pictures;
        for (int i = 0; i < 10; ++i) pictures.push_back(pattern_picture(128, 128, i));
        const Result<void> done = write_pictures(folder_ / "film.mp4", pictures);
        ::setrlimit(RLIMIT_FSIZE, &before);
        ASSERT_FALSE(done.ok());
        EXPECT_THAT(done.error().what, HasSubstr("File too large"));
        EXPECT_THAT(folder_.names(), IsEmpty());
    }
    std::signal(SIGXFSZ, handler);
}
#endif

}  // namespace
}  // namespace weft
