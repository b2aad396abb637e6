#include "base/cache_file.h"
#include "base/temporary_folder.test.h"
#include "gpu/test_device.h"

#include <filesystem>

namespace weft::gpu {
namespace {

namespace fs = std::filesystem;

class PipelineCache : public OnDevice {
  protected:
    // Opens a device with that file, makes a pipeline and closes it.
    void run(const fs::path& file) {
        open({.pipeline_cache = file});
        if (!device) return;
        auto pipeline = Pipeline::create(*device, test_shader("arithmetic"), std::array{64u});
        EXPECT_TRUE(pipeline.ok());
        pipeline = Error{};
        device.reset();
    }
};

TEST_F(PipelineCache, is_written_and_used_again) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "weft" / "pipelines";
    run(file);
    const std::vector<char> first = read_cache_file(file, pipeline_cache_format);
    ASSERT_GE(first.size(), 32u) << "at least the head that Vulkan prescribes";
    run(file);
    EXPECT_EQ(read_cache_file(file, pipeline_cache_format).size(), first.size());
}

TEST_F(PipelineCache, a_damaged_one_is_replaced) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "pipelines";
    run(file);
    const std::vector<char> good = read_bytes(file);
    ASSERT_FALSE(good.empty());
    std::vector<char> flipped = good;
    flipped[flipped.size() / 2] = static_cast<char>(~flipped[flipped.size() / 2]);
    for (const std::vector<char>& bad : {std::vector<char>(good.begin(), good.begin() + 20), flipped,
                                         std::vector<char>(5000, 'x'), std::vector<char>{}}) {
        write_bytes(file, bad);
        run(file);
        EXPECT_EQ(read_cache_file(file, pipeline_cache_format).size() + 24, good.size()) << bad.size();
    }
}

// The file is intact, but the data names another driver or none, so the driver ignores it.
TEST_F(PipelineCache, one_of_another_driver_is_survived) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "pipelines";
    run(file);
    std::vector<char> other = read_cache_file(file, pipeline_cache_format);
    ASSERT_GE(other.size(), 32u);
    for (std::size_t at = 16; at < 32; ++at) other[at] = static_cast<char>(~other[at]);  // the driver's id
    ASSERT_TRUE(write_cache_file(file, pipeline_cache_format, other));
    run(file);
    EXPECT_NE(read_cache_file(file, pipeline_cache_format), other);
}

TEST_F(PipelineCache, one_that_cannot_be_written_is_no_error) {
    const TemporaryFolder folder;
    write_bytes(folder.path() / "file", std::vector<char>(3, 'x'));
    run(folder.path() / "file" / "pipelines");
    fs::create_directories(folder.path() / "taken" / "full");
    run(folder.path() / "taken");
    EXPECT_EQ(count_files(folder.path()), 2u);
}

}  // namespace
}  // namespace weft::gpu
