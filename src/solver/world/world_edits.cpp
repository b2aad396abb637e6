// Edits of the constraints, triangles and particles of cloths.
#include "base/hash.h"
#include "solver/model/pruned_limits.h"
#include "solver/model/rebuilt_limits.h"
#include "solver/model/tear_law.h"
#include "solver/world/world.h"

#include <algorithm>
#include <cassert>

namespace weft {
namespace {

void hash_row(const RowEdit& row, StateHash& hash) {
    hash.add(static_cast<std::uint32_t>(row.kind)), hash.add(row.row), hash.add(row.stiffness);
    for (const std::uint32_t particle : row.particles) hash.add(particle);
}

// The sources of the particles that `after` has beyond those of `before`.
std::span<const std::uint32_t> copies_since(const ClothModel& before, const ClothModel& after) {
    const std::size_t known = before.copied_from.size();
    return {after.copied_from.data() + known, after.copied_from.size() - known};
}

bool is_only_openings(const ClothEdit& edit) {
    return edit.appended.empty() && edit.triangles.empty() && edit.added.empty() && edit.rows.empty();
}

// Frames with tears, one after another, before coarse levels are built again. On cloth of 129² that takes as long as
// the rest of a frame.
constexpr std::uint32_t most_pruned_frames = 8;

// In how many frames the coarse levels have been pruned since they were built.
std::uint32_t pruned_frames(const std::vector<ClothEdit>& edits) {
    return edits.empty() ? 0 : edits.back().pruned_frames;
}

// Adds openings to the last edits. They are one edit, or two while the coarse levels are pruned: the openings before,
// and those since.
void add_openings(std::vector<ClothEdit>& edits, const std::vector<Opening>& openings, std::uint32_t pruned) {
    const auto append = [&](const std::vector<Opening>& more) {
        if (edits.empty() || !is_only_openings(edits.back())) edits.emplace_back();
        auto& all = edits.back().openings;
        all.insert(all.end(), more.begin(), more.end());
    };
    if (pruned == 1) edits.emplace_back();
    if (pruned == 0 && pruned_frames(edits) > 0) {
        const ClothEdit before = std::move(edits.back());
        edits.pop_back();
        append(before.openings);
    }
    append(openings);
    edits.back().pruned_frames = pruned;
}

}  // namespace

bool World::has_only_openings(const Cloth& cloth) {
    return std::ranges::all_of(cloth.edits, is_only_openings);
}

ClothEdit World::all_openings(const Cloth& cloth) {
    ClothEdit all;
    for (const ClothEdit& edit : cloth.edits)
        all.openings.insert(all.openings.end(), edit.openings.begin(), edit.openings.end());
    return all;
}

// Pins copies of pinned particles, and moves them like these; the first `plain_copies` copies are free. Returns the
// inverse masses of all copies. `model` is the next one of the cloth.
std::vector<ParticleWeight> World::pin_copies(Cloth& cloth, const ClothModel& model, std::size_t plain_copies) const {
    std::vector<ParticleWeight> copies;
    const std::span sources = copies_since(*cloth.model, model);
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        const std::uint32_t p = cloth.model->particle_count + i;
        const bool holds = i >= plain_copies && std::ranges::binary_search(cloth.pinned, sources[i]);
        copies.push_back({p, holds ? 0 : 1 / model.mass[p]});
        if (!holds) continue;
        cloth.pinned.push_back(p);
        auto& targets = cloth.targets.particles;
        const auto target = std::ranges::lower_bound(targets, sources[i], {}, &KinematicTarget::particle);
        if (target == targets.end() || target->particle != sources[i]) continue;
        KinematicTarget same = *target;
        same.particle = p;
        targets.insert(std::ranges::upper_bound(targets, p, {}, &KinematicTarget::particle), same);
    }
    return copies;
}

// The model of a cloth after the openings of a frame. `pruned`: as in ClothEdit; 0: coarse levels are built again.
Result<std::shared_ptr<const ClothModel>> World::opened_model(const Cloth& cloth, const std::vector<Opening>& openings,
                                                              std::uint32_t pruned) {
    if (!openings.empty()) return with_edit(*cloth.model, {.openings = openings, .pruned_frames = pruned});
    return with_rebuilt_limits(*cloth.model);
}

// The backend has opened the edges already. The model follows, so that the frame has its triangles. Coarse levels are
// pruned at first. They are built again after the first frame without tears, or after `most_pruned_frames` with tears.
void World::take_openings() const {
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        Cloth& cloth = cloths_[i];
        const std::vector<Opening>& openings = frame_.cloths[i].openings;
        const std::uint32_t before = pruned_frames(cloth.edits);
        if (openings.empty() && before == 0) continue;
        const bool prunes = !openings.empty() && before < most_pruned_frames && can_prune_limits(*cloth.model);
        const std::uint32_t pruned = prunes ? before + 1 : 0;
        auto model = opened_model(cloth, openings, pruned);
        auto set = model ? backend_->set_topology(cloth.handle, *model, {}) : Result<void>(model.errors());
        if (!set) {  // for example too little memory on the device
            frame_.cloths[i].reports |= report_device_failed;
            frame_.cloths[i].detail = set.error().message();
            continue;
        }
        (void)pin_copies(cloth, **model, 0);
        if (!cloth.unedited) cloth.unedited = cloth.model;
        add_openings(cloth.edits, openings, pruned);
        cloth.model = std::move(*model);
        frame_.cloths[i].model = cloth.model.get();
        torn_.push_back(cloths_.id_of(i));
        unread_ = true;
    }
    if (!torn_.empty()) drop_grabs_without_triangle();
}

Result<void> World::edit(ClothId id, const ClothEdit& edit) {
    assert(contains(id));
    complete_and_resolve();
    Cloth& cloth = cloths_[cloths_.find(id)];
    auto model = with_edit(*cloth.model, edit);
    if (!model) return model.errors();
    const std::span copied = copies_since(*cloth.model, **model);
    if (auto set = backend_->set_topology(cloth.handle, *model, copied); !set) return set;
    Cloth changed = cloth;
    const std::vector<ParticleWeight> copies = pin_copies(changed, **model, edit.appended.size());
    if (auto set = backend_->set_weights(cloth.handle, copies); !set) {
        (void)backend_->set_topology(cloth.handle, cloth.model, {});
        return set;
    }
    if (!cloth.unedited) cloth.unedited = cloth.model;
    cloth.edits.push_back(edit);
    cloth.model = std::move(*model);
    cloth.pinned = std::move(changed.pinned);
    cloth.targets = std::move(changed.targets);
    if (!is_only_openings(edit)) pending_.drop(id);
    drop_grabs_without_triangle();
    list_cloths();
    replan();
    return {};
}

Result<bool> World::set_pins(ClothId id, std::vector<std::uint32_t> pinned, KinematicTargets targets,
                             const std::vector<Attachment>& attachments) {
    assert(contains(id));
    complete_and_resolve();
    Cloth& cloth = cloths_[cloths_.find(id)];
    auto model = with_attachments(*cloth.model, attachments);
    if (!model) return model.errors();
    if (!*model) return false;
    std::shared_ptr<const ClothModel> unedited;
    if (cloth.unedited) {
        auto other = with_attachments(*cloth.unedited, attachments);
        if (!other) return other.errors();
        unedited = std::move(*other);
    }
    std::vector<Vec3> places;
    for (const Attachment& attachment : attachments) places.push_back(attachment.place);
    const auto before = cloth.model;
    const ClothSnapshot state = backend_->save(cloth.handle);
    const auto go_back = [&](const Errors& errors) {
        (void)backend_->set_topology(cloth.handle, before, {});
        (void)backend_->restore(cloth.handle, state);
        cloth.model = before;
        list_cloths();
        replan();
        return errors;
    };
    if (auto set = backend_->set_topology(cloth.handle, *model, {}); !set) return set.errors();
    if (auto placed = backend_->place_points(cloth.handle, (*model)->first_anchor(), places); !placed)
        return go_back(placed.errors());
    cloth.model = std::move(*model);
    list_cloths();
    replan();
    if (auto set = set_pins(id, std::move(pinned), std::move(targets)); !set) return go_back(set.errors());
    cloth.unedited = std::move(unedited);
    return true;
}

// The model of a cloth after these edits.
Result<std::shared_ptr<const ClothModel>> World::edited_model(const Cloth& cloth, const std::vector<ClothEdit>& edits) {
    if (edits == cloth.edits) return cloth.model;
    auto model = cloth.unedited ? cloth.unedited : cloth.model;
    for (const ClothEdit& edit : edits) {
        auto next = with_edit(*model, edit);
        if (!next) return next;
        model = std::move(*next);
    }
    return model;
}

// Sets the edits of a saved state; its positions and velocities are restored afterwards.
Result<void> World::set_edits(Cloth& cloth, const std::vector<ClothEdit>& edits,
                              std::shared_ptr<const ClothModel> model) {
    if (edits == cloth.edits) return {};
    if (auto set = backend_->set_topology(cloth.handle, model, {}); !set) return set;
    if (!cloth.unedited) cloth.unedited = cloth.model;
    if (edits.empty()) cloth.unedited = nullptr;
    cloth.edits = edits;
    cloth.model = std::move(model);
    return {};
}

// The model of a cloth before its edits, with the fabric and the strengths of `model`; null without edits.
Result<std::shared_ptr<const ClothModel>> World::with_fabric_unedited(const Cloth& cloth, const ClothModel& model) {
    if (!cloth.unedited) return std::shared_ptr<const ClothModel>();
    Fabric fabric = model.fabric;
    fabric.tether.use = cloth.unedited->tethers_asked;
    auto changed = with_fabric(*cloth.unedited, fabric);
    if (changed && !*changed)
        return Error{"cloth '" + model.name + "'", "has been edited, and this fabric needs other constraints"};
    if (changed && (*changed)->tear_law && (*changed)->tear_paint != model.tear_paint)
        return with_tear_paint(**changed, model.tear_paint);
    return changed;
}

void World::hash_edits(const Cloth& cloth, StateHash& hash) {
    for (const ClothEdit& edit : cloth.edits) {
        for (const std::uint32_t particle : edit.appended) hash.add(particle);
        for (const TriangleEdit& triangle : edit.triangles) {
            hash.add(triangle.triangle), hash.add(triangle.alive);
            for (const std::uint32_t corner : triangle.corners) hash.add(corner);
        }
        for (const Opening& opening : edit.openings)
            for (std::size_t i = 0; i < 2; ++i) hash.add(opening.links[i]), hash.add(opening.strayed[i]);
        for (const RowEdit& row : edit.rows) hash_row(row, hash);
        for (const RowEdit& row : edit.added) hash_row(row, hash);
        if (edit.pruned_frames > 0) hash.add(edit.pruned_frames);
    }
}

}  // namespace weft
