#include "cpu/cpu_backend.h"

#include "base/hash.h"
#include "cpu/cloth_state.h"
#include "cpu/executor.h"
#include "cpu/passes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

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

    Result<ClothHandle> add_cloth(std::shared_ptr<const ClothModel> model, std::uint32_t base) override {
        make_room(*model, base);
        auto state = std::make_unique<cpu::ClothState>(std::move(model), arrays_, base);
        const auto free = std::ranges::find_if(cloths_, [](const auto& one) { return one == nullptr; });
        const auto at = static_cast<std::uint32_t>(free - cloths_.begin());
        if (free == cloths_.end()) {
            cloths_.push_back(std::move(state));
        } else {
            *free = std::move(state);
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
        jobs_.resize(step.islands.size());
        links_.resize(std::max(links_.size(), step.islands.size()));
        const auto& begin = step.plan->frame_begin;
        const bool sticks = std::ranges::find(begin, PassKind::find, &Pass::kind) != begin.end();
        adhesion_.resize(sticks ? std::max(adhesion_.size(), step.islands.size()) : 0);
        counts_ = {};
        contact_counts_ = {};
        while (cloth_contact_.size() < step.islands.size()) cloth_contact_.emplace_back(search_always_);
        while (particle_contact_.size() < step.islands.size()) particle_contact_.emplace_back(search_always_);
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            cpu::Executor::Job& job = jobs_[i];
            job.step = &step.islands[i];
            job.links = job.step->links ? &links_[i] : nullptr;
            job.adhesion = sticks ? &adhesion_[i] : nullptr;
            job.again = false;
            job.cloths.clear();
            for (const ClothStep& one : job.step->cloths) job.cloths.push_back(&cloth(one.cloth));
            const auto collides = [](const cpu::ClothState* state) { return state->model->tiles != nullptr; };
            job.cloth_contact = std::ranges::any_of(job.cloths, collides) ? &cloth_contact_[i] : nullptr;
            const auto has_spheres = [](const cpu::ClothState* state) { return state->model->along_curve != nullptr; };
            const bool spheres = has_particle_contact(*step.plan) && std::ranges::any_of(job.cloths, has_spheres);
            job.particle_contact = spheres ? &particle_contact_[i] : nullptr;
        }
        executor_.run(step, jobs_, stage_ms_);
        for (cpu::Executor::Job& job : jobs_) {
            if (job.adhesion) complete_lists(step, job);
            if (job.cloth_contact) add_counts(job.cloth_contact->counts());
            if (job.particle_contact) add_counts(job.particle_contact->counts());
            end_island(step, job);
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
        for (const cpu::Executor::Job& job : jobs_) {
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
        sums.add_residual(model, stretch_residual(model, now.position, state.stretch_lambda(), state.substep_seconds));
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
    cpu::ClothState& cloth(ClothHandle id) const {
        assert(id.value < cloths_.size() && cloths_[id.value]);
        return *cloths_[id.value];
    }

    void make_room(const ClothModel& model, std::uint32_t base) {
        const std::size_t end = std::size_t{base} + model.capacity();
        if (arrays_.size() < end) arrays_.resize(end);
    }

    // If an island's list was too short, rolls the island back and repeats the frame with a longer list.
    void complete_lists(const WorldStep& step, cpu::Executor::Job& job) {
        while (job.adhesion->rows().is_full()) {
            for (cpu::ClothState* state : job.cloths) state->roll_back();
            job.adhesion->grow();
            job.again = true;
            executor_.run(step, std::span(&job, 1), stage_ms_);
            ++counts_.repeats;
        }
        counts_.rows += job.adhesion->rows().rows();
        counts_.capacity += job.adhesion->rows().capacity();
    }

    void add_counts(const ClothContactCounts& island) {
        contact_counts_.contacts += island.contacts;
        contact_counts_.searches += island.searches;
        contact_counts_.limited += island.limited;
        contact_counts_.tangled += island.tangled;
        if (island.tangled == 0) return;
        contact_counts_.tangled_particle = std::min(contact_counts_.tangled_particle, island.tangled_particle);
    }

    // Collects the reports and contacts of an island. If one of its cloths is not finite, rolls all of them back.
    void end_island(const WorldStep& step, const cpu::Executor::Job& job) {
        std::uint32_t all = report_none;
        for (std::size_t i = 0; i < job.cloths.size(); ++i) {
            const ClothStep& one = job.step->cloths[i];
            one.frame->reports = job.reports[i];
            one.frame->detail.clear();
            all |= job.reports[i];
            if (one.contact_forces && !job.cloths[i]->account.empty())
                job.cloths[i]->account.collect(*one.contact_forces);
        }
        if (!(all & report_non_finite)) return;
        for (cpu::ClothState* state : job.cloths) state->roll_back();
        const std::string culprit = executor_.find_non_finite(step, job);
        for (std::size_t i = 0; i < job.cloths.size(); ++i) {
            const ClothStep& one = job.step->cloths[i];
            cpu::ClothState& state = *job.cloths[i];
            if (one.contact_forces) one.contact_forces->clear();
            one.frame->reports |= report_non_finite;
            one.frame->detail = culprit;
            state.roll_back();
            // The multipliers belong to the discarded positions, but residuals and saved states would still read them.
            for (auto& table : state.lambda) std::ranges::fill(table, 0.0f);
            state.update_normals();
        }
    }

    const cpu::Passes& passes_;
    WorkerTeam team_;
    cpu::Executor executor_;
    std::vector<cpu::Executor::Job> jobs_;                // of the current frame
    std::vector<cpu::LinkState> links_;                   // by island
    std::vector<cpu::AdhesionList> adhesion_;             // by island; empty if nothing sticks
    std::vector<cpu::ClothContact> cloth_contact_;        // by island
    std::vector<cpu::ParticleContact> particle_contact_;  // by island
    bool search_always_;
    ListCounts counts_;                  // of the last frame
    ClothContactCounts contact_counts_;  // of the last frame
    cpu::WorldArrays arrays_;
    std::array<double, stage_count> stage_ms_{};
    std::vector<std::unique_ptr<cpu::ClothState>> cloths_;
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
