#include "physics/tether/geodesic.h"

#include "base/lowest_first.h"
#include "base/prefetch.h"
#include "physics/tether/through_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace weft {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A triangle, as stored for one of its corners.
struct Sector {
    std::array<std::uint32_t, 2> others;  // the next two corners in the triangle's order
    std::array<float, 2> side;            // m, from this corner to them
    float twice_area;                     // m²

    /// Lower bound for the distance at the third corner of a front with distance d here and d_from at others[from].
    /// Through a point X of the side between the two, |SC| = |SX| + |XC|, with |SX| >= |SA| - |XA|, |SX| >= |SB| - |XB|
    /// and |XC| no less than the height.
    double earliest_from(std::size_t from, double d, double d_from) const {
        constexpr double rounding = 1e-6;  // more than the rounding of floats
        const float ab = side[from], height = twice_area / ab;
        return (d + d_from - ab) / 2 + height - rounding * (d + d_from + ab + height);
    }
    /// Lower bound for the distance at others[to], along the side.
    double earliest_along(std::size_t to, double d) const { return d + side[to] * (1 - 1e-6); }
};

// The sectors of each particle, its triangles ascending. They are stored contiguously, because fronts visit particles
// in a cache-unfriendly order, and prefetched when a front first reaches a neighbor.
class Sectors {
  public:
    explicit Sectors(const Topology& topology)
        : offsets_(topology.particle_triangles.offsets), sectors_(topology.particle_triangles.items.size()) {
        std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end());
        const auto& x = topology.rest_positions;
        for (const Triangle& t : topology.triangles) {
            const float twice_area = length(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
            const std::array<float, 3> side = {length(x[t[1]] - x[t[0]]), length(x[t[2]] - x[t[1]]),
                                               length(x[t[0]] - x[t[2]])};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t second = (k + 1) % 3, third = (k + 2) % 3;
                sectors_[next[t[k]]++] = {{t[second], t[third]}, {side[k], side[third]}, twice_area};
            }
        }
    }
    std::span<const Sector> operator[](std::uint32_t particle) const {
        return std::span(sectors_).subspan(offsets_[particle], offsets_[particle + 1] - offsets_[particle]);
    }
    WEFT_PREFETCH void will_need(std::uint32_t particle) const {
        const auto own = (*this)[particle];
        prefetch(own.data(), own.size_bytes());
    }

  private:
    std::span<const std::uint32_t> offsets_;
    std::vector<Sector> sectors_;
};

// Computes ways_to_places(). A known geodesic has the index most · particle + i; it is final once it leaves the queue.
class March {
  public:
    March(const Topology& topology, std::uint32_t most)
        : topology_(topology),
          sectors_(topology),
          ways_{most, std::vector<Way>(std::size_t{most} * topology.particle_count)},
          final_(ways_.ways.size()),
          queue_(ways_.ways.size()) {}

    WaysToPlaces run(std::span<const std::vector<std::uint32_t>> places) {
        for (std::uint32_t place = 0; place < places.size(); ++place) {
            for (const std::uint32_t source : places[place]) offer(source, {0, place, source});
        }
        while (!queue_.empty()) {
            const std::uint32_t way = queue_.pop().item;
            final_[way] = 1;
            const Way front = ways_.ways[way];
            const std::uint32_t particle = way / ways_.most;
            for (const Sector& sector : sectors_[particle]) pass(sector, particle, front);
        }
        return std::move(ways_);
    }

  private:
    std::span<Way> ways_from(std::uint32_t particle) {
        return std::span(ways_.ways).subspan(std::size_t{ways_.most} * particle, ways_.most);
    }
    bool is_final(const Way& way) const { return final_[static_cast<std::size_t>(&way - ways_.ways.data())]; }

    /// The known geodesic from the particle to the place, or null.
    const Way* find(std::uint32_t particle, std::uint32_t place) {
        for (const Way& way : ways_from(particle)) {
            if (way.place == place) return &way;
        }
        return nullptr;
    }

    /// Stores a distance that is shorter than the known one. A final distance may still become shorter, if a front
    /// arrives around an obtuse triangle; it is not propagated again.
    void offer(std::uint32_t particle, const Way& offered) {
        Way* taken = nullptr;
        for (Way& way : ways_from(particle)) {
            if (way.place == offered.place || way.place == none) {
                taken = &way;
                break;
            }
            // If there is no room, replaces the farthest that is not final.
            if (!is_final(way) && (!taken || taken->distance < way.distance)) taken = &way;
        }
        if (!taken || (taken->place != none && !(offered.distance < taken->distance))) return;
        *taken = offered;
        if (!is_final(*taken)) queue_.put(static_cast<std::uint32_t>(taken - ways_.ways.data()), offered.distance);
    }

    /// Propagates a front from p to the two other corners of a triangle.
    void pass(const Sector& sector, std::uint32_t p, const Way& front) {
        const Way* known[2] = {find(sector.others[0], front.place), find(sector.others[1], front.place)};
        const bool final[2] = {known[0] && is_final(*known[0]), known[1] && is_final(*known[1])};
        const auto& x = topology_.rest_positions;
        for (const std::size_t i : {0, 1}) {
            const std::uint32_t q = sector.others[i], r = sector.others[1 - i];
            if (!final[i]) {  // along the edge
                if (known[i] && sector.earliest_along(i, front.distance) > known[i]->distance) continue;
                if (!known[i]) sectors_.will_need(q);
                const double d = front.distance + std::sqrt(dot_exact(x[q] - x[p], x[q] - x[p]));
                offer(q, {d, front.place, front.source});
                continue;
            }
            // Distances from different sources cannot be combined.
            const double dq = known[i]->distance;
            if (known[i]->source != front.source) continue;
            if (known[1 - i] && sector.earliest_from(i, front.distance, dq) > known[1 - i]->distance) continue;
            const double arrival = through_triangle(x[p], x[q], x[r], front.distance, dq);
            if (arrival < infinity) offer(r, {arrival, front.place, front.source});
        }
    }

    const Topology& topology_;
    const Sectors sectors_;
    WaysToPlaces ways_;
    std::vector<std::uint8_t> final_;  // per way
    LowestFirst queue_;
};

}  // namespace

WaysToPlaces ways_to_places(const Topology& topology, std::span<const std::vector<std::uint32_t>> places,
                            std::uint32_t most) {
    return March(topology, most).run(places);
}

Geodesic geodesic_distance(const Topology& topology, std::span<const std::uint32_t> sources) {
    const std::vector<std::uint32_t> place(sources.begin(), sources.end());
    const WaysToPlaces ways = ways_to_places(topology, std::span(&place, 1), 1);
    Geodesic result{std::vector<float>(topology.particle_count, std::numeric_limits<float>::infinity()),
                    std::vector<std::uint32_t>(topology.particle_count, none)};
    for (std::uint32_t p = 0; p < topology.particle_count; ++p) {
        for (const Way& way : ways[p]) {
            result.distance[p] = static_cast<float>(way.distance);
            result.nearest[p] = way.source;
        }
    }
    return result;
}

}  // namespace weft
