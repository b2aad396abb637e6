#include "io/files/atomic_file.h"

#include "io/exports/film_fixtures.test.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <optional>

namespace weft {
namespace {

using test::read_text;
using test::TestFolder;
using test::write_text;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// While it exists, writing more than `bytes` to a file fails, as on a full disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);
};

/// The user root can write to every folder. A test that runs as root switches to the unprivileged user 65534.
class WithoutPrivileges {
  public:
    WithoutPrivileges() : user_(::geteuid()) {
        if (user_ == 0) dropped_ = ::seteuid(65534) == 0;
    }
    WithoutPrivileges(const WithoutPrivileges&) = delete;
    WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;
    ~WithoutPrivileges() {
        if (dropped_ && ::seteuid(user_) != 0) std::abort();
    }

  private:
    uid_t user_;
    bool dropped_ = false;
};

TEST(AtomicFile, AppearsWholeOnCommit) {
    const TestFolder folder;
    Result<AtomicFile> file = AtomicFile::create(folder / "a.txt");
    ASSERT_TRUE(file.ok());
    const std::string large(3 << 20, 'x');  // larger than the buffer
    ASSERT_TRUE(file->write("one ").ok());
    ASSERT_TRUE(file->write(large).ok());
    ASSERT_TRUE(file->write(" two").ok());
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
    ASSERT_TRUE(file->commit().ok());
    EXPECT_EQ(read_text(folder / "a.txt"), "one " + large + " two");
    EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, WithoutCommitLeavesNothingAndKeepsTheEarlierFile) {
    const TestFolder folder;
    write_text(folder / "a.txt", "earlier");
    {
        Result<AtomicFile> file = AtomicFile::create(folder / "a.txt");
        ASSERT_TRUE(file.ok());
        ASSERT_TRUE(file->write("later").ok());
        AtomicFile moved = *std::move(file);
        EXPECT_EQ(folder.names().size(), 2u);
    }
    EXPECT_EQ(read_text(folder / "a.txt"), "earlier");
    EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, TwoOnOneNameDoNotMeet) {
    const TestFolder folder;
    Result<AtomicFile> first = AtomicFile::create(folder / "a.txt");
    Result<AtomicFile> second = AtomicFile::create(folder / "a.txt");
    ASSERT_TRUE(first.ok() && second.ok());
    ASSERT_TRUE(first->write("first").ok());
    ASSERT_TRUE(second->write("second").ok());
    ASSERT_TRUE(second->commit().ok());
    EXPECT_EQ(read_text(folder / "a.txt"), "second");
    ASSERT_TRUE(first->commit().ok());
    EXPECT_EQ(read_text(folder / "a.txt"), "first");
    EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, FullDiskIsNamedAndLeavesTheEarlierFile) {
    const TestFolder folder;
    write_text(folder / "a.txt", "earlier");
    std::optional<Error> error;
    {
        const FileSizeLimit limit(4096);
        Result<AtomicFile> file = AtomicFile::create(folder / "a.txt");
        ASSERT_TRUE(file.ok());
        ASSERT_TRUE(file->write(std::string(100000, 'x')).ok());  // still in the buffer
        const Result<void> committed = file->commit();
        ASSERT_FALSE(committed.ok());
        error = committed.error();
    }
    EXPECT_EQ(error->where, (folder / "a.txt").string());
    EXPECT_THAT(error->what, HasSubstr("File too large"));
    EXPECT_EQ(read_text(folder / "a.txt"), "earlier");
    EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, ADeviceThatIsFullSaysSo) {
    BufferedFile full(::open("/dev/full", O_WRONLY), "/dev/full");
    ASSERT_TRUE(full.write(std::as_bytes(std::span("x"))).ok());
    const Result<void> closed = full.sync_and_close();
    ASSERT_FALSE(closed.ok());
    EXPECT_EQ(closed.error().message(), "/dev/full: cannot be written: No space left on device");
}

TEST(AtomicFile, RefusesFoldersThatCannotBeWritten) {
    const TestFolder folder;
    ASSERT_EQ(::chmod(folder.path().c_str(), 0555), 0);
    {
        const WithoutPrivileges nobody;
        const Result<AtomicFile> file = AtomicFile::create(folder / "a.txt");
        ASSERT_FALSE(file.ok());
        EXPECT_EQ(file.error().where, (folder / "a.txt").string());
        EXPECT_EQ(file.error().what, "cannot be written: Permission denied");
    }
    ASSERT_EQ(::chmod(folder.path().c_str(), 0755), 0);
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, RefusesAFolderADeviceAndAMissingFolder) {
    const TestFolder folder;
    EXPECT_THAT(AtomicFile::create(folder.path()).error().what, HasSubstr("it is a folder"));
    EXPECT_THAT(AtomicFile::create("/dev/null").error().what, HasSubstr("not a regular file"));
    EXPECT_THAT(AtomicFile::create(folder / "none/a.txt").error().what, HasSubstr("No such file or directory"));
}

TEST(AtomicFile, WritesThroughALinkAndKeepsIt) {
    const TestFolder folder;
    write_text(folder / "real.txt", "earlier");
    std::filesystem::create_symlink("real.txt", folder / "link.txt");
    Result<AtomicFile> file = AtomicFile::create(folder / "link.txt");
    ASSERT_TRUE(file.ok() && file->write("later").ok() && file->commit().ok());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
    EXPECT_EQ(read_text(folder / "real.txt"), "later");
}

TEST(BufferedFile, NamelessIsNeverSeenAndMovesWhole) {
    const TestFolder folder;
    Result<BufferedFile> nameless = BufferedFile::open_nameless(folder.path(), "film.glb");
    ASSERT_TRUE(nameless.ok());
    EXPECT_THAT(folder.names(), IsEmpty());
    std::string content;
    for (int i = 0; i < 400000; ++i) content += std::to_string(i);
    ASSERT_TRUE(nameless->write(std::as_bytes(std::span(content))).ok());
    EXPECT_EQ(nameless->size(), content.size());
    Result<AtomicFile> file = AtomicFile::create(folder / "copy");
    ASSERT_TRUE(file.ok() && nameless->move_to(file->content()).ok() && file->commit().ok());
    EXPECT_EQ(read_text(folder / "copy"), content);
}

TEST(BufferedFile, TakesFromTheFrontAndFreesWhatItTook) {
    const TestFolder folder;
    Result<BufferedFile> opened = BufferedFile::open_nameless(folder.path(), "film.glb");
    ASSERT_TRUE(opened.ok());
    BufferedFile file = *std::move(opened);
    std::string content;
    for (int i = 0; content.size() < (std::size_t{9} << 20); ++i) content += std::to_string(i);
    ASSERT_TRUE(file.write(std::as_bytes(std::span(content))).ok() && file.flush().ok());
    const auto blocks = [&] {
        struct stat status {};
        EXPECT_EQ(::fstat(file.descriptor(), &status), 0);
        return status.st_blocks;
    };
    const auto all = blocks();
    // Pieces that end within a block.
    std::string piece(700001, ' '), taken;
    for (int i = 0; i < 9; ++i) {
        ASSERT_TRUE(file.take(std::as_writable_bytes(std::span(piece))).ok());
        taken += piece;
    }
    EXPECT_EQ(taken, content.substr(0, taken.size()));
    const bool has_holes = ::fallocate(file.descriptor(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, 4096) == 0;
    if (has_holes) {
        EXPECT_LT(blocks(), all / 2);
    }

    BufferedFile moved = std::move(file);
    Result<AtomicFile> rest = AtomicFile::create(folder / "rest");
    ASSERT_TRUE(rest.ok() && moved.move_to(rest->content()).ok() && rest->commit().ok());
    EXPECT_EQ(read_text(folder / "rest"), content.substr(taken.size()));
    const Result<void> past_the_end = moved.take(std::as_writable_bytes(std::span(piece)));
    ASSERT_FALSE(past_the_end.ok());
    EXPECT_THAT(past_the_end.error().message(), HasSubstr("film.glb: cannot be read back"));
}

}  // namespace
}  // namespace weft
