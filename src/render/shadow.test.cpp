// Compares shadows with their geometric positions.

#include "render/studio.test.h"

#include <numbers>
#include <string>

namespace weft::render {
namespace {

class VulkanShadows : public VulkanPictures {
  protected:
    /// For images from above with `side` m from top to bottom: the pixel index of a coordinate.
    static std::uint32_t pixel(float at, float side, std::uint32_t count, std::uint32_t height) {
        const float p = at / side * static_cast<float>(height) + 0.5f * static_cast<float>(count);
        return static_cast<std::uint32_t>(std::clamp(p, 0.0f, static_cast<float>(count - 1)));
    }
};

TEST_F(VulkanShadows, lie_where_the_light_is_taken_from) {
    constexpr float side = 3;
    const MaterialId white = add(paper());
    objects = {object_of(level_sheet(0.5f, 0.6f), white)};
    grounds = {{.material = white}};
    drawing.camera = from_above(side, 40);
    struct Case {
        float azimuth, elevation;
    };
    for (const Case& one : {Case{90, 45}, Case{-90, 45}, Case{0, 40}, Case{180, 60}, Case{-60, 50}}) {
        light_by(sun_alone(one.azimuth, one.elevation));
        const Image8 image = picture(128, 128);
        const float a = one.azimuth * std::numbers::pi_v<float> / 180,
                    e = one.elevation * std::numbers::pi_v<float> / 180;
        const float reach = 0.6f / std::tan(e), dx = -reach * std::sin(a), dz = -reach * std::cos(a);
        const auto light_at = [&](float x, float z) {
            return gray_of(image.at(pixel(x, side, 128, 128), pixel(z, side, 128, 128)));
        };
        const std::string what = "azimuth " + std::to_string(one.azimuth);
        for (const float x : {-1.3f, -0.9f, -0.6f, 0.0f, 0.4f, 0.9f, 1.3f}) {
            for (const float z : {-1.3f, -0.6f, -0.2f, 0.1f, 0.7f, 1.2f}) {
                if (std::max(std::abs(x), std::abs(z)) < 0.3f) continue;  // the sheet itself
                const float from_edge = std::max(std::abs(x - dx), std::abs(z - dz)) - 0.25f;
                if (std::abs(from_edge) < 0.05f) continue;
                if (from_edge < 0) {
                    EXPECT_LT(light_at(x, z), 0.02f) << what << " at " << x << ", " << z;
                } else {
                    EXPECT_NEAR(light_at(x, z), std::sin(e), 0.04f) << what << " at " << x << ", " << z;
                }
            }
        }
        EXPECT_NEAR(light_at(0, 0), std::sin(e), 0.04f) << what << ": the sheet";
    }
}

TEST_F(VulkanShadows, have_edges_as_wide_as_the_sun) {
    constexpr float side = 0.3f;
    const MaterialId white = add(paper());
    objects = {object_of(level_sheet(0.6f, 1), white)};
    grounds = {{.material = white}};
    drawing.camera = from_above(side, 40);
    drawing.camera.position.x = drawing.camera.target.x = -0.7f;  // over the shadow's inner edge
    const auto penumbra = [&](float size) {                       // m between 20 % and 80 % of the light
        light_by(sun_alone(90, 45, size));
        const Image8 image = picture(192, 192);
        const float full = std::sin(std::numbers::pi_v<float> / 4);
        std::uint32_t between = 0;
        for (std::uint32_t x = 0; x < 192; ++x) {
            float sum = 0;
            for (std::uint32_t y = 84; y < 108; ++y) sum += gray_of(image.at(x, y)) / 24;
            between += sum > 0.2f * full && sum < 0.8f * full;
        }
        return static_cast<float>(between) * side / 192;
    };
    // The distance from edge to ground is 1.41 m, and the light hits the ground at an angle: 2 m of ground per radian
    // of sun. For a round sun, 0.49 of it is between 20 % and 80 %.
    const auto expected = [](float size) { return 0.49f * 2 * size * std::numbers::pi_v<float> / 180; };
    EXPECT_LT(penumbra(0.1f), 0.006f);
    EXPECT_NEAR(penumbra(0.8f), expected(0.8f), 0.005f);
    EXPECT_NEAR(penumbra(1.5f), expected(1.5f), 0.008f);
}

TEST_F(VulkanShadows, do_not_speckle_what_is_lit) {
    const MaterialId white = add(paper());
    for (const float elevation : {4.0f, 10.0f, 35.0f, 80.0f}) {
        Lighting light = sun_alone(30, elevation);
        light.exposure = std::min(3.0f, std::log2(0.7f / std::sin(elevation * std::numbers::pi_v<float> / 180)));
        light_by(light);
        objects = {object_of(level_sheet(2, 0, 40), white)};
        drawing.camera = from_above(1.6f);
        const Image8 image = picture(128, 128);
        const float mean = mean_light(image).x;
        EXPECT_NEAR(mean, std::sin(elevation * std::numbers::pi_v<float> / 180) * std::exp2(light.exposure), 0.15f)
            << elevation;
        std::size_t dark = 0;
        for (std::uint32_t y = 0; y < 128; ++y)
            for (std::uint32_t x = 0; x < 128; ++x) dark += gray_of(image.at(x, y)) < 0.97f * mean;
        EXPECT_EQ(dark, 0u) << "at " << elevation << " of 16384 pixels";
    }
}

// A ball has all slopes. In sunlight, only the cosine darkens it.
TEST_F(VulkanShadows, do_not_speckle_a_ball) {
    objects = {object_of(patch(64,
                               [](float s, float t) {
                                   const float a = 2 * std::numbers::pi_v<float> * s,
                                               b = std::numbers::pi_v<float> * (0.02f + 0.96f * t);
                                   return Vec3{std::sin(b) * std::sin(a), -std::cos(b), std::sin(b) * std::cos(a)};
                               }),
                         add(paper()))};
    drawing.camera = {.position = {0, 0, 8}, .target = {0, 0, 0}, .fov = 16};
    Lighting light = sun_alone(40, 30);
    light.exposure = -0.5f;
    light_by(light);
    const Vec3 sun = direction_of(light.sun);
    const Image8 image = picture(128, 128);
    const float half = 8 * std::tan(8 * std::numbers::pi_v<float> / 180);
    for (std::uint32_t y = 0; y < 128; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            const float px = ((static_cast<float>(x) + 0.5f) / 64 - 1), py = 1 - (static_cast<float>(y) + 0.5f) / 64;
            const Vec3 d = normalized(Vec3{px * half, py * half, -8});
            const float b = 8 * d.z, root = b * b - 63;
            if (root < 0.5f) continue;
            const Vec3 n = Vec3{0, 0, 8} + d * (-b - std::sqrt(root));
            const float facing = dot(n, sun) * 0.7071f;
            if (facing > 0.2f) {
                EXPECT_NEAR(gray_of(image.at(x, y)), facing, 0.03f + 0.04f * facing) << x << ", " << y;
            } else if (facing < -0.05f) {
                EXPECT_LT(gray_of(image.at(x, y)), 0.03f) << x << ", " << y;
            }
        }
    }
}

// The shadow of a wall that stands on the ground begins at its foot.
TEST_F(VulkanShadows, begin_where_things_stand) {
    const MaterialId white = add(paper());
    objects = {object_of(patch(4, [](float s, float t) { return Vec3{0, 0.5f * t, s - 0.5f}; }), white)};
    grounds = {{.material = white}};
    constexpr float side = 0.02f;  // m: a pixel is a fifth of a millimeter
    drawing.camera = from_above(side, 60);
    light_by(sun_alone(90, 45));
    const Image8 image = picture(100, 100);
    // The map's side: around a wall of 1 m by 0.5 m, in steps of a quarter of an octave.
    const float texel = 1.19f / 2048;
    const float full = std::sin(std::numbers::pi_v<float> / 4);
    for (std::uint32_t y = 10; y < 100; y += 20) {
        float begins = 1;
        for (std::uint32_t x = 0; x < 100; ++x) {
            const float at = (static_cast<float>(x) + 0.5f - 50) / 100 * side;
            if (gray_of(image.at(x, y)) < 0.5f * full) begins = at;
        }
        EXPECT_NEAR(begins, 0, 2 * texel) << "row " << y;
        EXPECT_LT(gray_of(image.at(20, y)), 0.05f * full);
        EXPECT_NEAR(gray_of(image.at(90, y)), full, 0.05f);
    }
}

TEST_F(VulkanShadows, are_cast_by_what_casts_them) {
    const MaterialId white = add(paper());
    objects = {object_of(level_sheet(0.5f, 0.5f), white)};
    grounds = {{.material = white}};
    drawing.camera = from_above(2, 40);
    light_by(sun_alone(90, 45));
    const auto shadow = [&] { return gray_of(picture(64, 64).at(pixel(-0.5f, 2, 64, 64), 32)); };
    EXPECT_LT(shadow(), 0.02f);
    objects[0].casts_shadow = false;
    EXPECT_NEAR(shadow(), std::sin(std::numbers::pi_v<float> / 4), 0.04f);
}

// Threads that cover half of the area pass half of the light, and less at an oblique angle.
TEST_F(VulkanShadows, of_sheer_cloth_are_lighter) {
    Material gauze = paper();
    gauze.coverage = 0.5f;
    objects = {object_of(level_sheet(0.8f, 0.5f), add(gauze))};
    grounds = {{.material = add(paper())}};
    drawing.camera = from_above(3, 40);
    light_by(sun_alone(90, 45));
    const Image8 image = picture(128, 128);
    float sum = 0;
    for (std::uint32_t y = 56; y < 72; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) sum += gray_of(image.at(pixel(-0.6f, 3, 128, 128) + x - 4, y)) / 128;
    const float part = sum / std::sin(std::numbers::pi_v<float> / 4);
    EXPECT_GT(part, 0.25f);
    EXPECT_LT(part, 0.6f);
}

}  // namespace
}  // namespace weft::render
