// Logs the contacts of a cloth on the CPU during a frame.
#pragma once

#include "base/aligned.h"
#include "cpu/collider_lists.h"
#include "solver/state/contact_forces.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

class ContactAccount {
  public:
    /// Allocates; nothing if there are no colliders. Only prepare() and collect() allocate, on the calling thread.
    void prepare(std::size_t colliders, unsigned workers);

    bool empty() const { return parts_.empty(); }

    /// Sums the contacts of a worker's particles below `particles`, the number of those that are not anchors. `near`
    /// and `position` must not change until collect(). Lists only as many contacts as there is room for, so that it
    /// does not allocate; the sums are complete.
    void count(unsigned worker, const ColliderPart& near, std::uint32_t particles, std::span<const Vec4> position,
               float inv_h);
    /// Collects the contacts of all workers, all of them: allocates more room if a list was full. The lists in `to`
    /// stay valid until the call after the next.
    void collect(ClothContactLog& to);

  private:
    /// Aligned so that no two workers share a cache line.
    struct alignas(cache_line) Part {
        std::vector<ContactRecord> contacts;  ///< as many as there is room for; of each collider by particle
        std::size_t found = 0;                ///< contacts in all
        std::vector<ImpulseSum> sums;         ///< per collider
        // Arguments of count(), for listing again in collect().
        const ColliderPart* near = nullptr;
        std::uint32_t particles = 0;
        std::span<const Vec4> position = {};
        float inv_h = 0;
    };

    static void list(Part& part);

    std::vector<Part> parts_;        ///< per worker
    std::vector<std::size_t> next_;  ///< per collider: place of its next contact
    std::array<std::vector<ContactRecord>, 2> lists_;
    std::uint32_t turn_ = 0;
};

}  // namespace weft::cpu
