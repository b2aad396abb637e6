// Every instruction set against one lane, constraint by constraint, on random and degenerate input: equal to the bit.
#include "cpu/passes.h"
#include "cpu/instruction_sets.test.h"

#include "solver/model/faces_around.h"

#include "base/aligned.h"
#include "physics/testing.h"
#include "solver/model/random_rows.test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace weft::cpu {
namespace {

using namespace instruction_sets;

constexpr float step = 1e-3f;  // s

void run_lines(const Passes& passes, Fixture& f, LambdaUse use) {
    AlignedVector<float> scratch(line_scratch_floats(longest_line), NAN);  // its previous content does not matter
    for (const Batch& batch : f.table.batches) {
        const auto blocks = std::span(f.table.blocks).subspan(batch.first_block, batch.blocks);
        passes.lines(f.view(), f.rows(), blocks, step, use, scratch.data());
    }
}

TEST_P(InstructionSet, projects_and_damps_every_constraint_alike) {
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        for (unsigned seed = 0; seed < 20; ++seed) {
            const bool degenerate = seed % 2;
            Fixture state = random_state(seed, degenerate);
            add_rows(state, static_cast<ConstraintKind>(kind), seed + 100, degenerate);
            for (const LambdaUse use : {LambdaUse::discard, LambdaUse::store, LambdaUse::accumulate}) {
                compare(state, [&](const Passes& passes, Fixture& f) {
                    for (const Batch& batch : f.table.batches) {
                        if (batch.serial) continue;
                        passes.project[kind](f.view(), f.rows(), {batch.begin, batch.padded_end()}, 1e-3f, use);
                    }
                });
            }
            if (!constraint_info(static_cast<ConstraintKind>(kind)).damped) continue;
            compare(state, [&](const Passes& passes, Fixture& f) {
                for (const Batch& batch : f.table.batches) {
                    if (!batch.serial) passes.damp[kind](f.view(), f.rows(), {batch.begin, batch.padded_end()}, 1e-3f);
                }
            });
        }
    }
}

// A constraint alone has no second particle to be relative to if it has one particle; stitches go over several cloths.
bool keeps_remainders(ConstraintKind kind) {
    const RowSource source = constraint_info(kind).source;
    return source == RowSource::model || source == RowSource::level;
}

TEST_P(InstructionSet, keeps_remainders_alike) {
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        if (!keeps_remainders(static_cast<ConstraintKind>(kind))) continue;
        for (unsigned seed = 0; seed < 10; ++seed) {
            Fixture state = random_state(seed, seed % 2);
            state.keep_remainders();
            add_rows(state, static_cast<ConstraintKind>(kind), seed + 100, seed % 2);
            compare(state, [&](const Passes& passes, Fixture& f) {
                for (const Batch& batch : f.table.batches)
                    if (!batch.serial)
                        passes.project[kind](f.view(), f.rows(), {batch.begin, batch.padded_end()}, step,
                                             LambdaUse::accumulate);
                passes.velocities(f.view(), {0, padded(particle_count)}, 100, step);
            });
        }
    }
}

// The remainders are far smaller than the displacements here, so both ways move particles alike.
TEST_P(InstructionSet, moves_particles_as_much_where_it_keeps_remainders) {
    const Passes& passes = *GetParam();
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        if (!keeps_remainders(static_cast<ConstraintKind>(kind))) continue;
        Fixture plain = random_state(2, false);
        add_rows(plain, static_cast<ConstraintKind>(kind), 102, false);
        Fixture exact = plain;
        exact.remainder.assign(exact.position.size(), Vec4{});
        const Batch& batch = plain.table.batches.front();
        const auto before = plain.position;
        for (Fixture* f : {&plain, &exact})
            passes.project[kind](f->view(), f->rows(), {batch.begin, batch.padded_end()}, step, LambdaUse::discard);
        double most = 0, moved = 0;
        for (std::uint32_t p = 0; p < particle_count; ++p) {
            most = std::max(most, double{length(plain.position[p].xyz() - exact.position[p].xyz())});
            moved = std::max(moved, double{length(plain.position[p].xyz() - before[p].xyz())});
        }
        EXPECT_LT(most, 1e-3 * moved + 1e-6) << constraint_info(static_cast<ConstraintKind>(kind)).name;
    }
}

TEST_P(InstructionSet, projects_plainly_and_side_by_side_alike) {
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        const RowSource source = constraint_info(static_cast<ConstraintKind>(kind)).source;
        if (source == RowSource::level) continue;
        for (unsigned seed = 0; seed < 10; ++seed) {
            const bool degenerate = seed % 2;
            Fixture state = random_state(seed, degenerate);
            add_rows(state, static_cast<ConstraintKind>(kind), seed + 100, degenerate);
            const bool plain_too = source != RowSource::dynamic;
            if (plain_too)
                compare(state, [&](const Passes& passes, Fixture& f) {
                    for (const Batch& batch : f.table.batches) {
                        if (!batch.serial)
                            passes.project_plain[kind](f.view(), f.rows(), {batch.begin, batch.padded_end()},
                                                       {0.3f, 0.8f});
                    }
                });
            if (source == RowSource::links) continue;
            // Stores corrections as positions, so that the comparison includes them.
            for (const bool plain : {false, true}) {
                compare(state, [&](const Passes& passes, Fixture& f) {
                    AlignedVector<Vec4> blocks(std::size_t{6} * f.table.stride);
                    const AlignedVector<float> share(f.table.stride, 0.25f);
                    const CorrectionView out{&blocks[0].x, plain ? nullptr : share.data(), {0.3f, 0.8f}};
                    const LambdaUse use = plain ? LambdaUse::discard : LambdaUse::accumulate;
                    passes.correct[kind](f.view(), f.rows(), out, {0, f.table.stride}, 1e-3f, use);
                    for (std::uint32_t p = 0; p < particle_count && p < f.table.stride; ++p) {
                        if (f.is_row(p)) f.start[p] = blocks[p];
                    }
                });
            }
        }
    }
}

TEST_P(InstructionSet, solves_lines_alike) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const bool degenerate = seed % 2;
        Fixture state = random_state(seed, degenerate);
        add_lines(state, seed + 100, degenerate);
        ASSERT_EQ(std::ranges::max(state.table.blocks, {}, &LineBlock::length).length, longest_line);
        ASSERT_GE(state.table.batches.front().blocks, 2u);
        ASSERT_GE(state.table.batches.size(), 3u);
        for (const LambdaUse use : {LambdaUse::discard, LambdaUse::store, LambdaUse::accumulate}) {
            compare(state, [&](const Passes& passes, Fixture& f) { run_lines(passes, f, use); });
            Fixture exact = state;
            exact.keep_remainders();
            compare(exact, [&](const Passes& passes, Fixture& f) { run_lines(passes, f, use); });
        }
        run_lines(*GetParam(), state, LambdaUse::store);
        // An enormous compliance may then meet the lambda of the other side's small one.
        for (int i = 0; i < 2 && !degenerate; ++i) run_lines(*GetParam(), state, LambdaUse::accumulate);
        for (std::uint32_t p = 0; p < particle_count; ++p) {
            ASSERT_TRUE(finite(state.position[p].xyz())) << "particle " << p << ", seed " << seed;
        }
        for (std::uint32_t p = particle_count; p < state.position.size(); ++p) EXPECT_EQ(state.position[p], Vec4{});
        for (const float lambda : state.lambda) ASSERT_TRUE(std::isfinite(lambda));
    }
}

// Lines near their rest lengths, so that no pull is limited.
Fixture calm_lines(unsigned seed) {
    Fixture f = random_state(seed, false);
    Numbers random(seed);
    Chains chains(random);
    const auto number = [&](float size) { return random.uniform(-size, size); };
    for (std::uint32_t p = 0; p < particle_count; ++p) {
        const Vec3 x = chains.at_rest[p] + Vec3{number(0.05f), number(0.05f), number(0.05f)};
        f.position[p] = {x.x, x.y, x.z, random.below(20) == 0 ? 0 : random.uniform(0.5f, 2)};
    }
    for (std::uint32_t r = 0; r < chains.rows.size(); ++r) {
        const std::uint32_t* ends = &chains.rows.particles[2 * r];
        const float distance = length(f.position[ends[0]].xyz() - f.position[ends[1]].xyz());
        const float compliance = random.below(9) == 0 ? -1 : random.uniform(1e-7f, 1e-6f);
        chains.rows.fields.insert(chains.rows.fields.end(),
                                  {distance + number(4e-3f), compliance, compliance, WEFT_NEVER_STRAIGHT});
    }
    f.table = chains.pack();
    for (std::uint32_t r = 0; r < f.table.stride; ++r) f.lambda.push_back(number(1e-4f));
    return f;
}

// Gauss' elimination of [matrix | right side]. Without pivots: the diagonal is the largest of its row, or nearly so.
std::vector<double> solve(std::vector<std::vector<double>> system) {
    const std::size_t n = system.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 1; j < n; ++j) {
            const double factor = system[j][i] / system[i][i];
            for (std::size_t k = i; k <= n; ++k) system[j][k] -= factor * system[i][k];
        }
    }
    std::vector<double> x(n);
    for (std::size_t i = n; i-- > 0;) {
        x[i] = system[i][n];
        for (std::size_t j = i + 1; j < n; ++j) x[i] -= system[i][j] * x[j];
        x[i] /= system[i][i];
    }
    return x;
}

// One Newton step for constraints that may share any particles, in double precision: (J W Jᵀ + regularization + α̃) Δλ
// = −(C + α̃ λ), Δx = W Jᵀ Δλ.
struct Newton {
    std::vector<double> change;
    std::vector<reference::vec3> moved = std::vector(particle_count, reference::vec3(0.0));

    Newton(const Fixture& f, std::span<const std::uint32_t> rows) {
        const std::size_t n = rows.size();
        const auto particle = [&](std::size_t i, int end) { return f.table.particles[end * f.table.stride + rows[i]]; };
        const auto weight = [&](std::size_t i, int end) { return double{f.position[particle(i, end)].w}; };
        const auto from_other = [&](std::size_t i, int end) {
            const Vec4 &a = f.position[particle(i, end)], &b = f.position[particle(i, 1 - end)];
            return reference::vec3(a.x, a.y, a.z) - reference::vec3(b.x, b.y, b.z);
        };
        const auto gradient = [&](std::size_t i, int end) {
            return from_other(i, end) * (1 / testing_kernels::norm(from_other(i, end)));
        };
        std::vector<std::vector<double>> system(n, std::vector<double>(n + 1));
        for (std::size_t i = 0; i < n; ++i) {
            const double w = weight(i, 0) + weight(i, 1), lambda = f.lambda[rows[i]];
            const double alpha = f.table.fields[f.table.stride + rows[i]] / (double{step} * step);
            if (w == 0 || alpha < 0) {  // a slack constraint undoes its lambda
                system[i][i] = 1, system[i][n] = w > 0 ? -lambda : 0;
                continue;
            }
            for (std::size_t j = 0; j < n; ++j) {
                for (const auto& [a, b] : {std::pair(0, 0), {0, 1}, {1, 0}, {1, 1}}) {
                    if (particle(i, a) == particle(j, b))
                        system[i][j] += weight(i, a) * reference::dot(gradient(i, a), gradient(j, b));
                }
            }
            const double rest = f.table.fields[rows[i]];
            const double out = testing_kernels::norm(from_other(i, 0)) - rest;
            system[i][i] += 1e-4 * w + std::max(alpha, w * std::min(0.1, std::abs(out) / rest));
            system[i][n] = -(out + alpha * lambda);
        }
        change = solve(std::move(system));
        for (std::size_t i = 0; i < n; ++i) {
            for (const int end : {0, 1}) {
                reference::vec3& x = moved[particle(i, end)];
                x = x + gradient(i, end) * (weight(i, end) * change[i]);
            }
        }
    }
};

TEST_P(InstructionSet, solves_the_system_of_all_rows_of_a_batch) {
    for (unsigned seed = 0; seed < 3; ++seed) {
        Fixture f = calm_lines(seed);
        f.table.batches.resize(1);
        const Fixture before = f;
        run_lines(*GetParam(), f, LambdaUse::accumulate);
        std::vector<std::uint32_t> rows;
        for (std::uint32_t r = 0; r < f.table.batches[0].padded_end(); ++r) {
            if (f.table.is_real(r)) rows.push_back(r);
        }
        const Newton expected(before, rows);
        double largest = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            ASSERT_NEAR(double{f.lambda[rows[i]]} - before.lambda[rows[i]], expected.change[i], 2e-5) << "row " << i;
            largest = std::max(largest, std::abs(expected.change[i]));
        }
        EXPECT_GT(largest, 1e-3) << "there is something to solve";
        for (std::uint32_t p = 0; p < particle_count; ++p) {
            const Vec3 moved = f.position[p].xyz() - before.position[p].xyz();
            const reference::vec3 off = expected.moved[p] - reference::vec3(moved.x, moved.y, moved.z);
            ASSERT_LT(testing_kernels::norm(off), 2e-5) << "particle " << p;
        }
    }
}

// The triangles at each particle; the first particles have so many that one packet stores separate lists.
Adjacency lists_of(const std::vector<std::uint32_t>& corners, std::uint32_t faces) {
    Adjacency lists{.offsets = {0}, .items = {}};
    for (std::uint32_t p = 0; p < particle_count; ++p) {
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            if (corners[i] == p || (p == 3 && i % 2 == 0)) lists.items.push_back(i % faces);
        }
        lists.offsets.push_back(static_cast<std::uint32_t>(lists.items.size()));
    }
    return lists;
}

TEST_P(InstructionSet, blows_and_pushes_alike) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Fixture state = random_state(seed, seed % 2);
        compare(state, [&](const Passes& passes, Fixture& f) {
            constexpr std::uint32_t faces = 128;
            Numbers random(seed);
            std::vector<std::uint32_t> corners(3 * faces);
            for (std::uint32_t& c : corners) c = random.below(particle_count);
            AlignedVector<float> mass(faces, 1e-4f);
            AlignedVector<Vec4> wind(faces), impulse(faces + 1), normals(padded(particle_count));
            const Adjacency lists = lists_of(corners, faces);
            const FacesAround abreast = lay_out_around(lists, faces);
            const AroundView around = view_of(abreast);
            const AirView air{.position = &f.position[0].x,
                              .velocity = &f.velocity[0].x,
                              .faces = corners.data(),
                              .stride = faces,
                              .mass = mass.data(),
                              .wind = &wind[0].x,
                              .sheltered = nullptr,
                              .impulse = &impulse[0].x,
                              .drag = 0.7f,
                              .lift = 0.4f,
                              .sine_lift = seed % 3 == 0,
                              .around = around};
            for (std::uint32_t kind = 0; kind < wind_kind_count; ++kind) {
                const WindNow now{.kind = static_cast<WindKind>(kind),
                                  .vectors = {Vec3{3, 1, 0}, Vec3{0, 0, 1}, Vec3{-0.3f, 0.9f, 0}},
                                  .numbers = {0.5f, 2, -1},
                                  .position = {0.1f, -0.2f, 0.3f},
                                  .axes = {},
                                  .edge = {1, 2, 3},
                                  .per_border = 0.7f,
                                  .strength = 1.3f,
                                  .gust = 0.3f,
                                  .gust_turns = 5.3f,
                                  .gust_per_meter = 0.25f,
                                  .scattered = seed % 4 == 0,
                                  .turbulence = 0.4f,
                                  .noise_per_meter = 2,
                                  .noise_time = 7.2f,
                                  .noise_offset = {1, 2, 3}};
                passes.wind[kind](air, now, kind == 0, {0, faces});
            }
            passes.air(air, {0, faces}, 1e-3f);
            passes.push(f.view(), air, {0, particle_count});
            passes.normals({&f.position[0].x, corners.data(), faces, &impulse[0].x, around, &normals[0].x},
                           {0, particle_count});
            for (std::uint32_t t = 0; t < faces; ++t) f.start[t] = impulse[t], f.compensation[t] = wind[t];
            for (std::uint32_t p = 0; p < particle_count; ++p) f.position[p] = normals[p];
        });
    }
}

TEST_P(InstructionSet, padding_rows_touch_no_particle) {
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        RowList rows = make_rows(static_cast<ConstraintKind>(kind));
        for (std::uint32_t slot = 0; slot < rows.arity; ++slot) rows.particles.push_back(slot);
        rows.fields.assign(rows.field_count, 0.5f);
        Fixture state = random_state(7, false);
        state.table = pack_rows(static_cast<ConstraintKind>(kind), rows, particle_count, {.min_rows = 1});
        state.lambda.assign(std::size_t{constraint_info(state.table.kind).lambdas} * state.table.stride, 0);
        const Fixture before = state;
        for (const Batch& batch : state.table.batches) {
            GetParam()->project[kind](state.view(), state.rows(), {batch.begin, batch.padded_end()}, 1e-3f,
                                      LambdaUse::store);
        }
        for (std::uint32_t p = rows.arity; p < particle_count; ++p) EXPECT_EQ(state.position[p], before.position[p]);
        for (std::uint32_t p = particle_count; p < state.position.size(); ++p) EXPECT_EQ(state.position[p], Vec4{});
    }
}

TEST_P(InstructionSet, moves_particles_alike) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Fixture state = random_state(seed, seed % 2);
        compare(state, [&](const Passes& passes, Fixture& f) {
            const Range all{0, padded(particle_count)};
            for (int i = 0; i < 3; ++i) {
                const float max_speed = seed % 3 == 0 ? 2.0f : 200.0f;  // the lower one caps many particles
                passes.predict(f.view(), all, {0.1f, -9.81f, 0.3f}, max_speed, 1e-3f);
                passes.velocities(f.view(), all, max_speed, 1e-3f);
            }
        });
    }
}

TEST_P(InstructionSet, ends_a_substep_and_begins_the_next_in_one) {
    const Range all{0, padded(particle_count)};
    const Vec3 gravity{0.1f, -9.81f, 0.3f};
    for (unsigned seed = 0; seed < 20; ++seed) {
        Fixture one = random_state(seed, seed % 2), other = one;
        const bool capped = GetParam()->velocities(one.view(), all, 20.0f, 1e-3f);
        const bool capped_then = GetParam()->predict(one.view(), all, gravity, 20.0f, 1e-3f);
        EXPECT_EQ(GetParam()->advance(other.view(), all, gravity, 20.0f, 1e-3f), capped || capped_then);
        expect_same(one.position, other.position, "position");
        expect_same(one.start, other.start, "start");
        expect_same(one.velocity, other.velocity, "velocity");
        expect_same(one.compensation, other.compensation, "compensation");
    }
}

TEST_P(InstructionSet, carries_nodes_to_particles_alike_whatever_their_numbers_take) {
    const Fixture state = random_state(3, false);
    const std::uint32_t stride = padded(particle_count), nodes = 50;
    std::mt19937 random(9);
    const auto below = [&](std::uint32_t end) {
        return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(random);
    };
    AlignedVector<Vec4> displacement(nodes);
    for (Vec4& d : displacement)
        d = {static_cast<float>(below(100)), static_cast<float>(below(100)), 0.1f * static_cast<float>(below(100)), 0};
    AlignedVector<std::uint16_t> narrow(std::size_t{Prolongation::parents} * stride);
    AlignedVector<float> weight(narrow.size());
    for (std::size_t i = 0; i < narrow.size(); ++i) {
        narrow[i] = static_cast<std::uint16_t>(below(nodes));
        weight[i] = 0.01f * static_cast<float>(below(100));
    }
    const AlignedVector<std::uint32_t> wide(narrow.begin(), narrow.end());
    const ProlongationView short_numbers{&displacement[0].x, stride, narrow.data(), nullptr, weight.data()},
        long_numbers{&displacement[0].x, stride, nullptr, wide.data(), weight.data()};
    const auto spread = [&](const Passes& passes, const ProlongationView& prolongation) {
        Fixture f = state;
        passes.prolongation(f.view(), prolongation, {0, stride});
        return f.position;
    };
    const auto one_by_one = spread(scalar_passes(), long_numbers);
    EXPECT_NE(one_by_one[0], state.position[0]);
    expect_same(spread(*GetParam(), short_numbers), one_by_one, "16 bits");
    expect_same(spread(*GetParam(), long_numbers), one_by_one, "32 bits");
}

TEST_P(InstructionSet, weighs_nodes_as_the_particles_they_stand_for) {
    constexpr std::uint32_t nodes = 2 * lane_padding, particles = 100, members = 5;
    std::mt19937 random(11);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    AlignedVector<Vec4> finer(particles), origin(nodes), position(nodes), displacement(nodes);
    AlignedVector<float> free(particles), part(members * nodes, 1.0f / members), node_weight(nodes, 4);
    AlignedVector<std::uint32_t> node(part.size());
    for (std::uint32_t p = 0; p < particles; ++p) {
        free[p] = static_cast<float>(1 + below(50));
        finer[p] = {0, 0, 0, p % 7 == 0 ? 0 : free[p] / static_cast<float>(1 + below(200))};
    }
    for (std::uint32_t& particle : node) particle = below(particles);
    const AlignedVector<std::uint32_t> begin{0, members, 2 * members};
    const LevelView level{&position[0].x, &origin[0].x, &displacement[0].x, nullptr,     begin.data(),
                          node.data(),    part.data(),  node_weight.data(), free.data(), true};
    const auto weigh = [&](const Passes& passes) {
        passes.restriction(&finer[0].x, level, {0, nodes});
        passes.interpolation(level, {}, {0, nodes});
        return position;
    };
    const auto one_by_one = weigh(scalar_passes());
    for (std::uint32_t i = 0; i < nodes; ++i) {
        double ratio = 0;  // a particle that was pinned since the levels were built has its own mass
        for (std::uint32_t k = 0; k < members; ++k) {
            const std::uint32_t p = node[(i / lane_padding * members + k) * lane_padding + i % lane_padding];
            ratio += (finer[p].w > 0 ? double{free[p]} / double{finer[p].w} : 1) / members;
        }
        EXPECT_NEAR(one_by_one[i].w, 4 / ratio, 1e-5) << i;
    }
    const auto abreast = weigh(*GetParam());
    for (std::uint32_t i = 0; i < nodes; ++i) EXPECT_EQ(abreast[i].w, one_by_one[i].w) << i;
}

TEST_P(InstructionSet, notices_what_is_not_finite) {
    AlignedVector<float> data(64, 1.0f);
    EXPECT_TRUE(GetParam()->all_finite(data.data(), 0, 64));
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        for (std::size_t i = 0; i < 64; ++i) {
            data[i] = bad;
            EXPECT_FALSE(GetParam()->all_finite(data.data(), 0, 64)) << bad << " at " << i;
            data[i] = 1;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isa, InstructionSet, testing::ValuesIn(available_passes().begin(), available_passes().end()),
                         name_of);

}  // namespace
}  // namespace weft::cpu
