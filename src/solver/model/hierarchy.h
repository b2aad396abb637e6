// Coarse levels of a cloth, which propagate a pull from one end of the cloth to the other in few constraints.
//
// Projection propagates an error only from neighbor to neighbor, so large cloths stretch: one sweep over constraints of
// 1 cm moves nothing that is 1 m away. A coarse level is a subset of the particles (its nodes) with constraints between
// neighboring nodes that limit their distance (physics/coarse_limit). Corrections of the nodes are interpolated to the
// particles between them, level by level, and leave little error for the fine constraints (Müller 2008, "Hierarchical
// Position Based Dynamics", with other levels and constraints).
#pragma once

#include "physics/rest_shape.h"
#include "scene/fabric.h"
#include "solver/model/constraint_table.h"
#include "solver/model/link_graph.h"
#include "solver/model/pin_loads.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// Prolongation: interpolates the displacements of a level's nodes to the nodes of the next finer level. Each finer
/// node has up to four parents; the arrays are padded with parents of weight 0.
struct Prolongation {
    static constexpr std::uint32_t parents = 4;
    std::uint32_t stride = 0;
    AlignedVector<std::uint16_t> narrow;  ///< [parent · stride + finer node]: the parent, if 16 bits suffice
    AlignedVector<std::uint32_t> wide;    ///< the same, if they do not; one of the two is empty
    AlignedVector<float> weight;          ///< [parent · stride + finer node]; sums to 1, or to 0 for pinned nodes

    std::uint32_t node(std::size_t at) const { return narrow.empty() ? wide[at] : narrow[at]; }
};

/// Restriction: the position of a node is the mean of the finer nodes that it moves, weighted by mass and prolongation
/// weight. It must be the transpose of Prolongation. Constraints between such means, whose displacements are
/// interpolated back, are then constraints on the particles themselves, and their projection removes energy. If a mean
/// covered fewer finer nodes than the node moves, waves shorter than the node spacing would alias to longer waves and
/// feed them energy. The position of a pinned node is its particle's.
///
/// Lists of lane_padding nodes are interleaved; shorter lists are filled with weights of 0.
struct Restriction {
    AlignedVector<std::uint32_t> begin;  ///< per packet of nodes: its first member; and one more entry at the end
    AlignedVector<std::uint32_t> node;   ///< [member · lane_padding + node in its packet]: of the next finer level
    AlignedVector<float> weight;         ///< [member · lane_padding + node in its packet]; sums to 1
};

/// Levels with at least this many nodes are shared among threads: a sweep then takes longer than its barriers.
inline constexpr std::uint32_t nodes_for_many_threads = 2048;

struct CoarseLevel {
    std::uint32_t count = 0;
    AlignedVector<std::uint32_t> particle;  ///< node -> particle; padded
    std::vector<std::uint32_t> pinned;      ///< nodes, ascending
    Restriction restriction;                ///< from the next finer level; of the first level, from particles
    AlignedVector<float> weight;            ///< 1/kg per node: inverse of the mass that it moves; padded with zeros
    ConstraintTable limits;                 ///< constraints between nodes
    Prolongation prolongation;              ///< to the next finer level; of the first level, to the particles
    LinkGraph ways;                         ///< graph of the nodes; cleared when the model is built

    std::uint32_t capacity() const { return particle_capacity(count); }
};

/// Spacing of the nodes of the finest level, in edges. Line solves alone propagate an error over several edges.
enum class FinestLevel { every_second, every_fourth };

struct Hierarchy {
    std::vector<CoarseLevel> levels;  ///< finest first; each has about a quarter of the nodes of the previous one
    PinLoads loads;                   ///< of the particles, for which the limits make room
};

/// Empty for small cloths, and for cloths so soft that limits have no effect. `start`: position (m) and inverse mass
/// (1/kg) of each particle, 0 for pinned ones.
Hierarchy build_hierarchy(const RestShape& rest, const Fabric& fabric, std::span<const Vec4> start,
                          FinestLevel finest = FinestLevel::every_second);

}  // namespace weft
