// Labels of this file: threads

#include "base/workers.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace weft {
namespace {

class Team : public testing::TestWithParam<unsigned> {};

TEST_P(Team, runs_every_rank_once_per_task) {
    WorkerTeam team(GetParam());
    std::array<int, 16> calls{};
    for (int i = 0; i < 100; ++i) team.run([&](unsigned worker) { ++calls[worker]; });
    for (unsigned worker = 0; worker < calls.size(); ++worker)
        EXPECT_EQ(calls[worker], worker <= GetParam() ? 100 : 0) << worker;
}

TEST_P(Team, a_meeting_shows_every_rank_what_the_others_wrote) {
    WorkerTeam team(GetParam());
    std::vector<std::uint64_t> a(team.size(), 1), b(team.size());
    constexpr int rounds = 300;
    team.run([&](unsigned worker) {
        for (int i = 0; i < rounds; ++i) {
            b[worker] = std::accumulate(a.begin(), a.end(), std::uint64_t{0}) % 1000003;
            team.barrier();
            a[worker] = b[(worker + 1) % team.size()] + 1;
            team.barrier();
        }
    });
    // Every worker computes the same sum, so the result is that of a single worker.
    std::uint64_t expected = 1;
    for (int i = 0; i < rounds; ++i) expected = expected * team.size() % 1000003 + 1;
    for (std::uint64_t value : a) EXPECT_EQ(value, expected);
}

TEST_P(Team, runs_what_the_first_worker_decides) {
    WorkerTeam team(GetParam());
    const auto wait = [&] { team.barrier(); };
    const FunctionRef<void()> barrier(wait);
    LedTeam led;
    std::vector<int> calls(team.size()), seen(team.size());
    team.run([&](unsigned worker) {
        for (int pass = 0; pass < 50; ++pass) {
            if (worker != 0) {
                led.help(worker, barrier);
                continue;
            }
            led.lead(team.size(), barrier, [&] {
                for (int task = 0; task < pass % 3; ++task) {
                    led.run([&](unsigned of_task) {
                        ++calls[of_task];
                        led.wait();
                        seen[of_task] += std::accumulate(calls.begin(), calls.end(), 0);
                    });
                }
            });
        }
    });
    // 0, 1, 2, 0, 1, 2, …: 49 tasks, and after each of them all workers have been called equally often.
    const int all = static_cast<int>(team.size()) * 49 * 50 / 2;
    for (unsigned worker = 0; worker < team.size(); ++worker) {
        EXPECT_EQ(calls[worker], 49);
        EXPECT_EQ(seen[worker], all);
    }
}

TEST(LedTeam, runs_tasks_of_the_calling_thread_alone) {
    int calls = 0;
    LedTeam().run([&](unsigned worker) { calls += worker == 0 ? 1 : 100; });
    EXPECT_EQ(calls, 1);
}

INSTANTIATE_TEST_SUITE_P(Workers, Team, testing::Values(0u, 1u, 2u, 4u));

TEST(Share, covers_everything_once_in_whole_units) {
    for (std::uint32_t count : {0u, 1u, 15u, 16u, 17u, 1000u, 4096u}) {
        for (unsigned workers : {1u, 2u, 3u, 5u, 16u}) {
            std::uint32_t at = 0;
            for (unsigned worker = 0; worker < workers; ++worker) {
                const Share share = share_of(count, 16, worker, workers);
                EXPECT_EQ(share.begin, at);
                EXPECT_TRUE(share.begin % 16 == 0 || share.begin == count);
                at = share.end;
            }
            EXPECT_EQ(at, count);
        }
    }
}

}  // namespace
}  // namespace weft
