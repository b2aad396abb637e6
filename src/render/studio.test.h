// For the tests of this folder: a renderer with validation layers, meshes from formulas, and the light of pixels.
#pragma once

#include "gpu/test_device.h"
#include "render/host_mesh.h"
#include "render/renderer.h"
#include "render/shading/tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <optional>
#include <vector>

namespace weft::render {

struct Shape {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<Vec4> tangents;
    std::vector<Triangle> triangles;
};

/// A mesh of the positions `at(s, t)`, with s and t in 0…1. On the front side, s and t run counterclockwise; u is s,
/// v is t.
template <class At>
Shape patch(std::uint32_t cells, At&& at) {
    Shape shape;
    constexpr float h = 1e-3f;
    for (std::uint32_t j = 0; j <= cells; ++j) {
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const float s = static_cast<float>(i) / static_cast<float>(cells),
                        t = static_cast<float>(j) / static_cast<float>(cells);
            const Vec3 along_s = at(s + h, t) - at(s - h, t), along_t = at(s, t + h) - at(s, t - h);
            const Vec3 tangent = normalized(along_s);
            shape.positions.push_back(at(s, t));
            shape.normals.push_back(normalized(cross(along_s, along_t)));
            shape.uvs.push_back({s, t});
            shape.tangents.push_back({tangent.x, tangent.y, tangent.z, 1});
        }
    }
    for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 2, d = a + cells + 1;
            shape.triangles.push_back({a, b, c});
            shape.triangles.push_back({a, c, d});
        }
    }
    return shape;
}

/// Level, facing up, around (0, height, 0); u along x, v along -z.
inline Shape level_sheet(float side, float height, std::uint32_t cells = 4) {
    return patch(cells, [=](float s, float t) { return Vec3{side * (s - 0.5f), height, side * (0.5f - t)}; });
}

inline Lighting no_light() {
    Lighting light;
    light.sun.intensity = 0;
    light.sky.intensity = 0;
    light.ambient_occlusion = 0;
    return light;
}

/// The same white from everywhere.
inline Lighting furnace() {
    Lighting light = no_light();
    light.sky = {.intensity = 1, .zenith = {1, 1, 1}, .horizon = {1, 1, 1}, .ground = {1, 1, 1}};
    return light;
}

/// Only a white sun.
inline Lighting sun_alone(float azimuth, float elevation, float size = 0.53f) {
    Lighting light = no_light();
    light.sun = {
        .azimuth = azimuth, .elevation = elevation, .intensity = 1, .color = {1, 1, 1}, .angular_diameter = size};
    return light;
}

/// A diffuse surface without gloss: F0 is 0.
inline Material paper(float share = 1) {
    return {.color = {share, share, share},
            .weft_color = {share, share, share},
            .specular = 0,
            .roughness = {1, 1},
            .weave_depth = 0};
}

/// A camera that looks straight down on (0, 0, 0); +x is to the right, +z is down. `side`: height of the image in m, on
/// the ground.
inline Camera from_above(float side, float height = 10) {
    const float fov = 2 * std::atan(0.5f * side / height) * 180 / 3.14159265f;
    return {.position = {0, height, 0}, .target = {0, 0, 0}, .fov = fov};
}

/// The light of a pixel: the inverse of shading/tone.h, for colors below the compressed range.
inline Vec3 light_of(const std::uint8_t* pixel) {
    glm::vec3 c(0);
    for (int i = 0; i < 3; ++i) c[i] = weft::shading::srgb_decoded(static_cast<float>(pixel[i]) / 255);
    const float least = std::min(c.x, std::min(c.y, c.z));
    const float taken = least >= 0.04f ? 0.04f : std::sqrt(least / 6.25f) - least;
    return {c.x + taken, c.y + taken, c.z + taken};
}

inline float gray_of(const std::uint8_t* pixel) {
    const Vec3 light = light_of(pixel);
    return (light.x + light.y + light.z) / 3;
}

/// Mean light of a part of an image, from pixel (x, y) on.
inline Vec3 mean_light(const Image8& image, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                       std::uint32_t height) {
    Vec3 sum{};
    for (std::uint32_t j = y; j < y + height; ++j)
        for (std::uint32_t i = x; i < x + width; ++i) sum += light_of(image.at(i, j));
    return sum / static_cast<float>(width * height);
}

inline Vec3 mean_light(const Image8& image) {
    return mean_light(image, 0, 0, image.width, image.height);
}

/// The largest difference of two images at one pixel, and the number of pixels that differ by more than `much`.
struct Difference {
    int largest = 0;
    std::size_t beyond = 0;
};

inline Difference difference(const Image8& a, const Image8& b, int much = 1) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    Difference found;
    for (std::size_t i = 0; i + 3 < std::min(a.rgba.size(), b.rgba.size()); i += 4) {
        int here = 0;
        for (std::size_t c = i; c < i + 4; ++c) here = std::max(here, std::abs(int{a.rgba[c]} - int{b.rgba[c]}));
        found.largest = std::max(found.largest, here);
        found.beyond += here > much;
    }
    return found;
}

/// A renderer with a drawing and its objects.
class VulkanPictures : public gpu::OnDevice {
  protected:
    void SetUp() override {
        OnDevice::SetUp();
        if (HasFatalFailure()) return;
        open();
        if (HasFatalFailure()) return;
        start();
        drawing.camera = {.position = {0, 0, 3}, .target = {0, 0, 0}, .fov = 40};
    }
    void TearDown() override {
        meshes.clear();
        renderer.reset();
        OnDevice::TearDown();
    }

    void start(std::uint32_t samples = 4) {
        renderer.reset();
        auto made = Renderer::create(device, {.samples = samples});
        ASSERT_TRUE(made.ok()) << made.error().message();
        renderer.emplace(std::move(*made));
    }
    MaterialId add(const Material& material, const Image8* color_map = nullptr, const Image8* normal_map = nullptr) {
        auto id = renderer->add(material, color_map, normal_map);
        EXPECT_TRUE(id.ok()) << id.error().message();
        return id.ok() ? *id : 0;
    }
    /// The mesh stays on the device until the end of the test.
    Object object_of(const Shape& shape, MaterialId material) {
        auto mesh = HostMesh::create(*device, static_cast<std::uint32_t>(shape.positions.size()), shape.triangles,
                                     shape.uvs, {}, "shape");
        EXPECT_TRUE(mesh.ok()) << mesh.error().message();
        if (!mesh) return {};
        meshes.push_back(std::move(*mesh));
        EXPECT_TRUE(meshes.back().update(shape.positions, shape.normals, shape.tangents).ok());
        Object object;
        object.surface = meshes.back().surface();
        object.material = material;
        return object;
    }
    void light_by(const Lighting& light, const ImageF* environment = nullptr) {
        drawing.lighting = light;
        const auto done = renderer->surround(light, environment);
        ASSERT_TRUE(done.ok()) << done.error().message();
    }
    Image8 picture(std::uint32_t width = 96, std::uint32_t height = 54) {
        drawing.objects = objects;
        drawing.grounds = grounds;
        auto made = renderer->picture(drawing, width, height);
        EXPECT_TRUE(made.ok()) << made.error().message();
        return made.ok() ? std::move(*made) : Image8{width, height, std::vector<std::uint8_t>(width * height * 4)};
    }

    std::optional<Renderer> renderer;
    std::deque<HostMesh> meshes;
    std::vector<Object> objects;
    std::vector<Ground> grounds;
    Drawing drawing;
};

}  // namespace weft::render
