// Factors on the thickness of a fabric, at places of the cloth.

#ifdef WEFT_VULKAN
#include "backend_runs.h"
#endif
#include "../bodies/body_worlds.h"
#include "falling_cloth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::physical {
namespace {

// A power of two, so that multiplying with it rounds nothing.
constexpr float thicker = 4, plain_thickness = 0.002f;

float everywhere(Vec3) {
    return thicker;
}
float in_stripes(Vec3 p) {
    return static_cast<int>(std::floor(6 * (p.x + 0.5f))) % 2 == 0 ? 0.5f : 3.0f;
}

Collider sticky_post() {
    Collider post = make_collider({.shape = SphereDesc{0.05f}, .transform = {.position = {0.3f, 0.1f, -0.2f}}});
    post.adhesion = Adhesion{0.004f, 0};
    return post;
}

/// A sheet that falls on a ground, a box, a small ball and a post that sticks, and bodies that fall on it.
void add_everything(World& world, SheetDesc sheet) {
    add_ground(world);
    world.add(make_collider({.shape = BoxDesc{{0.15f, 0.05f, 0.1f}},
                             .transform = {.position = {-0.2f, 0.05f, 0.1f}, .rotation_degrees = {0, 30, 20}}}));
    world.add(make_collider({.shape = SphereDesc{0.02f}, .transform = {.position = {0.1f, 0.05f, 0.3f}}}));
    world.add(sticky_post());
    for (int i = 0; i < 3; ++i) {
        const float x = 0.2f * static_cast<float>(i - 1);
        world.add(make_ball(0.04f, 0.05f, {x, 0.3f, -x}));
    }
    sheet.position = {0, 0.2f, 0};
    world.add(make_sheet(sheet));
}

SheetDesc falling_sheet(SelfCollision self_collision) {
    SheetDesc sheet = falling(20, {8, 0, 5});
    sheet.self_collision = self_collision;
    sheet.fabric.contact.thickness = plain_thickness;
    return sheet;
}

std::string hash_with_everything(World world, const SheetDesc& sheet, double seconds) {
    add_everything(world, sheet);
    run(world, seconds);
    return world.state_hash();
}

World ten_substeps(const CpuOptions& options = {}) {
    return make_world({.solver = {.substeps = 10}}, options);
}

TEST(Thickness, of_everything_is_another_fabric) {
    for (const SelfCollision with : {SelfCollision::off, SelfCollision::fast, SelfCollision::exact}) {
        SheetDesc painted = falling_sheet(with), other = painted;
        painted.thickness = everywhere;
        other.fabric.contact.thickness *= thicker;
        EXPECT_EQ(hash_with_everything(ten_substeps(), painted, 0.5), hash_with_everything(ten_substeps(), other, 0.5))
            << static_cast<int>(with);
    }
}

// Lists and threads have no effect, with pairs of many thicknesses.
TEST(Thickness, of_stripes_gives_the_same_bits_however_pairs_are_found) {
    for (const SelfCollision with : {SelfCollision::fast, SelfCollision::exact}) {
        SheetDesc sheet = falling_sheet(with);
        sheet.thickness = in_stripes;
        const std::string expected = hash_with_everything(ten_substeps(), sheet, 0.5);
        EXPECT_EQ(hash_with_everything(ten_substeps({.search_always = true}), sheet, 0.5), expected);
        EXPECT_EQ(hash_with_everything(ten_substeps({.workers = 3}), sheet, 0.5), expected);
        EXPECT_EQ(hash_with_everything(ten_substeps({.isa = "scalar"}), sheet, 0.5), expected);
    }
}

#ifdef WEFT_VULKAN
World on_device(bool vulkan) {
    const WorldSettings settings{.solver = {.substeps = 10}};
    return vulkan ? on_vulkan(settings) : on_cpu(settings);
}

// Labels: slow no-asan
TEST(Thickness, of_stripes_is_the_same_on_both_backends) {
    for (const SelfCollision with : {SelfCollision::off, SelfCollision::fast, SelfCollision::exact}) {
        SheetDesc sheet = falling_sheet(with);
        sheet.thickness = in_stripes;
        EXPECT_EQ(hash_with_everything(on_device(true), sheet, 0.4), hash_with_everything(on_device(false), sheet, 0.4))
            << static_cast<int>(with);
    }
}
#endif

/// Heights of the particles of a cloth whose factor is this, m: least and largest.
std::array<double, 2> heights_where(const ClothFrame& cloth, const std::function<float(Vec3)>& thickness,
                                    float factor) {
    std::array<double, 2> range{1e9, -1e9};
    for (std::uint32_t p = 0; p < cloth.positions.size(); ++p) {
        const Vec3 at_rest = cloth.model->rest_position(p);
        if (thickness({at_rest.x, 0, at_rest.z}) != factor) continue;
        const double y = double{cloth.positions[p].y};
        range = {std::min(range[0], y), std::max(range[1], y)};
    }
    return range;
}

float on_one_side(Vec3 p) {
    return p.x < 0 ? 1.0f : 3.0f;
}

// A soft sheet on the ground lies half of its own thickness above it.
TEST(Thickness, keeps_each_place_at_its_own_distance_from_colliders) {
    SheetDesc sheet{.resolution = {33, 33}, .position = {0, 0.01f, 0}, .fabric = find_fabric("silk")->fabric};
    sheet.fabric.contact.thickness = plain_thickness;
    sheet.thickness = on_one_side;
    World world = make_world({.solver = {.substeps = 20}}, sheet);
    add_ground(world);
    run(world, 1);
    const ClothFrame& cloth = world.frame().cloths[0];
    for (const float factor : {1.0f, 3.0f}) {
        const auto [least, most] = heights_where(cloth, on_one_side, factor);
        const double expected = 0.5 * double{plain_thickness} * double{factor};
        EXPECT_NEAR(least, expected, 2e-5);
        // Next to the thick part the thin one hangs from it.
        if (factor > 1) {
            EXPECT_NEAR(most, expected, 2e-5);
        }
    }
}

// Two sheets one on the other: the upper one lies higher by the mean of both thicknesses.
TEST(Thickness, of_a_pair_of_cloths_is_the_mean_of_both) {
    for (const SelfCollision with : {SelfCollision::exact}) {
        World world = make_world({.solver = {.substeps = 20}});
        add_ground(world);
        for (int i = 0; i < 2; ++i) {
            SheetDesc sheet{.resolution = {13, 13},
                            .position = {0.01f * static_cast<float>(i), 0.004f + 0.012f * static_cast<float>(i), 0},
                            .fabric = find_fabric("silk")->fabric,
                            .self_collision = with};
            sheet.fabric.contact.thickness = plain_thickness;
            if (i == 1) sheet.thickness = [](Vec3) { return 3.0f; };
            world.add(make_sheet(sheet));
        }
        run(world, 2);
        std::array<double, 2> middle{};
        for (std::size_t i = 0; i < 2; ++i) {
            for (const Vec4& x : world.frame().cloths[i].positions) middle[i] += double{x.y};
            middle[i] /= static_cast<double>(world.frame().cloths[i].positions.size());
        }
        EXPECT_NEAR(middle[0], 0.001, 5e-5);
        EXPECT_NEAR(middle[1] - middle[0], 0.004, 2e-4);
    }
}

// Spheres of the fast contact are larger where the thickness asks for it.
TEST(Thickness, makes_spheres_of_fast_contact_larger) {
    const auto gap_with = [](float factor) {
        World world = make_world({.solver = {.substeps = 20}});
        add_ground(world);
        for (int i = 0; i < 2; ++i) {
            SheetDesc sheet{.resolution = {9, 9},
                            .position = {0, 0.05f + 0.35f * static_cast<float>(i), 0},
                            .fabric = find_fabric("silk")->fabric,
                            .self_collision = SelfCollision::fast};
            sheet.fabric.contact.thickness = 0.02f;
            if (i == 1) sheet.thickness = [=](Vec3) { return factor; };
            world.add(make_sheet(sheet));
        }
        run(world, 2);
        double least = 1e9;
        for (const Vec4& x : world.frame().cloths[0].positions)
            for (const Vec4& y : world.frame().cloths[1].positions)
                least = std::min(least, double{distance(x.xyz(), y.xyz())});
        return least;
    };
    // Of 1.4 mean edges, 0.19 m, and of a third more.
    const double plain = gap_with(1), large = gap_with(16);
    EXPECT_GT(large, plain + 0.03);
}

SheetDesc tearing_sheet() {
    SheetDesc sheet{.resolution = {17, 17}, .position = {0, 0.0035f, 0}, .layout = {.lines = true, .hierarchy = true}};
    sheet.fabric = find_fabric("silk")->fabric;
    sheet.fabric.contact.thickness = plain_thickness;
    sheet.fabric.stretch = {.stretch = {800, 800}, .compression = {400, 400}, .shear = 20};
    sheet.fabric.tear.strength[0] = sheet.fabric.tear.strength[1] = 1;
    sheet.fabric.tear.tear_energy = 0;
    sheet.pinned = [](Vec3 p) { return p.x < -0.49f; };
    sheet.reserve = {.particles = 512, .openings = true, .tears = true};
    sheet.thickness = [](Vec3 p) { return std::abs(p.z) < 0.3f ? 3.0f : 1.0f; };
    return sheet;
}

/// A sheet on the ground, pinned at one side and pulled to the other one.
WorldSettings pulling(std::uint32_t substeps) {
    return {.gravity = {60, -9.81f, 0}, .solver = {.substeps = substeps}};
}
World with_torn_sheet(World world) {
    add_ground(world);
    world.add(make_sheet(tearing_sheet()));
    return world;
}

// A copy is as thick as its original from the substep on in which it appears.
TEST(Thickness, of_copies_is_that_of_their_originals) {
    World world = with_torn_sheet(make_world(pulling(20)));
    std::size_t copies = 0;
    for (int frame = 0; frame < 20; ++frame) {
        world.step(1.0 / 60);
        const ClothFrame& cloth = world.frame().cloths[0];
        const ClothModel& model = *cloth.model;
        copies = model.copied_from.size();
        const std::uint32_t built = model.particle_count - static_cast<std::uint32_t>(copies);
        for (std::uint32_t p = built; p < model.particle_count; ++p) {
            const float factor = model.thickness_factors[p];
            EXPECT_EQ(factor, model.thickness_factors[model.copied_from[p - built]]);
            EXPECT_GT(cloth.positions[p].y, 0.5f * plain_thickness * factor - 2e-5f) << "frame " << frame;
        }
    }
    EXPECT_GT(copies, 10u);
}

#ifdef WEFT_VULKAN
// Labels: slow no-asan
TEST(Thickness, of_a_torn_cloth_is_the_same_on_both_backends) {
    World cpu = with_torn_sheet(on_cpu(pulling(10))), vulkan = with_torn_sheet(on_vulkan(pulling(10)));
    run(cpu, 0.3), run(vulkan, 0.3);
    EXPECT_GT(cpu.frame().cloths[0].positions.size(), 17u * 17u);
    EXPECT_EQ(vulkan.state_hash(), cpu.state_hash());
}
#endif

TEST(Thickness, must_be_above_0) {
    const TriangleMesh mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::uniform);
    const auto problem = [&](std::vector<float> factors) {
        auto topology = build_topology(mesh, {});
        ClothModelDesc desc{.mesh = mesh, .weights = {.thickness = {.of_particles = std::move(factors)}}};
        const auto built = build_cloth_model(std::move(desc), std::move(*topology));
        return built.ok() ? "" : built.errors()[0].where;
    };
    for (const float bad : {0.0f, -1.0f, std::numeric_limits<float>::infinity(), std::nanf("")})
        EXPECT_EQ(problem(std::vector<float>(9, bad)), "weights of thickness");
    EXPECT_EQ(problem({1, 2}), "weights of thickness");
    EXPECT_EQ(problem(std::vector<float>(9, 1e6f)), "");
}

}  // namespace
}  // namespace weft::physical
