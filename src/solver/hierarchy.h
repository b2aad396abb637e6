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
#include "solver/constraint_table.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// How what moves the nodes of a level moves those of the finer one: up to four parents each, SoA, padded with parents
/// of weight 0.
struct Carry {
    static constexpr std::uint32_t parents = 4;
    std::uint32_t stride = 0;
    AlignedVector<std::uint32_t> node;  ///< [parent · stride + finer node]
    AlignedVector<float> weight;        ///< likewise; sums to 1, to 0 for what is pinned
};

/// Where a node takes its place from: itself and up to three pairs of finer nodes (or particles) on opposite sides of
/// it, SoA, weighted so that at rest their mean lies where the node does, or nearly so. One particle alone may quiver,
/// and a node that followed it would set all around quivering.
struct Surroundings {
    static constexpr std::uint32_t members = 7;
    std::uint32_t stride = 0;
    AlignedVector<std::uint32_t> node;  ///< [member · stride + node]; the first is the node itself
    AlignedVector<float> weight;        ///< likewise; sums to 1
};

struct CoarseLevel {
    std::uint32_t count = 0;
    AlignedVector<std::uint32_t> particle;  ///< node -> particle; padded
    Surroundings around;                    ///< in the next finer level; of the first level, particles
    AlignedVector<float> weight;            ///< 1/kg per node: of all that it carries; padded with zeros
    ConstraintTable reach;                  ///< rows between nodes
    Carry carry;                            ///< to the next finer level; of the first level, to the particles

    std::uint32_t capacity() const { return particle_capacity(count); }
};

/// How far apart the nodes of the finest level are, in edges. Lines carry an error over several edges by themselves.
enum class FinestLevel { every_second, every_fourth };

/// The finest level first; each has about a quarter of the nodes of the one before. Empty for cloths so small that they
/// have no use for it. `weight`: inverse mass of each particle, 0 for pinned ones.
std::vector<CoarseLevel> build_hierarchy(const RestShape& rest, const Fabric& fabric, std::span<const Vec4> start,
                                         FinestLevel finest = FinestLevel::every_second);

}  // namespace weft
