// Cloth that tears by itself.

#include "sheet.h"

#include "solver/measures/tension.h"

#include <cmath>
#include <cstdio>

namespace weft::physical {
namespace {

struct StripDesc {
    std::array<float, 2> size{0.25f, 1};
    std::array<std::uint32_t, 2> resolution{9, 33};
    float jitter = 0;  ///< in cells
    Fabric fabric = {};
    std::function<bool(Vec3)> pinned = {};
    bool lines = true;
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
                         .layout = {.lines = desc.lines, .hierarchy = desc.lines},
                         .reserve = {.particles = 600, .openings = true, .tears = true}};
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
    WorldSettings settings{
        .solver = {.substeps = substeps, .projection = Projection::lines, .hierarchy = !std::getenv("NOLEVELS")}};
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

Fabric rubber() {
    Fabric fabric = find_fabric("rubber")->fabric;
    fabric.body.damping = 0.02f;
    return fabric;
}

TEST(Tearing, of_a_hanging_strip_begins_at_its_strength) {
    for (const std::uint32_t cells : {16u, 32u, 64u}) {
        for (const double part : {0.9, 1.1}) {
            const auto model =
                make_strip({.resolution = {cells / 4 + 1, cells + 1}, .fabric = rubber(), .pinned = [](Vec3 x) {
                                return x.y > 0.499f;
                            }});
            const World world = hang(
                model, part, 3, std::getenv("SUB") ? static_cast<std::uint32_t>(std::atoi(std::getenv("SUB"))) : 20);
            const ClothFrame& cloth = world.frame().cloths[0];
            std::printf(
                "length %.3f tension %.3f ",
                [&] {
                    float low = 0;
                    for (const Vec4& x : cloth.positions) low = std::min(low, x.y);
                    return 0.5 - low;
                }(),
                TensionMeter().measure(world.frame()).most->value / double(model->fabric.tear.strength[1]));
            std::printf("cells %u part %.2f: pieces %u, torn at %.2f s, load %.3f, copies %zu\n", cells, part,
                        pieces_of(*cloth.model), world.time(), load_of(world), cloth.model->copied_from.size());
            EXPECT_EQ(pieces_of(*cloth.model), part > 1 ? 2u : 1u);
            for (const std::uint32_t p : cloth.model->copied_from)
                EXPECT_GT(cloth.model->rest_position(p).y, 0.3f) << "tears near the top";
        }
    }
}

}  // namespace
}  // namespace weft::physical
