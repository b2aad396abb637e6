// Measures that the device computes, compared with the same in double precision on the host.

#include "vulkan_fixture.h"

#include "mesh/procedural.h"
#include "solver/measures/statistics.h"
#include "solver/state/address_space.h"
#include "solver/world/world.h"

#include <volk.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace weft {
namespace {

struct Sheet {
    TriangleMesh mesh;
    std::vector<std::uint32_t> pins = {};
    Projection projection = Projection::gauss_seidel;
    ClothLayout layout = {};
};

std::shared_ptr<const ClothModel> model_of(Sheet sheet) {
    auto topology = build_topology(sheet.mesh, {});
    EXPECT_TRUE(topology.ok());
    ClothModelDesc desc{.name = "sheet", .mesh = std::move(sheet.mesh), .layout = sheet.layout};
    for (const std::uint32_t vertex : sheet.pins) desc.pins.particles.push_back(topology->vertex_to_particle[vertex]);
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

TriangleMesh grid(std::uint32_t side, GridDiagonal diagonal = GridDiagonal::alternating) {
    return make_grid({1, 1}, {side, side}, diagonal);
}

TriangleMesh irregular(std::uint32_t side) {
    TriangleMesh mesh = grid(side);
    std::mt19937 random(side);
    std::uniform_real_distribution<float> by(-0.25f / static_cast<float>(side), 0.25f / static_cast<float>(side));
    for (Vec3& p : mesh.positions) p = p + Vec3{by(random), by(random), by(random)};
    return mesh;
}

// The same on the host, from the saved state.
MeasureSums on_host(const ClothModel& model, const ClothSnapshot& state) {
    MeasureSums sums;
    std::vector<Vec4> positions(state.position.begin(), state.position.begin() + model.particle_count);
    for (std::uint32_t p = 0; p < model.particle_count; ++p) positions[p].w = model.start[p].w;
    sums.add(model, positions, state.velocity);
    sums.add_residual(model, stretch_residual(model, state.position, state.kept, state.substep_seconds));
    return sums;
}

void expect_near(const ClothMeasures& device, const ClothMeasures& host) {
    const auto near = [](double a, double b, const char* what) {
        EXPECT_NEAR(a, b, 1e-5 * std::abs(b) + 1e-12) << what;
    };
    near(device.strain.stretch.mean, host.strain.stretch.mean, "mean stretch");
    near(device.strain.stretch.max, host.strain.stretch.max, "max stretch");
    near(device.strain.shear.mean, host.strain.shear.mean, "mean shear");
    near(device.strain.shear.max, host.strain.shear.max, "max shear");
    near(device.residual.mean, host.residual.mean, "mean residual");
    near(device.residual.max, host.residual.max, "max residual");
    near(device.kinetic_energy, host.kinetic_energy, "kinetic energy");
    near(device.max_speed, host.max_speed, "max speed");
    EXPECT_EQ(device.finite, host.finite);
}

std::array<std::uint64_t, 9> bits(const ClothMeasures& m) {
    const auto of = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    return {of(m.strain.stretch.mean), of(m.strain.stretch.max), of(m.strain.shear.mean),
            of(m.strain.shear.max),    of(m.residual.mean),      of(m.residual.max),
            of(m.kinetic_energy),      of(m.max_speed),          m.finite};
}

void expect_as_on_host(World& world, const std::vector<std::shared_ptr<const ClothModel>>& models) {
    const Snapshot saved = world.save();
    ASSERT_EQ(saved.cloths.size(), models.size());
    MeasureSums sums;
    for (std::size_t i = 0; i < models.size(); ++i) sums.add(on_host(*models[i], saved.cloths[i]));
    expect_near(world.measure(), sums.result());
}

class VulkanMeasures : public testing::TestWithParam<const char*> {
  protected:
    static World world_of(const std::vector<std::shared_ptr<const ClothModel>>& models,
                          const WorldSettings& settings = {.solver = {.substeps = 3}}) {
        World world(checked_vulkan_backend({.execution = GetParam()}), settings);
        for (const auto& model : models) EXPECT_TRUE(world.try_add(model).ok());
        return world;
    }
};

// Labels: no-asan
// Labels with "fused": long
TEST_P(VulkanMeasures, are_those_of_the_host_frame_by_frame) {
    const Sheet sheets[] = {{grid(30), {0, 29}},
                            {grid(15, GridDiagonal::cross), {0}},
                            {irregular(20), {0, 19, 150}},
                            {make_sphere(0.5f, 2), {0}},
                            {grid(14), {0, 13}, Projection::jacobi},
                            {grid(20), {0, 19}, Projection::lines, {.lines = true, .hierarchy = true}}};
    for (const Sheet& sheet : sheets) {
        const std::vector models{model_of(sheet)};
        World world = world_of(models, {.solver = {.substeps = 3,
                                                   .iterations = sheet.projection == Projection::jacobi ? 6u : 2u,
                                                   .projection = sheet.projection,
                                                   .hierarchy = sheet.layout.hierarchy}});
        expect_as_on_host(world, models);  // at rest
        for (int frame = 0; frame < 2; ++frame) {
            world.advance(1.0 / 60);
            expect_as_on_host(world, models);
        }
        EXPECT_GT(world.measure().strain.shear.mean, 0);
        EXPECT_GT(world.measure().residual.max, 0);
        EXPECT_GT(world.measure().max_speed, 0);
    }
}

// Labels with "fused": long
TEST_P(VulkanMeasures, of_several_cloths_weigh_each_by_its_edges) {
    const auto small = model_of({grid(8), {0}}), large = model_of({irregular(25), {0, 24}});
    const std::vector models{small, large, small};
    World world = world_of(models, {.solver = {.substeps = 2, .projection = Projection::gauss_seidel}});
    for (int frame = 0; frame < 2; ++frame) world.advance(1.0 / 60);
    expect_as_on_host(world, models);
}

TEST_P(VulkanMeasures, are_the_same_bits_every_time_and_after_coming_back) {
    const std::vector models{model_of({irregular(25), {0}})};
    World world = world_of(models);
    for (int frame = 0; frame < 2; ++frame) world.advance(1.0 / 60);
    const Snapshot kept = world.save();
    const auto then = bits(world.measure());
    EXPECT_EQ(bits(world.measure()), then);
    world.advance(1.0 / 60);
    EXPECT_NE(bits(world.measure()), then);
    ASSERT_TRUE(world.restore(kept).ok());
    EXPECT_EQ(bits(world.measure()), then);
    World other = world_of(models);
    ASSERT_TRUE(other.restore(kept).ok());
    EXPECT_EQ(bits(other.measure()), then);
}

INSTANTIATE_TEST_SUITE_P(, VulkanMeasures, testing::Values("streamed", "grouped", "fused"));

// A cloth with a given state, without a step.
struct Placed {
    explicit Placed(std::shared_ptr<const ClothModel> of, VulkanOptions options = {})
        : model(std::move(of)),
          backend(checked_vulkan_backend(std::move(options))),
          cloth(*backend->add_cloth(model, AddressSpace::reserved)) {
        state = backend->save(cloth);
        for (Vec4& v : state.velocity) v = {};
    }
    ClothMeasures measure() const {
        MeasureSums sums;
        backend->measure(cloth, sums);
        return sums.result();
    }
    void put() const { ASSERT_TRUE(backend->restore(cloth, state).ok()); }

    std::shared_ptr<const ClothModel> model;
    std::unique_ptr<Backend> backend;
    ClothHandle cloth;
    ClothSnapshot state;
};

// Multipliers that leave a residual of about 1e-4 of the error of the constraint.
void nearly_solve(const ClothModel& model, ClothSnapshot& state) {
    const ConstraintTable& table = model.table(ConstraintKind::stretch);
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row)) continue;
        const Vec4 &a = state.position[table.particles[row]], &b = state.position[table.particles[table.stride + row]];
        const double c = distance(a.xyz(), b.xyz()) - table.fields[row];
        const double compliance = table.fields[(c > 0 ? 1 : 2) * std::size_t{table.stride} + row];
        const double h = state.substep_seconds;
        if (compliance > 0) state.kept[row] = static_cast<float>(-c * h * h / compliance * (1 + 1e-4 * (row % 3)));
    }
}

// About 100 000 particles in 49 tiles, with about 150 tiles of edges, far from the origin. Strains range from one
// rounding error to large ones.
TEST(VulkanMeasuring, of_many_particles_keep_their_digits) {
    Placed placed(model_of({grid(317), {0, 316}}));
    const std::vector<Vec4> rest = placed.state.position;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1, 1);
    placed.state.substep_seconds = 1.0 / 1170;
    for (float& lambda : placed.state.kept) lambda = 1e-6f * unit(random);
    for (const float amount : {0.0f, 1e-6f, 1e-3f, 1.0f}) {
        for (std::size_t p = 0; p < rest.size(); ++p) {
            placed.state.position[p] = {rest[p].x + amount / 317 * unit(random) + 10, rest[p].y,
                                        rest[p].z + amount / 317 * unit(random), rest[p].w};
            placed.state.velocity[p] = {amount * unit(random), 3 * amount * unit(random), amount * unit(random), 0};
        }
        placed.put();
        expect_near(placed.measure(), on_host(*placed.model, placed.state).result());
        ClothSnapshot solved = placed.state;
        nearly_solve(*placed.model, solved);
        ASSERT_TRUE(placed.backend->restore(placed.cloth, solved).ok());
        const ClothMeasures host = on_host(*placed.model, solved).result();
        expect_near(placed.measure(), host);
        if (amount > 1e-3f) {
            EXPECT_LT(host.residual.mean, 1e-3 * host.strain.stretch.mean) << "little is left";
        }
    }
}

TEST(VulkanMeasuring, see_a_single_number_that_is_not_finite) {
    Placed placed(model_of({grid(70), {0}}));
    const ClothSnapshot sound = placed.state;
    placed.put();
    EXPECT_TRUE(placed.measure().finite);
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (const float number : bad) {
        for (const std::size_t particle : {std::size_t{0}, std::size_t{2500}, sound.position.size() - 1}) {
            if (particle >= placed.model->particle_count) continue;
            placed.state = sound;
            placed.state.position[particle].y = number;
            placed.put();
            const ClothMeasures moved = placed.measure();
            EXPECT_FALSE(moved.finite) << number << " at " << particle;
            EXPECT_FALSE(std::isfinite(moved.strain.stretch.max)) << number << " at " << particle;
            EXPECT_FALSE(std::isfinite(moved.strain.stretch.mean)) << number << " at " << particle;
            EXPECT_EQ(moved.max_speed, 0);

            placed.state = sound;
            placed.state.velocity[particle].z = number;
            placed.put();
            const ClothMeasures fast = placed.measure();
            EXPECT_FALSE(fast.finite) << number << " at " << particle;
            EXPECT_FALSE(std::isfinite(fast.max_speed)) << number << " at " << particle;
            EXPECT_EQ(fast.strain.stretch.max, 0);
        }
    }
}

// Finite, but its square overflows a float.
TEST(VulkanMeasuring, of_what_floats_cannot_square_are_those_of_the_host) {
    Placed placed(model_of({grid(5), {}}));
    placed.state.velocity[3].x = 1e25f;
    placed.state.position[4].y = -1e30f;
    placed.put();
    const ClothMeasures measures = placed.measure();
    EXPECT_TRUE(measures.finite);
    EXPECT_NEAR(measures.max_speed, 1e25, 1e19);
    EXPECT_NEAR(measures.strain.stretch.max, 4e30, 1e25) << "edges of a quarter of a meter";
}

std::shared_ptr<ClothModel> three_loose_particles(std::array<float, 3> x = {0, 1, 2}) {
    auto loose = std::make_shared<ClothModel>();
    loose->name = "loose";
    loose->particle_count = 3;
    AlignedVector<Vec4> start(loose->capacity());
    for (std::uint32_t p = 0; p < 3; ++p) start[p] = {x[p], 0, 0, p == 0 ? 0.0f : 2.0f};
    loose->start = std::move(start);
    loose->mass = std::vector<float>{5, 0.5f, 0.5f};
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        const auto as_kind = static_cast<ConstraintKind>(kind);
        loose->constraints[kind] = pack_rows(as_kind, make_rows(as_kind), 3);
    }
    loose->around =
        std::make_shared<FacesAround>(lay_out_around({.offsets = std::vector<std::uint32_t>(4), .items = {}}, 0));
    return loose;
}

TEST(VulkanMeasuring, are_nothing_where_there_is_nothing_to_measure) {
    const auto chain = three_loose_particles({0, 1, 1});  // two particles of it at the same place, and no shear
    chain->edges = std::make_shared<ClothEdges>(
        ClothEdges{.axial_rows = {}, .without_row = {{0, 1}, {1, 2}}, .axial_without_row = 2});

    Placed one(three_loose_particles());
    one.state.velocity[0] = {0, 4, 0, 0};  // pinned, so it has no energy
    one.state.velocity[1] = {0, 0, 2, 0};
    one.put();
    const ClothMeasures free = one.measure();
    EXPECT_EQ(free.strain.stretch.mean + free.strain.stretch.max + free.strain.shear.mean + free.strain.shear.max, 0);
    EXPECT_EQ(free.residual.mean + free.residual.max, 0);
    EXPECT_DOUBLE_EQ(free.kinetic_energy, 1);
    EXPECT_DOUBLE_EQ(free.max_speed, 4);
    EXPECT_TRUE(free.finite);
    one.state.position[2].z = std::numeric_limits<float>::quiet_NaN();
    one.put();
    EXPECT_FALSE(one.measure().finite) << "though nothing hangs on it";

    Placed other(chain);
    other.state.position[1].x = 1.5f;
    other.put();
    EXPECT_DOUBLE_EQ(other.measure().strain.stretch.mean, 0.5) << "the other edge has no length at rest";
    EXPECT_EQ(other.measure().strain.shear.max, 0);
}

std::uint64_t bytes_copied = 0;
PFN_vkCmdCopyBuffer real_copy = nullptr;

void VKAPI_CALL count_copy(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                           const VkBufferCopy* regions) {
    for (std::uint32_t i = 0; i < count; ++i) bytes_copied += regions[i].size;
    real_copy(commands, from, to, count, regions);
}

TEST(VulkanMeasuring, leave_the_cloth_where_it_is) {
    Placed placed(model_of({grid(40), {0}}), {.intercept = [](VolkDeviceTable& table) {
                      real_copy = table.vkCmdCopyBuffer;
                      table.vkCmdCopyBuffer = count_copy;
                  }});
    placed.put();
    const std::uint64_t without = placed.backend->device_bytes();
    EXPECT_GT(without, 40 * 40 * 64u);
    bytes_copied = 0;
    const ClothMeasures first = placed.measure();
    const EdgesByDirection all = edges_by_direction(*placed.model);
    const std::uint64_t lists = bytes_copied, edges = all.axial.size() + all.others.size();
    EXPECT_GE(lists, 40 * 40 * 4 + edges * 16) << "masses and edges go up when they are first asked for";
    EXPECT_LT(lists, 40 * 40 * 4 + edges * 16 + 1024);
    EXPECT_GE(placed.backend->device_bytes(), without + lists);
    EXPECT_EQ(bits(placed.measure()), bits(first));
    EXPECT_EQ(bytes_copied, lists) << "and nothing comes back";
}

int buffers_that_fail = 0;
PFN_vkCreateBuffer real_create = nullptr;

VkResult VKAPI_CALL fail_some(VkDevice device, const VkBufferCreateInfo* info, const VkAllocationCallbacks* with,
                              VkBuffer* buffer) {
    if (buffers_that_fail-- > 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return real_create(device, info, with, buffer);
}

TEST(VulkanMeasuring, are_found_on_the_host_where_the_device_has_no_room) {
    buffers_that_fail = 0;
    Placed placed(model_of({irregular(20), {0}}), {.intercept = [](VolkDeviceTable& table) {
                      real_create = table.vkCreateBuffer;
                      table.vkCreateBuffer = fail_some;
                  }});
    placed.state.velocity[7] = {1, 2, 3, 0};
    placed.state.position[9].x += 0.01f;
    placed.put();
    const ClothMeasures host = on_host(*placed.model, placed.state).result();
    buffers_that_fail = 1;
    EXPECT_EQ(bits(placed.measure()), bits(host)) << "to the bit";
    expect_near(placed.measure(), host);
    EXPECT_NE(bits(placed.measure()), bits(host)) << "on the device again, in other digits";
}

}  // namespace
}  // namespace weft
