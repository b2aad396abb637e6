// Contact of cloth with itself and with other cloths by particles that keep a distance like spheres (law:
// physics/particle_contact/particle_contact.md). One object for all cloths that step together. All workers share its
// passes.
#pragma once

#include "cpu/cloth_run.h"
#include "cpu/particle_contact/particle_loops.h"
#include "solver/plan/particle_contact_numbers.h"
#include "solver/state/cloth_contact_counts.h"

#include <weft/bounds.h>

#include <span>
#include <vector>

namespace weft::cpu {

/// What contact keeps for every particle of the world, for all islands: an island uses the elements of its own
/// particles.
struct ParticleArrays {
    /// Aligned so that no two workers share a cache line.
    struct alignas(cache_line) OfWorker {
        std::vector<std::uint32_t> pushes;  ///< by particle: number of overlaps
        AlignedVector<ParticleSum> sums;    ///< by particle
        std::vector<std::uint8_t> touched;  ///< by block of particles: whether any overlaps
        std::vector<std::uint8_t> pushed;   ///< by block of particles: whether the current sweep pushes any
    };
    std::vector<OfWorker> workers;
    AlignedVector<Vec4> friction;  ///< by block of particles: square roots of static and kinetic friction

    /// Makes room for so many particles.
    void reserve(std::size_t particles, unsigned worker_count) {
        const std::size_t blocks = particles / particle_block + 1;
        workers.resize(worker_count);
        for (OfWorker& one : workers)
            one.pushes.resize(particles), one.sums.resize(particles), one.touched.resize(blocks),
                one.pushed.resize(blocks);
        friction.resize(blocks);
    }
};

/// Input of the passes over the particles of cloths that step together.
struct ParticleContactContext {
    const WorldStep& step;
    std::span<ClothState* const> cloths;
    std::shared_ptr<const Seams> seams = {};
    ParticleArrays& arrays;  ///< with room for all particles of the world
    std::span<Bounds* const> swept =
        {};  ///< by cloth: gets a box around all places at which passes look at its particles
};

class ParticleContact {
  public:
    explicit ParticleContact(bool search_always = false) : search_always_(search_always) {}

    /// Allocates for these cloths. Keeps the lists if they are the same ones as in the frame before. Arrays and boxes
    /// must last until the next call.
    void prepare(const Passes& passes, const ParticleContactContext& context, unsigned workers);
    void run(const Pass& pass, Worker worker);

    /// Of the frame: contacts and searches.
    ClothContactCounts counts() const;
    /// Adds the bits (ContactMark) of the particles from `base` on, which must be those of one cloth.
    void add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const;

  private:
    /// Aligned so that no two workers share a cache line.
    struct alignas(cache_line) Part {
        ParticleOverlaps overlaps;                   ///< of the worker's tiles
        ParticleArrays::OfWorker* arrays = nullptr;  ///< of the worker
        bool searched = false;                       ///< in the current sweep
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

    const Vec4* friction_ = nullptr;  // ParticleArrays::friction
    std::span<Bounds* const> swept_;
    std::vector<std::uint32_t> searched_cloths_;  // places in `swept_` of those that the search knows

    // Of the frame.
    Vec4 *x_ = nullptr, *start_ = nullptr;
    float h_ = 0;                   // s
    std::vector<Range> particles_;  // of the cloths that take part
    std::uint64_t searches_ = 0;
};

}  // namespace weft::cpu
