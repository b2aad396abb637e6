#include "solver/model/pruned_limits.h"

#include "solver/model/tear_cloth.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Of the finer nodes whose mean is a node, the part that may lie at openings. Beyond it the mean would lie between two
// rims that move apart. A cut through the middle of a node's region has a part of about 1 / its radius in finer nodes,
// which doubles from level to level; this is about a quarter of it.
constexpr float most_opened = 0.06f;

// Limit of a constraint that has ended, m: longer than any distance.
constexpr float no_limit = 1e18f;

// How much longer than a limit the way through an opening may be: limits can be shorter than the way (hierarchy.cpp).
constexpr float way_over_limit = 1.15f;

std::vector<std::uint32_t> opened_vertices(const ClothModel& model, std::span<const Opening> openings) {
    OpenedArrays unused;
    const StretchLaw law(model.fabric.stretch);
    const scalar::TearAccess access{model, unused, law};
    std::vector<std::uint32_t> vertices;
    for (const Opening& opening : openings) {
        scalar::TearOpening links{opening.links[0], opening.links[1], 0, 0};
        if (links.first == none) links = {links.second, none, 0, 0};
        if (links.first == none) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = scalar::tear_opened_vertex(access, links, k);
            if (vertex != none) vertices.push_back(vertex);
        }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

// Makes room for the parents of all particles that can be appended.
void make_room(const ClothModel& model, Prolongation& prolongation) {
    const std::uint32_t before = prolongation.stride, after = padded(model.first_anchor());
    if (before == after) return;
    const auto widen = [&](auto& array) {
        if (array.empty()) return;
        auto wider = array;
        wider.assign(std::size_t{Prolongation::parents} * after, 0);
        for (std::uint32_t k = 0; k < Prolongation::parents; ++k)
            std::copy_n(array.begin() + std::size_t{k} * before, before, wider.begin() + std::size_t{k} * after);
        array = std::move(wider);
    };
    widen(prolongation.narrow), widen(prolongation.wide), widen(prolongation.weight);
    prolongation.stride = after;
}

// Copies move with the nodes that move their originals.
void follow_originals(const ClothModel& model, std::uint32_t first_copy, Prolongation& prolongation) {
    make_room(model, prolongation);
    const std::uint32_t built = model.particle_count - static_cast<std::uint32_t>(model.copied_from.size());
    const auto copy = [&](auto& array, std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t k = 0; k < Prolongation::parents && !array.empty(); ++k)
            array[std::size_t{k} * prolongation.stride + to] = array[std::size_t{k} * prolongation.stride + from];
    };
    for (std::uint32_t p = first_copy; p < model.particle_count; ++p) {
        const std::uint32_t from = model.copied_from[p - built];
        copy(prolongation.narrow, from, p), copy(prolongation.wide, from, p), copy(prolongation.weight, from, p);
    }
}

// Per node: the part of its mean that is made of `opened` finer nodes.
std::vector<float> opened_parts(const CoarseLevel& level, std::span<const float> opened) {
    std::vector<float> parts(level.count);
    const Restriction& from = level.restriction;
    for (std::uint32_t first = 0; first < level.count; first += lane_padding) {
        const std::uint32_t packet = first / lane_padding, lanes = std::min(lane_padding, level.count - first);
        for (std::size_t k = from.begin[packet]; k < from.begin[packet + 1]; ++k)
            for (std::uint32_t lane = 0; lane < lanes; ++lane)
                parts[first + lane] +=
                    from.weight[k * lane_padding + lane] * opened[from.node[k * lane_padding + lane]];
    }
    return parts;
}

// The limits between nodes of which too much is opened, and those of which the shortest way can lead through one of the
// vertices.
void end_limits(const ClothModel& model, std::span<const std::uint32_t> vertices, std::span<const float> opened,
                float most, CoarseLevel& level) {
    ConstraintTable& limits = level.limits;
    AlignedVector<float> fields(limits.fields.begin(), limits.fields.end());
    for (std::uint32_t row = 0; row < limits.stride; ++row) {
        const std::uint32_t a = limits.particles[row], b = limits.particles[std::size_t{limits.stride} + row];
        if (limits.is_dummy(a) || fields[row] >= no_limit) continue;
        const Vec3 from = model.rest_position(level.particle[a]), to = model.rest_position(level.particle[b]);
        const float way = way_over_limit * std::max(fields[row], length(to - from)) + model.mean_edge;
        const auto leads_through = [&](std::uint32_t vertex) {
            const Vec3 x = model.rest_position(vertex);
            return length(x - from) + length(x - to) < way;
        };
        if (opened[a] <= most && opened[b] <= most && std::ranges::none_of(vertices, leads_through)) continue;
        fields[row] = no_limit, fields[limits.stride + row] = 0;
        --limits.rows;
    }
    limits.fields = std::move(fields);
}

}  // namespace

bool can_prune_limits(const ClothModel& model) {
    return !model.hierarchy.empty() && model.table(ConstraintKind::tether).rows == 0;
}

void prune_limits(ClothModel& model, std::span<const Opening> openings, std::uint32_t first_copy) {
    const std::vector<std::uint32_t> vertices = opened_vertices(model, openings);
    auto pruned = std::make_shared<PrunedLevels>();
    if (model.pruned) pruned->vertices = model.pruned->vertices;
    pruned->vertices.insert(pruned->vertices.end(), vertices.begin(), vertices.end());
    std::ranges::sort(pruned->vertices);
    pruned->vertices.erase(std::unique(pruned->vertices.begin(), pruned->vertices.end()), pruned->vertices.end());

    std::vector<CoarseLevel> levels(model.hierarchy.begin(), model.hierarchy.end());
    follow_originals(model, first_copy, levels.front().prolongation);
    const std::uint32_t built = model.particle_count - static_cast<std::uint32_t>(model.copied_from.size());
    std::vector<float> opened(model.particle_count);
    for (const std::uint32_t vertex : pruned->vertices) opened[vertex] = 1;
    for (std::uint32_t p = built; p < model.particle_count; ++p) opened[p] = opened[model.copied_from[p - built]];
    float most = most_opened;
    for (CoarseLevel& level : levels) {
        opened = opened_parts(level, opened);
        end_limits(model, vertices, opened, most, level);
        most *= 0.5f;
    }
    model.hierarchy = std::move(levels);
    model.pruned = std::move(pruned);
}

}  // namespace weft
