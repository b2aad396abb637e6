#include "vulkan/vulkan_backend.h"

#include "gpu/device.h"
#include "solver/measures/diagnosis.h"
#include "vulkan/device_options.h"
#include "vulkan/frame_run.h"
#include "vulkan/interop.h"
#include "vulkan/world_colliders.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <tuple>
#include <utility>

namespace weft {
namespace {

using vulkan::Cloth;
using vulkan::DrawnMesh;
using vulkan::Execution;
using vulkan::FrameRun;
using vulkan::ModelBuffers;

class VulkanBackend final : public Backend, public VulkanInterop {
  public:
    VulkanBackend(std::shared_ptr<gpu::Device> device, Execution execution, const VulkanOptions& options)
        : device_(std::move(device)),
          programs_(*device_),
          execution_(execution),
          timings_(options.timings),
          search_always_(options.search_always) {}
    // The results of a running frame are not needed any more, but its buffers must exist until it ends.
    ~VulkanBackend() override { (void)device_->wait(device_->submitted()); }

    std::string_view name() const override { return "vulkan"; }
    std::string device() const override { return device_->info().name + ", " + device_->info().driver; }
    unsigned threads() const override { return 1; }
    std::uint32_t most_bodies() const override { return most_device_bodies; }
    std::uint64_t device_bytes() const override { return device_->memory().used(); }

    Result<ClothHandle> add_cloth(std::shared_ptr<const ClothModel> model, std::uint32_t base) override {
        auto cloth = make_cloth(std::move(model), base);
        if (!cloth) return cloth.errors();
        const auto free = std::ranges::find_if(cloths_, [](const auto& one) { return one == nullptr; });
        const auto at = static_cast<std::uint32_t>(free - cloths_.begin());
        if (free == cloths_.end()) {
            cloths_.push_back(std::move(*cloth));
        } else {
            *free = std::move(*cloth);
        }
        return ClothHandle{at};
    }

    void remove_cloth(ClothHandle handle) override {
        forget_runs(cloth(handle));
        cloths_[handle.value] = nullptr;
    }

    Result<void> set_model(ClothHandle handle, std::shared_ptr<const ClothModel> model, std::uint32_t base) override {
        Cloth& old = cloth(handle);
        assert(model->first_anchor() == old.model().first_anchor());
        const auto before = old.save();
        if (!before) return before.errors();
        const bool same_anchors = model->anchor_count == old.model().anchor_count;
        // The new cloth may overwrite the particles of the old one. After a failure, the old one is restored.
        const auto undone = [&](const Errors& errors) -> Result<void> {
            (void)old.restore(*before);
            return errors;
        };
        auto next = make_cloth(std::move(model), base);
        if (!next) return undone(next.errors());
        ClothSnapshot snapshot = *before;
        keep_what_moves(snapshot, old.model(), (*next)->model(), same_anchors);
        if (auto restored = (*next)->restore(snapshot); !restored) return undone(restored.errors());
        forget_runs(old);
        cloths_[handle.value] = std::move(*next);
        return {};
    }

    Result<void> set_material(ClothHandle handle, std::shared_ptr<const ClothModel> model) override {
        vulkan::ClothState& state = cloth(handle).state();
        // Recorded commands contain numbers of the old fabric.
        forget_runs(cloth(handle));
        if (!state.owns_buffers() || models_[model.get()].lock()) {
            auto buffers = buffers_of(std::move(model));
            return buffers ? state.set_material(*device_, std::move(*buffers)) : Result<void>(buffers.errors());
        }
        const std::weak_ptr<ModelBuffers> mine = state.shared_buffers();
        models_.erase(&state.model());
        auto done = state.set_material(*device_, std::move(model));
        models_[&state.model()] = mine;
        return done;
    }

    Result<void> set_topology(ClothHandle handle, std::shared_ptr<const ClothModel> model,
                              std::span<const std::uint32_t> copied) override {
        Cloth& old = cloth(handle);
        assert(model->capacity() == old.model().capacity());
        const bool follows = copied.empty() && (old.torn || differs_in_levels_only(*model, old.model()));
        if (!model->tear_law || !follows) return replace_topology(handle, std::move(model), copied);
        auto buffers = ModelBuffers::create(*device_, std::move(model));
        if (!buffers) return buffers.errors();
        forget_runs(old);
        return old.follow(std::move(*buffers));
    }

    Result<void> place_points(ClothHandle handle, std::uint32_t first, std::span<const Vec3> places) override {
        auto done = cloth(handle).state().place_points(*device_, first, places);
        cloth(handle).changed(true);
        return done;
    }

    Result<void> set_weights(ClothHandle handle, std::span<const ParticleWeight> changed) override {
        auto done = cloth(handle).state().set_weights(*device_, changed);
        cloth(handle).changed(true);
        return done;
    }

    void step(const WorldStep& step) override {
        assert(groups_.empty());
        step_ = &step;
        counts_ = {};
        contact_counts_ = {};
        group(step);
        if (groups_.empty()) return run_bodies_alone(step);
        const auto copied = update_colliders(step);
        for (Group& group : groups_) {
            if (!copied) {
                fail(group, copied.error());
            } else {
                submit(step, group);
            }
        }
        last_ = device_->submitted();
    }

    void finish(std::array<double, stage_count>& stage_ms) override {
        if (groups_.empty()) return;
        const auto done = device_->wait(last_);
        for (Group& group : groups_) {
            if (!group.run) continue;
            if (done && complete_lists(group)) {
                finish(group, stage_ms);
            } else if (!done) {
                fail(group, done.error());
            }
        }
        groups_.clear();
    }

    bool read(ClothHandle handle, ClothFrame& frame) const override {
        Cloth& one = cloth(handle);
        const bool read = one.read().ok();
        frame.model = &one.model();
        frame.positions = one.positions();
        frame.velocities = one.velocities();
        frame.normals = one.normals();
        frame.triangles = one.model().triangles();
        frame.topology_version = one.model().topology_version;
        return read;
    }

    ListCounts list_counts() const override { return counts_; }
    ClothContactCounts cloth_contact_counts() const override { return contact_counts_; }
    void add_contact_marks(ClothHandle handle, std::span<std::uint32_t> marks) const override {
        const Cloth& one = cloth(handle);
        for (const auto& run : runs_)
            if (run->has(&one)) run->add_contact_marks(one, marks);
    }
    void measure(ClothHandle handle, MeasureSums& sums) const override { cloth(handle).measure(sums); }
    ClothSnapshot save(ClothHandle handle) const override {
        auto snapshot = cloth(handle).save();
        return snapshot ? std::move(*snapshot) : ClothSnapshot{};
    }
    Result<void> restore(ClothHandle handle, const ClothSnapshot& snapshot) override {
        return cloth(handle).restore(snapshot);
    }
    void hash(ClothHandle handle, StateHash& hash) const override { cloth(handle).hash(hash); }

    const std::shared_ptr<gpu::Device>& shared_device() const override { return device_; }
    Result<gpu::SurfaceBuffers> surface(ClothHandle handle, gpu::Moment before) override {
        Cloth& one = cloth(handle);
        if (!one.has_surface()) {
            auto mesh = drawn_mesh(one.state().buffers().model());
            if (!mesh) return mesh.errors();
            if (auto made = one.make_surface(std::move(*mesh)); !made) return made.errors();
        }
        return one.surface(before);
    }

  private:
    Result<void> update_colliders(const WorldStep& step) {
        if (auto done = bodies_.update(*device_, step); !done) return done;
        return colliders_.update(*device_, step.input.colliders, *step.input.places, bodies_.address());
    }

    // There is no frame to report a failure to: the bodies stay where they are.
    void run_bodies_alone(const WorldStep& step) {
        if (step.input.bodies.empty()) return;
        for (bool full = true; full;) {
            if (!update_colliders(step)) return;
            if (!bodies_.run_alone(*device_, programs_, colliders_.address(), step.plan->substeps)) return;
            full = bodies_.list_was_full();
            if (full) bodies_.grow();
        }
        if (bodies_.all_finite()) bodies_.finish();
    }

    Cloth& cloth(ClothHandle handle) const {
        assert(handle.value < cloths_.size() && cloths_[handle.value]);
        return *cloths_[handle.value];
    }

    // Makes room for particles up to `end`. If their addresses change, all users of the addresses are updated.
    Result<void> make_room(std::uint64_t end) {
        const auto moved = particles_.make_room(*device_, end);
        if (!moved) return moved.errors();
        if (!*moved) return {};
        runs_.clear();
        for (const auto& one : cloths_) {
            if (!one) continue;
            if (auto done = one->particles_moved(); !done) return done;
        }
        return {};
    }

    Result<std::unique_ptr<Cloth>> make_cloth(std::shared_ptr<const ClothModel> model, std::uint32_t base) {
        if (auto room = make_room(std::uint64_t{base} + model->capacity()); !room) return room.errors();
        auto buffers = buffers_of(std::move(model));
        if (!buffers) return buffers.errors();
        return Cloth::create(*device_, programs_, std::move(*buffers), particles_, base);
    }

    // Cloths of one model share its buffers.
    Result<std::shared_ptr<ModelBuffers>> buffers_of(std::shared_ptr<const ClothModel> model) {
        if (model->tear_law) return ModelBuffers::create(*device_, model);  // it changes while the cloth tears
        if (auto there = models_[model.get()].lock()) return there;
        std::erase_if(models_, [](const auto& one) { return one.second.expired(); });
        auto made = ModelBuffers::create(*device_, model);
        if (made) models_[model.get()] = *made;
        return made;
    }

    Result<std::shared_ptr<const DrawnMesh>> drawn_mesh(const std::shared_ptr<const ClothModel>& model) {
        if (auto there = drawn_[model.get()].lock()) return there;
        std::erase_if(drawn_, [](const auto& one) { return one.second.expired(); });
        auto made = DrawnMesh::create(*device_, model);
        if (made) drawn_[model.get()] = *made;
        return made;
    }

    // Makes a cloth of the model, with the particles of the present one.
    Result<void> replace_topology(ClothHandle handle, std::shared_ptr<const ClothModel> model,
                                  std::span<const std::uint32_t> copied) {
        Cloth& old = cloth(handle);
        const auto before = old.save();
        if (!before) return before.errors();
        ClothSnapshot snapshot = *before;
        for (std::size_t i = 0; i < copied.size(); ++i) {
            const std::size_t to = old.model().particle_count + i, from = copied[i];
            for (auto* array : {&snapshot.position, &snapshot.start, &snapshot.velocity, &snapshot.compensation})
                (*array)[to] = (*array)[from];
            snapshot.position[to].w = 0;
        }
        for (std::uint32_t p = 0; p < model->particle_count; ++p)
            snapshot.position[p].w = snapshot.position[p].w > 0 ? 1 / model->mass[p] : 0;
        for (std::uint32_t p = model->particle_count; p < model->first_anchor(); ++p) snapshot.position[p].w = 0;
        for (auto* array : {&snapshot.position, &snapshot.start, &snapshot.velocity, &snapshot.compensation})
            array->resize(model->point_count());
        // The new cloth overwrites the particles of the old one. After a failure, the old one is restored.
        auto next = make_cloth(std::move(model), old.state().base());
        Result<void> done;
        if (!next) done = next.errors();
        if (done) done = (*next)->restore(snapshot);
        if (!done) {
            (void)old.restore(*before);
            return done;
        }
        forget_runs(old);
        cloths_[handle.value] = std::move(*next);
        return {};
    }

    // Whether the triangles, masses and constraints are the same arrays.
    static bool differs_in_levels_only(const ClothModel& a, const ClothModel& b) {
        const auto same = [](const ConstraintTable& one, const ConstraintTable& other) {
            return one.particles.shares(other.particles) && one.fields.shares(other.fields);
        };
        return a.faces.shares(b.faces) && a.mass.shares(b.mass) && a.anchor_count == b.anchor_count &&
               std::ranges::equal(a.constraints, b.constraints, same);
    }

    // Anchors of different sets do not correspond, so new ones start at the positions in the model.
    static void keep_what_moves(ClothSnapshot& snapshot, const ClothModel& before, const ClothModel& model,
                                bool same_anchors) {
        const std::size_t kept = same_anchors ? model.point_count() : model.first_anchor();
        for (auto* array : {&snapshot.position, &snapshot.start, &snapshot.velocity, &snapshot.compensation})
            array->resize(kept), array->resize(model.point_count());
        for (std::size_t p = kept; p < model.point_count(); ++p) snapshot.position[p] = model.start[p];
        for (std::size_t p = 0; p < kept; ++p) snapshot.position[p].w = model.start[p].w;
        snapshot.kept = kept_after(before, snapshot.kept, model);
    }

    // Islands that one FrameRun runs together.
    struct Group {
        Execution execution{};
        std::vector<const ClothStep*> steps;
        std::vector<FrameRun::Member> members;
        FrameRun* run = nullptr;  ///< null if it failed
    };

    // `fused`: a workgroup runs a cloth to the end of the frame without waiting for others. So the cloth must be the
    // only one in its island, and there must be no dynamic lists and no contact between cloths, which all cloths share.
    // Contact of faces is too long a program: with it, drivers need minutes to compile the fused one.
    Execution execution_for(const WorldStep& step, const IslandStep& island) const {
        const bool single_cloth = island.cloths.size() == 1 && !island.parts.front().links && !has_lists(step) &&
                                  step.input.bodies.empty() &&
                                  !cloth(island.cloths.front().cloth).model().along_curve &&
                                  !cloth(island.cloths.front().cloth).model().tear_law && !has_face_contact(*step.plan);
        if (execution_ != Execution::automatic && (single_cloth || execution_ != Execution::fused)) return execution_;
        if (!device_->info().is_gpu()) return Execution::streamed;
        return single_cloth && vulkan::fits_fused(*device_, cloth(island.cloths.front().cloth).model())
                   ? Execution::fused
                   : Execution::grouped;
    }

    static bool has_lists(const WorldStep& step) {
        const auto& begin = step.plan->frame_begin;
        return std::ranges::find(begin, PassKind::find, &Pass::kind) != begin.end();
    }

    // Groups the islands by their execution.
    void group(const WorldStep& step) {
        for (std::uint32_t i = 0; i < step.islands.size(); ++i) {
            const IslandStep& island = step.islands[i];
            if (island.cloths.empty()) continue;
            const Execution execution = execution_for(step, island);
            auto there = std::ranges::find(groups_, execution, &Group::execution);
            if (there == groups_.end()) {
                groups_.push_back({.execution = execution, .steps = {}, .members = {}});
                there = groups_.end() - 1;
            }
            for (const StitchedPart& part : island.parts) {
                for (std::uint32_t k = part.begin; k < part.end; ++k) {
                    const ClothStep& one = island.cloths[k];
                    there->steps.push_back(&one);
                    there->members.push_back(
                        {.cloth = &cloth(one.cloth),
                         .shape = vulkan::shape_of(cloth(one.cloth).model(), *step.plan, step.input, one),
                         .stiffness = one.stiffness ? *one.stiffness : PlainStiffness{},
                         .island = i,
                         .links = k == part.begin ? part.links : nullptr,
                         .seams = island.seams.get()});
                }
            }
        }
    }

    void submit(const WorldStep& step, Group& group) {
        for (const FrameRun::Member& member : group.members) member.cloth->torn = false;
        for (const ClothStep* one : group.steps) {
            one->frame->reports = report_none;
            one->frame->detail.clear();
            one->frame->openings.clear();
        }
        auto run = find_run(step, group);
        if (!run) return fail(group, run.error());
        const auto value = (*run)->submit(step.input, group.steps);
        if (!value) return fail(group, value.error());
        group.run = *run;
        mark_changed(step, group);
    }

    void mark_changed(const WorldStep& step, const Group& group) const {
        const auto& end = step.plan->frame_end;
        const bool normals = std::ranges::find(end, PassKind::normals, &Pass::kind) != end.end();
        for (const ClothStep* one : group.steps) cloth(one->cloth).changed(normals);
    }

    // Returns the run that was recorded for the same frame, or records a new one in place of the cloths' other runs.
    Result<FrameRun*> find_run(const WorldStep& step, const Group& group) {
        for (const auto& run : runs_) {
            if (run->is_for(step.plan_serial, group.members, group.execution, step.input.tangle)) return run.get();
        }
        contact_room_ = contact_room_.for_tangle(step.input.tangle);
        for (const FrameRun::Member& member : group.members) forget_runs(*member.cloth);
        auto run = FrameRun::create(
            *device_, programs_, *step.plan, step.plan_serial, group.members, group.execution, timings_,
            {.colliders = colliders_.address(),
             .first_capacity = step.input.list_capacity,
             .adhesion = std::max(list_capacity_, first_list_capacity(step.input.list_capacity)),
             .cloth_contact = contact_room_,
             .particle_pairs = particle_pairs_,
             .bodies = bodies_.empty() ? nullptr : &bodies_,
             .search_always = search_always_,
             .records_marks = step.input.contact_marks});
        if (!run) return run.errors();
        runs_.push_back(std::move(*run));
        return runs_.back().get();
    }

    void forget_runs(const Cloth& cloth) {
        std::erase_if(runs_, [&](const auto& run) { return run->has(&cloth); });
    }

    // The bodies are at the start of the frame again.
    Result<FrameRun*> find_run_again(const Group& group) {
        if (auto updated = update_colliders(*step_); !updated) return updated.errors();
        return find_run(*step_, group);
    }

    // If a list was full, the device has restored the state before the frame. Runs the frame again with a longer list.
    // Returns false on failure.
    bool complete_lists(Group& group) {
        while (group.run->list_was_full()) {
            ++counts_.repeats;
            std::vector<std::uint32_t> slots_before;
            for (const FrameRun::Member& member : group.members)
                slots_before.push_back(member.cloth->state().near_slots);
            if (group.run->near_list_was_full()) {
                if (auto grown = group.run->roll_back_and_grow(); !grown) return fail(group, grown.error()), false;
            }
            const auto before = std::tuple(list_capacity_, contact_room_, particle_pairs_, bodies_.room());
            if (const auto* list = group.run->adhesion(); list && list->wanted() > list->capacity())
                list_capacity_ = grown_list_capacity(list->wanted());
            if (const auto* contact = group.run->cloth_contact())
                contact_room_ = contact_room_.with(contact->room().grown(contact->wanted()));
            if (const auto* particles = group.run->particle_contact();
                particles && particles->wanted() > particles->capacity())
                particle_pairs_ = grown_list_capacity(particles->wanted());
            if (group.run->bodies() && bodies_.list_was_full()) bodies_.grow();
            undo_tears(group);
            group.run = nullptr;
            for (const FrameRun::Member& member : group.members) forget_runs(*member.cloth);
            auto run = find_run_again(group);
            if (!run) {  // the next frame may need less
                std::tie(list_capacity_, contact_room_, particle_pairs_) =
                    std::tuple(std::get<0>(before), std::get<1>(before), std::get<2>(before));
                bodies_.set_room(std::get<3>(before));
                for (std::size_t i = 0; i < group.members.size(); ++i)
                    group.members[i].cloth->state().near_slots = slots_before[i];
                return fail(group, run.error()), false;
            }
            const auto value = (*run)->submit(step_->input, group.steps, true);
            if (!value) return fail(group, value.error()), false;
            mark_changed(*step_, group);
            if (auto done = device_->wait(*value); !done) return fail(group, done.error()), false;
            group.run = *run;
        }
        if (const auto* list = group.run->adhesion()) {
            counts_.rows += list->wanted();
            counts_.capacity += list->capacity();
        }
        if (const auto* contact = group.run->cloth_contact()) contact_counts_ = contact->counts();
        if (const auto* particles = group.run->particle_contact()) {
            if (!group.run->cloth_contact()) contact_counts_ = {};
            contact_counts_.contacts += particles->counts().contacts;
            contact_counts_.searches += particles->counts().searches;
        }
        return true;
    }

    void finish(Group& group, std::array<double, stage_count>& stage_ms) {
        group.run->finish(stage_ms);
        for (std::size_t i = 0; i < group.steps.size(); ++i) {
            ClothFrame& frame = *group.steps[i]->frame;
            frame.reports = group.run->report(i);
            group.run->read_pulls(i, group.steps[i]->pulls);
            if (ClothContactLog* contact_forces = group.steps[i]->contact_forces)
                frame.reports |= group.run->read_contact_forces(i, *contact_forces);
            if (frame.reports & report_non_finite) {
                name_culprit(group, i);
            } else if (const auto* tearing = group.run->tearing()) {
                frame.openings = tearing->openings(i);
                group.members[i].cloth->torn = !frame.openings.empty();
            }
        }
        const auto not_finite = [](const ClothStep* step) { return step->frame->reports & report_non_finite; };
        const bool failed = std::ranges::any_of(group.steps, not_finite);
        if (failed) undo_tears(group, true);
        if (!failed && group.run->bodies()) bodies_.finish();
    }

    // The device has restored the particles of a frame, but not what openings have changed. `only_not_finite`: of
    // cloths with that report.
    void undo_tears(Group& group, bool only_not_finite = false) {
        if (!group.run->tearing()) return;
        std::vector<std::size_t> torn;
        for (std::size_t i = 0; i < group.members.size(); ++i) {
            const bool meant = !only_not_finite || (group.steps[i]->frame->reports & report_non_finite);
            if (meant && !group.run->tearing()->openings(i).empty()) torn.push_back(i);
        }
        for (const std::size_t i : torn) {
            const ClothHandle handle = group.steps[i]->cloth;
            // A repeated frame keeps its limits, which follow from the lambda of the frame before.
            const auto limits = vulkan::download(*device_, cloth(handle).state().arena(), cloth(handle).state().limits);
            auto done = limits ? replace_topology(handle, cloth(handle).state().buffers().model(), {})
                               : Result<void>(limits.errors());
            const vulkan::ClothState& state = cloth(handle).state();
            if (done) done = vulkan::upload(*device_, state.arena(), state.limits, *limits);
            if (!done) fail(group, done.error());
            group.members[i].cloth = &cloth(handle);
        }
    }

    // All cloths of an island get the same detail: the first cause that is found in one of them.
    void name_culprit(Group& group, std::size_t member) {
        std::string& detail = group.steps[member]->frame->detail;
        const std::uint32_t island = group.members[member].island;
        if (member > 0 && group.members[member - 1].island == island) {
            detail = group.steps[member - 1]->frame->detail;
            return;
        }
        detail = late_non_finite;
        for (std::size_t i = member; i < group.steps.size() && group.members[i].island == island; ++i) {
            auto culprit = group.run->find_non_finite(i, step_->input, *group.steps[i]);
            detail = culprit ? *culprit : culprit.error().message();
            if (detail != late_non_finite) return;
        }
    }

    static void fail(const Group& group, const Error& error) {
        for (const ClothStep* step : group.steps) {
            step->frame->reports = report_device_failed;
            step->frame->detail = error.message();
        }
    }

    std::shared_ptr<gpu::Device> device_;
    vulkan::Programs programs_;
    Execution execution_;
    bool timings_, search_always_;
    std::map<const ClothModel*, std::weak_ptr<ModelBuffers>> models_;
    std::map<const ClothModel*, std::weak_ptr<const DrawnMesh>> drawn_;
    vulkan::WorldParticles particles_;  // outlives the cloths
    std::vector<std::unique_ptr<Cloth>> cloths_;
    std::vector<std::unique_ptr<FrameRun>> runs_;
    // Timeline value at the end of the last frame. Work that is submitted after it may wait for the host, so the next
    // step must not wait for that work.
    std::uint64_t last_ = 0;
    // Valid until the frame is finished:
    std::vector<Group> groups_;
    const WorldStep* step_ = nullptr;
    ListCounts counts_;                      ///< of the last frame
    std::uint32_t list_capacity_ = 0;        ///< grown capacity of dynamic lists, in constraints
    vulkan::ClothContactRoom contact_room_;  ///< the same for contact between cloths
    std::uint32_t particle_pairs_ = 0;       ///< the same for contact between particles
    vulkan::WorldColliders colliders_;
    vulkan::Bodies bodies_;
    ClothContactCounts contact_counts_;  ///< of the last frame
};

Result<Execution> execution_of(const VulkanOptions& options) {
    const auto execution = std::ranges::find(execution_names, options.execution);
    if (execution == execution_names.end())
        return Error{"execution", "must be auto, streamed, grouped or fused, got '" + options.execution + "'"};
    return static_cast<Execution>(execution - execution_names.begin());
}

}  // namespace

Result<std::unique_ptr<Backend>> make_vulkan_backend(std::shared_ptr<gpu::Device> device,
                                                     const VulkanOptions& options) {
    const auto execution = execution_of(options);
    if (!execution) return execution.errors();
    return std::unique_ptr<Backend>(std::make_unique<VulkanBackend>(std::move(device), *execution, options));
}

Result<std::unique_ptr<Backend>> make_vulkan_backend(std::shared_ptr<const gpu::Instance> instance,
                                                     const gpu::HostDevice& host, const VulkanOptions& options) {
    if (const auto execution = execution_of(options); !execution) return execution.errors();
    gpu::DeviceInfo info;
    for (const gpu::DeviceInfo& one : instance->devices())
        if (instance->physical(one) == host.physical) info = one;
    auto device = gpu::Device::adopt(std::move(instance), host, vulkan::device_options(info, options));
    if (!device) return device.errors();
    return make_vulkan_backend(std::move(*device), options);
}

Result<std::unique_ptr<Backend>> make_vulkan_backend(const VulkanOptions& options) {
    if (const auto execution = execution_of(options); !execution) return execution.errors();
    auto device = make_vulkan_device(options);
    if (!device) return device.errors();
    return make_vulkan_backend(std::move(*device), options);
}

}  // namespace weft
