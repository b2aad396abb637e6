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
    for (int i = 0; i < 100; ++i) team.run([&](unsigned rank) { ++calls[rank]; });
    for (unsigned rank = 0; rank < calls.size(); ++rank) EXPECT_EQ(calls[rank], rank <= GetParam() ? 100 : 0) << rank;
}

TEST_P(Team, a_meeting_shows_every_rank_what_the_others_wrote) {
    WorkerTeam team(GetParam());
    std::vector<std::uint64_t> a(team.ranks(), 1), b(team.ranks());
    constexpr int rounds = 300;
    team.run([&](unsigned rank) {
        for (int i = 0; i < rounds; ++i) {
            b[rank] = std::accumulate(a.begin(), a.end(), std::uint64_t{0}) % 1000003;
            team.meet();
            a[rank] = b[(rank + 1) % team.ranks()] + 1;
            team.meet();
        }
    });
    // Every rank computes the same sum, so the result is that of one rank doing it alone.
    std::uint64_t expected = 1;
    for (int i = 0; i < rounds; ++i) expected = expected * team.ranks() % 1000003 + 1;
    for (std::uint64_t value : a) EXPECT_EQ(value, expected);
}

INSTANTIATE_TEST_SUITE_P(Workers, Team, testing::Values(0u, 1u, 2u, 4u));

TEST(Share, covers_everything_once_in_whole_units) {
    for (std::uint32_t count : {0u, 1u, 15u, 16u, 17u, 1000u, 4096u}) {
        for (unsigned ranks : {1u, 2u, 3u, 5u, 16u}) {
            std::uint32_t at = 0;
            for (unsigned rank = 0; rank < ranks; ++rank) {
                const Share share = share_of(count, 16, rank, ranks);
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
