#include "scenes.h"

#include "look/material.h"
#include "view/overlays.h"

#include <filesystem>
#include <fstream>
#include <ostream>

namespace weft {
namespace {

namespace fs = std::filesystem;

int frames_of(PictureContent content) {
    switch (content) {
        case PictureContent::laid:
            return 36;
        case PictureContent::hung:
        case PictureContent::slit:
            return 24;
        case PictureContent::tips:
            return 8;
        case PictureContent::thrown:
            return 2;
        case PictureContent::star:
            break;
    }
    return 0;
}

PictureContent content_of(const Overlay& overlay) {
    if (overlay.name == "rims") return PictureContent::slit;
    if (overlay.name == "distance_fields") return PictureContent::star;
    return overlay.needs == OverlayNeeds::contact_marks ? PictureContent::thrown : PictureContent::hung;
}

std::vector<PictureScene> all_scenes() {
    std::vector<PictureScene> scenes;
    for (const MaterialPreset& preset : material_presets()) {
        const std::string name(preset.name);
        scenes.push_back({.name = "material_" + name, .look = "\"" + name + "\""});
    }
    for (const Overlay& overlay : overlays()) {
        const std::string name(overlay.name);
        scenes.push_back({.name = "overlay_" + name, .overlays = {name}, .content = content_of(overlay)});
    }
    scenes.push_back({.name = "overlay_contacts_of_faces", .overlays = {"contacts"}, .content = PictureContent::tips});
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

std::string star_text() {
    std::string text;
    const auto vertex = [&](double x, double y, double z) {
        text += "v " + std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(z) + '\n';
    };
    const auto face = [&](int a, int b, int c) {
        text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
    };
    // An octahedron; on each face a pyramid, whose tip is far out.
    constexpr double r = 0.11, out = 0.17;
    const double corners[6][3] = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
    for (const auto& [x, y, z] : corners) vertex(x, y, z);
    int tip = 6;
    for (const int x : {0, 1}) {
        for (const int y : {2, 3}) {
            for (const int z : {4, 5}) {
                vertex(x == 0 ? out : -out, y == 2 ? out : -out, z == 4 ? out : -out);
                const bool even = (x + y + z) % 2 == 0;  // counterclockwise from outside
                const int a = x, b = even ? y : z, c = even ? z : y;
                face(a, b, tip), face(b, c, tip), face(c, a, tip);
                ++tip;
            }
        }
    }
    const double plate[4][2] = {{-0.06, -0.06}, {0.06, -0.06}, {0.06, 0.06}, {-0.06, 0.06}};
    for (const double z : {0.159, 0.161})
        for (const auto& [x, y] : plate) vertex(x, y, z);
    for (int k = 0; k < 4; ++k) {
        const int a = tip + k, b = tip + (k + 1) % 4;
        face(a, b, b + 4), face(a, b + 4, a + 4);
    }
    face(tip, tip + 2, tip + 1), face(tip, tip + 3, tip + 2);
    face(tip + 4, tip + 5, tip + 6), face(tip + 4, tip + 6, tip + 7);
    return text;
}

std::string scene_text(const PictureScene& scene) {
    const std::string material = ", \"material\": " + scene.look + " }],";
    const std::string laid = R"(
        "cloths": [{ "name": "cloth", "mesh": { "grid": { "size": [0.9, 0.9], "resolution": [31, 31] } },
                     "transform": { "position": [0, 0.62, 0], "rotation": [0, 30, 0] }, "fabric": "cotton")" +
                             material + R"(
        "colliders": [{ "name": "ball", "sphere": { "radius": 0.25 }, "transform": { "position": [0, 0.3, 0] } },
                      { "name": "ground", "plane": {} }],)";
    const std::string slit = scene.content == PictureContent::slit ? R"(, "tearing": "cuts",
                     "cuts": [{ "points": [[0.1, 0.1, 0.27], [0, 0.6, 0.18]] }])"
                                                                   : "";
    const std::string hung = R"(
        "air": { "wind": [{ "velocity": [1.5, 0, -2] }] },
        "cloths": [{ "name": "cloth", "mesh": { "grid": { "size": [0.8, 0.8], "resolution": [17, 17] } },
                     "transform": { "position": [0, 0.5, 0.2], "rotation": [80, 0, 0] }, "fabric": "cotton",
                     "pins": [{ "vertices": [0, 16] }])" +
                             slit + material + R"(
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
    const std::string tips = R"(
        "cloths": [{ "name": "cloth", "mesh": { "grid": { "size": [0.9, 0.9], "resolution": [13, 13] } },
                     "transform": { "position": [0.05, 0.43, 0], "rotation": [0, 20, 0] }, "fabric": "denim")" +
                             material + R"(
        "colliders": [{ "name": "star", "mesh": { "file": "star.obj", "resolution": 24 },
                        "transform": { "position": [-0.2, 0.15, 0.05], "rotation": [20, 20, 10] } },
                      { "name": "box", "box": { "half_extents": [0.12, 0.12, 0.12] },
                        "transform": { "position": [0.25, 0.19, -0.07], "rotation": [45, 0, 35.26] } },
                      { "name": "ball", "sphere": { "radius": 0.02 }, "transform": { "position": [0.1, 0.37, 0.22] } },
                      { "name": "ground", "plane": {} }],)";
    const std::string from_near = R"({ "position": [0.55, 0.95, 1.75], "target": [0, 0.24, 0], "fov": 21 })",
                      from_far = R"({ "position": [0.9, 0.9, 1.9], "target": [0, 0.42, 0.05], "fov": 34 })",
                      from_above = R"({ "position": [0.9, 0.8, 1.4], "target": [-0.15, 0.08, 0.05], "fov": 32 })",
                      at_tips = R"({ "position": [0.5, 1.0, 1.6], "target": [-0.1, 0.22, 0.05], "fov": 34 })",
                      at_star = R"({ "position": [0.1, 0.4, 1.0], "target": [-0.36, 0.05, 0.05], "fov": 36 })";
    const auto whole = [&](const std::string& content, const std::string& camera) {
        return R"({ "weft": 1,)" + content + R"(
        "camera": )" +
               camera + R"(,
        "light": )" +
               scene.light + " }\n";
    };
    switch (scene.content) {
        case PictureContent::laid:
            break;
        case PictureContent::hung:
        case PictureContent::slit:
            return whole(hung, from_far);
        case PictureContent::thrown:
            return whole(thrown, from_above);
        case PictureContent::tips:
            return whole(tips, at_tips);
        case PictureContent::star:
            return whole(tips, at_star);
    }
    return whole(laid, from_near);
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
    if (scene.content == PictureContent::tips || scene.content == PictureContent::star)
        std::ofstream(folder / "star.obj") << star_text();
    Options options;
    options.backend = "cpu";
    options.contact_forces = true;
    auto session = open_scene(file, options);
    EXPECT_TRUE(session.ok()) << session.error().message();
    if (!session) return {};
    session->set_contact_marks(scene.content == PictureContent::thrown);
    for (int i = 0; i < frames_of(scene.content); ++i) session->advance();
    const bool with_legend = scene.content != PictureContent::laid;  // which needs room

    ViewSources sources;
    if (scene.environment) sources.read_light = [](const std::string&) { return Result<ImageF>(window_light()); };
    auto view = SceneView::create(device, session->scene(), session->world(),
                                  {.width = with_legend ? 320u : 160u,
                                   .height = with_legend ? 180u : 90u,
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
