// Tests which settings change an image and which do not.

#include "look/weave.h"
#include "render/shading/color_scale.h"
#include "render/studio.test.h"

#include <cstring>
#include <numeric>

namespace weft::render {
namespace {

class VulkanDrawing : public VulkanPictures {
  protected:
    /// An S-shaped cloth that shows both sides to the camera, in front of a level one.
    static Shape folded() {
        return patch(48, [](float s, float t) {
            const float a = 5 * (s - 0.5f);
            return Vec3{0.8f * std::sin(a), 1.4f * (t - 0.5f) + 0.1f * std::sin(4 * a), 0.5f * std::cos(1.3f * a)};
        });
    }
};

TEST_F(VulkanDrawing, both_sides_in_one_pass_are_as_in_two) {
    light_by({});
    for (const char* name : {"denim", "velvet", "silk", "chiffon"}) {
        objects = {object_of(folded(), add(find_material(name)->material)),
                   object_of(level_sheet(3, -0.8f), add(paper(0.5f)))};
        drawing.camera = {.position = {0.3f, 0.5f, 3}, .target = {0, 0, 0}, .fov = 40};
        drawing.two_passes = false;
        const Image8 one = picture();
        drawing.two_passes = true;
        const Image8 two = picture();
        // In pixels with both sides, the order of the sums differs.
        const Difference found = difference(one, two);
        EXPECT_LE(found.beyond, one.rgba.size() / 4 / 200) << name;
        drawing.camera.position.z = -3;
        EXPECT_GT(difference(two, picture(), 8).beyond, one.rgba.size() / 4 / 10) << name << " from behind";
    }
}

TEST_F(VulkanDrawing, backs_of_denim_are_its_weft) {
    light_by(furnace());
    Material denim = find_material("denim")->material;
    objects = {object_of(patch(1,
                               [](float s, float t) {
                                   return Vec3{4 * (s - 0.5f), 4 * (t - 0.5f), 0};
                               }),
                         add(denim))};
    const Vec3 front = mean_light(picture(32, 32));
    drawing.camera.position.z = -3;
    const Vec3 back = mean_light(picture(32, 32));
    EXPECT_GT(front.z, 1.2f * front.x) << "blue";
    EXPECT_GT(back.x, 1.5f * front.x) << "the raw weft is lighter";
}

TEST_F(VulkanDrawing, the_same_drawing_gives_the_same_bytes) {
    light_by({});
    const auto draw = [&] {
        objects = {object_of(folded(), add(find_material("satin")->material)),
                   object_of(level_sheet(0.4f, 0.9f), add(find_material("chiffon")->material))};
        grounds = {{.offset = -0.9f, .material = add(find_material("floor")->material)}};
        return picture();
    };
    const Image8 first = draw();
    EXPECT_EQ(draw().rgba, first.rgba);
    EXPECT_EQ(picture().rgba, first.rgba);
    start();  // another renderer
    light_by({});
    EXPECT_EQ(draw().rgba, first.rgba);
}

// Labels: slow no-asan
TEST_F(VulkanDrawing, more_samples_show_the_same_more_smoothly) {
    Vec3 sums[4];
    Image8 images[4];
    std::size_t i = 0;
    for (const std::uint32_t samples : {1u, 2u, 4u, 16u}) {
        start(samples);
        light_by({});
        objects = {object_of(folded(), add(find_material("cotton")->material))};
        grounds = {{.offset = -0.9f, .material = add(find_material("floor")->material)}};
        images[i] = picture();
        sums[i] = mean_light(images[i]);
        ++i;
    }
    for (i = 0; i < 3; ++i) {
        EXPECT_NEAR(sums[i].x, sums[3].x, 0.015f * sums[3].x) << i;
        EXPECT_NEAR(sums[i].z, sums[3].z, 0.015f * sums[3].z) << i;
        EXPECT_LE(difference(images[i], images[3], 24).beyond, images[i].rgba.size() / 4 / 12)
            << "edges and noise " << i;
    }
    EXPECT_LE(difference(images[2], images[3], 24).beyond, difference(images[0], images[3], 24).beyond);
}

TEST_F(VulkanDrawing, without_a_background_alpha_says_what_is_covered) {
    Lighting light;
    light.sun.azimuth = 150;
    light.exposure = -0.5f;
    light_by(light);
    drawing.background = Background::transparent;
    drawing.camera = {.position = {0, 0.6f, 4}, .target = {0, 0, 0}, .fov = 40};
    objects = {object_of(patch(1,
                               [](float s, float t) {
                                   const float u = s - 0.5f, v = t - 0.5f;
                                   return Vec3{0.9f * u - 0.3f * v, 0.9f * v + 0.3f * u, 0};
                               }),
                         add(paper(0.9f)))};
    const Image8 alone = picture();
    EXPECT_EQ(alone.at(2, 2)[3], 0);
    EXPECT_EQ(alone.at(48, 27)[3], 255);
    std::size_t edge = 0;
    const float inside = gray_of(alone.at(48, 27));
    for (std::size_t i = 0; i < alone.rgba.size(); i += 4) {
        const std::uint8_t alpha = alone.rgba[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        ++edge;
        EXPECT_GT(gray_of(&alone.rgba[i]), 0.8f * inside) << "no dark rim; alpha " << int{alpha};
    }
    EXPECT_GT(edge, 20u);

    grounds = {{.offset = -0.6f, .material = add(paper(0.5f))}};
    const Image8 grounded = picture();
    std::size_t shadow = 0;
    for (std::size_t i = 0; i < alone.rgba.size(); i += 4) {
        const bool ground = alone.rgba[i + 3] == 0 && grounded.rgba[i + 3] > 40;
        shadow += ground;
        if (!ground) continue;
        EXPECT_LT(grounded.rgba[i] + grounded.rgba[i + 1] + grounded.rgba[i + 2], 60) << "shadows are black";
    }
    EXPECT_GT(shadow, 50u);
    EXPECT_LT(grounded.at(90, 50)[3], 30) << "far from the shadow";
    EXPECT_EQ(grounded.at(48, 27)[3], 255);
}

// Compares the relief of a weave with a normal map of the same relief.
TEST_F(VulkanDrawing, a_normal_map_of_a_weave_looks_like_the_weave) {
    const Relief relief = make_weave(Weave::twill);
    constexpr float repeat = 2;
    Material woven = paper(0.8f);
    woven.weave = Weave::twill;
    woven.weave_depth = 0.6f;
    woven.thread_spacing = 10;  // mm
    const Image8 map = normal_map_of(relief, 1);
    Image8 upside_down = map;
    for (std::uint32_t y = 0; y < map.height; ++y)
        std::memcpy(upside_down.at(0, y), map.at(0, map.height - 1 - y), std::size_t{map.width} * 4);
    Material mapped = woven;
    mapped.uv_tiling[0] = mapped.uv_tiling[1] = repeat;
    const Shape sheet = patch(1, [](float s, float t) { return Vec3{2 * (s - 0.5f), 2 * (t - 0.5f), 0}; });
    light_by(sun_alone(60, 40, 3));
    drawing.camera.fov = 30;
    const auto draw = [&](MaterialId material) {
        Object object = object_of(sheet, material);
        object.uv_meters[0] = 0.01f * relief.threads[0] * repeat;
        object.uv_meters[1] = 0.01f * relief.threads[1] * repeat;
        objects = {object};
        return picture(96, 96);
    };
    const Image8 a = draw(add(woven)), b = draw(add(mapped, nullptr, &map)),
                 c = draw(add(mapped, nullptr, &upside_down));
    const auto alike = [](const Image8& one, const Image8& other) {  // correlation
        const std::size_t count = one.rgba.size() / 4;
        double sum[2]{}, square[2]{}, product = 0;
        for (std::size_t i = 0; i < one.rgba.size(); i += 4) {
            const double x = double(gray_of(&one.rgba[i])), y = double(gray_of(&other.rgba[i]));
            sum[0] += x, sum[1] += y, square[0] += x * x, square[1] += y * y, product += x * y;
        }
        const double n = double(count);
        return (product - sum[0] * sum[1] / n) /
               std::sqrt((square[0] - sum[0] * sum[0] / n) * (square[1] - sum[1] * sum[1] / n));
    };
    // The weave also darkens the gaps between threads, which the map does not contain.
    EXPECT_GT(alike(a, b), 0.8);
    EXPECT_LT(alike(a, c), 0.6) << "the test can tell";
}

TEST_F(VulkanDrawing, a_color_map_lies_as_the_uvs_say) {
    Image8 map{2, 2, {}};
    // Rows from the top: v = 1 is the first one.
    map.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
    light_by(furnace());
    objects = {object_of(patch(1,
                               [](float s, float t) {
                                   return Vec3{2 * (s - 0.5f), 2 * (t - 0.5f), 0};
                               }),
                         add(paper(0.7f), &map))};
    const Image8 image = picture(96, 96);
    const auto strongest = [&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* p = image.at(x, y);
        return p[0] > 2 * p[1] ? 'r' : p[1] > 2 * p[0] && p[1] > 2 * p[2] ? 'g' : p[2] > 2 * p[0] ? 'b' : 'w';
    };
    EXPECT_EQ(strongest(28, 28), 'r');
    EXPECT_EQ(strongest(68, 28), 'g');
    EXPECT_EQ(strongest(28, 68), 'b');
    EXPECT_EQ(strongest(68, 68), 'w');
}

// The colors on the cloth match the legend.
TEST_F(VulkanDrawing, values_have_the_colors_of_their_scale) {
    const Shape sheet = patch(32, [](float s, float t) { return Vec3{6 * (s - 0.5f), 4 * (t - 0.5f), 0}; });
    Object object = object_of(sheet, add(paper()));
    auto values = device->memory().buffer(sheet.positions.size() * sizeof(float), gpu::MemoryKind::upload, "values");
    ASSERT_TRUE(values.ok());
    for (std::size_t v = 0; v < sheet.positions.size(); ++v)
        values->as<float>()[v] = 10 + 30 * (sheet.positions[v].x + 1) / 2;  // 10 at x = -1, 40 at x = 1
    drawing.camera = {.position = {0, 0, 60}, .target = {0, 0, 0}, .fov = 3};
    for (const ColorScale scale : {ColorScale::balance, ColorScale::amount}) {
        object.scalars = {range_of(*values, 0, values->size()), 10, 40, scale};
        objects = {object};
        Lighting light;
        for (const float exposure : {0.0f, 3.0f}) {
            light.exposure = exposure;
            light_by(light);
            const Image8 image = picture(96, 54);
            const float half = 60 * std::tan(1.5f * 3.14159265f / 180) * 96 / 54;
            for (std::uint32_t x = 0; x < 96; ++x) {
                const float at = ((static_cast<float>(x) + 0.5f) / 48 - 1) * half;
                const glm::vec3 expected = shading::color_scale((at + 1) / 2, static_cast<int>(scale));
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(image.at(x, 20)[c], 255 * expected[c], 3) << "value at " << at << ", channel " << c;
            }
        }
    }
}

TEST_F(VulkanDrawing, what_is_flat_is_on_top_in_its_own_color) {
    light_by({});
    grounds = {{.offset = -0.5f, .material = add(paper())}};
    const Vec4 color{0.2f, 0.5f, 0.8f, 1};
    const FlatVertex flat[] = {{10, 10, color}, {30, 10, color}, {10, 30, color}};
    drawing.flat = flat;
    const Image8 image = picture();
    EXPECT_NEAR(image.at(14, 14)[0], 51, 1.5);
    EXPECT_NEAR(image.at(14, 14)[1], 127.5, 1.5);
    EXPECT_NEAR(image.at(14, 14)[2], 204, 1.5);
    drawing.flat = {};
    EXPECT_EQ(difference(image, picture(), 2).beyond, difference(picture(), image, 2).beyond);
    EXPECT_NEAR(static_cast<double>(difference(image, picture(), 2).beyond), 200, 25) << "half of 20 x 20 pixels";
}

TEST_F(VulkanDrawing, lines_are_hidden_by_what_stands_before_them_and_those_on_top_are_not) {
    light_by(furnace());
    objects = {object_of(patch(1, [](float s, float t) { return Vec3{s - 0.5f, t - 0.5f, 0}; }), add(paper(0.5f)))};
    const Image8 none = picture();
    const Line behind[] = {{{-2, 0, -0.5f}, {2, 0, -0.5f}, {1, 0, 0, 1}, 3}};
    drawing.lines = behind;
    const Image8 hidden = picture();
    drawing.lines = {};
    drawing.lines_on_top = behind;
    const Image8 on_top = picture();
    const auto red = [](const Image8& image, std::uint32_t x) { return image.at(x, 27)[0] > 2 * image.at(x, 27)[1]; };
    EXPECT_FALSE(red(none, 10));
    EXPECT_TRUE(red(hidden, 10));
    EXPECT_FALSE(red(hidden, 48));
    EXPECT_TRUE(red(on_top, 48));
    drawing.lines_on_top = {};
    const Point point[] = {{{0, 0, -1}, {0, 0, 1, 1}, 10}};
    drawing.points = point;
    EXPECT_GT(picture().at(48, 27)[2], 2 * picture().at(48, 27)[0]) << "points are shown through everything";
}

}  // namespace
}  // namespace weft::render
