#include "solver/pin_spans.h"

#include "solver/link_graph.h"

#include <algorithm>
#include <limits>

namespace weft {
namespace {

constexpr std::size_t most_pins = 8;
constexpr double near = 0.25;
// Ways along rows have corners, which makes them up to this much longer than they need be.
constexpr double detour = 1.12;
constexpr double unreached = std::numeric_limits<double>::infinity();

LinkGraph graph_of_rows(const CoarseLevel& level) {
    std::vector<std::vector<Link>> links(level.count);
    const ConstraintTable& rows = level.reach;
    for (std::uint32_t row = 0; row < rows.stride; ++row) {
        if (rows.source[row] == none) continue;
        const std::uint32_t a = rows.particles[row], b = rows.particles[rows.stride + row];
        const double length = rows.fields[row];
        links[a].push_back({b, length, length});
        links[b].push_back({a, length, length});
    }
    LinkGraph graph;
    for (const auto& of_node : links) {
        graph.links.insert(graph.links.end(), of_node.begin(), of_node.end());
        graph.offsets.push_back(static_cast<std::uint32_t>(graph.links.size()));
    }
    return graph;
}

}  // namespace

std::vector<PinSpan> find_pin_spans(std::span<const CoarseLevel> hierarchy, std::span<const Vec3> at_rest) {
    // The coarsest level that still tells most_pins pins apart; pins come first in it.
    constexpr std::uint32_t enough_nodes = 256;
    const auto last_fine =
        std::ranges::find_if(hierarchy, [](const auto& level) { return level.count < enough_nodes; });
    if (hierarchy.empty()) return {};
    const CoarseLevel& level = last_fine == hierarchy.begin() ? *last_fine : *(last_fine - 1);
    std::uint32_t pin_count = 0;
    while (pin_count < level.count && level.weight[pin_count] == 0) ++pin_count;
    if (pin_count < 2) return {};

    const LinkGraph graph = graph_of_rows(level);
    LocalSearch search(graph);
    std::vector<std::uint32_t> chosen;
    std::vector<double> nearest(pin_count, unreached);  // of those chosen
    std::vector<PinSpan> spans;
    for (std::uint32_t pin = 0; chosen.size() < std::min<std::size_t>(most_pins, pin_count);) {
        std::vector<double> distance(pin_count, unreached);
        double farthest = 0;
        search.run<&Link::reach>(pin, std::numeric_limits<double>::max(), [&](std::uint32_t node, double d) {
            if (node < pin_count) distance[node] = d;
            farthest = d;  // the nearest come first
            return LocalSearch::Go::on;
        });
        for (const std::uint32_t other : chosen) {
            const double d = distance[other];
            if (!(d < unreached && d >= near * farthest && d > 0)) continue;
            const std::uint32_t a = level.particle[other], b = level.particle[pin];
            const double straight = length(at_rest[a] - at_rest[b]);
            spans.push_back({a, b, static_cast<float>(std::max(straight, d / detour))});
        }
        chosen.push_back(pin);
        for (std::uint32_t other = 0; other < pin_count; ++other)
            nearest[other] = std::min(nearest[other], distance[other]);
        pin = static_cast<std::uint32_t>(std::ranges::max_element(nearest) - nearest.begin());
        if (!(nearest[pin] > 0)) break;
    }
    return spans;
}

float strain_between(std::span<const PinSpan> spans, std::span<const Vec4> positions) {
    float strain = 0;
    for (const PinSpan& span : spans) {
        const float apart = length(positions[span.a].xyz() - positions[span.b].xyz());
        strain = std::max(strain, apart / span.length - 1);
    }
    return strain;
}

}  // namespace weft
