#include "view/scene_view.h"

#include "base/copies.h"
#include "mesh/uv_scale.h"
#include "render/host_mesh.h"
#include "render/renderer.h"
#include "scene/materials.h"
#include "solver/world/collider_mesh.h"
#include "view/framing.h"
#include "view/overlay_parts.h"
#include "view/overlays.h"
#include "view/scene_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace weft {
namespace {

struct ClothOnDevice {
    ClothId id;
    std::shared_ptr<const ClothModel> model;
    std::size_t scene_place = 0;  // in the scene's list, if it has not changed since
    std::optional<render::MaterialId> material;
    std::array<float, 2> uv_meters{1, 1};
    std::optional<render::HostMesh> mesh;  // only without a surface on the device, or with overlays
    gpu::Buffer rest;
    std::array<gpu::Buffer, 2> scalars;  // used alternately
    std::uint64_t topology_version = 0;  // of `mesh`
};

/// The surface of a distance field.
struct FieldOnDevice {
    std::shared_ptr<const FieldSurface> field;
    std::optional<render::HostMesh> mesh;  // none for a field without an inside
    gpu::Buffer errors;
};

struct ColliderOnDevice {
    ColliderId id;
    ShapeKind shape{};
    std::array<float, 4> numbers{};
    std::shared_ptr<const ShapeData> data;
    std::size_t scene_place = 0;
    std::optional<render::MaterialId> material;
    std::optional<render::HostMesh> mesh;  // none for a plane
    FieldOnDevice field = {};              // only with an overlay that has shown it

    // Another world may have another shape under the same id.
    bool has_shape_of(const Collider& collider) const {
        return shape == collider.shape && numbers == collider.numbers && data == collider.data;
    }
};

/// m: half the diagonal of the bounds of everything except planes, with cloths at rest. Constant scale for overlays.
float size_of(const WorldFrame& world) {
    Bounds bounds;
    for (std::size_t i = 0; i < world.cloth_count(); ++i) {
        const ClothModel& model = *world.model(i);
        for (std::uint32_t p = 0; p < model.particle_count; ++p) bounds.include(model.rest_position(p));
    }
    for (const Collider& collider : world.colliders()) {
        if (const Bounds solid = bounds_of(collider); !solid.empty()) bounds.include(solid);
    }
    if (bounds.empty()) bounds.include(Bounds{{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}});
    return 0.5f * length(bounds.size());
}

std::array<Vec3, 4> transform_of(const Pose& pose) {
    return {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.position};
}

Result<FieldOnDevice> upload_field(gpu::Device& device, const std::string& name,
                                   const std::shared_ptr<const FieldSurface>& field) {
    FieldOnDevice made{.field = field, .mesh = {}, .errors = {}};
    const TriangleMesh& mesh = field->mesh;
    if (mesh.triangles.empty()) return made;
    auto on_device = render::HostMesh::create(device, static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles,
                                              {}, mesh.positions, "field of " + name);
    if (!on_device) return on_device.errors();
    if (auto moved = on_device->update(mesh.positions, mesh.normals, {}); !moved) return moved.errors();
    made.mesh.emplace(std::move(*on_device));
    auto errors = device.memory().buffer(field->errors.size() * sizeof(float), gpu::MemoryKind::upload,
                                         "errors of the field of " + name);
    if (!errors) return errors.errors();
    std::ranges::copy(field->errors, errors->as<float>().begin());
    made.errors = std::move(*errors);
    return made;
}

/// The material of the object with this name; `matte` if the scene has no such object. `place`: where it was in the
/// list before. Searches only if it is not there any more, because this is called for each object and image.
template <class Object>
const Material& material_called(const std::vector<Object>& objects, const std::string& name, std::size_t& place) {
    if (place >= objects.size() || objects[place].name != name) {
        const auto found = std::ranges::find(objects, name, &Object::name);
        if (found == objects.end()) return find_material("matte")->material;
        place = static_cast<std::size_t>(found - objects.begin());
    }
    return material_of(objects[place]);
}

/// The element with this id, which is usually the one at `place`.
template <class List, class Id>
auto find_at(List& list, Id id, std::size_t place) {
    if (place < list.size() && list[place].id == id) return list.begin() + static_cast<std::ptrdiff_t>(place);
    return std::ranges::find(list, id, [](const auto& one) { return one.id; });
}

/// Whether Renderer::surround() would give the same. `with_file`: the image of the environment is used.
bool same_surroundings(const Lighting& a, const Lighting& b, bool with_file) {
    const Environment &one = a.environment, &other = b.environment;
    if (one.file != other.file) return false;
    return with_file ? one.rotation == other.rotation && one.intensity == other.intensity : a.sky == b.sky;
}

}  // namespace

struct SceneView::Impl {
    ViewOptions options;
    ViewSources sources;
    render::Renderer renderer;
    SceneMaterials materials;
    float size = 1;      // m
    bool sized = false;  // `size` is that of the objects of the last image
    std::vector<const Overlay*> overlays;
    std::vector<std::string> notes;
    std::vector<ClothOnDevice> cloths;
    std::vector<ColliderOnDevice> colliders;
    std::uint32_t turn = 0;

    std::optional<Lighting> surrounded;  // by which light the renderer is surrounded
    ImageF environment;                  // of the file that `surrounded` names; empty if it cannot be read

    std::array<std::uint64_t, 2> frames{};  // timeline values of the last two frames, older one first

    // Data of the current image.
    std::uint32_t width = 1, height = 1;
    std::vector<render::Object> objects;
    std::vector<render::Ground> grounds;
    OverlayOutput shown;
    std::vector<std::string> hidden;  // names
    std::shared_ptr<const ClothPaint> paint;
    FieldSurfaces fields;

    Impl(ViewOptions o, ViewSources from, render::Renderer r)
        : options(std::move(o)), sources(std::move(from)), renderer(std::move(r)), materials(sources.read_picture) {}

    Result<void> open(const SceneDesc& scene, const WorldFrame& world);
    Result<void> surround(const Lighting& light);
    bool has_other_objects(const WorldFrame& world) const;
    Result<ClothOnDevice*> cloth(const SceneDesc& scene, const WorldFrame& world, std::size_t place);
    Result<ColliderOnDevice*> collider(const SceneDesc& scene, const WorldFrame& world, std::size_t place);
    template <class Object>
    Result<void> store(std::vector<Object>& list, typename std::vector<Object>::iterator& at, Object made);
    Result<void> drop_what_left(const WorldFrame& world);
    Result<void> bring(const SceneDesc& scene, const WorldFrame& world);
    Result<void> add_cloth(const SceneDesc& scene, const WorldFrame& world, std::size_t place, const Frame* frame);
    Result<void> add_collider(const SceneDesc& scene, const WorldFrame& world, std::size_t place,
                              const ColliderScalars* scalars);
    Result<void> add_field(ColliderOnDevice& collider, const ColliderScalars& scalars, const Pose& pose);
    Result<void> draw_overlays(const WorldFrame& world, const Frame& frame);
    Result<void> show(const Scalars& scalars, ClothOnDevice& cloth, render::Object& object);
    Result<void> show_paint(const WorldFrame& world);
    Result<gpu::SurfaceBuffers> host_surface(ClothOnDevice& cloth, const ClothFrame& now);
    Result<render::Drawing> draw(const SceneDesc& scene, const WorldFrame& world, const Camera& camera,
                                 std::uint32_t wide, std::uint32_t high);
    gpu::Device& device() { return *renderer.device(); }
};

Result<void> SceneView::Impl::open(const SceneDesc& scene, const WorldFrame& world) {
    for (const std::string& name : options.overlays) {
        const auto overlay = find_overlay(name);
        if (!overlay) return overlay.errors();
        overlays.push_back(*overlay);
    }
    return bring(scene, world);  // reports failed uploads now
}

Result<void> SceneView::Impl::surround(const Lighting& light) {
    if (surrounded && same_surroundings(*surrounded, light, !environment.rgba.empty())) return {};
    const std::string& file = light.environment.file;
    if (!surrounded || surrounded->environment.file != file) {
        environment = {};
        if (!file.empty()) {
            auto read = sources.read_light
                            ? sources.read_light(file)
                            : Result<ImageF>(Error{file, "cannot be read: this program sets no image reader"});
            if (read) {
                environment = std::move(*read);
            } else {
                notes.push_back("light: " + read.error().message() + "; the sky is drawn instead");
            }
        }
    }
    surrounded = light;
    return renderer.surround(light, environment.rgba.empty() ? nullptr : &environment);
}

// --- Device data of the scene's objects

// Whether objects came or went since the last image. A cloth that has torn or got another fabric is the same one.
bool SceneView::Impl::has_other_objects(const WorldFrame& world) const {
    if (cloths.size() != world.cloth_count() || colliders.size() != world.colliders().size()) return true;
    for (std::size_t i = 0; i < cloths.size(); ++i) {
        const auto known = find_at(cloths, world.cloth_id(i), i);
        if (known == cloths.end() || known->model->extent != world.model(i)->extent) return true;
    }
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const auto known = find_at(colliders, world.collider_id(i), i);
        if (known == colliders.end() || !known->has_shape_of(world.colliders()[i])) return true;
    }
    return false;
}

/// Puts an object at its place in the list: in place of the one that it replaces, or behind all others if `at` is the
/// end. So the list has the order of the world. Lets `at` point to it.
template <class Object>
Result<void> SceneView::Impl::store(std::vector<Object>& list, typename std::vector<Object>::iterator& at,
                                    Object made) {
    if (at == list.end()) {
        at = list.insert(at, std::move(made));
        return {};
    }
    if (auto idle = device().wait(device().submitted()); !idle) return idle;
    made.scene_place = at->scene_place;
    made.material = std::exchange(at->material, std::nullopt);
    *at = std::move(made);
    return {};
}

Result<ClothOnDevice*> SceneView::Impl::cloth(const SceneDesc& scene, const WorldFrame& world, std::size_t place) {
    const ClothId id = world.cloth_id(place);
    const std::shared_ptr<const ClothModel>& model = world.model(place);
    auto known = find_at(cloths, id, place);
    if (known == cloths.end() || known->model != model) {
        ClothOnDevice made;
        made.id = id;
        made.model = model;
        made.uv_meters = uv_meters(model->mesh());
        if (model->mesh().uvs.empty()) {
            auto rest = device().memory().buffer(model->mesh().positions.size() * sizeof(Vec3), gpu::MemoryKind::upload,
                                                 "rest of " + model->name);
            if (!rest) return rest.errors();
            std::ranges::copy(model->mesh().positions, rest->as<Vec3>().begin());
            made.rest = std::move(*rest);
        }
        if (auto stored = store(cloths, known, std::move(made)); !stored) return stored.errors();
    }
    const Material& material = material_called(scene.cloths, model->name, known->scene_place);
    if (auto set = materials.set(renderer, known->material, model->name, material, notes); !set) return set.errors();
    return &*known;
}

Result<ColliderOnDevice*> SceneView::Impl::collider(const SceneDesc& scene, const WorldFrame& world,
                                                    std::size_t place) {
    const Collider& collider = world.colliders()[place];
    const ColliderId id = world.collider_id(place);
    auto known = find_at(colliders, id, place);
    if (known == colliders.end() || !known->has_shape_of(collider)) {
        ColliderOnDevice made;
        made.id = id;
        made.shape = collider.shape;
        made.numbers = collider.numbers;
        made.data = collider.data;
        const TriangleMesh mesh = mesh_of(collider);
        if (!mesh.triangles.empty()) {
            auto on_device = render::HostMesh::create(device(), static_cast<std::uint32_t>(mesh.positions.size()),
                                                      mesh.triangles, {}, mesh.positions, collider.name);
            if (!on_device) return on_device.errors();
            if (auto moved = on_device->update(mesh.positions, mesh.normals, {}); !moved) return moved.errors();
            made.mesh.emplace(std::move(*on_device));
        }
        if (auto stored = store(colliders, known, std::move(made)); !stored) return stored.errors();
    }
    const Material& material = material_called(scene.colliders, collider.name, known->scene_place);
    if (auto set = materials.set(renderer, known->material, "collider " + collider.name, material, notes); !set)
        return set.errors();
    return &*known;
}

// Waits first, because frames in flight may use the removed objects. Also frees materials that are no longer used.
Result<void> SceneView::Impl::drop_what_left(const WorldFrame& world) {
    const auto is_gone = [&](const auto& one) { return !world.contains(one.id); };
    if (std::ranges::none_of(cloths, is_gone) && std::ranges::none_of(colliders, is_gone)) return {};
    if (auto idle = device().wait(device().submitted()); !idle) return idle;
    const auto drop_from = [&](auto& list) {
        for (auto& one : list)
            if (is_gone(one)) materials.release(renderer, one.material);
        std::erase_if(list, is_gone);
    };
    drop_from(cloths);
    drop_from(colliders);
    return {};
}

Result<gpu::SurfaceBuffers> SceneView::Impl::host_surface(ClothOnDevice& cloth, const ClothFrame& now) {
    const RenderMesh& mesh = now.render_mesh();
    if (cloth.mesh && cloth.topology_version != now.topology_version) {
        if (auto idle = device().wait(device().submitted()); !idle) return idle.errors();
        cloth.mesh.reset();
    }
    if (!cloth.mesh) {
        auto made = render::HostMesh::create(device(), static_cast<std::uint32_t>(mesh.positions.size()),
                                             mesh.triangles, mesh.uvs, {}, cloth.model->name);
        if (!made) return made.errors();
        cloth.mesh.emplace(std::move(*made));
        cloth.topology_version = now.topology_version;
    }
    if (auto moved = cloth.mesh->update(mesh.positions, mesh.normals, now.tangents()); !moved) return moved.errors();
    gpu::SurfaceBuffers surface = cloth.mesh->surface();
    surface.topology_version = now.topology_version;
    return surface;
}

// --- Drawing of an image

Result<void> SceneView::Impl::add_cloth(const SceneDesc& scene, const WorldFrame& world, std::size_t place,
                                        const Frame* frame) {
    auto found = cloth(scene, world, place);
    if (!found) return found.errors();
    ClothOnDevice& one = **found;
    auto surface =
        sources.surface && world.is_live() ? sources.surface(one.id) : host_surface(one, frame->cloths[place]);
    if (!surface) return surface.errors();
    render::Object object;
    object.surface = *surface;
    object.material = *one.material;
    object.uv_meters[0] = one.uv_meters[0];
    object.uv_meters[1] = one.uv_meters[1];
    if (one.rest) object.rest = render::range_of(one.rest, 0, one.rest.size());
    objects.push_back(object);
    return {};
}

Result<void> SceneView::Impl::add_field(ColliderOnDevice& one, const ColliderScalars& scalars, const Pose& pose) {
    if (one.field.field != scalars.field) {
        if (one.field.field) {
            if (auto idle = device().wait(device().submitted()); !idle) return idle;
        }
        auto made = upload_field(device(), std::to_string(scalars.collider), scalars.field);
        if (!made) return made.errors();
        one.field = std::move(*made);
    }
    if (!one.field.mesh) return {};
    render::Object object;
    object.surface = one.field.mesh->surface();
    object.rest = one.field.mesh->rest();
    object.material = *one.material;
    object.transform = transform_of(pose);
    object.scalars = {render::range_of(one.field.errors, 0, one.field.errors.size()), scalars.least, scalars.most,
                      scalars.scale};
    objects.push_back(object);
    return {};
}

Result<void> SceneView::Impl::add_collider(const SceneDesc& scene, const WorldFrame& world, std::size_t place,
                                           const ColliderScalars* scalars) {
    auto found = collider(scene, world, place);
    if (!found) return found.errors();
    const Collider& described = world.colliders()[place];
    ColliderOnDevice& one = **found;
    const Pose& pose = described.pose;
    if (scalars) return add_field(one, *scalars, pose);
    if (!one.mesh) {
        const Vec3 normal = pose.rotation * Vec3{described.numbers[0], described.numbers[1], described.numbers[2]};
        grounds.push_back({normal, described.numbers[3] + dot(normal, pose.position), *one.material});
        return {};
    }
    render::Object object;
    object.surface = one.mesh->surface();
    object.rest = one.mesh->rest();
    object.material = *one.material;
    object.transform = transform_of(pose);
    objects.push_back(object);
    return {};
}

Result<void> SceneView::Impl::bring(const SceneDesc& scene, const WorldFrame& world) {
    if (auto around = surround(scene.light); !around) return around;
    if (!sized || has_other_objects(world)) size = size_of(world);
    sized = true;
    if (auto dropped = drop_what_left(world); !dropped) return dropped;
    // Without overlays, surfaces on the device need no readback. A model has triangles, so every cloth is an object.
    const bool here = !sources.surface || !world.is_live() || !overlays.empty();
    turn = 1 - turn;
    const Frame* frame = here ? &world.frame() : nullptr;
    objects.clear();
    grounds.clear();
    shown = {};
    const auto is_hidden = [&](const std::string& name) { return std::ranges::find(hidden, name) != hidden.end(); };
    for (std::size_t i = 0; i < world.cloth_count(); ++i)
        if (auto added = add_cloth(scene, world, i, frame); !added) return added;
    if (!overlays.empty()) {
        if (auto drawn = draw_overlays(world, *frame); !drawn) return drawn;
    }
    if (auto painted = show_paint(world); !painted) return painted;
    auto next = shown.colliders.begin();
    for (std::size_t i = 0; i < world.colliders().size(); ++i) {
        const bool colored = next != shown.colliders.end() && next->collider == i;
        const ColliderScalars* scalars = colored ? &*next++ : nullptr;
        if (is_hidden(world.colliders()[i].name)) continue;
        if (auto added = add_collider(scene, world, i, scalars); !added) return added;
    }
    // Only now, because overlays count the cloths.
    for (std::size_t i = world.cloth_count(); i-- > 0;)
        if (is_hidden(world.model(i)->name)) objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(i));
    return {};
}

Result<void> SceneView::Impl::draw_overlays(const WorldFrame& world, const Frame& frame) {
    shown = weft::draw_overlays(overlays, {.world = world,
                                           .frame = frame,
                                           .fields = fields,
                                           .size = size,
                                           .width = width,
                                           .height = height,
                                           .legends = options.legends});
    for (std::size_t i = 0; i < world.cloth_count() && i < shown.scalars.size(); ++i) {
        auto done = show(shown.scalars[i], *find_at(cloths, world.cloth_id(i), i), objects[i]);
        if (!done) return done;
    }
    return {};
}

Result<void> SceneView::Impl::show(const Scalars& scalars, ClothOnDevice& cloth, render::Object& object) {
    gpu::Buffer& buffer = cloth.scalars[turn];
    if (!buffer) {
        auto made = device().memory().buffer(scalars.values.size() * sizeof(float), gpu::MemoryKind::upload,
                                             "overlay of " + cloth.model->name);
        if (!made) return made.errors();
        buffer = std::move(*made);
    }
    std::ranges::copy(scalars.values, buffer.as<float>().begin());
    object.scalars = {render::range_of(buffer, 0, buffer.size()), scalars.least, scalars.most, scalars.scale};
    return {};
}

Result<void> SceneView::Impl::show_paint(const WorldFrame& world) {
    for (std::size_t i = 0; paint && i < world.cloth_count(); ++i) {
        const ClothModel& model = *world.model(i);
        if (model.name != paint->cloth || model.particle_count != paint->values.size() + model.copied_from.size())
            continue;
        std::vector<float> values = paint->values;
        append_copies(values, std::span(model.copied_from.data(), model.copied_from.size()), model.particle_count);
        const Scalars scalars{overlay::at_vertices(model, values), paint->least, paint->most, paint->scale};
        auto done = show(scalars, *find_at(cloths, world.cloth_id(i), i), objects[i]);
        if (!done) return done;
    }
    return {};
}

Result<render::Drawing> SceneView::Impl::draw(const SceneDesc& scene, const WorldFrame& world, const Camera& from,
                                              std::uint32_t wide, std::uint32_t high) {
    width = wide;
    height = high;
    if (auto brought = bring(scene, world); !brought) return brought.errors();
    render::Drawing drawing;
    drawing.camera = from;
    drawing.lighting = scene.light;
    drawing.background = options.transparent ? render::Background::transparent : render::Background::sky;
    drawing.objects = objects;
    drawing.grounds = grounds;
    drawing.lines = shown.lines;
    drawing.lines_on_top = shown.lines_on_top;
    drawing.points = shown.points;
    drawing.flat = shown.flat;
    drawing.two_passes = options.two_passes;
    return drawing;
}

// --- Public functions

SceneView::SceneView(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SceneView::SceneView(SceneView&&) noexcept = default;
SceneView& SceneView::operator=(SceneView&&) noexcept = default;
SceneView::~SceneView() = default;

Result<SceneView> SceneView::create(std::shared_ptr<gpu::Device> device, const SceneDesc& scene,
                                    const WorldFrame& world, const ViewOptions& options, const ViewSources& sources) {
    auto renderer = render::Renderer::create(std::move(device), {.samples = options.samples, .draft = options.draft});
    if (!renderer) return renderer.errors();
    auto impl = std::make_unique<Impl>(options, sources, std::move(*renderer));
    if (auto opened = impl->open(scene, world); !opened) return opened.errors();
    return SceneView(std::move(impl));
}

Camera SceneView::camera(const SceneDesc& scene, const WorldFrame& world) const {
    if (scene.camera) return *scene.camera;
    return framing(subject_of(world).all, impl_->options.aspect());
}

const std::vector<Legend>& SceneView::legends() const {
    return impl_->shown.legends;
}

const std::vector<std::string>& SceneView::notes() const {
    return impl_->notes;
}

void SceneView::set_hidden(std::vector<std::string> names) {
    impl_->hidden = std::move(names);
}

void SceneView::set_paint(std::shared_ptr<const ClothPaint> paint) {
    impl_->paint = std::move(paint);
}

void SceneView::set_overlays(std::vector<const Overlay*> overlays) {
    impl_->overlays = std::move(overlays);
}

Result<Image8> SceneView::picture(const SceneDesc& scene, const WorldFrame& world, const Camera& camera) {
    return picture(scene, world, camera, impl_->options.width, impl_->options.height);
}

Result<Image8> SceneView::picture(const SceneDesc& scene, const WorldFrame& world, const Camera& camera,
                                  std::uint32_t width, std::uint32_t height) {
    const auto drawing = impl_->draw(scene, world, camera, width, height);
    if (!drawing) return drawing.errors();
    return impl_->renderer.picture(*drawing, width, height);
}

Result<std::uint64_t> SceneView::draw(const SceneDesc& scene, const WorldFrame& world, const Camera& camera,
                                      const render::Target& target, gpu::BinarySemaphores window) {
    Impl& self = *impl_;
    // This frame overwrites data that the frame before the last one reads.
    if (auto waited = self.device().wait(self.frames[0]); !waited) return waited.errors();
    const auto drawing = self.draw(scene, world, camera, target.width, target.height);
    if (!drawing) return drawing.errors();
    const auto done = self.renderer.draw(*drawing, target, window);
    if (done) self.frames = {self.frames[1], *done};
    return done;
}

Camera orbited(const Camera& camera, float degrees) {
    const float angle = degrees * std::numbers::pi_v<float> / 180, c = std::cos(angle), s = std::sin(angle);
    const Vec3 d = camera.position - camera.target;
    Camera turned = camera;
    turned.position = camera.target + Vec3{c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    return turned;
}

}  // namespace weft
