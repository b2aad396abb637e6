// Lists all pairs of features of cloth that can come within their thickness: vertices and triangles, edges and edges.
//
// A list stays valid while every particle is near its listed trajectory, a uniform motion. A check after each substep
// finds the tiles whose particles are not, and only pairs of these tiles are searched again. A list may hold more pairs
// than are near; their order does not depend on when they were listed.
#pragma once

#include "base/collision_filter.h"
#include "base/workers.h"
#include "collide/seams.h"
#include "collide/tiles.h"
#include "collide/uneven_thickness.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace weft {

/// Centers and half sizes of boxes, as [axis][box].
template <std::size_t Count>
struct BoxArrays {
    alignas(cache_line) std::array<std::array<float, Count>, 3> center, half;
};

/// Features of one kind of a tile, as arrays. Neighboring features form groups, which have boxes too.
template <std::size_t Count, std::size_t Corners>
struct FeatureArrays {
    alignas(cache_line)
        std::array<std::array<float, Count>, Corners> number;  ///< of the corners' particles: equal for equal particles
    BoxArrays<Count> boxes;
    BoxArrays<16> groups;
};

/// A cloth as the search needs it.
struct SearchedCloth {
    std::shared_ptr<const std::vector<Tile>> tiles;
    std::uint32_t base = 0;                   ///< number of its first particle in the world
    const Vec4* rest = nullptr;               ///< m, by particle of the cloth
    float thickness = 0;                      ///< m, where it is thickest
    float slack = 0;                          ///< m: how far a particle may be from its listed trajectory at most
    bool surface = false;                     ///< of a collider: it forms pairs with cloths alone
    bool thin = false;                        ///< beside its edges, so that rounding tilts the normals of its pairs
    CollisionFilter filter = {};              ///< for other cloths
    std::shared_ptr<const Seams> seams = {};  ///< the same ones for all cloths; null if there are none
    UnevenThickness uneven = {};
    friend bool operator==(const SearchedCloth&, const SearchedCloth&) = default;
};

/// A tile and the trajectory of its vertices that the lists were made for: place + velocity * ticks since then.
struct TileState {
    const Tile* tile = nullptr;
    std::uint32_t cloth = 0;
    std::array<std::uint32_t, tile_vertices> particle;                ///< in the world
    std::array<std::array<float, tile_vertices>, 3> place, velocity;  ///< m and m per tick
    std::array<float, tile_vertices> around;  ///< m: the lists cover all points this near the trajectory besides
    std::int64_t listed = -1;                 ///< tick; -1: never
    std::int32_t lifetime = 4;                ///< ticks that a list of a moving tile is made for
    bool moving = false;
    Vec3 mean_velocity{};
    float spread = 0;  ///< m per tick: largest deviation of a vertex's velocity from the mean
    /// m: bound on the distance of its vertices from their trajectories, at the start and at the end of the tick.
    std::array<float, 2> strays{};
    float most_around = 0;  ///< of all vertices
    float slack = 0;        ///< m: how far a vertex may be from its listed trajectory; at most that of the cloth
    float deviation = -1;   ///< m: of a tile that rests in this frame, from its trajectory; negative: not known yet

    // At the tick `bounded`.
    std::int64_t bounded = -1;
    float middle = 0;  ///< ticks: half of the time that the list lasts from then on
    alignas(cache_line) std::array<Vec4, tile_vertices> now;  ///< w: farthest deviation from the mean motion
    std::array<float, 3> center, half;                        ///< of the box around all vertices

    // At the tick `gathered`.
    std::int64_t gathered = -1;
    FeatureArrays<tile_vertices, 1> vertices;  ///< that it owns
    FeatureArrays<tile_edges, 2> edges;
    FeatureArrays<tile_triangles, 3> triangles;

    std::uint32_t base() const { return particle[0] - tile->particle[0]; }  ///< of the cloth
};

/// Pairs of one kind, as arrays. Their ends are padded with 16 pairs of negative thickness.
struct PairList {
    std::array<AlignedVector<std::uint32_t>, 4> particle;  ///< in the world
    AlignedVector<float> thickness;                        ///< m
    AlignedVector<float> spare;  ///< m: by how much the distance exceeded the thickness when the pair was listed
    std::uint32_t count = 0;

    void reserve(std::uint32_t pairs);
    void append(const PairList& other, std::uint32_t begin, std::uint32_t pairs);
    void pad(std::uint32_t with_particle);
};

/// Features in a kind of pair.
enum class PairKind : std::uint8_t { vertex_triangle, edge_edge };

/// All pairs of a tile with itself and with tiles of higher numbers.
struct TilePairs {
    struct Block {
        std::uint32_t other = 0;
        std::array<std::uint32_t, 2> begin{}, count{};  ///< by kind, in `lists`
        std::array<float, 2> least_spare{};             ///< m, by kind
        std::int64_t until = 0;                         ///< tick from which on the block is not valid
        std::int64_t listed = 0;                        ///< tick in which it was made
        /// Ticks after it was made for which distances were computed: of the relative motion of both tiles, and of the
        /// motion within either of them.
        std::array<float, 3> middle{};
    };
    std::array<PairList, 2> lists;  ///< by kind
    std::vector<Block> blocks;      ///< by ascending `other`
    std::int64_t until = 0;         ///< the least of all blocks
};

/// How two tiles move relative to each other while a list of their pairs lasts.
struct TileReach {
    std::array<float, 3> shift, widen;  ///< m: half of the relative motion, and how much farther boxes reach
    float add = 0;               ///< m: pairs whose distance is at most this more than their thickness are listed
    float thickness = 0;         ///< m: of the thickest pair
    const Vec4* rest = nullptr;  ///< by particle of the cloth, if both tiles belong to one cloth
    std::array<float, 2> of_cloths = {};         ///< m: SearchedCloth::thickness of both
    std::array<UnevenThickness, 2> uneven = {};  ///< of both
    bool is_uneven() const { return uneven[0] || uneven[1]; }
};

/// Working memory of SearchLoops::list_pairs.
struct SearchScratch {
    static constexpr std::size_t most_pairs = std::size_t{tile_edges} * tile_edges;
    // Boxes of the features of one tile, by axis.
    alignas(cache_line) std::array<std::array<float, tile_edges>, 3> center, half;
    // Packets of pairs whose boxes meet: the lanes that do as the lowest 16 bits, then the one feature, then the first
    // of as many other ones as there are lanes.
    std::array<std::uint32_t, most_pairs + 1> packet;
    std::uint32_t packets = 0;

    // Pairs, one after another. First those whose boxes meet, by their vertices in the tiles; then those that come
    // within the thickness of their tiles, by particles.
    std::array<std::array<std::uint32_t, most_pairs + 32>, 4> vertex;
    std::array<AlignedVector<std::uint32_t>, 4> particle;  ///< in their cloths
    AlignedVector<float> far;        ///< m: how much farther than their thickness the pairs to be listed may be apart
    AlignedVector<float> distance;   ///< m
    AlignedVector<float> thickness;  ///< m, of the pairs
    std::uint32_t count = 0;
};

/// The inner loops, one table per instruction set.
struct SearchLoops {
    /// Largest distance of a vertex from its listed trajectory, m. Not a number if a position is not.
    float (*deviation)(const TileState&, const float* positions, float ticks);
    /// Vertices at a tick, `ticks` after the list was made, with half of their motion relative to the mean while the
    /// list lasts, and their box for that time.
    void (*bound)(TileState&, float ticks);
    /// Largest distance between two places of a vertex that the tile owns, m. Places as blocks of four.
    float (*measure)(const TileState&, const float* places, const float* other_places);
    /// Features of a tile whose vertices are bounded.
    void (*gather)(TileState&);
    /// Appends the pairs of features of both tiles to `lists`.
    void (*list_pairs)(const TileState& a, const TileState& b, const TileReach&, SearchScratch&,
                       std::array<PairList, 2>& lists);
};

/// Functions with a team share their work among its workers. The result does not depend on it.
class PairSearch {
  public:
    /// Starts anew with these cloths, whose particles must not overlap. Keeps all lists if nothing differs.
    void set_cloths(const SearchLoops& loops, std::vector<SearchedCloth> cloths);

    /// The cloths (by index) that do not move in this frame. Call before check_start(), after set_cloths().
    void set_resting(std::span<const std::uint8_t> rests) { rests_.assign(rests.begin(), rests.end()); }
    /// Drops the lists of tiles with a vertex farther than its slack from its listed trajectory at the start of the
    /// current tick. Call where positions may have changed from outside.
    void check_start(const Vec4* positions);

    /// The largest distance between two places of a vertex of each tile, m.
    void measure(const Vec4* places, const Vec4* other_places, std::vector<float>& distance, const LedTeam& team = {});
    /// Marks the tiles with a vertex that may be farther than its slack from its listed trajectory at the end of the
    /// current tick: as far as `reach` (m, by tile; empty: 0) from `positions`. Or marks all tiles. Returns whether
    /// there is anything to search.
    bool find_outdated(const Vec4* positions, std::span<const float> reach, bool all = false, const LedTeam& team = {});
    /// Lists the marked tiles for motion from `from` to `to` within this tick, and on along `velocity` (m/s) times `h`
    /// if that is near. Covers all places within `reach` of `to` in this tick.
    void follow(const Vec4* from, const Vec4* to, const Vec4* velocity, float h, std::span<const float> reach,
                const LedTeam& team = {});
    /// Lists the marked tiles for all places between `from` and `to`, for this tick only.
    void cover(const Vec4* from, const Vec4* to);
    /// Lists all pairs of which a tile is marked or whose list has expired. find_outdated() and follow() come before.
    void search(const LedTeam& team = {});
    void next_tick();

    /// Calls visit(tile, its pairs, block, approach) for the blocks of every so many tiles, from one on. `approach`, in
    /// m: the distance of a listed pair is now at least its distance when it was listed less this, for all places that
    /// its particles take in this tick up to the positions of the last find_outdated().
    template <class Visit>
    void for_each_block(unsigned first, unsigned every, Visit&& visit) const {
        for (std::uint32_t a = first; a < pairs_.size(); a += every)
            for (const TilePairs::Block& block : pairs_[a].blocks)
                visit(a, pairs_[a], block, approach(tiles_[a], tiles_[block.other], block));
    }
    std::span<const SearchedCloth> cloths() const { return cloths_; }
    const SearchedCloth& cloth(std::uint32_t tile) const { return cloths_[tiles_[tile].cloth]; }
    std::size_t tile_count() const { return tiles_.size(); }
    /// Whether the last find_outdated() marked the tile.
    bool outdated(std::uint32_t tile) const { return outdated_[tile] != 0; }
    /// Tiles searched since set_cloths().
    std::uint64_t searched_tiles() const { return searched_; }

  private:
    bool rests(const TileState& tile) const { return !rests_.empty() && rests_[tile.cloth] != 0; }
    float deviation(TileState& tile, const Vec4* positions, float ticks) const;
    float full_slack(const TileState& tile) const { return cloths_[tile.cloth].slack; }
    std::int64_t remaining(const TileState& tile) const;
    void find_owners();
    void follow(TileState& tile, const Vec4* from, const Vec4* to, const Vec4* velocity, float h, float reach);
    void cover(TileState& tile, const Vec4* from, const Vec4* to);
    void begin_list(TileState& tile, bool moving);
    void bound(TileState& tile);
    void gather(TileState& tile);
    void bound_tiles(const LedTeam& team);
    void find_near_tiles();
    template <class Work>
    void for_each_tile(const LedTeam& team, Work&& work) {
        team.run([&](unsigned worker) {
            const Share mine = share_of(static_cast<std::uint32_t>(tiles_.size()), 1, worker, team.size());
            for (std::uint32_t i = mine.begin; i < mine.end; ++i) work(i);
        });
    }
    int sort_tiles();
    float approach(const TileState& a, const TileState& b, const TilePairs::Block& block) const;
    TileReach reach(std::uint32_t tile_a, std::uint32_t tile_b, TilePairs::Block& block) const;
    void find_rows();
    bool is_old(std::uint32_t a, const TilePairs::Block& block) const;
    struct Workspace {
        TilePairs fresh;
        SearchScratch scratch;
    };
    void list_row(std::uint32_t a, Workspace& workspace);
    void list_block(std::uint32_t a, std::uint32_t b, Workspace& workspace) const;
    void apply_seams(int kind, PairList& list, std::uint32_t begin) const;

    const SearchLoops* loops_ = nullptr;
    std::vector<SearchedCloth> cloths_;
    std::vector<TileState> tiles_;
    std::vector<TilePairs> pairs_;
    std::vector<std::vector<std::uint32_t>> owners_;  // by tile: other tiles that own some of its vertices
    std::vector<float> of_owned_;                     // m, by tile: measured distance of the vertices that it owns
    std::vector<std::uint8_t> outdated_;
    std::vector<std::uint8_t> rests_;               // by cloth; empty: none
    std::array<AlignedVector<float>, 9> bounds_;    // of all tiles: center, half, mean velocity
    std::vector<std::uint32_t> sorted_;             // tiles along an axis
    std::vector<std::vector<std::uint32_t>> near_;  // by tile: tiles of higher numbers to list it with
    std::int64_t tick_ = 0;
    std::uint64_t searched_ = 0;
    std::vector<float> thickness_;  // m, by tile: of its thickest vertex
    float thickest_ = 0, most_slack_ = 0;
    std::vector<std::uint32_t> rows_;                     // tiles of which pairs are to be listed
    std::vector<std::uint32_t> to_gather_;                // tiles whose features that needs
    std::vector<std::unique_ptr<Workspace>> workspaces_;  // by worker
};

}  // namespace weft
