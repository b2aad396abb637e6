// Exports by the program weft, which the whole build makes.
#include "editor/app/export_job.h"

#include "editor/core/scene.test.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

namespace weft::editor {
namespace {

class ExportJobTest : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(std::filesystem::exists(program)) << program << " is not built"; }
    /// Waits for the end; fails after a minute.
    static void wait_for(ExportJob& job) {
        for (int i = 0; i < 6000 && job.running(); ++i) {
            job.update();
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        EXPECT_FALSE(job.running());
    }
    const std::filesystem::path program = std::filesystem::path(WEFT_BINARY_DIR) / "apps" / "cli" / "weft";
    ScratchFolder folder;
};

TEST_F(ExportJobTest, writes_the_run_of_a_scene) {
    const auto file = folder / "cloth.glb";
    auto job = SimulatedExport::start(*small_document(), {.file = file, .frames = 8, .program = program});
    ASSERT_TRUE(job) << job.error().message();
    wait_for(**job);
    EXPECT_EQ((*job)->problem(), "");
    EXPECT_EQ((*job)->done(), 1);
    EXPECT_GT(std::filesystem::file_size(file), 1000u);
}

TEST_F(ExportJobTest, tells_how_far_it_is_in_small_steps) {
    auto job =
        SimulatedExport::start(*small_document(), {.file = folder / "long.glb", .frames = 20000, .program = program});
    ASSERT_TRUE(job);
    while ((*job)->running() && (*job)->done() <= 0) {
        (*job)->update();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_GT((*job)->done(), 0);
    EXPECT_LT((*job)->done(), 0.2f);
}

TEST_F(ExportJobTest, tells_why_it_failed) {
    auto job =
        SimulatedExport::start(*small_document(), {.file = folder / "cloth.xyz", .frames = 2, .program = program});
    ASSERT_TRUE(job);
    wait_for(**job);
    EXPECT_THAT((*job)->problem(), testing::HasSubstr("xyz"));
    EXPECT_FALSE(SimulatedExport::start(*small_document(), {.file = folder / "a.glb", .program = "/no/such/program"}));
}

TEST_F(ExportJobTest, can_be_canceled_and_leaves_nothing_behind) {
    const auto file = folder / "long.glb";
    auto job = SimulatedExport::start(*small_document(), {.file = file, .frames = 100000, .program = program});
    ASSERT_TRUE(job);
    (*job)->update();
    EXPECT_TRUE((*job)->running());
    (*job)->cancel();
    EXPECT_FALSE((*job)->running());
    EXPECT_EQ((*job)->problem(), "canceled");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace weft::editor
