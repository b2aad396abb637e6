#include "weft/scene_world.h"

#include "base/cache_file.h"
#include "scene/check.h"
#include "scene/scene_keys.h"
#include "scene/set_value.h"
#include "solver/model/cuts.h"
#include "weft/body_building.h"
#include "weft/scene_parts.h"
#include "weft/stitching.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

namespace weft {
namespace {

Errors apply(const Options& options, SolverDesc& solver) {
    Problems problems;
    set_values(solver_keys, &solver, options.solver, "solver", problems);
    if (problems.none()) check_solver(solver, "solver", problems);
    if (options.threads < 1 || options.threads > 256)
        problems.add("threads", "must be from 1 to 256, got " + std::to_string(options.threads));
    return std::move(problems).take();
}

/// `now`, with gravity and air of the scene and with this solver.
WorldSettings settings_of(const SceneDesc& scene, const SolverDesc& solver, WorldSettings now) {
    now.gravity = scene.gravity;
    now.solver = solver;
    now.air = scene.air;
    return now;
}

/// Unique in the process, so that a checkpoint can go to another SceneWorld.
std::uint64_t next_serial() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

/// A new model for a cloth.
struct SceneWorld::Change {
    ClothId id;
    std::shared_ptr<const ClothModel> model;
    KinematicTargets targets;
    std::vector<std::uint32_t> pinned;
};

SceneWorld::SceneWorld() = default;
SceneWorld::SceneWorld(SceneWorld&&) noexcept = default;
SceneWorld& SceneWorld::operator=(SceneWorld&&) noexcept = default;
SceneWorld::~SceneWorld() = default;

Result<SceneWorld> SceneWorld::create(SceneDesc scene, const Options& options, const std::filesystem::path& folder,
                                      const MakeBackend& make) {
    if (Errors errors = apply(options, scene.solver); !errors.empty()) return errors;
    Options on = options;
    const auto bodies = std::ranges::count_if(scene.colliders, [](const ColliderDesc& one) { return !!one.body; });
    if (bodies > most_device_bodies && on.backend == "auto" && on.device.empty()) on.backend = "cpu";
    auto backend = make ? make(on) : make_backend(on);
    if (!backend) return backend.errors();
    name_unnamed(scene);
    SceneWorld made;
    made.files_ = {options.read_mesh, folder};
    made.shapes_ =
        ShapeLibrary(std::max(1u, options.threads), FieldCache(options.field_cache.value_or(cache_folder())));
    const WorldSettings host{.contact_forces = options.contact_forces, .background = options.threads > 1};
    made.world_ = std::make_unique<World>(std::move(*backend), settings_of(scene, scene.solver, host));
    std::vector<SceneCloth> cloths = std::exchange(scene.cloths, {});
    std::vector<SceneCollider> colliders = std::exchange(scene.colliders, {});
    std::vector<StitchDesc> stitches = std::exchange(scene.stitches, {});
    made.scene_ = std::move(scene);
    Errors errors;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        auto added = made.add(std::move(colliders[i]), "/colliders/" + std::to_string(i));
        if (!added) errors.insert(errors.end(), added.errors().begin(), added.errors().end());
    }
    for (std::size_t i = 0; i < cloths.size(); ++i) {
        auto added = made.add(std::move(cloths[i]), "/cloths/" + std::to_string(i));
        if (!added) errors.insert(errors.end(), added.errors().begin(), added.errors().end());
    }
    for (std::size_t i = 0; errors.empty() && i < stitches.size(); ++i) {
        auto added = made.add(std::move(stitches[i]), "/stitches/" + std::to_string(i));
        if (!added) errors = added.errors();
    }
    if (!errors.empty()) return errors;
    made.make_cuts();  // those of time 0, so that the first frame shows them
    return made;
}

void SceneWorld::make_cuts() {
    for (std::size_t i = 0; i < sources_.size(); ++i)
        if (!sources_[i].cuts.empty()) make_cuts(i);
}

// Looks at the edges and not at a list of what was done, so that it is right after any change and in a restored world.
void SceneWorld::make_cuts(std::size_t place) {
    const ClothId id = world_->cloth_id(place);
    const auto now = static_cast<float>(world_->time());  // rounded like the times of cuts: 0.2f is later than 0.2
    std::vector<PlannedCut>& cuts = sources_[place].cuts;
    ClothEdit edit;
    for (const PlannedCut& cut : cuts) {
        if (cut.time > now) break;
        if (cut.failed) continue;
        const auto closed = closed_ones(*world_->model(id), cut.openings);
        edit.openings.insert(edit.openings.end(), closed.begin(), closed.end());
    }
    if (edit.openings.empty()) return;
    const auto done = world_->edit(id, edit);
    if (done) return;
    for (PlannedCut& cut : cuts) cut.failed = cut.failed || cut.time <= now;
    for (const Error& error : done.errors()) notes_.push_back("cut not made: " + error.message());
}

Result<void> SceneWorld::cut(ClothId id, const CutDesc& cut, CutPositions positions) {
    const std::size_t place = place_of(id);
    if (scene_.cloths[place].tearing == Tearing::off)
        return Error{"cloth '" + scene_.cloths[place].name + "'",
                     "cannot be cut: its \"tearing\" is \"off\"; it must be \"cuts\", \"split\" or \"erode\""};
    const Frame& frame = world_->frame();
    const std::shared_ptr<const ClothModel> model = world_->model(id);
    std::span<const Vec4> now;
    if (positions == CutPositions::current) now = frame.cloths[place].positions;
    auto openings = find_cut(cut, *model, now, "cut");
    if (!openings) return openings.errors();
    if (auto opens = check_opens(*model, *openings, "cut"); !opens) return opens;
    return world_->edit(id, {.openings = std::move(*openings)});
}

Result<GrabId> SceneWorld::grab(ClothId id, const MeshPoint& point, Vec3 to, const GrabDesc& spring) {
    const std::size_t place = place_of(id);
    (void)world_->summary();  // the running frame may remove the triangle
    const auto triangle = find_triangle(point.triangle, *world_->unedited_model(id), sources_[place]);
    if (!triangle) return triangle.errors();
    const Triangle corners = world_->model(id)->triangles()[*triangle];
    if (corners[0] == corners[1])
        return Error{"/triangle", "triangle " + std::to_string(point.triangle) + " has been removed"};
    const float sum = point.weights.x + point.weights.y + point.weights.z;  // 1 up to rounding
    return world_->grab(id, *triangle, point.weights / sum, to, spring);
}

std::size_t SceneWorld::place_of(ClothId id) const {
    assert(world_->contains(id));
    std::size_t place = 0;
    while (world_->cloth_id(place) != id) ++place;
    return place;
}

std::size_t SceneWorld::place_of(ColliderId id) const {
    assert(world_->contains(id));
    std::size_t place = 0;
    while (world_->collider_id(place) != id) ++place;
    return place;
}

Result<ClothId> SceneWorld::add(SceneCloth cloth, const std::string& pointer) {
    auto built = build_cloth(cloth, files_, *world_, pointer, notes_);
    if (!built) return built.errors();
    auto id = world_->try_add(std::move(built->model), std::move(built->targets));
    if (!id) return placed_at(pointer, id.errors());
    sources_.push_back(std::move(built->source));
    sources_.back().serial = next_serial();
    scene_.cloths.push_back(std::move(cloth));
    return *id;
}

Result<StitchId> SceneWorld::add(StitchDesc stitches, const std::string& pointer) {
    const auto named = [&](const std::string& name) -> SewnCloth {
        const auto place = static_cast<std::size_t>(find_named(scene_.cloths, name) - scene_.cloths.data());
        const ClothId id = world_->cloth_id(place);
        return {id, *world_->model(id), sources_[place]};
    };
    auto made = make_stitches(stitches, named(stitches.a.cloth), named(stitches.b.cloth), pointer);
    if (!made) return made.errors();
    const StitchId id = world_->add(std::move(*made));
    stitch_ids_.push_back(id);
    scene_.stitches.push_back(std::move(stitches));
    return id;
}

void SceneWorld::remove(StitchId id) {
    const auto place = std::ranges::find(stitch_ids_, id) - stitch_ids_.begin();
    world_->remove(id);
    stitch_ids_.erase(stitch_ids_.begin() + place);
    scene_.stitches.erase(scene_.stitches.begin() + place);
}

Result<ColliderId> SceneWorld::add(SceneCollider collider, const std::string& pointer) {
    auto data = shapes_.data_of(collider, files_, pointer, notes_);
    if (!data) return data.errors();
    auto surface = surface_of(collider, data->get(), pointer, notes_);
    if (!surface) return surface.errors();
    Collider made = make_collider(collider, std::move(*data));
    made.surface = std::move(*surface);
    if (auto body = add_body(made, collider, world_->colliders(), pointer, notes_); !body) return body.errors();
    auto id = world_->try_add(std::move(made));
    if (!id) return placed_at(pointer, id.errors());
    collider_serials_.push_back(next_serial());
    scene_.colliders.push_back(std::move(collider));
    return *id;
}

void SceneWorld::remove(ClothId id) {
    const auto place = static_cast<std::ptrdiff_t>(place_of(id));
    const std::string& called = scene_.cloths[static_cast<std::size_t>(place)].name;
    for (std::size_t i = scene_.stitches.size(); i-- > 0;)
        if (scene_.stitches[i].a.cloth == called || scene_.stitches[i].b.cloth == called) remove(stitch_ids_[i]);
    world_->remove(id);
    sources_.erase(sources_.begin() + place);
    scene_.cloths.erase(scene_.cloths.begin() + place);
}

void SceneWorld::remove(ColliderId id) {
    const auto place = static_cast<std::ptrdiff_t>(place_of(id));
    world_->remove(id);
    const std::string name = std::move(scene_.colliders[static_cast<std::size_t>(place)].name);
    scene_.colliders.erase(scene_.colliders.begin() + place);
    collider_serials_.erase(collider_serials_.begin() + place);
    for (SceneCloth& cloth : scene_.cloths)
        for (PinDesc& pin : cloth.pins)
            if (pin.attach == name) pin.attach.clear();
}

// Sets all models, or none if one fails.
Result<void> SceneWorld::set_models(std::span<Change> changes) {
    std::vector<Change> before;
    std::vector<ClothId> pending;
    for (Change& change : changes) {
        Change now{change.id, world_->unedited_model(change.id), world_->kinematic_targets(change.id),
                   world_->pinned(change.id)};
        if (world_->is_rebuilding(change.id)) pending.push_back(change.id);
        if (auto set = world_->set_model(change.id, std::move(change.model), std::move(change.targets),
                                         std::move(change.pinned));
            !set) {
            // The old models fitted before, so there is room for each of them.
            for (Change& earlier : before)
                (void)world_->set_model(earlier.id, std::move(earlier.model), std::move(earlier.targets),
                                        std::move(earlier.pinned));
            for (const ClothId id : pending) rebuild_later(place_of(id));
            return set;
        }
        before.push_back(std::move(now));
    }
    return {};
}

// `cloth` has no meshes (without_meshes()).
Result<void> SceneWorld::change_cloth(ClothId id, SceneCloth cloth, ClothPins pins, KinematicTargets targets,
                                      std::vector<std::uint32_t> pinned) {
    const std::size_t place = place_of(id);
    auto model = rebuild_cloth(*world_->model(id), sources_[place], cloth, pins, world_->settings().layout());
    if (!model) return model.errors();
    Change change{id, std::move(*model), std::move(targets), std::move(pinned)};
    if (auto set = set_models(std::span(&change, 1)); !set) return set;
    SceneCloth& document = scene_.cloths[place];
    cloth.mesh = std::move(document.mesh);
    cloth.render_mesh = std::move(document.render_mesh);
    document = std::move(cloth);
    sources_[place].pins = std::move(pins);
    return {};
}

Result<void> SceneWorld::set_fabric(ClothId id, const Fabric& fabric, const std::string& preset) {
    const std::size_t place = place_of(id);
    SceneCloth cloth = without_meshes(scene_.cloths[place]);
    cloth.fabric = fabric;
    cloth.fabric_name = preset;
    auto changed = change_material(place, cloth);
    if (!changed) return changed.errors();
    if (*changed) return {};
    // Use the current targets of the world: colliders that moved pins may have been removed.
    return change_cloth(id, std::move(cloth), sources_[place].pins, world_->kinematic_targets(id), world_->pinned(id));
}

Result<bool> SceneWorld::change_material(std::size_t place, const SceneCloth& cloth) {
    const ClothId id = world_->cloth_id(place);
    const auto before = world_->model(id);
    const Fabric fabric = fabric_of(cloth);
    auto model = with_fabric(*before, fabric);
    if (!model) return model.errors();
    if (!*model) return false;
    const bool pending = world_->is_rebuilding(id);
    if (auto set = world_->set_material(id, std::move(*model)); !set) return set.errors();
    scene_.cloths[place].fabric = cloth.fabric;
    scene_.cloths[place].fabric_name = cloth.fabric_name;
    // The new fabric may need coarse levels even if the cloth has none yet.
    const bool limited = world_->settings().solver.hierarchy || before->table(ConstraintKind::tether).rows > 0;
    if (pending || (limited && limits_differ(before->fabric, fabric))) rebuild_later(place);
    return true;
}

// The strength of particles is part of the model and not of the constraints: nothing else changes.
Result<void> SceneWorld::change_resistance(std::size_t place, const SceneCloth& cloth, const std::string& pointer) {
    const ClothId id = world_->cloth_id(place);
    const bool pending = world_->is_rebuilding(id);
    auto model = with_resistance(*world_->model(id), sources_[place], cloth, pointer);
    if (!model) return model.errors();
    if (auto set = world_->set_material(id, std::move(*model)); !set) return set;
    scene_.cloths[place].resistance = cloth.resistance;
    if (pending) rebuild_later(place);
    return {};
}

// The room for copies is part of the model. A cloth that has been cut would lose its cuts.
bool SceneWorld::can_change_tearing(std::size_t place, const SceneCloth& wanted) const {
    const ClothId id = world_->cloth_id(place);
    const auto& model = world_->model(id);
    return wanted.cuts.empty() && wanted.seams.empty() && world_->unedited_model(id) == model &&
           gets_room_while_it_moves(scene_.cloths[place], *model);
}

Result<void> SceneWorld::change_tearing(std::size_t place, const SceneCloth& wanted) {
    const ClothId id = world_->cloth_id(place);
    SceneCloth cloth = without_meshes(scene_.cloths[place]);
    cloth.tearing = wanted.tearing, cloth.tear_room = wanted.tear_room;
    cloth.resistance.clear();  // change_resistance() follows
    ClothSource source = sources_[place];
    const std::uint32_t anchors_before = world_->model(id)->first_anchor();
    auto model = rebuild_with_tearing(*world_->model(id), source, cloth, world_->settings().layout());
    if (!model) return model.errors();
    KinematicTargets targets = world_->kinematic_targets(id);
    for (KinematicTarget& target : targets.particles)
        if (target.particle >= anchors_before) target.particle += (*model)->first_anchor() - anchors_before;
    if (auto set = world_->set_model_with_room(id, std::move(*model), std::move(targets)); !set) return set;
    source.serial = next_serial();  // to go back, the cloth of then is needed
    sources_[place] = std::move(source);
    SceneCloth& document = scene_.cloths[place];
    document.tearing = cloth.tearing, document.tear_room = cloth.tear_room;
    document.resistance.clear();
    return {};
}

Result<void> SceneWorld::set_pins(ClothId id, std::vector<PinDesc> pins) {
    const std::size_t place = place_of(id);
    auto pinned = select_pins_now(*world_, id, sources_[place], pins);
    if (!pinned) return pinned.errors();
    auto done = target_at_once(place, *pinned);
    if (!done) return done.errors();
    if (*done) {
        scene_.cloths[place].pins = std::move(pins);
        return {};
    }
    SceneCloth cloth = without_meshes(scene_.cloths[place]);
    cloth.pins = std::move(pins);
    std::vector<std::uint32_t> particles = pinned->pins.particles;
    return change_cloth(id, std::move(cloth), std::move(pinned->pins), std::move(pinned->targets),
                        std::move(particles));
}

Result<void> SceneWorld::set_weights(ClothId id, std::vector<WeightDesc> weights) {
    const std::size_t place = place_of(id);
    SceneCloth cloth = without_meshes(scene_.cloths[place]);
    cloth.weights = std::move(weights);
    return change_cloth(id, std::move(cloth), sources_[place].pins, world_->kinematic_targets(id), world_->pinned(id));
}

Result<void> SceneWorld::set_resistance(ClothId id, std::vector<ResistanceDesc> resistance) {
    const std::size_t place = place_of(id);
    SceneCloth cloth = without_meshes(scene_.cloths[place]);
    cloth.resistance = std::move(resistance);
    return change_resistance(place, cloth, "");
}

// Changes the pins without a new model. Returns false and changes nothing if the model has no room for the springs.
Result<bool> SceneWorld::target_at_once(std::size_t place, const Pinned& pinned) {
    const ClothId id = world_->cloth_id(place);
    const auto& springs = pinned.pins.attachments;
    if (sources_[place].pins.attachments.empty() && springs.empty()) {
        if (auto set = world_->set_pins(id, pinned.pins.particles, pinned.targets); !set) return set.errors();
    } else {
        auto set = world_->set_pins(id, pinned.pins.particles, pinned.targets, springs);
        if (!set || !*set) return set;
    }
    sources_[place].pins = pinned.pins;
    // Coarse levels and tethers depend on the pins, and a pending model was built for the old pins.
    const auto& now = world_->model(id);
    if (!now->hierarchy.empty() || now->table(ConstraintKind::tether).rows > 0 ||
        scene_.cloths[place].tethers == Tethers::on || world_->is_rebuilding(id))
        rebuild_later(place);
    return true;
}

// Builds the model of the document in the background, because coarse levels and tethers take long to build.
void SceneWorld::rebuild_later(std::size_t place) {
    const ClothId id = world_->cloth_id(place);
    const auto now = world_->model(id);
    const ClothSource& all = sources_[place];
    world_->rebuild_later(id, [now, source = ClothSource{all.simulated, all.topology, all.numbers, all.pins, {}},
                               cloth = without_meshes(scene_.cloths[place]), layout = world_->settings().layout()] {
        return rebuild_cloth(*now, source, cloth, source.pins, layout);
    });
}

void SceneWorld::move(ColliderId id, Vec3 position, Vec3 rotation_degrees) {
    world_->move(id, {rotation_from_degrees(rotation_degrees), position});
    ColliderDesc& collider = scene_.colliders[place_of(id)];
    collider.transform.position = position;
    collider.transform.rotation_degrees = rotation_degrees;
    collider.motion.clear();
}

void SceneWorld::set_friction(ColliderId id, std::array<float, 2> friction) {
    world_->set_friction(id, friction);
    scene_.colliders[place_of(id)].friction = friction;
}

void SceneWorld::set_gravity(Vec3 gravity) {
    scene_.gravity = gravity;
    world_->configure(settings_of(scene_, scene_.solver, world_->settings()));
}

void SceneWorld::set_air(const std::optional<AirDesc>& air) {
    scene_.air = air;
    world_->configure(settings_of(scene_, scene_.solver, world_->settings()));
}

void SceneWorld::set_contact_forces(bool on) {
    WorldSettings settings = world_->settings();
    if (std::exchange(settings.contact_forces, on) != on) world_->configure(std::move(settings));
}

void SceneWorld::set_contact_marks(bool on) {
    WorldSettings settings = world_->settings();
    if (std::exchange(settings.contact_marks, on) != on) world_->configure(std::move(settings));
}

Result<void> SceneWorld::set_solver(const SolverDesc& solver) {
    const WorldSettings settings = settings_of(scene_, solver, world_->settings());
    if (const ClothLayout layout = settings.layout(); layout != world_->settings().layout()) {
        std::vector<Change> changes;
        for (std::size_t i = 0; i < sources_.size(); ++i) {
            const ClothId id = world_->cloth_id(i);
            auto model = rebuild_cloth(*world_->model(id), sources_[i], scene_.cloths[i], sources_[i].pins, layout);
            if (!model) return model.errors();
            changes.push_back({id, std::move(*model), world_->kinematic_targets(id), world_->pinned(id)});
        }
        if (auto set = set_models(changes); !set) return set;
    }
    world_->configure(settings);
    scene_.solver = solver;
    return {};
}

}  // namespace weft
