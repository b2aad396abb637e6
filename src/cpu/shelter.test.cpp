// Shelter from the wind on every instruction set against one lane.
#include "cpu/passes.h"
#include "cpu/sample_shapes.test.h"

#include "base/aligned.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace weft::cpu {
namespace {

constexpr std::uint32_t blown_faces = 256, blown_particles = 64;

struct BlownFaces {
    AlignedVector<Vec4> position{blown_particles}, wind{blown_faces}, sum{blown_faces};
    std::vector<std::uint32_t> corners = std::vector<std::uint32_t>(3 * blown_faces);

    explicit BlownFaces(unsigned seed, float scale) {
        std::mt19937 random(seed);
        const auto number = [&] { return static_cast<float>(random() % 2001) / 1000 - 1; };
        for (Vec4& p : position) p = {scale * number(), scale * number(), scale * number(), 1};
        for (std::uint32_t& c : corners) c = random() % blown_particles;
        for (Vec4& u : wind) u = {number(), number(), number(), 1};
        for (std::uint32_t i = 0; i < blown_faces; i += 7) wind[i] = {0, 0, 0, 1};
        for (std::uint32_t i = 0; i < blown_faces; i += 5) wind[i] = {0, 0, -3, 1};
    }

    AirView view() {
        return {.position = &position[0].x,
                .velocity = nullptr,
                .faces = corners.data(),
                .stride = blown_faces,
                .mass = nullptr,
                .wind = &sum[0].x,
                .sheltered = &wind[0].x,
                .impulse = nullptr,
                .drag = 0,
                .lift = 0,
                .sine_lift = false,
                .around = {}};
    }
};

TEST(ShelterPass, gives_every_shape_the_same_shelter_on_every_instruction_set) {
    for (std::uint32_t shape = 0; shape < shape_kind_count; ++shape) {
        std::uint32_t hits = 0;
        for (unsigned seed = 0; seed < 12; ++seed) {
            const ContactView collider{.kind = static_cast<int>(shape),
                                       .numbers = {0.6f, 0.64f, 0.48f, 0.1f},
                                       .data = sample_blocks(shape),
                                       .steepness = seed % 2 ? 1.5f : 1.0f,
                                       .roundness = 0,
                                       .width = 1,
                                       .now = {rotation_from_degrees({10, 20, 30}), {0.1f, 0.2f, 0.3f}},
                                       .before = {},
                                       .static_friction = 0,
                                       .kinetic_friction = 0,
                                       .thickness = {.half = 0},
                                       .depenetration = 0};
            const float scale = seed == 10 ? 1e6f : seed == 11 ? 1e-6f : 3.0f;
            const auto run = [&](const Passes& passes) {
                BlownFaces faces(seed, scale);
                passes.shelter(faces.view(), collider, seed == 9 ? 1e6f : 2.0f, {0, blown_faces});
                passes.add_sheltered(faces.view(), true, {0, blown_faces});
                passes.add_sheltered(faces.view(), false, {0, blown_faces});
                return faces;
            };
            const BlownFaces expected = run(scalar_passes());
            for (const Vec4& u : expected.wind) hits += u.w == 0;
            for (const Passes* passes : available_passes()) {
                const BlownFaces found = run(*passes);
                for (std::uint32_t t = 0; t < blown_faces; ++t) {
                    ASSERT_EQ(found.wind[t], expected.wind[t]) << passes->isa << ", shape " << shape << ", face " << t;
                    ASSERT_EQ(found.sum[t], expected.sum[t]) << passes->isa << ", shape " << shape << ", face " << t;
                }
            }
        }
        EXPECT_GT(hits, 100u) << "shape " << shape;
        EXPECT_LT(hits, 12 * blown_faces) << "shape " << shape;
    }
}

}  // namespace
}  // namespace weft::cpu
