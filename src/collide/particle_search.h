// Lists all pairs of particles that can come nearer than their diameter.
//
// Particles are grouped into tiles of neighbors, and pairs into blocks, one per pair of tiles. A block stays valid
// while its tiles neither deform nor approach each other by more than a margin; only blocks that are not are searched
// again. A list may hold more pairs than are near.
#pragma once

#include "base/aligned.h"
#include "base/collision_filter.h"
#include "collide/seams.h"
#include "collide/uneven_thickness.h"

#include <weft/bounds.h>
#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace weft {

/// Particles in a tile: as many as a word of flags has. With fewer, handling tiles takes longer than handling pairs.
inline constexpr std::uint32_t particle_tile = 64;

/// A cloth as the search needs it.
struct SearchedParticles {
    std::shared_ptr<const std::vector<std::uint32_t>> order;  ///< of its particles; neighbors follow one another
    std::uint32_t base = 0;                                   ///< number of its first particle in the world
    const Vec4* rest = nullptr;                               ///< m, by particle of the cloth
    float diameter = 0;                                       ///< m, of the largest particle
    float margin = 0;                                         ///< m: how much farther its listed pairs may be apart
    float part_at_rest = 0;       ///< two of its particles keep at most this part of their distance at rest,
    float less_at_rest = 0;       ///< or that distance less this, m, whichever is larger
    bool with_alike = true;       ///< false: it has no pairs with itself and with other cloths that have none
    CollisionFilter filter = {};  ///< for other cloths
    std::shared_ptr<const Seams> seams = {};  ///< the same ones for all cloths; null if there are none
    UnevenThickness uneven = {};              ///< gives diameters
    friend bool operator==(const SearchedParticles&, const SearchedParticles&) = default;
};

/// Low and high corner of a box. The fourth numbers are unused.
struct ParticleBox {
    alignas(16) std::array<float, 4> low, high;
};

/// Boxes that are tested side by side.
inline constexpr std::uint32_t boxes_together = 16;
struct BoxGroup {
    alignas(cache_line) std::array<std::array<float, boxes_together>, 3> low, high;  ///< by axis and box
};

/// Pairs of particles of the world, as arrays.
struct ParticlePairs {
    AlignedVector<std::uint32_t> one, two;
    AlignedVector<float> diameter;  ///< m
    std::uint32_t count = 0;

    /// Makes room for as many pairs and a packet of lanes.
    void reserve(std::size_t pairs);
    void append(const ParticlePairs& other, std::uint32_t begin, std::uint32_t pairs);
    /// Fills the packet after the last pair with a particle's number.
    void pad(std::uint32_t with_particle);
};

/// The particles of a tile where it was listed. Unused places are far away.
struct ListedTile {
    using Axes = std::array<std::array<float, particle_tile>, 3>;
    alignas(cache_line) Axes place, rest;                             ///< m
    std::array<std::uint32_t, particle_tile> particle{};              ///< in the world
    alignas(cache_line) std::array<float, particle_tile> diameter{};  ///< m
    float largest = 0;                                                ///< m: of the diameters
    ParticleBox box, rest_box;
};

/// A pair of tiles to be listed.
struct TilesToList {
    const ListedTile *one = nullptr, *two = nullptr;
    Vec3 shift;          ///< m: added to the listed places of tile two
    float diameter = 0;  ///< m: of the largest pair
    float margin = 0;    ///< m
    float part_at_rest = 0;
    float less_at_rest = 0;  ///< m
    bool by_rest = false;    ///< the distance at rest may limit the diameter
    bool uneven = false;     ///< particles have different diameters
};

/// The inner loops, one table per instruction set.
struct ParticleSearchLoops {
    /// Appends the pairs of two tiles to `pairs`. Returns the least distance of a pair beyond its diameter, m.
    float (*list)(const TilesToList&, ParticlePairs& pairs);
    /// The boxes of a group that overlap a box, as bits.
    std::uint32_t (*overlapping)(const BoxGroup&, const ParticleBox&);
};

class ParticleSearch {
  public:
    /// Starts anew with these cloths, whose particles must not overlap. Keeps all lists if nothing differs.
    void set_cloths(const ParticleSearchLoops& loops, std::vector<SearchedParticles> cloths, unsigned workers);

    // The passes of a search, in order. The first and the last one are shared: call them for all tiles.

    /// Compares the positions of a tile with where it was listed.
    void track(std::uint32_t tile, const Vec4* positions);
    /// Finds the tiles to be listed anew, and the tiles near each other. `always`: takes all tiles.
    void find_outdated(const Vec4* positions, bool always);
    /// Lists a tile with itself and with tiles of higher numbers, as far as its lists are not valid. Returns whether
    /// any was not.
    bool list(std::uint32_t tile, unsigned worker);

    /// Calls visit(pairs, begin, end) for the pairs of a tile that may be nearer than their diameter.
    template <class Visit>
    void for_each_run(std::uint32_t tile, Visit&& visit) const {
        for (const auto& [begin, end] : rows_[tile].runs) visit(rows_[tile].pairs, begin, end);
    }
    std::uint32_t tile_count() const { return static_cast<std::uint32_t>(tiles_.size()); }
    /// Calls visit(cloth, box around the tile's particles) for all tiles where track() saw them.
    template <class Visit>
    void for_each_box(Visit&& visit) const {
        for (const Tile& tile : tiles_) {
            const auto corner = [](const std::array<float, 4>& of) { return Vec3{of[0], of[1], of[2]}; };
            visit(tile.cloth, Bounds{corner(tile.now.low), corner(tile.now.high)});
        }
    }

  private:
    /// The pairs of two tiles.
    struct Block {
        std::uint32_t other = 0;             // the tile of the higher number
        std::uint32_t begin = 0, count = 0;  // in the pairs of the row
        Vec3 shift;                          // m: relative motion of the tiles up to the time of listing
        float allowed = 0;                   // m: up to which they may approach each other since then
        float spare = 0;                     // m: by how much the distance of the nearest pair exceeded its diameter
    };
    struct Row {
        ParticlePairs pairs;
        std::vector<Block> blocks;                       // by ascending `other`
        std::vector<std::array<std::uint32_t, 2>> runs;  // of pairs that may be near now
    };
    struct Tile {
        std::uint32_t cloth = 0, count = 0;
        bool outdated = true;  // listed anew in this search
        bool renewed = true;   // the tiles near it have changed
        ParticleBox now;
        ParticleBox reach;  // around all places that find_near_tiles() has provided for
    };
    struct Motion {
        Vec3 moved;         // m: since the tile was listed
        float strayed = 0;  // m: bound on how far a particle's motion differs from that
    };
    struct Scratch {
        ParticlePairs pairs;
        std::vector<Block> blocks;
    };
    // Boxes of neighbors, in groups, and boxes around the groups, likewise.
    struct Grouped {
        std::vector<std::uint32_t> tile;       // by place; none where a group has no further tile
        std::vector<std::uint32_t> place;      // by tile
        std::vector<ParticleBox> boxes;        // by place
        AlignedVector<BoxGroup> groups;        // of places
        std::vector<ParticleBox> around;       // by group
        AlignedVector<BoxGroup> outer_groups;  // of groups
    };

    float margin(const Tile& tile) const { return cloths_[tile.cloth].margin; }
    bool approached(std::uint32_t tile, const Block& block, float distance) const;
    void list_tile_anew(std::uint32_t tile, const Vec4* positions);
    bool any_out_of_reach() const;
    void find_near_tiles();
    void group_tiles();
    void group_boxes();
    void add_near_tiles(std::uint32_t group, std::uint32_t other_group);
    bool can_meet(std::uint32_t tile, std::uint32_t other) const;
    Block list_block(std::uint32_t tile, std::uint32_t other, ParticlePairs& pairs) const;
    void relist(std::uint32_t tile, Scratch& scratch);

    const ParticleSearchLoops* loops_ = nullptr;
    std::vector<SearchedParticles> cloths_;
    std::vector<Tile> tiles_;
    AlignedVector<Motion> motions_;
    AlignedVector<ListedTile> listed_;
    AlignedVector<Vec4> listed_places_;  // by place in a tile, [tile · particle_tile + place]
    std::vector<Row> rows_;
    std::vector<std::vector<std::uint32_t>> near_, fresh_near_;  // by tile: itself and near tiles of higher numbers
    Grouped grouped_;
    bool reached_ = false;          // find_near_tiles() has run
    std::vector<Scratch> scratch_;  // by worker
};

}  // namespace weft
