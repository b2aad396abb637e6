#include "base/cache_file.h"

#include "base/temporary_folder.test.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace weft {
namespace {

constexpr CacheFormat cache_format = "weft-xy1";

namespace fs = std::filesystem;

TEST(CacheFile, gives_back_what_was_written_and_makes_its_folder) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a" / "b" / "cache";
    for (const std::size_t size : {0, 1, 4, 1001}) {
        std::vector<char> data(size);
        for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<char>(i * 7);
        EXPECT_TRUE(write_cache_file(file, cache_format, data));
        EXPECT_EQ(read_cache_file(file, cache_format), data);
        EXPECT_EQ(count_files(file.parent_path()), 1u) << "nothing is left beside it";
    }
}

TEST(CacheFile, what_is_not_as_it_was_written_is_nothing) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "cache";
    const std::vector<char> data(101, 'x');
    ASSERT_TRUE(write_cache_file(file, cache_format, data));
    const std::vector<char> good = read_bytes(file);
    for (std::size_t size = 0; size < good.size(); ++size) {
        write_bytes(file, std::span(good).first(size));
        EXPECT_TRUE(read_cache_file(file, cache_format).empty()) << size;
    }
    for (std::size_t at = 0; at < good.size(); ++at) {
        std::vector<char> bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 16);
        write_bytes(file, bad);
        EXPECT_TRUE(read_cache_file(file, cache_format).empty()) << at;
    }
    std::vector<char> longer = good;
    longer.push_back(0);
    write_bytes(file, longer);
    EXPECT_TRUE(read_cache_file(file, cache_format).empty());
    write_bytes(file, good);
    EXPECT_TRUE(read_cache_file(file, "weft-xy2").empty()) << "another format";
    EXPECT_EQ(read_cache_file(file, cache_format), data);
    EXPECT_TRUE(read_cache_file(folder.path() / "none", cache_format).empty());
    EXPECT_TRUE(read_cache_file(folder.path(), cache_format).empty()) << "a folder";
}

TEST(CacheFile, what_cannot_be_written_leaves_nothing_behind) {
    const TemporaryFolder folder;
    const std::vector<char> data(10, 'x');
    fs::create_directories(folder.path() / "taken" / "full");
    EXPECT_FALSE(write_cache_file(folder.path() / "taken", cache_format, data)) << "a folder stands there";
    EXPECT_EQ(count_files(folder.path()), 1u);
    write_bytes(folder.path() / "file", data);
    EXPECT_FALSE(write_cache_file(folder.path() / "file" / "cache", cache_format, data)) << "its folder is a file";
    EXPECT_EQ(count_files(folder.path()), 2u);
}

// Sets a variable of the environment for one test.
class Variable {
  public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before, was_set_ = true;
        value ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    ~Variable() { was_set_ ? ::setenv(name_, before_.c_str(), 1) : ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::string before_;
    bool was_set_ = false;
};

TEST(CacheFile, folder_follows_the_environment) {
    const Variable home("HOME", "/home/someone"), xdg("XDG_CACHE_HOME", nullptr), own("WEFT_CACHE", nullptr);
    EXPECT_EQ(cache_folder(), "/home/someone/.cache/weft");
    const Variable with_xdg("XDG_CACHE_HOME", "/elsewhere");
    EXPECT_EQ(cache_folder(), "/elsewhere/weft");
    const Variable with_own("WEFT_CACHE", "/mine");
    EXPECT_EQ(cache_folder(), "/mine");
    const Variable off("WEFT_CACHE", "");
    EXPECT_EQ(cache_folder(), "");
}

}  // namespace
}  // namespace weft
