// Contact of cloth with itself and with other cloths by particles that keep a distance like spheres (law:
// physics/particle_contact/particle_contact.md). One object per island. All workers share its passes.
#pragma once

#include "cpu/cloth_run.h"
#include "cpu/particle_contact/particle_loops.h"
#include "solver/plan/particle_contact_numbers.h"
#include "solver/state/cloth_contact_counts.h"

#include <span>
#include <vector>

namespace weft::cpu {

/// Input of the passes over an island's particles.
struct ParticleContactContext {
    const WorldStep& step;
    std::span<ClothState* const> cloths;
    std::shared_ptr<const Seams> seams = {};
};

class ParticleContact {
  public:
    explicit ParticleContact(bool search_always = false) : search_always_(search_always) {}

    /// Allocates for the island's cloths. Keeps the lists if they are the same cloths as in the frame before.
    void prepare(const Passes& passes, const ParticleContactContext& context, unsigned workers);
    void run(const Pass& pass, Worker worker);

    /// Of the frame: contacts and searches.
    ClothContactCounts counts() const;
    /// Adds the bits (ContactMark) of the particles from `base` on, which must be those of one cloth.
    void add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const;

  private:
    /// Aligned so that no two workers share a cache line.
    struct alignas(cache_line) Part {
        ParticleOverlaps overlaps;          ///< of the worker's tiles
        std::vector<std::uint32_t> pushes;  ///< by particle: number of overlaps
        AlignedVector<ParticleSum> sums;    ///< by particle
        bool searched = false;              ///< in the current sweep
        std::vector<std::uint8_t> touched;  ///< by block of particles: whether any overlaps
        std::vector<std::uint8_t> pushed;   ///< by block of particles: whether the current sweep pushes any
    };

    template <class Visit>
    void for_each_tile(Worker worker, Visit&& visit) const;
    template <class Visit>
    void for_each_block(Worker worker, Visit&& visit) const;
    void find_overlaps(Worker worker);
    ParticleInput input(const ParticleSweep& sweep) const;
    void move(Worker worker);
    void settle(Worker worker);
    void move_block(std::uint32_t first, Vec4* places);

    bool search_always_;
    const ParticleLoops* loops_ = nullptr;
    ParticleSearch search_;
    std::vector<Part> parts_;                   // by worker
    std::vector<const std::uint32_t*> pushes_;  // by worker

    AlignedVector<Vec4> friction_;  // by block of particles: square roots of static and kinetic friction

    // Of the frame.
    Vec4 *x_ = nullptr, *start_ = nullptr;
    float h_ = 0;                   // s
    std::vector<Range> particles_;  // of the cloths that take part
    std::uint64_t searches_ = 0;
};

}  // namespace weft::cpu
