// Malformed drawings and unusual sizes must not crash or cause messages of the validation layers.

#include "render/studio.test.h"

#include <limits>
#include <string>

namespace weft::render {
namespace {

using VulkanMalformedDrawings = VulkanPictures;

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

TEST_F(VulkanMalformedDrawings, sizes_may_change_from_picture_to_picture) {
    light_by({});
    objects = {object_of(level_sheet(1, 0), add(find_material("chiffon")->material)),
               object_of(level_sheet(2, -0.3f), add(find_material("cotton")->material))};
    drawing.camera.position = {0.5f, 1.5f, 2};
    const Image8 first = picture(64, 36);
    for (const auto& [width, height] : {std::pair{33u, 7u}, {1u, 1u}, {2u, 200u}, {1u, 3u}, {300u, 1u}}) {
        const Image8 image = picture(width, height);
        EXPECT_EQ(image.rgba.size(), std::size_t{width} * height * 4);
        EXPECT_EQ(image.rgba[3], 255);
    }
    EXPECT_EQ(picture(64, 36).rgba, first.rgba);
}

TEST_F(VulkanMalformedDrawings, a_picture_larger_than_the_device_can_is_an_error) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device->physical(), &properties);
    const std::uint32_t most = properties.limits.maxImageDimension2D;
    for (const auto& [width, height] : {std::pair{most + 1, 1u}, {1u, most + 1}}) {
        const auto made = renderer->picture(drawing, width, height);
        ASSERT_FALSE(made.ok());
        EXPECT_EQ(made.error().fault, Fault::machine) << made.error().message();
    }
    EXPECT_EQ(picture(8, 8).rgba.size(), 256u) << "and it goes on";
}

TEST_F(VulkanMalformedDrawings, nothing_at_all_is_the_background) {
    light_by(furnace());
    const Image8 image = picture(16, 16);
    const Vec3 light = mean_light(image);
    EXPECT_GT(light.x, 0.9f);
    drawing.background = Background::transparent;
    for (const std::uint8_t byte : picture(16, 16).rgba) EXPECT_EQ(byte, 0);
}

TEST_F(VulkanMalformedDrawings, objects_without_triangles_are_not_there) {
    light_by({});
    const Image8 none = picture();
    Shape points = level_sheet(1, 0);
    points.triangles.clear();
    objects = {object_of(points, add(paper())), object_of(points, add(find_material("chiffon")->material))};
    EXPECT_EQ(picture().rgba, none.rgba);
    Shape flat = level_sheet(1, 0);
    for (Triangle& t : flat.triangles) t = {t[0], t[0], t[1]};
    objects = {object_of(flat, add(paper()))};
    EXPECT_EQ(picture().rgba, none.rgba) << "triangles without an area";
}

TEST_F(VulkanMalformedDrawings, numbers_that_are_none_do_no_harm) {
    light_by({});
    grounds = {{.offset = -0.5f, .material = add(paper())}};
    const Shape good = level_sheet(1, 0, 8);
    for (const float bad : {nan, infinite, -infinite, 1e38f}) {
        for (const bool all : {false, true}) {
            Shape shape = good;
            for (std::size_t v = 0; v < shape.positions.size(); ++v) {
                if (!all && v % 7 != 3) continue;
                shape.positions[v] = {bad, bad, bad};
                shape.normals[v] = {bad, 0, bad};
                shape.tangents[v] = {bad, bad, 0, bad};
            }
            for (const char* name : {"cotton", "velvet", "chiffon"}) {
                objects = {object_of(shape, add(find_material(name)->material))};
                EXPECT_EQ(picture(48, 27).at(47, 26)[3], 255) << name << " " << bad;
            }
            meshes.clear();
        }
    }
    Shape without = good;
    for (Vec3& n : without.normals) n = {};
    for (Vec4& t : without.tangents) t = {};
    objects = {object_of(without, add(paper()))};
    drawing.camera.position = {0, 2, 2};
    const Image8 image = picture();
    EXPECT_GT(gray_of(image.at(48, 27)), 0.1f) << "normals are made of the triangles";
    objects = {object_of(good, add(paper()))};
    EXPECT_GT(gray_of(picture().at(48, 27)), 0.1f) << "the next picture is as it should be";
}

TEST_F(VulkanMalformedDrawings, cameras_may_stand_anywhere) {
    light_by({});
    objects = {object_of(level_sheet(1, 0, 8), add(find_material("denim")->material))};
    grounds = {{.offset = -0.5f, .material = add(paper())}};
    const Camera cameras[] = {{{0, 0, 0}, {0, 0, 0}, 40},        {{0, 5, 0}, {0, 0, 0}, 40},
                              {{0, -5, 0}, {0, 0, 0}, 40},       {{0, 0, 1}, {0, 0, 0}, 150},
                              {{1e6f, 1e6f, 0}, {0, 0, 0}, 1},   {{0, 1e-5f, 1e-5f}, {0, 0, 0}, 40},
                              {{0, -0.5f, 2}, {0, -0.5f, 0}, 40}};
    for (const Camera& camera : cameras) {
        drawing.camera = camera;
        const Image8 image = picture(32, 18);
        EXPECT_EQ(image.at(16, 9)[3], 255) << camera.position.x << " " << camera.position.y << " " << camera.position.z;
    }
}

TEST_F(VulkanMalformedDrawings, thousands_of_lines_and_points) {
    light_by({});
    std::vector<Line> lines;
    std::vector<Point> points;
    for (int i = 0; i < 20000; ++i) {
        const float a = 0.01f * static_cast<float>(i);
        const Vec3 p{std::cos(a) * a / 200, std::sin(a) * a / 200, 0};
        lines.push_back({p, p * 1.01f, {1, 1, 1, 0.5f}, 1});
        points.push_back({p, {1, 0, 0, 1}, 2});
    }
    lines.push_back({{nan, 0, 0}, {1, 1, 1}, {1, 0, 0, 1}, 2});
    lines.push_back({{0, 0, 1e9f}, {0, 0, -1e9f}, {1, 0, 0, 1}, 2});
    lines.push_back({{0, 0, 0}, {0, 0, 0}, {1, 0, 0, 1}, 2});
    points.push_back({{infinite, 0, 0}, {1, 0, 0, 1}, 2});
    const Image8 none = picture();
    drawing.lines = lines;
    drawing.lines_on_top = lines;
    drawing.points = points;
    EXPECT_GT(difference(none, picture()).beyond, 500u);
    drawing.lines = drawing.lines_on_top = {};
    drawing.points = {};
    EXPECT_EQ(picture().rgba, none.rgba);
}

TEST_F(VulkanMalformedDrawings, many_objects_of_one_mesh) {
    light_by({});
    const MaterialId material = add(paper(0.8f));
    const Object one = object_of(level_sheet(0.1f, 0), material);
    for (int i = 0; i < 500; ++i) {
        Object other = one;
        other.transform[3] = {0.1f * static_cast<float>(i % 25) - 1.2f, 0.1f * static_cast<float>(i / 25) - 1, 0};
        objects.push_back(other);
    }
    const Image8 image = picture();
    EXPECT_EQ(picture().rgba, image.rgba);
}

TEST_F(VulkanMalformedDrawings, light_beyond_all_measure) {
    Lighting light;
    light.sun.intensity = 1000;
    light.sky.intensity = 1000;
    light.exposure = 20;
    objects = {object_of(level_sheet(2, 0), add(find_material("satin")->material))};
    drawing.camera.position = {0, 2, 2};
    light_by(light);
    const Image8 bright = picture(32, 18);
    for (int c = 0; c < 3; ++c) EXPECT_GE(bright.at(16, 9)[c], 250) << "white, not black";
    light.exposure = -20;
    light.sun.intensity = light.sky.intensity = 1;
    light_by(light);
    for (int c = 0; c < 3; ++c) EXPECT_LE(picture(32, 18).at(16, 9)[c], 1);
    ImageF environment{4, 2, std::vector<float>(32, 1)};
    environment.rgba[0] = 6e4f;
    light.exposure = 0;
    light_by(light, &environment);
    EXPECT_EQ(picture(32, 18).at(16, 9)[3], 255);
}

// Labels: no-asan
TEST_F(VulkanMalformedDrawings, what_a_renderer_took_it_gives_back) {
    renderer.reset();
    const std::uint64_t before = device->memory().used();
    for (int i = 0; i < 2; ++i) {
        start();
        EXPECT_GT(device->memory().used(), before);
        light_by({});
        const Image8 map{4, 4, std::vector<std::uint8_t>(64, 200)};
        objects = {object_of(level_sheet(1, 0), add(find_material("chiffon")->material, &map, &map))};
        grounds = {{.material = add(paper())}};
        (void)picture(64, 36);
        (void)picture(128, 72);
        const std::uint64_t drawn = device->memory().used();
        for (int again = 0; again < 4; ++again) {
            (void)picture(128, 72);
            light_by({});
        }
        EXPECT_EQ(device->memory().used(), drawn) << "pictures do not add up";
        meshes.clear();
        renderer.reset();
        EXPECT_EQ(device->memory().used(), before);
    }
}

}  // namespace
}  // namespace weft::render
