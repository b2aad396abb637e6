// Coarse levels over a cloth: a pull at one end of it reaches the other in a few rows.
//
// Projection carries an error from neighbor to neighbor, so large cloths stretch: one sweep over rows of 1 cm moves
// nothing that is 1 m away. A coarse level is a subset of the particles with rows between neighbors in it, each keeping
// two nodes within reach of one another (physics/reach). What the rows make of the nodes is carried to the particles
// between them, level by level, and the fine rows have little left to do (Müller 2008, "Hierarchical Position Based
// Dynamics", with other levels and rows).
#pragma once

#include "physics/rest_shape.h"
#include "scene/fabric.h"
#include "solver/model/constraint_table.h"
#include "solver/model/link_graph.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// How what moves the nodes of a level moves those of the finer one: up to four parents each, SoA, padded with parents
/// of weight 0.
struct Carry {
    static constexpr std::uint32_t parents = 4;
    std::uint32_t stride = 0;
    AlignedVector<std::uint16_t> narrow;  ///< [parent · stride + finer node]: the parent, where 16 bits hold them all
    AlignedVector<std::uint32_t> wide;    ///< likewise, where they do not; one of the two is empty
    AlignedVector<float> weight;          ///< likewise; sums to 1, to 0 for what is pinned

    std::uint32_t node(std::size_t at) const { return narrow.empty() ? wide[at] : narrow[at]; }
};

/// Where a node takes its place from: the mean of all that it carries, weighted by mass and share. That is the
/// transpose of Carry, and has to be. Rows between such means and a displacement that is carried back are constraints
/// on the particles themselves, and what projects those takes energy out of them; of nodes that follow less than what
/// they move, waves shorter than a cell of nodes are taken for longer ones, and feed them. Pinned nodes are their
/// own place.
///
/// Lists of lane_padding nodes side by side, shorter ones ending in weights of 0.
struct Restriction {
    AlignedVector<std::uint32_t> begin;  ///< packet of nodes -> its first member, and an end
    AlignedVector<std::uint32_t> node;   ///< [member · lane_padding + node in its packet]: of the next finer level
    AlignedVector<float> weight;         ///< likewise; sums to 1
};

struct CoarseLevel {
    std::uint32_t count = 0;
    AlignedVector<std::uint32_t> particle;  ///< node -> particle; padded
    Restriction restriction;                ///< from the next finer level; of the first level, from particles
    AlignedVector<float> weight;            ///< 1/kg per node: of all that it carries; padded with zeros
    ConstraintTable reach;                  ///< rows between nodes
    Carry carry;                            ///< to the next finer level; of the first level, to the particles
    LinkGraph ways;                         ///< between nodes; until the model is built

    std::uint32_t capacity() const { return particle_capacity(count); }
};

/// How far apart the nodes of the finest level are, in edges. Lines carry an error over several edges by themselves.
enum class FinestLevel { every_second, every_fourth };

/// The finest level first; each has about a quarter of the nodes of the one before. Empty for cloths so small that they
/// have no use for it. `weight`: inverse mass of each particle, 0 for pinned ones.
std::vector<CoarseLevel> build_hierarchy(const RestShape& rest, const Fabric& fabric, std::span<const Vec4> start,
                                         FinestLevel finest = FinestLevel::every_second);

}  // namespace weft
