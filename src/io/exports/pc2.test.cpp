#include "io/exports/torn_film.test.h"
#include "io/meshes/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace weft {
namespace {

using test::Cloth;
using test::expect_shows;
using test::export_film;
using test::Instant;
using test::make_cloth;
using test::read_text;
using test::TestFolder;
using test::TornFilm;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Reads by the published layout, independently of the exporter's struct.
struct Cache {
    std::string signature;
    std::int32_t version = 0, points = 0, samples = 0;
    float first = -1, rate = -1;
    std::vector<Vec3> positions;

    explicit Cache(const std::string& bytes) {
        EXPECT_GE(bytes.size(), 32u);
        if (bytes.size() < 32) return;
        const auto at = [&]<class T>(T, std::size_t offset) {
            T value;
            std::memcpy(&value, bytes.data() + offset, sizeof value);
            return value;
        };
        signature = bytes.substr(0, 12);
        version = at(std::int32_t{}, 12);
        points = at(std::int32_t{}, 16);
        first = at(float{}, 20);
        rate = at(float{}, 24);
        samples = at(std::int32_t{}, 28);
        EXPECT_EQ((bytes.size() - 32) % 12, 0u);
        for (std::size_t o = 32; o + 12 <= bytes.size(); o += 12) {
            positions.push_back({at(float{}, o), at(float{}, o + 4), at(float{}, o + 8)});
        }
    }
};

TEST(Pc2Export, HoldsEveryVertexOfEveryClothInEveryFrame) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("left", 5, 0), make_cloth("right", 7, 1)};
    ASSERT_TRUE(export_film(folder / "film.pc2", cloths, 4, 10).ok());
    EXPECT_THAT(folder.names(), ElementsAre("film.obj", "film.pc2"));

    const Cache cache(read_text(folder / "film.pc2"));
    EXPECT_EQ(cache.signature, std::string("POINTCACHE2\0", 12));
    EXPECT_EQ(cache.version, 1);
    EXPECT_EQ(cache.points, 25 + 49);
    EXPECT_EQ(cache.first, 0);
    EXPECT_EQ(cache.rate, 1);
    EXPECT_EQ(cache.samples, 4);
    ASSERT_EQ(cache.positions.size(), 4u * 74);
    std::size_t next = 0;
    for (int frame = 0; frame < 4; ++frame) {
        Instant instant(cloths, 0, frame / 10.0);
        for (std::size_t cloth = 0; cloth < 2; ++cloth) {
            for (const Vec3& p : instant.positions(cloth)) EXPECT_EQ(cache.positions[next++], p) << frame;
        }
    }
}

TEST(Pc2Export, TheRestMeshIsOneObjectInTheOrderOfTheCache) {
    const TestFolder folder;
    std::vector<Cloth> cloths = {make_cloth("left", 5, 0), make_cloth("right", 4, 1)};
    cloths[1].mesh.uvs.clear();
    ASSERT_TRUE(export_film(folder / "film.pc2", cloths, 3).ok());
    const std::string text = read_text(folder / "film.obj");
    EXPECT_EQ(text.find("o waves\n"), 0u);
    EXPECT_EQ(text.find("\no "), text.npos);
    const Result<TriangleMesh> rest = load_mesh(folder / "film.obj");
    ASSERT_TRUE(rest.ok());
    const Cache cache(read_text(folder / "film.pc2"));
    ASSERT_EQ(rest->positions.size(), 25u + 16);
    for (std::size_t i = 0; i < rest->positions.size(); ++i) EXPECT_EQ(rest->positions[i], cache.positions[i]) << i;
    EXPECT_EQ(rest->triangles.size(), 2u * 16 + 2 * 9);
    EXPECT_EQ(rest->triangles[32][0], cloths[1].mesh.triangles[0][0] + 25);
    EXPECT_EQ(rest->uvs[7], cloths[0].mesh.uvs[7]);
    EXPECT_EQ(rest->uvs[30], Vec2{});
}

// Blender's importer drops them, so the numbers of vertices would differ.
TEST(Pc2Export, VerticesThatNoFaceUsesAreInNeitherFile) {
    const TestFolder folder;
    std::vector<Cloth> cloths = {make_cloth("a", 3, 0), make_cloth("b", 3, 1)};
    TriangleMesh& mesh = cloths[0].mesh;
    mesh.uvs.clear();
    mesh.positions.insert(mesh.positions.begin() + 4, Vec3{8, 8, 8});
    for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& vertex : triangle) vertex += vertex >= 4;
    }
    mesh.positions.push_back({9, 9, 9});
    mesh.triangles.push_back({0, 10, 10});  // not a face either
    ASSERT_TRUE(export_film(folder / "film.pc2", cloths, 2).ok());

    const Cache cache(read_text(folder / "film.pc2"));
    EXPECT_EQ(cache.points, 9 + 9);
    Instant last(cloths, 1, 1.0 / 60);
    EXPECT_EQ(cache.positions.at(18 + 3), last.positions(0)[3]);
    EXPECT_EQ(cache.positions.at(18 + 4), last.positions(0)[5]);
    EXPECT_EQ(cache.positions.at(18 + 9), last.positions(1)[0]);
    const Result<TriangleMesh> rest = load_mesh(folder / "film.obj");
    ASSERT_TRUE(rest.ok());
    EXPECT_EQ(rest->positions.size(), 18u);
    EXPECT_EQ(rest->triangles.size(), 16u);
}

TEST(Pc2Export, AFrameOfAnotherShapeIsRefused) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("a", 3, 0), make_cloth("b", 3, 1)};
    const auto second_frame = [&](const std::vector<Cloth>& later, std::uint64_t topology_version = 1) {
        const auto made = make_exporter(folder / "film.pc2");
        EXPECT_TRUE(made.ok() && (*made)->begin({"s", 60, 2}).ok());
        EXPECT_TRUE((*made)->write(Instant(cloths, 0, 0).frame()).ok());
        Instant second(later, 1, 0.1);
        second.surfaces.back().topology_version = topology_version;
        const Result<void> written = (*made)->write(second.frame());
        return written ? std::string("none") : written.error().message();
    };
    EXPECT_EQ(second_frame(cloths), "none");
    EXPECT_THAT(second_frame({cloths[0]}), HasSubstr("film.pc2: frame 1: it does not have the cloths"));
    EXPECT_THAT(second_frame({cloths[0], make_cloth("b", 4, 1)}),
                HasSubstr("cloth \"b\" has 18 triangles instead of 8"));
    EXPECT_EQ(second_frame(cloths, 2), "none") << "the same triangles";
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Pc2Export, AClothThatPartsHasOneMesh) {
    for (const bool removes : {false, true}) {
        const TestFolder folder;
        const TornFilm film(removes);
        ASSERT_TRUE(film.write(folder / "film.pc2").ok());
        const Cache cache(read_text(folder / "film.pc2"));
        const Result<TriangleMesh> rest = load_mesh(folder / "film.obj");
        ASSERT_TRUE(rest.ok());
        const std::size_t points = film.vertices() + 9;
        EXPECT_EQ(cache.points, static_cast<std::int32_t>(points));
        EXPECT_EQ(cache.samples, static_cast<std::int32_t>(film.size()));
        ASSERT_EQ(cache.positions.size(), film.size() * points);
        ASSERT_EQ(rest->positions.size(), points);
        for (std::size_t f = 0; f < film.size(); ++f) {
            const auto sample = cache.positions.begin() + static_cast<std::ptrdiff_t>(f * points);
            std::vector<Vec3> shown(sample, sample + static_cast<std::ptrdiff_t>(points));
            // Both cloths as one surface.
            const auto instant = film.at(f);
            std::vector<Vec3> positions = instant->positions(0);
            std::vector<Triangle> triangles = film.torn(f).triangles;
            const auto first = static_cast<std::uint32_t>(positions.size());
            for (const Triangle& t : film.cloths(f)[1].mesh.triangles)
                triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
            positions.insert(positions.end(), instant->positions(1).begin(), instant->positions(1).end());
            expect_shows(rest->triangles, shown, triangles, positions, f);
            if (f > 0) continue;
            expect_shows(rest->triangles, rest->positions, triangles, positions, f);
            for (std::size_t t = 0; t < film.torn(0).triangles.size(); ++t)
                for (std::size_t k = 0; k < 3; ++k)
                    EXPECT_EQ(rest->uvs[rest->triangles[t][k]], film.torn(0).uvs[film.torn(0).triangles[t][k]]);
        }
    }
}

// Both are in neither file, and what parts beside them has the right parent.
TEST(Pc2Export, AClothThatPartsBesideUnusedVerticesHasOneMesh) {
    const TestFolder folder;
    Cloth cloth = make_cloth("c", 3, 0);
    TriangleMesh& mesh = cloth.mesh;
    mesh.uvs.clear();
    mesh.positions.insert(mesh.positions.begin() + 1, Vec3{8, 8, 8});
    for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& vertex : triangle) vertex += vertex >= 1;
    }
    mesh.triangles.push_back({0, 0, 0});  // removed before the run
    Cloth torn = cloth;
    const std::uint32_t corner = torn.mesh.triangles[0][1];
    torn.mesh.positions.push_back(Vec3(torn.mesh.positions[corner]));
    torn.mesh.triangles[0][1] = 10;
    const auto exporter = make_exporter(folder / "film.pc2");
    ASSERT_TRUE(exporter.ok() && (*exporter)->begin({"s", 60, 2}).ok());
    const std::vector<Cloth> before = {cloth}, after = {torn};
    const Instant first(before, 0, 0);
    Instant second(after, 1, 1);
    second.surfaces[0].topology_version = 2;
    second.positions(0)[10] = {5, 6, 7};
    ASSERT_TRUE((*exporter)->write(first.frame()).ok());
    ASSERT_TRUE((*exporter)->write(second.frame()).ok() && (*exporter)->finish().ok());
    const Cache cache(read_text(folder / "film.pc2"));
    ASSERT_EQ(cache.points, 10);
    EXPECT_EQ(cache.positions[9], first.surfaces[0].positions[corner]);
    EXPECT_EQ(cache.positions[19], (Vec3{5, 6, 7}));
    const Result<TriangleMesh> rest = load_mesh(folder / "film.obj");
    ASSERT_TRUE(rest.ok());
    EXPECT_EQ(rest->triangles.size(), 8u);
    EXPECT_EQ(rest->triangles[0][1], 9u);
}

TEST(Pc2Export, ARestMeshThatCannotBeWrittenIsKnownBeforeTheRun) {
    const TestFolder folder;
    std::filesystem::create_directory(folder / "film.obj");
    const auto made = make_exporter(folder / "film.pc2");
    ASSERT_TRUE(made.ok());
    const Result<void> begun = (*made)->begin({"s", 60, 2});
    ASSERT_FALSE(begun.ok());
    EXPECT_EQ(begun.error().where, (folder / "film.obj").string());
}

TEST(Pc2Export, BothFilesAppearOrNeither) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("a", 3, 0)};
    const auto made = make_exporter(folder / "film.pc2");
    ASSERT_TRUE(made.ok() && (*made)->begin({"s", 60, 1}).ok());
    ASSERT_TRUE((*made)->write(Instant(cloths, 0, 0).frame()).ok());
    // The path that begin() found free is taken when finish() writes.
    std::filesystem::create_directory(folder / "film.pc2");
    EXPECT_FALSE((*made)->finish().ok());
    EXPECT_THAT(folder.names(), ElementsAre("film.pc2"));
    EXPECT_TRUE(std::filesystem::is_directory(folder / "film.pc2"));
}

TEST(Pc2Export, MoreVerticesThanItCountsAreRefused) {
    const auto made = make_exporter("film.pc2");
    ASSERT_TRUE(made.ok());
    // Never read; only their number matters.
    const std::span<const Vec3> many(reinterpret_cast<const Vec3*>(0x1000), std::size_t{1} << 31);
    const ExportSurface surface = surface_of("huge", {}, many, many);
    const auto estimate = (*made)->estimate({"s", 60, 1}, {0, 0, std::span(&surface, 1)});
    ASSERT_FALSE(estimate.ok());
    EXPECT_THAT(estimate.error().message(), HasSubstr("2147483648 vertices"));
    EXPECT_FALSE((*made)->estimate({"s", 60, std::uint64_t{1} << 31}, {}).ok());
}

}  // namespace
}  // namespace weft
