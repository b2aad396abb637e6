#include "solver/cloth_model.h"

#include "physics/tether/held_places.h"
#include "scene/problems.h"
#include "scene/scene_keys.h"
#include "solver/lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

std::vector<float> lump_masses(const RestShape& rest, float density) {
    std::vector<double> sum(rest.topology.particle_count);
    for (std::size_t t = 0; t < rest.topology.triangles.size(); ++t) {
        const double third = static_cast<double>(density) * rest.area[t] / 3;
        for (std::uint32_t p : rest.topology.triangles[t]) sum[p] += third;
    }
    return {sum.begin(), sum.end()};
}

Result<Done> place_particles(ClothModel& model, const Topology& topology, const std::vector<std::uint32_t>& pinned) {
    model.start.assign(model.capacity(), Vec4{});
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const Vec3 x = topology.rest_positions[p];
        const float weight = 1 / model.mass[p];
        if (!(std::isfinite(weight) && weight > 0)) {
            return Error{"particle " + std::to_string(p),
                         "its mass of " + number_text(model.mass[p]) + " kg has no finite inverse in single precision"};
        }
        model.start[p] = {x.x, x.y, x.z, weight};
    }
    for (std::uint32_t p : pinned) {
        if (p >= model.particle_count) {
            return Error{"pinned particle " + std::to_string(p),
                         "there are only " + std::to_string(model.particle_count)};
        }
        model.pinned_count += model.start[p].w > 0;
        model.start[p].w = 0;
    }
    return Done{};
}

Result<Done> place_anchors(ClothModel& model, const std::vector<Attachment>& attachments) {
    for (std::uint32_t i = 0; i < attachments.size(); ++i) {
        const auto& [particle, compliance, place] = attachments[i];
        const std::string where = "attachment " + std::to_string(i);
        if (particle >= model.particle_count)
            return Error{where, "there are only " + std::to_string(model.particle_count) + " particles, got number " +
                                    std::to_string(particle)};
        if (!(compliance > 0 && std::isfinite(compliance)))
            return Error{where, "compliance must be > 0 m/N, got " + number_text(compliance)};
        if (!finite(place)) return Error{where, "place is not finite"};
        model.start[model.particle_count + i] = {place.x, place.y, place.z, 0};
    }
    return Done{};
}

void lay_out_faces(ClothModel& model, const RestShape& rest) {
    const Topology& topology = rest.topology;
    const auto count = model.triangle_count = static_cast<std::uint32_t>(topology.triangles.size());
    model.face_stride = padded(count);
    model.faces.resize(std::size_t{3} * model.face_stride);
    model.around = lay_out_around(topology.particle_triangles, model.face_stride);
    for (std::uint32_t t = 0; t < model.face_stride; ++t) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            model.faces[std::size_t{corner} * model.face_stride + t] =
                t < count ? topology.triangles[t][corner]
                          : first_dummy(model.point_count()) + corner * lane_padding + t % lane_padding;
        }
    }
}

void measure_edges(ClothModel& model, const RestShape& rest) {
    constexpr float cos2_10_degrees = 0.9698463f;
    const Topology& topology = rest.topology;
    double sum = 0;
    model.edges.reserve(topology.edges.size());
    std::vector<std::array<std::uint32_t, 2>> others;
    for (const Edge& edge : topology.edges) {
        const float cos2 = cos2_to_warp(rest, edge);
        const bool axial = cos2 >= cos2_10_degrees || cos2 <= 1 - cos2_10_degrees;
        (axial ? model.edges : others).push_back({edge.a, edge.b});
        sum += length(topology.rest_positions[edge.a] - topology.rest_positions[edge.b]);
    }
    model.axial_edges = model.edges.size();
    model.edges.insert(model.edges.end(), others.begin(), others.end());
    model.mean_edge = static_cast<float>(sum / static_cast<double>(topology.edges.size()));
}

// A simulated mesh was checked when its topology was built.
Result<Done> check_drawn(const TriangleMesh& mesh) {
    const std::size_t count = mesh.positions.size();
    for (std::size_t v = 0; v < count; ++v) {
        // Farther out, a vertex that turns with its triangle can leave the range of a float.
        const Vec3 p = mesh.positions[v];
        const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (!finite(p) || farthest > far_away)
            return Error{"drawn mesh", "vertex " + std::to_string(v) + ": position must be within 1e6 m of the origin"};
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        if (std::max({a, b, c}) >= count)
            return Error{"drawn mesh", "triangle " + std::to_string(t) + ": indices must be < " +
                                           std::to_string(count) + ", the number of vertices"};
    }
    if (mesh.triangles.empty()) return Error{"drawn mesh", "must have at least one triangle"};
    if (!mesh.normals.empty() && mesh.normals.size() != count)
        return Error{"drawn mesh", "must have one normal per vertex or none"};
    return Done{};
}

void add_table(ClothModel& model, const Topology& topology, ConstraintKind kind, const RowList& rows, bool lines,
               const ColoringOptions& options, BuildClock& clock) {
    ConstraintTable& table = model.constraints[static_cast<std::uint32_t>(kind)];
    clock.spent_on(kind == ConstraintKind::tether ? BuildPart::tethers : BuildPart::rows);
    if (lines) {
        table = pack_lines(rows, topology.rest_positions, model.point_count(), options);
    } else {
        const Coloring coloring = color_rows(kind, rows, model.point_count(), options);
        clock.spent_on(BuildPart::coloring);
        table = pack_rows(kind, rows, model.point_count(), coloring);
    }
    clock.spent_on(BuildPart::tables);
}

// Where a cloth hangs by many places, the nearest is near, and coarse levels do as well. What stretches under a load is
// stiffened by tethers beyond what they allow for.
void choose_tethers(ClothModel& model, const RestShape& rest) {
    constexpr std::size_t few = 16;
    TetherMaterial& tether = model.fabric.tether;
    if (tether.use != Tethers::automatic) return;
    const bool pays = !model.hierarchy.empty() && model.fabric.stretch.inextensible && held_places(rest).size() <= few;
    tether.use = pays ? Tethers::on : Tethers::off;
}

// Everything that material and pins decide.
Result<Done> lay_out(ClothModel& model, const TriangleMesh& mesh, const Topology& topology, const Fabric& fabric,
                     const ClothPins& pins, const ColoringOptions& coloring, const ClothLayout& layout) {
    const float density = fabric.body.density;
    if (!(density > 0) || !std::isfinite(density))
        return Error{"density", "must be > 0 kg/m², got " + number_text(density)};
    BuildClock clock(model.build_times);
    model.fabric = fabric;
    model.particle_count = topology.particle_count;
    model.anchor_count = static_cast<std::uint32_t>(pins.attachments.size());

    RestShape rest = make_rest_shape(mesh, topology);
    model.mass = lump_masses(rest, density);
    if (auto placed = place_particles(model, topology, pins.particles); !placed) return placed;
    if (auto placed = place_anchors(model, pins.attachments); !placed) return placed;
    rest.attachments = pins.attachments;
    rest.held.assign(model.particle_count, 0);
    for (std::uint32_t p : pins.particles) rest.held[p] = 1;
    rest.elasticity = model.elasticity = elasticity_of(model.fabric.stretch, density, topology);
    clock.spent_on(BuildPart::rest);

    if (layout.hierarchy)
        model.hierarchy = build_hierarchy(rest, model.fabric, model.start,
                                          layout.lines ? FinestLevel::every_fourth : FinestLevel::every_second);
    model.pin_spans = find_pin_spans(model.hierarchy, topology.rest_positions);
    for (CoarseLevel& level : model.hierarchy) level.ways = {};
    clock.spent_on(BuildPart::hierarchy);

    choose_tethers(model, rest);
    // The same values for all three; which of them makes rows is one of the values.
    model.fabric.plate = model.fabric.flexion = model.fabric.bend;
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas)                              \
    add_table(model, topology, ConstraintKind::name, build_##name(rest, model.fabric.name), \
              layout.lines&& ConstraintKind::name == ConstraintKind::stretch, coloring, clock);
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

    lay_out_faces(model, rest);
    measure_edges(model, rest);
    clock.spent_on(BuildPart::rest);
    return Done{};
}

}  // namespace

Result<std::shared_ptr<const ClothModel>> build_cloth_model(ClothModelDesc desc, Topology topology) {
    auto model = std::make_shared<ClothModel>();
    model->name = std::move(desc.name);
    model->build_times = desc.build_times;
    if (auto done = lay_out(*model, desc.mesh, topology, desc.fabric, desc.pins, desc.coloring, desc.layout); !done)
        return done.errors();
    BuildClock clock(model->build_times);
    if (desc.drawn) {
        if (auto sound = check_drawn(*desc.drawn); !sound) return sound.errors();
        model->binding = bind_mesh(*desc.drawn, topology);
    } else {
        model->vertex_to_particle = std::move(topology.vertex_to_particle);
    }
    model->mesh = desc.drawn ? std::move(*desc.drawn) : std::move(desc.mesh);
    clock.spent_on(BuildPart::rest);
    return std::shared_ptr<const ClothModel>(std::move(model));
}

Result<std::shared_ptr<const ClothModel>> change_cloth_model(const ClothModel& from, const TriangleMesh& mesh,
                                                             const Topology& topology, const Fabric& fabric,
                                                             const ClothPins& pins, const ClothLayout& layout) {
    auto model = std::make_shared<ClothModel>();
    model->name = from.name;
    model->mesh = from.mesh;
    model->binding = from.binding;
    model->vertex_to_particle = from.vertex_to_particle;
    if (auto done = lay_out(*model, mesh, topology, fabric, pins, {}, layout); !done) return done.errors();
    return std::shared_ptr<const ClothModel>(std::move(model));
}

std::vector<float> face_masses(const ClothModel& model) {
    std::vector<float> masses(model.face_stride);
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        const auto [a, b, c] = model.triangle(t);
        masses[t] =
            model.fabric.body.density * area_of(model.rest_position(a), model.rest_position(b), model.rest_position(c));
    }
    return masses;
}

}  // namespace weft
