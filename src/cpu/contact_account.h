// The account that a cloth on the CPU keeps of its contacts in a frame, and what is read from it.
#pragma once

#include "base/aligned.h"
#include "base/workers.h"
#include "solver/state/feedback.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

class ContactAccount {
  public:
    /// Makes room; none where there is nothing to keep. Only prepare() and collect() ask for memory, on the calling
    /// thread.
    void prepare(std::size_t colliders, std::size_t capacity, unsigned ranks);

    bool empty() const { return moved_.empty(); }
    /// Blocks of four per particle (ContactTrace).
    float* moved(std::size_t collider) { return &moved_[collider * capacity_].x; }
    float* turned(std::size_t collider) { return &turned_[collider * capacity_].x; }

    /// What the rank's own particles did. `mine` has no anchors; `position` stays as it is until collect(). Lists no
    /// more contacts than there was room for, so that it asks for no memory: sums are complete.
    void count(unsigned rank, Share mine, std::span<const Vec4> position, float inv_h);
    /// Of all ranks, every contact: where room was short, there is more now. What `to` shows stays until the call after
    /// the next.
    void collect(ClothFeedback& to);

  private:
    /// A cache line is one rank's alone.
    struct alignas(cache_line) Part {
        std::vector<ContactRecord> contacts;  ///< as many as there was room for
        std::vector<std::size_t> begin;       ///< of each collider's among all contacts, and their number
        std::vector<ImpulseSum> sums;         ///< per collider
        // What was counted, to list it once more.
        Share mine{};
        std::span<const Vec4> position = {};
        float inv_h = 0;
    };

    void list(Part& part) const;

    std::size_t capacity_ = 0;
    AlignedVector<Vec4> moved_, turned_;  ///< [collider · capacity + particle]
    std::vector<Part> parts_;             ///< per rank
    std::array<std::vector<ContactRecord>, 2> lists_;
    std::uint32_t turn_ = 0;
};

}  // namespace weft::cpu
