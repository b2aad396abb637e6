// Contact of cloth with itself and with other cloths, exactly: a substep that starts without crossings ends without
// crossings (law: physics/cloth_contact/cloth_contact.md). One object for all cloths that step together.
#pragma once

#include "base/workers.h"
#include "cpu/cloth_contact/contact_arrays.h"
#include "cpu/cloth_run.h"
#include "solver/plan/cloth_contact_numbers.h"
#include "solver/state/cloth_contact_counts.h"

#include <weft/bounds.h>

#include <array>
#include <span>
#include <vector>

namespace weft::cpu {

/// Input of the passes over the pairs of cloths that step together.
struct ClothContactContext {
    const WorldStep& step;
    std::span<ClothState* const> cloths;
    FunctionRef<void()> barrier;  ///< of all workers that run the passes
    std::uint32_t substep;
};

class ClothContact {
  public:
    explicit ClothContact(bool search_always = false) : search_always_(search_always) {}

    /// Allocates for these cloths, one of `steps` for each. Keeps the lists if they are the same ones as in the frame
    /// before. `arrays` must have room for all particles of the world, and last until the next call. `swept`: by cloth,
    /// gets a box around all places at which passes look at its particles; empty if that is not needed.
    void prepare(const Passes& passes, const WorldStep& step, std::span<ClothState* const> cloths,
                 std::span<const ClothStep* const> steps, const std::shared_ptr<const Seams>& seams,
                 ContactArrays& arrays, std::span<Bounds* const> swept);
    /// All workers call it. The first one decides what to do, and all do it.
    void run(const ClothContactContext& context, const Pass& pass, Worker worker);

    /// Of the frame.
    const ClothContactCounts& counts() const { return counts_; }
    /// Adds the bits (ContactMark) of the particles from `base` on, which must be those of one cloth. None unless the
    /// frame recorded them.
    void add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const;

  private:
    struct Mine;
    void use(ContactArrays& arrays);
    void prepare_particles(const ClothState& cloth, const ClothStep& step, float surface_motion);
    void lead(const Pass& pass);
    void detect();
    void place_resting(const ClothState& cloth);
    void sweep_boxes();
    void find_near_of_motion(bool search_always);
    void push(const Pass& pass);
    void sweep();
    template <class Add>
    void add_up(const Mine& mine, Add&& add);
    float cap(std::uint32_t p) const { return numbers_[p].z; }
    float own_cap(std::uint32_t p) const { return numbers_[p].w; }
    bool of_surface(std::uint32_t p) const { return cap(p) == cap_of_surface; }
    void keep_in_reach(std::uint32_t p);
    void add_share(std::uint32_t p, float weight);
    float share(std::uint32_t p) const;
    void add_to_sum(std::uint32_t p, Vec3 change, double quanta);
    Vec3 sum(std::uint32_t p, double quanta) const;
    void separate();
    // near_pairs.cpp
    void begin_reach();
    void follow_and_search();
    void find_near();
    void add_near_pairs();
    void add_near_pairs(Mine& mine) const;
    bool is_relisted(std::uint32_t a, std::uint32_t b) const;
    void extend_reach();
    void extend_reach_of_limit();
    void extend_reach_to_moved();
    std::vector<std::array<std::uint32_t, 4>> remove_relisted(NearPairs& near) const;
    void extend_near_pairs(bool relisted);
    // limit.cpp
    struct MovedPair;
    MovedPair moved_pair(const NearPairs& near, int kind, std::uint32_t pair) const;
    float part_before_brake_depth(const NearPairs& near, int kind, std::uint32_t pair) const;
    template <class Visit>
    void for_each_lost(Mine& mine, float depth, Visit&& visit) const;
    bool any_found() const;
    bool any_lost();
    bool brake();
    float brake_depth(const std::array<std::uint32_t, 4>& pair) const;
    void limit();
    void send_back();
    bool retreat(Mine& mine, const MovedPair& pair, bool all);
    void set_back(std::uint32_t p);
    bool any_uncovered();
    void find_farthest();
    void restart_limit();
    void stay_at_start();
    void count_limited_particles();
    // carry.cpp
    Vec3 base_of(std::uint32_t p) const;
    Vec3 carried_place(std::uint32_t p, std::uint32_t carrier) const;
    float most_carried_by(std::uint32_t p) const { return cap(p) - limit_carry_margin * own_cap(p); }
    std::uint32_t carrier_of(const std::array<std::uint32_t, 4>& pair) const;
    bool touches_moving_surface(const std::array<std::uint32_t, 4>& pair) const;
    bool is_carried(std::uint32_t p) const { return carrier_[p] > 0 && !of_surface(p); }
    bool is_carried(const std::array<std::uint32_t, 4>& pair) const;
    bool carry(Mine& mine, const std::array<std::uint32_t, 4>& pair);
    bool begin_carried(std::uint32_t p);
    // contact_marks.cpp
    void mark_stuck(std::span<const std::uint32_t> particles);
    // untangle.cpp
    void untangle();
    void drop_pairs_without_side(NearPairs& near, int kind, std::uint32_t begin) const;

    /// Calls work(what the worker has of the pairs) on all workers at the same time.
    template <class Work>
    void in_parallel(Work&& work) {
        team_.run([&](unsigned worker) { work(workers_[worker]); });
    }
    /// Of all particles, those that the worker processes.
    template <class Visit>
    void for_each_particle(const Mine& mine, Visit&& visit) const {
        const Worker worker{mine.worker, team_.size()};
        for (const ClothState* cloth : cloths_) {
            if (!cloth->model->tiles || cloth->rests) continue;
            const Share particles = worker.of(cloth->model->particle_count);
            for (std::uint32_t p = particles.begin; p < particles.end; ++p) visit(cloth->base + p);
        }
    }

    struct Pushed {
        std::array<std::uint32_t, 4> particles;
        std::array<float, 4> weights;
        Vec3 normal;
    };
    bool search_always_;
    const ContactLoops* loops_ = nullptr;
    PairSearch search_;
    // What one worker has of the pairs: those of every so many rows of tiles.
    struct Mine {
        unsigned worker = 0;
        std::array<Candidates, 4> candidates;  // by kind; then those with surfaces of colliders
        std::array<NearPairs, 2> near;         // by kind
        Overlaps overlaps;
        ContactSums* sums = nullptr;  // by particle of the world, if there are several workers
        std::vector<Pushed> pushes;   // of the substep
        std::vector<std::uint32_t> lost, to_send_back;
        bool found = false;                    // of the last loop that looks for something
        std::uint64_t stuck = 0, limited = 0;  // pairs, particles
        std::uint32_t least_stuck = 0;         // particle
    };
    std::vector<Mine> workers_;
    // By tile, m: how far lists and near pairs allow particles to move from reached_, and did before; how far they are
    // from there, and were at most.
    std::vector<float> reach_, before_, moved_, most_moved_;
    std::vector<float> caps_;                      // m, of the tiles' particles; 0 for surfaces
    std::vector<float> own_caps_;                  // without the motion of surfaces
    float least_cap_ = 0;                          // m, of all cloths
    std::vector<std::span<const Pose>> carriers_;  // poses of the surfaces that move in this frame
    std::uint32_t substep_ = 0;                    // in progress
    LedTeam team_;

    // Of the frame.
    std::span<ClothState* const> cloths_;
    const Tangle* tangle_ = nullptr;  // null if nothing is tangled
    Vec4 *x_ = nullptr, *velocity_ = nullptr;
    const Vec4* start_ = nullptr;
    float h_ = 0;  // s
    std::span<Bounds* const> swept_;
    ClothContactCounts counts_;
    bool records_marks_ = false;

    ContactArrays* arrays_ = nullptr;
    // Of these, by particle of the world.
    Vec4 *reached_ = nullptr, *asked_ = nullptr, *farthest_ = nullptr, *numbers_ = nullptr;
    ContactSums *sums_ = nullptr, *unscaled_ = nullptr;
    float* part_ = nullptr;
    Vec3* slide_ = nullptr;
    std::uint8_t *retreats_ = nullptr, *sent_back_ = nullptr;
    std::uint32_t *carrier_ = nullptr, *next_carrier_ = nullptr;
    std::uint32_t* marks_ = nullptr;
};

}  // namespace weft::cpu
