#include "solver/model/faces_around.h"

#include "solver/model/constraint_table.h"

#include <algorithm>

namespace weft {
namespace {

// Lists of equal length cost a fifth per triangle. They gain nothing if they have more than this many elements per
// triangle.
constexpr std::size_t most_padding = 4;

}  // namespace

FacesAround lay_out_around(const Adjacency& particle_triangles, std::uint32_t nothing) {
    const std::uint32_t count = particle_triangles.size();
    FacesAround around;
    around.begin.reserve(padded(count) / lane_padding + 1);
    around.own.reserve(padded(count) / lane_padding);
    around.begin.push_back(0);
    for (std::uint32_t first = 0; first < count; first += lane_padding) {
        const std::uint32_t end = std::min(first + lane_padding, count);
        std::size_t longest = 0, all = 0;
        for (std::uint32_t p = first; p < end; ++p) {
            longest = std::max(longest, particle_triangles[p].size());
            all += particle_triangles[p].size();
        }
        if (longest * lane_padding > most_padding * all) longest = 0;
        around.begin.push_back(around.begin.back() + static_cast<std::uint32_t>(longest));
    }
    around.triangles.resize(std::size_t{around.begin.back()} * lane_padding, nothing);
    for (std::uint32_t packet = 0; packet + 1 < around.begin.size(); ++packet) {
        const std::uint32_t first = packet * lane_padding, end = std::min(first + lane_padding, count);
        const bool abreast = around.abreast(packet);
        around.own.push_back(static_cast<std::uint32_t>(around.offsets.size()));
        for (std::uint32_t lane = 0; !abreast && lane <= lane_padding; ++lane) {
            around.offsets.push_back(static_cast<std::uint32_t>(around.items.size()));
            if (lane == lane_padding || first + lane >= end) continue;
            const auto list = particle_triangles[first + lane];
            around.items.insert(around.items.end(), list.begin(), list.end());
        }
        const std::size_t at = std::size_t{around.begin[packet]} * lane_padding;
        for (std::uint32_t p = first; abreast && p < end; ++p) {
            for (std::size_t k = 0; k < particle_triangles[p].size(); ++k) {
                around.triangles[at + k * lane_padding + (p - first)] = particle_triangles[p][k];
            }
        }
    }
    return around;
}

}  // namespace weft
