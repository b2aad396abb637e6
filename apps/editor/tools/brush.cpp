#include "editor/tools/brush.h"

#include "editor/tools/double3.h"

#include <algorithm>
#include <cmath>

namespace weft::editor {
namespace {

std::vector<std::uint32_t> sound_triangles(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    const MeshView mesh(positions, triangles);
    std::vector<std::uint32_t> sound;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (mesh.sound(triangles[t])) sound.push_back(t);
    return sound;
}

std::vector<Triangle> chosen(std::span<const Triangle> triangles, std::span<const std::uint32_t> numbers) {
    std::vector<Triangle> some;
    for (const std::uint32_t t : numbers) some.push_back(triangles[t]);
    return some;
}

}  // namespace

float brush_fall_off(float distance, float radius, BrushFallOff kind) {
    if (!(radius > 0) || !(distance < radius)) return 0;
    if (kind == BrushFallOff::none) return 1;
    if (kind == BrushFallOff::linear) return 1 - std::max(distance, 0.0f) / radius;
    const float t = std::max(distance, 0.0f) / radius;
    return (1 - t * t) * (1 - t * t);
}

std::vector<BrushWeight> brush_weights(SurfaceDistance& distance, const MeshView& mesh, const MeshPlace& center,
                                       float radius, const std::optional<MeshPlace>& mirrored, BrushFallOff fall_off) {
    std::vector<BrushWeight> weights;
    const auto add = [&](const MeshPlace& place) {
        for (const ReachedVertex& reached : distance.from(mesh, place, radius))
            weights.push_back({reached.vertex, brush_fall_off(reached.distance, radius, fall_off)});
    };
    add(center);
    if (mirrored) add(*mirrored);
    std::ranges::sort(weights, [](const BrushWeight& a, const BrushWeight& b) {
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.weight > b.weight;
    });
    const auto same = [](const BrushWeight& a, const BrushWeight& b) { return a.vertex == b.vertex; };
    weights.erase(std::unique(weights.begin(), weights.end(), same), weights.end());
    return weights;
}

RestMirror::RestMirror(std::vector<Vec3> rest_positions, std::span<const Triangle> triangles, MirrorAxis axis)
    : axis_(axis == MirrorAxis::x   ? &Vec3::x
            : axis == MirrorAxis::y ? &Vec3::y
                                    : &Vec3::z),
      positions_(std::move(rest_positions)),
      numbers_(sound_triangles(positions_, triangles)),
      place_(triangles.size(), none),
      search_({}, {}) {
    triangles_ = chosen(triangles, numbers_);
    Bounds bounds;
    for (const Triangle& t : triangles_)
        for (const std::uint32_t corner : t) bounds.include(positions_[corner]);
    if (!triangles_.empty()) twice_middle_ = bounds.min.*axis_ + bounds.max.*axis_;
    for (std::uint32_t i = 0; i < numbers_.size(); ++i) place_[numbers_[i]] = i;
    search_ = SurfaceSearch(positions_, triangles_);
}

std::optional<MeshPlace> RestMirror::of(const MeshPlace& place, float tolerance) const {
    if (place.triangle >= place_.size() || place_[place.triangle] == none) return std::nullopt;
    Vec3 point = point_of(MeshView(positions_, triangles_), {place_[place.triangle], place.weights});
    if (!finite(point)) return std::nullopt;
    point.*axis_ = twice_middle_ - point.*axis_;
    const SurfacePoint found = search_.closest(point);
    if (found.triangle == none || !(found.distance <= static_cast<double>(tolerance))) return std::nullopt;
    const auto& w = found.weights;
    return MeshPlace{numbers_[found.triangle], rounded(Double3{w[0], w[1], w[2]})};
}

BrushStroke::BrushStroke(const BrushSettings& settings, std::vector<float> values)
    : settings_(settings), before_(std::move(values)), values_(before_), weights_(before_.size()) {}

void BrushStroke::dab(std::span<const BrushWeight> weights, const SurfaceDistance& distance) {
    if (settings_.mode == BrushMode::smooth) return smooth(weights, distance);
    for (const auto& [vertex, weight] : weights) {
        if (vertex >= values_.size() || !(weight > weights_[vertex])) continue;
        weights_[vertex] = weight;
        const float part = settings_.strength * weight, before = before_[vertex];
        float to = before + settings_.value * part;
        if (settings_.mode == BrushMode::subtract) to = before - settings_.value * part;
        if (settings_.mode == BrushMode::set) to = before + (settings_.value - before) * part;
        values_[vertex] = std::clamp(to, settings_.min, settings_.max);
    }
}

// All vertices at once, so that the result does not depend on their order.
void BrushStroke::smooth(std::span<const BrushWeight> weights, const SurfaceDistance& distance) {
    std::vector<float> smoothed(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const std::uint32_t vertex = weights[i].vertex;
        if (vertex >= values_.size() || vertex >= distance.vertices()) continue;
        const auto around = distance.neighbors(vertex);
        float sum = 0;
        for (const std::uint32_t other : around) sum += values_[other];
        const float mean = around.empty() ? values_[vertex] : sum / static_cast<float>(around.size());
        smoothed[i] = values_[vertex] + (mean - values_[vertex]) * settings_.strength * weights[i].weight;
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const std::uint32_t vertex = weights[i].vertex;
        if (vertex < values_.size() && vertex < distance.vertices())
            values_[vertex] = std::clamp(smoothed[i], settings_.min, settings_.max);
    }
}

std::vector<std::uint32_t> BrushStroke::changed() const {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < values_.size(); ++v)
        if (values_[v] != before_[v]) vertices.push_back(v);
    return vertices;
}

}  // namespace weft::editor
