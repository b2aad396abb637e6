// Threads. The library starts no threads elsewhere.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// A non-owning reference to a callable object. Valid only during the call it is passed to.
template <class Signature>
class FunctionRef;
template <class R, class... Args>
class FunctionRef<R(Args...)> {
  public:
    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>) FunctionRef(F&& f)
        : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
          call_([](void* object, Args... args) -> R {
              return (*static_cast<std::remove_reference_t<F>*>(object))(args...);
          }) {}
    R operator()(Args... args) const { return call_(object_, args...); }

  private:
    void* object_;
    R (*call_)(void*, Args...);
};

/// The part of [0, count) that a worker processes: whole units, independent of timing.
struct Share {
    std::uint32_t begin, end;
};
constexpr Share share_of(std::uint32_t count, std::uint32_t unit, unsigned worker, unsigned workers) {
    if (workers == 1) return {0, count};  // the divisions below take longer than a pass over a small coarse level
    const std::uint64_t units = (std::uint64_t{count} + unit - 1) / unit;
    const auto bound = [&](unsigned r) {
        const std::uint64_t at = units * r / workers * unit;
        return static_cast<std::uint32_t>(at < count ? at : count);
    };
    return {bound(worker), bound(worker + 1)};
}

/// A fixed team of threads that run one task together. Worker 0 is the calling thread, so a team with 0 extra threads
/// starts no thread.
class WorkerTeam {
  public:
    explicit WorkerTeam(unsigned extra_threads = 0);
    ~WorkerTeam();
    WorkerTeam(const WorkerTeam&) = delete;
    WorkerTeam& operator=(const WorkerTeam&) = delete;

    /// Threads that take part: the workers and the caller.
    unsigned size() const { return size_; }

    /// Calls task(worker) once on every worker at the same time and returns when all have returned. Not reentrant.
    void run(FunctionRef<void(unsigned worker)> task);

    /// Call within a task: waits until every worker has called it. Writes before the barrier are visible after it.
    void barrier();

  private:
    void work(unsigned worker);
    void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) const;

    unsigned size_;
    unsigned spins_;
    FunctionRef<void(unsigned)>* task_ = nullptr;
    std::atomic<bool> quit_{false};
    alignas(64) std::atomic<std::uint32_t> round_{0};  // a new value wakes the workers
    alignas(64) std::atomic<std::uint32_t> arrived_{0};
    alignas(64) std::atomic<std::uint32_t> generation_{0};  // a new value opens the barrier
    std::vector<std::jthread> threads_;
};

/// Workers of a team of which the first one decides what all of them do. The first one calls lead(), all others help().
class LedTeam {
  public:
    /// The calling thread alone.
    LedTeam() = default;

    /// Calls decide(), which may call run(), and then lets the others return. `barrier`: of all workers.
    template <class Decide>
    void lead(unsigned size, const FunctionRef<void()>& barrier, Decide&& decide) {
        size_ = size, barrier_ = &barrier;
        decide();
        if (size == 1) return;
        task_ = nullptr;
        barrier();
        barrier();  // all have seen that there is no more to do, before the next leader sets a task
    }
    /// Runs the tasks of the leader until it has no more.
    void help(unsigned worker, const FunctionRef<void()>& barrier) const {
        while (true) {
            barrier();
            const auto* const task = task_;
            if (task) (*task)(worker);
            barrier();
            if (!task) return;
        }
    }

    unsigned size() const { return size_; }
    /// Calls work(worker) once on every worker at the same time and returns when all have returned.
    template <class Work>
    void run(Work&& work) const {
        if (size_ == 1) return work(0u);
        const FunctionRef<void(unsigned)> task(work);
        task_ = &task;
        (*barrier_)();
        work(0u);
        (*barrier_)();
    }
    /// Within such work: waits until every worker has called it.
    void wait() const {
        if (size_ > 1) (*barrier_)();
    }

  private:
    unsigned size_ = 1;
    const FunctionRef<void()>* barrier_ = nullptr;
    mutable const FunctionRef<void(unsigned)>* task_ = nullptr;  // null: there is no more to do
};

/// Work whose result is needed later. start() runs it on its own thread; if it was not started, wait() runs it.
class LaterWork {
  public:
    explicit LaterWork(std::function<void()> work) : work_(std::move(work)) {}
    LaterWork(const LaterWork&) = delete;
    LaterWork& operator=(const LaterWork&) = delete;

    void start();
    bool started() const { return thread_.joinable() || done(); }
    bool done() const { return done_.load(std::memory_order_acquire); }
    /// Returns when the work is done.
    void wait();

  private:
    void run();

    std::function<void()> work_;
    std::atomic<bool> done_{false};
    std::jthread thread_;  // last member: joined before the others are destroyed
};

}  // namespace weft
