#include "mesh/procedural.h"
#include "solver/model/cloth_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> build(const TriangleMesh& mesh, const Fabric& fabric, const ClothLayout& layout = {},
                                        const ClothPins& pins = {{0, 3}, {{5, 1e-3f, {0, 1, 0}}}}) {
    auto topology = build_topology(mesh);
    EXPECT_TRUE(topology.ok());
    auto model =
        build_cloth_model({.name = "sheet", .mesh = mesh, .fabric = fabric, .pins = pins, .layout = layout}, *topology);
    EXPECT_TRUE(model.ok()) << model.error().message();
    return *model;
}

std::shared_ptr<const ClothModel> changed(const ClothModel& model, const Fabric& fabric) {
    auto next = with_fabric(model, fabric);
    EXPECT_TRUE(next.ok()) << next.error().message();
    return *next;
}

template <class A, class B>
void expect_same_bits(const A& a, const B& b, const char* what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    if (a.size() > 0) {
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])), 0) << what;
    }
}

void expect_same(const ClothModel& got, const ClothModel& built) {
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        const ConstraintTable &a = got.constraints[kind], &b = built.constraints[kind];
        expect_same_bits(a.particles, b.particles, "particles");
        expect_same_bits(a.fields, b.fields, constraint_info(static_cast<ConstraintKind>(kind)).name.data());
        expect_same_bits(a.geometry, b.geometry, "geometry");
        expect_same_bits(a.left_out, b.left_out, "left out");
        expect_same_bits(a.coupling, b.coupling, "coupling");
    }
    expect_same_bits(got.mass, built.mass, "masses");
    expect_same_bits(got.start, built.start, "starts");
    expect_same_bits(face_masses(got), face_masses(built), "masses of faces");
    EXPECT_EQ(got.elasticity.warp, built.elasticity.warp);
    EXPECT_EQ(got.elasticity.weft, built.elasticity.weft);
    EXPECT_EQ(got.elasticity.shear, built.elasticity.shear);
    EXPECT_EQ(got.elasticity.tension, built.elasticity.tension);
    EXPECT_TRUE(got.fabric == built.fabric);
    EXPECT_EQ(got.fabric.tether.use, built.fabric.tether.use);
    EXPECT_EQ(got.fabric.distance_bend.bend[0], built.fabric.distance_bend.bend[0]);
}

class RandomNumbers {
  public:
    explicit RandomNumbers(unsigned seed) : engine_(seed) {}
    /// Uniform in the logarithm between `low` and `high`.
    float number(float low, float high) {
        return low * std::pow(high / low, static_cast<float>(engine_()) / 4294967296.0f);
    }
    float offset(float most) { return most * (static_cast<float>(engine_()) / 2147483648.0f - 1); }
    bool one_in(unsigned n) { return engine_() % n == 0; }

  private:
    std::mt19937 engine_;
};

Fabric random_fabric(RandomNumbers& random, BendModel model) {
    Fabric fabric;
    fabric.body = {.density = random.number(0.01f, 10), .damping = random.number(0.01f, 1)};
    for (float& k : fabric.stretch.stretch) k = random.number(10, 1e6f);
    for (float& k : fabric.stretch.compression) k = random.number(10, 1e6f);
    fabric.stretch.shear = random.number(1, 1e6f);
    fabric.stretch.inextensible = random.one_in(4);
    for (float& b : fabric.bend.bend) b = random.number(1e-8f, 1);
    fabric.bend.model = model;
    return fabric;
}

TriangleMesh bent_grid(std::array<std::uint32_t, 2> resolution, RandomNumbers& random) {
    TriangleMesh mesh = make_grid({1, 0.7f}, resolution, GridDiagonal::alternating);
    for (Vec3& p : mesh.positions) p += Vec3{random.offset(0.02f), random.offset(0.02f), random.offset(0.02f)};
    return mesh;
}

std::vector<TriangleMesh> meshes(RandomNumbers& random) {
    std::vector<TriangleMesh> all = {make_grid({1, 1}, {19, 23}, GridDiagonal::uniform), bent_grid({17, 14}, random),
                                     make_sphere(0.5f, 3)};
    all.push_back(bent_grid({9, 12}, random));
    all.back().uvs.clear();
    return all;
}

TEST(WithFabric, gives_the_bits_of_a_model_that_is_built_anew) {
    RandomNumbers random(3);
    for (const BendModel model : {BendModel::dihedral, BendModel::distance, BendModel::moment}) {
        for (const TriangleMesh& mesh : meshes(random)) {
            for (const bool lines : {false, true}) {
                Fabric now = random_fabric(random, model);
                auto running = build(mesh, now, {.lines = lines});
                for (int change = 0; change < 4; ++change) {  // successive changes of one model
                    now = random_fabric(random, model);
                    running = changed(*running, now);
                    ASSERT_TRUE(running);
                    expect_same(*running, *build(mesh, now, {.lines = lines}));
                }
            }
        }
    }
}

TEST(WithFabric, keeps_the_angles_and_edges_that_were_chosen) {
    RandomNumbers random(4);
    const TriangleMesh mesh = bent_grid({15, 12}, random);
    for (const BendModel model : {BendModel::dihedral, BendModel::distance, BendModel::moment}) {
        for (const BendEdges hinges : {BendEdges::all, BendEdges::no_diagonals}) {
            Fabric before = random_fabric(random, model), after = random_fabric(random, model);
            before.bend.edges = after.bend.edges = hinges;
            before.bend.rest_angle = after.bend.rest_angle = 20;
            const auto next = changed(*build(mesh, before), after);
            ASSERT_TRUE(next);
            expect_same(*next, *build(mesh, after));
        }
    }
}

TEST(WithFabric, leaves_out_the_same_constraints_as_a_build) {
    const TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::uniform);
    Fabric threads;  // no shear, so diagonals have no constraint
    threads.stretch.shear = 0;
    threads.bend.model = BendModel::dihedral;
    threads.bend.bend[0] = threads.bend.bend[1] = 0;
    Fabric stiffer = threads;
    stiffer.stretch.stretch[0] = 7000;
    stiffer.bend.bend[2] = 1e-4f;
    const auto model = build(mesh, threads);
    EXPECT_FALSE(model->edges->without_row.empty());
    EXPECT_FALSE(model->table(ConstraintKind::stretch).left_out.empty());
    EXPECT_FALSE(model->table(ConstraintKind::bend).left_out.empty());
    const auto next = changed(*model, stiffer);
    ASSERT_TRUE(next);
    expect_same(*next, *build(mesh, stiffer));
}

TEST(WithFabric, leaves_other_rows_to_a_build) {
    const TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::uniform);
    const auto differs = [&](const Fabric& from, auto&& change) {
        Fabric to = from;
        change(to);
        return changed(*build(mesh, from), to) == nullptr;
    };
    const Fabric cotton;
    Fabric threads, limp, plate;
    threads.stretch.shear = 0;
    limp.bend.bend[0] = limp.bend.bend[1] = limp.bend.bend[2] = 0;
    plate.bend.model = BendModel::plate;
    EXPECT_TRUE(differs(cotton, [](Fabric& f) { f.stretch.shear = 0; }));
    EXPECT_TRUE(differs(threads, [](Fabric& f) { f.stretch.shear = 1; }));
    EXPECT_TRUE(differs(threads, [](Fabric& f) { f.stretch.inextensible = true; }));
    EXPECT_TRUE(differs(cotton, [](Fabric& f) { f.bend.bend[0] = f.bend.bend[1] = f.bend.bend[2] = 0; }));
    EXPECT_TRUE(differs(limp, [](Fabric& f) { f.bend.bend[1] = 1e-5f; }));
    EXPECT_TRUE(differs(cotton, [](Fabric& f) { f.bend.model = BendModel::distance; }));
    EXPECT_TRUE(differs(cotton, [](Fabric& f) { f.bend.edges = BendEdges::no_diagonals; }));
    EXPECT_TRUE(differs(cotton, [](Fabric& f) { f.bend.rest_angle = 0; }));
    EXPECT_TRUE(differs(cotton, [](Fabric& f) { f.tether.use = Tethers::on; }));
    EXPECT_TRUE(differs(cotton, [](Fabric& f) { f.tether.slack = 0.1f; }));
    EXPECT_TRUE(differs(plate, [](Fabric& f) { f.bend.bend[0] *= 2; }));
    EXPECT_FALSE(differs(limp, [](Fabric& f) { f.body.density = 1; }));
    EXPECT_FALSE(differs(plate, [](Fabric& f) { f.stretch.inextensible = true; }));
}

TEST(WithFabric, of_a_plate_changes_all_but_its_stiffness) {
    RandomNumbers random(5);
    const TriangleMesh mesh = bent_grid({9, 9}, random);
    const Fabric before = random_fabric(random, BendModel::plate);
    Fabric after = random_fabric(random, BendModel::plate);
    std::copy_n(before.bend.bend, 3, after.bend.bend);
    const auto next = changed(*build(mesh, before), after);
    ASSERT_TRUE(next);
    expect_same(*next, *build(mesh, after));
}

TEST(WithFabric, shares_what_a_fabric_does_not_change) {
    const TriangleMesh mesh = make_grid({1, 1}, {33, 33}, GridDiagonal::alternating);
    const auto model = build(mesh, {}, {.lines = true, .hierarchy = true});
    Fabric fabric;
    fabric.air.drag = 2;
    fabric.contact.thickness = 0.01f;
    fabric.body.damping = 0;
    const auto airy = changed(*model, fabric);
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind)
        EXPECT_TRUE(airy->constraints[kind].fields.shares(model->constraints[kind].fields));
    EXPECT_TRUE(airy->mass.shares(model->mass));
    EXPECT_FALSE(limits_differ(model->fabric, fabric));
    EXPECT_EQ(airy->fabric.air.drag, 2);

    fabric.stretch.stretch[0] = 9000;
    const auto stiff = changed(*model, fabric);
    ASSERT_FALSE(model->hierarchy.empty());
    EXPECT_TRUE(stiff->hierarchy.shares(model->hierarchy));
    EXPECT_FALSE(stiff->table(ConstraintKind::stretch).fields.shares(model->table(ConstraintKind::stretch).fields));
    EXPECT_TRUE(stiff->table(ConstraintKind::bend).fields.shares(model->table(ConstraintKind::bend).fields));
    EXPECT_EQ(&stiff->mesh(), &model->mesh());
    EXPECT_TRUE(limits_differ(model->fabric, fabric));
}

TEST(WithFabric, refuses_what_a_build_refuses) {
    const TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::uniform);
    const auto model = build(mesh, {});
    const auto topology = build_topology(mesh);
    ASSERT_TRUE(topology.ok());
    for (const float density : {0.0f, -1.0f, std::nanf(""), std::numeric_limits<float>::infinity(), 1e-44f}) {
        Fabric fabric;
        fabric.body.density = density;
        const auto next = with_fabric(*model, fabric);
        const auto built = build_cloth_model({.name = "sheet", .mesh = mesh, .fabric = fabric}, *topology);
        ASSERT_FALSE(next.ok()) << density;
        ASSERT_FALSE(built.ok()) << density;
        EXPECT_EQ(next.error().message(), built.error().message());
    }
}

}  // namespace
}  // namespace weft
