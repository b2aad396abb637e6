#include "solver/model/rebuilt_limits.h"

#include "mesh/edges.h"
#include "mesh/grouping.h"
#include "solver/model/pin_spans.h"

#include <cmath>

namespace weft {
namespace {

// The mesh of the triangles that are there.
struct CurrentMesh {
    Topology topology;
    std::vector<float> area;
    std::vector<Vec3> warp;
};

Adjacency adjacency(Groups<std::uint32_t> groups) {
    return {std::move(groups.offsets), std::move(groups.items)};
}

Vec3 warp_of(const ClothModel& model, std::uint32_t t) {
    const auto [a, b, c] = model.triangles()[t];
    const Vec3 side = normalized(model.rest_position(b) - model.rest_position(a));
    const Vec3 normal = normalized(cross(side, model.rest_position(c) - model.rest_position(a)));
    return side * std::cos(model.face_warp[t]) + cross(normal, side) * std::sin(model.face_warp[t]);
}

CurrentMesh current_mesh(const ClothModel& model) {
    CurrentMesh mesh;
    Topology& topology = mesh.topology;
    const std::uint32_t count = topology.particle_count = model.particle_count;
    for (std::uint32_t p = 0; p < count; ++p) topology.rest_positions.push_back(model.rest_position(p));
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        if (!(model.face_area[t] > 0)) continue;
        topology.triangles.push_back(model.triangles()[t]);
        mesh.area.push_back(model.face_area[t]);
        mesh.warp.push_back(warp_of(model, t));
    }
    EdgeList edges = build_edges(topology.triangles, count);
    topology.hinges = build_hinges(edges, topology.triangles).hinges;
    topology.edges = std::move(edges.edges);
    topology.particle_edges = adjacency(group_items<std::uint32_t>(count, [&](auto put) {
        for (std::uint32_t e = 0; e < topology.edges.size(); ++e)
            put(topology.edges[e].a, e), put(topology.edges[e].b, e);
    }));
    topology.particle_triangles = adjacency(group_items<std::uint32_t>(count, [&](auto put) {
        for (std::uint32_t t = 0; t < topology.triangles.size(); ++t)
            for (const std::uint32_t p : topology.triangles[t]) put(p, t);
    }));
    topology.boundary.resize(count);
    for (const Edge& edge : topology.edges)
        if (edge.triangle1 == none) topology.boundary[edge.a] = topology.boundary[edge.b] = 1;
    return mesh;
}

void rebuild_tethers(ClothModel& model, const RestShape& rest) {
    constexpr auto kind = ConstraintKind::tether;
    const RowList rows = build_tether(rest, model.fabric.tether);
    ConstraintTable table = pack_rows(kind, rows, model.room());
    if (model.reserved.constraints > 0 && table.rows > 0) add_spare_rows(table, model.reserved.constraints);
    model.constraints[static_cast<std::uint32_t>(kind)] = std::move(table);
}

}  // namespace

void rebuild_limits(ClothModel& model) {
    const bool has_tethers = model.table(ConstraintKind::tether).rows > 0;
    if (model.hierarchy.empty() && !has_tethers) return;
    CurrentMesh mesh = current_mesh(model);
    RestShape rest = make_rest_shape(mesh.topology, std::move(mesh.area), std::move(mesh.warp));
    rest.elasticity = model.elasticity;
    rest.mean_density = mean_density(model);
    rest.first_anchor = model.first_anchor();
    rest.pinned.resize(model.particle_count);
    for (std::uint32_t p = 0; p < model.particle_count; ++p) rest.pinned[p] = !(model.start[p].w > 0);
    if (has_tethers) rebuild_tethers(model, rest);
    if (model.hierarchy.empty()) return;
    const bool lines = !model.table(ConstraintKind::stretch).blocks.empty();
    model.set_hierarchy(
        build_hierarchy(rest, model.fabric, model.start, lines ? FinestLevel::every_fourth : FinestLevel::every_second),
        mesh.topology.rest_positions);
    model.pruned = nullptr;
}

std::shared_ptr<const ClothModel> with_rebuilt_limits(const ClothModel& model) {
    auto rebuilt = std::make_shared<ClothModel>(model);
    rebuild_limits(*rebuilt);
    return rebuilt;
}

}  // namespace weft
