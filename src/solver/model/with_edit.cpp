#include "mesh/grouping.h"
#include "physics/change_rows.h"
#include "solver/model/cloth_edit.h"
#include "solver/model/contact_rest.h"
#include "solver/model/masses.h"
#include "solver/model/opened_cloth.h"
#include "solver/model/pruned_limits.h"
#include "solver/model/rebuilt_limits.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

namespace weft {
namespace {

// Every edit gets a new number, unique across cloths and worlds.
std::atomic<std::uint64_t> versions = first_topology_version;

std::string text(std::uint32_t number) {
    return std::to_string(number);
}

// A writable copy of a table.
struct OpenTable {
    explicit OpenTable(const ConstraintTable& from)
        : table(from),
          particles(from.particles.begin(), from.particles.end()),
          fields(from.fields.begin(), from.fields.end()),
          geometry(from.geometry.begin(), from.geometry.end()) {}

    ConstraintTable close() && {
        table.particles = std::move(particles);
        table.fields = std::move(fields);
        table.geometry = std::move(geometry);
        return table;
    }

    std::size_t at(std::uint32_t array, std::uint32_t row) const { return std::size_t{array} * table.stride + row; }
    std::uint32_t geometry_count() const {
        return table.stride == 0 ? 0 : static_cast<std::uint32_t>(geometry.size() / table.stride);
    }

    ConstraintTable table;
    AlignedVector<std::uint32_t> particles;
    AlignedVector<float> fields, geometry;
};

class Editor {
  public:
    explicit Editor(const ClothModel& from, const std::vector<std::uint32_t>* pinned = nullptr)
        : model_(std::make_shared<ClothModel>(from)), pinned_(pinned) {}

    Result<std::shared_ptr<const ClothModel>> run(const ClothEdit& edit) {
        const bool has_openings = !edit.openings.empty(), other = !edit.appended.empty() || !edit.triangles.empty();
        const bool reshaped = has_openings || other;
        if (reshaped && !model_->mesh_is_of_particles() && (other || !model_->parting))
            return Error{"cloth '" + model_->name + "'",
                         "has a render mesh of its own, or vertices that share a particle: only openings can change "
                         "its triangles"};
        for (std::size_t i = 0; i < edit.appended.size(); ++i)
            if (auto known = check_particle("appended particle " + std::to_string(i), edit.appended[i]); !known)
                return known.errors();
        if (auto done = append(edit.appended, false); !done) return done.errors();
        if (auto done = set_triangles(edit.triangles); !done) return done.errors();
        const std::uint32_t first_copy = model_->particle_count;
        if (has_openings) {
            if (auto done = open(edit.openings); !done) return done.errors();
        }
        if (reshaped) {
            if (pinned_) pin(*pinned_);
            if (auto done = reshape(); !done) return done.errors();
            if (has_openings && model_->tiles) model_->contact_rest = rest_for_contact(*model_);
            if (other) {
                model_->set_hierarchy({}, {});
                model_->pruned = nullptr;
            } else if (edit.pruned_frames > 0 && can_prune_limits(*model_)) {
                prune_limits(*model_, edit.openings, first_copy);
            } else {
                rebuild_limits(*model_);
            }
        }
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            if (auto done = change_table(static_cast<ConstraintKind>(kind), edit); !done) return done.errors();
        }
        return std::shared_ptr<const ClothModel>(std::move(model_));
    }

  private:
    Result<void> check_particle(const std::string& where, std::uint32_t particle) const {
        if (particle < model_->particle_count) return {};
        return Error{where,
                     "there are only " + text(model_->particle_count) + " particles, got number " + text(particle)};
    }

    Result<void> check_opening(const Opening& opening, const std::string& where) const {
        const auto& entries = model_->tears->entries;
        const auto& links = opening.links;
        if (links[1] == drops_triangle) {
            if (!model_->reserved.erodes) return Error{where, "removes a triangle, but the cloth does not erode"};
            if (links[0] >= entries.size()) return Error{where, "must name a triangle of the cloth"};
            return {};
        }
        for (const std::uint32_t link : links) {
            if (link == none) continue;
            if (link >= entries.size() || entries[link].next == none ||
                entries[link].vertex != entries[links[0] == none ? link : links[0]].vertex)
                return Error{where, "must name edges inside the cloth at one vertex"};
        }
        return {};
    }

    Result<void> open(const std::vector<Opening>& openings) {
        const std::string name = "cloth '" + model_->name + "'";
        if (!model_->tears) return Error{name, "was not built to be cut or torn"};
        OpenedArrays arrays(*model_);
        const auto first_copy = static_cast<std::ptrdiff_t>(arrays.copied_from.size());
        Opener opener(*model_, arrays);
        for (std::size_t i = 0; i < openings.size(); ++i) {
            if (auto sound = check_opening(openings[i], "opening " + std::to_string(i)); !sound) return sound;
            if (!opener.open(openings[i]))
                return Error{name, "has no room for more particles at opening " + std::to_string(i) + " of " +
                                       std::to_string(openings.size())};
        }
        const std::vector<std::uint32_t> copies(arrays.copied_from.begin() + first_copy, arrays.copied_from.end());
        take_constraints(arrays);
        model_->faces = std::move(arrays.faces);
        take_removals();
        model_->strayed = std::move(arrays.strayed);
        if (auto done = append(copies, true); !done) return done;  // a copy may be one of an earlier copy
        model_->make_tiles_if_needed();
        // Particles that have lost their last triangle keep the mass that they had with it.
        model_->mass = AlignedVector<float>(arrays.mass.begin(), arrays.mass.begin() + model_->particle_count);
        return {};
    }

    // Leaves the ends as they are if the triangle was removed.
    static void set_ends(EdgeEnds& ends, const AlignedVector<std::uint32_t>& faces, const EdgeEnds& corners) {
        if (faces[corners[0]] != faces[corners[1]]) ends = {faces[corners[0]], faces[corners[1]]};
    }

    // Takes all constraints over, and lists their second halves when there are some.
    void take_constraints(OpenedArrays& arrays) {
        for (ConstraintTable& table : model_->constraints) {
            OpenedArrays::Rows& rows = arrays.rows[static_cast<std::uint32_t>(table.kind)];
            table.particles = std::move(rows.particles);
            table.fields = std::move(rows.fields);
            table.geometry = std::move(rows.geometry);
            table.rows = rows.rows;
        }
        auto edges = std::make_shared<ClothEdges>(*model_->edges);
        for (std::size_t i = 0; i < edges->without_row.size(); ++i)
            set_ends(edges->without_row[i], arrays.faces, model_->tears->without_row[i]);
        ConstraintTable& stretch = model_->constraints[static_cast<std::uint32_t>(ConstraintKind::stretch)];
        for (std::size_t i = 0; i < arrays.blocks.size(); ++i) stretch.blocks[i] = arrays.blocks[i];
        if (std::ranges::none_of(stretch.batches, &Batch::halves)) {
            use_second_halves(stretch);
            for (LineBlock& block : std::span(stretch.blocks).subspan(arrays.blocks.size())) block.cut = true;
        }
        model_->edges = std::move(edges);
    }

    // Triangles that openings have removed have no area.
    void take_removals() {
        if (!model_->reserved.erodes) return;
        std::vector<float> area(model_->face_area.begin(), model_->face_area.end());
        for (std::uint32_t t = 0; t < model_->triangle_count; ++t) {
            const auto [a, b, c] = model_->triangles()[t];
            if (a == b) area[t] = 0;
        }
        model_->face_area = std::move(area);
    }

    // `pinned`: copies of pinned particles are pinned too.
    Result<void> append(const std::vector<std::uint32_t>& sources, bool pinned) {
        if (sources.empty()) return {};
        if (sources.size() > model_->reserve)
            return Error{"cloth '" + model_->name + "'", "has room for " + text(model_->reserve) +
                                                             " more particles, got " + std::to_string(sources.size())};
        AlignedVector<Vec4> start(model_->start.begin(), model_->start.end());
        AlignedVector<float> mass(model_->mass.begin(), model_->mass.end());
        for (std::size_t i = 0; i < sources.size(); ++i) {
            start[model_->particle_count + i] = start[sources[i]];
            if (!pinned || start[sources[i]].w > 0) start[model_->particle_count + i].w = 1 / mass[sources[i]];
            mass.push_back(mass[sources[i]]);
        }
        if (!model_->thickness_factors.empty()) {
            AlignedVector<float> factors(model_->thickness_factors.begin(), model_->thickness_factors.end());
            for (std::size_t i = 0; i < sources.size(); ++i) factors[model_->particle_count + i] = factors[sources[i]];
            model_->thickness_factors = std::move(factors);
        }
        model_->start = std::move(start);
        model_->mass = std::move(mass);
        if (!model_->parting) model_->append_vertices(sources);
        std::vector<std::uint32_t> copied_from(model_->copied_from.begin(), model_->copied_from.end());
        copied_from.insert(copied_from.end(), sources.begin(), sources.end());
        model_->copied_from = std::move(copied_from);
        model_->particle_count += static_cast<std::uint32_t>(sources.size());
        model_->reserve -= static_cast<std::uint32_t>(sources.size());
        return {};
    }

    // Only whether inverse masses are 0; reshape() computes them.
    void pin(const std::vector<std::uint32_t>& pinned) {
        AlignedVector<Vec4> start(model_->start.begin(), model_->start.end());
        for (std::uint32_t p = 0; p < model_->particle_count; ++p) start[p].w = 1;
        for (const std::uint32_t p : pinned)
            if (p < model_->particle_count) start[p].w = 0;
        model_->start = std::move(start);
    }

    Result<void> set_triangles(const std::vector<TriangleEdit>& edits) {
        if (edits.empty()) return {};
        AlignedVector<std::uint32_t> faces(model_->faces.begin(), model_->faces.end());
        std::vector<float> area(model_->face_area.begin(), model_->face_area.end());
        for (const auto& [triangle, corners, alive] : edits) {
            const std::string where = "triangle " + text(triangle);
            if (triangle >= model_->triangle_count)
                return Error{where, "there are only " + text(model_->triangle_count)};
            for (const std::uint32_t corner : corners)
                if (auto known = check_particle(where, corner); !known) return known;
            const auto [a, b, c] = model_->triangles()[triangle];
            if (a == b) return Error{where, "has been removed already"};
            if (alive && (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]))
                return Error{where, "must have three different corners"};
            // A removed triangle has the same corner three times: it has no area for drawing and air forces.
            for (std::uint32_t k = 0; k < 3; ++k)
                faces[std::size_t{k} * model_->face_stride + triangle] = alive ? corners[k] : corners[0];
            if (!alive) area[triangle] = 0;
        }
        model_->faces = std::move(faces);
        model_->make_tiles_if_needed();
        model_->face_area = std::move(area);
        return {};
    }

    // Recomputes everything that depends on the triangles.
    Result<void> reshape() {
        const ClothModel& model = *model_;
        auto around = group_items<std::uint32_t>(model.particle_count, [&](auto put) {
            for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
                const auto [a, b, c] = model.triangles()[t];
                if (a == b) continue;
                put(a, t), put(b, t), put(c, t);
            }
        });
        const std::vector<std::uint32_t> offsets = around.offsets;
        model_->around = std::make_shared<const FacesAround>(
            lay_out_around({std::move(around.offsets), std::move(around.items)}, model.face_stride));
        model_->faces_by_tile =
            std::make_shared<const FacesByTile>(lay_out_by_tile(model.triangles(), model.particle_count));
        AlignedVector<float> mass = masses_of(model);
        AlignedVector<Vec4> start(model.start.begin(), model.start.end());
        for (std::uint32_t p = 0; p < model.particle_count; ++p) {
            if (offsets[p] == offsets[p + 1]) mass[p] = model.mass[p];
        }
        weigh_opened(model, mass);
        for (std::uint32_t p = 0; p < model.particle_count; ++p) start[p].w = start[p].w > 0 ? 1 / mass[p] : 0;
        if (auto weighed = check_masses(mass); !weighed) return weighed;
        model_->mass = std::move(mass);
        model_->start = std::move(start);
        model_->reset_mesh();
        model_->topology_version = ++versions;
        return {};
    }

    Result<void> change_table(ConstraintKind kind, const ClothEdit& edit) {
        const auto concerned = [&](const RowEdit& row) { return row.kind == kind; };
        if (std::ranges::none_of(edit.rows, concerned) && std::ranges::none_of(edit.added, concerned)) return {};
        OpenTable open(model_->table(kind));
        for (const RowEdit& row : edit.added) {
            if (row.kind != kind) continue;
            if (auto done = add_row(open, row); !done) return done;
        }
        std::vector<std::uint32_t> touched;
        for (const RowEdit& row : edit.rows) {
            if (row.kind != kind) continue;
            if (auto done = set_row(open, row); !done) return done;
            touched.push_back(row.row);
        }
        if (auto apart = check_batches(open, touched); !apart) return apart;
        if (auto done = compute_fields(open); !done) return done;
        model_->constraints[static_cast<std::uint32_t>(kind)] = std::move(open).close();
        return {};
    }

    static std::string name_of(const RowEdit& row) {
        return std::string(constraint_info(row.kind).name) + " constraint " + text(row.row);
    }

    static bool is_there(const OpenTable& open, std::uint32_t row) {
        if (open.table.is_dummy(open.particles[row])) return false;
        return open.table.blocks.empty() || open.geometry_count() == 0 ||
               !(open.geometry[open.at(open.geometry_count() - 1, row)] < 0);
    }

    Result<void> check_row(const OpenTable& open, const RowEdit& row) const {
        const std::string where = name_of(row);
        if (row.kind == ConstraintKind::attachment) return Error{where, "belongs to a pin; change the pins instead"};
        if (row.row >= open.table.stride || !is_there(open, row.row))
            return Error{where, "there is no constraint with this number"};
        if (row.stiffness != 0 && !(row.stiffness >= 1e-6f && row.stiffness <= 1e6f))
            return Error{where, "stiffness must be 0, or 1e-6 to 1e6 times what it is"};
        for (std::uint32_t slot = 1; slot < open.table.arity; ++slot)
            if (row.particles[slot] == row.particles[slot - 1]) return Error{where, "must have different ends"};
        const bool edges = model_->fabric.stretch.model == StretchModel::edges;
        const bool scales = (row.kind == ConstraintKind::stretch && edges) || row.kind == ConstraintKind::bend;
        if (!scales && row.stiffness != 0 && row.stiffness != 1)
            return Error{where, "has no stiffness to scale: use 0 to remove it, 1 to keep it"};
        for (std::uint32_t slot = 0; slot < open.table.arity; ++slot) {
            const bool unused = open.table.is_dummy(open.particles[open.at(slot, row.row)]) &&
                                row.particles[slot] == open.particles[open.at(slot, row.row)];
            const bool anchor =
                row.particles[slot] >= model_->first_anchor() && row.particles[slot] < model_->point_count();
            if (unused || anchor) continue;
            if (auto known = check_particle(where, row.particles[slot]); !known) return known;
        }
        return {};
    }

    Result<void> set_row(OpenTable& open, const RowEdit& row) const {
        if (auto sound = check_row(open, row); !sound) return sound;
        const bool in_line = open.table.line_block(row.row).has_value();
        for (std::uint32_t slot = 0; slot < open.table.arity; ++slot) {
            std::uint32_t& particle = open.particles[open.at(slot, row.row)];
            if (in_line && particle != row.particles[slot])
                return Error{name_of(row),
                             "is part of a line, so its ends cannot change; remove it and add another one"};
            // A removed constraint becomes padding.
            particle =
                row.stiffness > 0 || in_line ? row.particles[slot] : dummy(open.table.first_dummy, slot, row.row);
        }
        scale(open, row.row, row.stiffness, in_line);
        if (row.stiffness == 0) --open.table.rows;
        return {};
    }

    static void scale(OpenTable& open, std::uint32_t row, float stiffness, bool in_line) {
        if (stiffness > 0) {
            // Scales the area at the edge: stretch stiffness is proportional to it, bending stiffness inversely
            // proportional.
            const std::uint32_t last = open.geometry_count() - 1;
            if (stiffness != 1)
                open.geometry[open.at(last, row)] *=
                    open.table.kind == ConstraintKind::bend ? 1 / stiffness : stiffness;
            return;
        }
        for (std::uint32_t k = 0; k < open.geometry_count(); ++k) open.geometry[open.at(k, row)] = no_area;
        // On a line, a negative compliance means no stiffness and separates the constraints before and after it.
        for (std::uint32_t k = in_line ? 1 : 0; k < open.table.field_count; ++k)
            open.fields[open.at(k, row)] = in_line ? -1.0f : 0.0f;
    }

    // Constraints of a batch are projected in parallel, so no two may share a particle that one of them moves.
    Result<void> check_batches(const OpenTable& open, const std::vector<std::uint32_t>& touched) const {
        const std::uint32_t moved = constraint_info(open.table.kind).moved;
        std::vector<std::uint32_t> taken(model_->capacity(), none);
        for (const Batch& batch : open.table.batches) {
            const auto inside = [&](std::uint32_t row) { return row >= batch.begin && row < batch.padded_end(); };
            if (batch.serial || batch.blocks > 0 || std::ranges::none_of(touched, inside)) continue;
            for (std::uint32_t row = batch.begin; row < batch.begin + batch.rows; ++row) {
                for (std::uint32_t slot = 0; slot < moved; ++slot) {
                    const std::uint32_t particle = open.particles[open.at(slot, row)];
                    if (open.table.is_dummy(particle)) continue;
                    if (taken[particle] != none && taken[particle] >= batch.begin && taken[particle] != row)
                        return Error{std::string(constraint_info(open.table.kind).name) + " constraint " + text(row),
                                     "shares particle " + text(particle) + " with constraint " + text(taken[particle]) +
                                         ", which is projected at the same time"};
                    taken[particle] = row;
                }
            }
        }
        return {};
    }

    // Adds to the reserve, whose constraints are projected one after another.
    Result<void> add_row(OpenTable& open, const RowEdit& row) {
        if (auto sound = check_row(open, row); !sound) return sound;
        ConstraintTable& table = open.table;
        if (!(row.stiffness > 0)) return Error{name_of(row), "is added, so its stiffness must be > 0"};
        if (table.spare_used == table.spare_rows)
            return Error{name_of(row), "there is room for " + text(table.spare_rows) + " more constraints of its kind"};
        const std::uint32_t at = table.first_spare + table.spare_used++;
        if (table.spare_used == 1) table.batches.push_back({.begin = table.first_spare, .rows = 0, .serial = true});
        table.batches.back().rows = table.spare_used;
        ++table.rows;
        for (std::uint32_t slot = 0; slot < table.arity; ++slot)
            open.particles[open.at(slot, at)] = row.particles[slot];
        for (std::uint32_t k = 0; k < table.field_count; ++k)
            open.fields[open.at(k, at)] = open.fields[open.at(k, row.row)];
        for (std::uint32_t k = 0; k < open.geometry_count(); ++k)
            open.geometry[open.at(k, at)] = open.geometry[open.at(k, row.row)];
        scale(open, at, row.stiffness, false);
        if (table.kind == ConstraintKind::stretch) {
            auto edges = std::make_shared<ClothEdges>(*model_->edges);
            edges->axial_rows[at] = edges->axial_rows[row.row];
            model_->edges = std::move(edges);
        }
        return {};
    }

    // Computes fields like with_fabric(), so that edits and fabric changes give the same bits in either order.
    Result<void> compute_fields(OpenTable& open) const {
        const RowsToChange rows{.stride = open.table.stride,
                                .particles = open.particles.data(),
                                .geometry = open.geometry.data(),
                                .left_out = {},
                                .rest_positions = model_->start.data(),
                                .fields = open.fields.data()};
        // The springs of a membrane are not a function of their geometry; their stiffness cannot be scaled.
        if (open.table.kind == ConstraintKind::stretch && model_->fabric.stretch.model == StretchModel::edges)
            (void)change_stretch(rows, model_->fabric.stretch);
        if (open.table.kind == ConstraintKind::bend) (void)change_bend(rows, model_->fabric.bend);
        const auto unsound = std::ranges::find_if_not(open.fields, [](float field) { return std::isfinite(field); });
        if (unsound == open.fields.end()) return {};
        const auto row = static_cast<std::size_t>(unsound - open.fields.begin()) % open.table.stride;
        return Error{std::string(constraint_info(open.table.kind).name) + " constraint " + std::to_string(row),
                     "would have no finite compliance: its ends coincide at rest, or its stiffness is out of range"};
    }

    std::shared_ptr<ClothModel> model_;
    const std::vector<std::uint32_t>* pinned_;  // null: unchanged
};

}  // namespace

Result<std::shared_ptr<const ClothModel>> with_edit(const ClothModel& from, const ClothEdit& edit) {
    return Editor(from).run(edit);
}

Result<std::shared_ptr<const ClothModel>> with_openings(const ClothModel& from, const std::vector<Opening>& openings,
                                                        const std::vector<std::uint32_t>& pinned) {
    return Editor(from, &pinned).run({.openings = openings});
}

}  // namespace weft
