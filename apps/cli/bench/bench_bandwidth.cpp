#include "base/aligned.h"
#include "base/workers.h"
#include "cli/bench/bench_reference.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>

namespace weft::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// Called through a volatile pointer, so that the compiler cannot merge equal copies.
void* (*volatile copy_bytes)(void*, const void*, std::size_t) = std::memcpy;

// The C library copies large pieces past the caches, medium ones with a special instruction, and small ones through
// registers. Which is fastest depends on the processor.
constexpr std::size_t pieces[] = {std::size_t{1} << 62, 2048};

constexpr std::size_t least_per_round = 4 << 20;  // bytes: enough to make clock resolution and thread start negligible

}  // namespace

double copy_bandwidth(unsigned threads, std::size_t bytes) {
    const auto lines = static_cast<std::uint32_t>(std::max<std::size_t>(bytes / 2 / cache_line, threads));
    const std::size_t half = std::size_t{lines} * cache_line;
    const auto passes = static_cast<std::uint32_t>(least_per_round / (2 * half) + 1);
    AlignedVector<char> from(half, 1), to(half, 2);
    WorkerTeam team(threads - 1);
    double best = 0;
    for (const std::size_t piece : pieces) {
        const auto begin = Clock::now();
        for (int round = 0; round < 2 || (round < 50 && Clock::now() - begin < 2ms); ++round) {
            const auto start = Clock::now();
            team.run([&](unsigned worker) {
                const Share share = share_of(lines, 1, worker, team.size());
                const std::size_t end = std::size_t{share.end} * cache_line;
                for (std::uint32_t pass = 0; pass < passes; ++pass) {
                    for (std::size_t at = std::size_t{share.begin} * cache_line; at < end;) {
                        const std::size_t size = std::min(piece, end - at);
                        copy_bytes(&to[at], &from[at], size);
                        at += size;
                    }
                }
            });
            const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
            best = std::max(best, 2 * static_cast<double>(half) * passes / std::max(seconds, 1e-9));
        }
    }
    return best;
}

std::size_t beyond_caches() {
    long last_cache = 0;
#ifdef _SC_LEVEL3_CACHE_SIZE
    last_cache = sysconf(_SC_LEVEL3_CACHE_SIZE);  // 0 or -1 if unknown
#endif
    constexpr long least = 64l << 20, most = 256l << 20;
    return static_cast<std::size_t>(std::clamp(last_cache, least / 2, most / 2) * 2);
}

}  // namespace weft::cli
