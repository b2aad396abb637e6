#include "weft/field_cache.h"

#include "base/cache_file.h"
#include "base/temporary_folder.test.h"
#include "mesh/procedural.h"
#include "weft/shape_building.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace weft {
namespace {

namespace fs = std::filesystem;

class FieldCaches : public testing::Test {
  protected:
    fs::path file() const { return folder_ / key_.file_name(); }
    // The data of a collider with `mesh_`, by a new library.
    std::shared_ptr<const ShapeData> load(const fs::path& cache) {
        const ColliderDesc collider{.shape = SolidMeshDesc{.mesh = mesh_, .resolution = cells}};
        ShapeLibrary library(1, FieldCache(cache));
        notes_.clear();
        auto data = library.data_of(collider, {}, "/colliders/0", notes_);
        EXPECT_TRUE(data.ok());
        return data.ok() ? *data : nullptr;
    }
    bool as_built(const std::shared_ptr<const ShapeData>& data) const {
        return data && data->words.size() == field_.data.words.size() && data->steepness == field_.data.steepness &&
               std::memcmp(data->words.data(), field_.data.words.data(), field_.bytes()) == 0;
    }

    static constexpr std::uint32_t cells = 16;
    const TemporaryFolder temporary_;
    const fs::path folder_ = temporary_.path();
    TriangleMesh mesh_ = make_box({1, 0.08f, 1}, {3, 2, 3});
    DistanceField field_ = *build_distance_field(mesh_.positions, mesh_.triangles, {.cells = cells, .threads = 1});
    FieldCache::Key key_ = FieldCache::key_of(mesh_.positions, mesh_.triangles, cells);
    std::vector<std::string> notes_;
};

TEST_F(FieldCaches, give_back_the_whole_field) {
    const FieldCache cache(folder_ / "a" / "b");
    EXPECT_FALSE(cache.read(key_));
    field_.flipped = 3, field_.zero_area = 2;
    ASSERT_GT(field_.thin.thin, 0u);
    cache.write(key_, field_);
    const auto kept = cache.read(key_);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->data.words, field_.data.words);
    EXPECT_EQ(kept->data.steepness, field_.data.steepness);
    EXPECT_EQ(kept->data.bounds, field_.data.bounds);
    EXPECT_EQ(kept->cell, field_.cell);
    EXPECT_EQ(kept->places, field_.places);
    EXPECT_EQ(kept->bricks, field_.bricks);
    EXPECT_EQ(kept->zero_area, 2u);
    EXPECT_EQ(kept->flipped, 3u);
    EXPECT_EQ(kept->closed, field_.closed);
    EXPECT_EQ(kept->has_inside, field_.has_inside);
    EXPECT_EQ(kept->is_sheet, field_.is_sheet);
    EXPECT_EQ(kept->thin.samples, field_.thin.samples);
    EXPECT_EQ(kept->thin.thin, field_.thin.thin);
    EXPECT_EQ(kept->thin.least_thickness, field_.thin.least_thickness);
    EXPECT_EQ(kept->thin.place, field_.thin.place);
    EXPECT_FALSE(FieldCache().read(key_));
    FieldCache().write(key_, field_);
}

TEST_F(FieldCaches, know_fields_by_all_that_they_depend_on) {
    TriangleMesh moved = mesh_, turned = mesh_;
    moved.positions[3].y += 1e-6f;
    std::swap(turned.triangles[5][0], turned.triangles[5][1]);
    EXPECT_EQ(FieldCache::key_of(mesh_.positions, mesh_.triangles, cells), key_);
    for (const auto& other : {FieldCache::key_of(moved.positions, mesh_.triangles, cells),
                              FieldCache::key_of(mesh_.positions, turned.triangles, cells),
                              FieldCache::key_of(mesh_.positions, mesh_.triangles, cells + 1)}) {
        EXPECT_NE(other.hash, key_.hash);
        EXPECT_NE(other.check, key_.check);
    }
}

TEST_F(FieldCaches, spare_the_work) {
    EXPECT_TRUE(as_built(load(folder_)));
    EXPECT_EQ(count_files(folder_), 1u);
    const std::vector<std::string> notes = notes_;
    ASSERT_FALSE(notes.empty()) << "it is thin";
    // A field of something else under this key is believed, so it must have been read.
    DistanceField other = field_;
    other.data.steepness = 1.625f;
    FieldCache(folder_).write(key_, other);
    const auto data = load(folder_);
    ASSERT_TRUE(data);
    EXPECT_EQ(data->steepness, 1.625f);
    EXPECT_EQ(notes_, notes);
    EXPECT_EQ(data->surface.positions, mesh_.positions);
    EXPECT_TRUE(as_built(load({}))) << "without a cache";
}

TEST_F(FieldCaches, build_again_what_is_damaged) {
    ASSERT_TRUE(as_built(load(folder_)));
    const std::vector<char> good = read_bytes(file());
    ASSERT_GT(good.size(), 1000u);
    std::vector<std::vector<char>> bad;
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{7}, std::size_t{24}, std::size_t{100}, good.size() / 2, good.size() - 1})
        bad.emplace_back(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
    for (const std::size_t at : {std::size_t{2}, std::size_t{9}, std::size_t{20}, std::size_t{30}, std::size_t{60},
                                 good.size() / 2, good.size() - 1}) {
        bad.push_back(good);
        bad.back()[at] = static_cast<char>(bad.back()[at] ^ 4);
    }
    bad.push_back(good);
    bad.back().resize(good.size() + 4);
    const std::string text = "this is no field";
    bad.emplace_back(text.begin(), text.end());
    for (const std::vector<char>& bytes : bad) {
        write_bytes(file(), bytes);
        EXPECT_FALSE(FieldCache(folder_).read(key_)) << bytes.size();
        EXPECT_TRUE(as_built(load(folder_)));
        EXPECT_EQ(read_bytes(file()), good) << "it is replaced";
    }
}

// Sound files, but of another version, another format or another mesh.
TEST_F(FieldCaches, build_again_what_is_old_or_foreign) {
    constexpr CacheFormat format = "weft-df1";
    ASSERT_TRUE(as_built(load(folder_)));
    const std::vector<char> good = read_bytes(file());
    const std::vector<char> data = read_cache_file(file(), format);
    ASSERT_FALSE(data.empty());
    std::vector<char> old = data;
    old[sizeof(FieldCache::Key)] = static_cast<char>(old[sizeof(FieldCache::Key)] + 1);
    std::vector<char> foreign = data;
    foreign[8] = static_cast<char>(foreign[8] ^ 1);
    std::vector<char> shorter = data;
    shorter.resize(data.size() - 16);
    const std::vector<char> little(data.begin(), data.begin() + 20);
    for (const auto& bytes : {old, foreign, shorter, little}) {
        ASSERT_TRUE(write_cache_file(file(), format, bytes));
        EXPECT_FALSE(FieldCache(folder_).read(key_));
        EXPECT_TRUE(as_built(load(folder_)));
        EXPECT_EQ(read_bytes(file()), good);
    }
    ASSERT_TRUE(write_cache_file(file(), "weft-df0", data));
    EXPECT_FALSE(FieldCache(folder_).read(key_));
}

TEST_F(FieldCaches, are_no_error_where_nothing_can_be_written) {
    write_bytes(file(), {});  // a file where the folder should be
    EXPECT_TRUE(as_built(load(file())));
    EXPECT_TRUE(as_built(load("/proc/self/fields")));
    EXPECT_EQ(count_files(folder_), 1u);
    // A folder where the file should be.
    fs::remove(file());
    fs::create_directories(file() / "full");
    EXPECT_TRUE(as_built(load(folder_)));
    EXPECT_EQ(count_files(folder_), 1u) << "nothing is left";
}

TEST_F(FieldCaches, remove_the_oldest_fields) {
    const auto written = [&](std::uint64_t n, int hours_ago) {
        const FieldCache::Key key{n, n};
        FieldCache(folder_, 3 * field_.bytes()).write(key, field_);
        const fs::path of_key = folder_ / key.file_name();
        fs::last_write_time(of_key, fs::file_time_type::clock::now() - std::chrono::hours(hours_ago));
        return of_key;
    };
    std::ofstream(folder_ / "driver.pipelines") << "something else";
    const fs::path first = written(1, 2), second = written(2, 3);
    EXPECT_TRUE(fs::exists(first) && fs::exists(second));
    const fs::path third = written(3, 1);
    EXPECT_FALSE(fs::exists(second));
    EXPECT_TRUE(fs::exists(first) && fs::exists(third));
    EXPECT_TRUE(fs::exists(folder_ / "driver.pipelines"));
}

}  // namespace
}  // namespace weft
