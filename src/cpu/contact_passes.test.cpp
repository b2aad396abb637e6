// Contact with every shape: every instruction set against one lane, on random and degenerate input: equal to the bit.
#include "cpu/instruction_sets.test.h"
#include "cpu/passes.h"
#include "cpu/sample_shapes.test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <random>

namespace weft::cpu {
namespace {

using namespace instruction_sets;

class ContactPasses : public InstructionSet {};

TEST_P(ContactPasses, touches_every_shape_alike) {
    const Pose here{rotation_from_degrees({10, 20, 30}), {0.1f, 0.2f, 0.3f}};
    const Pose there{rotation_from_degrees({11, 19, 30}), {0.1f, 0.19f, 0.3f}};
    for (std::uint32_t shape = 0; shape < shape_kind_count; ++shape) {
        for (unsigned seed = 0; seed < 20; ++seed) {
            const Fixture state = random_state(seed, seed % 2);
            compare(state, [&](const Passes& passes, Fixture& f) {
                AlignedVector<Vec4> sums(f.position.size());
                AlignedVector<float> factors(f.position.size());
                for (std::size_t p = 0; p < factors.size(); ++p) factors[p] = 0.2f + static_cast<float>(p % 7);
                ContactView view{.kind = static_cast<int>(shape),
                                 .numbers = {0.6f, 0.64f, 0.48f, 0.1f},
                                 .data = sample_blocks(shape),
                                 .steepness = 1,
                                 .roundness = 0,
                                 .width = 1,
                                 .now = here,
                                 .before = there,
                                 .static_friction = 0.4f,
                                 .kinetic_friction = 0.3f,
                                 .thickness = {0.001f, seed % 3 ? nullptr : factors.data()},
                                 .depenetration = 0.0008f,
                                 .sums = &sums[0].x,
                                 .first_iteration = true};
                const Range all{0, padded(particle_count)};
                passes.contact[shape](f.view(), view, all);
                view.first_iteration = false;
                passes.contact[shape](f.view(), view, all);
                view.sums = nullptr;
                passes.contact[shape](f.view(), view, all);
            });
        }
    }
}

// In the frame of the shape: at its center, on its faces, edges and corners, very close to them and very far away.
// Without -0: a particle that nothing touches may become +0 if another lane of its group is touched.
TEST_P(ContactPasses, touches_every_shape_alike_at_degenerate_places) {
    const float subnormal = 1e-40f;
    for (std::uint32_t shape = 0; shape < shape_kind_count; ++shape) {
        for (const float size : {0.5f, 1e-6f, 1e6f, 1e-30f}) {
            const float places[] = {0,        size,      -size,      size / 2, std::nextafter(size, 0.0f),
                                    2 * size, subnormal, -subnormal, 1e-20f,   1e6f,
                                    -1e15f,   0.6f};
            for (unsigned seed = 0; seed < 6; ++seed) {
                Fixture state = random_state(seed, true);
                std::mt19937 random(seed);
                const auto place = [&] { return places[random() % std::size(places)]; };
                for (std::size_t p = 0; p < state.position.size(); ++p) {
                    Vec4& x = state.position[p];
                    x.x = place(), x.y = place(), x.z = place();
                    if (p % 2) continue;
                    Vec4& start = state.start[p];
                    start.x = place(), start.y = place(), start.z = place();
                }
                compare(state, [&](const Passes& passes, Fixture& f) {
                    AlignedVector<Vec4> sums(f.position.size());
                    // Thickness makes the distances of points outside count too.
                    const ContactView view{.kind = static_cast<int>(shape),
                                           .numbers = {size, seed % 2 ? size : size / 2, size, size / 4},
                                           .data = sample_blocks(shape),
                                           .steepness = 1,
                                           .roundness = 0,
                                           .width = 1,
                                           .now = {},
                                           .before = {},
                                           .static_friction = 0.4f,
                                           .kinetic_friction = 0.3f,
                                           .thickness = {seed % 3 ? 2 * size : 1e7f},
                                           .depenetration = 0.0008f,
                                           .sums = &sums[0].x,
                                           .first_iteration = true};
                    passes.contact[shape](f.view(), view, {0, padded(particle_count)});
                });
                if (HasFatalFailure()) FAIL() << "shape " << shape << ", size " << size << ", seed " << seed;
            }
        }
    }
}

TEST_P(ContactPasses, keeps_the_same_account_of_contacts_and_moves_nothing_else_by_it) {
    const Range all{0, padded(particle_count)};
    for (std::uint32_t shape = 0; shape < shape_kind_count; ++shape) {
        for (unsigned seed = 0; seed < 10; ++seed) {
            const Fixture state = random_state(seed, seed % 2);
            AlignedVector<Vec4> sums(state.position.size());
            ContactView view{.kind = static_cast<int>(shape),
                             .numbers = {0.6f, 0.8f, 0.3f, 0.1f},
                             .data = sample_blocks(shape),
                             .steepness = 1,
                             .roundness = 0,
                             .width = 1,
                             .now = {rotation_from_degrees({10, 20, 30}), {0.1f, 0.2f, 0.3f}},
                             .before = {rotation_from_degrees({11, 19, 30}), {0.1f, 0.19f, 0.3f}},
                             .static_friction = 0.4f,
                             .kinetic_friction = 0.3f,
                             .thickness = {0.001f},
                             .depenetration = 0.0008f,
                             .sums = &sums[0].x,
                             .first_iteration = true};
            const auto traced = [&](const Passes& passes, Fixture& f, AlignedVector<Vec4>& moved,
                                    AlignedVector<Vec4>& turned) {
                moved.assign(f.position.size(), {});
                turned = moved;
                view.moved = &moved[0].x;
                view.turned = &turned[0].x;
                for (const bool first : {true, false}) {
                    view.first_iteration = first;
                    passes.contact_traced[shape](f.view(), view, all);
                }
            };
            Fixture plain = state, ours = state, theirs = state;
            for (const bool first : {true, false}) {
                view.first_iteration = first;
                GetParam()->contact[shape](plain.view(), view, all);
            }
            AlignedVector<Vec4> moved, turned, scalar_moved, scalar_turned;
            traced(*GetParam(), ours, moved, turned);
            traced(scalar_passes(), theirs, scalar_moved, scalar_turned);
            expect_same(ours.position, plain.position, "position");
            expect_same(moved, scalar_moved, "moved");
            expect_same(turned, scalar_turned, "turned");
            if (seed % 2) continue;
            std::uint32_t touched = 0;
            for (std::uint32_t p = 0; p < particle_count; ++p) {
                const Vec3 by = ours.position[p].xyz() - state.position[p].xyz();
                EXPECT_LT(length(moved[p].xyz() - by), 1e-5f);
                touched += by != Vec3();
            }
            EXPECT_GT(touched, 0u);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isa, ContactPasses, testing::ValuesIn(available_passes().begin(), available_passes().end()),
                         name_of);

}  // namespace
}  // namespace weft::cpu
