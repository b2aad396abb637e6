#include "solver/plan/world_plan.h"

#include "solver/plan/cloth_contact_numbers.h"
#include "solver/plan/particle_contact_numbers.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

class Planner {
  public:
    Planner(const StepSettings& settings, std::span<const PlannedCloth> cloths,
            std::span<const LinkTables* const> links)
        : settings_(settings), cloths_(cloths), links_(links) {}

    WorldPlan run() {
        WorldPlan plan{settings_.solver, 0, {}, {}, {}};
        plan.projection = resolve(plan.projection, plan.method);
        plan.weighs_taut = weighs_taut();
        plan.compensated = settings_.compensated;
        plan.steadies = steadies();
        if (plan.steadies) plan.frame_begin.push_back({.kind = PassKind::steady});
        plan.reads_kept = plan.weighs_taut || !coupled().empty();
        for (const ConstraintKind kind : found()) {
            for (const PassKind pass : {PassKind::find, PassKind::place, PassKind::list})
                plan.frame_begin.push_back(dynamic(pass, kind));
        }
        // The wind is evaluated once per frame, because it changes little. Air forces are evaluated every substep.
        if (settings_.air && settings_.wind) plan.frame_begin.push_back({.kind = PassKind::wind});

        const bool tears =
            std::ranges::any_of(cloths_, [](const PlannedCloth& cloth) { return cloth.model->tear_law != nullptr; });
        if (tears) plan.frame_begin.push_back({.kind = PassKind::watch_tears});

        add_taut_weights(plan.substep);
        if (settings_.air) plan.substep.push_back({.kind = PassKind::air});
        if (settings_.air) plan.substep.push_back({.kind = PassKind::push});
        plan.substep.push_back({.kind = PassKind::predict});
        if (settings_.bodies) plan.substep.push_back({.kind = PassKind::predict_bodies});
        if (std::ranges::any_of(cloths_, &PlannedCloth::kinematic)) plan.substep.push_back({.kind = PassKind::targets});
        for (const ConstraintKind kind : found()) plan.substep.push_back(dynamic(PassKind::aim, kind));
        if (weighs_taut()) plan.substep.push_back({.kind = PassKind::take_taut, .constraint = ConstraintKind::stretch});
        const auto collides = [](const PlannedCloth& cloth) { return cloth.model->tiles != nullptr; };
        const bool exact = std::ranges::any_of(cloths_, collides);
        for (std::uint32_t i = 0; i < settings_.solver.iterations; ++i) {
            add_levels(i == 0, plan.substep);
            add_constraints_and_pulls(i == 0, false, plan.substep);
            if (i + 1 == settings_.solver.iterations) add_particle_contact(plan.substep);
            add_longest_edge(plan.substep);
            add_contact(i == 0, plan.substep);
            add_face_contact(plan.substep);
        }
        add_later_sweeps(plan.substep);
        if (exact) {
            add_cloth_contact(plan.substep);
            plan.later_rounds = contact_rounds - 1;
        }
        if (has_particle_contact(cloths_)) {
            plan.substep.push_back({.kind = PassKind::hold_particles});
            plan.substep.push_back({.kind = PassKind::settle_particles});
        }
        add_couplings(plan.substep);
        if (attached()) plan.substep.push_back({.kind = PassKind::targets, .batch = targets_at_last});
        if (settings_.bodies) plan.substep.push_back({.kind = PassKind::finish_bodies});
        if (weighs_taut()) plan.substep.push_back({.kind = PassKind::free_taut, .constraint = ConstraintKind::stretch});
        if (grabbed()) plan.substep.push_back({.kind = PassKind::free_grabs});
        if (tears) plan.substep.push_back({.kind = PassKind::tear});
        plan.substep.push_back({.kind = PassKind::velocities});
        if (exact) plan.substep.push_back({.kind = PassKind::separate});

        if (plan.steadies) plan.frame_end.push_back({.kind = PassKind::release});
        add_damping(plan.frame_end);
        if (settings_.surface) {
            plan.frame_end.push_back({.kind = PassKind::faces});
            plan.frame_end.push_back({.kind = PassKind::normals});
            plan.frame_end.push_back({.kind = PassKind::smooth_faces});
            plan.frame_end.push_back({.kind = PassKind::normals});
        }
        return plan;
    }

  private:
    using Passes = std::vector<Pass>;

    // The largest number over all cloths. Cloths with fewer have no work in the remaining passes.
    template <class Count>
    std::uint32_t most(Count&& count) const {
        std::size_t largest = 0;
        for (const PlannedCloth& cloth : cloths_) largest = std::max(largest, std::size_t{count(*cloth.model)});
        return static_cast<std::uint32_t>(largest);
    }
    static std::size_t batches_of(const ClothModel& model, ConstraintKind kind) {
        return model.table(kind).batches.size();
    }
    template <class Visit>
    void for_each_kind(Visit&& visit) const {
        for (std::uint32_t k = 0; k < constraint_kind_count; ++k) visit(static_cast<ConstraintKind>(k));
    }
    std::uint32_t link_batches(ConstraintKind kind) const {
        std::size_t largest = 0;
        for (const LinkTables* tables : links_)
            largest = std::max(largest, (*tables)[static_cast<std::uint32_t>(kind)].batches.size());
        return static_cast<std::uint32_t>(largest);
    }

    bool attached() const { return std::ranges::any_of(cloths_, &PlannedCloth::attached); }
    bool grabbed() const { return std::ranges::any_of(cloths_, &PlannedCloth::grabbed); }

    /// Kinds whose constraints are found again in every frame.
    std::vector<ConstraintKind> found() const {
        if (settings_.adhesion) return {ConstraintKind::adhesion};
        return {};
    }
    static Pass dynamic(PassKind pass, ConstraintKind kind, bool first = true) {
        return {.kind = pass, .constraint = kind, .first_iteration = first, .source = RowSource::dynamic};
    }

    // Plain constraints have no elasticity, and those side by side share no weights.
    bool weighs_taut() const {
        return settings_.bodies && settings_.solver.method == Method::xpbd &&
               settings_.solver.projection != Projection::jacobi;
    }

    // Coarse limits leave the load near pins to the constraints there. With bodies, taut edges add mass instead.
    bool steadies() const {
        return !settings_.bodies && settings_.solver.hierarchy && settings_.solver.method == Method::xpbd &&
               settings_.solver.projection != Projection::jacobi &&
               std::ranges::any_of(cloths_, [](const PlannedCloth& cloth) { return cloth.model->has_pin_loads(); });
    }

    void add_taut_weights(Passes& passes) const {
        if (!weighs_taut()) return;
        const auto kind = ConstraintKind::stretch;
        const std::uint32_t batches = most([&](const ClothModel& model) { return batches_of(model, kind); });
        for (std::uint32_t batch = 0; batch < batches; ++batch)
            passes.push_back({.kind = PassKind::weigh_taut, .constraint = kind, .batch = batch});
    }

    // Plain constraints have no compliance.
    std::vector<ConstraintKind> coupled() const {
        std::vector<ConstraintKind> kinds;
        if (settings_.solver.method != Method::xpbd) return kinds;
        for_each_kind([&](ConstraintKind kind) {
            if (std::ranges::any_of(cloths_, [&](const auto& one) { return one.model->table(kind).is_coupled(); }))
                kinds.push_back(kind);
        });
        return kinds;
    }

    void add_couplings(Passes& passes) const {
        for (const ConstraintKind kind : coupled()) passes.push_back({.kind = PassKind::couple, .constraint = kind});
    }

    // Coarse levels know nothing of the hands of grabs and would throw them about, so they do not move what is grabbed.
    void add_levels(bool first, Passes& passes) const {
        const bool levels = settings_.solver.hierarchy &&
                            std::ranges::any_of(cloths_, [](const auto& one) { return !one.model->hierarchy.empty(); });
        if (levels && attached()) passes.push_back({.kind = PassKind::weigh_attached, .batch = weigh_for_levels});
        if (levels && grabbed()) passes.push_back({.kind = PassKind::hide_grabs});
        if (levels) add_hierarchy(first, passes);
        if (grabbed() && (levels || first)) passes.push_back({.kind = PassKind::hold_grabs, .first_iteration = first});
    }

    void add_hierarchy(bool first, Passes& passes) const {
        const std::uint32_t levels = most([](const ClothModel& model) { return model.hierarchy.size(); });
        for (std::uint32_t i = 0; i < levels; ++i)
            passes.push_back({.kind = PassKind::restriction, .level = i, .source = RowSource::level});
        for (std::uint32_t i = levels; i-- > 0;) {
            const std::uint32_t batches = most([&](const ClothModel& model) {
                return i < model.hierarchy.size() ? model.hierarchy[i].limits.batches.size() : 0;
            });
            passes.push_back({.kind = PassKind::interpolation, .level = i, .source = RowSource::level});
            for (std::uint32_t sweep = 0; sweep < coarse_sweeps; ++sweep) {
                for (std::uint32_t batch = 0; batch < batches; ++batch)
                    passes.push_back({.kind = PassKind::coarse_limit,
                                      .constraint = ConstraintKind::coarse_limit,
                                      .batch = batch,
                                      .first_iteration = first && sweep == 0,
                                      .level = i,
                                      .source = RowSource::level});
            }
            passes.push_back({.kind = PassKind::node_correction, .level = i, .source = RowSource::level});
        }
        if (levels > 0) passes.push_back({.kind = PassKind::prolongation, .source = RowSource::level});
    }

    // The constraints answer what contact has moved: rounds of both make a pile quiet. Coarse levels have done their
    // part before, and would move what lies in contact by many edges.
    void add_cloth_contact(Passes& passes) const {
        passes.push_back({.kind = PassKind::detect});
        for (std::uint32_t round = 0; round < contact_rounds; ++round) {
            const std::size_t first = passes.size();
            if (round > 0) add_constraints_and_pulls(false, true, passes);
            passes.push_back({.kind = PassKind::cloth_contact, .batch = round});
            if (round + 1 == contact_rounds) add_longest_edge(passes);
            add_contact(false, passes);
            if (round + 1 == contact_rounds) add_face_contact(passes);
            leave_to(PassFor::exact_cloths, passes, first);
        }
        passes.push_back({.kind = PassKind::limit});
    }

    // The passes from number `first` on are for these cloths alone, those of links and dynamic lists excepted. So a
    // cloth costs and does the same, whatever contact other cloths have.
    static void leave_to(PassFor cloths, Passes& passes, std::size_t first) {
        for (std::size_t i = first; i < passes.size(); ++i)
            if (passes[i].source == RowSource::model) passes[i].cloths = cloths;
    }

    // They come before the rounds of exact contact, which limit how far particles move after them.
    void add_particle_contact(Passes& passes) const {
        if (!has_particle_contact(cloths_)) return;
        for (const PassKind kind : {PassKind::track_particles, PassKind::search_particles, PassKind::list_particles,
                                    PassKind::overlap_particles, PassKind::push_particles, PassKind::move_particles})
            passes.push_back({.kind = kind});
    }

    // Colliders have had their turn since the first sweep, and get another one.
    void add_later_sweeps(Passes& passes) const {
        if (!has_particle_contact(cloths_)) return;
        for (std::uint32_t sweep = 1; sweep < particle_sweeps.size(); ++sweep) {
            passes.push_back({.kind = PassKind::push_particles, .batch = sweep});
            passes.push_back({.kind = PassKind::move_particles, .batch = sweep});
        }
        const std::size_t first = passes.size();
        add_contact(false, passes);
        leave_to(PassFor::fast_cloths, passes, first);  // rounds of their own follow for exact ones
    }

    // Contacts come last in an iteration, so that no particle is inside a collider after it.
    void add_contact(bool first, Passes& passes) const {
        if (settings_.bodies) add_body_contact(first, passes);
        if (settings_.contacts) passes.push_back({.kind = PassKind::contact, .first_iteration = first});
    }

    // Before contact with colliders that do not give way. The first move of the bodies only adds up how many particles
    // touch each of them.
    static void add_body_contact(bool first, Passes& passes) {
        if (first) {
            passes.push_back({.kind = PassKind::count_touches});
            passes.push_back({.kind = PassKind::move_bodies, .batch = move_before_faces});
        }
        for (std::uint32_t sweep = 0; sweep < (first ? body_sweeps : 1); ++sweep) {
            passes.push_back({.kind = PassKind::touch_bodies, .first_iteration = first && sweep == 0});
            passes.push_back({.kind = PassKind::move_bodies, .batch = move_after_particles});
        }
    }

    // How far around particles contact looks for what their faces touch.
    void add_longest_edge(Passes& passes) const {
        if (settings_.faces) passes.push_back({.kind = PassKind::longest_edge});
    }

    // After contact of particles, so that only faces which are deeper than their corners are pushed.
    void add_face_contact(Passes& passes) const {
        if (!settings_.faces) return;
        const auto move_bodies = [&](std::uint32_t batch) {
            if (settings_.bodies) passes.push_back({.kind = PassKind::move_bodies, .batch = batch});
        };
        passes.push_back({.kind = PassKind::find_faces});
        move_bodies(move_before_faces);
        for (std::uint32_t sweep = 0; sweep <= face_sweeps; ++sweep) {
            passes.push_back({.kind = PassKind::push_faces, .batch = sweep});
            passes.push_back({.kind = PassKind::move_faces, .batch = sweep});
            move_bodies(move_after_faces);
        }
        for (std::uint32_t hold = 0; hold < face_holds; ++hold) {
            passes.push_back({.kind = PassKind::hold_faces, .batch = hold});
            passes.push_back({.kind = PassKind::settle_faces, .batch = hold});
        }
        passes.push_back({.kind = PassKind::finish_holds, .batch = face_holds});
        move_bodies(move_after_faces);
    }

    // Attached points have a mass only while constraints and coarse levels act. For contact they are pins that move.
    void add_constraints_and_pulls(bool first, bool rounds, Passes& passes) const {
        if (attached()) passes.push_back({.kind = PassKind::weigh_attached});
        add_constraints(first, passes);
        if (!attached()) return;
        passes.push_back({.kind = PassKind::pull_bodies, .first_iteration = first});
        passes.push_back({.kind = PassKind::move_bodies, .batch = rounds ? move_in_rounds : move_after_pulls});
        if (!rounds) passes.push_back({.kind = PassKind::targets, .batch = targets_on_bodies});
    }

    void add_constraints(bool first, Passes& passes) const {
        if (settings_.solver.projection == Projection::jacobi) {
            bool any = false;
            for_each_kind([&](ConstraintKind kind) {
                if (most([&](const ClothModel& model) { return model.table(kind).rows; }) == 0) return;
                passes.push_back({.kind = PassKind::correct, .constraint = kind, .first_iteration = first});
                any = true;
            });
            if (any) passes.push_back({.kind = PassKind::average});
        } else {
            for_each_kind([&](ConstraintKind kind) {
                const std::uint32_t batches = most([&](const ClothModel& model) { return batches_of(model, kind); });
                for (std::uint32_t batch = 0; batch < batches; ++batch)
                    passes.push_back({PassKind::project, kind, batch, first});
            });
        }
        // Constraints between cloths come after those of each cloth, so that an iteration ends with correct gaps.
        for_each_kind([&](ConstraintKind kind) {
            for (std::uint32_t batch = 0; batch < link_batches(kind); ++batch)
                passes.push_back({.kind = PassKind::project,
                                  .constraint = kind,
                                  .batch = batch,
                                  .first_iteration = first,
                                  .source = RowSource::links});
        });
        // Each constraint of a dynamic list moves one particle, which takes the mean of its corrections.
        for (const ConstraintKind kind : found()) {
            passes.push_back(dynamic(PassKind::correct, kind, first));
            passes.push_back(dynamic(PassKind::average, kind, first));
        }
        // Last, so that a grabbed point is where its grab has pulled it.
        if (grabbed()) passes.push_back({.kind = PassKind::grab, .first_iteration = first});
    }

    // Damping runs once per frame and costs as much as the projection of one substep. It is implicit, so the longer
    // step is stable.
    void add_damping(Passes& passes) const {
        for_each_kind([&](ConstraintKind kind) {
            if (!constraint_info(kind).damped) return;
            const std::uint32_t batches = most(
                [&](const ClothModel& model) { return model.fabric.body.damping > 0 ? batches_of(model, kind) : 0; });
            for (std::uint32_t batch = 0; batch < batches; ++batch)
                passes.push_back({.kind = PassKind::damp, .constraint = kind, .batch = batch});
        });
    }

    const StepSettings& settings_;
    std::span<const PlannedCloth> cloths_;
    std::span<const LinkTables* const> links_;
};

// x^(1/n) for x in [0, 1], by bisection. It only multiplies, so every machine gives the same bits; pow() differs
// between C libraries.
double root(double x, std::uint32_t n) {
    const auto power = [n](double base) {
        double result = 1;
        for (std::uint32_t left = n; left > 0; left /= 2, base *= base)
            if (left % 2 == 1) result *= base;
        return result;
    };
    double low = 0, high = 1;
    for (int i = 0; i < 64; ++i) {
        const double middle = 0.5 * (low + high);
        (power(middle) < x ? low : high) = middle;
    }
    return high;
}

// To remove the fraction s of an error in k iterations, each must remove 1 - (1 - s)^(1/k) (Müller et al. 2007,
// "Position Based Dynamics", section 3.3).
float per_iteration(float stiffness, std::uint32_t iterations) {
    return static_cast<float>(1 - root(1 - static_cast<double>(stiffness), iterations));
}

template <class Material>
std::array<float, 2> stiffness_of(const Fabric& fabric, std::uint32_t iterations) {
    const auto of = [&](int which) {
        return which < 0 ? 1.0f : per_iteration(fabric.body.stiffness[which], iterations);
    };
    return {of(Material::plain[0]), of(Material::plain[1])};
}

// The surface of a collider that rests only has pairs.
bool surface_takes_part(const PlannedCloth& cloth, const Pass& pass) {
    if (is_cloth_contact(pass.kind)) return true;
    return cloth.kinematic && (pass.kind == PassKind::predict || pass.kind == PassKind::targets ||
                               pass.kind == PassKind::velocities || pass.kind == PassKind::advance);
}

}  // namespace

PlainStiffness plain_stiffness(const Fabric& fabric, std::uint32_t iterations) {
    PlainStiffness stiffness;
    stiffness.fill({1, 1});
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping)           \
    WEFT_IF_FABRIC_##source(stiffness[static_cast<std::uint32_t>(ConstraintKind::name)] = \
                                stiffness_of<Name##Material>(fabric, iterations);)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
    return stiffness;
}

WorldPlan plan_world(const StepSettings& settings, std::span<const PlannedCloth> cloths,
                     std::span<const LinkTables* const> links) {
    return Planner(settings, cloths, links).run();
}

bool has_particle_contact(std::span<const PlannedCloth> cloths) {
    return std::ranges::any_of(
        cloths, [](const PlannedCloth& cloth) { return cloth.model->collision.with_cloth == SelfCollision::fast; });
}

bool has_particle_contact(const WorldPlan& plan) {
    return std::ranges::any_of(plan.substep, [](const Pass& pass) { return is_particle_contact(pass.kind); });
}

bool has_face_contact(const WorldPlan& plan) {
    return std::ranges::any_of(plan.substep, [](const Pass& pass) { return is_face_contact(pass.kind); });
}

std::uint32_t rounds_of(const WorldPlan& plan, const ClothModel& model) {
    return plan.iterations + (model.collision.with_cloth == SelfCollision::exact ? plan.later_rounds : 0);
}
std::uint32_t rounds_of_links(const WorldPlan& plan) {
    return plan.iterations + plan.later_rounds;
}

bool takes_part(const PlannedCloth& cloth, const Pass& pass) {
    const ClothModel& model = *cloth.model;
    if (model.collision.surface) return surface_takes_part(cloth, pass);
    if (pass.source == RowSource::links) return false;
    if (pass.source == RowSource::dynamic) return true;
    if (pass.cloths == PassFor::exact_cloths && model.collision.with_cloth != SelfCollision::exact) return false;
    if (pass.cloths == PassFor::fast_cloths && model.collision.with_cloth != SelfCollision::fast) return false;
    switch (pass.kind) {
        case PassKind::targets:
            if (pass.batch == targets_all) return cloth.kinematic;
            return cloth.attached && (pass.batch == targets_on_bodies || model.tiles == nullptr);
        case PassKind::weigh_attached:
        case PassKind::pull_bodies:
            return cloth.attached;
        case PassKind::hide_grabs:
        case PassKind::hold_grabs:
        case PassKind::grab:
        case PassKind::free_grabs:
            return cloth.grabbed;
        case PassKind::weigh_taut:
        case PassKind::project:
            return pass.batch < model.table(pass.constraint).batches.size();
        case PassKind::damp:
            return model.fabric.body.damping > 0 && pass.batch < model.table(pass.constraint).batches.size();
        case PassKind::couple:
            return model.table(pass.constraint).is_coupled();
        case PassKind::correct:
            return model.table(pass.constraint).rows > 0;
        case PassKind::restriction:
        case PassKind::interpolation:
        case PassKind::node_correction:
            return pass.level < model.hierarchy.size();
        case PassKind::coarse_limit:
            return pass.level < model.hierarchy.size() &&
                   pass.batch < model.hierarchy[pass.level].limits.batches.size();
        case PassKind::prolongation:
            return !model.hierarchy.empty();
        case PassKind::steady:
        case PassKind::release:
            return model.has_pin_loads();
        case PassKind::watch_tears:
        case PassKind::tear:
            return model.tear_law != nullptr;
        case PassKind::detect:
        case PassKind::cloth_contact:
        case PassKind::limit:
        case PassKind::separate:
            return model.tiles != nullptr;
        case PassKind::track_particles:
        case PassKind::search_particles:
        case PassKind::list_particles:
        case PassKind::overlap_particles:
        case PassKind::push_particles:
        case PassKind::move_particles:
        case PassKind::hold_particles:
        case PassKind::settle_particles:
            return model.along_curve != nullptr;
        default:
            return true;
    }
}

bool takes_part(const LinkTables& links, const Pass& pass) {
    return pass.source == RowSource::links &&
           pass.batch < links[static_cast<std::uint32_t>(pass.constraint)].batches.size();
}

SubstepPasses passes_of(const WorldPlan& plan, std::uint32_t substep) {
    const std::span<const Pass> passes(plan.substep);
    const bool together =
        passes.size() > 1 && passes.front().kind == PassKind::predict && passes.back().kind == PassKind::velocities;
    const bool begun = together && substep > 0, goes_on = together && substep + 1 < plan.substeps;
    return {passes.subspan(begun, passes.size() - begun - goes_on), goes_on};
}

bool stores_lambda(const WorldPlan& plan, const ConstraintTable& table, const ClothModel& model) {
    return rounds_of(plan, model) > 1 || table.is_coupled();
}

LambdaUse lambda_use(const WorldPlan& plan, const ClothModel& model, const Pass& pass, std::uint32_t substep) {
    const LambdaUse use = lambda_use(plan, pass, substep, rounds_of(plan, model));
    const bool coupled = pass.source == RowSource::model && model.table(pass.constraint).is_coupled();
    return use == LambdaUse::discard && coupled ? LambdaUse::store : use;
}

LambdaUse lambda_use(const WorldPlan& plan, const Pass& pass, std::uint32_t substep, std::uint32_t rounds) {
    if (!pass.first_iteration) return LambdaUse::accumulate;
    if (pass.source == RowSource::level) return LambdaUse::store;
    const bool read_later = pass.source == RowSource::model && pass.constraint == ConstraintKind::stretch &&
                            (substep + 1 == plan.substeps || plan.weighs_taut);
    return rounds > 1 || read_later ? LambdaUse::store : LambdaUse::discard;
}

std::string describe(const WorldPlan& plan) {
    std::string text;
    const auto name_of = [](const Pass& pass) {
        std::string name(stage_name(stage_of(pass)));
        return pass.source == RowSource::links ? name + " between cloths" : name;
    };
    const auto list = [&](const std::vector<Pass>& passes) {
        for (std::size_t i = 0, end = 0; i < passes.size(); i = end) {
            const std::string name = name_of(passes[i]);
            for (end = i; end < passes.size() && name_of(passes[end]) == name;) ++end;
            text += "  " + name;
            if (end - i > 1) text += " x" + std::to_string(end - i);
            text += '\n';
        }
    };
    if (!plan.frame_begin.empty()) text += "first:\n";
    list(plan.frame_begin);
    text += std::to_string(plan.substeps) + " times:\n";
    list(plan.substep);
    text += "once a frame:\n";
    list(plan.frame_end);
    return text;
}

}  // namespace weft
