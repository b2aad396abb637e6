// Contact of cloth with itself and with other cloths, exactly: a substep that starts without crossings ends without
// crossings (law: physics/cloth_contact/cloth_contact.md). One object per island.
#pragma once

#include "cpu/cloth_contact/contact_loops.h"
#include "cpu/cloth_run.h"
#include "solver/state/cloth_contact_counts.h"

#include <array>
#include <span>
#include <vector>

namespace weft::cpu {

/// Input of the passes over an island's pairs.
struct ClothContactContext {
    const WorldStep& step;
    std::span<ClothState* const> cloths;
    FunctionRef<void()> barrier;  ///< of all workers that run the passes
};

class ClothContact {
  public:
    explicit ClothContact(bool search_always = false) : search_always_(search_always) {}

    /// Allocates for the island's cloths. Keeps the lists if they are the same cloths as in the frame before.
    void prepare(const Passes& passes, const WorldStep& step, std::span<ClothState* const> cloths,
                 const std::shared_ptr<const Seams>& seams);
    /// All workers call it. The first one runs the pass, and the others help it with the search.
    void run(const ClothContactContext& context, const Pass& pass, Worker worker);

    /// Of the frame.
    const ClothContactCounts& counts() const { return counts_; }
    /// Adds the bits (ContactMark) of the particles from `base` on, which must be those of one cloth. None unless the
    /// frame recorded them.
    void add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const;

  private:
    void lead(const Pass& pass);
    void help(const ClothContactContext& context, Worker worker);
    void detect();
    void find_near_of_motion(bool search_always);
    // near_pairs.cpp
    void begin_reach();
    void follow_and_search();
    void search();
    void find_near();
    void add_near_pairs();
    bool is_relisted(std::uint32_t a, std::uint32_t b) const;
    void extend_reach(float more = 0);
    std::vector<std::array<std::uint32_t, 4>> remove_relisted(NearPairs& near) const;
    void mark_pushed(NearPairs& near, std::uint32_t begin, std::vector<std::array<std::uint32_t, 4>>& pairs);

    void push(const Pass& pass);
    void keep_in_reach();
    void find_overlaps();
    void find_pushes();
    void add_pushes();
    void scale_pushes();
    void move_by_pushes();
    bool comes_near(int kind, std::uint32_t pair) const;
    void add_shares(std::span<const std::uint32_t> particles, std::span<const float> weights);
    float share(std::uint32_t p) const;
    void add_to_sum(std::uint32_t p, Vec3 change, double quanta);
    void add_to_sums(std::span<const std::uint32_t> particles, std::span<const float> weights, Vec3 change,
                     double quanta);
    Vec3 sum(std::uint32_t p, double quanta) const;
    // limit.cpp
    struct MovedPair;
    MovedPair moved_pair(int kind, std::uint32_t pair) const;
    float part_before_brake_depth(int kind, std::uint32_t pair) const;
    template <class Visit>
    void for_each_lost(float depth, Visit&& visit);
    bool any_lost();
    bool brake();
    void limit();
    void send_back();
    bool retreat(const MovedPair& pair, bool all);
    void set_back(std::uint32_t p);
    bool any_uncovered();
    // contact_marks.cpp
    void begin_marks(bool record);
    void mark_limited_particles();
    void mark_stuck(std::span<const std::uint32_t> particles);
    // untangle.cpp
    void untangle();
    void drop_pairs_without_side(int kind, std::uint32_t begin);
    void separate();
    template <class Visit>
    void for_each_particle(Visit&& visit) const {
        for (const ClothState* cloth : cloths_) {
            if (!cloth->model->tiles) continue;
            for (std::uint32_t p = cloth->base, end = p + cloth->model->particle_count; p < end; ++p) visit(p);
        }
    }

    bool search_always_;
    const ContactLoops* loops_ = nullptr;
    PairSearch search_;
    std::array<Candidates, 2> candidates_;  // by kind
    std::array<NearPairs, 2> near_;         // by kind
    // By tile, m: how far lists and near pairs allow particles to move from reached_, and did before; how far they are
    // from there, and were at most.
    std::vector<float> reach_, before_, moved_, most_moved_;
    struct Pushed {
        std::array<std::uint32_t, 4> particles;
        std::array<float, 4> weights;
        Vec3 normal;
    };
    std::vector<Pushed> pushes_of_substep_;

    // Of the pass.
    unsigned workers_ = 1;
    const FunctionRef<void()>* barrier_ = nullptr;
    const FunctionRef<void(unsigned, unsigned)>* task_ = nullptr;  // for all workers; null: the pass is done

    // Of the frame.
    std::span<ClothState* const> cloths_;
    const Tangle* tangle_ = nullptr;  // null if nothing is tangled
    Vec4 *x_ = nullptr, *velocity_ = nullptr;
    const Vec4* start_ = nullptr;
    float h_ = 0;      // s
    float slack_ = 0;  // m
    float cap_ = 0;    // m: how far pushes may move a particle from where the constraints left it
    ClothContactCounts counts_;
    bool records_marks_ = false;
    std::vector<std::uint32_t> marks_;  // by particle of the world: ContactMark, without mark_touches

    // By particle of the world.
    AlignedVector<Vec4> reached_;                     // where the constraints left the particles
    AlignedVector<Vec4> asked_;                       // before the limit
    AlignedVector<Vec4> farthest_;                    // from the listed trajectories
    std::vector<std::array<std::uint32_t, 3>> sums_;  // of pushes or velocities, in quanta
    std::vector<std::uint32_t> share_;                // sum of the weights of all pairs that push, in quanta
    std::vector<float> part_;                         // of its motion that the brake leaves to the particle
    std::vector<Vec3> slide_;                         // motion that the limit leaves to a particle that slides
    std::vector<std::uint8_t> retreats_;              // how often the limit has sent the particle back
    std::vector<std::uint8_t> sent_back_, marked_;
    std::vector<std::array<float, 2>> friction_;  // static and kinetic, by particle of the world

    std::array<std::vector<Overlap>, 2> overlaps_;
    std::vector<std::uint32_t> lost_;
    std::vector<std::uint32_t> to_send_back_;
};

}  // namespace weft::cpu
