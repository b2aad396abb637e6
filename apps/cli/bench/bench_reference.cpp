#include "cli/bench/bench_reference.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

namespace weft::cli {
namespace {

constexpr double word = 4;    // bytes of a number, an index, a multiplier
constexpr double block = 16;  // four numbers: one entry of a particle's, node's or triangle's array

// Memory traffic of one pass, in bytes.
struct PassTraffic {
    double own = 0;     ///< read by no other pass: constraints, indices, weights
    double shared = 0;  ///< of particles, nodes and triangles, read and written, and what passes hand to one another
    double rows = 0;    ///< constraints projected in it
};

class TrafficCounter {
  public:
    TrafficCounter(const ClothModel& model, const WorldPlan& plan, double colliders)
        : model_(model), plan_(plan), colliders_(colliders), seen_(model.capacity(), 0) {}

    /// Without the multipliers (lambda).
    PassTraffic of(const Pass& pass) {
        const auto [found, fresh] = known_.try_emplace({pass.kind, pass.constraint, pass.batch, pass.level});
        if (fresh) found->second = count(pass);
        return found->second;
    }

    /// A multiplier starts at 0 in the first iteration and is written only if another iteration follows or others read
    /// it. (The last substep also keeps it for statistics; that is not counted.)
    double lambda_bytes(const Pass& pass) {
        const bool projects = pass.kind == PassKind::project || pass.kind == PassKind::correct;
        if (!projects || pass.source != RowSource::model || plan_.method == Method::pbd) return 0;
        if (!stores_lambda(plan_, model_.table(pass.constraint), model_)) return 0;
        const double transfers = pass.first_iteration ? 1 : 2;
        return of(pass).rows * constraint_info(pass.constraint).lambdas * word * transfers;
    }

    /// The data of all passes of a substep: their own, the four arrays of the particles, and three of the nodes.
    double working_set() {
        std::map<Key, double> own;
        for (const Pass& pass : plan_.substep) {
            if (!takes_part(PlannedCloth{&model_, false}, pass)) continue;
            const PassTraffic traffic = of(pass);
            double& bytes = own[{pass.kind, pass.constraint, pass.batch, pass.level}];
            bytes = std::max(bytes, traffic.own + std::min(lambda_bytes(pass), traffic.rows * word));
        }
        double sum = 4 * block * model_.point_count();
        for (const auto& [key, bytes] : own) sum += bytes;
        for (const CoarseLevel& level : model_.hierarchy) sum += 3 * block * level.count;
        return sum;
    }

  private:
    using Key = std::tuple<PassKind, ConstraintKind, std::uint32_t, std::uint32_t>;

    // Traffic of the rows [begin, end) of a table without padding: indices and fields once per row, and each particle
    // once, even if several rows share it.
    struct Touched {
        double rows = 0, read = 0, moved = 0;
    };
    Touched touched(const ConstraintTable& table, std::uint32_t begin, std::uint32_t end) {
        Touched sum;
        const std::uint32_t moved = constraint_info(table.kind).moved;
        round_ += 2;  // marks of earlier rounds are smaller; round_: read, round_ + 1: moved
        for (std::uint32_t r = begin; r < end; ++r) {
            if (!table.is_real(r)) continue;
            ++sum.rows;
            for (std::uint32_t slot = 0; slot < table.arity; ++slot) {
                std::uint32_t& mark = seen_[table.particles[std::size_t{slot} * table.stride + r]];
                if (mark < round_) ++sum.read, mark = round_;
                if (slot < moved && mark == round_) ++sum.moved, mark = round_ + 1;
            }
        }
        return sum;
    }
    Touched touched(const ConstraintTable& table, const Batch& batch) {
        if (batch.blocks == 0) return touched(table, batch.begin, batch.padded_end());
        return touched(table, table.blocks[batch.first_block].begin,
                       table.blocks[batch.first_block + batch.blocks - 1].end());
    }
    static double row_bytes(const ConstraintTable& table) { return word * (table.arity + table.field_count); }

    static double prolongation_bytes(const Prolongation& prolongation) {
        const std::size_t node =
            prolongation.narrow.empty() ? sizeof prolongation.wide[0] : sizeof prolongation.narrow[0];
        return static_cast<double>(Prolongation::parents * (node + sizeof prolongation.weight[0]));
    }

    PassTraffic projected(const ConstraintTable& table, const Batch& batch) {
        const Touched t = touched(table, batch);
        const double shifts = table.is_coupled() ? 2 * word * t.rows : 0;
        return {.own = t.rows * row_bytes(table), .shared = block * (t.read + t.moved) + shifts, .rows = t.rows};
    }

    PassTraffic count_level(const Pass& pass) {
        const CoarseLevel& level = model_.hierarchy[pass.level];
        const double nodes = level.count;
        const double finer = pass.level == 0 ? model_.particle_count : model_.hierarchy[pass.level - 1].count;
        const bool coarsest = pass.level + 1 == model_.hierarchy.size();
        if (pass.kind == PassKind::coarse_limit) return projected(level.limits, level.limits.batches[pass.batch]);
        if (pass.kind == PassKind::restriction)
            return {.own = 2 * word * static_cast<double>(level.restriction.node.size()),
                    .shared = block * (finer + nodes)};
        if (pass.kind == PassKind::node_correction) return {.own = 0, .shared = 3 * block * nodes};
        if (coarsest) return {.own = word * nodes, .shared = 2 * block * nodes};
        return {.own = (word + prolongation_bytes(model_.hierarchy[pass.level + 1].prolongation)) * nodes,
                .shared = block * (2 * nodes + model_.hierarchy[pass.level + 1].count)};
    }

    bool predicts_first() const { return plan_.substep.front().kind == PassKind::predict; }

    PassTraffic count_faces(const Pass& pass) {
        const double particles = model_.particle_count;
        const auto triangles = static_cast<double>(model_.triangle_count);
        const double corners = 3 * word * triangles;
        switch (pass.kind) {
            case PassKind::air:  // positions, velocities; a mass read, an impulse written, and the wind, if any
                return {.own = corners + word * triangles,
                        .shared = block * (2 * particles + (plan_.frame_begin.empty() ? 1 : 2) * triangles)};
            case PassKind::push:  // all four arrays of a particle read, three written
                return {.own = corners, .shared = block * (7 * particles + triangles)};
            case PassKind::smooth_faces:  // normals read, a block per triangle read and written
                return {.own = corners, .shared = block * (particles + 2 * triangles)};
            default:  // wind, faces: positions read, a block per triangle written; normals: the reverse
                return {.own = corners, .shared = block * (particles + triangles)};
        }
    }

    PassTraffic count(const Pass& pass) {
        if (pass.source == RowSource::dynamic) return {};  // their number is known only during the run
        const double points = model_.point_count();
        const ConstraintTable& table = model_.table(pass.constraint);
        switch (pass.kind) {
            case PassKind::find:
            case PassKind::place:
            case PassKind::list:
            case PassKind::aim:
                return {};  // of dynamic lists
            case PassKind::predict_bodies:
            case PassKind::count_touches:
            case PassKind::touch_bodies:
            case PassKind::move_bodies:
            case PassKind::finish_bodies:
            case PassKind::weigh_attached:
            case PassKind::pull_bodies:
            case PassKind::steady:
            case PassKind::release:
            case PassKind::weigh_taut:
            case PassKind::take_taut:
            case PassKind::free_taut:
            case PassKind::longest_edge:
            case PassKind::find_faces:
            case PassKind::push_faces:
            case PassKind::move_faces:
            case PassKind::hold_faces:
            case PassKind::settle_faces:
            case PassKind::finish_holds:
            case PassKind::detect:
            case PassKind::cloth_contact:
            case PassKind::limit:
            case PassKind::separate:
            case PassKind::track_particles:
            case PassKind::search_particles:
            case PassKind::list_particles:
            case PassKind::overlap_particles:
            case PassKind::push_particles:
            case PassKind::move_particles:
            case PassKind::hold_particles:
            case PassKind::settle_particles:
            case PassKind::watch_tears:
            case PassKind::tear:
                return {};           // the number of pairs and contacts is known only during the run
            case PassKind::predict:  // four arrays read, four written
                return {.own = 0, .shared = 8 * block * points};
            case PassKind::velocities:  // four read, two written; all but the last are merged with the next prediction
                return {.own = 0, .shared = 6 * block * points / (predicts_first() ? plan_.substeps : 1)};
            case PassKind::advance:  // counted as its two halves
            case PassKind::targets:  // few particles are kinematic targets or grabbed
            case PassKind::hide_grabs:
            case PassKind::hold_grabs:
            case PassKind::grab:
            case PassKind::free_grabs:
                return {};
            case PassKind::contact:  // most particles touch nothing, and only where they are and were is read
                return {.own = 0, .shared = 2 * colliders_ * block * points};
            case PassKind::project:
                return projected(table, table.batches[pass.batch]);
            case PassKind::correct: {  // a share read, a correction written per particle that a constraint may move
                const Touched t = touched(table, 0, table.stride);
                const double out = block * constraint_info(table.kind).moved * t.rows;
                return {.own = t.rows * (row_bytes(table) + word), .shared = block * t.read + out, .rows = t.rows};
            }
            case PassKind::couple: {  // multipliers read; shifts read and written
                const double rows = table.rows;
                return {.own = word * (coupled_rows + coupled_numbers + 2) * rows, .shared = 3 * word * rows};
            }
            case PassKind::average: {  // all corrections read again, found by an index
                double items = 0;
                for (const ConstraintTable& each : model_.constraints)
                    items += static_cast<double>(each.rows) * constraint_info(each.kind).moved;
                return {.own = (word + block) * items, .shared = 2 * block * points};
            }
            case PassKind::damp: {  // positions and velocities read, velocities written
                const Touched t = touched(table, table.batches[pass.batch]);
                return {.own = t.rows * row_bytes(table), .shared = block * (2 * t.read + t.moved), .rows = t.rows};
            }
            case PassKind::prolongation:
                return {.own = prolongation_bytes(model_.hierarchy.front().prolongation) * points,
                        .shared = block * (2 * points + model_.hierarchy.front().count)};
            case PassKind::restriction:
            case PassKind::interpolation:
            case PassKind::coarse_limit:
            case PassKind::node_correction:
                return count_level(pass);
            case PassKind::wind:
            case PassKind::air:
            case PassKind::push:
            case PassKind::faces:
            case PassKind::smooth_faces:
            case PassKind::normals:
                return count_faces(pass);
        }
        return {};
    }

    const ClothModel& model_;
    const WorldPlan& plan_;
    double colliders_;
    std::map<Key, PassTraffic> known_;
    std::vector<std::uint32_t> seen_;  ///< per particle or node: the last round that touched it
    std::uint32_t round_ = 0;
};

}  // namespace

double FrameTraffic::all() const {
    return std::accumulate(bytes.begin(), bytes.end(), 0.0);
}

FrameTraffic frame_traffic(const World& world) {
    FrameTraffic frame;
    for (std::size_t i = 0; i < world.frame().cloths.size(); ++i) {
        const WorldPlan& plan = world.plan();
        TrafficCounter counter(*world.frame().cloths[i].model, plan, static_cast<double>(world.colliders().size()));
        const auto add = [&](const std::vector<Pass>& passes, double times) {
            for (const Pass& pass : passes) {
                if (!takes_part(PlannedCloth{world.frame().cloths[i].model, false}, pass)) continue;
                const PassTraffic traffic = counter.of(pass);
                frame.bytes[stage_of(pass)] += times * (traffic.own + traffic.shared + counter.lambda_bytes(pass));
            }
        };
        add(plan.frame_begin, 1);
        add(plan.substep, plan.substeps);
        add(plan.frame_end, 1);
        frame.working_set = std::max(frame.working_set, counter.working_set());
    }
    return frame;
}

}  // namespace weft::cli
