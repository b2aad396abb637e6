// Pairs of features that can take part in contact in the current substep, and the loops over them.
#pragma once

#include "collide/pair_search.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace weft::cpu {

/// Listed pairs of one kind that may be near in this substep. Padded to whole packets of lanes.
struct Candidates {
    std::array<AlignedVector<std::uint32_t>, 4> particle;  ///< in the world
    AlignedVector<float> thickness;                        ///< m
    /// m: how far contact may move both sides together from where the constraints left them; and the same when the near
    /// pairs were found before: those that were near then are not near pairs again.
    AlignedVector<float> reach, before;
    AlignedVector<std::uint32_t> block;               ///< index into `tiles`
    std::vector<std::array<std::uint32_t, 2>> tiles;  ///< by block
    std::uint32_t count = 0;

    void clear();
    void reserve(std::uint32_t pairs);
    void pad(std::uint32_t with_particle);
};

/// What applies to all listed pairs of two tiles.
struct ChosenBlock {
    float approach;       ///< m: by how much their distance may be less than when they were listed
    float reach, before;  ///< m: see Candidates
};
/// ChosenBlock::before of pairs that were not near before.
inline constexpr float never_near = -1e30f;

/// Pairs of one kind with their closest points and normal at the start of the substep. Padded to whole packets of
/// lanes; padding has no weights. In any order: sums over pairs do not depend on it.
struct NearPairs {
    std::array<AlignedVector<std::uint32_t>, 4> particle;  ///< in the world
    std::array<AlignedVector<float>, 4> weight;            ///< of the closest points
    std::array<AlignedVector<float>, 3> normal;
    AlignedVector<float> thickness;  ///< m
    AlignedVector<float> gap;        ///< m: between the sides along the normal, at the start
    AlignedVector<float> distance;   ///< m, at the start
    std::array<AlignedVector<std::uint32_t>, 2> tile;
    AlignedVector<std::uint8_t> pushed;  ///< whether contact pushed it in this substep
    std::uint32_t count = 0;

    std::array<std::uint32_t, 4> particles(std::uint32_t i) const {
        return {particle[0][i], particle[1][i], particle[2][i], particle[3][i]};
    }
    void reserve(std::uint32_t pairs);
    void move(std::uint32_t from, std::uint32_t to);
    void pad(std::uint32_t with_particle);
};

/// Whether a pair comes within its thickness while its particles move straight from `start` to `positions`, blocks of
/// four.
bool comes_near(const NearPairs&, PairKind, std::uint32_t pair, const float* start, const float* positions);

struct NearInput {
    const float* start;    ///< blocks of four: positions at the start of the substep
    const float* reached;  ///< where the constraints left the particles
    float floor;           ///< least gap that a pair keeps, as a part of its thickness
    bool square;           ///< makes normals perpendicular to large features: near surfaces of colliders and thin cloth
};

/// Pairs of both kinds that a sweep pushes apart. Padded to whole packets of lanes. In any order.
struct Overlaps {
    AlignedVector<std::uint32_t> pair;                     ///< number among the near pairs of its kind
    std::array<AlignedVector<std::uint32_t>, 4> particle;  ///< in the world
    std::array<AlignedVector<float>, 4> weight;            ///< of the closest points
    std::array<AlignedVector<float>, 4> give;              ///< 1/kg: the weights times the inverse masses
    std::array<AlignedVector<float>, 3> normal;
    AlignedVector<float> depth;                ///< m, > 0
    AlignedVector<float> distance, thickness;  ///< m, at the start; only while overlaps are found
    std::array<AlignedVector<float>, 3> push;  ///< kg·m: what one unit of inverse mass moves at weight 1
    std::uint32_t count = 0;

    void reserve(std::uint32_t pairs);
    void pad(std::uint32_t with_particle);
};

/// Sums over the pairs of a particle, in quanta (cloth_contact.kernel.h): of pushes or velocities by axis, and of the
/// weights. They wrap around.
struct alignas(16) ContactSums {
    std::array<std::uint32_t, 3> push{};
    std::uint32_t share = 0;
};

/// What the loops over overlaps read and add to, by particle of the world.
struct SweepView {
    const float *start, *positions;                    ///< blocks of four: position and inverse mass
    const float* friction;                             ///< blocks of four: static, kinetic
    const ContactSums* shares;                         ///< sums of the weights of all workers
    const ContactSums* unscaled;                       ///< sums of the pushes of all workers, before they are scaled
    ContactSums *to_shares, *to_unscaled, *to_scaled;  ///< what this worker adds to; no other one does
    float recovery;                                    ///< m: the most of an overlap from before that a substep removes
};

/// One table per instruction set.
struct ContactLoops {
    SearchLoops search;
    /// Appends `count` listed pairs from `begin` on that may be near, as the last one of Candidates::tiles.
    void (*choose)(const PairList&, std::uint32_t begin, std::uint32_t count, const ChosenBlock&, Candidates&);
    /// Appends the candidates that contact or the limit may have to act on, and had not before.
    std::array<void (*)(const Candidates&, const NearInput&, NearPairs&), 2> find_near;
    /// Appends the pairs that overlap, and adds up the weights of their particles.
    std::array<void (*)(NearPairs&, const SweepView&, Overlaps&), 2> find_overlaps;
    /// Finds the pushes of all overlaps and adds them up; scales those that open too far together, and adds them up.
    void (*find_pushes)(Overlaps&, const SweepView&);
    void (*scale_pushes)(Overlaps&, const SweepView&);
    /// Appends the pairs that lose their gap, and `depth` m more, at `positions`, in order.
    std::array<
        void (*)(const NearPairs&, const float* positions, float floor, float depth, std::vector<std::uint32_t>&), 2>
        find_lost;
};

/// The table of an instruction set that available_passes() lists.
const ContactLoops& contact_loops_of(std::string_view isa);
const ContactLoops& scalar_contact_loops();

}  // namespace weft::cpu
