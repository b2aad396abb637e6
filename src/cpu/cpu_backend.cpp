#include "cpu/cpu_backend.h"

#include "base/hash.h"
#include "cpu/cloth_state.h"
#include "cpu/executor.h"
#include "cpu/near_parts.h"
#include "cpu/passes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace weft {
namespace {

class CpuBackend final : public Backend {
  public:
    CpuBackend(const cpu::Passes& passes, const CpuOptions& options)
        : passes_(passes),
          team_(options.workers),
          executor_(passes, team_, options.smallest_shared),
          search_always_(options.search_always) {}

    std::string_view name() const override { return "cpu"; }
    std::string device() const override {
        return std::string(passes_.isa) + ", " + std::to_string(passes_.lanes) +
               (passes_.lanes == 1 ? " lane" : " lanes");
    }
    unsigned threads() const override { return team_.size(); }
    std::uint32_t most_bodies() const override { return none; }

    Result<ClothHandle> add_cloth(std::shared_ptr<const ClothModel> model, std::uint32_t base) override {
        make_room(*model, base);
        auto place = std::make_unique<Place>(cpu::ClothState(std::move(model), arrays_, base), search_always_);
        const auto free = std::ranges::find_if(cloths_, [](const auto& one) { return one == nullptr; });
        const auto at = static_cast<std::uint32_t>(free - cloths_.begin());
        if (free == cloths_.end()) {
            cloths_.push_back(std::move(place));
        } else {
            *free = std::move(place);
        }
        return ClothHandle{at};
    }

    void remove_cloth(ClothHandle handle) override {
        assert(handle.value < cloths_.size());
        cloths_[handle.value] = nullptr;
    }

    Result<void> set_model(ClothHandle handle, std::shared_ptr<const ClothModel> model, std::uint32_t base) override {
        make_room(*model, base);
        cloth(handle).set_model(std::move(model), base);
        return {};
    }

    Result<void> set_material(ClothHandle handle, std::shared_ptr<const ClothModel> model) override {
        cloth(handle).set_material(std::move(model));
        return {};
    }

    Result<void> set_topology(ClothHandle handle, std::shared_ptr<const ClothModel> model,
                              std::span<const std::uint32_t> copied) override {
        cloth(handle).set_topology(std::move(model), copied);
        return {};
    }

    Result<void> place_points(ClothHandle handle, std::uint32_t first, std::span<const Vec3> places) override {
        cloth(handle).place_points(first, places);
        return {};
    }

    Result<void> set_weights(ClothHandle handle, std::span<const ParticleWeight> changed) override {
        cloth(handle).set_weights(changed);
        return {};
    }

    ClothSnapshot save(ClothHandle handle) const override { return cloth(handle).save(); }
    Result<void> restore(ClothHandle handle, const ClothSnapshot& snapshot) override {
        cloth(handle).restore(snapshot);
        return {};
    }

    void step(const WorldStep& step) override {
        counts_ = {};
        contact_counts_ = {};
        job_count_ = 0;
        while (islands_.size() < step.islands.size()) islands_.push_back(std::make_unique<Island>());
        for (std::size_t i = 0; i < step.islands.size(); ++i) begin_island(step, step.islands[i], *islands_[i]);
        run(step, jobs());
        if (jobs().empty() && !step.input.bodies.empty()) run_bodies_alone(step);
        for (std::size_t i = 0; i < step.islands.size(); ++i) group_again(step, *islands_[i]);
        for (const cpu::Executor::Job& job : jobs()) {
            if (job.adhesion) add_counts(*job.adhesion);
            if (job.cloth_contact) add_counts(job.cloth_contact->counts());
            if (job.particle_contact) add_counts(job.particle_contact->counts());
            end_job(step, job);
        }
    }

    void finish(std::array<double, stage_count>& stage_ms) override {
        for (std::uint32_t stage = 0; stage < stage_count; ++stage) stage_ms[stage] += stage_ms_[stage];
        stage_ms_.fill(0);
    }

    bool read(ClothHandle id, ClothFrame& frame) const override {
        const cpu::ClothState& state = cloth(id);
        const std::uint32_t count = state.model->particle_count;
        const cpu::Particles now = state.now();
        frame.model = state.model.get();
        frame.positions = now.position.first(count);
        frame.velocities = now.velocity.first(count);
        frame.normals = state.normals().first(count);
        frame.triangles = state.model->triangles();
        frame.topology_version = state.model->topology_version;
        return true;
    }

    ListCounts list_counts() const override { return counts_; }
    ClothContactCounts cloth_contact_counts() const override { return contact_counts_; }

    void add_contact_marks(ClothHandle id, std::span<std::uint32_t> marks) const override {
        const cpu::ClothState& state = cloth(id);
        for (const cpu::Executor::Job& job : jobs()) {
            if (std::ranges::find(job.cloths, &state) == job.cloths.end()) continue;
            if (job.cloth_contact && state.model->tiles) job.cloth_contact->add_marks(state.base, marks);
            if (job.particle_contact && state.model->along_curve) job.particle_contact->add_marks(state.base, marks);
        }
    }

    void measure(ClothHandle id, MeasureSums& sums) const override {
        const cpu::ClothState& state = cloth(id);
        const ClothModel& model = *state.model;
        const cpu::Particles now = state.now();
        sums.add(model, now.position, now.velocity);
        sums.add_residual(model, stretch_residual(model, now.position, state.kept(), state.substep_seconds));
    }

    void hash(ClothHandle id, StateHash& hash) const override {
        const cpu::ClothState& state = cloth(id);
        const cpu::Particles now = state.now();
        for (std::uint32_t p = 0; p < state.model->particle_count; ++p) {
            for (const Vec4& v : {now.position[p], now.velocity[p], now.compensation[p]}) {
                hash.add(v.x), hash.add(v.y), hash.add(v.z), hash.add(v.w);
            }
            hash.add(now.start[p].w);
        }
    }

  private:
    // A cloth, and what the cloths that step together keep between frames if it is the first of them.
    struct Place {
        Place(cpu::ClothState cloth, bool search_always)
            : state(std::move(cloth)), cloth_contact(search_always), particle_contact(search_always) {}
        cpu::ClothState state;
        cpu::LinkState links;  // of its stitched part
        cpu::AdhesionList adhesion;
        cpu::ClothContact cloth_contact;
        cpu::ParticleContact particle_contact;
    };
    // In a frame.
    struct Island {
        const IslandStep* step = nullptr;
        std::vector<cpu::ClothState*> cloths = {};  // as in the step
        cpu::NearParts near = {};
    };

    Place& place(ClothHandle id) const {
        assert(id.value < cloths_.size() && cloths_[id.value]);
        return *cloths_[id.value];
    }
    cpu::ClothState& cloth(ClothHandle id) const { return place(id).state; }

    std::span<cpu::Executor::Job> jobs() { return std::span(jobs_).first(job_count_); }
    std::span<const cpu::Executor::Job> jobs() const { return std::span(jobs_).first(job_count_); }

    // Adds the jobs of an island.
    void begin_island(const WorldStep& step, const IslandStep& of, Island& island) {
        island.step = &of;
        island.cloths.clear();
        for (const ClothStep& one : of.cloths) island.cloths.push_back(&cloth(one.cloth));
        if (of.cloths.empty()) return;
        island.near.begin(of, island.cloths, step.input);
        constexpr std::array<std::uint32_t, 1> only_part{0};
        if (of.parts.size() == 1) return make_job(step, island, only_part, next_job());
        if (!step.input.bodies.empty()) {
            std::vector<std::uint32_t> all(of.parts.size());
            std::iota(all.begin(), all.end(), 0u);
            return make_job(step, island, all, next_job());
        }
        for (const auto& parts : island.near.groups()) make_job(step, island, parts, next_job());
    }

    void run_bodies_alone(const WorldStep& step) {
        bodies_.prepare(step, 1);
        bodies_.run_alone(*step.plan);
        if (bodies_.all_finite()) bodies_.finish();
    }

    // Keeps the memory that earlier frames have allocated.
    cpu::Executor::Job& next_job() {
        if (job_count_ == jobs_.size()) jobs_.emplace_back();
        return jobs_[job_count_++];
    }

    // The job of some parts of an island.
    void make_job(const WorldStep& step, Island& island, std::span<const std::uint32_t> parts,
                  cpu::Executor::Job& job) {
        job.step = island.step;
        job.again = false;
        job.bodies = step.input.bodies.empty() ? nullptr : &bodies_;
        job.steps.clear(), job.cloths.clear(), job.links.clear(), job.swept.clear();
        bool collides = false, has_spheres = false;
        for (const std::uint32_t number : parts) {
            const StitchedPart& part = island.step->parts[number];
            for (std::uint32_t i = part.begin; i < part.end; ++i) {
                const ClothModel& model = *island.cloths[i]->model;
                collides = collides || (model.tiles && !model.collision.surface);
                has_spheres = has_spheres || model.along_curve;
                job.steps.push_back(&island.step->cloths[i]);
                job.cloths.push_back(island.cloths[i]);
                island.cloths[i]->rests = model.collision.surface && job.steps.back()->targets.empty();
                if (island.step->parts.size() > 1 && step.input.bodies.empty())
                    job.swept.push_back(&island.near.swept(i));
            }
            if (part.links) job.links.push_back({part.links, &place(island.step->cloths[part.begin].cloth).links});
        }
        Place& first = place(job.steps.front()->cloth);
        const auto& begin = step.plan->frame_begin;
        const bool sticks = std::ranges::find(begin, PassKind::find, &Pass::kind) != begin.end();
        job.adhesion = sticks ? &first.adhesion : nullptr;
        job.cloth_contact = collides ? &first.cloth_contact : nullptr;
        job.particle_contact = has_spheres && has_particle_contact(*step.plan) ? &first.particle_contact : nullptr;
    }

    void run(const WorldStep& step, std::span<cpu::Executor::Job> jobs) {
        executor_.run(step, jobs, stage_ms_);
        for (cpu::Executor::Job& job : jobs)
            if (job.adhesion) complete_lists(step, job);
    }

    // Cloths that have come near each other without stepping together are taken back, and the frame runs again.
    void group_again(const WorldStep& step, Island& island) {
        if (!step.input.bodies.empty()) return;  // all step together
        while (island.near.merge()) {
            std::vector<cpu::Executor::Job> grown;
            for (const auto& parts : island.near.groups()) {
                cpu::Executor::Job job;
                make_job(step, island, parts, job);
                if (std::ranges::find(jobs(), job.cloths, &cpu::Executor::Job::cloths) != jobs().end()) continue;
                job.again = true;
                for (cpu::ClothState* state : job.cloths) {
                    state->roll_back();
                    remove_job_of(*state);
                }
                ++counts_.repeats;
                grown.push_back(std::move(job));
            }
            run(step, grown);
            for (cpu::Executor::Job& job : grown) next_job() = std::move(job);
        }
    }

    void remove_job_of(const cpu::ClothState& state) {
        for (std::size_t i = 0; i < job_count_; ++i) {
            if (std::ranges::find(jobs_[i].cloths, &state) == jobs_[i].cloths.end()) continue;
            std::swap(jobs_[i], jobs_[--job_count_]);
            return;
        }
    }

    void make_room(const ClothModel& model, std::uint32_t base) {
        const std::size_t end = std::size_t{base} + model.capacity();
        if (arrays_.size() < end) arrays_.resize(end);
    }

    // If a list was too short, rolls its cloths back and repeats the frame with a longer list.
    void complete_lists(const WorldStep& step, cpu::Executor::Job& job) {
        while (job.adhesion->rows().is_full()) {
            for (cpu::ClothState* state : job.cloths) state->roll_back();
            job.adhesion->grow();
            job.again = true;
            executor_.run(step, std::span(&job, 1), stage_ms_);
            ++counts_.repeats;
        }
    }

    void add_counts(const cpu::AdhesionList& list) {
        counts_.rows += list.rows().rows();
        counts_.capacity += list.rows().capacity();
    }

    void add_counts(const ClothContactCounts& of_job) {
        contact_counts_.contacts += of_job.contacts;
        contact_counts_.searches += of_job.searches;
        contact_counts_.limited += of_job.limited;
        contact_counts_.tangled += of_job.tangled;
        if (of_job.tangled == 0) return;
        contact_counts_.tangled_particle = std::min(contact_counts_.tangled_particle, of_job.tangled_particle);
    }

    // Collects the reports and contacts of cloths. If one of them is not finite, rolls all of them back.
    void end_job(const WorldStep& step, const cpu::Executor::Job& job) {
        std::uint32_t all = report_none;
        for (std::size_t i = 0; i < job.cloths.size(); ++i) {
            const ClothStep& one = *job.steps[i];
            one.frame->reports = job.reports[i];
            one.frame->detail.clear();
            one.frame->openings.clear();
            if (job.cloths[i]->tearing) one.frame->openings = job.cloths[i]->tearing->openings();
            all |= job.reports[i];
            if (one.contact_forces && !job.cloths[i]->account.empty())
                job.cloths[i]->account.collect(*one.contact_forces);
        }
        if (!(all & report_non_finite)) return job.bodies->finish();
        for (cpu::ClothState* state : job.cloths) state->roll_back();
        const std::string culprit = executor_.find_non_finite(step, job);
        for (std::size_t i = 0; i < job.cloths.size(); ++i) {
            const ClothStep& one = *job.steps[i];
            cpu::ClothState& state = *job.cloths[i];
            if (one.contact_forces) one.contact_forces->clear();
            one.frame->openings.clear();
            one.frame->reports |= report_non_finite;
            one.frame->detail = culprit;
            state.roll_back();
            // The multipliers belong to the discarded positions, but residuals and saved states would still read them.
            std::fill_n(state.kept().begin(), state.model->first_shift(), 0.0f);
            state.update_normals();
        }
    }

    const cpu::Passes& passes_;
    WorkerTeam team_;
    cpu::Executor executor_;
    std::vector<std::unique_ptr<Island>> islands_;
    std::vector<cpu::Executor::Job> jobs_;  // of the current frame, and unused ones
    std::size_t job_count_ = 0;
    bool search_always_;
    ListCounts counts_;                  // of the last frame
    ClothContactCounts contact_counts_;  // of the last frame
    cpu::WorldArrays arrays_;
    cpu::Bodies bodies_;
    std::array<double, stage_count> stage_ms_{};
    std::vector<std::unique_ptr<Place>> cloths_;  // by handle
};

}  // namespace

Result<std::unique_ptr<Backend>> make_cpu_backend(const CpuOptions& options) {
    if (options.workers > 255)
        return Error{"threads", "must be at most 256, got " + std::to_string(options.workers + 1)};
    const cpu::Passes* passes = options.isa.empty() ? cpu::available_passes().front() : cpu::find_passes(options.isa);
    if (!passes) {
        std::string known;
        for (std::string_view isa : cpu_instruction_sets()) known += (known.empty() ? "" : ", ") + std::string(isa);
        return Error{"instruction set '" + options.isa + "'", "this machine has " + known};
    }
    return std::unique_ptr<Backend>(std::make_unique<CpuBackend>(*passes, options));
}

std::vector<std::string_view> cpu_instruction_sets() {
    std::vector<std::string_view> names;
    for (const cpu::Passes* passes : cpu::available_passes()) names.push_back(passes->isa);
    return names;
}

}  // namespace weft
