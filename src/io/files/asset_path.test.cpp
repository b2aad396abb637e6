#include "base/temporary_folder.test.h"
#include "io/meshes/mesh_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

namespace weft {
namespace {

class FindAsset : public testing::Test {
  protected:
    FindAsset() {
        if (const char* old = std::getenv("WEFT_ASSETS")) old_ = old;
        ::unsetenv("WEFT_ASSETS");
    }
    ~FindAsset() override {
        if (old_)
            ::setenv("WEFT_ASSETS", old_->c_str(), 1);
        else
            ::unsetenv("WEFT_ASSETS");
    }
    void search(const std::string& value) { ::setenv("WEFT_ASSETS", value.c_str(), 1); }

    TemporaryFolder folder_;
    std::optional<std::string> old_;
};

TEST_F(FindAsset, BesideTheSceneComesFirst) {
    const auto beside = folder_.write("scenes/a.obj", "1");
    folder_.write("assets/a.obj", "2");
    search((folder_.path() / "assets").string());
    const auto found = find_asset("a.obj", folder_.path() / "scenes");
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(*found, beside);
}

TEST_F(FindAsset, ThenTheFoldersOfTheEnvironmentInOrder) {
    const auto first = folder_.write("one/sub/a.obj", "1");
    folder_.write("two/sub/a.obj", "2");
    const auto only_second = folder_.write("two/b.obj", "2");
    search(":" + (folder_.path() / "one").string() + "::" + (folder_.path() / "two").string() + ":");
    EXPECT_EQ(*find_asset("sub/a.obj", folder_.path() / "scenes"), first);
    EXPECT_EQ(*find_asset("b.obj", folder_.path() / "scenes"), only_second);
}

TEST_F(FindAsset, ThenTheFoldersOfTheSystem) {
    if (!std::filesystem::exists("/usr/share/glmark2/models/bunny.obj")) GTEST_SKIP() << "needs glmark2-data";
    EXPECT_EQ(*find_asset("bunny.obj", folder_.path()), "/usr/share/glmark2/models/bunny.obj");
}

TEST_F(FindAsset, AnAbsolutePathIsTakenAsItIs) {
    const auto file = folder_.write("a.obj", "1");
    EXPECT_EQ(*find_asset(file.string(), "/nowhere"), file);
    const auto missing = find_asset("/nowhere/a.obj", folder_.path());
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().message(), "/nowhere/a.obj: not found");
}

TEST_F(FindAsset, TheErrorListsEveryPlaceInOrder) {
    search("/assets/one:/assets/two");
    const auto missing = find_asset("no-such-mesh.obj", folder_.path());
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().where, "no-such-mesh.obj");
    const std::string begin = "not found; tried " + (folder_.path() / "no-such-mesh.obj").string() +
                              ", /assets/one/no-such-mesh.obj, /assets/two/no-such-mesh.obj, and the folders of "
                              "installed models; put it beside the scene";
    EXPECT_TRUE(missing.error().what.starts_with(begin)) << missing.error().what;
}

TEST_F(FindAsset, AFolderIsNoAsset) {
    folder_.write("mesh.obj/inner", "1");
    EXPECT_FALSE(find_asset("mesh.obj", folder_.path()).ok());
    EXPECT_FALSE(find_asset("", folder_.path()).ok());
}

}  // namespace
}  // namespace weft
