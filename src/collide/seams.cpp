#include "collide/seams.h"

#include "base/disjoint_sets.h"
#include "collide/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

/// A particle at a point of a seam.
struct SeamParticle {
    std::uint32_t particle, seam, side;
};

bool is_particle(const StitchPoint& point) {
    return std::ranges::count_if(point.shares, [](float share) { return share != 0; }) == 1;
}

template <class Visit>
void for_each_particle(const StitchPoint& point, Visit&& visit) {
    for (std::size_t k = 0; k < 3; ++k)
        if (point.shares[k] != 0) visit(point.particles[k]);
}

const SeamedCloth* cloth_of(std::span<const SeamedCloth> cloths, std::uint32_t particle) {
    const auto found = std::ranges::find_if(cloths, [&](const SeamedCloth& cloth) {
        return particle >= cloth.base && particle - cloth.base < cloth.count;
    });
    return found != cloths.end() ? &*found : nullptr;
}

bool is_seam(const SeamTie& tie, std::span<const SeamedCloth> cloths) {
    const SeamedCloth *a = cloth_of(cloths, tie.from.particles[0]), *b = cloth_of(cloths, tie.to.particles[0]);
    return a && b && tie.gap < 0.5f * (a->thickness + b->thickness);
}

// Particles that stitches hold together, directly or through others, are one seam. A stitch to a point between
// particles is a seam of its own: through the particles of an edge it would join with all its neighbors.
std::vector<SeamParticle> seam_particles(std::span<const SeamTie> ties, std::span<const SeamedCloth> cloths,
                                         std::uint32_t base, std::uint32_t end) {
    std::vector<SeamParticle> found;
    DisjointSets together(end - base);
    std::vector<std::uint32_t> tied;
    std::uint32_t next = end - base;  // numbers below are those of particles
    for (const SeamTie& tie : ties) {
        if (!is_seam(tie, cloths)) continue;
        if (is_particle(tie.from) && is_particle(tie.to)) {
            std::array<std::uint32_t, 2> pair{};
            for_each_particle(tie.from, [&](std::uint32_t p) { pair[0] = p; });
            for_each_particle(tie.to, [&](std::uint32_t p) { pair[1] = p; });
            together.merge(pair[0] - base, pair[1] - base);
            tied.insert(tied.end(), pair.begin(), pair.end());
        } else {
            for_each_particle(tie.from, [&](std::uint32_t p) { found.push_back({p, next, 0}); });
            for_each_particle(tie.to, [&](std::uint32_t p) { found.push_back({p, next, 1}); });
            ++next;
        }
    }
    std::ranges::sort(tied);
    tied.erase(std::unique(tied.begin(), tied.end()), tied.end());
    for (const std::uint32_t p : tied) found.push_back({p, together.first_of(p - base), p});
    return found;
}

float distance_of(Vec4 a, Vec4 b) {
    return length(a.xyz() - b.xyz());
}

}  // namespace

Seams::Seams(std::span<const SeamTie> ties, std::span<const SeamedCloth> cloths) {
    if (cloths.empty()) return;
    std::uint32_t end = 0;
    float thickest = 0;
    base_ = cloths.front().base;
    for (const SeamedCloth& cloth : cloths) {
        base_ = std::min(base_, cloth.base), end = std::max(end, cloth.base + cloth.count);
        thickest = std::max(thickest, cloth.thickness);
    }
    const std::vector<SeamParticle> particles = seam_particles(ties, cloths, base_, end);
    if (particles.empty()) return;
    std::vector<std::vector<SeamEntry>> near(end - base_);
    for (const SeamedCloth& cloth : cloths) {
        // The distance through a seam counts up to twice the thickness of a pair.
        const float reach = cloth.thickness + thickest;
        std::vector<SeamParticle> own;
        std::vector<Bounds> boxes;
        for (const SeamParticle& one : particles) {
            if (one.particle < cloth.base || one.particle - cloth.base >= cloth.count) continue;
            own.push_back(one);
            const Vec3 place = cloth.rest[one.particle - cloth.base].xyz(), around{reach, reach, reach};
            boxes.push_back({place - around, place + around});
        }
        const Bvh bvh(boxes);
        for (std::uint32_t p = 0; p < cloth.count; ++p) {
            const Vec3 place = cloth.rest[p].xyz();
            bvh.for_each_overlap({place, place}, [&](std::uint32_t i) {
                const float distance = distance_of(cloth.rest[p], cloth.rest[own[i].particle - cloth.base]);
                if (distance < reach) near[cloth.base + p - base_].push_back({own[i].seam, own[i].side, distance});
            });
        }
    }
    for (std::vector<SeamEntry>& list : near) {
        first_.push_back(static_cast<std::uint32_t>(entries_.size()));
        std::ranges::sort(list, [](const SeamEntry& a, const SeamEntry& b) {
            if (a.seam != b.seam) return a.seam < b.seam;
            return a.side != b.side ? a.side < b.side : a.distance < b.distance;
        });
        for (const SeamEntry& entry : list) {  // of several particles of a point, the nearest
            if (entries_.size() > first_.back() && entries_.back().seam == entry.seam &&
                entries_.back().side == entry.side)
                continue;
            entries_.push_back(entry);
        }
    }
    first_.push_back(static_cast<std::uint32_t>(entries_.size()));
}

float Seams::distance(std::uint32_t p, std::uint32_t q) const {
    float least = far;
    if (p < base_ || q < base_ || p - base_ + 1 >= first_.size() || q - base_ + 1 >= first_.size()) return least;
    for (std::uint32_t i = first_[p - base_]; i < first_[p - base_ + 1]; ++i) {
        for (std::uint32_t k = first_[q - base_]; k < first_[q - base_ + 1]; ++k) {
            if (entries_[i].seam == entries_[k].seam && entries_[i].side != entries_[k].side)
                least = std::min(least, entries_[i].distance + entries_[k].distance);
        }
    }
    return least;
}

}  // namespace weft
