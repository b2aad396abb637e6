#include "base/workers.h"

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace weft {
namespace {

void relax() {
#if defined(__x86_64__) || defined(__i386__)
    _mm_pause();
#endif
}

}  // namespace

WorkerTeam::WorkerTeam(unsigned workers) : ranks_(workers + 1) {
    // Passes last microseconds, a trip through the kernel as long: spinning pays, unless the threads share a core and
    // the one that spins keeps the one that works from running.
    spins_ = ranks_ <= std::thread::hardware_concurrency() ? 20000 : 0;
    threads_.reserve(workers);
    for (unsigned rank = 1; rank < ranks_; ++rank) threads_.emplace_back([this, rank] { work(rank); });
}

WorkerTeam::~WorkerTeam() {
    quit_.store(true, std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
}

void WorkerTeam::wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) const {
    for (unsigned i = 0; i < spins_; ++i) {
        if (value.load(std::memory_order_acquire) != old) return;
        relax();
    }
    while (value.load(std::memory_order_acquire) == old) value.wait(old, std::memory_order_acquire);
}

void WorkerTeam::meet() {
    if (ranks_ == 1) return;
    const std::uint32_t generation = generation_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == ranks_) {
        arrived_.store(0, std::memory_order_relaxed);
        generation_.store(generation + 1, std::memory_order_release);
        generation_.notify_all();
    } else {
        wait_for_change(generation_, generation);
    }
}

void WorkerTeam::run(FunctionRef<void(unsigned)> task) {
    if (ranks_ > 1) {
        task_ = &task;
        round_.fetch_add(1, std::memory_order_release);
        round_.notify_all();
    }
    task(0);
    meet();
}

void WorkerTeam::work(unsigned rank) {
    std::uint32_t seen = 0;
    while (true) {
        wait_for_change(round_, seen);
        ++seen;
        if (quit_.load(std::memory_order_relaxed)) return;
        (*task_)(rank);
        meet();
    }
}

void LaterWork::run() {
    work_();
    done_.store(true, std::memory_order_release);
}

void LaterWork::start() {
    thread_ = std::jthread([this] { run(); });
}

void LaterWork::wait() {
    if (thread_.joinable()) thread_.join();
    if (!done()) run();
}

}  // namespace weft
