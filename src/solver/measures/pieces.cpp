#include "solver/measures/pieces.h"

#include "base/disjoint_sets.h"
#include "mesh/grouping.h"
#include "solver/model/tear_table.h"

#include <algorithm>

namespace weft {
namespace {

struct Side {
    std::uint32_t upper;  // end of the edge
    std::uint32_t triangle;
};

DisjointSets pieces_of(const ClothModel& model) {
    const TriangleView triangles = model.triangles();
    // Sides of triangles by the lower end of their edge.
    const auto sides = group_items<Side>(model.particle_count, [&](auto put) {
        for (std::uint32_t t = 0; t < model.triangle_count; ++t)
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
                if (a != b) put(std::min(a, b), Side{std::max(a, b), t});
            }
    });
    DisjointSets pieces(model.triangle_count);
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        for (std::uint32_t i = sides.offsets[p]; i < sides.offsets[p + 1]; ++i)
            for (std::uint32_t j = sides.offsets[p]; j < i; ++j)
                if (sides.items[i].upper == sides.items[j].upper)
                    pieces.merge(sides.items[i].triangle, sides.items[j].triangle);
    }
    return pieces;
}

}  // namespace

std::vector<OpenEdge> open_edges(const ClothModel& model) {
    std::vector<OpenEdge> open;
    if (!model.tears) return open;
    const auto& entries = model.tears->entries;
    const auto& faces = model.faces;
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        const TearTable::Entry& entry = entries[i];
        if (entry.next == none || entry.twin < i) continue;  // each edge once
        const OpenEdge sides{EdgeEnds{faces[entry.corner], faces[entry.far]},
                             EdgeEnds{faces[entries[entry.next].corner], faces[entry.next_far]}};
        const bool removed = sides[0][0] == sides[0][1] && sides[1][0] == sides[1][1];
        if (sides[0] != sides[1] && !removed) open.push_back(sides);
    }
    return open;
}

Pieces find_pieces(const Frame& frame) {
    Pieces found;
    for (std::uint32_t cloth = 0; cloth < frame.cloths.size(); ++cloth) {
        const ClothModel& model = *frame.cloths[cloth].model;
        found.torn_edges += open_edges(model).size();
        DisjointSets pieces = pieces_of(model);
        std::vector<double> area(model.triangle_count);
        std::vector<std::uint64_t> triangles(model.triangle_count);
        double whole = 0;
        for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
            if (!(model.face_area[t] > 0)) continue;  // it was removed
            const std::uint32_t piece = pieces.first_of(t);
            area[piece] += double{model.face_area[t]};
            ++triangles[piece];
            whole += double{model.face_area[t]};
        }
        for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
            if (triangles[t] == 0) continue;
            ++found.count;
            const double part = area[t] / whole;
            if (found.smallest.triangles == 0 || part < found.smallest.part)
                found.smallest = {cloth, triangles[t], part};
        }
    }
    return found;
}

}  // namespace weft
