// The loops over pairs of particles in contact.
#pragma once

#include "base/aligned.h"
#include "collide/particle_search.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace weft::cpu {

/// Sum of the pushes of one particle, in quanta (WEFT_PUSH_QUANTA_PER_METER). The fourth number is unused.
struct alignas(16) ParticleSum : std::array<std::uint32_t, 4> {};

/// Pairs that overlap.
struct ParticleOverlaps : ParticlePairs {
    AlignedVector<float> depth;  ///< m, sum over the sweeps of a substep of the depths of their pushes
};

/// Particles that share a flag and friction. Every cloth's first particle is a multiple of it.
inline constexpr std::uint32_t particle_block = 16;

/// Input of the loops. Arrays are by particle of the world.
struct ParticleInput {
    const float* position;               ///< blocks of four
    const float* start;                  ///< blocks of four
    const float* friction;               ///< blocks of four, by block of particles: square roots of both coefficients
    const std::uint32_t* const* pushes;  ///< by worker and particle: number of overlaps
    unsigned workers;
    float deep;      ///< part of the diameter below which pairs are pushed
    float recovery;  ///< m
    float split;     ///< part of the mass splitting
};

/// One table per instruction set.
struct ParticleLoops {
    ParticleSearchLoops search;
    /// Appends the pairs [begin, end) that overlap to `overlaps`, and counts them by particle.
    void (*find_overlaps)(const ParticlePairs& pairs, std::uint32_t begin, std::uint32_t end, const float* positions,
                          ParticlePairs& overlaps, std::uint32_t* pushes);
    /// Adds the pushes of all overlaps to the sums, by particle, and their depths to the depths. Marks the blocks of
    /// particles that are pushed.
    void (*push)(const ParticleInput&, ParticleOverlaps&, ParticleSum* sums, std::uint8_t* pushed);
    /// Adds what takes away the motion by which pushes have separated particles.
    void (*hold)(const ParticleInput&, const ParticleOverlaps&, ParticleSum* sums);
};

/// The table of an instruction set that available_passes() lists.
const ParticleLoops& particle_loops_of(std::string_view isa);
const ParticleLoops& scalar_particle_loops();

}  // namespace weft::cpu
