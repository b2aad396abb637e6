#include "io/files/overwriting.h"

#include "base/temporary_folder.test.h"

#include <gmock/gmock.h>

namespace weft {
namespace {

namespace fs = std::filesystem;

TEST(Overwriting, of_an_input_is_an_error_in_any_spelling) {
    TemporaryFolder folder;
    folder.write("disc.obj", "x");
    folder.write("0007.obj", "x");
    const fs::path root = folder.path();
    const auto count = [&](const fs::path& output) {
        const std::vector<fs::path> outputs{output}, inputs{root / "disc.obj", root / "0007.obj", root / "gone.obj"};
        return overwritten_inputs(outputs, inputs).size();
    };
    EXPECT_EQ(count(root / "disc.obj"), 1u);
    EXPECT_EQ(count(root / "." / "disc.obj"), 1u);
    EXPECT_EQ(count(root / "other.obj"), 0u);
    EXPECT_EQ(count(root / "gone.obj"), 0u);
    EXPECT_EQ(count(root / "%04d.obj"), 1u);
    EXPECT_EQ(count(root / "a%04d.obj"), 0u);
    EXPECT_EQ(count(root / "%04d.ply"), 0u);
}

}  // namespace
}  // namespace weft
