// Logs the contacts of a cloth on the CPU during a frame.
#pragma once

#include "base/aligned.h"
#include "base/workers.h"
#include "solver/state/contact_forces.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

class ContactAccount {
  public:
    /// Allocates; nothing if there are no colliders. Only prepare() and collect() allocate, on the calling thread.
    void prepare(std::size_t colliders, std::size_t capacity, unsigned workers);

    bool empty() const { return moved_.empty(); }
    /// Blocks of four per particle (ContactTrace).
    float* moved(std::size_t collider) { return &moved_[collider * capacity_].x; }
    float* turned(std::size_t collider) { return &turned_[collider * capacity_].x; }

    /// Sums the contacts of a worker's particles. `mine` must not contain anchors; `position` must not change until
    /// collect(). Lists only as many contacts as there is room for, so that it does not allocate; the sums are
    /// complete.
    void count(unsigned worker, Share mine, std::span<const Vec4> position, float inv_h);
    /// Collects the contacts of all workers, all of them: allocates more room if a list was full. The lists in `to`
    /// stay valid until the call after the next.
    void collect(ClothContactLog& to);

  private:
    /// Aligned so that no two workers share a cache line.
    struct alignas(cache_line) Part {
        std::vector<ContactRecord> contacts;  ///< as many as there is room for
        std::vector<std::size_t> begin;       ///< start of each collider's contacts among all, then their number
        std::vector<ImpulseSum> sums;         ///< per collider
        // Arguments of count(), for listing again in collect().
        Share mine{};
        std::span<const Vec4> position = {};
        float inv_h = 0;
    };

    void list(Part& part) const;

    std::size_t capacity_ = 0;
    AlignedVector<Vec4> moved_, turned_;  ///< [collider · capacity + particle]
    std::vector<Part> parts_;             ///< per worker
    std::array<std::vector<ContactRecord>, 2> lists_;
    std::uint32_t turn_ = 0;
};

}  // namespace weft::cpu
