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

WorkerTeam::WorkerTeam(unsigned extra_threads) : size_(extra_threads + 1) {
    // A pass takes microseconds, as long as a wait in the kernel, so spinning is faster. Do not spin if threads share a
    // core: a spinning thread would keep a working thread from running.
    spins_ = size_ <= std::thread::hardware_concurrency() ? 20000 : 0;
    threads_.reserve(extra_threads);
    for (unsigned worker = 1; worker < size_; ++worker) threads_.emplace_back([this, worker] { work(worker); });
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

void WorkerTeam::barrier() {
    if (size_ == 1) return;
    const std::uint32_t generation = generation_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
        arrived_.store(0, std::memory_order_relaxed);
        generation_.store(generation + 1, std::memory_order_release);
        generation_.notify_all();
    } else {
        wait_for_change(generation_, generation);
    }
}

void WorkerTeam::run(FunctionRef<void(unsigned)> task) {
    if (size_ > 1) {
        task_ = &task;
        round_.fetch_add(1, std::memory_order_release);
        round_.notify_all();
    }
    task(0);
    barrier();
}

void WorkerTeam::work(unsigned worker) {
    std::uint32_t seen = 0;
    while (true) {
        wait_for_change(round_, seen);
        ++seen;
        if (quit_.load(std::memory_order_relaxed)) return;
        (*task_)(worker);
        barrier();
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
