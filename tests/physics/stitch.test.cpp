// Stitched cloths hang like one cloth, are stepped together, and separate when the stitches are removed.

#include "sheet.h"

#include <cmath>

namespace weft::physical {
namespace {

constexpr std::uint32_t side = 9;  // vertices along each side of a patch of half a meter

// A patch that hangs in the plane z = 0, its center at (x, y). Particle (column, row) is row · side + column, row 0 on
// top.
SheetDesc patch(float x, float y, bool pinned) {
    SheetDesc sheet{
        .size = {0.5f, 0.5f}, .resolution = {side, side}, .rotation_degrees = {90, 0, 0}, .position = {x, y, 0}};
    if (pinned) sheet.pinned = [](Vec3 p) { return p.z < -0.249f; };
    return sheet;
}

StitchPoint vertex(std::uint32_t column, std::uint32_t row) {
    return {.particles = {row * side + column, 0, 0}};
}

struct Patchwork {
    World world;
    std::array<ClothId, 4> cloths;  ///< upper left, upper right, lower left, lower right
    std::vector<Stitch> stitches;
};

// Four patches that meet at (0, 0), stitched along all four seams.
Patchwork fill(World world, float compliance) {
    Patchwork work{std::move(world), {}, {}};
    for (std::size_t i = 0; i < 4; ++i)
        work.cloths[i] = work.world.add(make_sheet(patch(i % 2 ? 0.25f : -0.25f, i < 2 ? 0.25f : -0.25f, i < 2)));
    const auto sew = [&](std::size_t a, std::size_t b, StitchPoint from, StitchPoint to) {
        work.stitches.push_back({work.cloths[a], work.cloths[b], from, to, 0, compliance});
    };
    for (std::uint32_t k = 0; k < side; ++k) {
        sew(0, 1, vertex(side - 1, k), vertex(0, k));
        sew(2, 3, vertex(side - 1, k), vertex(0, k));
        sew(0, 2, vertex(k, side - 1), vertex(k, 0));
        sew(1, 3, vertex(k, side - 1), vertex(k, 0));
    }
    return work;
}

Patchwork make_patchwork(const WorldSettings& settings = {.solver = {.substeps = 20}}, float compliance = 0) {
    return fill(make_world(settings), compliance);
}

double gap(const World& world, const Stitch& stitch) {
    const auto place = [&](ClothId id, const StitchPoint& point) {
        for (const ClothFrame& cloth : world.frame().cloths) {
            if (cloth.id != id) continue;
            Vec3 x{};
            for (int k = 0; k < 3; ++k) x += cloth.positions[point.particles[k]].xyz() * point.shares[k];
            return x;
        }
        return Vec3{};
    };
    return length(place(stitch.a, stitch.from) - place(stitch.b, stitch.to));
}

double widest_gap(const Patchwork& work) {
    double widest = 0;
    for (const Stitch& stitch : work.stitches) widest = std::max(widest, gap(work.world, stitch));
    return widest;
}

float lowest(const World& world) {
    float y = 1e9f;
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const Vec4& p : cloth.positions) y = std::min(y, p.y);
    return y;
}

// Labels on Vulkan: long
TEST(Stitches, make_a_patchwork_hang_as_one) {
    Patchwork work = make_patchwork();
    EXPECT_EQ(work.world.island_count(), 4u);
    work.world.add(work.stitches);
    ASSERT_EQ(work.world.island_count(), 1u);
    for (int i = 0; i < 120; ++i) work.world.step(1.0 / 60);
    EXPECT_LT(widest_gap(work), 1e-4);
    // Within 0.5 % of its length, a single sheet of one meter sags by as much.
    EXPECT_NEAR(lowest(work.world), -0.5f, 0.01f);
    EXPECT_LT(work.world.measure().strain.stretch.mean, 0.005);
    EXPECT_EQ(work.world.frame().reports, 0u);
}

TEST(Stitches, let_go_when_they_are_removed) {
    Patchwork work = make_patchwork();
    const StitchId id = work.world.add(work.stitches);
    for (int i = 0; i < 10; ++i) work.world.step(1.0 / 60);
    work.world.remove(id);
    EXPECT_EQ(work.world.island_count(), 4u);
    for (int i = 0; i < 30; ++i) work.world.step(1.0 / 60);
    EXPECT_LT(lowest(work.world), -1.5f) << "the lower patches have nothing to hold on to";
}

TEST(Stitches, go_with_a_cloth_of_theirs) {
    Patchwork work = make_patchwork();
    const StitchId id = work.world.add(work.stitches);
    work.world.remove(work.cloths[2]);
    EXPECT_FALSE(work.world.contains(id));
    for (int i = 0; i < 10; ++i) work.world.step(1.0 / 60);
    EXPECT_EQ(work.world.frame().reports, 0u);
}

TEST(Stitches, with_compliance_give_way_by_their_share_of_the_weight) {
    constexpr float compliance = 0.02f;
    Patchwork work = make_patchwork({.solver = {.substeps = 20}}, compliance);
    work.world.add(work.stitches);
    for (int i = 0; i < 600; ++i) work.world.step(1.0 / 60);
    // The lower half hangs by 18 stitches.
    const double weight = 0.14 * 0.5 * 9.81;
    double mean = 0;
    for (const Stitch& stitch : work.stitches)
        if (stitch.from.particles[0] >= side * (side - 1) && stitch.a != work.cloths[2])
            mean += gap(work.world, stitch);
    EXPECT_NEAR(mean / 18, compliance * weight / 18, 0.1 * compliance * weight / 18);
}

// Labels on Vulkan: long
TEST(Stitches, between_points_inside_triangles_hold) {
    Patchwork work = make_patchwork();
    const auto inside = [](std::uint32_t column, std::uint32_t row) {
        const std::uint32_t p = row * side + column;
        return StitchPoint{.particles = {p, p + 1, p + side}, .shares = {0.25f, 0.35f, 0.4f}};
    };
    work.stitches.clear();
    for (std::uint32_t k = 0; k + 1 < side; ++k) {
        work.stitches.push_back({work.cloths[0], work.cloths[2], inside(k, side - 2), inside(k, 0), 0.06f, 0});
        work.stitches.push_back({work.cloths[1], work.cloths[3], inside(k, side - 2), inside(k, 0), 0.06f, 0});
    }
    work.world.add(work.stitches);
    for (int i = 0; i < 120; ++i) work.world.step(1.0 / 60);
    for (const Stitch& stitch : work.stitches) EXPECT_NEAR(gap(work.world, stitch), 0.06, 2e-3);
}

TEST(Stitches, of_one_cloth_close_it_to_a_tube) {
    World world = make_world({.solver = {.substeps = 20}});
    const ClothId id = world.add(make_sheet(patch(0, 0, true)));
    std::vector<Stitch> seam;
    for (std::uint32_t k = 1; k < side; ++k) seam.push_back({id, id, vertex(0, k), vertex(side - 1, k)});
    world.add(seam);
    for (int i = 0; i < 240; ++i) world.step(1.0 / 60);
    for (const Stitch& stitch : seam) EXPECT_LT(gap(world, stitch), stitch.from.particles[0] < 2 * side ? 0.02 : 2e-3);
    EXPECT_EQ(world.frame().reports, 0u);
}

// Labels: slow no-asan
TEST(Stitches, have_the_same_bits_on_every_thread_count) {
    const auto hash = [](unsigned workers) {
        Patchwork work = fill(make_world({.solver = {.substeps = 20}}, CpuOptions{.workers = workers}), 0);
        work.world.add(work.stitches);
        for (int i = 0; i < 20; ++i) work.world.step(1.0 / 60);
        return work.world.state_hash();
    };
    const std::string one = hash(0);
    for (const unsigned workers : {1u, 2u, 3u}) EXPECT_EQ(hash(workers), one) << workers;
}

TEST(Stitches, are_part_of_what_a_restored_state_goes_on_with) {
    Patchwork work = make_patchwork();
    work.world.add(work.stitches);
    for (int i = 0; i < 15; ++i) work.world.step(1.0 / 60);
    const Snapshot saved = work.world.save();
    for (int i = 0; i < 15; ++i) work.world.step(1.0 / 60);
    const std::string hash = work.world.state_hash();
    ASSERT_TRUE(work.world.restore(saved).ok());
    for (int i = 0; i < 15; ++i) work.world.step(1.0 / 60);
    EXPECT_EQ(work.world.state_hash(), hash);
}

TEST(Stitches, of_a_cloth_that_is_not_finite_take_the_island_back) {
    Patchwork work = make_patchwork();
    work.world.add(work.stitches);
    for (int i = 0; i < 5; ++i) work.world.step(1.0 / 60);
    const std::string before = work.world.state_hash();
    WorldSettings settings = work.world.settings();
    settings.gravity.y = std::nanf("");
    work.world.configure(settings);
    const Frame& frame = work.world.step(1.0 / 60);
    for (const ClothFrame& cloth : frame.cloths) {
        EXPECT_TRUE(cloth.reports & report_non_finite);
        EXPECT_EQ(cloth.detail, "gravity is not finite");
    }
    EXPECT_EQ(work.world.state_hash(), before);
}

// Labels on Vulkan: long
TEST(Stitches, survive_iterations_methods_and_projections) {
    for (const Method method : {Method::xpbd, Method::pbd}) {
        for (const Projection projection : {Projection::lines, Projection::gauss_seidel, Projection::jacobi}) {
            if (method == Method::pbd && projection == Projection::lines) continue;
            Patchwork work = make_patchwork(
                {.solver = {.substeps = 10, .iterations = 2, .method = method, .projection = projection}}, 1e-5f);
            work.world.add(work.stitches);
            for (int i = 0; i < 60; ++i) work.world.step(1.0 / 60);
            EXPECT_EQ(work.world.frame().reports, 0u);
            EXPECT_LT(widest_gap(work), 5e-3);
        }
    }
}

}  // namespace
}  // namespace weft::physical
