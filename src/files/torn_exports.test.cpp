// Exports of cloth that is cut and torn while it moves.

#include "files/open_scene.h"
#include "io/exports/exporter.h"
#include "io/meshes/mesh_file.h"
#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "scene/fabric.h"
#include "solver/model/cut.test.h"
#include "solver/model/drawn_pieces.test.h"
#include "solver/world/world.h"
#include "weft/backends.h"
#include "weft/drawn_frame.h"
#include "weft/scene_world.h"

#include "base/temporary_folder.test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>

namespace weft {
namespace {

constexpr std::uint32_t cut_side = 17;

std::shared_ptr<const ClothModel> cuttable_sheet(const std::string& name, float x, ClothReserve reserve) {
    TriangleMesh mesh = make_grid({1, 1}, {cut_side, cut_side}, GridDiagonal::alternating);
    ClothModelDesc desc{.name = name, .reserve = reserve};
    for (std::uint32_t p = 0; p < mesh.positions.size(); ++p) {
        Vec3& at = mesh.positions[p];
        if (at.z < -0.49f && std::abs(at.x) > 0.49f) desc.pins.particles.push_back(p);
        at = {at.x + x, -at.z, 0};
    }
    auto topology = build_topology(mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    desc.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

/// All cloths of a frame as one mesh.
struct Shown {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;

    explicit Shown(std::span<const DrawnSurface> surfaces) {
        for (const DrawnSurface& surface : surfaces) {
            const auto first = static_cast<std::uint32_t>(positions.size());
            positions.insert(positions.end(), surface.positions.begin(), surface.positions.end());
            for (const auto& [a, b, c] : surface.triangles) triangles.push_back({a + first, b + first, c + first});
        }
    }
    void expect_same(const std::vector<Triangle>& constant, std::span<const Vec3> values) const {
        ASSERT_EQ(constant.size(), triangles.size());
        for (std::size_t t = 0; t < constant.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(values[constant[t][k]], positions[triangles[t][k]]);
    }
};

/// Exports of a world in all formats.
class TornFilmFolder {
  public:
    /// `next(frame)` changes the world before a frame other than the first, and steps it.
    template <class Next>
    void write(const World& world, std::uint64_t frames, Next&& next) {
        const ExportInfo info{"torn", 60, frames};
        DrawnFrame drawn;
        drawn.update(world.frame());
        std::vector<std::unique_ptr<Exporter>> exporters;
        for (const char* name : {"film.glb", "film.pc2", "%d.ply", "%d.obj"}) {
            auto made = make_exporter(folder_.path() / name);
            ASSERT_TRUE(made.ok());
            auto estimate = (*made)->estimate(info, {0, 0, drawn.surfaces()});
            ASSERT_TRUE(estimate.ok() && (*made)->begin(info).ok());
            bound_ += estimate->bytes;
            exporters.push_back(std::move(*made));
        }
        for (std::uint64_t frame = 0; frame < frames; ++frame) {
            if (frame > 0) next(frame);
            drawn.update(world.frame());
            shown.emplace_back(drawn.surfaces());
            for (const auto& exporter : exporters) {
                const auto written = exporter->write({frame, static_cast<double>(frame) / 60, drawn.surfaces()});
                ASSERT_TRUE(written.ok()) << written.error().message();
            }
        }
        for (const auto& exporter : exporters) ASSERT_TRUE(exporter->finish().ok());
        EXPECT_EQ(world.frame().reports, report_none);
    }

    /// Expects that the files show each frame, with so many vertices.
    void expect_film(std::size_t points) const {
        expect_film();
        EXPECT_EQ(load_mesh(folder_.path() / "film.obj")->positions.size(), points);
    }
    void expect_film() const {
        const Result<TriangleMesh> rest = load_mesh(folder_.path() / "film.obj");
        ASSERT_TRUE(rest.ok());
        const std::size_t points = rest->positions.size();
        shown[0].expect_same(rest->triangles, rest->positions);
        std::ifstream file(folder_.path() / "film.pc2", std::ios::binary);
        const std::string cache{std::istreambuf_iterator<char>(file), {}};
        ASSERT_EQ(cache.size(), 32 + shown.size() * points * sizeof(Vec3));
        for (std::size_t f = 0; f < shown.size(); ++f) {
            std::vector<Vec3> sample(points);
            std::memcpy(sample.data(), cache.data() + 32 + f * points * sizeof(Vec3), points * sizeof(Vec3));
            shown[f].expect_same(rest->triangles, sample);
            for (const std::string ending : {".ply", ".obj"}) {
                const Result<TriangleMesh> frame = load_mesh(folder_.path() / (std::to_string(f) + ending));
                ASSERT_TRUE(frame.ok()) << frame.error().message();
                if (ending == ".obj") {  // the reader joins identical vertices of .ply
                    EXPECT_EQ(frame->positions.size(), points);
                    EXPECT_EQ(frame->triangles, rest->triangles);
                }
                shown[f].expect_same(frame->triangles, frame->positions);
            }
        }
        std::uint64_t written = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) written += entry.file_size();
        EXPECT_LE(written, bound_);
    }

    std::vector<Shown> shown;  ///< by frame

  private:
    TemporaryFolder folder_;
    std::uint64_t bound_ = 0;  ///< bytes of all exports
};

class TornExports : public testing::TestWithParam<const char*> {};

TEST_P(TornExports, ShowEachFrameOfAClothThatIsCut) {
    Options options;
    options.backend = GetParam();
    auto backend = make_backend(options);
    ASSERT_TRUE(backend.ok()) << backend.error().message();
    WorldSettings settings;
    settings.solver.substeps = 10;
    World world(std::move(*backend), settings);
    const ClothId id = world.add(cuttable_sheet("torn", 0, {32, 128}));
    world.add(cuttable_sheet("whole", 2, {}));
    TornFilmFolder film;
    film.write(world, 8, [&](std::uint64_t frame) {
        if (frame == 3) {
            const ClothEdit edit = test::cut(
                *world.model(id), [](std::uint32_t p) { return p % cut_side == 8; },
                [](std::uint32_t p) { return p % cut_side > 8; });
            ASSERT_EQ(edit.appended.size(), cut_side);
            ASSERT_TRUE(world.edit(id, edit).ok());
        }
        if (frame == 5) {
            const std::uint32_t corner = world.model(id)->triangles()[200][0];
            ASSERT_TRUE(world.edit(id, {.triangles = {{200, {corner, corner, corner}, 0}}}).ok());
        }
        world.step(1.0 / 60);
    });
    ASSERT_EQ(film.shown.size(), 8u);
    EXPECT_NE(film.shown[2].positions.size(), film.shown[3].positions.size());
    EXPECT_NE(film.shown[4].triangles, film.shown[5].triangles);
    film.expect_film(2 * cut_side * cut_side + cut_side + 2);
}

/// A sheet of rubber with the sides along x pinned. The right one moves away in a second.
SceneDesc pulled_sheet(MeshDesc mesh, Tearing tearing) {
    SceneDesc scene;
    scene.solver.substeps = 10;
    SceneCloth cloth;
    cloth.name = "pulled";
    cloth.mesh = std::move(mesh);
    cloth.fabric = find_fabric("rubber")->fabric;
    cloth.fabric.tear.tear_ratio = tearing == Tearing::erode ? 1.5f : 0;
    cloth.fabric_name = "rubber";
    cloth.tearing = tearing;
    cloth.pins = {{.select = BoxPins{{{-0.51f, -1, -1}, {-0.49f, 1, 1}}}},
                  {.select = BoxPins{{{0.49f, -1, -1}, {0.51f, 1, 1}}}, .motion = {{0, {}}, {1, {8, 1, 0}}}}};
    scene.cloths = {cloth};
    return scene;
}

/// Four patches with seams of UVs along x = 0 and z = 0.
TriangleMesh patched_square() {
    return testing_meshes::with_seams(make_grid({1, 1}, {17, 17}, GridDiagonal::alternating),
                                      [](Vec3 at) { return 2 * (at.x > 0) + (at.z > 0); });
}

SceneWorld open_torn_world(const SceneDesc& scene, const std::string& backend) {
    auto world = SceneWorld::create(scene, {.backend = backend});
    EXPECT_TRUE(world.ok()) << world.error().message();
    return std::move(*world);
}

// Beside a seam and across another one.
const CutDesc beside_the_seam{.along = PlaneCut{{1, 0, 0}, 0.0625f}};

/// The simulated mesh is drawn, with seams; or a finer mesh with seams, out of step with it.
SceneDesc seamed_sheet(bool bound, Tearing tearing) {
    if (!bound) return pulled_sheet(patched_square(), tearing);
    SceneDesc scene = pulled_sheet(GridDesc{.size = {1, 1}, .resolution = {17, 17}}, tearing);
    scene.cloths[0].render_mesh = testing_meshes::with_seams(make_grid({1, 1}, {40, 36}, GridDiagonal::uniform),
                                                             [](Vec3 at) { return 2 * (at.x > 0) + (at.z > 0); });
    return scene;
}

void expect_cut_film(bool bound, const char* backend) {
    SceneWorld world = open_torn_world(seamed_sheet(bound, Tearing::cuts), backend);
    const ClothId id = world.world().cloth_id(0);
    const auto cloth = [&]() -> const ClothFrame& { return world.world().frame().cloths[0]; };
    const std::size_t vertices = cloth().render_mesh().positions.size();
    Snapshot whole, parted;
    std::vector<Vec3> shown_then;
    TornFilmFolder film;
    film.write(world.world(), 10, [&](std::uint64_t frame) {
        if (frame == 3) {
            const double area = test::drawn_area(cloth());
            whole = world.world().save();
            ASSERT_TRUE(world.cut(id, beside_the_seam, CutPositions::start).ok());
            EXPECT_NEAR(test::drawn_area(cloth()), area, 1e-5 * area) << "closed at first";
            // The surface is curved by the normals of its particles, which are one-sided on the cut.
            EXPECT_LT(test::widest_gap(cloth()), bound ? 1e-4f : 1e-9f);
        }
        world.step();
        EXPECT_EQ(test::expect_no_triangle_spans_pieces(*cloth().model).size(), frame < 3 ? 1u : 2u);
        if (frame == 6) {
            parted = world.world().save();
            shown_then = cloth().render_mesh().positions;
        }
    });
    EXPECT_GT(test::widest_gap(cloth()), 0.05f);
    const std::size_t appended = cloth().render_mesh().positions.size() - vertices;
    if (bound) {
        EXPECT_GT(appended, 36u + 35);
    } else {
        EXPECT_EQ(appended, 18u);
    }
    film.expect_film(vertices + appended);
    // A restored world shows the same mesh.
    const TriangleMesh mesh = cloth().model->mesh();
    ASSERT_TRUE(world.world().restore(whole).ok());
    EXPECT_EQ(cloth().render_mesh().positions.size(), vertices);
    SceneWorld other = open_torn_world(seamed_sheet(bound, Tearing::cuts), backend);
    for (SceneWorld* restored : {&world, &other}) {
        ASSERT_TRUE(restored->world().restore(parted).ok());
        const ClothFrame& now = restored->world().frame().cloths[0];
        EXPECT_EQ(now.model->mesh(), mesh);
        EXPECT_EQ(now.render_mesh().positions, shown_then);
    }
}

void expect_torn_film(bool bound, const char* backend) {
    SceneWorld world = open_torn_world(seamed_sheet(bound, Tearing::split), backend);
    const std::size_t vertices = world.world().frame().cloths[0].render_mesh().positions.size();
    TornFilmFolder film;
    film.write(world.world(), 25, [&](std::uint64_t) {
        world.step();
        test::expect_no_triangle_spans_pieces(*world.world().frame().cloths[0].model);
    });
    const ClothFrame& cloth = world.world().frame().cloths[0];
    EXPECT_GE(test::expect_no_triangle_spans_pieces(*cloth.model).size(), 2u);
    EXPECT_GT(test::widest_gap(cloth), 0.2f);
    EXPECT_GT(cloth.render_mesh().positions.size(), vertices);
    film.expect_film(cloth.render_mesh().positions.size());
}

// Drawn triangles of removed ones have no area. All others keep theirs.
void expect_eroded_film(bool bound, const char* backend) {
    SceneWorld world = open_torn_world(seamed_sheet(bound, Tearing::erode), backend);
    const auto cloth = [&]() -> const ClothFrame& { return world.world().frame().cloths[0]; };
    const double whole = test::area_of(cloth().render_mesh().triangles, cloth().render_mesh().rest_positions);
    TornFilmFolder film;
    film.write(world.world(), 25, [&](std::uint64_t) { world.step(); });
    double left = 0;
    for (const float area : cloth().model->face_area) left += double{area};
    EXPECT_LT(left, 0.99 * whole);
    EXPECT_NEAR(test::area_of(cloth().render_mesh().triangles, cloth().render_mesh().rest_positions), left,
                1e-4 * whole);
    EXPECT_GT(test::expect_no_triangle_spans_pieces(*cloth().model).size(), 1u);
    for (const Vec3& x : cloth().render_mesh().positions) EXPECT_TRUE(std::isfinite(x.x + x.y + x.z));
    for (const Vec3& n : cloth().render_mesh().normals) EXPECT_TRUE(std::isfinite(n.x + n.y + n.z));
    film.expect_film();
    const TriangleMesh mesh = cloth().model->mesh();
    const Snapshot state = world.world().save();
    SceneWorld other = open_torn_world(seamed_sheet(bound, Tearing::erode), backend);
    ASSERT_TRUE(other.world().restore(state).ok());
    EXPECT_EQ(other.world().frame().cloths[0].model->mesh(), mesh);
}

// Labels: long
TEST_P(TornExports, ShowEachFrameOfAClothWithSeamsThatErodes) {
    expect_eroded_film(false, GetParam());
}
TEST_P(TornExports, ShowEachFrameOfARenderMeshThatErodes) {
    expect_eroded_film(true, GetParam());
}
TEST_P(TornExports, ShowEachFrameOfAClothWithSeamsThatIsCut) {
    expect_cut_film(false, GetParam());
}
TEST_P(TornExports, ShowEachFrameOfAClothWithSeamsThatTears) {
    expect_torn_film(false, GetParam());
}
TEST_P(TornExports, ShowEachFrameOfARenderMeshThatIsCut) {
    expect_cut_film(true, GetParam());
}
TEST_P(TornExports, ShowEachFrameOfARenderMeshThatTears) {
    expect_torn_film(true, GetParam());
}

constexpr const char* backends_of_build[] = {"cpu",
#ifdef WEFT_VULKAN
                                             "vulkan"
#endif
};
INSTANTIATE_TEST_SUITE_P(Backends, TornExports, testing::ValuesIn(backends_of_build),
                         [](const auto& backend) { return std::string(backend.param); });

// A rubber sheet whose right side is pulled away.
TEST(ExportsOfAWorld, ShowEachFrameOfAClothThatTears) {
    std::string left, right;
    for (int row = 0; row < 17; ++row) {
        left += (row > 0 ? ", " : "") + std::to_string(17 * row);
        right += (row > 0 ? ", " : "") + std::to_string(17 * row + 16);
    }
    const TemporaryFolder folder;
    auto session = open_scene(
        folder.write("s.json",
                     R"({"weft": 1, "solver": {"substeps": 10}, "cloths": [{"fabric": "rubber", "tearing": "split",
            "mesh": {"grid": {"size": [1, 1], "resolution": [17, 17]}}, "pins": [{"vertices": [)" +
                         left + R"(]}, {"vertices": [)" + right +
                         R"(], "motion": [{"time": 0}, {"time": 0.5, "offset": [4, 0.5, 0]}]}]}]})"),
        {.backend = "cpu"});
    ASSERT_TRUE(session.ok()) << session.error().message();
    TornFilmFolder film;
    film.write(session->world(), 40, [&](std::uint64_t) { session->step(); });
    ASSERT_EQ(film.shown.size(), 40u);
    const std::size_t vertices = film.shown.back().positions.size();
    EXPECT_GE(vertices, 17u * 17 + 10) << "it has torn in two";
    std::set<std::size_t> counts;
    for (const Shown& shown : film.shown) counts.insert(shown.positions.size());
    EXPECT_GE(counts.size(), 3u) << "in several frames";
    film.expect_film(vertices);
}

}  // namespace
}  // namespace weft
