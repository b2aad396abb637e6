// Distances at rest through stitches. Contact must not push apart what stitches hold together.
#pragma once

#include "physics/stitch/stitch.h"

#include <weft/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// A stitch between points of cloths that can touch. Particles are numbered over the world.
struct SeamTie {
    StitchPoint from, to;
    float gap = 0;  ///< m
};

/// A cloth as the seams need it.
struct SeamedCloth {
    const Vec4* rest = nullptr;  ///< m, by particle of the cloth
    std::uint32_t base = 0;      ///< number of its first particle in the world
    std::uint32_t count = 0;     ///< of its particles
    float thickness = 0;         ///< m: pairs of two cloths keep at most the mean of both
};

/// One point of a seam that is near a particle at rest.
struct SeamEntry {
    std::uint32_t seam = 0;  ///< its number
    std::uint32_t side = 0;  ///< which of the points that the stitches hold together
    float distance = 0;      ///< m
};

/// For each particle, the points of seams on its own cloth that are nearer than any pair with it can be thick twice.
/// Points that stitches hold together have one number and different sides. All particles that have a share of a point
/// are at distance 0 from it. Stitches whose gap is wider than the thickness are no seams: contact does not act on
/// them.
class Seams {
  public:
    Seams(std::span<const SeamTie> ties, std::span<const SeamedCloth> cloths);

    bool empty() const { return entries_.empty(); }
    /// The least distance at rest from one particle through a stitch to the other one, m; `far` if there is none near.
    /// 0: a stitch holds the two together.
    float distance(std::uint32_t p, std::uint32_t q) const;
    static constexpr float far = 1e30f;

    // For the device. The entries of particle p are `entries()[first()[p - base()]] … entries()[first()[p - base() + 1]
    // - 1]`.
    std::uint32_t base() const { return base_; }
    std::span<const std::uint32_t> first() const { return first_; }
    std::span<const SeamEntry> entries() const { return entries_; }

  private:
    std::uint32_t base_ = 0;            // the first particle
    std::vector<std::uint32_t> first_;  // by particle
    std::vector<SeamEntry> entries_;
};

}  // namespace weft
