// Every scene of the library opens without a warning and runs its first frames without a report.
#include "files/open_scene.h"
#include "solver/measures/statistics.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace weft {
namespace {

TEST(Scenes, all_run) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(WEFT_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".json") continue;
        SCOPED_TRACE(entry.path().filename().string());
        auto session = open_scene(entry.path(), {});
        ASSERT_TRUE(session.ok()) << session.error().message();
        EXPECT_TRUE(session->notes().empty()) << session->notes().front();
        EXPECT_FALSE(session->scene().name.empty());
        for (int frame = 0; frame < 8; ++frame) session->step();
        const Frame& frame = session->world().frame();
        EXPECT_EQ(frame.reports, report_none);
        EXPECT_TRUE(all_finite(frame));
        EXPECT_GT(max_speed(frame), 0.01) << "something moves";
        EXPECT_LT(measure_strain(frame).stretch.mean, 0.05);
        EXPECT_LT(measure_penetration(frame, session->world().colliders()).max, 0.01);
        ++scenes;
    }
    EXPECT_GE(scenes, 9);
}

}  // namespace
}  // namespace weft
