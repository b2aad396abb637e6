#include "io/exports/exporter.h"

#include "io/exports/export_format.h"
#include "io/exports/torn_film.test.h"
#include "io/meshes/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <limits>
#include <sstream>

namespace weft {
Result<StillVertices> read_obj(const std::filesystem::path& path);
Result<StillVertices> read_ply(const std::filesystem::path& path);

namespace {

using test::Cloth;
using test::expect_shows;
using test::export_film;
using test::Instant;
using test::make_cloth;
using test::read_text;
using test::TestFolder;
using test::TornFilm;
using test::write_text;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Exporter, UnknownEndingNamesTheKnownOnes) {
    const TestFolder folder;
    for (const char* name : {"a.abc", "a", ".obj", "a.glb.zip"}) {
        const auto made = make_exporter(folder / name);
        ASSERT_FALSE(made.ok()) << name;
        EXPECT_EQ(made.error().where, (folder / name).string());
        for (const ExportFormat& format : export_formats()) {
            EXPECT_THAT(made.error().what, HasSubstr(std::string(format.ending)));
        }
    }
    EXPECT_GE(export_formats().size(), 3u);
    EXPECT_TRUE(make_exporter(folder / "UPPER.OBJ").ok());
}

TEST(Exporter, RefusesPatternsThatAreNotOneNumber) {
    const TestFolder folder;
    for (const char* name :
         {"%s.obj", "%n.obj", "%4d.obj", "%d_%d.obj", "%%d.obj", "100%.obj", "%.obj", "%0d.obj", "%00d.obj", "%04.obj",
          "%-4d.obj", "%04i.obj", "%ld.obj", "%0400d.obj", "%04", "%*d.ply"}) {
        const auto made = make_exporter(folder / name);
        EXPECT_FALSE(made.ok()) << name;
    }
    EXPECT_THAT(make_exporter(folder / "%s.obj").error().what, HasSubstr("%04d"));
    for (const char* name : {"%d.obj", "%04d.obj", "a%09db.ply", "%01d.PLY"}) {
        EXPECT_TRUE(make_exporter(folder / name).ok()) << name;
    }
}

TEST(Exporter, ASequenceOfFilmsIsRefused) {
    const TestFolder folder;
    const auto made = make_exporter(folder / "new/%04d.glb");
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().what, AllOf(HasSubstr("whole animation"), HasSubstr(".obj, .ply")));
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Exporter, ASequenceIsOneFilePerFrameInAFolderMadeForIt) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("sheet", 4, 0)};
    ASSERT_TRUE(export_film(folder / "deep/er/f_%03d.obj", cloths, 3).ok());
    std::set<std::string> names, contents;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "deep/er")) {
        names.insert(entry.path().filename());
        contents.insert(read_text(entry.path()));
    }
    EXPECT_THAT(names, ElementsAre("f_000.obj", "f_001.obj", "f_002.obj"));
    EXPECT_EQ(contents.size(), 3u);
}

TEST(Exporter, ASequenceNumbersByTheFrameAndAPercentInAFolderIsOnlyAName) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("sheet", 4, 0)};
    const auto made = make_exporter(folder / "50%d%s/%02d.ply");
    ASSERT_TRUE(made.ok());
    ASSERT_TRUE((*made)->begin({"s", 60, 2}).ok());
    for (const std::uint64_t index : {7u, 123u}) {
        ASSERT_TRUE((*made)->write(Instant(cloths, index, 1).frame()).ok());
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "50%d%s/07.ply"));
    EXPECT_TRUE(std::filesystem::exists(folder / "50%d%s/123.ply"));
}

TEST(Exporter, AStillHoldsTheLastFrameAndCopiesIt) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("sheet", 4, 0)};
    for (const char* name : {"still.obj", "still.ply"}) {
        // The frames of export_film() no longer exist when finish() writes.
        ASSERT_TRUE(export_film(folder / name, cloths, 3, 10).ok());
        const auto alone = make_exporter(folder / (std::string("alone_") + name));
        ASSERT_TRUE(alone.ok() && (*alone)->begin({"waves", 10, 1}).ok());
        ASSERT_TRUE((*alone)->write(Instant(cloths, 2, 0.2).frame()).ok() && (*alone)->finish().ok());
        EXPECT_EQ(read_text(folder / name), read_text(folder / (std::string("alone_") + name)));
    }
}

TEST(Exporter, AStillHasTheTrianglesOfTheLastFrame) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("c", 4, 0)};
    const auto made = make_exporter(folder / "a.obj");
    ASSERT_TRUE(made.ok() && (*made)->begin({"s", 60, 2}).ok());
    ASSERT_TRUE((*made)->write(Instant(cloths, 0, 0).frame()).ok());
    {
        std::vector<Triangle> torn(cloths[0].mesh.triangles.begin(), cloths[0].mesh.triangles.end() - 3);
        Instant last(cloths, 1, 0.1);
        last.surfaces[0].triangles = torn;
        last.surfaces[0].topology_version = 2;
        ASSERT_TRUE((*made)->write(last.frame()).ok());
        torn.assign(torn.size(), {});  // the exporter must have copied its data
    }
    ASSERT_TRUE((*made)->finish().ok());
    const std::string text = read_text(folder / "a.obj");
    EXPECT_EQ(std::ranges::count(text, 'f'), static_cast<std::ptrdiff_t>(cloths[0].mesh.triangles.size() - 3));
    EXPECT_EQ(text.find("f 1/1/1 1/1/1"), std::string::npos);
}

/// What is in a sequence: the numbers of a mesh that a .obj or .ply holds.
struct SequenceFile {
    std::vector<Vec3> positions, normals;
    std::vector<Triangle> triangles;
};
SequenceFile read_file(const std::filesystem::path& path) {
    SequenceFile file;
    const auto vertices = path.extension() == ".ply" ? read_ply(path) : read_obj(path);
    EXPECT_TRUE(vertices.ok()) << path;
    if (!vertices) return file;
    file.positions = vertices->positions, file.normals = vertices->normals;
    const std::string text = read_text(path);
    if (path.extension() == ".ply") {
        constexpr std::size_t record = 13;
        const std::size_t faces = std::stoul(text.substr(text.find("element face ") + 13));
        for (std::size_t f = 0; f < faces; ++f) {
            const char* at = text.data() + text.size() - (faces - f) * record;
            EXPECT_EQ(*at, 3);
            std::memcpy(file.triangles.emplace_back().data(), at + 1, sizeof(Triangle));
        }
        return file;
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("f ")) continue;
        std::istringstream in(line.substr(2));
        Triangle& triangle = file.triangles.emplace_back();
        for (std::uint32_t& vertex : triangle) {
            std::string corner;
            in >> corner;
            vertex = static_cast<std::uint32_t>(std::stoul(corner) - 1);
        }
    }
    return file;
}

TEST(Exporter, ASequenceOfAClothThatPartsHasOneListOfTriangles) {
    for (const bool removes : {false, true}) {
        for (const std::string ending : {".obj", ".ply"}) {
            const TestFolder folder;
            const TornFilm film(removes);
            ASSERT_TRUE(film.write(folder / ("%d" + ending)).ok());
            EXPECT_EQ(folder.names().size(), film.size());
            std::vector<Triangle> triangles;
            for (std::size_t f = 0; f < film.size(); ++f) {
                const std::filesystem::path path = folder / (std::to_string(f) + ending);
                const SequenceFile file = read_file(path);
                if (f == 0) triangles = file.triangles;
                EXPECT_EQ(file.triangles, triangles);
                EXPECT_EQ(file.positions.size(), film.vertices() + 9);
                const auto instant = film.at(f);
                // Both cloths as one surface.
                std::vector<Vec3> positions = instant->positions(0), normals = instant->normals(0);
                std::vector<Triangle> surface = film.torn(f).triangles;
                const auto first = static_cast<std::uint32_t>(positions.size());
                for (const Triangle& t : film.cloths(f)[1].mesh.triangles)
                    surface.push_back({t[0] + first, t[1] + first, t[2] + first});
                for (const Vec3& p : instant->positions(1)) positions.push_back(p);
                for (const Vec3& n : instant->normals(1)) normals.push_back(n);
                expect_shows(triangles, file.positions, surface, positions, f);
                expect_shows(triangles, file.normals, surface, normals, f);
                EXPECT_TRUE(load_mesh(path).ok()) << path;
            }
        }
    }
}

TEST(Exporter, ASequenceWritesOnlyThoseFilesAgainThatLackVertices) {
    const TestFolder folder;
    const TornFilm film;
    const auto made = make_exporter(folder / "%d.ply");
    ASSERT_TRUE(made.ok() && (*made)->begin({"s", 60, film.size()}).ok());
    for (std::size_t f = 0; f < film.size(); ++f) ASSERT_TRUE((*made)->write(film.at(f)->frame()).ok());
    // A file that is written again is another file.
    std::vector<std::filesystem::path> links;
    for (std::size_t f = 0; f < film.size(); ++f) {
        links.push_back(folder / ("link" + std::to_string(f)));
        std::filesystem::create_hard_link(folder / (std::to_string(f) + ".ply"), links.back());
    }
    ASSERT_TRUE((*made)->finish().ok());
    for (std::size_t f = 0; f < film.size(); ++f)
        EXPECT_EQ(std::filesystem::equivalent(links[f], folder / (std::to_string(f) + ".ply")), f >= 4) << f;
}

TEST(Exporter, ASequenceWhoseFilesChangeDuringTheRunIsAnError) {
    const TornFilm film;
    for (const std::string ending : {".obj", ".ply"}) {
        const auto finished_after = [&](auto&& spoil) {
            const TestFolder folder;
            const auto made = make_exporter(folder / ("%d" + ending));
            EXPECT_TRUE(made.ok() && (*made)->begin({"s", 60, film.size()}).ok());
            for (std::size_t f = 0; f < film.size(); ++f) EXPECT_TRUE((*made)->write(film.at(f)->frame()).ok());
            spoil(folder / ("1" + ending));
            const Result<void> finished = (*made)->finish();
            return finished ? std::string("none") : finished.error().message();
        };
        EXPECT_EQ(finished_after([](const auto&) {}), "none");
        EXPECT_THAT(finished_after([](const auto& path) { std::filesystem::remove(path); }), HasSubstr("1" + ending));
        EXPECT_THAT(finished_after([](const auto& path) { write_text(path, "v 1 2\n"); }), HasSubstr("1" + ending));
        EXPECT_THAT(finished_after([&](const auto& path) { (void)export_film(path, {make_cloth("other", 3, 0)}, 1); }),
                    HasSubstr("was changed by another program"));
        EXPECT_THAT(finished_after([](const auto& path) {
                        std::filesystem::resize_file(path, std::filesystem::file_size(path) / 4);
                    }),
                    HasSubstr("1" + ending));
    }
}

// Such a run cannot have one list of triangles: it has one until the cloth is replaced, and one after that.
TEST(Exporter, ASequenceGoesOnWithAnotherCloth) {
    const TestFolder folder;
    const TornFilm film;
    const std::vector<Cloth> others = {make_cloth("other", 5, 0)};
    const auto made = make_exporter(folder / "%d.ply");
    ASSERT_TRUE(made.ok() && (*made)->begin({"s", 60, film.size() + 2}).ok());
    for (std::size_t f = 0; f < film.size(); ++f) ASSERT_TRUE((*made)->write(film.at(f)->frame()).ok());
    for (const std::uint64_t f : {6u, 7u}) ASSERT_TRUE((*made)->write(Instant(others, f, 1).frame()).ok());
    ASSERT_TRUE((*made)->finish().ok());
    for (std::size_t f = 0; f < 8; ++f) {
        const SequenceFile file = read_file(folder / (std::to_string(f) + ".ply"));
        EXPECT_EQ(file.positions.size(), f < film.size() ? film.vertices() + 9 : 25u);
        EXPECT_EQ(file.triangles == others[0].mesh.triangles, f >= film.size());
    }
}

TEST(Exporter, DestroyedEarlyLeavesNothing) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("sheet", 40, 0)};
    write_text(folder / "b.glb", "earlier");
    for (const char* name : {"a.glb", "b.glb", "a.pc2", "a.obj", "a.ply", "%d.obj"}) {
        const auto made = make_exporter(folder / name);
        ASSERT_TRUE(made.ok());
        ASSERT_TRUE((*made)->begin({"s", 60, 100}).ok());
        EXPECT_THAT(folder.names(), ElementsAre("b.glb")) << "while running, " << name;
        if (name[0] == '%') continue;  // complete frames of a sequence stay
        for (std::uint64_t i = 0; i < 30; ++i) {
            ASSERT_TRUE((*made)->write(Instant(cloths, i, static_cast<double>(i) / 60).frame()).ok());
        }
        EXPECT_THAT(folder.names(), ElementsAre("b.glb")) << "while running, " << name;
    }
    EXPECT_THAT(folder.names(), ElementsAre("b.glb"));
    EXPECT_EQ(read_text(folder / "b.glb"), "earlier");
}

TEST(Exporter, FinishWithoutAFrameFailsAndLeavesNothing) {
    const TestFolder folder;
    for (const char* name : {"a.glb", "a.pc2", "a.obj", "a.ply"}) {
        const auto made = make_exporter(folder / name);
        ASSERT_TRUE(made.ok() && (*made)->begin({}).ok());
        EXPECT_FALSE((*made)->finish().ok()) << name;
    }
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Exporter, APlaceThatCannotBeWrittenIsKnownBeforeTheRun) {
    const TestFolder folder;
    std::filesystem::create_directory(folder / "folder.glb");
    std::filesystem::create_directory(folder / "folder.obj");
    write_text(folder / "file", "");
    for (const char* name : {"folder.glb", "folder.obj"}) {
        const auto made = make_exporter(folder / name);
        ASSERT_TRUE(made.ok());
        const Result<void> begun = (*made)->begin({});
        ASSERT_FALSE(begun.ok()) << name;
        EXPECT_THAT(begun.error().what, HasSubstr("it is a folder"));
    }
    const auto below_file = make_exporter(folder / "file/below/a.obj");
    ASSERT_FALSE(below_file.ok());
    EXPECT_THAT(below_file.error().message(), AllOf(HasSubstr("file/below/a.obj"), HasSubstr("Not a directory")));
    EXPECT_FALSE(make_exporter("/proc/weft/a.obj").ok());
}

TEST(Exporter, AFullDiskIsAnErrorAndKeepsTheEarlierFile) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("sheet", 60, 0)};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    std::vector<std::string> whats;
    for (const char* name : {"a.glb", "b.pc2", "a.obj", "a.ply", "000.obj"}) {
        write_text(folder / name, "earlier");
        const rlimit limit{20000, before.rlim_max};
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
        const Result<void> done = export_film(folder / (name[0] == '0' ? "%03d.obj" : name), cloths, 3);
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
        ASSERT_FALSE(done.ok()) << name;
        EXPECT_EQ(done.error().where, (folder / name).string());
        EXPECT_THAT(done.error().what, HasSubstr("File too large"));
        EXPECT_EQ(read_text(folder / name), "earlier") << name;
    }
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(folder.names(), ElementsAre("000.obj", "a.glb", "a.obj", "a.ply", "b.pc2"));
}

TEST(Exporter, BrokenFramesAreNamed) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("good", 4, 0), make_cloth("bad", 4, 0)};
    const auto problem_with = [&](auto&& spoil) {
        const auto made = make_exporter(folder / "a.glb");
        EXPECT_TRUE(made.ok() && (*made)->begin({"s", 60, 1}).ok());
        Instant instant(cloths, 3, 0);
        spoil(instant);
        const Result<void> written = (*made)->write(instant.frame());
        return written ? std::string("none") : written.error().message();
    };
    EXPECT_EQ(problem_with([](Instant&) {}), "none");
    EXPECT_THAT(problem_with([](Instant& i) { i.positions(1)[5].y = std::numeric_limits<float>::quiet_NaN(); }),
                AllOf(HasSubstr("a.glb: frame 3: cloth \"bad\""), HasSubstr("not finite at vertex 5")));
    EXPECT_THAT(problem_with([](Instant& i) { i.surfaces[1].normals = {}; }), HasSubstr("16 positions but 0 normals"));
    EXPECT_THAT(problem_with([](Instant& i) { i.surfaces[1].triangles = {}; }), HasSubstr("no triangles"));
    EXPECT_THAT(problem_with([](Instant& i) { i.surfaces.clear(); }), HasSubstr("no cloth"));
    std::vector<Triangle> triangles = cloths[1].mesh.triangles;
    triangles.back()[1] = 16;
    EXPECT_THAT(problem_with([&](Instant& i) { i.surfaces[1].triangles = triangles; }), HasSubstr("vertex 16 of 16"));
    EXPECT_THAT(problem_with([](Instant& i) { i.surfaces[1].uvs = i.surfaces[1].uvs.first(15); }),
                HasSubstr("one UV per vertex"));
}

TEST(Exporter, NormalsAreUnitWhateverComes) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const Vec3 bad : {Vec3{}, Vec3{nan, 0, 0}, Vec3{inf, 1, 0}, Vec3{1e-30f, 0, 0}, Vec3{1e30f, 1, 1}}) {
        EXPECT_EQ(unit_normal(bad), (Vec3{0, 1, 0}));
    }
    EXPECT_NEAR(length(unit_normal({3, 4, 12})), 1, 1e-6);
    const Vec3 kept = normalized({1, 2, 3});
    EXPECT_EQ(unit_normal(kept), kept);
}

}  // namespace
}  // namespace weft
