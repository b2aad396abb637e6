#include "solver/model/pin_loads.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace weft {
namespace {

constexpr double gravity = 9.81;  // m/s²

// Values from trials with sheets between pins (pin_load.md).
constexpr double least_concentration = 1.5;  // largest tension of a group that bears much, over that of a hanging sheet
constexpr double ordinary = 0.2;             // tension that is left out, over that of a hanging sheet
constexpr double steadying = 12;             // mass of an edge over tension h²
constexpr double steady_edges = 4;           // distance, in edges, at which a quarter of this mass is left
constexpr double give_factor = 1.45;         // extension of a limit over that of the cloth along the edges
constexpr double edge_loads = 3;             // load of a pin over m ℓ/h² at which limits give half
// Width of the bands of cloth at one distance from a pin: in edges, or as a factor of the distance if that is wider.
constexpr double band_edges = 1, band_factor = 1.4;
// Woven cloth extends along its bias until the threads run along the pull: √2 - 1.
constexpr double most_shear = 0.42;

// The nearest pins of all particles, along edges.
class NearestPins {
  public:
    NearestPins(const LinkGraph& edges, const PinGroups& groups)
        : distance(edges.size(), LocalWays::unreached),
          pin(edges.size()),
          group(edges.size(), none),
          before(edges.size(), none),
          members(groups.size()) {
        for (std::uint32_t p = 0; p < edges.size(); ++p) pin[p] = p;
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
        for (std::uint32_t g = 0; g < groups.size(); ++g)
            for (const std::uint32_t p : groups[g]) distance[p] = 0, group[p] = g, waiting.emplace(0, p);
        while (!waiting.empty()) {
            const auto [d, p] = waiting.top();
            waiting.pop();
            if (d > distance[p]) continue;
            members[group[p]].push_back(p);
            for (const Link& link : edges[p]) {
                if (!(d + link.length < distance[link.to])) continue;
                distance[link.to] = d + link.length, before[link.to] = p;
                pin[link.to] = pin[p], group[link.to] = group[p];
                waiting.emplace(distance[link.to], link.to);
            }
        }
    }

    std::vector<double> distance;                     // m
    std::vector<std::uint32_t> pin, group;            // as in PinLoads
    std::vector<std::uint32_t> before;                // the particle before this one on the way from its pin
    std::vector<std::vector<std::uint32_t>> members;  // per group: its particles, nearest first
};

// Tension at each member of a group, N/m: the weight of the cloth behind it over the width of the cloth at its
// distance.
std::vector<double> tensions_of(const std::vector<std::uint32_t>& members, const NearestPins& nearest,
                                std::span<const double> mass, double density, double unit) {
    std::vector<double> within = {0}, tensions;  // kg of the first members
    for (const std::uint32_t p : members) within.push_back(within.back() + mass[p]);
    const auto mass_within = [&](double r) {
        const auto end = std::ranges::upper_bound(members, r, {}, [&](auto p) { return nearest.distance[p]; });
        return within[static_cast<std::size_t>(end - members.begin())];
    };
    const double farthest = nearest.distance[members.back()];
    for (const std::uint32_t p : members) {
        const double r = nearest.distance[p];
        const double low = std::max(std::min(r - band_edges * unit, r / band_factor), 0.0);
        const double high = std::min(std::max(r + band_edges * unit, r * band_factor), farthest);
        const double band = (mass_within(high) - mass_within(low)) / density;  // m²
        const double behind = within.back() - mass_within(r) + 0.5 * mass[p];
        tensions.push_back(band > 0 && r > 0 ? gravity * behind * (high - low) / band : 0);
    }
    return tensions;
}

}  // namespace

PinLoads find_pin_loads(const LinkGraph& edges, const PinGroups& groups, std::span<const double> mass, double density,
                        double extent, const Elasticity& elasticity) {
    const double softest = limit_any_way(elasticity, 1).compliance;
    if (!(softest > 0) || groups.empty()) return {};
    NearestPins nearest(edges, groups);
    const double unit = mean_length(edges), hanging = density * gravity * extent;
    const double threads = std::max(elasticity.warp, elasticity.weft);
    std::vector<double> tension(edges.size());  // beyond that of a hanging sheet
    PinLoads loads{.steadiness = std::vector<double>(edges.size()),
                   .give = std::vector<double>(edges.size()),
                   .ease = std::vector<double>(edges.size()),
                   .pin = {},
                   .group = {}};
    bool any = false;
    for (std::size_t g = 0; g < nearest.members.size(); ++g) {
        const std::vector<std::uint32_t>& members = nearest.members[g];
        const std::vector<double> all = tensions_of(members, nearest, mass, density, unit);
        if (!(std::ranges::max(all) > least_concentration * hanging)) continue;
        any = true;
        double sum = 0;
        for (const std::uint32_t p : members) sum += mass[p];
        const double free = static_cast<double>(members.size() - groups[g].size());
        const double at_pin = gravity * sum / static_cast<double>(groups[g].size()),
                     of_edge = edge_loads * sum / free * unit;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const std::uint32_t p = members[i], from = nearest.before[p];
            if (!(nearest.distance[p] > 0)) continue;
            tension[p] = std::max(all[i] - ordinary * hanging, 0.0);
            const double mean = !(nearest.distance[from] > 0) ? tension[p] : 0.5 * (tension[p] + tension[from]);
            const double strain = std::min(softest * mean, most_shear + threads * mean);
            loads.give[p] = loads.give[from] + give_factor * strain * (nearest.distance[p] - nearest.distance[from]);
            loads.ease[p] = at_pin / of_edge;
        }
    }
    if (!any) return {};
    const auto felt = [&](std::uint32_t p) {
        const double far = 1 + nearest.distance[p] / (steady_edges * unit);
        return tension[p] > 0 ? tension[p] / (far * far) : 0;
    };
    for (std::uint32_t p = 0; p < edges.size(); ++p) {
        if (!(mass[p] > 0)) continue;
        double of_edges = 0;
        for (const Link& link : edges[p]) of_edges += 0.5 * (felt(p) + felt(link.to));
        loads.steadiness[p] = steadying * of_edges / mass[p];
    }
    loads.pin = std::move(nearest.pin), loads.group = std::move(nearest.group);
    return loads;
}

}  // namespace weft
