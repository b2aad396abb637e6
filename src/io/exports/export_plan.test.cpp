#include "io/exports/export_plan.h"

#include "io/exports/torn_film.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

using test::Cloth;
using test::export_film;
using test::Instant;
using test::make_cloth;
using test::TestFolder;
using test::TornFilm;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::uint64_t mib = std::uint64_t{1} << 20;

std::optional<FreeSpace> endless(const std::filesystem::path&) {
    return FreeSpace{1, ~std::uint64_t{0}};
}
std::optional<FreeSpace> ten_mib(const std::filesystem::path&) {
    return FreeSpace{1, 10 * mib};
}
std::optional<FreeSpace> ten_mib_a_folder(const std::filesystem::path& folder) {
    return FreeSpace{std::hash<std::string>{}(folder.string()), 10 * mib};
}
std::optional<FreeSpace> unknown(const std::filesystem::path&) {
    return std::nullopt;
}

class Plan : public testing::Test {
  protected:
    Result<std::vector<ExportEstimate>> plan(const std::vector<std::string>& names, std::uint64_t frames,
                                             FreeSpaceOf free_space_of) {
        std::vector<std::unique_ptr<Exporter>> exporters;
        for (const std::string& name : names) {
            auto made = make_exporter(folder_ / name);
            EXPECT_TRUE(made.ok()) << name;
            exporters.push_back(*std::move(made));
        }
        const Instant start(cloths_, 0, 0);
        return plan_exports(exporters, {"waves", 60, frames}, start.frame(), free_space_of);
    }
    std::string problem(const std::vector<std::string>& names, std::uint64_t frames, FreeSpaceOf free_space_of) {
        const auto planned = plan(names, frames, free_space_of);
        return planned ? "none" : planned.error().message();
    }

    TestFolder folder_;
    // All kinds of vertex data, and more vertices than 16-bit indices allow.
    std::vector<Cloth> cloths_ = {make_cloth("large", 260, 0), make_cloth("colored", 40, 1, true)};
};

TEST_F(Plan, EstimatesAreALittleMoreThanWhatIsWritten) {
    cloths_.front() = make_cloth("smaller", 120, 0);
    cloths_.push_back(make_cloth("bare", 30, 0));
    cloths_.back().mesh.uvs.clear();
    for (const ExportFormat& format : export_formats()) {
        for (const std::uint64_t frames : {1u, 2u, 9u}) {
            const std::string name = "a" + std::string(format.ending);
            const auto planned = plan({name}, frames, endless);
            ASSERT_TRUE(planned.ok());
            ASSERT_TRUE(export_film(folder_ / name, cloths_, frames).ok());
            double written = 0;
            for (const auto& file : planned->front().files) {
                written += static_cast<double>(std::filesystem::file_size(file));
            }
            const auto estimated = static_cast<double>(planned->front().bytes);
            EXPECT_GE(estimated, written) << name << ", " << frames << " frames";
            EXPECT_LE(estimated, 1.25 * written) << name << ", " << frames << " frames";
        }
    }
}

TEST_F(Plan, EstimatesIncludeTheVerticesThatClothMayGet) {
    const TornFilm film(false);
    for (const std::string name : {"a.glb", "a.pc2", "a.obj", "a.ply", "%d.obj", "%d.ply"}) {
        const auto made = make_exporter(folder_ / name);
        ASSERT_TRUE(made.ok());
        const auto start = film.at(0);
        const auto whole = (*made)->estimate({"torn", 60, film.size()}, start->frame());
        start->surfaces[0].spare_vertices = 5;
        const auto torn = (*made)->estimate({"torn", 60, film.size()}, start->frame());
        ASSERT_TRUE(whole.ok() && torn.ok());
        ASSERT_TRUE(film.write(folder_ / name).ok());
        std::uint64_t written = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            written += std::filesystem::file_size(entry.path());
            std::filesystem::remove(entry.path());
        }
        EXPECT_GT(torn->bytes, whole->bytes) << name;
        EXPECT_GE(torn->bytes, written) << name;
        if (name.ends_with(".ply")) {
            EXPECT_LT(whole->bytes, written) << "exact for cloth that stays whole";
        }
    }
}

TEST_F(Plan, ASequenceTakesWhatItsFramesTake) {
    const auto one = plan({"a.ply"}, 50, endless), sequence = plan({"a%d.ply"}, 50, endless);
    ASSERT_TRUE(one.ok() && sequence.ok());
    EXPECT_EQ(sequence->front().bytes, 50 * one->front().bytes);
    EXPECT_THAT(sequence->front().files, ElementsAre(folder_ / "a%d.ply"));
}

TEST_F(Plan, AGlbPastFourGibIsRefusedBeforeTheRun) {
    EXPECT_TRUE(plan({"a.glb"}, 2400, endless).ok());
    EXPECT_THAT(problem({"a.glb"}, 2800, endless),
                AllOf(HasSubstr("a.glb: would take 4."),
                      HasSubstr("GiB for 2800 frames, but a .glb cannot be larger than 4 GiB")));
}

TEST_F(Plan, ADiskWithoutRoomIsNamedWithBothNumbers) {
    // 69,200 vertices: a .pc2 takes 812 KiB per frame, its .obj about 15 MiB.
    EXPECT_EQ(problem({"a.ply"}, 1, ten_mib), "none");
    const std::string full = problem({"a.glb"}, 10, ten_mib);
    EXPECT_THAT(full, AllOf(HasSubstr("a.glb: would take up to 1"), HasSubstr("MiB, and only 10 MiB are free there")));
    EXPECT_EQ(problem({"a.glb"}, 10, unknown), "none");
    EXPECT_EQ(problem({"a.glb"}, 10, endless), "none");
}

TEST_F(Plan, ExportsOnOneDiskShareItsRoom) {
    EXPECT_EQ(problem({"x/a.ply"}, 1, ten_mib), "none");
    EXPECT_THAT(problem({"x/a.ply", "y/b.ply", "y/c.ply"}, 1, ten_mib), HasSubstr("x/a.ply, "));
    EXPECT_EQ(problem({"x/a.ply", "y/b.ply"}, 1, ten_mib_a_folder), "none");
    EXPECT_THAT(problem({"x/a.ply", "y/b.ply", "y/c.ply", "y/d.ply"}, 1, ten_mib_a_folder),
                AllOf(HasSubstr("y/b.ply, "), Not(HasSubstr("x/a.ply"))));
}

TEST_F(Plan, TwoExportsOfOneFileAreRefused) {
    EXPECT_THAT(problem({"a.obj", "a.pc2"}, 1, endless), AllOf(HasSubstr("a.pc2: would write"), HasSubstr("a.obj")));
    EXPECT_THAT(problem({"a.glb", "b.glb", "./a.glb"}, 1, endless), HasSubstr("and so would"));
    EXPECT_EQ(problem({"a.obj", "b.pc2", "a%d.obj", "a.ply"}, 1, endless), "none");
}

TEST_F(Plan, EveryProblemIsReported) {
    const auto planned = plan({"a.glb", "b.pc2", "b.obj"}, 3000, ten_mib);
    ASSERT_FALSE(planned.ok());
    EXPECT_EQ(planned.errors().size(), 3u);
}

TEST_F(Plan, OnlyLargeExportsAreAnnounced) {
    const ExportEstimate small{{"a.glb", "b.obj"}, large_export_bytes / 2 - 1}, half{{"c.pc2"}, large_export_bytes / 2};
    EXPECT_FALSE(large_export_note({}));
    EXPECT_FALSE(large_export_note(std::array{small, half}));
    EXPECT_EQ(large_export_note(std::array{half, half}).value_or(""),
              "the exports will take up to 1.0 GiB: c.pc2 512 MiB, c.pc2 512 MiB");
}

TEST(FreeSpace, IsThatOfTheSystem) {
    const TestFolder folder;
    const auto found = free_space(folder.path());
    ASSERT_TRUE(found.has_value());
    EXPECT_LE(found->bytes, std::filesystem::space(folder.path()).capacity);
    EXPECT_FALSE(free_space(folder / "none"));
}

TEST(BytesText, HasTwoOrMoreDigitsAndAUnit) {
    EXPECT_EQ(bytes_text(0), "0 bytes");
    EXPECT_EQ(bytes_text(1023), "1023 bytes");
    EXPECT_EQ(bytes_text(1024), "1.0 KiB");
    EXPECT_EQ(bytes_text(10 * mib - 1), "10 MiB");
    EXPECT_EQ(bytes_text(1024 * mib - 1), "1.0 GiB");
    EXPECT_EQ(bytes_text(large_export_bytes * 3 / 2), "1.5 GiB");
    EXPECT_EQ(bytes_text(~std::uint64_t{0}), "16 EiB");
}

}  // namespace
}  // namespace weft
