#include "solver/model/pin_spans.h"

#include "solver/model/link_graph.h"

#include <algorithm>
#include <limits>

namespace weft {
namespace {

constexpr std::size_t most_pins = 8;
constexpr double near = 0.25;
// Paths along links have corners and are longer than geodesics by up to this factor.
constexpr double detour = 1.12;

// Chooses pins one after another, each as far as possible from those chosen before.
class SpanFinder {
  public:
    SpanFinder(const CoarseLevel& level, std::uint32_t pin_count, std::span<const Vec3> at_rest)
        : level_(level), at_rest_(at_rest), search_(level.ways), nearest_(pin_count, LocalWays::unreached) {}

    bool is_reached(std::uint32_t pin) const { return nearest_[pin] < LocalWays::unreached; }

    /// Adds the spans of the connected piece of cloth that contains this pin.
    void add_piece_with(std::uint32_t pin) {
        std::vector<std::uint32_t> chosen;
        while (chosen.size() < most_pins) {
            add_spans(pin, chosen);
            chosen.push_back(pin);
            // Pins of other pieces are not reached from this pin and are skipped.
            double farthest = 0;
            for (std::uint32_t other = 0; other < nearest_.size(); ++other) {
                if (distance_[other] < LocalWays::unreached && nearest_[other] > farthest)
                    farthest = nearest_[other], pin = other;
            }
            if (farthest == 0) return;
        }
    }
    std::vector<PinSpan> take() { return std::move(spans_); }

  private:
    void add_spans(std::uint32_t pin, std::span<const std::uint32_t> chosen) {
        distance_.assign(nearest_.size(), LocalWays::unreached);
        double farthest = 0;
        search_.run<&Link::limit>(pin, std::numeric_limits<double>::max(), [&](std::uint32_t node, double d) {
            if (node < nearest_.size()) distance_[node] = d, nearest_[node] = std::min(nearest_[node], d);
            farthest = d;  // nodes are visited nearest first
            return LocalSearch::Go::on;
        });
        for (const std::uint32_t other : chosen) {
            const double d = distance_[other];
            if (!(d >= near * farthest && d > 0)) continue;
            const std::uint32_t a = level_.particle[other], b = level_.particle[pin];
            const double straight = length(at_rest_[a] - at_rest_[b]);
            spans_.push_back({a, b, static_cast<float>(std::max(straight, d / detour))});
        }
    }

    const CoarseLevel& level_;
    std::span<const Vec3> at_rest_;
    LocalSearch search_;
    std::vector<double> nearest_;   // m, per pin, to the nearest chosen pin
    std::vector<double> distance_;  // m, per pin, to the last chosen pin
    std::vector<PinSpan> spans_;
};

}  // namespace

std::vector<PinSpan> find_pin_spans(std::span<const CoarseLevel> hierarchy, std::span<const Vec3> at_rest) {
    if (hierarchy.empty()) return {};
    // The coarsest level that still has enough nodes to represent pins separately. Pinned nodes come first in it.
    constexpr std::uint32_t enough_nodes = 256;
    const auto first_coarse = std::ranges::find_if(hierarchy, [](const auto& one) { return one.count < enough_nodes; });
    const CoarseLevel& level = first_coarse == hierarchy.begin() ? *first_coarse : *(first_coarse - 1);
    std::uint32_t pin_count = 0;
    while (pin_count < level.count && level.weight[pin_count] == 0) ++pin_count;
    if (pin_count < 2) return {};

    SpanFinder finder(level, pin_count, at_rest);
    for (std::uint32_t pin = 0; pin < pin_count; ++pin) {
        if (!finder.is_reached(pin)) finder.add_piece_with(pin);
    }
    return finder.take();
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
