// A cloth without a World, for tests that set its state and measure its energy.
#pragma once

#include "cpu/cloth_state.h"
#include "cpu/executor.h"
#include "physics/scalar.h"
#include "sheet.h"

#include <algorithm>
#include <cmath>

namespace weft::physical {

/// A single cloth on one thread, with access to its state.
class LoneCloth {
  public:
    LoneCloth(std::shared_ptr<const ClothModel> model, const StepSettings& settings)
        : arrays_(sized(model->capacity())),
          state_(std::move(model), arrays_, 0),
          executor_(*cpu::available_passes().front(), team_),
          plan_(plan_world(settings, {{{.model = state_.model.get()}}})),
          passes_(plan_, {{{.model = state_.model.get()}}}, {}),
          stiffness_(plain_stiffness(state_.model->fabric, settings.solver.iterations)) {}

    const ClothModel& model() const { return *state_.model; }
    cpu::Particles now() const { return state_.now(); }
    /// Returns report bits. `gravity` in m/s².
    std::uint32_t step(double dt, Vec3 gravity) {
        const ClothStep cloth{.cloth = {}, .stiffness = &stiffness_};
        const StitchedPart part{0, 1};
        const IslandStep island{.plan = &passes_, .cloths = {&cloth, 1}, .parts = {&part, 1}};
        const WorldStep step{.plan = &plan_, .input = {.dt = dt, .gravity = gravity}};
        cpu::Executor::Job job{.step = &island, .steps = {&cloth}, .cloths = {&state_}};
        executor_.run(step, {&job, 1}, stage_ms_);
        return job.reports.front();
    }

  private:
    static cpu::WorldArrays sized(std::size_t count) {
        cpu::WorldArrays arrays;
        arrays.resize(count);
        return arrays;
    }

    cpu::WorldArrays arrays_;
    cpu::ClothState state_;
    WorkerTeam team_;
    cpu::Executor executor_;
    WorldPlan plan_;
    IslandPlan passes_;
    PlainStiffness stiffness_;
    std::array<double, stage_count> stage_ms_{};
};

class Specimen {
  public:
    struct Steps {
        double dt;  ///< s, of a frame
        std::uint32_t substeps = 10, iterations = 1;
        Compensation compensation = Compensation::automatic;
    };

    Specimen(std::shared_ptr<const ClothModel> model, const Steps& steps)
        : cloth_(std::move(model), {.solver = solver(steps),
                                    .contacts = false,
                                    .surface = false,
                                    .compensated = compensates(solver(steps), steps.dt)}),
          dt_(steps.dt) {}

    const ClothModel& model() const { return cloth_.model(); }
    std::uint32_t size() const { return cloth_.model().particle_count; }
    bool pinned(std::uint32_t p) const { return !(cloth_.now().position[p].w > 0); }
    Vec3 position(std::uint32_t p) const { return cloth_.now().position[p].xyz(); }
    Vec3 velocity(std::uint32_t p) const { return cloth_.now().velocity[p].xyz(); }

    /// Moves each particle, also pinned ones, to `pose(rest position)`. Keeps velocities.
    template <class Pose>
    void place(Pose&& pose) {
        for (std::uint32_t p = 0; p < size(); ++p) {
            const Vec3 x = pose(cloth_.model().rest_position(p));
            Vec4& now = cloth_.now().position[p];
            now = {x.x, x.y, x.z, now.w};
        }
    }

    void step() { reports_ |= cloth_.step(dt_, {0, -gravity, 0}); }
    void step_without_gravity() { reports_ |= cloth_.step(dt_, {}); }
    std::uint32_t reports() const { return reports_; }

    /// Brings the cloth to rest by a drag of `rate` 1/s. Drag acts on velocities only, so the end is the equilibrium of
    /// the constraints. True once no particle is faster than `slow` m/s.
    bool settle(double rate, double slow, double seconds) {
        const auto keep = static_cast<float>(std::exp(-rate * dt_));
        for (int frame = 0; frame * dt_ < seconds; ++frame) {
            step();
            float fastest = 0;
            for (std::uint32_t p = 0; p < size(); ++p) {
                const Vec3 v = velocity(p) * keep;
                cloth_.now().velocity[p] = {v.x, v.y, v.z, 0};
                fastest = std::max(fastest, dot(v, v));
            }
            if (frame > 10 && fastest < slow * slow) return true;
        }
        return false;
    }

    static constexpr float gravity = 9.81f;  ///< m/s², along -y

  private:
    static SolverDesc solver(const Steps& steps) {
        return {.substeps = steps.substeps, .iterations = steps.iterations, .compensation = steps.compensation};
    }

    LoneCloth cloth_;
    double dt_;
    std::uint32_t reports_ = report_none;
};

/// Energy of one plate constraint with particle p at `at(p)`, J.
template <class At>
double plate_energy(const ConstraintTable& plate, std::uint32_t row, At&& at) {
    reference::vec3 x[6];
    for (std::uint32_t slot = 0; slot < 6; ++slot) x[slot] = at(plate.particles[slot * plate.stride + row]);
    double f[9];
    for (std::uint32_t k = 0; k < 9; ++k) f[k] = plate.fields[k * plate.stride + row];
    const reference::PlateRow numbers{f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8]};
    const auto t = reference::plate_angles(x[0], x[1], x[2], x[3], x[4], x[5], 1, 1, 1, 1, 1, 1, numbers);
    const auto strain =
        reference::coupled_strains(reference::plate_stiffness(numbers), {t.a.theta, t.b.theta, t.c.theta});
    return 0.5 * reference::dot(strain, strain);
}

/// Energy of a cloth, J: potential above y = 0, kinetic, and of stretch and bend constraints of any model.
struct Energy {
    double height = 0, motion = 0, stretch = 0, bend = 0;
    double total() const { return height + motion + stretch + bend; }
};

inline Energy measure_energy(const Specimen& cloth) {
    const auto at = [&](std::uint32_t p) {
        const Vec3 x = cloth.position(p);
        return reference::vec3(x.x, x.y, x.z);
    };
    Energy energy;
    for (std::uint32_t p = 0; p < cloth.size(); ++p) {
        if (cloth.pinned(p)) continue;
        const double m = cloth.model().mass[p];
        energy.height += m * Specimen::gravity * cloth.position(p).y;
        energy.motion += 0.5 * m * dot(cloth.velocity(p), cloth.velocity(p));
    }
    const ConstraintTable& stretch = cloth.model().table(ConstraintKind::stretch);
    for (std::uint32_t r = 0; r < stretch.stride; ++r) {
        if (!stretch.is_real(r)) continue;
        const reference::vec3 d = at(stretch.particles[r]) - at(stretch.particles[stretch.stride + r]);
        const double c = std::sqrt(reference::dot(d, d)) - stretch.fields[r];
        const double compliance = stretch.fields[(c > 0 ? 1 : 2) * stretch.stride + r];
        if (compliance > 0) energy.stretch += 0.5 * c * c / compliance;
    }
    const ConstraintTable& bend = cloth.model().table(ConstraintKind::bend);
    for (std::uint32_t r = 0; r < bend.stride; ++r) {
        if (!bend.is_real(r)) continue;
        const auto corner = [&](std::uint32_t slot) { return at(bend.particles[slot * bend.stride + r]); };
        const double c = reference::hinge_angle(corner(0), corner(1), corner(2), corner(3)).theta - bend.fields[r];
        energy.bend += 0.5 * c * c / bend.fields[bend.stride + r];
    }
    const ConstraintTable& plate = cloth.model().table(ConstraintKind::plate);
    for (std::uint32_t r = 0; r < plate.stride; ++r) {
        if (plate.is_real(r)) energy.bend += plate_energy(plate, r, at);
    }
    return energy;
}

/// As make_sheet, from any flat mesh.
inline std::shared_ptr<const ClothModel> make_specimen(TriangleMesh mesh, const Fabric& fabric,
                                                       const std::function<bool(Vec3 at_rest)>& pinned) {
    auto topology = build_topology(mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    ClothModelDesc model{.name = "specimen", .mesh = std::move(mesh), .fabric = fabric};
    for (std::uint32_t p = 0; p < topology->particle_count; ++p) {
        if (pinned(topology->rest_positions[p])) model.pins.particles.push_back(p);
    }
    auto built = build_cloth_model(std::move(model), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

}  // namespace weft::physical
