#include "solver/model/opened_cloth.h"

#include "mesh/edges.h"
#include "mesh/procedural.h"
#include "physics/stretch/stretch_law.h"
#include "solver/model/cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace weft {
namespace {

struct Kind {
    GridDiagonal diagonal = GridDiagonal::alternating;
    float jitter = 0;  // of vertices, in cells
    bool lines = true;
    BendModel bend = BendModel::moment;
    bool erodes = false;
    StretchModel stretch = StretchModel::edges;
};
const Kind kinds[] = {{},
                      {.diagonal = GridDiagonal::uniform, .lines = false, .bend = BendModel::dihedral},
                      {.jitter = 0.25f, .bend = BendModel::distance},
                      {.diagonal = GridDiagonal::uniform, .jitter = 0.25f, .bend = BendModel::plate},
                      {.diagonal = GridDiagonal::cross, .lines = false, .bend = BendModel::plate},
                      {.stretch = StretchModel::membrane},
                      {.diagonal = GridDiagonal::uniform, .jitter = 0.25f, .stretch = StretchModel::membrane},
                      {.diagonal = GridDiagonal::cross, .lines = false, .stretch = StretchModel::membrane}};

TriangleMesh mesh_of(const Kind& kind) {
    TriangleMesh mesh = make_grid({1, 1}, {9, 9}, kind.diagonal);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> moved(-kind.jitter / 8, kind.jitter / 8);
    for (Vec3& x : mesh.positions) x = x + Vec3{moved(random), 0, moved(random)};
    mesh.uvs.clear();
    return mesh;
}

std::shared_ptr<const ClothModel> make_tearable(const Kind& kind, std::uint32_t reserve = 400) {
    TriangleMesh mesh = mesh_of(kind);
    ClothModelDesc desc{
        .name = "sheet",
        .layout = {.lines = kind.lines, .hierarchy = true},
        .reserve = {
            .particles = reserve, .constraints = 16, .openings = true, .tears = kind.erodes, .erodes = kind.erodes}};
    desc.fabric.bend.model = kind.bend;
    desc.fabric.stretch.model = kind.stretch;
    if (kind.stretch == StretchModel::membrane) desc.fabric.stretch.compression[0] *= 0.25f;
    auto topology = build_topology(mesh, {.reorder = false});
    desc.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

std::vector<Opening> random_openings(const ClothModel& model, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Opening> openings;
    const TearTable& table = *model.tears;
    while (openings.size() < count) {
        const auto link = static_cast<std::uint32_t>(random() % table.entries.size());
        if (table.entries[link].next == none) continue;
        const std::uint32_t begin = table.ring_begin[table.entries[link].vertex],
                            ring = table.ring_begin[table.entries[link].vertex + 1] - begin;
        const auto other = begin + static_cast<std::uint32_t>(random() % ring);
        Opening opening{{link, none}};
        if (random() % 2 && table.entries[other].next != none && other != link) opening.links[1] = other;
        openings.push_back(opening);
    }
    return openings;
}

// Half of the openings of edges, in random order with removals of triangles.
std::vector<Opening> random_removals(const ClothModel& model, std::size_t count, unsigned seed) {
    std::vector<Opening> openings = random_openings(model, count / 2, seed);
    std::mt19937 random(seed + 1);
    while (openings.size() < count) {
        const auto entry = static_cast<std::uint32_t>(random() % model.tears->entries.size());
        openings.push_back({{entry, drops_triangle}});
    }
    std::ranges::shuffle(openings, random);
    return openings;
}

using Ends = std::array<std::uint32_t, 2>;
Ends sorted(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}
std::uint32_t particle_of(const ConstraintTable& table, std::uint32_t row, std::uint32_t slot) {
    return table.particles[std::size_t{slot} * table.stride + row];
}

// `areas`: of the triangles.
void expect_rows_of_edges(const ClothModel& model, const std::vector<float>& areas, const EdgeList& edges) {
    const ConstraintTable& table = model.table(ConstraintKind::stretch);
    std::map<Ends, float> strips;
    for (const Edge& edge : edges.edges) {
        const float squared = dot(model.rest_position(edge.b) - model.rest_position(edge.a),
                                  model.rest_position(edge.b) - model.rest_position(edge.a));
        float area = areas[edge.triangle0];
        if (edge.triangle1 != none) area += areas[edge.triangle1];
        strips[{edge.a, edge.b}] = area / squared;
    }
    std::uint32_t rows = 0;
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row)) continue;
        ++rows;
        const auto strip = strips.find(sorted(particle_of(table, row, 0), particle_of(table, row, 1)));
        ASSERT_NE(strip, strips.end()) << "constraint " << row << " of no edge";
        EXPECT_NEAR(table.geometry[table.stride + row], strip->second, 1e-5f * strip->second);
        strips.erase(strip);
    }
    EXPECT_EQ(rows, table.rows);
    EXPECT_TRUE(strips.empty()) << strips.size() << " edges of " << areas.size() << " triangles have no constraint";
}

// Each triangle has kept its springs and its membrane.
void expect_membranes_of_triangles(const ClothModel& model, const Kind& kind) {
    const TriangleMesh mesh = mesh_of(kind);
    const Topology topology = *build_topology(mesh, {.reorder = false});
    const auto springs = springs_of_membrane(make_rest_shape(mesh, topology), model.fabric.stretch);
    using Sum = std::array<double, 2>;
    std::map<Ends, Sum> expected, got;
    const auto add = [](Sum& sum, float stretched, float compressed) {
        if (stretched > 0) sum[0] += 1 / double{stretched};
        if (compressed > 0) sum[1] += 1 / double{compressed};
    };
    std::uint32_t triangles = 0, left_out = 0;
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        const Triangle now = model.triangles()[t];
        if (now[0] == now[1]) continue;
        ++triangles;
        for (std::size_t i = 0; i < 3; ++i)
            add(expected[sorted(now[(i + 1) % 3], now[(i + 2) % 3])], springs[t][i].stretched,
                springs[t][i].compressed);
    }
    const ConstraintTable& table = model.table(ConstraintKind::stretch);
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row) || table.geometry[table.stride + row] < 0) continue;
        add(got[sorted(particle_of(table, row, 0), particle_of(table, row, 1))], table.fields[table.stride + row],
            table.fields[std::size_t{2} * table.stride + row]);
    }
    for (const auto& [ends, sum] : expected) {
        const Sum& found = got[ends];
        if (sum[0] == 0 && sum[1] == 0) ++left_out;
        for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(found[k], sum[k], 1e-5 * sum[k]) << ends[0] << ' ' << ends[1];
    }
    EXPECT_LT(left_out, expected.size());
    EXPECT_EQ(got.size(), expected.size());
    const ConstraintTable& membranes = model.table(ConstraintKind::membrane);
    std::set<Triangle> alive, spanned;
    const auto in_order = [](Triangle triangle) {
        std::ranges::sort(triangle);
        return triangle;
    };
    for (std::uint32_t t = 0; t < model.triangle_count; ++t)
        if (model.face_area[t] > 0) alive.insert(in_order(model.triangles()[t]));
    for (std::uint32_t row = 0; row < membranes.stride; ++row)
        if (membranes.is_real(row))
            spanned.insert(in_order(
                {particle_of(membranes, row, 0), particle_of(membranes, row, 1), particle_of(membranes, row, 2)}));
    EXPECT_EQ(spanned.size(), membranes.rows);
    EXPECT_EQ(spanned, alive);
    EXPECT_EQ(alive.size(), triangles);
}

void expect_rows_of_hinges(const ClothModel& model, const HingeList& hinges) {
    std::multiset<std::array<std::uint32_t, 4>> expected, got;
    const bool tips_alone = model.fabric.bend.model == BendModel::distance;
    for (const Hinge& hinge : hinges.hinges) {
        const Ends edge = tips_alone ? Ends{} : sorted(hinge.a, hinge.b), tips = sorted(hinge.c, hinge.d);
        expected.insert({edge[0], edge[1], tips[0], tips[1]});
    }
    const ConstraintTable& table =
        model.table(tips_alone                                       ? ConstraintKind::distance_bend
                    : model.fabric.bend.model == BendModel::dihedral ? ConstraintKind::bend
                                                                     : ConstraintKind::moment);
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row)) continue;
        const auto at = [&](std::uint32_t slot) { return particle_of(table, row, slot); };
        const Ends edge = tips_alone ? Ends{} : sorted(at(0), at(1)),
                   tips = tips_alone ? sorted(at(0), at(1)) : sorted(at(2), at(3));
        got.insert({edge[0], edge[1], tips[0], tips[1]});
    }
    EXPECT_EQ(got.size(), table.rows);
    std::vector<std::array<std::uint32_t, 4>> wrong;
    std::ranges::set_symmetric_difference(got, expected, std::back_inserter(wrong));
    EXPECT_TRUE(wrong.empty()) << ::testing::PrintToString(wrong);
}

// Every plate spans a triangle and neighbors that still share an edge with it.
void expect_plates_on_triangles(const ClothModel& model, const EdgeList& edges,
                                const std::vector<Triangle>& triangles) {
    const ConstraintTable& table = model.table(ConstraintKind::plate);
    std::map<Ends, std::set<std::uint32_t>> tips;
    for (const Edge& edge : edges.edges)
        for (const std::uint32_t t : {edge.triangle0, edge.triangle1})
            for (std::uint32_t k = 0; t != none && k < 3; ++k)
                if (triangles[t][k] != edge.a && triangles[t][k] != edge.b)
                    tips[{edge.a, edge.b}].insert(triangles[t][k]);
    std::uint32_t rows = 0;
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row)) continue;
        ++rows;
        const auto at = [&](std::uint32_t slot) { return particle_of(table, row, slot); };
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Ends edge = sorted(at(3 + (k + 1) % 3), at(3 + (k + 2) % 3));
            EXPECT_TRUE(tips[edge].contains(at(3 + k))) << "row " << row;
            const bool unused = at(k) == edge[0] || at(k) == edge[1] || at(k) == at(3 + k);
            EXPECT_TRUE(unused || tips[edge].contains(at(k))) << "row " << row;
        }
    }
    EXPECT_EQ(rows, table.rows);
    EXPECT_GT(rows, 0u);
}

// Around each particle, triangles that share an edge form one chain or circle.
void expect_one_fan_each(const ClothModel& model, const std::vector<Triangle>& triangles, const EdgeList& edges) {
    std::vector<std::uint32_t> corners(model.particle_count), inner(model.particle_count), rim(model.particle_count);
    for (const Triangle& triangle : triangles)
        for (const std::uint32_t p : triangle) ++corners[p];
    for (const Edge& edge : edges.edges)
        for (const std::uint32_t p : {edge.a, edge.b}) ++(edge.triangle1 == none ? rim : inner)[p];
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        EXPECT_EQ(rim[p], corners[p] == inner[p] ? 0u : 2u) << "particle " << p;
        EXPECT_TRUE(corners[p] == inner[p] || corners[p] == inner[p] + 1) << "particle " << p;
    }
}

void expect_consistent(const ClothModel& model, const Kind& kind) {
    std::vector<Triangle> triangles;
    std::vector<float> areas;
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        const Triangle triangle = model.triangles()[t];
        EXPECT_EQ(triangle[0] == triangle[1], model.face_area[t] == 0);
        if (triangle[0] != triangle[1]) triangles.push_back(triangle), areas.push_back(model.face_area[t]);
    }
    const EdgeList edges = build_edges(triangles, model.particle_count);
    EXPECT_TRUE(edges.non_manifold.empty());
    expect_one_fan_each(model, triangles, edges);
    if (kind.stretch == StretchModel::membrane) {
        expect_membranes_of_triangles(model, kind);
    } else {
        expect_rows_of_edges(model, areas, edges);
    }
    if (model.fabric.bend.model == BendModel::plate) {
        expect_plates_on_triangles(model, edges, triangles);
    } else {
        expect_rows_of_hinges(model, build_hinges(edges, triangles));
    }
}

double sum_of(const SharedArray<float>& numbers) {
    double sum = 0;
    for (const float number : numbers) sum += static_cast<double>(number);
    return sum;
}

TEST(Openings, leave_the_constraints_of_the_opened_mesh) {
    for (const Kind& kind : kinds) {
        const auto model = make_tearable(kind);
        expect_consistent(*model, kind);
        for (const std::size_t count : {1, 3, 12, 60}) {
            const auto opened = with_edit(*model, {.openings = random_openings(*model, count, unsigned(count))});
            ASSERT_TRUE(opened.ok()) << opened.errors()[0].message();
            EXPECT_NEAR(sum_of((*opened)->mass), sum_of(model->mass), 1e-6 * sum_of(model->mass));
            EXPECT_EQ((*opened)->particle_count, model->particle_count + (*opened)->copied_from.size());
            expect_consistent(**opened, kind);
            if (HasFailure()) return;
        }
    }
}

// The mass of particles that have triangles.
double mass_of_triangles(const ClothModel& model) {
    std::vector<bool> has(model.particle_count);
    for (std::uint32_t t = 0; t < model.triangle_count; ++t)
        if (model.face_area[t] > 0)
            for (const std::uint32_t p : model.triangles()[t]) has[p] = true;
    double sum = 0;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) sum += has[p] ? double{model.mass[p]} : 0;
    return sum;
}

TEST(Openings, that_remove_triangles_leave_the_constraints_of_the_others) {
    for (Kind kind : kinds) {
        kind.erodes = true;
        const auto model = make_tearable(kind);
        for (const std::size_t count : {1, 2, 3, 12, 60, 100}) {
            const auto openings = random_removals(*model, count, unsigned(count));
            const auto opened = with_edit(*model, {.openings = openings});
            ASSERT_TRUE(opened.ok()) << opened.errors()[0].message();
            expect_consistent(**opened, kind);
            const double expected = sum_of((*opened)->face_area) * double{model->fabric.body.density};
            EXPECT_NEAR(mass_of_triangles(**opened), expected, 1e-6 * sum_of(model->mass));
            auto one_by_one = model;
            for (const Opening& opening : openings) one_by_one = *with_edit(*one_by_one, {.openings = {opening}});
            EXPECT_EQ(one_by_one->faces, (*opened)->faces);
            EXPECT_EQ(one_by_one->table(ConstraintKind::stretch).fields,
                      (*opened)->table(ConstraintKind::stretch).fields);
            expect_consistent(*one_by_one, kind);
            if (HasFailure()) return;
        }
    }
}

TEST(Openings, that_remove_triangles_need_a_cloth_that_erodes) {
    const auto opened = with_edit(*make_tearable({}), {.openings = {{{0, drops_triangle}}}});
    ASSERT_FALSE(opened.ok());
    EXPECT_EQ(opened.errors()[0].message(), "opening 0: removes a triangle, but the cloth does not erode");
    for (const std::uint32_t link : {1u << 30, none, drops_triangle})
        EXPECT_FALSE(with_edit(*make_tearable({.erodes = true}), {.openings = {{{link, drops_triangle}}}}).ok());
}

TEST(Openings, one_by_one_give_the_same_model) {
    const auto model = make_tearable({});
    const std::vector<Opening> openings = random_openings(*model, 40, 2);
    auto one_by_one = model;
    for (const Opening& opening : openings) one_by_one = *with_edit(*one_by_one, {.openings = {opening}});
    const auto at_once = *with_edit(*model, {.openings = openings});
    EXPECT_EQ(one_by_one->faces, at_once->faces);
    EXPECT_EQ(one_by_one->mass, at_once->mass);
    EXPECT_EQ(one_by_one->copied_from, at_once->copied_from);
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        EXPECT_EQ(one_by_one->constraints[kind].particles, at_once->constraints[kind].particles);
        EXPECT_EQ(one_by_one->constraints[kind].fields, at_once->constraints[kind].fields);
        EXPECT_EQ(one_by_one->constraints[kind].rows, at_once->constraints[kind].rows);
    }
    ASSERT_EQ(one_by_one->hierarchy.size(), at_once->hierarchy.size());
    for (std::size_t level = 0; level < at_once->hierarchy.size(); ++level)
        EXPECT_EQ(one_by_one->hierarchy[level].limits.fields, at_once->hierarchy[level].limits.fields);
}

TEST(Openings, of_all_edges_leave_single_triangles) {
    for (const Kind& kind : kinds) {
        if (kind.bend == BendModel::plate) continue;
        const auto model = make_tearable(kind, 2000);
        std::vector<std::uint32_t> group(model->triangle_count);
        for (std::uint32_t t = 0; t < group.size(); ++t) group[t] = t;
        const auto opened = with_edit(*model, {.openings = openings_between(*model, group)});
        ASSERT_TRUE(opened.ok());
        EXPECT_EQ((*opened)->particle_count, 3 * model->triangle_count);
        if (kind.stretch == StretchModel::edges) {
            EXPECT_EQ((*opened)->table(ConstraintKind::stretch).rows, 3 * model->triangle_count);
        }
        EXPECT_EQ((*opened)->table(ConstraintKind::bend).rows, 0u);
        EXPECT_EQ((*opened)->table(ConstraintKind::moment).rows, 0u);
        EXPECT_TRUE(openings_between(**opened, group).empty()) << "all are open";
        expect_consistent(**opened, kind);
    }
}

TEST(Openings, keep_their_constraints_through_a_change_of_fabric) {
    const auto model = make_tearable({});
    const std::vector<Opening> openings = random_openings(*model, 30, 9);
    Fabric stiff = model->fabric;
    stiff.stretch.stretch[0] *= 2, stiff.body.density *= 1.5f, stiff.bend.bend[1] *= 3;
    const auto first_opened = *with_fabric(**with_edit(*model, {.openings = openings}), stiff);
    const auto first_changed = *with_edit(**with_fabric(*model, stiff), {.openings = openings});
    ASSERT_TRUE(first_opened && first_changed);
    for (const ConstraintKind kind : {ConstraintKind::stretch, ConstraintKind::moment})
        EXPECT_EQ(first_opened->table(kind).fields, first_changed->table(kind).fields);
    EXPECT_EQ(first_opened->mass, first_changed->mass);
}

TEST(Openings, that_are_wrong_or_too_many_are_errors) {
    const auto model = make_tearable({}, 3);
    const auto message_of = [&](const ClothModel& of, const Opening& opening) {
        const auto opened = with_edit(of, {.openings = {opening}});
        return opened.ok() ? std::string() : opened.errors()[0].message();
    };
    EXPECT_NE(message_of(*model, {{9999999, none}}).find("opening 0"), std::string::npos);
    std::uint32_t rim = 0;
    while (model->tears->entries[rim].next != none) ++rim;
    EXPECT_NE(message_of(*model, {{rim, none}}).find("inside the cloth"), std::string::npos);
    EXPECT_EQ(message_of(*model, {}), "") << "nothing to open";
    const auto full = with_edit(*model, {.openings = random_openings(*model, 50, 1)});
    ASSERT_FALSE(full.ok());
    EXPECT_NE(full.errors()[0].message().find("has no room for more particles"), std::string::npos);

    auto plain = ClothModelDesc{.name = "plain", .mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::uniform)};
    auto topology = build_topology(plain.mesh);
    const auto built = build_cloth_model(std::move(plain), std::move(*topology));
    EXPECT_NE(message_of(**built, {{0, none}}).find("not built to be cut"), std::string::npos);

    ClothModelDesc three{.name = "fin", .reserve = {8, 8, true}};
    three.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    three.mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    auto fin = build_topology(three.mesh, {.reorder = false});
    const auto refused = build_cloth_model(std::move(three), std::move(*fin));
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.errors()[0].message().find("three triangles"), std::string::npos);
}

TEST(Openings, along_a_plane_stay_near_it) {
    for (const Kind& kind : kinds) {
        const auto model = make_tearable(kind);
        const Vec3 point{0.03f, 0, 0.05f}, normal = normalized(Vec3{1, 0, 0.4f});
        const auto openings = openings_along_plane(*model, model->start, point, normal);
        const auto opened = with_edit(*model, {.openings = openings});
        ASSERT_TRUE(opened.ok());
        for (const std::uint32_t p : (*opened)->copied_from)
            EXPECT_LT(std::abs(dot(model->rest_position(p) - point, normal)), 0.75f * model->longest_edge);
        EXPECT_GE((*opened)->copied_from.size(), 8u);
        expect_consistent(**opened, kind);
    }
}

TEST(Openings, along_a_stroke_end_where_it_ends) {
    const Kind kind{.jitter = 0.2f};
    const auto model = make_tearable(kind);
    const std::vector<Vec3> stroke{{-0.6f, 0, 0.02f}, {0, 0, 0.1f}, {0.26f, 0, -0.1f}};
    const auto openings = openings_along_stroke(*model, model->start, stroke);
    const auto opened = with_edit(*model, {.openings = openings});
    ASSERT_TRUE(opened.ok());
    EXPECT_GE((*opened)->copied_from.size(), 5u);
    for (const std::uint32_t p : (*opened)->copied_from) EXPECT_LT(model->rest_position(p).x, 0.3f);
    expect_consistent(**opened, kind);
    EXPECT_TRUE(openings_along_stroke(*model, model->start, {}).empty());
    EXPECT_TRUE(openings_along_stroke(*model, model->start, std::vector<Vec3>{{0, 0, 0}, {0, 0, 0.001f}}).empty());
}

TEST(Openings, along_a_stroke_at_rest_take_the_same_path_in_opened_cloth) {
    for (const Kind& kind : kinds) {
        const auto model = make_tearable(kind);
        const std::vector<Vec3> stroke{{-0.6f, 0, 0.02f}, {0, 0, 0.1f}, {0.26f, 0, -0.1f}};
        const auto openings = openings_along_stroke_at_rest(*model, stroke);
        EXPECT_EQ(openings, openings_along_stroke(*model, model->start, stroke)) << "nothing is open yet";
        EXPECT_LT(farthest_from(stroke, *model, model->start, openings), 0.75f * model->longest_edge);
        // Another cut crosses it: what is left of the path is the rest of the same path.
        const auto crossed =
            *with_edit(*model, {.openings = openings_along_plane(*model, model->start, {-0.2f, 0, 0}, {1, 0, 0.1f})});
        const auto left = openings_along_stroke_at_rest(*crossed, stroke);
        EXPECT_FALSE(left.empty());
        for (const Opening& opening : left)
            for (const std::uint32_t link : opening.links)
                EXPECT_TRUE(link == none || std::ranges::any_of(openings, [&](const Opening& one) {
                                return one.links[0] == link || one.links[1] == link;
                            }));
        const auto opened = *with_edit(*crossed, {.openings = left});
        EXPECT_TRUE(openings_along_stroke_at_rest(*opened, stroke).empty());
        EXPECT_TRUE(closed_ones(*opened, openings).empty());
        EXPECT_EQ(closed_ones(*model, openings), openings);
    }
}

// A plane halfway between two columns of a grid does not zigzag along the diagonals.
TEST(Openings, along_a_plane_are_straight_where_the_mesh_has_rows) {
    for (const float offset : {0.01f, 0.03f, 0.0625f, 0.09f, 0.12f}) {
        for (const Kind& kind : {kinds[0], kinds[1]}) {
            const auto model = make_tearable(kind);
            const auto opened =
                *with_edit(*model, {.openings = openings_along_plane(*model, model->start, {offset, 0, 0}, {1, 0, 0})});
            ASSERT_EQ(opened->copied_from.size(), 9u) << offset;
            const float x = model->rest_position(opened->copied_from[0]).x;
            for (const std::uint32_t p : opened->copied_from) EXPECT_EQ(model->rest_position(p).x, x);
        }
    }
}

// Copies take part in contact from the next frame on.
TEST(Openings, list_copies_for_contact) {
    for (const SelfCollision contact : {SelfCollision::fast, SelfCollision::exact}) {
        TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::alternating);
        auto topology = build_topology(mesh, {.reorder = false});
        ClothModelDesc desc{.name = "sheet", .collision = {contact}, .reserve = {.particles = 40, .openings = true}};
        desc.mesh = std::move(mesh);
        const auto whole = *build_cloth_model(std::move(desc), std::move(*topology));
        const auto cut = *with_edit(*whole, {.openings = openings_along_plane(*whole, whole->start, {}, {1, 0, 0})});
        ASSERT_GT(cut->particle_count, whole->particle_count);
        EXPECT_EQ(cut->along_curve->size(), cut->particle_count);
        if (contact != SelfCollision::exact) continue;
        std::size_t owned = 0;
        for (const Tile& tile : *cut->tiles) owned += tile.own_vertices;
        EXPECT_EQ(owned, cut->particle_count);
    }
}

}  // namespace
}  // namespace weft
