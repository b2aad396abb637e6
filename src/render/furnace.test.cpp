// Furnace tests: if the same white comes from everywhere, a surface shows its albedo.

#include "render/albedo.h"
#include "render/studio.test.h"

#include <string>

namespace weft::render {
namespace {

using glm::vec2;
using glm::vec3;
using shading::Fiber;
using shading::Lobes;
using shading::table_size;

constexpr float exposure = -1;  // half: below the range that tone mapping compresses

class VulkanFurnace : public VulkanPictures {
  protected:
    void SetUp() override {
        VulkanPictures::SetUp();
        if (HasFatalFailure()) return;
        Lighting light = furnace();
        light.exposure = exposure;
        light_by(light);
        sheet = patch(1, [](float s, float t) { return Vec3{6 * (s - 0.5f), 6 * (t - 0.5f), 0}; });
    }
    /// A sheet of this material, seen at `degrees` from its normal. It fills the image.
    Vec3 seen(MaterialId material, float degrees, float turn = 0) {
        Object object = object_of(sheet, material);
        object.uv_meters[0] = object.uv_meters[1] = 6;
        objects = {object};
        const float a = degrees * shading::pi / 180, b = turn * shading::pi / 180;
        drawing.camera = {.position = Vec3{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)} * 8.0f,
                          .target = {0, 0, 0},
                          .fov = 1.5f};
        return mean_light(picture(24, 24)) / std::exp2(exposure);
    }

    Shape sheet;
};

Material white(Material material) {
    material.color = material.weft_color = {1, 1, 1};
    return material;
}

/// The albedo, integrated over a grid of directions and over viewers around the normal.
double albedo_of(const Fiber& fiber, float cosine) {
    const AlbedoTable table = albedo_table(fiber);
    const auto at = [&](float c) {
        const float place = std::clamp(c, 0.0f, 1.0f) * float(table_size) - 0.5f;
        const int below = int(std::clamp(std::floor(place), 0.0f, float(table_size) - 2));
        const float part = std::clamp(place - float(below), 0.0f, 1.0f);
        return vec2(mix(table[std::size_t(below)], table[std::size_t(below) + 1], part));
    };
    constexpr int rings = 128, viewers = 4;
    const double step = double(shading::pi) / 2 / rings;
    const float side = std::sqrt(1 - cosine * cosine);
    double sum = 0;
    for (int viewer = 0; viewer < viewers; ++viewer) {
        const float turn = shading::pi * (float(viewer) + 0.25f) / viewers;
        const vec3 v(side * std::cos(turn), side * std::sin(turn), cosine);
        for (int i = 0; i < rings; ++i) {
            const double angle = (i + 0.5) * step, c = std::cos(angle), s = std::sin(angle);
            for (int j = 0; j < 2 * rings; ++j) {
                const double a = (j + 0.5) * 2 * step;
                const vec3 l(s * std::cos(a), s * std::sin(a), c);
                const Lobes lobes = layered(fiber, lobes_before_layering(fiber, l, v), at(cosine), at(l.z));
                const vec3 f = lobes.matte * fiber.color + lobes.sheen + vec3(lobes.gloss);
                sum += double(f.x + f.y + f.z) / 3 * c * s * step * (2 * step);
            }
        }
    }
    return sum / viewers;
}

TEST_F(VulkanFurnace, no_material_is_brighter_than_what_is_around_it) {
    for (const MaterialPreset& preset : material_presets()) {
        const MaterialId id = add(white(preset.material));
        for (const float degrees : {0.0f, 45.0f, 70.0f, 84.0f}) {
            const Vec3 light = seen(id, degrees, 30);
            for (const float channel : {light.x, light.y, light.z}) {
                EXPECT_LE(channel, 1.01f) << preset.name << " at " << degrees;
                EXPECT_GE(channel, 0.5f) << preset.name << " at " << degrees;
            }
        }
    }
}

// Labels: slow no-asan
TEST_F(VulkanFurnace, flat_materials_show_the_albedo_that_a_grid_of_directions_finds) {
    for (const MaterialPreset& preset : material_presets()) {
        Material material = white(preset.material);
        material.weave = Weave::smooth;
        material.coverage = 1;
        const MaterialId id = add(material);
        const Fiber fiber = fiber_of(material, 1);
        for (const float degrees : {0.0f, 45.0f, 70.0f, 84.0f}) {
            const float expected = float(albedo_of(fiber, std::cos(degrees * shading::pi / 180)));
            const Vec3 light = seen(id, degrees);
            EXPECT_NEAR((light.x + light.y + light.z) / 3, expected, 0.02f) << preset.name << " at " << degrees;
        }
    }
}

TEST_F(VulkanFurnace, colors_come_out_as_they_are) {
    const Vec3 color{0.4f, 0.25f, 0.6f};
    Material material = paper();
    material.color = material.weft_color = color;
    const Vec3 light = seen(add(material), 0);
    EXPECT_NEAR(light.x, color.x, 0.01f);
    EXPECT_NEAR(light.y, color.y, 0.01f);
    EXPECT_NEAR(light.z, color.z, 0.01f);
}

TEST_F(VulkanFurnace, light_that_goes_through_is_not_lost) {
    Material material = paper(0.7f);
    const Vec3 opaque = seen(add(material), 30);
    material.transmission = 0.5f;
    const Vec3 through = seen(add(material), 30);
    EXPECT_NEAR(opaque.x, through.x, 0.005f) << "as much comes from behind";
}

// Sheer cloth shows the background in proportion to the gaps between threads.
TEST_F(VulkanFurnace, sheer_cloth_lets_the_background_through) {
    Material material = paper(0.2f);
    material.coverage = 0.4f;
    const Vec3 sheer = seen(add(material), 0);
    EXPECT_NEAR(sheer.x, 0.6f * 1 + 0.4f * 0.2f, 0.012f);
}

}  // namespace
}  // namespace weft::render
