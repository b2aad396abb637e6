// Copies of a world's frame are drawn as the world was, whatever has happened to it since. A view shows every change of
// its scene.

#include "scenes.h"

#include "collide/distance_field.h"
#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "solver/model/cuts.h"
#include "view/framing.h"
#include "view/overlays.h"
#include "view/world_frame.h"
#include "weft/backends.h"
#include "weft/drawing_device.h"

#include <cstdlib>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

namespace weft {
namespace {

constexpr double frame_seconds = 1.0 / 60;
constexpr Camera camera{.position = {0.8f, 0.7f, 2.2f}, .target = {0, 0.1f, 0}, .fov = 40};

std::shared_ptr<const ClothModel> sheet_that_opens(const std::string& name, Vec3 at, float size = 1,
                                                   SelfCollision contact = SelfCollision::off) {
    TriangleMesh mesh = make_grid({size, size}, {13, 13}, GridDiagonal::uniform);
    for (Vec3& p : mesh.positions) p += at;
    auto topology = build_topology(mesh, {.reorder = false});
    ClothModelDesc desc{.name = name, .reserve = {.particles = 40, .openings = true}};
    desc.pins.particles = {0, 12};
    for (const std::uint32_t p : {topology->vertex_to_particle[156], topology->vertex_to_particle[168]})
        desc.pins.attachments.push_back({p, 1e-3f, mesh.positions[p] + Vec3{0, 0.05f, 0}});
    desc.collision = {contact, {}, 0};
    desc.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

std::shared_ptr<const ShapeData> star_shape() {
    const TriangleMesh mesh = make_sphere(0.2f, 3);
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = 16, .threads = 1});
    EXPECT_TRUE(field.ok());
    field->data.surface = mesh;
    return std::make_shared<const ShapeData>(std::move(field->data));
}

/// A world in which every overlay has something to show: two cloths, one of them slit and pinned to a collider, wind,
/// contacts with colliders and between cloths, and a mesh with a distance field. Only the CPU has contact between the
/// cloths.
struct Busy {
    explicit Busy(const std::string& backend) : world(backend_of(backend), settings()) {
        const ColliderId bar = world.add(make_collider(
            {.name = "bar", .shape = BoxDesc{{0.5f, 0.02f, 0.02f}}, .transform = {.position = {0, 0.3f, -0.5f}}}));
        ball = world.add(make_collider({.name = "ball", .shape = SolidMeshDesc{}}, star_shape()));
        const SelfCollision contact = backend == "cpu" ? SelfCollision::exact : SelfCollision::off;
        const auto model = sheet_that_opens("sheet", {0, 0.22f, 0}, 1, contact);
        KinematicTargets targets{.motions = {{.collider = bar}}, .particles = {}};
        targets.particles.push_back({0, 0, model->rest_position(0) - Vec3{0, 0.3f, -0.5f}});
        sheet = world.add(model, targets);
        patch = world.add(sheet_that_opens("patch", {0.1f, 0.26f, 0.1f}, 0.5f, contact));
        EXPECT_TRUE(world.edit(sheet, {.openings = openings_along_plane(*model, model->start, {}, {1, 0, 0})}).ok());
        world.move(bar, {{}, {0, 0.35f, -0.5f}});
        for (int i = 0; i < 12; ++i) world.step(frame_seconds);
    }

    static std::unique_ptr<Backend> backend_of(const std::string& name) {
        Options options;
        options.backend = name;
        auto made = make_backend(options);
        EXPECT_TRUE(made.ok()) << made.error().message();
        return std::move(*made);
    }
    static WorldSettings settings() {
        WorldSettings settings{.solver = {.substeps = 8}, .contact_forces = true, .contact_marks = true};
        settings.air = AirDesc{};
        settings.air->wind.push_back({.velocity = {2, 0, -1}});
        return settings;
    }

    World world;
    ClothId sheet, patch;
    ColliderId ball;
};

class WorldFrameTest : public gpu::OnDevice {
  protected:
    void SetUp() override {
        OnDevice::SetUp();
        if (!HasFatalFailure()) open();
    }

    SceneView new_view(const SceneDesc& scene, const WorldFrame& world, std::vector<std::string> overlays = {},
                       const ViewSources& sources = {}) {
        auto view = SceneView::create(
            device, scene, world, {.width = 120, .height = 90, .samples = 1, .overlays = std::move(overlays)}, sources);
        EXPECT_TRUE(view.ok()) << view.error().message();
        return std::move(*view);
    }
    static std::vector<std::uint8_t> picture(SceneView& view, const SceneDesc& scene, const WorldFrame& world) {
        auto image = view.picture(scene, world, camera);
        EXPECT_TRUE(image.ok()) << image.error().message();
        return image ? std::move(image->rgba) : std::vector<std::uint8_t>{};
    }
};

// Labels: no-asan long
TEST_F(WorldFrameTest, is_drawn_as_the_world_was_with_every_overlay) {
    for (const std::string backend : {"cpu", "vulkan"}) {
        Busy busy(backend);
        World& world = busy.world;
        const SceneDesc scene;
        SceneView view = new_view(scene, LiveWorldFrame(world));
        std::vector<std::vector<const Overlay*>> choices{{}};
        for (const Overlay& overlay : overlays()) choices.push_back({&overlay});
        const auto pictures = [&](SceneView& by, const WorldFrame& of) {
            std::vector<std::vector<std::uint8_t>> all;
            for (const auto& choice : choices) {
                by.set_overlays(choice);
                all.push_back(picture(by, scene, of));
            }
            return all;
        };
        const auto live = pictures(view, LiveWorldFrame(world));
        for (std::size_t i = 1; i < live.size(); ++i)
            EXPECT_NE(live[i], live[0]) << choices[i][0]->name << " shows nothing";
        WorldFrameCopies copies;
        auto copy = copies.copy(world);
        const Subject subject = subject_of(world);
        const auto expect_the_same = [&](const std::string& when, bool new_one = false) {
            std::optional<SceneView> fresh;
            if (new_one) fresh.emplace(new_view(scene, *copy));
            const auto now = pictures(new_one ? *fresh : view, *copy);
            for (std::size_t i = 0; i < now.size(); ++i)
                EXPECT_EQ(now[i], live[i]) << backend << ": " << (i ? choices[i][0]->name : "plain") << ", " << when;
            EXPECT_EQ(subject_of(*copy).all.center, subject.all.center);
            EXPECT_EQ(subject_of(*copy).all.radius, subject.all.radius);
        };
        expect_the_same("at once");
        for (int i = 0; i < 3; ++i) world.step(frame_seconds);
        expect_the_same("after steps");
        view.set_overlays({});
        EXPECT_NE(picture(view, scene, LiveWorldFrame(world)), live[0]) << "nothing has moved";
        const auto& model = world.model(busy.patch);
        ASSERT_TRUE(
            world.edit(busy.patch, {.openings = openings_along_plane(*model, model->start, {0.1f, 0, 0}, {1, 0, 0})})
                .ok());
        world.configure({.solver = {.substeps = 4}});
        world.step(frame_seconds);
        world.remove(busy.sheet);
        world.remove(busy.ball);
        world.add(sheet_that_opens("sheet", {0.5f, 0.5f, 0}));
        world.step(frame_seconds);
        expect_the_same("after a tear, and without a cloth and a collider");
        { const World gone = std::move(world); }
        expect_the_same("without the world", true);
    }
}

// With surfaces on the device, a copy must not be drawn with those of the world, which has moved on.
// Labels: no-asan long
TEST_F(WorldFrameTest, is_not_drawn_with_surfaces_of_the_world) {
    Busy busy("vulkan");
    auto drawing = drawing_device(busy.world, "");
    ASSERT_TRUE(drawing.ok());
    device = *drawing;
    const SceneDesc scene;
    const ViewSources sources{.surface = surfaces_on_device(busy.world), .read_picture = {}, .read_light = {}};
    SceneView view = new_view(scene, LiveWorldFrame(busy.world), {}, sources);
    WorldFrameCopies copies;
    const auto copy = copies.copy(busy.world);
    const auto before = picture(view, scene, *copy);
    for (int i = 0; i < 5; ++i) busy.world.step(frame_seconds);
    EXPECT_NE(picture(view, scene, LiveWorldFrame(busy.world)), before);
    EXPECT_EQ(picture(view, scene, *copy), before);
}

// Labels: no-asan
TEST_F(WorldFrameTest, reuse_the_memory_of_released_copies) {
    Busy busy("cpu");
    WorldFrameCopies copies;
    auto first = copies.copy(busy.world);
    const Vec4* const positions = first->frame().cloths[0].positions.data();
    auto second = copies.copy(busy.world);
    EXPECT_NE(second->frame().cloths[0].positions.data(), positions) << "in use";
    first.reset();
    auto third = copies.copy(busy.world);
    EXPECT_EQ(third->frame().cloths[0].positions.data(), positions);
    // A copy keeps its models alive, and the memory of released copies keeps none.
    const std::weak_ptr<const ClothModel> model = busy.world.model(busy.patch);
    { const World gone = std::move(busy.world); }
    EXPECT_FALSE(model.expired());
    second.reset();
    third.reset();
    EXPECT_TRUE(model.expired());
}

// Labels: no-asan
TEST_F(WorldFrameTest, can_be_read_by_several_threads) {
    Busy busy("cpu");
    WorldFrameCopies copies;
    for (int round = 0; round < 20; ++round) {
        const auto copy = copies.copy(busy.world);
        std::vector<const Vec3*> meshes(4);
        std::vector<std::size_t> tangents(4);
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            threads.emplace_back([&, i] {
                tangents[i] = copy->frame().cloths[0].tangents().size();
                meshes[i] = copy->frame().cloths[0].render_mesh().positions.data();
            });
        }
        for (std::thread& thread : threads) thread.join();
        for (std::size_t i = 1; i < meshes.size(); ++i) {
            EXPECT_EQ(meshes[i], meshes[0]);
            EXPECT_EQ(tangents[i], copy->frame().cloths[0].render_mesh().positions.size());
        }
        busy.world.step(frame_seconds);
    }
}

/// A scene and its world, drawn with one view that sees every change.
class ChangingSceneTest : public WorldFrameTest {
  protected:
    void SetUp() override {
        WorldFrameTest::SetUp();
        scene.cloths.push_back({.name = "sheet"});
        for (const char* name : {"ball", "box"}) {
            SceneCollider collider;
            collider.name = name;
            scene.colliders.push_back(collider);
        }
        sheet = world.add(sheet_that_opens("sheet", {0, 0.3f, 0}));
        ball = world.add(make_collider({.name = "ball", .shape = SphereDesc{0.2f}}));
    }
    void TearDown() override {
        view.reset();
        WorldFrameTest::TearDown();
    }

    /// The view draws what a new view draws, and not what it drew before.
    void expect_shown(const std::string& what) {
        if (!view) view.emplace(new_view(scene, LiveWorldFrame(world), {"wireframe"}));
        const auto now = picture(*view, scene, LiveWorldFrame(world));
        SceneView fresh = new_view(scene, LiveWorldFrame(world), {"wireframe"});
        EXPECT_EQ(now, picture(fresh, scene, LiveWorldFrame(world))) << what;
        EXPECT_NE(now, before) << what;
        before = now;
        EXPECT_EQ(picture(*view, scene, LiveWorldFrame(world)), before) << what << ", again";
    }

    SceneDesc scene;
    World world{std::move(*make_cpu_backend()), {}};
    ClothId sheet;
    ColliderId ball;
    std::optional<SceneView> view;
    std::vector<std::uint8_t> before;
};

// Labels: no-asan long
TEST_F(ChangingSceneTest, shows_materials) {
    expect_shown("default");
    SceneMaterial material;
    material.values = find_material("cotton")->material;
    material.values.color = {1, 0, 0};
    scene.cloths[0].material = material;
    expect_shown("color");
    scene.cloths[0].material->values.color = {0, 1, 0};
    expect_shown("other color");
    scene.cloths[0].material->values.coverage = 0.5f;
    expect_shown("sheer");
    scene.cloths[0].material->values.weave = Weave::knit;
    scene.cloths[0].material->values.thread_spacing = 30;
    expect_shown("weave");
    scene.cloths[0].material->values.color_map = "nowhere.png";
    expect_shown("map");
    EXPECT_EQ(view->notes().size(), 1u);
    scene.colliders[0].material = scene.cloths[0].material;
    expect_shown("the same material for another object");
    scene.cloths[0].material->values.color = {0, 0, 1};
    expect_shown("one of two that were equal");
    scene.cloths[0].material.reset();
    scene.colliders[0].material.reset();
    expect_shown("default again");
    EXPECT_EQ(view->notes().size(), 1u);
    std::swap(scene.colliders[0], scene.colliders[1]);
    scene.colliders[1].material = material;
    expect_shown("objects in another order");
}

// Labels: no-asan long
TEST_F(ChangingSceneTest, shows_lights) {
    expect_shown("default");
    scene.light.sun.intensity = 0;
    expect_shown("no sun");
    scene.light.sky.zenith = {1, 0, 0};
    expect_shown("sky");
    scene.light.exposure = -1;
    expect_shown("exposure");
    scene.light.environment.file = "nowhere.hdr";
    (void)picture(*view, scene, LiveWorldFrame(world));
    EXPECT_EQ(view->notes().size(), 1u) << "there is no such image";
    scene.light.sky.zenith = {0, 0, 1};
    expect_shown("sky in place of the image");
    EXPECT_EQ(view->notes().size(), 1u);
}

// Labels: no-asan long
TEST_F(ChangingSceneTest, shows_another_environment) {
    int reads = 0;
    const ViewSources sources{.surface = {}, .read_picture = {}, .read_light = [&](const std::string& file) {
                                  ++reads;
                                  ImageF image = window_light();
                                  if (file == "dim.hdr")
                                      for (float& value : image.rgba) value *= 0.5f;
                                  return Result<ImageF>(image);
                              }};
    scene.light.sun.intensity = 0;
    SceneView one = new_view(scene, LiveWorldFrame(world), {}, sources);
    const auto expect_as_new = [&](const std::string& what) {
        SceneView fresh = new_view(scene, LiveWorldFrame(world), {}, sources);
        const int before_reads = reads;
        const auto now = picture(one, scene, LiveWorldFrame(world));
        EXPECT_EQ(now, picture(fresh, scene, LiveWorldFrame(world))) << what;
        EXPECT_NE(now, before) << what;
        before = now;
        return reads - before_reads;
    };
    expect_as_new("sky");
    scene.light.environment.file = "window.hdr";
    EXPECT_EQ(expect_as_new("image"), 1);
    scene.light.environment.rotation = 90;
    EXPECT_EQ(expect_as_new("rotation"), 0) << "the image is kept";
    scene.light.environment.intensity = 2;
    EXPECT_EQ(expect_as_new("intensity"), 0);
    scene.light.environment.file = "dim.hdr";
    EXPECT_EQ(expect_as_new("other image"), 1);
    scene.light.environment.file.clear();
    EXPECT_EQ(expect_as_new("sky again"), 0);
}

// Labels: no-asan
TEST_F(ChangingSceneTest, shows_objects) {
    expect_shown("at first");
    world.remove(sheet);
    sheet = world.add(sheet_that_opens("sheet", {0.2f, 0.5f, 0}, 0.6f));
    expect_shown("another cloth with the same name");
    world.add(make_collider({.name = "box", .shape = BoxDesc{}, .transform = {.position = {-0.4f, 0, 0}}}));
    expect_shown("a box more");
    world.remove(ball);
    expect_shown("without the ball");
    ball = world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}}));
    expect_shown("a larger ball");
    world.remove(sheet);
    expect_shown("without cloth");
    // Another world, with other objects under the same ids.
    world = World(std::move(*make_cpu_backend()), {});
    sheet = world.add(sheet_that_opens("sheet", {0, 0.2f, 0}, 0.8f));
    world.add(make_collider({.name = "ball", .shape = BoxDesc{}}));
    expect_shown("another world");
    world = World(std::move(*make_cpu_backend()), {});
    expect_shown("nothing");
}

// A draft has the colors of the image: it leaves out details only.
// Labels: no-asan long
TEST_F(ChangingSceneTest, has_drafts_that_look_alike) {
    const auto mean_difference = [&](const std::vector<std::string>& overlays) {
        std::vector<std::uint8_t> images[2];
        for (const bool draft : {false, true}) {
            auto made = SceneView::create(
                device, scene, world, {.width = 120, .height = 90, .samples = 4, .draft = draft, .overlays = overlays});
            EXPECT_TRUE(made.ok()) << made.error().message();
            images[draft] = picture(*made, scene, LiveWorldFrame(world));
        }
        EXPECT_NE(images[0], images[1]);
        double sum = 0;
        for (std::size_t i = 0; i < images[0].size(); ++i) sum += std::abs(images[0][i] - images[1][i]);
        return sum / static_cast<double>(images[0].size());
    };
    world.add(make_collider({.name = "ground", .shape = PlaneDesc{{0, 1, 0}, -0.3f}}));
    EXPECT_LT(mean_difference({}), 4);
    EXPECT_LT(mean_difference({"strain", "wireframe", "pins"}), 4);
    for (const char* name : {"velvet", "chiffon", "denim"}) {
        SceneMaterial material;
        material.values = find_material(name)->material;
        scene.cloths[0].material = material;
        EXPECT_LT(mean_difference({}), 5) << name;
    }
}

}  // namespace
}  // namespace weft
