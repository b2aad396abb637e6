// The only place where the library starts threads.
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

/// A reference to something callable, without an allocation. Valid only during the call it is passed to.
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

/// The share of [0, count) that a rank works on: whole units, the same whatever the machine is doing.
struct Share {
    std::uint32_t begin, end;
};
constexpr Share share_of(std::uint32_t count, std::uint32_t unit, unsigned rank, unsigned ranks) {
    const std::uint64_t units = (std::uint64_t{count} + unit - 1) / unit;
    const auto bound = [&](unsigned r) {
        const std::uint64_t at = units * r / ranks * unit;
        return static_cast<std::uint32_t>(at < count ? at : count);
    };
    return {bound(rank), bound(rank + 1)};
}

/// A fixed team of threads that work on one task together. Rank 0 is the calling thread itself, so a team of 0 workers
/// starts no thread at all.
class WorkerTeam {
  public:
    explicit WorkerTeam(unsigned workers = 0);
    ~WorkerTeam();
    WorkerTeam(const WorkerTeam&) = delete;
    WorkerTeam& operator=(const WorkerTeam&) = delete;

    /// Threads that take part: the workers and the caller.
    unsigned ranks() const { return ranks_; }

    /// Calls task(rank) once on every rank at the same time and returns when all have returned. Not reentrant.
    void run(FunctionRef<void(unsigned rank)> task);

    /// For use within a task: waits until every rank has come here. Everything written before is visible after.
    void meet();

  private:
    void work(unsigned rank);
    void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) const;

    unsigned ranks_;
    unsigned spins_;
    FunctionRef<void(unsigned)>* task_ = nullptr;
    std::atomic<bool> quit_{false};
    alignas(64) std::atomic<std::uint32_t> round_{0};  // a new value wakes the workers
    alignas(64) std::atomic<std::uint32_t> arrived_{0};
    alignas(64) std::atomic<std::uint32_t> generation_{0};  // a new value opens the barrier
    std::vector<std::jthread> threads_;
};

/// Work that is needed later: done on a thread of its own in the meantime or, if that was not started, when it is
/// waited for.
class LaterWork {
  public:
    explicit LaterWork(std::function<void()> work) : work_(std::move(work)) {}
    LaterWork(const LaterWork&) = delete;
    LaterWork& operator=(const LaterWork&) = delete;

    void start();
    bool started() const { return thread_.joinable() || done(); }
    bool done() const { return done_.load(std::memory_order_acquire); }
    /// The work is done when this returns.
    void wait();

  private:
    void run();

    std::function<void()> work_;
    std::atomic<bool> done_{false};
    std::jthread thread_;  // ends before the rest goes
};

}  // namespace weft
