// Cloth that tears by itself.

#include "physics/stretch/stretch_law.h"
#include "sheet.h"

#include "solver/measures/pieces.h"
#include "solver/measures/tension.h"
#include "solver/model/cuts.h"
#include "solver/model/tear_law.h"
#include "solver/model/tear_paint.h"
#include "solver/model/tear_table.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace weft::physical {
namespace {

struct StripDesc {
    std::array<float, 2> size{0.25f, 1};
    std::array<std::uint32_t, 2> resolution{9, 33};
    float jitter = 0;  ///< in cells
    Fabric fabric = {};
    std::function<bool(Vec3)> pinned = {};
    bool lines = true;
    SelfCollision self_collision = SelfCollision::off;
    bool erodes = false;
};

// A strip in the plane z = 0, its upper edge at y = size[1] / 2.
std::shared_ptr<const ClothModel> make_strip(const StripDesc& desc) {
    TriangleMesh mesh = make_grid(desc.size, desc.resolution, GridDiagonal::alternating);
    std::uint32_t state = 12345;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 8388608.0f - 1;
    };
    const float cell = desc.size[1] / static_cast<float>(desc.resolution[1] - 1);
    ClothModelDesc model{.name = "strip",
                         .fabric = desc.fabric,
                         .collision = {desc.self_collision},
                         .layout = {.lines = desc.lines, .hierarchy = desc.lines},
                         .reserve = {.particles = 600, .openings = true, .tears = true, .erodes = desc.erodes}};
    for (std::uint32_t p = 0; p < mesh.positions.size(); ++p) {
        Vec3& x = mesh.positions[p];
        const bool inner_x = std::abs(x.x) < 0.499f * desc.size[0], inner_z = std::abs(x.z) < 0.499f * desc.size[1];
        const float dx = random() * desc.jitter * cell, dz = random() * desc.jitter * cell;
        x = {x.x + (inner_x ? dx : 0), x.z + (inner_z ? dz : 0), 0};
        x = {x.x, -x.y, 0};
        if (desc.pinned && desc.pinned(x)) model.pins.particles.push_back(p);
    }
    auto topology = build_topology(mesh, {.reorder = false});
    model.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(model), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

// Pieces of the cloth: of triangles that share an edge.
std::uint32_t pieces_of(const ClothModel& model) {
    std::vector<std::uint32_t> piece(model.particle_count);
    for (std::uint32_t p = 0; p < piece.size(); ++p) piece[p] = p;
    const auto root = [&](std::uint32_t p) {
        while (piece[p] != p) p = piece[p] = piece[piece[p]];
        return p;
    };
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        const auto [a, b, c] = model.triangles()[t];
        piece[root(a)] = root(b), piece[root(b)] = root(c);
    }
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < piece.size(); ++p) count += piece[p] == p;
    return count;
}

double load_of(const World& world) {
    return TensionMeter().measure(world.frame()).load->value;
}

// Gravity grows over 5 s until the strip's weight is `part` of its strength; then it hangs for `seconds`.
World hang(const std::shared_ptr<const ClothModel>& model, double part, double seconds, std::uint32_t substeps) {
    WorldSettings settings{.solver = {.substeps = substeps, .projection = Projection::lines, .hierarchy = true}};
    const float strength = model->fabric.tear.strength[1];
    const auto full = static_cast<float>(part) * strength / model->fabric.body.density;
    World world = make_world(settings);
    world.add(model);
    for (int i = 0; i < static_cast<int>(60 * (5 + seconds)); ++i) {
        settings.gravity = {0, -full * std::min(1.0f, static_cast<float>(i) / 300), 0};
        world.configure(settings);
        world.step(1.0 / 60);
        if (pieces_of(*world.frame().cloths[0].model) > 1) break;
    }
    return world;
}

Fabric rubber(StretchModel model = StretchModel::edges) {
    Fabric fabric = find_fabric("rubber")->fabric;
    fabric.body.damping = 0.02f;
    fabric.stretch.model = model;
    return fabric;
}

TEST(Tearing, of_a_hanging_strip_begins_at_its_strength) {
    struct Strip {
        std::uint32_t cells, substeps;
        StretchModel model = StretchModel::edges;
    };
    for (const auto& [cells, substeps, stretch] :
         {Strip{16, 40}, Strip{32, 40}, Strip{16, 80, StretchModel::membrane}}) {
        for (const double part : {0.9, 1.1}) {
            const auto model =
                make_strip({.resolution = {cells / 4 + 1, cells + 1}, .fabric = rubber(stretch), .pinned = [](Vec3 x) {
                                return x.y > 0.499f;
                            }});
            const World world = hang(model, part, 3, substeps);
            const ClothFrame& cloth = world.frame().cloths[0];
            EXPECT_EQ(pieces_of(*cloth.model) > 1, part > 1) << cells << " cells, " << load_of(world);
            for (const std::uint32_t p : cloth.model->copied_from)
                EXPECT_GT(cloth.model->rest_position(p).y, 0.3f) << "tears near the top";
        }
    }
}

// Cloth far weaker than its cuts parts at four times its strength, whatever their ends would bear.
TEST(Tearing, is_not_stopped_by_the_ends_of_cuts_that_hold) {
    Fabric fabric = rubber();
    fabric.tear.strength[0] = fabric.tear.strength[1] = 20;
    fabric.tear.tear_energy = 1e5f;
    const auto model = make_strip(
        {.size = {0.5f, 1}, .resolution = {17, 33}, .fabric = fabric, .pinned = [](Vec3 x) { return x.y > 0.499f; }});
    const World world = hang(model, 4, 1, 40);
    EXPECT_GT(pieces_of(*world.frame().cloths[0].model), 1u) << "load " << load_of(world);
}

// Unsolved stretch reads as load, so stiff cloth tears too early with few substeps.
TEST(Tearing, of_cotton_begins_nearer_to_its_strength_with_more_substeps) {
    double before = 0;
    for (const std::uint32_t substeps : {20u, 40u, 80u}) {
        const auto model =
            make_strip({.resolution = {9, 33}, .fabric = find_fabric("cotton")->fabric, .pinned = [](Vec3 x) {
                            return x.y > 0.499f;
                        }});
        const World world = hang(model, 1.2, 0, substeps);
        const double part = 1.2 * std::min(1.0, world.time() / 5);
        RecordProperty("part_of_strength_" + std::to_string(substeps), std::to_string(part));
        EXPECT_GE(part, before);
        before = part;
    }
    EXPECT_NEAR(before, 1, 0.15);
}

// A strip of 1 m × `height` whose long edges are pulled apart slowly by keyed pins; cut in from the left by `notch` m.
struct Pulled {
    World world;
    ClothId id;
    float height = 0;
    double begun = 0;  // strain when the rip first grew; 0: never

    double strain() const { return rate * world.time(); }
    static constexpr double rate = 0.16;  // 1/s
};

struct PullDesc {
    std::uint32_t cells = 16;  // along the height
    std::uint32_t substeps = 20;
    float height = 0.25f, notch = 0.4f, jitter = 0;
    StretchModel stretch = StretchModel::edges;
};

Pulled pull_apart(const PullDesc& desc, double until) {
    const auto at_edge = [&](Vec3 x) { return std::abs(x.y) > 0.4999f * desc.height; };
    const auto along = static_cast<std::uint32_t>(std::lround(static_cast<float>(desc.cells) / desc.height));
    const auto model = make_strip({.size = {1, desc.height},
                                   .resolution = {along + 1, desc.cells + 1},
                                   .jitter = desc.jitter,
                                   .fabric = rubber(desc.stretch),
                                   .pinned = at_edge});
    KinematicTargets targets;
    const float speed = 0.5f * static_cast<float>(Pulled::rate) * desc.height;
    for (const float way : {-1.0f, 1.0f})
        targets.motions.push_back({.offsets = {{0, {}}, {100, {0, way * 100 * speed, 0}}}});
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const Vec3 x = model->rest_position(p);
        if (at_edge(x)) targets.particles.push_back({p, x.y > 0 ? 1u : 0u, x});
    }
    Pulled pulled{make_world({.gravity = {}, .solver = {.substeps = desc.substeps, .projection = Projection::lines}}),
                  {},
                  desc.height};
    pulled.id = pulled.world.add(model, targets);
    const std::vector<Vec3> stroke{{-0.51f, 0, 0}, {-0.5f + desc.notch, 0, 0}};
    const auto openings = openings_along_stroke(*model, model->start, stroke);
    EXPECT_TRUE(pulled.world.edit(pulled.id, {.openings = openings}).ok());
    const std::size_t cut = pulled.world.model(pulled.id)->copied_from.size();
    while (pulled.strain() < until && pulled.begun == 0) {
        pulled.world.step(1.0 / 60);
        if (pulled.world.frame().cloths[0].model->copied_from.size() > cut) pulled.begun = pulled.strain();
    }
    return pulled;
}

// Rivlin and Thomas 1953: ahead of a long cut the strip is stretched evenly, and a rip that runs on frees the energy
// of the strip, ½ K ε² per area, times its height. K is the stiffness of a strip that cannot contract: of springs along
// edges that of the threads and the diagonals, of a membrane that of the threads.
TEST(Tearing, of_a_strip_pulled_apart_begins_when_it_frees_the_energy_of_the_rip) {
    const Fabric fabric = rubber();
    const double edges = StretchLaw(fabric.stretch).softest_spring() + static_cast<double>(fabric.stretch.shear),
                 membrane = fabric.stretch.stretch[1];
    double least = 2, most = 0;
    for (const PullDesc& desc :
         {PullDesc{.cells = 8, .substeps = 20}, PullDesc{.cells = 16, .substeps = 40},
          PullDesc{.cells = 32, .substeps = 80}, PullDesc{.cells = 16, .substeps = 80, .jitter = 0.25f},
          PullDesc{.cells = 16, .substeps = 40, .stretch = StretchModel::membrane},
          PullDesc{.cells = 16, .substeps = 80, .jitter = 0.25f, .stretch = StretchModel::membrane}}) {
        const double stiffness = desc.stretch == StretchModel::membrane ? membrane : edges;
        const double expected = std::sqrt(2 * static_cast<double>(fabric.tear.tear_energy) / (stiffness * 0.25));
        const Pulled pulled = pull_apart(desc, 2 * expected);
        RecordProperty("strain_" + std::to_string(desc.cells) + (desc.jitter > 0 ? "_irregular" : "") +
                           (desc.stretch == StretchModel::membrane ? "_membrane" : ""),
                       std::to_string(pulled.begun) + " of " + std::to_string(expected));
        EXPECT_NEAR(pulled.begun, expected, 0.15 * expected) << desc.cells << " cells, moved by " << desc.jitter;
        least = std::min(least, pulled.begun / expected), most = std::max(most, pulled.begun / expected);
    }
    EXPECT_LT(most, 1.15 * least);
}

// Labels: slow no-asan
TEST(Tearing, of_notches_begins_at_a_load_that_falls_with_the_root_of_their_length) {
    double begun[2];
    for (const int longer : {0, 1})
        begun[longer] =
            pull_apart({.cells = 64, .substeps = 80, .height = 1, .notch = longer ? 0.125f : 0.0625f}, 1).begun;
    EXPECT_NEAR(begun[0] / begun[1], std::sqrt(2.0), 0.1 * std::sqrt(2.0));
}

// A square sheet of which a band across its middle is free, `degrees` off the mesh. The sheet is cut in along the band
// and pulled apart across it.
// Labels: slow no-asan
TEST(Tearing, runs_straight_across_the_pull_whatever_the_direction_of_the_mesh) {
    constexpr float half = 0.12f;
    for (const double degrees : {0.0, 20.0, 45.0}) {
        const float c = static_cast<float>(std::cos(degrees * std::numbers::pi / 180)),
                    s = static_cast<float>(std::sin(degrees * std::numbers::pi / 180));
        const auto along = [&](Vec3 x) { return c * x.x + s * x.y; };
        const auto across = [&](Vec3 x) { return c * x.y - s * x.x; };
        const auto model =
            make_strip({.size = {1, 1}, .resolution = {49, 49}, .fabric = rubber(), .pinned = [&](Vec3 x) {
                            return std::abs(across(x)) > half;
                        }});
        KinematicTargets targets;
        for (const float way : {-1.0f, 1.0f})
            targets.motions.push_back({.offsets = {{0, {}}, {10, {-s * way * 0.2f, c * way * 0.2f, 0}}}});
        for (std::uint32_t p = 0; p < model->particle_count; ++p) {
            const Vec3 x = model->rest_position(p);
            if (std::abs(across(x)) > half) targets.particles.push_back({p, across(x) > 0 ? 1u : 0u, x});
        }
        World world = make_world({.gravity = {}, .solver = {.substeps = 40, .projection = Projection::lines}});
        const ClothId id = world.add(model, targets);
        const std::vector<Vec3> stroke{{-0.7f * c, -0.7f * s, 0}, {-0.2f * c, -0.2f * s, 0}};
        ASSERT_TRUE(world.edit(id, {.openings = openings_along_stroke(*model, model->start, stroke)}).ok());
        const std::size_t cut = world.model(id)->copied_from.size();
        while (world.time() < 10 && pieces_of(*world.frame().cloths[0].model) < 2) world.step(1.0 / 60);
        const ClothModel& torn = *world.frame().cloths[0].model;
        EXPECT_EQ(pieces_of(torn), 2u) << degrees;
        double sum = 0, farthest = 0, xx = 0, xy = 0, mean_x = 0, mean_y = 0;
        for (std::size_t i = cut; i < torn.copied_from.size(); ++i) {
            const Vec3 x = torn.rest_position(torn.copied_from[i]);
            farthest = std::max(farthest, static_cast<double>(std::abs(across(x))));
            mean_x += static_cast<double>(along(x)), mean_y += static_cast<double>(across(x)), ++sum;
        }
        mean_x /= sum, mean_y /= sum;
        for (std::size_t i = cut; i < torn.copied_from.size(); ++i) {
            const Vec3 x = torn.rest_position(torn.copied_from[i]);
            const double dx = static_cast<double>(along(x)) - mean_x, dy = static_cast<double>(across(x)) - mean_y;
            xx += dx * dx, xy += dx * dy;
        }
        EXPECT_GT(sum, 25);
        EXPECT_LT(farthest * 48, 1.5) << degrees << " degrees: edges off the line";
        EXPECT_LT(std::abs(std::atan(xy / xx)) * 180 / std::numbers::pi, 5) << degrees;
    }
}

// A sheet that hangs by its upper row, under 250 times its weight.
std::shared_ptr<const ClothModel> make_heavy_sheet(float jitter = 0, SelfCollision self_collision = {},
                                                   bool erodes = false, StretchModel stretch = StretchModel::edges) {
    const std::uint32_t side = self_collision == SelfCollision::off ? 17 : 9;
    Fabric fabric = rubber(stretch);
    if (erodes) fabric.tear.tear_ratio = 1.4f;
    return make_strip({.size = {0.5f, 0.5f},
                       .resolution = {side, side},
                       .jitter = jitter,
                       .fabric = fabric,
                       .pinned = [](Vec3 x) { return x.y > 0.249f; },
                       .self_collision = self_collision,
                       .erodes = erodes});
}
WorldSettings heavy() {
    return {.gravity = {100, -5000, 60},
            .solver = {.substeps = 10, .projection = Projection::lines, .hierarchy = true}};
}

TearPaint seam_along(const ClothModel& model, Vec3 normal, float strength, float energy) {
    TearPaint paint;
    for (const Opening& opening : openings_along_plane(model, model.start, {0, 0.001f, 0}, normal))
        for (const std::uint32_t link : opening.links)
            if (link != none) paint.seams.push_back({link, strength, energy, normal});
    return paint;
}

// With a weak seam across it, a strong one along it, and particles of different resistance.
std::shared_ptr<const ClothModel> painted_sheet(const ClothModel& whole) {
    TearPaint paint = seam_along(whole, {0, 1, 0}, 150, 60);
    for (TearPaint::Link strong : seam_along(whole, {1, 0, 0}, 1e6f, 0).seams) paint.seams.push_back(strong);
    for (std::uint32_t p = 0; p < whole.particle_count; ++p)
        paint.resistance.push_back(0.5f + 0.25f * static_cast<float>(p % 7));
    return with_tear_paint(whole, std::make_shared<const TearPaint>(std::move(paint)));
}

class TearingState : public ::testing::TestWithParam<const char*> {};

// Labels: no-asan
TEST_P(TearingState, goes_on_with_the_same_bits_after_a_restore_and_in_every_number_of_threads) {
    const std::string_view kind = GetParam();
    const bool painted = kind == "painted", membrane = kind == "membrane";
    auto model = make_heavy_sheet(0, {}, kind == "eroding", membrane ? StretchModel::membrane : StretchModel::edges);
    if (painted) model = painted_sheet(*model);
    const auto opened = [](const World& world) { return open_edges(*world.frame().cloths[0].model).size(); };
    std::string hash;
    for (const unsigned workers : {0u, 1u, 3u}) {
        World world = make_world(heavy(), CpuOptions{.workers = workers});
        world.add(model);
        while (!painted && opened(world) < 4) world.step(1.0 / 60);  // the painted one parts within one frame
        const Snapshot middle = world.save();
        const std::size_t before = opened(world);
        run(world, 0.1);
        EXPECT_GT(opened(world), before) << "it was tearing";
        if (hash.empty()) hash = world.state_hash();
        EXPECT_EQ(world.state_hash(), hash) << workers << " workers";
        World other = make_world(heavy(), CpuOptions{.workers = workers});
        other.add(model);
        ASSERT_TRUE(other.restore(*snapshot_from_bytes(to_bytes(middle))).ok());
        run(other, 0.1);
        EXPECT_EQ(other.state_hash(), hash);
        ASSERT_TRUE(world.restore(middle).ok()) << "back to fewer particles";
        run(world, 0.1);
        EXPECT_EQ(world.state_hash(), hash);
    }
}

// Coarse levels are pruned in the frames of a tear. They are built again once the cloth tears no more, and after eight
// frames at the latest; a restored world knows when.
TEST(Tearing, builds_coarse_levels_again_in_the_same_frame_after_a_restore) {
    World world = make_world(heavy());
    world.add(make_heavy_sheet());
    const auto is_pruned = [](const World& of) { return of.frame().cloths[0].model->pruned != nullptr; };
    int pruned = 0, longest = 0, built_again = 0;
    for (int i = 0; i < 40; ++i) {
        const bool before = is_pruned(world);
        const Snapshot now = world.save();
        world.step(1.0 / 60);
        pruned = is_pruned(world) ? pruned + 1 : 0;
        longest = std::max(longest, pruned);
        built_again += before && !is_pruned(world);
        if (!before) continue;
        World other = make_world(heavy());
        other.add(make_heavy_sheet());
        ASSERT_TRUE(other.restore(*snapshot_from_bytes(to_bytes(now))).ok());
        EXPECT_TRUE(is_pruned(other));
        other.step(1.0 / 60);
        EXPECT_EQ(is_pruned(other), is_pruned(world)) << "frame " << i;
        EXPECT_EQ(other.state_hash(), world.state_hash()) << "frame " << i;
    }
    EXPECT_GT(longest, 0);
    EXPECT_LE(longest, 8);
    EXPECT_GT(built_again, 0);
}

INSTANTIATE_TEST_SUITE_P(, TearingState, ::testing::Values("splitting", "eroding", "painted", "membrane"));

TEST(Tearing, changes_no_bit_where_nothing_tears) {
    const auto hash_with = [](bool tears) {
        TriangleMesh mesh = make_grid({1, 1}, {33, 33}, GridDiagonal::alternating);
        ClothModelDesc desc{.name = "sheet", .layout = {.lines = true, .hierarchy = true}};
        if (tears) desc.reserve = {.particles = 100, .openings = true, .tears = true};
        desc.pins.particles = {0, 32};
        auto topology = build_topology(mesh, {.reorder = false});
        desc.mesh = std::move(mesh);
        World world = make_world({.solver = {.substeps = 10, .hierarchy = true}, .air = AirDesc{}});
        world.add(*build_cloth_model(std::move(desc), std::move(*topology)));
        run(world, 0.5);
        EXPECT_TRUE(world.frame().cloths[0].model->copied_from.empty());
        return world.state_hash();
    };
    EXPECT_EQ(hash_with(true), hash_with(false));
}

TEST(Tearing, of_everything_at_once_stays_finite_and_keeps_the_mass) {
    Fabric weak = rubber();
    weak.tear = {.strength = {1e-3f, 1e-3f}, .tear_energy = 1e-9f, .tear_ratio = 1};
    for (const float jitter : {0.0f, 0.3f}) {
        const auto model = make_strip(
            {.size = {0.5f, 0.5f}, .resolution = {17, 17}, .jitter = jitter, .fabric = weak, .pinned = [](Vec3 x) {
                 return x.y > 0.249f;
             }});
        World world = make_world(heavy());
        world.add(model);
        run(world, 0.3);
        const ClothFrame& cloth = world.frame().cloths[0];
        EXPECT_EQ(world.frame().reports & report_non_finite, report_none);
        EXPECT_GT(cloth.model->copied_from.size(), 300u);
        double before = 0, after = 0;
        for (const float mass : model->mass) before += static_cast<double>(mass);
        for (const float mass : cloth.model->mass) after += static_cast<double>(mass);
        EXPECT_NEAR(after, before, 1e-5 * before);
    }
}

// A strip of 0.25 × 1 m pulled apart along y until it parts. Returns the mean tension of the frame before, N/m, and the
// rest positions of the particles that were copied.
struct Parted {
    double tension = 0, strain = 0;
    std::vector<Vec3> copied;
    std::uint32_t pieces = 0;
    std::shared_ptr<const ClothModel> model;
};

Parted pull_until_it_parts(const std::shared_ptr<const ClothModel>& model, std::uint32_t substeps = 20) {
    KinematicTargets targets;
    for (const float way : {-1.0f, 1.0f}) targets.motions.push_back({.offsets = {{0, {}}, {10, {0, way * 0.5f, 0}}}});
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const Vec3 x = model->rest_position(p);
        if (std::abs(x.y) > 0.4999f) targets.particles.push_back({p, x.y > 0 ? 1u : 0u, x});
    }
    World world = make_world({.gravity = {}, .solver = {.substeps = substeps, .projection = Projection::lines}});
    world.add(model, targets);
    Parted parted;
    while (world.time() < 10) {
        if (world.frame().cloths[0].model->copied_from.empty()) {
            parted.tension = TensionMeter().measure(world.frame()).mean.value();
            parted.strain = 0.1 * world.time();
        }
        world.step(1.0 / 60);
        parted.pieces = pieces_of(*world.frame().cloths[0].model);
        if (parted.pieces > 1) break;
    }
    parted.model = std::make_shared<const ClothModel>(*world.frame().cloths[0].model);
    for (const std::uint32_t p : parted.model->copied_from) parted.copied.push_back(parted.model->rest_position(p));
    return parted;
}

StripDesc strip_to_pull() {
    Fabric fabric = rubber();
    fabric.tear = {.strength = {300, 300}, .tear_energy = 40, .tear_ratio = 0};
    return {.resolution = {9, 33}, .fabric = fabric, .pinned = [](Vec3 x) { return std::abs(x.y) > 0.4999f; }};
}

// The tension across a seam at 45° is half of that along the strip.
TEST(Tearing, opens_a_seam_where_the_tension_across_it_is_its_strength) {
    const auto whole = make_strip(strip_to_pull());
    const float strength = 0.3f * whole->fabric.tear.strength[1];
    for (const bool slanted : {false, true}) {
        const Vec3 normal = slanted ? Vec3{std::sqrt(0.5f), std::sqrt(0.5f), 0} : Vec3{0, 1, 0};
        const auto model =
            with_tear_paint(*whole, std::make_shared<const TearPaint>(seam_along(*whole, normal, strength, 0)));
        const Parted parted = pull_until_it_parts(model);
        EXPECT_EQ(parted.pieces, 2u);
        for (const Vec3 x : parted.copied) EXPECT_LT(std::abs(dot(x, normal)), 0.75f / 32) << "along the seam";
        const double expected = double{strength} * (slanted ? 2 : 1);
        EXPECT_NEAR(parted.tension, expected, (slanted ? 0.25 : 0.1) * expected) << slanted;
    }
}

// The band of painted particles is narrow, so the strip parts there and nowhere else.
TEST(Tearing, begins_where_the_cloth_is_painted_weak) {
    const auto whole = make_strip(strip_to_pull());
    TearPaint paint{.seams = {}, .resistance = std::vector<float>(whole->particle_count, 1.0f)};
    for (std::uint32_t p = 0; p < whole->particle_count; ++p)
        if (std::abs(whole->rest_position(p).y - 0.2f) < 0.04f) paint.resistance[p] = 0.4f;
    const auto model = with_tear_paint(*whole, std::make_shared<const TearPaint>(std::move(paint)));
    const Parted parted = pull_until_it_parts(model);
    EXPECT_GE(parted.pieces, 2u);
    const double expected = 0.4 * double{whole->fabric.tear.strength[1]};
    EXPECT_NEAR(parted.tension, expected, 0.15 * expected);
    ASSERT_FALSE(parted.copied.empty());
    EXPECT_NEAR(double{parted.copied[0].y}, 0.2, 0.04);
}

TEST(Tearing, runs_along_no_seam_that_is_stronger_than_the_cloth) {
    const auto whole = make_strip(strip_to_pull());
    TearPaint paint = seam_along(*whole, {0, 1, 0}, 100 * whole->fabric.tear.strength[1], 0);
    const std::vector<TearPaint::Link> seam = paint.seams;
    paint.resistance.assign(whole->particle_count, 1.0f);
    for (std::uint32_t p = 0; p < whole->particle_count; ++p)
        if (std::abs(whole->rest_position(p).y) < 0.001f) paint.resistance[p] = 0.4f;  // so that it begins at the seam
    const auto model = with_tear_paint(*whole, std::make_shared<const TearPaint>(std::move(paint)));
    const Parted parted = pull_until_it_parts(model);
    EXPECT_GE(parted.pieces, 2u);
    const auto& entries = model->tears->entries;
    for (const TearPaint::Link& link : seam) {
        const TearTable::Entry& entry = entries[link.link];
        EXPECT_EQ(parted.model->faces[entry.corner], parted.model->faces[entries[entry.next].corner]);
        EXPECT_EQ(parted.model->faces[entry.far], parted.model->faces[entry.next_far]);
    }
}

// Removed triangles leave no edge longer than the ratio for more than some frames, and no mass but theirs is lost.
TEST(Tearing, by_erosion_removes_the_triangles_that_are_too_long) {
    for (const float jitter : {0.0f, 0.25f}) {
        StripDesc desc = strip_to_pull();
        desc.jitter = jitter;
        desc.fabric.tear.tear_ratio = 1.2f;
        desc.erodes = true;
        const auto model = make_strip(desc);
        const Parted parted = pull_until_it_parts(model);
        EXPECT_GE(parted.pieces, 2u);
        EXPECT_NEAR(parted.strain, 0.2, 0.06);
    }
}

#ifdef WEFT_VULKAN
struct BothBackends {
    float jitter = 0;
    bool wind = false;
    SelfCollision self_collision = SelfCollision::off;
    bool erodes = false, painted = false;
    StretchModel stretch = StretchModel::edges;
};

// Labels: slow no-asan
TEST(Tearing, is_the_same_on_both_backends) {
    for (const BothBackends& both :
         {BothBackends{}, BothBackends{.jitter = 0.25f, .wind = true},
          BothBackends{.self_collision = SelfCollision::exact}, BothBackends{.self_collision = SelfCollision::fast},
          BothBackends{.erodes = true}, BothBackends{.jitter = 0.25f, .erodes = true}, BothBackends{.painted = true},
          BothBackends{.jitter = 0.25f, .stretch = StretchModel::membrane},
          BothBackends{.jitter = 0.25f, .erodes = true, .stretch = StretchModel::membrane}}) {
        // Each takes seconds on a software device.
        const bool tried = both.wind || both.painted || both.self_collision == SelfCollision::exact ||
                           both.stretch == StretchModel::membrane;
        if (!tried && !std::getenv("WEFT_LONG_TESTS")) continue;
        auto model = make_heavy_sheet(both.jitter, both.self_collision, both.erodes, both.stretch);
        if (both.painted) model = painted_sheet(*model);
        WorldSettings settings = heavy();
        if (both.wind) settings.air = AirDesc{.wind = {WindDesc{}}};
        settings.list_capacity = 4;  // so that frames with tears are repeated
        std::uint64_t repeats = 0;
        const auto hash_of = [&](World world) {
            world.add(model);
            for (int i = 0; i < 10; ++i) repeats += world.step(1.0 / 60).lists.repeats;
            EXPECT_GT(open_edges(*world.frame().cloths[0].model).size(), 4u);
            return world.state_hash();
        };
        World device(checked_vulkan_backend({}), settings);
        const bool exact = rounds_like_the_cpu(device);
        const std::string on_device = hash_of(std::move(device)), on_cpu = hash_of(make_world(settings, CpuOptions{}));
        if (exact) {
            EXPECT_EQ(on_device, on_cpu) << both.jitter << both.wind << static_cast<int>(both.self_collision)
                                         << both.erodes << static_cast<int>(both.stretch);
        }
        EXPECT_EQ(repeats > 0, both.self_collision != SelfCollision::off);
    }
}
#endif

}  // namespace
}  // namespace weft::physical
