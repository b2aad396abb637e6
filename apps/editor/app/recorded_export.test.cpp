// Exports of recorded frames.
#include "editor/app/recorded_export.h"

#include "editor/core/scene.test.h"
#include "io/images/image_file.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

namespace weft::editor {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

class RecordedExportTest : public testing::Test {
  protected:
    /// Positions of all cloths in the present frame of the simulator, one after another.
    std::vector<float> positions() {
        std::vector<float> all;
        simulator->run([&](Stage& stage) {
            for (const ClothFrame& cloth : stage.world().world().frame().cloths)
                for (const Vec3& p : cloth.render_mesh().positions) all.insert(all.end(), {p.x, p.y, p.z});
        });
        simulator->finish();
        return all;
    }
    void advance(std::uint64_t frames) {
        for (std::uint64_t i = 0; i < frames; ++i) {
            simulator->post(Advance{});
            frames_.push_back(positions());
        }
    }
    /// The run of a user: pulls, moves the hand, changes the fabric, lets go.
    void work() {
        frames_.push_back(positions());
        advance(3);
        simulator->post(Grab{"sheet", {40, {0.25f, 0.25f, 0.5f}}, {0.3f, 1, 0.2f}, 5});
        advance(2);
        simulator->post(MoveGrab{{0.1f, 1.5f, 0}});
        simulator->post(change_of("/cloths/0/fabric/density", 0.3));
        advance(2);
        simulator->post(Release{});
        advance(3);
    }
    std::string write(RecordedExportOptions options) {
        RecordedExport job(simulator, std::move(options));
        for (int i = 0; i < 6000 && job.running(); ++i) {
            job.update();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        EXPECT_FALSE(job.running());
        EXPECT_TRUE(!job.problem().empty() || job.done() == 1);
        return job.problem();
    }
    /// The samples of a point cache.
    static std::vector<std::vector<float>> samples_of(const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        std::int32_t points = 0, count = 0;
        std::vector<std::vector<float>> samples;
        if (bytes.size() < 32) return samples;
        std::memcpy(&points, bytes.data() + 16, 4);
        std::memcpy(&count, bytes.data() + 28, 4);
        for (std::int32_t i = 0; i < count; ++i) {
            std::vector<float> one(static_cast<std::size_t>(points) * 3);
            std::memcpy(one.data(), bytes.data() + 32 + static_cast<std::size_t>(i) * one.size() * 4, one.size() * 4);
            samples.push_back(std::move(one));
        }
        return samples;
    }

    ScratchFolder folder;
    std::shared_ptr<Simulator> simulator = std::make_shared<Simulator>(open_small(), Simulator::Hooks{});
    std::vector<std::vector<float>> frames_;
};

TEST_F(RecordedExportTest, writes_the_positions_of_the_recorded_frames) {
    work();
    EXPECT_EQ(write({.file = folder / "run.pc2", .frames = {0, 10}}), "");
    EXPECT_THAT(samples_of(folder / "run.pc2"), ElementsAreArray(frames_));
}

TEST_F(RecordedExportTest, writes_a_part_of_them_also_after_a_jump_back) {
    work();
    simulator->post(Seek{2});
    EXPECT_EQ(write({.file = folder / "run.pc2", .frames = {4, 9}}), "");
    EXPECT_THAT(samples_of(folder / "run.pc2"), ElementsAreArray(frames_.begin() + 4, frames_.begin() + 10));
}

TEST_F(RecordedExportTest, has_the_cuts) {
    frames_.push_back(positions());
    advance(2);
    simulator->post(Cut{"sheet", {{-0.6f, 0.5f, 0.01f}, {0.1f, 0.5f, 0.01f}}});
    advance(3);
    ASSERT_GT(frames_.back().size(), frames_.front().size());
    EXPECT_EQ(write({.file = folder / "run.pc2", .frames = {0, 5}}), "");
    const auto samples = samples_of(folder / "run.pc2");
    ASSERT_EQ(samples.size(), 6u);
    EXPECT_EQ(samples.back(), frames_.back());
}

TEST_F(RecordedExportTest, draws_the_last_frame) {
    work();
    const Camera camera{.position = {0, 1, 3}, .target = {0, 0.5f, 0}};
    EXPECT_EQ(
        write(
            {.file = folder / "last.png", .frames = {0, 10}, .images = {.width = 64, .height = 48, .camera = camera}}),
        "");
    const auto image = read_image(folder / "last.png");
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->width, 64u);
    EXPECT_EQ(image->height, 48u);
}

TEST_F(RecordedExportTest, draws_overlays) {
    work();
    const Camera camera{.position = {0, 1, 3}, .target = {0, 0.5f, 0}};
    std::vector<std::vector<std::uint8_t>> images;
    for (const std::vector<std::string>& overlays : {std::vector<std::string>{}, {"wireframe"}}) {
        const auto file = folder / ("with" + std::to_string(images.size()) + ".png");
        EXPECT_EQ(write({.file = file,
                         .frames = {0, 10},
                         .images = {.width = 64, .height = 48, .camera = camera, .overlays = overlays}}),
                  "");
        const auto image = read_image(file);
        ASSERT_TRUE(image) << image.error().message();
        images.push_back(image->rgba);
    }
    EXPECT_NE(images[0], images[1]);
}

TEST_F(RecordedExportTest, tells_what_is_missing_and_leaves_nothing_behind) {
    advance(3);
    EXPECT_THAT(write({.file = folder / "run.glb", .frames = {0, 9}}), HasSubstr("frame 4: is not recorded"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_THAT(write({.file = folder / "run.xyz", .frames = {0, 3}}), HasSubstr("xyz"));
}

TEST_F(RecordedExportTest, can_be_canceled) {
    work();
    {
        RecordedExport job(simulator, {.file = folder / "run.glb", .frames = {0, 10}});
        job.cancel();
        while (job.running()) job.update();
        EXPECT_THAT(job.problem(), testing::AnyOf("canceled", ""));
        if (job.problem().empty()) return;  // it was faster
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(RecordedExportTest, takes_all_frames_that_belong_to_the_present) {
    work();
    EXPECT_EQ(frames_to_export(*simulator->newest()), (FrameRange{0, 10}));
    simulator->post(Seek{2});
    simulator->finish();
    EXPECT_EQ(frames_to_export(*simulator->newest()), (FrameRange{0, 10}));
    simulator->post(change_of("/cloths/0/fabric/density", 0.5));
    simulator->post(Advance{1});
    simulator->finish();
    EXPECT_EQ(frames_to_export(*simulator->newest()), (FrameRange{0, 3}));
}

}  // namespace
}  // namespace weft::editor
