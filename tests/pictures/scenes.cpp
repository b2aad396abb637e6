#include "scenes.h"

#include "look/material.h"
#include "view/overlays.h"

#include <filesystem>
#include <fstream>
#include <ostream>

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr int frames_laid = 36, frames_hung = 24, frames_thrown = 2;

std::vector<PictureScene> all_scenes() {
    std::vector<PictureScene> scenes;
    for (const MaterialPreset& preset : material_presets()) {
        const std::string name(preset.name);
        scenes.push_back({.name = "material_" + name, .look = "\"" + name + "\""});
    }
    for (const Overlay& overlay : overlays()) {
        const std::string name(overlay.name);
        scenes.push_back({.name = "overlay_" + name,
                          .overlays = {name},
                          .hung = true,
                          .thrown = overlay.needs == OverlayNeeds::contact_marks});
    }
    const auto light = [&](const std::string& name, const std::string& text) -> PictureScene& {
        return scenes.emplace_back(PictureScene{.name = "light_" + name, .light = text});
    };
    light("sun_low", R"({ "sun": { "elevation": 8, "azimuth": -70 } })");
    light("sun_off", R"({ "sun": { "intensity": 0 } })");
    light("sun_large", R"({ "sun": { "angular_diameter": 25 } })");
    light("sun_behind", R"({ "sun": { "azimuth": 200, "elevation": 35 } })").look = "\"linen\"";
    light("overcast", R"({ "sun": { "intensity": 0.2 }, "sky": { "intensity": 1, "zenith": [0.5, 0.6, 0.8] } })");
    light("bright", R"({ "exposure": 2 })");
    light("dark", R"({ "exposure": -3 })");
    light("without_occlusion", R"({ "ambient_occlusion": 0 })");
    light("transparent", "{}").transparent = true;
    light("environment", R"({ "sun": { "intensity": 0 }, "environment": { "file": "window.hdr" } })").environment =
        true;
    PictureScene& turned = light("environment_turned", R"({ "sun": { "intensity": 0 },
        "environment": { "file": "window.hdr", "rotation": 120, "intensity": 1.5, "visible": false } })");
    turned.environment = true;
    turned.look = "\"satin\"";
    light("many_samples", "{}").samples = 16;
    return scenes;
}

}  // namespace

void PrintTo(const PictureScene& scene, std::ostream* out) {
    *out << scene.name;
}

const std::vector<PictureScene>& picture_scenes() {
    static const std::vector<PictureScene> scenes = all_scenes();
    return scenes;
}

std::string scene_text(const PictureScene& scene) {
    const std::string material = ", \"material\": " + scene.look + " }],";
    const std::string laid = R"(
        "cloths": [{ "name": "cloth", "mesh": { "grid": { "size": [0.9, 0.9], "resolution": [31, 31] } },
                     "transform": { "position": [0, 0.62, 0], "rotation": [0, 30, 0] }, "fabric": "cotton")" +
                             material + R"(
        "colliders": [{ "name": "ball", "sphere": { "radius": 0.25 }, "transform": { "position": [0, 0.3, 0] } },
                      { "name": "ground", "plane": {} }],)";
    const std::string hung = R"(
        "air": { "wind": [{ "velocity": [1.5, 0, -2] }] },
        "cloths": [{ "name": "cloth", "mesh": { "grid": { "size": [0.8, 0.8], "resolution": [17, 17] } },
                     "transform": { "position": [0, 0.5, 0.2], "rotation": [80, 0, 0] }, "fabric": "cotton",
                     "pins": [{ "vertices": [0, 16] }])" +
                             material + R"(
        "colliders": [{ "name": "ball", "sphere": { "radius": 0.25 }, "transform": { "position": [0, 0.3, 0] } },
                      { "name": "ground", "plane": {} }],)";
    const std::string thrown = R"(
        "cloths": [{ "name": "one", "mesh": { "grid": { "size": [0.8, 0.8], "resolution": [25, 25] } },
                     "transform": { "position": [0, 0.5, 0], "rotation": [80, 20, 45] }, "velocity": [0, -12, 0],
                     "fabric": { "preset": "cotton", "thickness": 0.008 }, "self_collision": "exact" },
                   { "name": "two", "mesh": { "grid": { "size": [0.3, 0.3], "resolution": [14, 14] } },
                     "transform": { "position": [0.1, 0.42, 0.12], "rotation": [5, 30, 50] }, "velocity": [0, -12, 0],
                     "fabric": { "preset": "cotton", "thickness": 0.008 }, "self_collision": "exact")" +
                               material + R"(
        "colliders": [{ "name": "ground", "plane": {} }],)";
    const std::string from_near = R"({ "position": [0.55, 0.95, 1.75], "target": [0, 0.24, 0], "fov": 21 })",
                      from_far = R"({ "position": [0.9, 0.9, 1.9], "target": [0, 0.42, 0.05], "fov": 34 })",
                      from_above = R"({ "position": [0.9, 0.8, 1.4], "target": [-0.15, 0.08, 0.05], "fov": 32 })";
    const auto whole = [&](const std::string& content, const std::string& camera) {
        return R"({ "weft": 1,)" + content + R"(
        "camera": )" +
               camera + R"(,
        "light": )" +
               scene.light + " }\n";
    };
    if (scene.thrown) return whole(thrown, from_above);
    return scene.hung ? whole(hung, from_far) : whole(laid, from_near);
}

ImageF window_light() {
    ImageF image{64, 32, {}};
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const bool window = x >= 44 && x < 52 && y >= 9 && y < 16;
            if (window) {
                image.rgba.insert(image.rgba.end(), {9, 7, 4.5f, 1});
            } else if (y < 16) {
                image.rgba.insert(image.rgba.end(), {0.25f, 0.35f, 0.55f, 1});
            } else {
                image.rgba.insert(image.rgba.end(), {0.12f, 0.1f, 0.08f, 1});
            }
        }
    }
    return image;
}

void PictureTest::SetUp() {
    OnDevice::SetUp();
    if (!HasFatalFailure()) open();
}

Image8 PictureTest::drawn(const PictureScene& scene) {
    const fs::path folder = fs::path(WEFT_BINARY_DIR) / "golden", file = folder / (scene.name + ".json");
    fs::create_directories(folder);
    std::ofstream(file) << scene_text(scene);
    Options options;
    options.backend = "cpu";
    options.contact_forces = true;
    auto session = open_scene(file, options);
    EXPECT_TRUE(session.ok()) << session.error().message();
    if (!session) return {};
    session->set_contact_marks(scene.thrown);
    const int frames = scene.thrown ? frames_thrown : scene.hung ? frames_hung : frames_laid;
    for (int i = 0; i < frames; ++i) session->advance();

    ViewSources sources;
    if (scene.environment) sources.read_light = [](const std::string&) { return Result<ImageF>(window_light()); };
    auto view = SceneView::create(device, session->scene(), session->world(),
                                  {.width = scene.hung ? 320u : 160u,  // legends need room
                                   .height = scene.hung ? 180u : 90u,
                                   .samples = scene.samples,
                                   .transparent = scene.transparent,
                                   .overlays = scene.overlays},
                                  sources);
    EXPECT_TRUE(view.ok()) << view.error().message();
    if (!view) return {};
    EXPECT_TRUE(view->notes().empty());
    auto image = view->picture(session->scene(), session->world(), view->camera(session->scene(), session->world()));
    EXPECT_TRUE(image.ok()) << image.error().message();
    return image ? std::move(*image) : Image8{};
}

}  // namespace weft
