// Stitched cloths with contact: contact does not push their seams apart.

#ifdef WEFT_VULKAN
#include "backend_runs.h"
#endif
#include "falling_cloth.h"

#include <cmath>
#include <numbers>

namespace weft::physical {
namespace {

constexpr std::uint32_t panel_side = 9;  // vertices along each side of half a meter
constexpr float panel_edge = 0.5f / (panel_side - 1);

struct Panels {
    SelfCollision self_collision = SelfCollision::exact;
    float thickness = 0.004f;  ///< m
    float gap = 0, compliance = 0;
    float apart = 0;    ///< m: of the two edges at the start
    bool touch = true;  ///< false: the panels do not collide with each other, only with themselves
};

SheetDesc panel(float y, bool pinned, const Panels& panels) {
    SheetDesc sheet{.size = {0.5f, 0.5f},
                    .resolution = {panel_side, panel_side},
                    .rotation_degrees = {90, 0, 0},
                    .position = {0, y, 0},
                    .self_collision = panels.self_collision};
    sheet.fabric.contact.thickness = panels.thickness;
    if (!panels.touch) sheet.filter = {.groups = pinned ? 1u : 2u, .mask = 4};
    if (pinned) sheet.pinned = [](Vec3 p) { return p.z < -0.249f; };
    return sheet;
}

std::vector<Stitch> stitches(const Panels& panels, ClothId upper, ClothId lower) {
    std::vector<Stitch> made;
    for (std::uint32_t column = 0; column < panel_side; ++column)
        made.push_back({upper,
                        lower,
                        {.particles = {(panel_side - 1) * panel_side + column, 0, 0}},
                        {.particles = {column, 0, 0}},
                        panels.gap,
                        panels.compliance});
    return made;
}

/// One panel hangs by its upper edge, the other one hangs from its lower edge.
StitchId add_panels(World& world, const Panels& panels) {
    const ClothId upper = world.add(make_sheet(panel(0.25f, true, panels)));
    const ClothId lower = world.add(make_sheet(panel(-0.25f - panels.apart, false, panels)));
    return world.add(stitches(panels, upper, lower));
}

/// Least and widest distance of the stitched particles.
std::array<float, 2> seam(const World& world) {
    float least = 1e9f, widest = 0;
    const auto& cloths = world.frame().cloths;
    for (std::uint32_t column = 0; column < panel_side; ++column) {
        const float apart = length(cloths[0].positions[(panel_side - 1) * panel_side + column].xyz() -
                                   cloths[1].positions[column].xyz());
        least = std::min(least, apart), widest = std::max(widest, apart);
    }
    return {least, widest};
}

/// Crossings with the seam's particles as one, as contact takes them.
std::uint64_t crossings_of_welded(const World& world) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    constexpr std::uint32_t count = panel_side * panel_side;
    for (const ClothFrame& cloth : world.frame().cloths) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        const auto welded = [&](std::uint32_t p) {
            return first > 0 && p < panel_side ? count - panel_side + p : first + p;
        };
        for (const Vec4& x : cloth.positions) positions.push_back(x.xyz());
        for (const Triangle t : cloth.triangles) triangles.push_back({welded(t[0]), welded(t[1]), welded(t[2])});
    }
    return count_crossings(positions, triangles).triangles;
}

World hung(const Panels& panels, int frames = 120) {
    World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
    add_panels(world, panels);
    (void)hash_after(world, frames);
    return world;
}

float farthest(const World& a, const World& b) {
    float most = 0;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t p = 0; p < a.frame().cloths[i].positions.size(); ++p)
            most =
                std::max(most, length(a.frame().cloths[i].positions[p].xyz() - b.frame().cloths[i].positions[p].xyz()));
    return most;
}

// Exact contact repeats the constraints, so the motion is compared with that of panels that cannot touch each other.
TEST(SeamContact, hang_as_if_they_could_not_touch) {
    const World off = hung({.self_collision = SelfCollision::off});
    // The last one is thicker than an edge is long.
    for (Panels panels :
         {Panels{}, {.thickness = 0.03f}, {.thickness = 1.2f * panel_edge}, {.self_collision = SelfCollision::fast}}) {
        const World world = hung(panels);
        panels.touch = false;
        EXPECT_EQ(world.state_hash(), hung(panels).state_hash()) << panels.thickness;
        EXPECT_LT(seam(world)[1], 1e-6f) << panels.thickness;
        EXPECT_LT(farthest(world, off), 0.005f) << panels.thickness;
        EXPECT_EQ(world.frame().cloth_contacts.contacts, 0u);
        EXPECT_EQ(world.frame().cloth_contacts.tangled, 0u);
        EXPECT_EQ(crossings(world), 0u);
    }
}

TEST(SeamContact, close_from_a_distance_to_their_gap) {
    for (const SelfCollision self_collision : {SelfCollision::exact, SelfCollision::fast}) {
        for (const float gap : {0.0f, 0.002f}) {
            const Panels panels{
                .self_collision = self_collision, .thickness = 1.2f * panel_edge, .gap = gap, .apart = 0.2f};
            World world = hung(panels, 0);
            ClothContactCounts counts;
            for (int frame = 0; frame < 120; ++frame) counts.add(world.step(1.0 / 60).cloth_contacts);
            EXPECT_NEAR(seam(world)[0], gap, 1e-5f);
            EXPECT_NEAR(seam(world)[1], gap, 1e-5f);
            EXPECT_EQ(counts.contacts, 0u) << "nothing pushes in the last frame";
            EXPECT_EQ(counts.tangled, 0u) << "in any frame";
            EXPECT_EQ(crossings_of_welded(world), 0u);
        }
    }
}

TEST(SeamContact, that_give_hang_as_if_they_could_not_touch) {
    for (const SelfCollision self_collision : {SelfCollision::exact, SelfCollision::fast}) {
        Panels panels{.self_collision = self_collision, .thickness = 0.03f, .compliance = 0.05f};
        const World world = hung(panels);
        EXPECT_GT(seam(world)[0], 0.001f);
        panels.touch = false;
        EXPECT_EQ(world.state_hash(), hung(panels).state_hash());
    }
}

TEST(SeamContact, apart_from_their_stitches_cloths_touch) {
    // The lower panel is folded up behind the upper one and falls against it.
    for (const SelfCollision self_collision : {SelfCollision::exact, SelfCollision::fast}) {
        const Panels panels{.self_collision = self_collision};
        World world = make_world({.gravity = {0, 0, 9.81f}, .solver = {.substeps = 20}}, CpuOptions{});
        SheetDesc upper = panel(0.25f, true, panels);
        upper.pinned = [](Vec3) { return true; };
        SheetDesc lower = panel(-0.25f, false, panels);
        // Its stitched edge is where the upper panel's lower edge is; it rises behind it at an angle.
        lower.shape = [](Vec3 p) {
            const float along = p.z + 0.25f;
            return Vec3{p.x, -0.5f * along, 0.25f - 0.87f * along};
        };
        lower.position = {0, 0, 0};
        const ClothId one = world.add(make_sheet(upper)), two = world.add(make_sheet(lower));
        world.add(stitches(panels, one, two));
        std::uint64_t contacts = 0;
        for (int frame = 0; frame < 60; ++frame) contacts += world.step(1.0 / 60).cloth_contacts.contacts;
        EXPECT_GT(contacts, 0u);
        EXPECT_LT(seam(world)[1], 1e-3f);
        std::uint32_t behind = 0;
        for (std::uint32_t p = 2 * panel_side; p < panel_side * panel_side; ++p)
            behind += world.frame().cloths[1].positions[p].z < 0;
        EXPECT_EQ(behind, panel_side * (panel_side - 2)) << "the sheet has not passed through the other one";
    }
}

TEST(SeamContact, follow_stitches_that_are_added_and_removed) {
    for (const SelfCollision self_collision : {SelfCollision::exact, SelfCollision::fast}) {
        const auto change = [&](bool search_always) {
            World world = make_world({.solver = {.substeps = 6}}, CpuOptions{.search_always = search_always});
            const Panels panels{.self_collision = self_collision, .thickness = 1.2f * panel_edge};
            const StitchId id = add_panels(world, panels);
            (void)hash_after(world, 5);
            EXPECT_EQ(world.frame().cloth_contacts.contacts, 0u);
            world.remove(id);
            std::uint64_t contacts = 0;
            for (int i = 0; i < 3; ++i) contacts += world.step(1.0 / 60).cloth_contacts.contacts;
            EXPECT_GT(contacts, 0u) << "without stitches the edges push each other";
            world.add(stitches(panels, world.cloth_id(0), world.cloth_id(1)));
            (void)hash_after(world, 40);
            EXPECT_EQ(world.frame().cloth_contacts.tangled, 0u);
            EXPECT_LT(seam(world)[1], 1e-3f);
            return world.state_hash();
        };
        EXPECT_EQ(change(false), change(true));
    }
}

TEST(SeamContact, follow_a_change_of_thickness) {
    const auto thicken = [](bool touch) {
        World world = hung({.touch = touch}, 30);
        for (const std::size_t i : {0u, 1u}) {
            Fabric fabric = world.model(world.cloth_id(i))->fabric;
            fabric.contact.thickness = 1.2f * panel_edge;
            auto model = with_fabric(*world.model(world.cloth_id(i)), fabric);
            EXPECT_TRUE(model.ok());
            EXPECT_TRUE(world.set_material(world.cloth_id(i), *model).ok());
        }
        return hash_after(world, 30);
    };
    EXPECT_EQ(thicken(true), thicken(false));
}

TEST(SeamContact, a_tube_of_one_cloth_keeps_its_seam) {
    for (const SelfCollision self_collision : {SelfCollision::exact, SelfCollision::fast}) {
        constexpr std::uint32_t around = 16, along = 6;
        SheetDesc sheet{.size = {1, 0.4f}, .resolution = {around, along}, .self_collision = self_collision};
        sheet.fabric.contact.thickness = 0.03f;
        // A turn of the sheet, so that its two edges are at the same place.
        sheet.shape = [](Vec3 p) {
            const float angle = 2 * std::numbers::pi_v<float> * (p.x + 0.5f), radius = 0.159f;
            return Vec3{radius * std::cos(angle), radius * std::sin(angle), p.z};
        };
        World world = make_world({.gravity = {}, .solver = {.substeps = 10}}, CpuOptions{});
        const ClothId tube = world.add(make_sheet(sheet));
        std::vector<Stitch> made;
        for (std::uint32_t row = 0; row < along; ++row)
            made.push_back(
                {tube, tube, {.particles = {row * around, 0, 0}}, {.particles = {row * around + around - 1, 0, 0}}});
        world.add(made);
        for (int frame = 0; frame < 20; ++frame) {
            const ClothContactCounts& counts = world.step(1.0 / 60).cloth_contacts;
            EXPECT_EQ(counts.contacts, 0u) << frame;
            EXPECT_EQ(counts.tangled, 0u) << frame;
        }
        EXPECT_LT(world.measure().max_speed, 1);
    }
}

#ifdef WEFT_VULKAN

void add_falling_panels(World& world, const Panels& panels) {
    SheetDesc upper = panel(0.6f, false, panels), lower = panel(0.1f, false, panels);
    upper.resolution = lower.resolution = {6, 6};
    upper.rotation_degrees = lower.rotation_degrees = {90, 8, 0};
    upper.velocity = lower.velocity = {0, -4, 0};
    const ClothId one = world.add(make_sheet(upper)), two = world.add(make_sheet(lower));
    std::vector<Stitch> made;
    for (std::uint32_t column = 0; column < 5; ++column) {
        const StitchPoint on_edge{.particles = {column, column + 1, 0}, .shares = {0.5f, 0.5f, 0}};
        made.push_back({one, two, {.particles = {30 + column, 0, 0}}, {.particles = {column, 0, 0}}, panels.gap, 0});
        if (column % 2)
            made.push_back(
                {two, one, on_edge, {.particles = {30 + column, 31 + column, 0}, .shares = {0.5f, 0.5f, 0}}, 0, 1e-4f});
    }
    world.add(made);
    add_ground(world);
}

// Labels: slow no-asan
TEST(SeamContactOnVulkan, are_the_same_as_on_the_cpu) {
    for (const SelfCollision self_collision : {SelfCollision::exact, SelfCollision::fast}) {
        const Panels panels{.self_collision = self_collision, .thickness = 0.12f, .gap = 0.001f};
        World cpu = on_cpu(with_substeps(4)), vulkan = on_vulkan(with_substeps(4));
        add_falling_panels(cpu, panels), add_falling_panels(vulkan, panels);
        const RunOfFrames expected = run_frames(cpu, 12), result = run_frames(vulkan, 12);
        EXPECT_GT(expected.contacts, 0u);
        if (!rounds_like_the_cpu(vulkan)) continue;
        EXPECT_EQ(result.hash, expected.hash);
        EXPECT_EQ(result.contacts, expected.contacts);
        EXPECT_EQ(result.counts.limited, expected.counts.limited);
    }
}

#endif

}  // namespace
}  // namespace weft::physical
