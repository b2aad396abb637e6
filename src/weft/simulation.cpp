#include "weft/simulation_impl.h"

#include "scene/check.h"
#include "scene/scene_keys.h"
#include "solver/measures/statistics.h"
#include "weft/simulation_access.h"

#include <weft/weft.h>

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

SceneCloth resolved(const ClothDesc& desc, const Fabric& fabric) {
    return {.name = desc.name,
            .mesh = desc.mesh,
            .render_mesh = desc.render_mesh,
            .transform = desc.transform,
            .velocity = desc.velocity,
            .fabric = fabric,
            .fabric_name = desc.fabric.preset,
            .pins = desc.pins,
            .cuts = desc.cuts,
            .seams = desc.seams,
            .resistance = desc.resistance,
            .weights = desc.weights,
            .tethers = desc.tethers,
            .tether_slack = desc.tether_slack,
            .self_collision = desc.self_collision,
            .tearing = desc.tearing,
            .tear_room = desc.tear_room,
            .collision_group = desc.collision_group,
            .collision_mask = desc.collision_mask,
            .layer = desc.layer};
}

template <class Named>
std::vector<std::string_view> names_of(const std::vector<Named>& all) {
    std::vector<std::string_view> names;
    for (const Named& one : all) names.push_back(one.name);
    return names;
}

// Returns the wanted name, with a problem if it is taken, or a free name if none is wanted.
std::string own_name(const std::string& wanted, const std::string& kind, std::span<const std::string_view> taken,
                     Problems& problems) {
    const auto is_taken = [&](std::string_view name) { return std::ranges::find(taken, name) != taken.end(); };
    if (!wanted.empty()) {
        if (is_taken(wanted)) problems.add("/name", "is taken: another is called " + in_quotes(wanted));
        return wanted;
    }
    for (std::size_t number = taken.size();; ++number)
        if (std::string name = kind + ' ' + std::to_string(number); !is_taken(name)) return name;
}

Surface view(const DrawnSurface& surface) {
    return {surface.name, surface.positions, surface.normals, surface.uvs, surface.triangles};
}

std::size_t place_of(const World& world, ClothId id) {
    std::size_t place = 0;
    while (place < world.cloth_count() && world.cloth_id(place) != id) ++place;
    return place;
}

}  // namespace

const char* version() {
    return WEFT_VERSION;
}

Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<Simulation> SimulationAccess::create(SceneDesc scene, const Options& options,
                                            const std::filesystem::path& folder, const MakeBackend& make) {
    auto made = SceneWorld::create(std::move(scene), options, folder, make);
    if (!made) return made.errors();
    return Simulation(std::unique_ptr<Simulation::Impl>(new Simulation::Impl{std::move(*made)}));
}

const SceneDesc& SimulationAccess::scene(const Simulation& simulation) {
    return simulation.impl_->scene.scene();
}

const std::filesystem::path& SimulationAccess::folder(const Simulation& simulation) {
    return simulation.impl_->scene.folder();
}

std::span<const DrawnSurface> SimulationAccess::surfaces(const Simulation& simulation) {
    return simulation.impl_->surfaces();
}

std::span<const DrawnSolid> SimulationAccess::solids(const Simulation& simulation, bool colliders) {
    const Simulation::Impl& impl = *simulation.impl_;
    impl.drawn_solids = DrawnSolids(colliders ? SolidChoice::colliders : SolidChoice::bodies);
    impl.drawn_solids.update(impl.world(), impl.scene.scene().colliders);
    return impl.drawn_solids.solids();
}

World& SimulationAccess::world(Simulation& simulation) {
    return simulation.impl_->world();
}

const World& SimulationAccess::world(const Simulation& simulation) {
    return simulation.impl_->world();
}

Result<SceneDesc> empty_scene(const WorldDesc& world) {
    SceneDesc scene;
    scene.gravity = world.gravity;
    scene.frame_rate = world.frame_rate;
    scene.solver = world.solver;
    scene.air = world.air;
    const auto sound = checked([&](Problems& problems) { check_parts(scene, problems); });
    if (!sound) return sound.errors();
    return scene;
}

Result<Simulation> Simulation::create(const WorldDesc& world, const Options& options) {
    auto scene = empty_scene(world);
    if (!scene) return scene.errors();
    return SimulationAccess::create(std::move(*scene), options, {});
}

void Simulation::step() {
    impl_->scene.advance();
    impl_->changed();
}

Result<void> Simulation::step(double dt) {
    if (!(dt > 0 && dt <= 1000)) return Error{"dt", "must be > 0 s and ≤ 1000 s, got " + number_text(dt)};
    impl_->scene.advance(dt);
    impl_->changed();
    return {};
}

std::uint64_t Simulation::frame() const {
    return impl_->world().index();
}
double Simulation::time() const {
    return impl_->world().time();
}

Result<ClothId> Simulation::add(const ClothDesc& desc) {
    Problems problems;
    const auto taken = names_of(impl_->scene.scene().cloths);
    const std::string name = own_name(desc.name, "cloth", taken, problems);
    auto fabric = make_fabric(desc.fabric);
    SceneCloth cloth = resolved(desc, fabric ? *fabric : Fabric{});
    cloth.name = name;
    check_cloth(cloth, "", problems);
    check_attachments(cloth.pins, names_of(impl_->scene.scene().colliders), "/pins", problems);
    if (!fabric)
        for (const Error& error : fabric.errors()) problems.add(error.where, error.what);
    if (!problems.none()) return std::move(problems).take();
    auto id = impl_->scene.add(std::move(cloth));
    if (id) impl_->changed();
    return id;
}

Result<ColliderId> Simulation::add(const ColliderDesc& desc) {
    Problems problems;
    ColliderDesc collider = desc;
    const auto taken = names_of(impl_->scene.scene().colliders);
    collider.name = own_name(desc.name, "collider", taken, problems);
    check_collider(collider, "", problems);
    if (!problems.none()) return std::move(problems).take();
    return impl_->scene.add(std::move(collider));
}

Result<StitchId> Simulation::add(const StitchDesc& desc) {
    Problems problems;
    StitchDesc stitches = desc;
    const SceneDesc& scene = impl_->scene.scene();
    stitches.name = own_name(desc.name, "stitches", names_of(scene.stitches), problems);
    check_stitches(stitches, names_of(scene.cloths), "", problems);
    if (!problems.none()) return std::move(problems).take();
    return impl_->scene.add(std::move(stitches));
}

Result<void> Simulation::remove(StitchId id) {
    if (!impl_->world().contains(id)) return no_such("row of stitches");
    impl_->scene.remove(id);
    return {};
}

std::vector<StitchId> Simulation::stitches() const {
    const auto ids = impl_->scene.stitches();
    return {ids.begin(), ids.end()};
}

Result<void> Simulation::remove(ClothId id) {
    if (!impl_->world().contains(id)) return no_such("cloth");
    impl_->scene.remove(id);
    impl_->changed();
    return {};
}

Result<void> Simulation::remove(ColliderId id) {
    if (!impl_->world().contains(id)) return no_such("collider");
    impl_->scene.remove(id);
    return {};
}

std::vector<ClothId> Simulation::cloths() const {
    std::vector<ClothId> ids;
    const World& world = impl_->world();
    for (std::size_t i = 0; i < world.cloth_count(); ++i) ids.push_back(world.cloth_id(i));
    return ids;
}

std::vector<ColliderId> Simulation::colliders() const {
    std::vector<ColliderId> ids;
    const World& world = impl_->world();
    for (std::size_t i = 0; i < world.colliders().size(); ++i) ids.push_back(world.collider_id(i));
    return ids;
}

ClothId Simulation::find_cloth(std::string_view name) const {
    const World& world = impl_->world();
    for (std::size_t i = 0; i < world.cloth_count(); ++i)
        if (const ClothId id = world.cloth_id(i); world.model(id)->name == name) return id;
    return {};
}

ColliderId Simulation::find_collider(std::string_view name) const {
    return weft::find_collider(impl_->world(), name);
}

Result<void> Simulation::set_fabric(ClothId id, const FabricDesc& desc) {
    if (!impl_->world().contains(id)) return no_such("cloth");
    const auto fabric = make_fabric(desc);
    if (!fabric) return fabric.errors();
    auto done = impl_->scene.set_fabric(id, *fabric, desc.preset);
    impl_->changed();
    return done;
}

Result<void> Simulation::set_pins(ClothId id, std::vector<PinDesc> pins) {
    if (!impl_->world().contains(id)) return no_such("cloth");
    const auto sound = checked([&](Problems& problems) {
        check_pins(pins, MeshFileDesc(), "/pins", problems);
        check_attachments(pins, names_of(impl_->scene.scene().colliders), "/pins", problems);
    });
    if (!sound) return sound;
    auto done = impl_->scene.set_pins(id, std::move(pins));
    impl_->changed();
    return done;
}

Result<void> Simulation::set_weights(ClothId id, std::vector<WeightDesc> weights) {
    if (!impl_->world().contains(id)) return no_such("cloth");
    const auto sound =
        checked([&](Problems& problems) { check_weights(weights, MeshFileDesc(), "/weights", problems); });
    if (!sound) return sound;
    auto done = impl_->scene.set_weights(id, std::move(weights));
    impl_->changed();
    return done;
}

Result<void> Simulation::set_resistance(ClothId id, std::vector<ResistanceDesc> resistance) {
    if (!impl_->world().contains(id)) return no_such("cloth");
    const Tearing tearing = impl_->scene.scene().cloths[place_of(impl_->world(), id)].tearing;
    const auto sound = checked([&](Problems& problems) {
        check_resistance(resistance, MeshFileDesc(), "/resistance", problems);
        if (tearing != Tearing::split && tearing != Tearing::erode)
            problems.add("/resistance", "needs a cloth with the tearing `split` or `erode`");
    });
    if (!sound) return sound;
    auto done = impl_->scene.set_resistance(id, std::move(resistance));
    impl_->changed();
    return done;
}

Result<void> Simulation::cut(ClothId id, const CutDesc& cut, CutPositions positions) {
    if (!impl_->world().contains(id)) return no_such("cloth");
    CutDesc now = cut;
    now.time = 0;
    const auto sound = checked([&](Problems& problems) { check_cut(now, "", problems); });
    if (!sound) return sound;
    auto done = impl_->scene.cut(id, now, positions);
    impl_->changed();
    return done;
}

Result<GrabId> Simulation::grab(ClothId id, const MeshPoint& point, Vec3 to, const GrabDesc& grab) {
    if (!impl_->world().contains(id)) return no_such("cloth");
    const auto sound = checked([&](Problems& problems) {
        check_mesh_point(point, "", problems);
        check_values(grab_target_keys, &to, "", problems);
        check_values(grab_keys, &grab, "", problems);
    });
    if (!sound) return sound.errors();
    return impl_->scene.grab(id, point, to, grab);
}

Result<void> Simulation::move_grab(GrabId id, Vec3 to) {
    if (!impl_->world().knows(id)) return no_such("grab");
    const auto sound = checked([&](Problems& problems) { check_values(grab_target_keys, &to, "", problems); });
    if (!sound) return sound;
    impl_->world().move_grab(id, to);
    return {};
}

Result<void> Simulation::release(GrabId id) {
    if (!impl_->world().contains(id)) return no_such("grab");
    impl_->world().release(id);
    return {};
}

std::vector<GrabId> Simulation::grabs() const {
    std::vector<GrabId> ids;
    for (const Grab& grab : impl_->world().grabs()) ids.push_back(grab.id);
    return ids;
}

Vec3 Simulation::grab_force(GrabId id) const {
    return impl_->world().contains(id) ? impl_->world().grab_force(id) : Vec3{};
}

Vec3 Simulation::grab_position(GrabId id) const {
    return impl_->world().contains(id) ? impl_->world().grab_position(id) : Vec3{};
}

Result<void> Simulation::move(ColliderId id, Vec3 position, Vec3 rotation_degrees) {
    if (!impl_->world().contains(id)) return no_such("collider");
    const TransformDesc transform{.position = position, .rotation_degrees = rotation_degrees};
    const auto sound = checked([&](Problems& problems) { check_values(pose_keys, &transform, "", problems); });
    if (!sound) return sound;
    impl_->scene.move(id, position, rotation_degrees);
    return {};
}

Result<void> Simulation::set_friction(ColliderId id, float static_friction, float kinetic_friction) {
    if (!impl_->world().contains(id)) return no_such("collider");
    ColliderDesc desc;
    desc.friction = {static_friction, kinetic_friction};
    const auto sound = checked([&](Problems& problems) { check_values(collider_keys, &desc, "", problems); });
    if (!sound) return sound;
    impl_->scene.set_friction(id, desc.friction);
    return {};
}

Result<void> Simulation::set_gravity(Vec3 gravity) {
    SceneDesc scene;
    scene.gravity = gravity;
    const auto sound = checked([&](Problems& problems) { check_values(scene_keys, &scene, "", problems); });
    if (!sound) return sound;
    impl_->scene.set_gravity(gravity);
    return {};
}

Result<void> Simulation::set_solver(const SolverDesc& solver) {
    const auto sound = checked([&](Problems& problems) { check_solver(solver, "", problems); });
    if (!sound) return sound;
    auto done = impl_->scene.set_solver(solver);
    impl_->changed();
    return done;
}

Result<void> Simulation::set_air(const std::optional<AirDesc>& air) {
    const auto sound = checked([&](Problems& problems) {
        if (air) check_air(*air, "", problems);
    });
    if (!sound) return sound;
    impl_->scene.set_air(air);
    return {};
}

std::size_t Simulation::cloth_count() const {
    return impl_->world().cloth_count();
}

Surface Simulation::cloth(std::size_t index) const {
    return index < cloth_count() ? view(impl_->surfaces()[index]) : Surface{};
}

Surface Simulation::surface(ClothId id) const {
    return cloth(place_of(impl_->world(), id));
}

std::span<const Vec4> Simulation::tangents(ClothId id) const {
    const std::size_t place = place_of(impl_->world(), id);
    if (place >= cloth_count()) return {};
    return impl_->world().frame().cloths[place].tangents();
}

Measures Simulation::measure() const {
    const World& world = impl_->world();
    const ClothMeasures measures = world.measure();
    // The only measure that needs positions on the host.
    const double penetration =
        world.colliders().empty() ? 0 : impl_->penetration.measure(world.frame(), world.colliders()).max;
    return {.mean_stretch = measures.strain.stretch.mean,
            .max_stretch = measures.strain.stretch.max,
            .mean_shear = measures.strain.shear.mean,
            .max_shear = measures.strain.shear.max,
            .mean_residual = measures.residual.mean,
            .max_residual = measures.residual.max,
            .kinetic_energy = measures.kinetic_energy,
            .max_speed = measures.max_speed,
            .max_penetration = penetration};
}

const ContactForces& Simulation::contact_forces() const {
    return impl_->world().contact_forces();
}

std::vector<std::string_view> Simulation::reports() const {
    return report_names(impl_->world().summary().reports);
}
std::string Simulation::state_hash() const {
    return impl_->world().state_hash();
}

std::vector<std::byte> Simulation::save_state() const {
    return to_bytes(impl_->world().save());
}

Result<void> Simulation::restore_state(std::span<const std::byte> state) {
    auto snapshot = snapshot_from_bytes(state);
    if (!snapshot) return snapshot.errors();
    auto done = impl_->world().restore(*snapshot);
    if (done) impl_->changed();
    return done;
}

}  // namespace weft
