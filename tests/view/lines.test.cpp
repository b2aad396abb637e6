// Overlays of lines and points, compared with known counts.

#include "shown.h"

#include "solver/model/cuts.h"
#include "solver/world/air.h"
#include "view/nice_numbers.h"
#include "view/touches.h"

#include <cmath>
#include <limits>
#include <set>

namespace weft::physical {
namespace {

constexpr double frame_seconds = 1.0 / 60;

float norm(Vec3 v) {
    return length(v);
}

TEST(WireframeOverlay, has_every_edge_once_on_either_side) {
    World world = make_world({}, SheetDesc{});
    Shown shown(world);
    // 8 · 9 each way and 64 diagonals.
    const OverlayOutput output = shown.draw("wireframe");
    ASSERT_EQ(output.lines.size(), 2 * (2 * 72 + 64u));
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (const render::Line& line : output.lines) {
        const auto vertex = [&](Vec3 p) {
            const auto& all = shown.positions();
            const auto nearest = std::ranges::min_element(all, {}, [&](Vec3 q) { return norm(p - q); });
            EXPECT_LT(norm(p - *nearest), 0.01f);
            return static_cast<std::size_t>(nearest - all.begin());
        };
        edges.insert(std::minmax(vertex(line.from), vertex(line.to)));
        EXPECT_GT(std::abs(line.from.y), 0) << "off the surface";
    }
    EXPECT_EQ(edges.size(), 208u);
}

TEST(RimsOverlay, has_both_sides_of_each_open_edge) {
    for (const bool bound : {false, true}) {
        TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::uniform);
        ClothModelDesc desc{.name = "sheet", .reserve = {.particles = 20, .openings = true}};
        auto topology = build_topology(mesh, {.reorder = false});
        desc.mesh = std::move(mesh);
        if (bound) desc.render_mesh = make_grid({1, 1}, {20, 20}, GridDiagonal::alternating);
        World world = make_world({});
        const ClothId id = world.add(*build_cloth_model(std::move(desc), std::move(*topology)));
        EXPECT_TRUE(Shown(world).draw("rims").lines.empty());
        const std::size_t closed = Shown(world).draw("wireframe").lines.size();
        const auto& model = world.model(id);
        ASSERT_TRUE(world.edit(id, {.openings = openings_along_plane(*model, model->start, {}, {1, 0, 0})}).ok());
        Shown shown(world);
        const OverlayOutput output = shown.draw("rims");
        EXPECT_EQ(output.lines.size(), 8u * 2 * 2) << "edges, sides of the cut, sides of the surface";
        for (const render::Line& line : output.lines) EXPECT_NEAR(line.from.x, 0, 0.01f);
        EXPECT_EQ(output.legends[0].entries[0].text, "open edges: 8");
        EXPECT_GE(shown.draw("wireframe").lines.size(), closed + 2 * 8) << "both sides of the cut";
    }
}

TEST(WireframeOverlay, is_that_of_the_mesh_that_is_drawn) {
    World world = make_world({});
    world.add(make_bound_sheet({9, 9}, make_grid({1, 1}, {5, 5}, GridDiagonal::uniform)));
    EXPECT_EQ(Shown(world).draw("wireframe").lines.size(), 2 * (2 * 20 + 16u));

    // Also along seams, where triangles do not share vertices.
    TriangleMesh torn;
    const TriangleMesh whole = make_grid({1, 1}, {5, 5}, GridDiagonal::uniform);
    for (const Triangle& triangle : whole.triangles) {
        const auto first = static_cast<std::uint32_t>(torn.positions.size());
        for (const std::uint32_t v : triangle) torn.positions.push_back(whole.positions[v]);
        torn.triangles.push_back({first, first + 1, first + 2});
    }
    World bound = make_world({});
    bound.add(make_bound_sheet({9, 9}, torn));
    EXPECT_EQ(Shown(bound).draw("wireframe").lines.size(), 2 * (2 * 20 + 16u));
    auto topology = build_topology(torn);
    World welded = make_world({});
    welded.add(*build_cloth_model({.name = "torn", .mesh = torn}, std::move(*topology)));
    EXPECT_EQ(Shown(welded).draw("wireframe").lines.size(), 2 * (2 * 20 + 16u));
}

TEST(NormalsOverlay, has_one_for_each_vertex_and_fewer_on_fine_meshes) {
    World coarse = make_world({}, SheetDesc{.rotation_degrees = {30, 0, 0}});
    Shown shown(coarse);
    const OverlayOutput output = shown.draw("normals");
    ASSERT_EQ(output.lines.size(), 81u);
    for (std::size_t v = 0; v < 81; ++v) {
        EXPECT_EQ(output.lines[v].from, shown.positions()[v]);
        const Vec3 along = output.lines[v].to - output.lines[v].from;
        EXPECT_NEAR(dot(normalized(along), shown.normals()[v]), 1, 1e-5);
    }
    World fine = make_world({}, SheetDesc{.resolution = {201, 201}});
    const std::size_t thinned = Shown(fine).draw("normals").lines.size();
    EXPECT_GT(thinned, 1000u);
    EXPECT_LT(thinned, 2500u);
}

TEST(PinsOverlay, marks_what_is_pinned) {
    World world = make_world({}, SheetDesc{.pinned = [](Vec3 p) { return p.z < -0.49f; }});
    Shown shown(world);
    const OverlayOutput output = shown.draw("pins");
    ASSERT_EQ(output.points.size(), 9u);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(output.points[i].position, shown.positions()[i]);
    EXPECT_EQ(entry(output, 0), "pinned: 9");

    World free = make_world({}, SheetDesc{});
    const OverlayOutput none_pinned = Shown(free).draw("pins");
    EXPECT_TRUE(none_pinned.points.empty());
    EXPECT_EQ(entry(none_pinned, 0), "pinned: 0");
}

TEST(PinsOverlay, tells_what_a_collider_carries_and_what_springs_hold) {
    World world = make_world({.solver = {.substeps = 2}});
    const ColliderId bar = world.add(make_collider({.shape = SphereDesc{0.1f}, .transform = {.position = {0, 3, 0}}}));
    const auto model = make_sheet(
        {.pinned = [](Vec3 p) { return p.z < -0.49f; }, .spring = [](Vec3 p) { return p.z > 0.49f ? 1e-3f : 0.0f; }});
    // Particles 0 and 1, and the first anchor.
    KinematicTargets targets{.motions = {{.collider = bar}}, .particles = {}};
    for (const std::uint32_t p : {0u, 1u}) targets.particles.push_back({p, 0, model->rest_position(p) - Vec3{0, 3, 0}});
    targets.particles.push_back(
        {model->particle_count, 0, model->rest_position(model->particle_count) - Vec3{0, 3, 0}});
    const ClothId id = world.add(model, targets);
    world.move(bar, {{}, {0, 3.5f, 0}});
    world.step(frame_seconds);
    Shown shown(world);
    const OverlayOutput output = shown.draw("pins");
    EXPECT_EQ(entry(output, 0), "pinned: 7");
    EXPECT_EQ(entry(output, 1), "pinned to colliders: 2");
    EXPECT_EQ(entry(output, 2), "held by springs: 9");
    ASSERT_EQ(output.points.size(), 9 + 2 * 9u);
    EXPECT_EQ(output.points[0].color, output.points[1].color);
    EXPECT_NE(output.points[1].color, output.points[2].color);
    ASSERT_EQ(output.lines_on_top.size(), 9u);
    // The anchor on the collider has moved up with it; the others have not moved.
    std::size_t up = 0;
    for (const render::Line& line : output.lines_on_top) {
        up += std::abs(line.to.y - 0.5f) < 1e-5f;
        EXPECT_TRUE(std::abs(line.to.y - 0.5f) < 1e-5f || line.to.y == 0) << line.to.y;
    }
    EXPECT_EQ(up, 1u);
    EXPECT_EQ(world.kinematic_targets(id).particles.size(), 3u);
}

TEST(PinsOverlay, shows_springs_where_keys_have_moved_them) {
    World world = make_world({.solver = {.substeps = 2}});
    const auto model = make_sheet({.spring = [](Vec3 p) { return p.z > 0.49f ? 1e-3f : 0.0f; }});
    const std::uint32_t anchor = model->particle_count + 4;
    world.add(model, {.motions = {{.offsets = {{0, {}}, {2, {0, 1, 0}}}}},
                      .particles = {{anchor, 0, model->rest_position(anchor)}}});
    run(world, 0.5);
    const OverlayOutput output = Shown(world).draw("pins");
    std::size_t up = 0;
    for (const render::Line& line : output.lines_on_top) up += std::abs(line.to.y - 0.25f) < 1e-5f;
    EXPECT_EQ(up, 1u);
    EXPECT_EQ(output.lines_on_top.size(), 9u);
}

TEST(ConstraintsOverlay, has_a_line_for_each_row_in_the_color_of_its_batch) {
    World world = make_world({}, SheetDesc{.pinned = [](Vec3 p) { return p.z < -0.49f; }});
    Shown shown(world);
    const OverlayOutput output = shown.draw("constraints");
    const ClothModel& model = *shown.frame().cloths[0].model;
    const ConstraintTable& stretch = model.table(ConstraintKind::stretch);
    ASSERT_EQ(stretch.rows, 208u);
    std::size_t rows = 0;
    for (const ConstraintTable& table : model.constraints) rows += table.rows;
    EXPECT_EQ(output.lines.size(), 2 * rows);
    EXPECT_EQ(entry(output, 0), "stretch: 208, " + std::to_string(stretch.batches.size()) + " batches");
    // Stretch comes first. Lines of one color do not meet.
    std::set<std::array<float, 3>> colors;
    for (std::size_t i = 0; i < 2 * 208; i += 2) {
        const Vec4 color = output.lines[i].color;
        colors.insert({color.x, color.y, color.z});
        for (std::size_t k = 0; k < i; k += 2) {
            if (!(output.lines[k].color == color)) continue;
            for (const Vec3 end : {output.lines[k].from, output.lines[k].to}) {
                ASSERT_GT(norm(end - output.lines[i].from), 0.01f);
                ASSERT_GT(norm(end - output.lines[i].to), 0.01f);
            }
        }
    }
    EXPECT_EQ(colors.size(), stretch.batches.size());
}

TEST(ConstraintsOverlay, shows_plates_springs_and_rows_along_lines) {
    SheetDesc desc{.layout = {.lines = true}, .spring = [](Vec3 p) { return p.z > 0.49f ? 1e-3f : 0.0f; }};
    desc.fabric.bend.model = BendModel::plate;
    World world = make_world({.solver = {.projection = Projection::lines}}, desc);
    Shown shown(world);
    const ClothModel& model = *shown.frame().cloths[0].model;
    ASSERT_FALSE(model.table(ConstraintKind::stretch).blocks.empty());
    const std::uint32_t plates = model.table(ConstraintKind::plate).rows;
    ASSERT_GE(plates, 128u);
    // Three sides of a plate. A spring at rest is a line of length 0.
    EXPECT_EQ(shown.draw("constraints").lines.size(), 2 * (208u + 9 + 3 * plates));
}

TEST(ClothContactsOverlay, shows_the_most_serious_mark_of_each_particle) {
    World world = make_world({.contact_marks = true});
    world.add(make_sheet({.resolution = {4, 4}}));
    const OverlayOutput before = Shown(world).draw("cloth_contacts");
    EXPECT_TRUE(before.points.empty());
    EXPECT_EQ(entry(before, 0), "touching: not known");
    world.step(frame_seconds);
    Shown shown(world);
    EXPECT_TRUE(shown.draw("cloth_contacts").points.empty());
    shown.mark(3, mark_touches);
    shown.mark(5, mark_touches | mark_limited);
    shown.mark(7, mark_touches | mark_limited | mark_tangled);
    const OverlayOutput output = shown.draw("cloth_contacts");
    ASSERT_EQ(output.points.size(), 3u);
    for (const std::size_t i : {0u, 1u, 2u}) {
        EXPECT_EQ(output.points[i].position, shown.frame().cloths[0].positions[3 + 2 * i].xyz());
        EXPECT_EQ(output.points[i].color, *output.legends[0].entries[i].color);
    }
    EXPECT_EQ(entry(output, 0), "touching: 3");
    EXPECT_EQ(entry(output, 1), "limited: 2");
    EXPECT_EQ(entry(output, 2), "tangled: 1");
}

TEST(ContactsOverlay, of_a_sheet_at_rest_are_all_its_particles) {
    World world = make_world({.solver = {.substeps = 10}, .contact_forces = true});
    world.add(make_collider({.shape = PlaneDesc{{0, 1, 0}, 0}}));
    world.add(make_sheet({.size = {0.4f, 0.4f}, .position = {0, 0.001f, 0}}));
    run(world, 0.2);
    Shown shown(world);
    const OverlayOutput output = shown.draw("contacts");
    ASSERT_EQ(output.points.size(), 81u);
    ASSERT_EQ(output.lines_on_top.size(), 81u);
    for (std::size_t i = 0; i < 81; ++i) {
        EXPECT_EQ(output.points[i].position, shown.positions()[i]);
        EXPECT_EQ(output.lines_on_top[i].from, shown.positions()[i]);
        const Vec3 along = output.lines_on_top[i].to - output.lines_on_top[i].from;
        EXPECT_GT(along.y, 0) << "the ground pushes up";
        EXPECT_LT(std::hypot(along.x, along.z), 0.02f * along.y);
    }
    EXPECT_EQ(entry(output, 0), "contacts of particles: 81");
    EXPECT_EQ(entry(output, 1), "contacts of faces: 0");
    EXPECT_EQ(entry(output, 3), "beyond a surface: 0");
}

// Contact of triangles, which contact forces divide among the particles at their corners.
TEST(ContactsOverlay, shows_a_tip_between_particles_where_it_touches) {
    World world = make_world({.solver = {.substeps = 20}, .contact_forces = true});
    const Vec3 tip{0.017f, 0, 0.011f};
    world.add(
        make_collider({.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
                       .transform = {.position = tip - Vec3{0, 0.173205f, 0}, .rotation_degrees = {45, 0, 35.2644f}}}));
    world.add(make_sheet({.size = {0.5f, 0.5f},
                          .resolution = {11, 11},
                          .position = {0, 0.002f, 0},
                          .layout = world.settings().layout()}));
    run(world, 0.05);
    Shown shown(world);
    ASSERT_EQ(world.contact_forces().frame, world.frame().index);
    const auto& contacts = world.contact_forces().contacts;
    ASSERT_FALSE(contacts.empty());
    Vec3 total;
    for (const Contact& contact : contacts) {
        EXPECT_GT(norm(contact.point - tip), 0.01f) << "no particle is at the tip";
        total += contact.impulse;
    }
    const OverlayOutput output = shown.draw("contacts");
    ASSERT_FALSE(output.points.empty());
    EXPECT_EQ(entry(output, 0), "contacts of particles: 0");
    EXPECT_EQ(entry(output, 1), "contacts of faces: " + std::to_string(output.points.size()));
    for (const render::Point& point : output.points) {
        EXPECT_LT(norm(point.position - tip), 0.002f);
        EXPECT_EQ(point.color, *output.legends[0].entries[1].color);
    }
    // All of the push is shown. Lines are in scale.
    const std::vector<Touch> touches = touches_of(LiveWorldFrame(world), world.frame());
    Vec3 shown_total, along;
    for (const Touch& touch : touches) shown_total += touch.impulse;
    for (const render::Line& line : output.lines_on_top) along += line.to - line.from;
    EXPECT_LT(norm(shown_total + total), 1e-5f * norm(total));
    EXPECT_GT(shown_total.y, 0.9f * norm(shown_total)) << "upward";
    EXPECT_NEAR(dot(normalized(along), normalized(shown_total)), 1, 1e-5);
}

// A box that lies under a fine sheet: both kinds of contacts, and no push is lost or counted twice.
// Labels on Vulkan: no-asan long
TEST(ContactsOverlay, shows_all_of_the_push) {
    World world = make_world({.solver = {.substeps = 10}, .contact_forces = true});
    world.add(make_collider({.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
                             .transform = {.position = {0.01f, -0.12f, 0}, .rotation_degrees = {10, 20, 5}}}));
    world.add(make_collider({.shape = SphereDesc{0.02f}, .transform = {.position = {0.3f, -0.025f, 0.21f}}}));
    world.add(make_collider({.shape = PlaneDesc{{0, 1, 0}, -0.3f}}));
    world.add(make_sheet({.resolution = {31, 31}, .layout = world.settings().layout()}));
    for (int i = 0; i < 30; ++i) {
        world.step(frame_seconds);
        Shown shown(world);
        const std::vector<Touch> touches = touches_of(LiveWorldFrame(world), shown.frame());
        Vec3 total, shown_total;
        float size = 0;
        for (const Contact& contact : world.contact_forces().contacts)
            total += contact.impulse, size += norm(contact.impulse);
        for (const Touch& touch : touches) shown_total += touch.impulse;
        EXPECT_LE(norm(total + shown_total), 1e-5f * size) << "frame " << i;
        if (i < 15) continue;
        const auto faces = std::ranges::count_if(touches, &Touch::of_face);
        EXPECT_GT(faces, 0);
        EXPECT_GT(touches.size() - static_cast<std::size_t>(faces), 10u);
    }
}

// Only colliders whose box a particle is in are looked at. A cloth that meets the triangles of a collider may be on
// either side of them.
TEST(ContactsOverlay, finds_what_is_inside_one_of_many) {
    World world = make_world({});
    for (int i = 0; i < 1000; ++i) {
        const auto x = static_cast<float>(i % 100), z = static_cast<float>(i / 100);
        world.add(make_collider({.shape = SphereDesc{0.2f}, .transform = {.position = {x, -0.2f, z}}}));
    }
    world.add(make_sheet({.position = {50, -0.003f, 5}}));
    EXPECT_EQ(entry(Shown(world).draw("contacts"), 1), "beyond a surface: 1, deepest 3 mm");
}

TEST(ContactsOverlay, finds_a_particle_three_millimeters_deep) {
    World world = make_world({});
    world.add(make_collider({.shape = SphereDesc{0.2f}, .transform = {.position = {0, -0.2f, 0}}}));
    world.add(make_sheet({.position = {0, -0.003f, 0}}));
    const OverlayOutput output = Shown(world).draw("contacts");
    ASSERT_EQ(output.points.size(), 1u) << "the one in the middle";
    EXPECT_LT(norm(output.points[0].position - Vec3{0, -0.003f, 0}), 1e-6f);
    ASSERT_EQ(output.lines_on_top.size(), 1u);
    EXPECT_LT(norm(output.lines_on_top[0].to), 1e-6f) << "on the surface";
    EXPECT_EQ(entry(output, 0), "contacts: not known");
    EXPECT_EQ(entry(output, 1), "beyond a surface: 1, deepest 3 mm");
}

TEST(ContactsOverlay, leads_from_every_penetration_to_the_surface) {
    for (const auto& shape : {ColliderDesc{.shape = BoxDesc{{0.3f, 0.2f, 0.25f}}},
                              {.shape = CapsuleDesc{0.15f, 0.2f}},
                              {.shape = TaperedCapsuleDesc{{0.25f, 0.1f}, 0.2f}},
                              {.shape = SphereDesc{0.3f}},
                              {.shape = PlaneDesc{{0, 1, 0}, 0.05f}}}) {
        ColliderDesc desc = shape;
        desc.transform = {.position = {0.1f, 0.02f, -0.1f}, .rotation_degrees = {20, 35, 50}};
        World world = make_world({});
        const ColliderId id = world.add(make_collider(desc));
        world.add(make_sheet({.resolution = {17, 17}}));
        const OverlayOutput output = Shown(world).draw("contacts");
        ASSERT_GT(output.lines_on_top.size(), 10u);
        ASSERT_LT(output.lines_on_top.size(), 289u);
        double deepest = 0;
        for (const render::Line& line : output.lines_on_top) {
            EXPECT_NEAR(signed_distance(world.collider(id), line.to), 0, 1e-6);
            deepest = std::max(deepest, -signed_distance(world.collider(id), line.from));
        }
        EXPECT_EQ(entry(output, 1), "beyond a surface: " + std::to_string(output.points.size()) + ", deepest " +
                                        short_number(1000 * deepest) + " mm");
    }
}

TEST(ContactsOverlay, leaves_out_what_is_pinned_inside) {
    World world = make_world({});
    world.add(make_collider({.shape = BoxDesc{{2, 2, 2}}}));
    world.add(make_sheet({.pinned = [](Vec3) { return true; }}));
    EXPECT_EQ(entry(Shown(world).draw("contacts"), 1), "beyond a surface: 0");
}

TEST(WindOverlay, shows_the_wind_as_it_is) {
    AirDesc air;
    air.wind.push_back({.velocity = {3, 0, 1}, .gust = {.amplitude = 0.4f}, .turbulence = {.strength = 0.5f}});
    air.wind.push_back({.velocity = {0, 0.5f, 0}});
    World world = make_world({.solver = {.substeps = 1}, .air = air}, SheetDesc{.pinned = [](Vec3) { return true; }});
    run(world, 0.5);
    Shown shown(world);
    const OverlayOutput output = shown.draw("wind");
    std::vector<WindNow> winds;
    for (const WindDesc& desc : air.wind) winds.push_back(wind_at(desc, shown.frame().time));
    const float most = output.legends[0].bar->most;
    EXPECT_EQ(most, 10) << "above 3.2 · 1.9 + 0.5 m/s";
    ASSERT_EQ(output.lines.size() % 5, 0u) << "shaft and four barbs";
    ASSERT_GT(output.lines.size() / 5, 50u);
    ASSERT_LE(output.lines.size() / 5, 9u * 9 * 9);
    float scale = 0;
    for (std::size_t i = 0; i < output.lines.size(); i += 5) {
        const auto& [from, to, color, width] = output.lines[i];
        const Vec3 velocity = wind_velocity(winds, from, static_cast<std::uint32_t>(i / 5));
        if (i == 0) scale = norm(to - from) / norm(velocity);
        EXPECT_LT(norm(to - from - velocity * scale), 1e-5f);
    }
    EXPECT_EQ(entry(output, 0), "an arrow of " + short_number(1000 * scale) + " cm: 10 m/s");
}

TEST(WindOverlay, is_none_in_a_vacuum_and_in_still_air) {
    World vacuum = make_world({}, SheetDesc{});
    EXPECT_TRUE(Shown(vacuum).draw("wind").lines.empty());
    AirDesc still;
    still.wind.push_back({});
    World air = make_world({.air = still}, SheetDesc{});
    const OverlayOutput output = Shown(air).draw("wind");
    EXPECT_TRUE(output.lines.empty());
    EXPECT_EQ(output.legends[0].title, "wind: none");
}

std::size_t beyond_numbers(const OverlayOutput& output) {
    std::size_t count = 0;
    for (const auto* lines : {&output.lines, &output.lines_on_top})
        for (const render::Line& line : *lines) count += !finite(line.from) || !finite(line.to);
    for (const render::Point& point : output.points) count += !finite(point.position);
    for (const render::FlatVertex& corner : output.flat) count += !std::isfinite(corner.x) || !std::isfinite(corner.y);
    for (const Scalars& scalars : output.scalars) {
        for (const float value : scalars.values) count += !std::isfinite(value);
        count += !std::isfinite(scalars.most) || !(scalars.least < scalars.most);
    }
    return count;
}

TEST(Overlays, survive_positions_that_are_none) {
    AirDesc air;
    air.wind.push_back({.velocity = {3, 0, 1}});
    World world = make_world({.air = air, .contact_forces = true});
    world.add(make_collider({.shape = PlaneDesc{{0, 1, 0}, 0}}));
    world.add(make_sheet(
        {.pinned = [](Vec3 p) { return p.z < -0.49f; }, .spring = [](Vec3 p) { return p.z > 0.49f ? 1e-3f : 0.0f; }}));
    world.step(frame_seconds);
    Shown shown(world);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    for (const float wrong : {nan, infinite, 1e30f, 0.0f}) {
        for (const bool all : {false, true}) {
            shown.place([&](Vec3 p) { return all || p.x > 0.3f ? Vec3{wrong, wrong, wrong} : p; });
            for (const Overlay& overlay : overlays())
                EXPECT_EQ(beyond_numbers(shown.draw(overlay.name)), 0u) << overlay.name << ' ' << wrong;
        }
    }
}

TEST(Overlays, of_nothing_are_nothing) {
    World world = make_world({.contact_forces = true});
    world.add(make_collider({.shape = PlaneDesc{{0, 1, 0}, 0}}));
    for (int cloths = 0; cloths < 2; ++cloths) {
        // Then a cloth without a triangle or a particle.
        if (cloths == 1) {
            auto empty = std::make_shared<ClothModel>();
            empty->start = AlignedVector<Vec4>(empty->capacity());
            empty->around = std::make_shared<FacesAround>(lay_out_around({}, 0));
            world.add(std::move(empty));
        }
        for (const Overlay& overlay : overlays()) {
            const OverlayOutput output = Shown(world).draw(overlay.name);
            EXPECT_EQ(output.lines.size() + output.lines_on_top.size() + output.points.size(), 0u) << overlay.name;
            for (const Scalars& scalars : output.scalars) EXPECT_TRUE(scalars.values.empty());
        }
    }
}

TEST(Overlays, are_found_by_name) {
    ASSERT_EQ(overlays().size(), 12u);
    for (const Overlay& overlay : overlays()) EXPECT_EQ(*find_overlay(overlay.name), &overlay);
    EXPECT_EQ((*find_overlay("contacts"))->needs, OverlayNeeds::contact_forces);
    EXPECT_EQ((*find_overlay("cloth_contacts"))->needs, OverlayNeeds::contact_marks);
    EXPECT_EQ((*find_overlay("strain"))->needs, OverlayNeeds::nothing);
    EXPECT_EQ(find_overlay("strian").error().message(), "overlay: unknown name \"strian\"; did you mean \"strain\"?");
}

}  // namespace
}  // namespace weft::physical
