// Compares surfaces that the device computes with those of a frame: bit for bit if the device rounds as IEEE 754 says.

#include "losing_device.h"
#include "read_back.h"
#include "vulkan_fixture.h"

#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "solver/model/cuts.h"
#include "solver/world/world.h"
#include "vulkan/interop.h"

#include <bit>
#include <functional>
#include <numbers>
#include <random>

namespace weft {
namespace {

struct ModelDesc {
    TriangleMesh mesh = {};
    std::optional<TriangleMesh> render_mesh = {};
    std::vector<std::uint32_t> pins = {0};
    ClothReserve reserve = {};
};

std::shared_ptr<const ClothModel> make_model(ModelDesc desc) {
    auto topology = build_topology(desc.mesh, {.reorder = true});
    EXPECT_TRUE(topology.ok());
    auto model = build_cloth_model({.name = "cloth",
                                    .mesh = desc.mesh,
                                    .render_mesh = desc.render_mesh,
                                    .pins = {.particles = desc.pins},
                                    .reserve = desc.reserve},
                                   std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

TriangleMesh sheet(std::array<std::uint32_t, 2> resolution = {9, 7}) {
    return make_grid({1, 1}, resolution, GridDiagonal::alternating);
}

/// A sheet rolled into a tube. Both sides of its seam have the same positions and different UVs.
TriangleMesh tube() {
    TriangleMesh mesh = sheet({13, 6});
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        Vec3& p = mesh.positions[v];
        const double angle = 2 * std::numbers::pi * static_cast<double>(v % 13 % 12) / 12;
        p = {static_cast<float>(0.2 * std::cos(angle)), p.z, static_cast<float>(0.2 * std::sin(angle))};
    }
    return mesh;
}

/// Degenerate, mirrored, huge and tiny UVs.
TriangleMesh with_odd_uvs() {
    TriangleMesh mesh = sheet();
    std::mt19937 random(3);
    for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
        const auto number = [&] { return static_cast<float>(random() % 2001) / 1000 - 1; };
        if (v < 20) mesh.uvs[v] = {0.5f, 0.5f};
        if (v >= 20 && v < 30) mesh.uvs[v] = {static_cast<float>(v), 2 * static_cast<float>(v)};
        if (v >= 40) mesh.uvs[v] = {number() * (v % 2 ? 1e15f : 1e-12f), number()};
    }
    return mesh;
}

/// Unused vertices, triangles without area and duplicate triangles.
TriangleMesh messy() {
    TriangleMesh mesh = sheet();
    mesh.positions.insert(mesh.positions.begin() + 5, Vec3{3, 4, 5});
    mesh.uvs.insert(mesh.uvs.begin() + 5, Vec2{1, 1});
    for (Triangle& triangle : mesh.triangles)
        for (std::uint32_t& v : triangle) v += v >= 5;
    mesh.positions.push_back({-1, -2, -3});
    mesh.uvs.push_back({0, 0});
    mesh.triangles.push_back(mesh.triangles[3]);
    mesh.triangles.push_back({0, 0, 1});
    return mesh;
}

class VulkanSurfaces : public testing::Test {
  protected:
    VulkanSurfaces() { open(); }

    void open(const WorldSettings& settings = {.solver = {.substeps = 4}}, VulkanOptions options = {}) {
        reader_.reset();
        world_.reset();
        world_ = std::make_unique<World>(checked_vulkan_backend(std::move(options)), settings);
        interop_ = dynamic_cast<VulkanInterop*>(&world_->backend());
        ASSERT_NE(interop_, nullptr);
        reader_.emplace(device().physical(), device().handle(), device().queue(), device().queue_family());
        exact_ = device().info().name.find("llvmpipe") != std::string::npos;
    }

    World& world() { return *world_; }
    gpu::Device& device() { return *interop_->shared_device(); }
    ClothId add(ModelDesc desc) {
        auto id = world().try_add(make_model(std::move(desc)));
        EXPECT_TRUE(id.ok());
        return *id;
    }
    void step(int frames = 1) {
        for (int i = 0; i < frames; ++i) world().advance(1.0 / 60);
        EXPECT_EQ(world().summary().reports, report_none);
    }
    gpu::SurfaceBuffers surface(ClothId id, gpu::Moment before = {}) {
        auto surface = interop_->surface(world().handle(id), before);
        EXPECT_TRUE(surface.ok()) << surface.error().message();
        return surface.ok() ? *surface : gpu::SurfaceBuffers{};
    }
    /// A semaphore of the host. The test destroys it.
    VkSemaphore make_timeline() {
        VkSemaphoreTypeCreateInfo type{};
        type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
        type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
        VkSemaphoreCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        info.pNext = &type;
        VkSemaphore semaphore = VK_NULL_HANDLE;
        EXPECT_EQ(reader_->vk().vkCreateSemaphore(device().handle(), &info, nullptr, &semaphore), VK_SUCCESS);
        return semaphore;
    }
    template <class T>
    std::vector<T> read(const gpu::BufferRange& range, gpu::Moment ready) {
        return reader_->read<T>(range.buffer, range.offset, range.size / sizeof(T), ready.semaphore, ready.value);
    }

    void expect_same(const std::vector<Vec4>& device, const std::vector<Vec4>& cpu, const char* what) {
        ASSERT_EQ(device.size(), cpu.size()) << what;
        for (std::size_t v = 0; v < cpu.size(); ++v) {
            const auto bits = [](const Vec4& a) { return std::bit_cast<std::array<std::uint32_t, 4>>(a); };
            if (exact_) {
                ASSERT_EQ(bits(device[v]), bits(cpu[v])) << what << " of vertex " << v;
            } else {
                ASSERT_LT(length(device[v].xyz() - cpu[v].xyz()), 1e-4f) << what << " of vertex " << v;
                ASSERT_EQ(device[v].w, cpu[v].w) << what << " of vertex " << v;
            }
        }
    }

    /// Compares the current state.
    void expect_surface_of_cpu(ClothId id) {
        const gpu::SurfaceBuffers buffers = surface(id);
        const Frame& frame = world().frame();
        const auto& cloth = *std::ranges::find(frame.cloths, id, &ClothFrame::id);
        const RenderMesh& mesh = cloth.render_mesh();
        const std::vector<Vec4> tangents(cloth.tangents().begin(), cloth.tangents().end());
        const auto wide = [](const std::vector<Vec3>& array, float w) {
            std::vector<Vec4> all;
            for (const Vec3 v : array) all.push_back({v.x, v.y, v.z, w});
            return all;
        };
        EXPECT_EQ(buffers.vertex_count, mesh.positions.size());
        EXPECT_EQ(buffers.triangle_count, mesh.triangles.size());
        EXPECT_EQ(buffers.topology_version, cloth.topology_version);
        expect_same(read<Vec4>(buffers.positions, buffers.ready), wide(mesh.positions, 1), "position");
        expect_same(read<Vec4>(buffers.normals, buffers.ready), wide(mesh.normals, 0), "normal");
        expect_same(read<Vec4>(buffers.tangents, buffers.ready), tangents, "tangent");
        EXPECT_TRUE(std::ranges::equal(read<Vec2>(buffers.uvs, buffers.ready), mesh.uvs));
        EXPECT_TRUE(std::ranges::equal(read<Triangle>(buffers.triangles, buffers.ready), mesh.triangles));
        EXPECT_EQ(buffers.tangents.buffer == VK_NULL_HANDLE, mesh.uvs.empty());
        EXPECT_EQ(buffers.uvs.buffer == VK_NULL_HANDLE, mesh.uvs.empty());
    }

    /// At the start and while it moves.
    void expect_surfaces_of_cpu(ModelDesc desc) {
        const ClothId id = add(std::move(desc));
        expect_surface_of_cpu(id);
        for (int i = 0; i < 3; ++i) {
            step(2);
            expect_surface_of_cpu(id);
        }
        EXPECT_LT(world().frame().cloths.back().velocities.back().y, 0) << "it falls";
    }

    /// Before and after a cut through the middle.
    void expect_surfaces_of_cpu_when_cut(ModelDesc desc) {
        desc.reserve = {.particles = 100, .openings = true};
        const ClothId id = add(std::move(desc));
        step(2);
        expect_surface_of_cpu(id);
        const std::uint32_t vertices = surface(id).vertex_count;
        const auto positions = world().frame().cloths[0].positions;
        const std::vector<Opening> middle = openings_along_plane(*world().model(id), positions, {}, {1, 0, 0});
        ASSERT_TRUE(world().edit(id, {.openings = middle}).ok());
        EXPECT_GT(surface(id).vertex_count, vertices);
        expect_surface_of_cpu(id);
        for (int i = 0; i < 3; ++i) {
            step(2);
            expect_surface_of_cpu(id);
        }
    }

    std::unique_ptr<World> world_;
    VulkanInterop* interop_ = nullptr;
    std::optional<ReadBack> reader_;
    bool exact_ = false;
};

TEST_F(VulkanSurfaces, of_a_grid) {
    expect_surfaces_of_cpu({.mesh = sheet()});
}

TEST_F(VulkanSurfaces, without_uvs) {
    expect_surfaces_of_cpu({.mesh = make_sphere(0.3f, 2)});
}

TEST_F(VulkanSurfaces, with_a_seam) {
    const TriangleMesh mesh = tube();
    const auto model = make_model({.mesh = mesh});
    ASSERT_LT(model->particle_count, mesh.positions.size()) << "the seam is welded";
    expect_surfaces_of_cpu({.mesh = mesh});
}

TEST_F(VulkanSurfaces, with_uvs_without_an_area) {
    expect_surfaces_of_cpu({.mesh = with_odd_uvs()});
}

TEST_F(VulkanSurfaces, with_vertices_and_triangles_that_are_not_simulated) {
    expect_surfaces_of_cpu({.mesh = messy()});
    const auto& cloth = world().frame().cloths[0];
    ASSERT_EQ(cloth.model->vertex_to_particle[5], none);
    const gpu::SurfaceBuffers buffers = surface(cloth.id);
    EXPECT_EQ(read<Vec4>(buffers.positions, buffers.ready)[5], (Vec4{3, 4, 5, 1})) << "it stays where it was";
}

TEST_F(VulkanSurfaces, that_follow_another_mesh) {
    TriangleMesh fine = make_grid({1.1f, 0.9f}, {31, 17}, GridDiagonal::cross);
    for (Vec3& p : fine.positions) p.y += 0.02f * std::sin(20 * p.x);
    expect_surfaces_of_cpu({.mesh = sheet(), .render_mesh = fine});
    TriangleMesh ball = make_sphere(0.35f, 3);
    ball.normals.clear();
    expect_surfaces_of_cpu({.mesh = make_sphere(0.3f, 1), .render_mesh = ball});
}

TEST_F(VulkanSurfaces, of_cloth_with_seams_that_is_cut) {
    expect_surfaces_of_cpu_when_cut(
        {.mesh = testing_meshes::with_seams(sheet(), [](Vec3 at) { return 2 * (at.x > 0.2f) + (at.z > 0); })});
}

TEST_F(VulkanSurfaces, of_a_render_mesh_that_is_cut) {
    TriangleMesh fine = make_grid({1.1f, 0.9f}, {31, 17}, GridDiagonal::cross);
    for (Vec3& p : fine.positions) p.y += 0.02f * std::sin(20 * p.x);
    expect_surfaces_of_cpu_when_cut({.mesh = sheet(), .render_mesh = fine});
}

// Random positions, some of them with normals and tangents of zero.
TEST_F(VulkanSurfaces, of_particles_that_are_anywhere) {
    TriangleMesh fine = make_grid({1, 1}, {20, 20}, GridDiagonal::uniform);
    const ClothId bound = add({.mesh = sheet(), .render_mesh = fine}), welded = add({.mesh = with_odd_uvs()});
    std::mt19937 random(5);
    for (int round = 0; round < 3; ++round) {
        Snapshot state = world().save();
        for (ClothSnapshot& cloth : state.cloths)
            for (Vec4& p : cloth.position) {
                const auto number = [&] { return static_cast<float>(random() % 7) / 3 - 1; };
                p = {number(), round == 0 ? 0.0f : number(), number(), p.w};
            }
        ASSERT_TRUE(world().restore(state).ok());
        expect_surface_of_cpu(bound);
        expect_surface_of_cpu(welded);
    }
}

TEST_F(VulkanSurfaces, are_made_once_a_frame) {
    const ClothId id = add({.mesh = sheet()});
    step();
    const gpu::SurfaceBuffers first = surface(id);
    const std::uint64_t submitted = device().submitted();
    EXPECT_EQ(first.ready.value, submitted);
    const gpu::SurfaceBuffers again = surface(id);
    EXPECT_EQ(device().submitted(), submitted);
    EXPECT_EQ(again.ready.value, first.ready.value);
    EXPECT_EQ(again.positions.offset, first.positions.offset);
    step();
    EXPECT_GT(surface(id).ready.value, first.ready.value);
}

TEST_F(VulkanSurfaces, take_turns) {
    const ClothId id = add({.mesh = sheet()});
    step();
    const gpu::SurfaceBuffers first = surface(id);
    const auto positions = read<Vec4>(first.positions, first.ready);
    step();
    const gpu::SurfaceBuffers second = surface(id);
    EXPECT_NE(second.positions.buffer, first.positions.buffer);
    EXPECT_EQ(second.triangles.buffer, first.triangles.buffer);
    EXPECT_EQ(read<Vec4>(first.positions, second.ready), positions) << "what the last frame gave stays";
    EXPECT_NE(read<Vec4>(second.positions, second.ready), positions);
    step();
    const gpu::SurfaceBuffers third = surface(id);
    EXPECT_EQ(third.positions.buffer, first.positions.buffer);
    EXPECT_NE(read<Vec4>(third.positions, third.ready), positions);
}

TEST_F(VulkanSurfaces, wait_for_the_moment_that_a_host_names) {
    const ClothId id = add({.mesh = sheet()});
    step();
    const VolkDeviceTable& vk = reader_->vk();
    VkSemaphore semaphore = make_timeline();

    const gpu::SurfaceBuffers buffers = surface(id, {semaphore, 3});
    VkSemaphoreWaitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    wait.semaphoreCount = 1;
    wait.pSemaphores = &buffers.ready.semaphore;
    wait.pValues = &buffers.ready.value;
    EXPECT_EQ(vk.vkWaitSemaphores(device().handle(), &wait, 50'000'000), VK_TIMEOUT);
    VkSemaphoreSignalInfo signal{};
    signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
    signal.semaphore = semaphore;
    signal.value = 3;
    ASSERT_EQ(vk.vkSignalSemaphore(device().handle(), &signal), VK_SUCCESS);
    EXPECT_EQ(vk.vkWaitSemaphores(device().handle(), &wait, ~std::uint64_t{0}), VK_SUCCESS);
    expect_surface_of_cpu(id);
    vk.vkDestroySemaphore(device().handle(), semaphore, nullptr);
}

// The frame finishes before the surface is computed, so queries of the frame do not wait for the host.
TEST_F(VulkanSurfaces, that_wait_for_a_host_do_not_delay_queries) {
    const ClothId id = add({.mesh = sheet()});
    step();
    (void)surface(id);
    const VolkDeviceTable& vk = reader_->vk();
    VkSemaphore semaphore = make_timeline();

    world().advance(1.0 / 60);
    const gpu::SurfaceBuffers buffers = surface(id, {semaphore, 1});
    EXPECT_EQ(world().summary().reports, report_none) << "without a signal";
    EXPECT_EQ(world().summary().index, 2u);
    std::uint64_t reached = 0;
    ASSERT_EQ(vk.vkGetSemaphoreCounterValue(device().handle(), buffers.ready.semaphore, &reached), VK_SUCCESS);
    EXPECT_LT(reached, buffers.ready.value);
    VkSemaphoreSignalInfo signal{};
    signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
    signal.semaphore = semaphore;
    signal.value = 1;
    ASSERT_EQ(vk.vkSignalSemaphore(device().handle(), &signal), VK_SUCCESS);
    expect_surface_of_cpu(id);
    vk.vkDestroySemaphore(device().handle(), semaphore, nullptr);
}

TEST_F(VulkanSurfaces, follow_changes_between_frames) {
    const ClothId id = add({.mesh = sheet()}), other = add({.mesh = tube()});
    step(2);
    expect_surface_of_cpu(id);
    const Snapshot early = world().save();
    step(3);
    const gpu::SurfaceBuffers before = surface(id);
    const auto late = read<Vec4>(before.positions, before.ready);
    ASSERT_TRUE(world().restore(early).ok());
    expect_surface_of_cpu(id);
    const gpu::SurfaceBuffers after = surface(id);
    EXPECT_NE(read<Vec4>(after.positions, after.ready), late);

    ASSERT_TRUE(world().set_model(id, make_model({.mesh = sheet(), .pins = {3, 4}}), {}).ok());
    expect_surface_of_cpu(id);
    step();
    expect_surface_of_cpu(id);
    world().remove(id);
    step();
    expect_surface_of_cpu(other);
    const ClothId third = add({.mesh = messy()});
    step();
    expect_surface_of_cpu(third);
    expect_surface_of_cpu(other);
}

TEST_F(VulkanSurfaces, of_one_model_share_what_does_not_move) {
    const auto model = make_model({.mesh = sheet()});
    const ClothId a = *world().try_add(model), b = *world().try_add(model);
    step();
    EXPECT_EQ(surface(a).triangles.buffer, surface(b).triangles.buffer);
    EXPECT_NE(surface(a).positions.buffer, surface(b).positions.buffer);
    world().remove(a);
    expect_surface_of_cpu(b);
}

TEST_F(VulkanSurfaces, have_normals_where_the_frame_has_none) {
    open({.solver = {.substeps = 4}, .surface = false});
    const ClothId id = add({.mesh = sheet()});
    step(5);
    const gpu::SurfaceBuffers buffers = surface(id);
    const auto normals = read<Vec4>(buffers.normals, buffers.ready);
    open();
    const ClothId with = add({.mesh = sheet()});
    step(5);
    const gpu::SurfaceBuffers expected = surface(with);
    EXPECT_EQ(normals, read<Vec4>(expected.normals, expected.ready));
    EXPECT_FALSE(std::ranges::all_of(normals, [](Vec4 n) { return n == Vec4{0, 1, 0, 0}; })) << "it is not flat";
}

TEST_F(VulkanSurfaces, for_which_there_is_no_room_are_an_error) {
    open({.solver = {.substeps = 4}}, {.memory_limit = 3 << 20});
    const ClothId small = add({.mesh = sheet()});
    const ClothId large = add({.mesh = sheet(), .render_mesh = make_grid({1, 1}, {150, 150}, GridDiagonal::uniform)});
    step();
    const auto none_left = interop_->surface(world().handle(large));
    ASSERT_FALSE(none_left.ok());
    EXPECT_EQ(none_left.error().fault, Fault::machine);
    EXPECT_NE(none_left.error().message().find("VK_ERROR_OUT_OF_DEVICE_MEMORY"), std::string::npos)
        << none_left.error().message();
    step();
    expect_surface_of_cpu(small);
}

TEST_F(VulkanSurfaces, of_a_lost_device_are_an_error) {
    open({.solver = {.substeps = 4}}, {.intercept = losing_device::intercept});
    const ClothId id = add({.mesh = sheet()});
    step();
    losing_device::submits_left = 0;
    for (int i = 0; i < 2; ++i) {
        const auto lost = interop_->surface(world().handle(id));
        ASSERT_FALSE(lost.ok());
        EXPECT_EQ(lost.error().fault, Fault::machine);
        EXPECT_NE(lost.error().message().find("VK_ERROR_DEVICE_LOST"), std::string::npos) << lost.error().message();
    }
    losing_device::submits_left = losing_device::never;
    expect_surface_of_cpu(id);
}

}  // namespace
}  // namespace weft
