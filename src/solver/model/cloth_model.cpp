#include "solver/model/cloth_model.h"

#include "mesh/grouping.h"
#include "physics/attachment/attachment.h"
#include "physics/tether/pinned_places.h"
#include "scene/problems.h"
#include "scene/scene_keys.h"
#include "solver/model/lines.h"
#include "solver/model/masses.h"
#include "solver/model/parting_mesh.h"
#include "solver/model/tear_law.h"
#include "solver/model/tear_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace weft {
namespace {

Result<void> place_particles(ClothModel& model, const Topology& topology, const std::vector<std::uint32_t>& pinned,
                             AlignedVector<Vec4>& start) {
    if (auto weighed = check_masses(model.mass); !weighed) return weighed;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const Vec3 x = topology.rest_positions[p];
        start[p] = {x.x, x.y, x.z, 1 / model.mass[p]};
    }
    for (std::uint32_t p : pinned) {
        if (p >= model.particle_count && p < model.first_anchor()) continue;  // a copy, pinned by World::set_model()
        if (p >= model.particle_count) {
            return Error{"pinned particle " + std::to_string(p),
                         "there are only " + std::to_string(model.particle_count)};
        }
        model.pinned_count += start[p].w > 0;
        start[p].w = 0;
    }
    return {};
}

Result<void> place_anchors(const ClothModel& model, const std::vector<Attachment>& attachments,
                           AlignedVector<Vec4>& start) {
    for (std::uint32_t i = 0; i < attachments.size(); ++i) {
        const auto& [particle, compliance, place] = attachments[i];
        const std::string where = "attachment " + std::to_string(i);
        if (particle >= model.first_anchor())  // copies of particles come with openings
            return Error{where, "there are only " + std::to_string(model.particle_count) + " particles, got number " +
                                    std::to_string(particle)};
        if (!(compliance > 0 && std::isfinite(compliance)))
            return Error{where, "compliance must be > 0 m/N, got " + number_text(compliance)};
        if (!finite(place)) return Error{where, "place is not finite"};
        start[model.first_anchor() + i] = {place.x, place.y, place.z, 0};
    }
    return {};
}

// Room for springs that are added while the cloth moves, for example to drag it with the mouse.
constexpr std::uint32_t spare_anchors = 8;

void lay_out_faces(ClothModel& model, const RestShape& rest) {
    const Topology& topology = rest.topology;
    const auto count = model.triangle_count = static_cast<std::uint32_t>(topology.triangles.size());
    model.face_stride = padded(count);
    AlignedVector<std::uint32_t> faces(std::size_t{3} * model.face_stride);
    model.around = std::make_shared<const FacesAround>(lay_out_around(topology.particle_triangles, model.face_stride));
    for (std::uint32_t t = 0; t < model.face_stride; ++t) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            faces[std::size_t{corner} * model.face_stride + t] =
                t < count ? topology.triangles[t][corner]
                          : first_dummy(model.room()) + corner * lane_padding + t % lane_padding;
        }
    }
    model.faces = std::move(faces);
    model.faces_by_tile = std::make_shared<const FacesByTile>(lay_out_by_tile(model.triangles(), model.particle_count));
    model.face_area = std::vector<float>(rest.area);
    std::vector<float> warp(count);
    for (std::uint32_t t = 0; t < count; ++t) {
        const auto [a, b, c] = topology.triangles[t];
        const Vec3 side = topology.rest_positions[b] - topology.rest_positions[a];
        const Vec3 normal = normalized(cross(side, topology.rest_positions[c] - topology.rest_positions[a]));
        warp[t] = std::atan2(dot(cross(normal, side), rest.warp[t]), dot(side, rest.warp[t]));
    }
    model.face_warp = std::move(warp);
}

// Finds edges by their ends. Topology sorts edges by lower end, then by upper end.
class EdgeIndex {
  public:
    explicit EdgeIndex(const Topology& topology) : edges_(topology.edges), first_(topology.particle_count + 1) {
        for (const Edge& edge : edges_) ++first_[edge.a + 1];
        for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
    }
    std::size_t find(std::uint32_t a, std::uint32_t b) const {
        if (a > b) std::swap(a, b);
        const auto begin = edges_.begin() + first_[a], end = edges_.begin() + first_[a + 1];
        return static_cast<std::size_t>(std::ranges::lower_bound(begin, end, b, {}, &Edge::b) - edges_.begin());
    }

  private:
    std::span<const Edge> edges_;
    std::vector<std::uint32_t> first_;
};

void measure_edges(ClothModel& model, const RestShape& rest) {
    constexpr float cos2_10_degrees = 0.9698463f;
    const Topology& topology = rest.topology;
    const std::size_t count = topology.edges.size();
    std::vector<std::uint8_t> axial(count), has_row(count);
    double sum = 0;
    for (std::size_t e = 0; e < count; ++e) {
        const Edge& edge = topology.edges[e];
        const float cos2 = rest.cos2_to_warp[e];
        axial[e] = cos2 >= cos2_10_degrees || cos2 <= 1 - cos2_10_degrees;
        const float edge_length = length(topology.rest_positions[edge.a] - topology.rest_positions[edge.b]);
        sum += edge_length;
        model.longest_edge = std::max(model.longest_edge, edge_length);
    }
    model.mean_edge = static_cast<float>(sum / static_cast<double>(count));

    const EdgeIndex index(topology);
    const ConstraintTable& rows = model.table(ConstraintKind::stretch);
    auto edges = std::make_shared<ClothEdges>();
    edges->axial_rows.assign(rows.stride, false);
    for (std::uint32_t row = 0; row < rows.stride; ++row) {
        if (!rows.is_real(row)) continue;
        const std::size_t e = index.find(rows.particles[row], rows.particles[std::size_t{rows.stride} + row]);
        has_row[e] = 1;
        edges->axial_rows[row] = axial[e];
        if (row < rows.second_halves) edges->axial_rows[rows.second_halves + row] = axial[e];
    }
    for (const bool along : {true, false}) {
        for (std::size_t e = 0; e < count; ++e) {
            if (!has_row[e] && static_cast<bool>(axial[e]) == along)
                edges->without_row.push_back({topology.edges[e].a, topology.edges[e].b});
        }
        if (along) edges->axial_without_row = edges->without_row.size();
    }
    model.edges = std::move(edges);
}

// Whether every vertex is a particle, and every triangle a face.
bool is_simulated_as_drawn(const TriangleMesh& mesh, const Topology& topology) {
    return topology.particle_count == mesh.positions.size() && topology.triangles.size() == mesh.triangles.size();
}

// Drawn triangles must have the numbers of the simulated ones to follow their corners.
void part_as_drawn(ClothModel& model, TriangleMesh mesh, Topology& topology) {
    std::vector<Triangle> kept;
    for (const std::uint32_t source : topology.source_triangle) kept.push_back(mesh.triangles[source]);
    mesh.triangles = std::move(kept);
    model.parting = std::make_shared<const PartingMesh>(std::move(mesh), std::move(topology.vertex_to_particle),
                                                        model.reserved.particles);
    model.reset_mesh();
}

// A render mesh of its own is cut along the edges of simulated triangles, so that it can part there.
void part_as_bound(ClothModel& model, TriangleMesh drawn, const Topology& topology) {
    drawn.normals = normals_to_draw(drawn);
    model.parting = std::make_shared<const PartingMesh>(clip_to_triangles(drawn, topology), topology);
    model.reset_mesh();
}

// A simulated mesh was checked when its topology was built.
Result<void> check_drawn(const TriangleMesh& mesh) {
    const std::size_t count = mesh.positions.size();
    for (std::size_t v = 0; v < count; ++v) {
        // A vertex farther out could leave the range of a float when its triangle rotates.
        const Vec3 p = mesh.positions[v];
        const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (!finite(p) || farthest > far_away)
            return Error{"render mesh",
                         "vertex " + std::to_string(v) + ": position must be within 1e6 m of the origin"};
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        if (std::max({a, b, c}) >= count)
            return Error{"render mesh", "triangle " + std::to_string(t) + ": indices must be < " +
                                            std::to_string(count) + ", the number of vertices"};
    }
    if (mesh.triangles.empty()) return Error{"render mesh", "must have at least one triangle"};
    if (!mesh.normals.empty() && mesh.normals.size() != count)
        return Error{"render mesh", "must have one normal per vertex or none"};
    return {};
}

void add_table(ClothModel& model, const Topology& topology, ConstraintKind kind, const RowList& rows, bool lines,
               const ColoringOptions& options, const ClothReserve& reserve, BuildClock& clock) {
    ConstraintTable& table = model.constraints[static_cast<std::uint32_t>(kind)];
    clock.spent_on(kind == ConstraintKind::tether ? BuildPart::tethers : BuildPart::rows);
    if (lines) {
        table = pack_lines(rows, topology.rest_positions, model.room(), options);
    } else {
        const Coloring coloring = color_rows(kind, rows, model.room(), options);
        clock.spent_on(BuildPart::coloring);
        table = pack_rows(kind, rows, model.room(), coloring);
    }
    if (reserve.openings && kind == ConstraintKind::stretch) add_second_halves(table);
    if (reserve.constraints > 0 && table.rows > 0) add_spare_rows(table, reserve.constraints);
    clock.spent_on(BuildPart::tables);
}

// Decides on automatic tethers. If a cloth hangs by many places, one is always near, and coarse levels work as well.
// Tethers would stiffen a cloth that stretches under load.
void choose_tethers(ClothModel& model, const RestShape& rest) {
    constexpr std::size_t few = 16;
    TetherMaterial& tether = model.fabric.tether;
    if (tether.use != Tethers::automatic) return;
    const bool pays =
        !model.hierarchy.empty() && model.fabric.stretch.inextensible && pinned_places(rest).size() <= few;
    tether.use = pays ? Tethers::on : Tethers::off;
}

Result<void> check_weights(const ClothWeights& weights, std::size_t triangles) {
    for (const auto& [name, factors] :
         {std::pair{"density", &weights.density}, {"stretch", &weights.stretch}, {"bend", &weights.bend}}) {
        const std::string where = std::string("weights of ") + name;
        if (factors->empty()) continue;
        if (factors->of_triangles.size() != triangles)
            return Error{where, "must be one per triangle, " + std::to_string(triangles) + ", got " +
                                    std::to_string(factors->of_triangles.size())};
        for (const float factor : factors->of_triangles)
            if (!(factor > 0 && std::isfinite(factor))) return Error{where, "must be > 0, got " + number_text(factor)};
    }
    return {};
}

Result<void> set_thickness(ClothModel& model, const std::vector<float>& factors) {
    if (factors.empty()) return {};
    if (factors.size() != model.particle_count)
        return Error{"weights of thickness", "must be one per particle, " + std::to_string(model.particle_count) +
                                                 ", got " + std::to_string(factors.size())};
    for (const float factor : factors)
        if (!(factor > 0 && std::isfinite(factor)))
            return Error{"weights of thickness", "must be > 0, got " + number_text(factor)};
    AlignedVector<float> padded(model.capacity(), 1.0f);
    std::ranges::copy(factors, padded.begin());
    model.thickness_factors = std::move(padded);
    const auto [least, most] = std::ranges::minmax(factors);
    model.thickness_range = {least, most};
    return {};
}

// Builds all parts of the model that depend on fabric, weights and pins.
Result<void> lay_out(ClothModel& model, const TriangleMesh& mesh, const Topology& topology, const ClothChange& change,
                     const ColoringOptions& coloring, const ClothReserve& reserve) {
    const ClothPins& pins = change.pins;
    const ClothLayout& layout = change.layout;
    if (auto sound = check_density(change.fabric.body.density); !sound) return sound;
    if (auto sound = check_weights(change.weights, topology.triangles.size()); !sound) return sound;
    BuildClock clock(model.build_times);
    model.fabric = change.fabric;
    model.weights = std::make_shared<const ClothWeights>(change.weights);
    model.collision = change.collision;
    model.tethers_asked = change.fabric.tether.use;
    model.particle_count = topology.particle_count;
    model.reserved = reserve;
    model.reserve = reserve.particles;
    model.anchor_count = static_cast<std::uint32_t>(pins.attachments.size());
    model.anchor_room = padded(model.anchor_count + spare_anchors);
    if (auto set = set_thickness(model, change.weights.thickness.of_particles); !set) return set;

    RestShape rest = make_rest_shape(mesh, topology);
    lay_out_faces(model, rest);
    rest.stretch_weight = change.weights.stretch.of_triangles;
    rest.bend_weight = change.weights.bend.of_triangles;
    model.mass = masses_of(model);
    AlignedVector<Vec4> start(model.capacity());
    if (auto placed = place_particles(model, topology, pins.particles, start); !placed) return placed;
    if (auto placed = place_anchors(model, pins.attachments, start); !placed) return placed;
    model.start = std::move(start);
    rest.attachments = pins.attachments;
    rest.first_anchor = model.first_anchor();
    rest.pinned.assign(model.particle_count, 0);
    for (std::uint32_t p : pins.particles)
        if (p < model.particle_count) rest.pinned[p] = 1;
    model.extent = extent_of(topology);
    rest.elasticity = model.elasticity = elasticity_of(model);
    rest.mean_density = mean_density(model);
    clock.spent_on(BuildPart::rest);

    Hierarchy hierarchy;
    if (layout.hierarchy)
        hierarchy = build_hierarchy(rest, model.fabric, model.start,
                                    layout.lines ? FinestLevel::every_fourth : FinestLevel::every_second);
    model.set_hierarchy(std::move(hierarchy), topology.rest_positions);
    clock.spent_on(BuildPart::hierarchy);

    choose_tethers(model, rest);
    // All bend models get the same values; `model` selects the one that creates constraints.
    model.fabric.moment = model.fabric.plate = model.fabric.distance_bend = model.fabric.bend;
    model.fabric.membrane = model.fabric.stretch;
    const auto add = [&](ConstraintKind kind, const RowList& rows) {
        const bool lines = layout.lines && kind == ConstraintKind::stretch;
        add_table(model, topology, kind, rows, lines, coloring, reserve, clock);
    };
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping)                \
    WEFT_IF_FABRIC_##source(add(ConstraintKind::name, build_##name(rest, model.fabric.name));) \
        WEFT_IF_PINS_##source(add(ConstraintKind::name, build_##name(rest));)                  \
            WEFT_IF_NOT_IN_MODEL_##source(add(ConstraintKind::name, make_rows(ConstraintKind::name));)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

    measure_edges(model, rest);
    if (reserve.openings) {
        auto tears = make_tear_table(model, rest);
        if (!tears) return tears.errors();
        model.tears = std::move(*tears);
        if (reserve.tears) {
            use_second_halves(model.constraints[static_cast<std::uint32_t>(ConstraintKind::stretch)]);
            model.tear_law = make_tear_law(model);
        }
    }
    model.make_tiles_if_needed();
    clock.spent_on(BuildPart::rest);
    return {};
}

}  // namespace

Result<std::shared_ptr<const ClothModel>> build_cloth_model(ClothModelDesc desc, Topology topology) {
    auto model = std::make_shared<ClothModel>();
    model->name = std::move(desc.name);
    model->start_velocity = desc.start_velocity;
    model->build_times = desc.build_times;
    const ClothChange parts{.fabric = desc.fabric,
                            .weights = std::move(desc.weights),
                            .pins = std::move(desc.pins),
                            .layout = desc.layout,
                            .collision = desc.collision,
                            .reserve = {}};
    if (auto done = lay_out(*model, desc.mesh, topology, parts, desc.coloring, desc.reserve); !done)
        return done.errors();
    BuildClock clock(model->build_times);
    if (desc.render_mesh) {
        if (auto sound = check_drawn(*desc.render_mesh); !sound) return sound.errors();
        if (desc.reserve.openings) {
            part_as_bound(*model, std::move(*desc.render_mesh), topology);
        } else {
            model->binding = bind_mesh(*desc.render_mesh, topology);
            model->set_mesh(std::move(*desc.render_mesh));
        }
    } else if (is_simulated_as_drawn(desc.mesh, topology)) {
        model->vertex_to_particle = std::move(topology.vertex_to_particle);
        model->set_mesh_of_particles(std::move(desc.mesh.uvs), std::move(desc.mesh.colors));
    } else if (desc.reserve.openings) {
        part_as_drawn(*model, std::move(desc.mesh), topology);
    } else {
        model->vertex_to_particle = std::move(topology.vertex_to_particle);
        model->set_mesh(std::move(desc.mesh));
    }
    clock.spent_on(BuildPart::rest);
    return std::shared_ptr<const ClothModel>(std::move(model));
}

std::vector<float> kept_after(const ClothModel& before, std::span<const float> kept, const ClothModel& after) {
    std::vector<float> still(after.kept_floats());
    const ConstraintTable &from = before.table(ConstraintKind::moment), &to = after.table(ConstraintKind::moment);
    if (from.particles.shares(to.particles) || std::ranges::equal(from.particles, to.particles))
        std::copy(kept.begin() + static_cast<std::ptrdiff_t>(before.first_shift()), kept.end(),
                  still.begin() + static_cast<std::ptrdiff_t>(after.first_shift()));
    return still;
}

Result<std::shared_ptr<const ClothModel>> with_attachments(const ClothModel& from,
                                                           const std::vector<Attachment>& attachments) {
    if (attachments.size() > from.anchor_room) return std::shared_ptr<const ClothModel>();
    auto model = std::make_shared<ClothModel>(from);
    model->anchor_count = static_cast<std::uint32_t>(attachments.size());
    AlignedVector<Vec4> start(from.start.begin(), from.start.end());
    std::fill(start.begin() + model->first_anchor(), start.begin() + model->room(), Vec4{});
    if (auto placed = place_anchors(*model, attachments, start); !placed) return placed.errors();
    model->start = std::move(start);
    constexpr auto kind = ConstraintKind::attachment;
    const RowList rows = attachment_rows(attachments, model->first_anchor());
    model->constraints[static_cast<std::uint32_t>(kind)] =
        pack_rows(kind, rows, model->room(), color_rows(kind, rows, model->room(), {}));
    return std::shared_ptr<const ClothModel>(std::move(model));
}

Result<std::shared_ptr<const ClothModel>> change_cloth_model(const ClothModel& from, const TriangleMesh& mesh,
                                                             const Topology& topology, const ClothChange& change) {
    auto model = std::make_shared<ClothModel>();
    model->name = from.name;
    model->start_velocity = from.start_velocity;
    model->binding = from.binding;
    assert(!change.reserve || (from.mesh_is_of_particles() && !from.parting));
    if (!change.reserve) model->tear_paint = from.tear_paint;
    model->parting = from.parting;
    if (from.binding.empty() && is_simulated_as_drawn(mesh, topology)) {
        model->set_mesh_of_particles(mesh.uvs, mesh.colors);
    } else if (!from.parting) {
        model->set_mesh(from.mesh());
    }
    model->vertex_to_particle = from.vertex_to_particle;
    if (!from.copied_from.empty() && !from.parting)  // without its copies
        model->vertex_to_particle = std::vector<std::uint32_t>(
            from.vertex_to_particle.begin(), from.vertex_to_particle.begin() + std::ptrdiff_t(mesh.positions.size()));
    if (auto done = lay_out(*model, mesh, topology, change, {}, change.reserve.value_or(from.reserved)); !done)
        return done.errors();
    if (model->parting) model->reset_mesh();
    return std::shared_ptr<const ClothModel>(std::move(model));
}

void ClothModel::set_hierarchy(Hierarchy found, std::span<const Vec3> at_rest) {
    pin_spans = find_pin_spans(found.levels, at_rest);
    for (CoarseLevel& level : found.levels) level.ways = {};
    hierarchy = std::move(found.levels);
    AlignedVector<float> steady;
    AlignedVector<std::uint32_t> pins;
    if (!found.loads.empty()) {
        steady.resize(capacity());
        pins.resize(capacity());
        std::ranges::transform(found.loads.steadiness, steady.begin(), [](double s) { return static_cast<float>(s); });
        std::ranges::copy(found.loads.pin, pins.begin());
    }
    steadiness = std::move(steady);
    pin_of = std::move(pins);
}

void ClothModel::make_tiles_if_needed() {
    tiles = nullptr;
    along_curve = nullptr;
    if (collision.with_cloth == SelfCollision::off) return;
    const std::span<const Vec4> particles{start.data(), particle_count};
    if (!collision.surface)
        along_curve = std::make_shared<const std::vector<std::uint32_t>>(order_along_curve(particles));
    if (collision.with_cloth != SelfCollision::exact) return;
    tiles = std::make_shared<const std::vector<Tile>>(make_tiles(triangles(), {start.data(), start.size()}));
}

void ClothModel::set_mesh(TriangleMesh mesh) {
    drawn_ = std::make_shared<Drawn>();
    drawn_->mesh = std::move(mesh);
    drawn_->mesh.normals = {};
}

void ClothModel::append_vertices(const std::vector<std::uint32_t>& sources) {
    assert(mesh_is_of_particles());
    const auto appended = [&](auto values, const auto& vertex_of) {
        if (values.empty()) return values;
        for (const std::uint32_t source : sources) values.push_back(values[vertex_of[source]]);
        return values;
    };
    std::vector<std::uint32_t> vertex(particle_count), particles(vertex_to_particle.begin(), vertex_to_particle.end());
    for (std::uint32_t v = 0; v < particles.size(); ++v) vertex[particles[v]] = v;
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        vertex.push_back(static_cast<std::uint32_t>(particles.size()));
        particles.push_back(particle_count + i);
    }
    vertex_to_particle = std::move(particles);
    set_mesh_of_particles(appended(drawn_->mesh.uvs, vertex), appended(drawn_->mesh.colors, vertex));
}

void ClothModel::reset_mesh() {
    if (parting) {
        PartingMesh::Parted now = parting->parted(triangles());
        vertex_to_particle = std::move(now.vertex_to_particle);
        binding = std::move(now.binding);
        return set_mesh(std::move(now.mesh));
    }
    set_mesh_of_particles(std::vector<Vec2>(drawn_->mesh.uvs), std::vector<Vec4>(drawn_->mesh.colors));
}

std::size_t ClothModel::spare_vertices() const {
    if (!parting && !mesh_is_of_particles()) return 0;
    // In an animation, corners of removed triangles need vertices of their own.
    const std::size_t removed = reserved.erodes ? 3 * mesh().triangles.size() : 0;
    if (!parting) return reserve + removed;
    return removed + parting->most_appended() + parting->built().positions.size() - mesh().positions.size();
}

void ClothModel::set_mesh_of_particles(std::vector<Vec2> uvs, std::vector<Vec4> colors) {
    drawn_ = std::make_shared<Drawn>();
    drawn_->mesh.uvs = std::move(uvs);
    drawn_->mesh.colors = std::move(colors);
    drawn_->of_particles = true;
}

const TriangleMesh& ClothModel::mesh() const {
    TriangleMesh& mesh = drawn_->mesh;
    if (!drawn_->of_particles) return mesh;
    std::call_once(drawn_->made, [&] {
        std::vector<std::uint32_t> vertex(particle_count);
        mesh.positions.reserve(particle_count);
        for (std::uint32_t v = 0; v < particle_count; ++v) {
            vertex[vertex_to_particle[v]] = v;
            mesh.positions.push_back(rest_position(vertex_to_particle[v]));
        }
        mesh.triangles.reserve(triangle_count);
        for (std::uint32_t t = 0; t < triangle_count; ++t) {
            const auto [a, b, c] = triangles()[t];
            mesh.triangles.push_back({vertex[a], vertex[b], vertex[c]});
        }
    });
    return mesh;
}

EdgesByDirection edges_by_direction(const ClothModel& model) {
    const auto grouped = [&](bool wanted) {
        auto by_lower = group_items<std::uint32_t>(model.particle_count, [&](auto put) {
            for_each_edge(model, [&](const EdgeEnds& ends, bool axial) {
                if (axial == wanted) put(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
            });
        });
        std::vector<EdgeEnds> edges;
        edges.reserve(by_lower.items.size());
        for (std::uint32_t a = 0; a < model.particle_count; ++a) {
            const auto begin = by_lower.items.begin() + by_lower.offsets[a];
            const auto end = by_lower.items.begin() + by_lower.offsets[a + 1];
            std::sort(begin, end);
            for (auto b = begin; b != end; ++b) edges.push_back({a, *b});
        }
        return edges;
    };
    return {grouped(true), grouped(false)};
}

std::vector<Vec4> start_velocities(const ClothModel& model) {
    std::vector<Vec4> velocities(model.capacity());
    const auto [x, y, z] = model.start_velocity;
    for (std::uint32_t p = 0; p < model.particle_count; ++p)
        if (model.start[p].w > 0) velocities[p] = {x, y, z, 0};
    return velocities;
}

std::vector<std::uint32_t> pinned_particles(const ClothModel& model) {
    std::vector<std::uint32_t> pinned;
    for (std::uint32_t p = 0; p < model.particle_count; ++p)
        if (!(model.start[p].w > 0)) pinned.push_back(p);
    return pinned;
}

float face_mass(const ClothModel& model, std::uint32_t triangle) {
    const float mass = model.fabric.body.density * model.face_area[triangle];
    return model.weights->density.empty() ? mass : mass * model.weights->density.at(triangle);
}

std::vector<float> face_masses(const ClothModel& model) {
    std::vector<float> masses(model.face_stride);
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) masses[t] = face_mass(model, t);
    return masses;
}

StretchMaterial softest_stretch(const ClothModel& model) {
    StretchMaterial material = model.fabric.stretch;
    const float least = model.weights->stretch.least();
    for (int k = 0; k < 2; ++k) material.stretch[k] *= least, material.compression[k] *= least;
    material.shear *= least;
    return material;
}

Elasticity elasticity_of(const ClothModel& model) {
    return elasticity_of(softest_stretch(model), model.fabric.body.density * model.weights->density.most(),
                         model.extent);
}

double mean_density(const ClothModel& model) {
    const auto& factors = model.weights->density.of_triangles;
    if (factors.empty()) return model.fabric.body.density;
    double sum = 0;
    for (const float factor : factors) sum += double{factor};
    return double{model.fabric.body.density} * sum / static_cast<double>(factors.size());
}

AlignedVector<float> masses_of(const ClothModel& model) {
    return lump_masses(model.face_area, model.triangles(), model.particle_count, model.fabric.body.density,
                       model.weights->density.of_triangles);
}

}  // namespace weft
