#include "vulkan/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace weft::vulkan {
namespace {

using Points = std::vector<std::uint32_t>;

float along(const Vec4& p, int axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

// The axis along which the points lie farthest apart at rest.
int longest_axis(const ClothModel& model, std::span<const std::uint32_t> points) {
    std::array<float, 3> low, high;
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
    for (const std::uint32_t p : points) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            low[a] = std::min(low[a], along(model.start[p], axis));
            high[a] = std::max(high[a], along(model.start[p], axis));
        }
    }
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis), b = static_cast<std::size_t>(longest);
        if (high[a] - low[a] > high[b] - low[b]) longest = axis;
    }
    return longest;
}

// Halves, and halves of these, until each has at most `size` points.
void bisect(const ClothModel& model, std::span<std::uint32_t> points, std::uint32_t size, std::vector<Points>& parts) {
    if (points.size() <= size) {
        parts.emplace_back(points.begin(), points.end());
        std::ranges::sort(parts.back());
        return;
    }
    const int axis = longest_axis(model, points);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const float x = along(model.start[a], axis), y = along(model.start[b], axis);
        return x != y ? x < y : a < b;
    };
    const std::size_t half = points.size() / 2;
    std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half), points.end(), before);
    bisect(model, points.first(half), size, parts);
    bisect(model, points.subspan(half), size, parts);
}

std::vector<Points> bisect(const ClothModel& model, std::uint32_t size) {
    Points all(model.point_count());
    std::iota(all.begin(), all.end(), 0);
    std::vector<Points> parts;
    bisect(model, all, size, parts);
    return parts;
}

// Makes patches one after another; its arrays are as large as the model and made once.
class Cutter {
  public:
    Cutter(const ClothModel& model, const JacobiGather& gather)
        : model_(model), gather_(gather), local_(model.point_count(), none) {
        for (const ConstraintTable& table : model.constraints)
            row_at_[static_cast<std::uint32_t>(table.kind)].assign(table.stride, none);
        list_alone();
    }

    Patch cut(const Points& owned, std::uint32_t rings) {
        Patch patch;
        patch_ = &patch;
        patch.points = owned;
        for (std::uint32_t i = 0; i < owned.size(); ++i) local_[owned[i]] = i;
        patch.within.push_back(static_cast<std::uint32_t>(owned.size()));
        for (std::uint32_t ring = 0; ring < rings; ++ring) add_ring(ring);
        own_first();
        number_rows();
        gather_rows(rings);
        for (const std::uint32_t p : patch.points) local_[p] = none;
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind)
            for (const std::uint32_t row : patch.tables[kind].rows) row_at_[kind][row] = none;
        return patch;
    }

  private:
    struct Block {
        std::uint32_t kind, slot, row;
    };

    const ConstraintTable& table(std::uint32_t kind) const { return model_.constraints[kind]; }
    std::uint32_t particle(std::uint32_t kind, std::uint32_t slot, std::uint32_t row) const {
        return table(kind).particles[std::size_t{slot} * table(kind).stride + row];
    }

    Block block(std::uint32_t item) const {
        std::uint32_t kind = 0;
        for (std::uint32_t next = 1; next < constraint_kind_count; ++next)
            if (table(next).stride > 0 && item >= gather_.first[next]) kind = next;
        const std::uint32_t rest = item - gather_.first[kind];
        return {kind, rest / table(kind).stride, rest % table(kind).stride};
    }

    std::span<const std::uint32_t> items(std::uint32_t p) const {
        return std::span(gather_.items).subspan(gather_.offsets[p], gather_.offsets[p + 1] - gather_.offsets[p]);
    }

    // Rows that name one particle twice move nothing, but have a lambda all the same.
    void list_alone() {
        for (const ConstraintTable& table : model_.constraints) {
            for (const Batch& batch : table.batches) {
                if (batch.blocks > 0) continue;
                for (std::uint32_t row = batch.begin; row < batch.begin + batch.rows; ++row)
                    if (!table.is_real(row)) alone_.push_back({static_cast<std::uint32_t>(table.kind), 0, row});
            }
        }
    }

    void add_row(std::uint32_t kind, std::uint32_t row) {
        if (row_at_[kind][row] != none) return;
        row_at_[kind][row] = 0;
        patch_->tables[kind].rows.push_back(row);
        for (std::uint32_t slot = 0; slot < table(kind).arity; ++slot) {
            const std::uint32_t p = particle(kind, slot, row);
            if (local_[p] != none) continue;
            local_[p] = static_cast<std::uint32_t>(patch_->points.size());
            patch_->points.push_back(p);
        }
    }

    // All rows that move what lies in the ring, and what these read.
    void add_ring(std::uint32_t ring) {
        const std::uint32_t begin = ring == 0 ? 0 : patch_->within[ring - 1], end = patch_->within[ring];
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t p = patch_->points[i];
            // Nothing moves what has no weight; what is owned is written back, lambda and all.
            if (ring > 0 && model_.start[p].w == 0) continue;
            for (const std::uint32_t item : items(p)) {
                const Block at = block(item);
                add_row(at.kind, at.row);
            }
        }
        if (ring == 0) {
            for (const Block& at : alone_)
                if (local_[particle(at.kind, 0, at.row)] < end) add_row(at.kind, at.row);
        }
        patch_->within.push_back(static_cast<std::uint32_t>(patch_->points.size()));
        for (PatchRows& rows : patch_->tables) rows.within.push_back(static_cast<std::uint32_t>(rows.rows.size()));
    }

    // A row belongs to the patch of its first particle.
    void own_first() {
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            PatchRows& rows = patch_->tables[kind];
            if (rows.rows.empty()) continue;
            const auto ring0 = rows.rows.begin() + rows.within.front();
            const auto others = std::stable_partition(rows.rows.begin(), ring0, [&](std::uint32_t row) {
                return local_[particle(kind, 0, row)] < patch_->within.front();
            });
            rows.owned = static_cast<std::uint32_t>(others - rows.rows.begin());
        }
    }

    void number_rows() {
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            PatchRows& rows = patch_->tables[kind];
            const std::uint32_t count = static_cast<std::uint32_t>(rows.rows.size());
            patch_->first[kind] = patch_->blocks;
            patch_->blocks += constraint_info(static_cast<ConstraintKind>(kind)).moved * count;
            for (std::uint32_t row = 0; row < count; ++row) row_at_[kind][rows.rows[row]] = row;
            rows.particles.reserve(std::size_t{table(kind).arity} * count);
            for (std::uint32_t slot = 0; slot < table(kind).arity; ++slot)
                for (const std::uint32_t row : rows.rows) rows.particles.push_back(local_[particle(kind, slot, row)]);
        }
    }

    // Particles of the last ring are read and never moved.
    void gather_rows(std::uint32_t rings) {
        patch_->offsets.push_back(0);
        for (std::uint32_t i = 0; i < patch_->points.size(); ++i) {
            const std::uint32_t p = patch_->points[i];
            const bool moves = i < patch_->within[rings - 1] && (i < patch_->within[0] || model_.start[p].w != 0);
            if (moves) {
                for (const std::uint32_t item : items(p)) {
                    const Block at = block(item);
                    const auto count = static_cast<std::uint32_t>(patch_->tables[at.kind].rows.size());
                    patch_->items.push_back(patch_->first[at.kind] + at.slot * count + row_at_[at.kind][at.row]);
                }
            }
            patch_->offsets.push_back(static_cast<std::uint32_t>(patch_->items.size()));
        }
    }

    const ClothModel& model_;
    const JacobiGather& gather_;
    std::vector<std::uint32_t> local_;                                      // by particle
    std::array<std::vector<std::uint32_t>, constraint_kind_count> row_at_;  // by row
    std::vector<Block> alone_;
    Patch* patch_ = nullptr;
};

// What a dispatch of `rings` iterations on patches like this one takes for each of them, in microseconds. The figures
// are of the order that large GPUs have; which of them counts depends on the size of the cloth, not on their last
// digit.
double cost(const Patch& patch, std::size_t patches, std::uint32_t rings) {
    constexpr double dispatch = 2.5;           // with the barrier behind it
    constexpr double phase = 0.15;             // a barrier of the workgroup and what it waits for
    constexpr double row = 1e-3, move = 2e-4;  // with the width of a multiprocessor
    constexpr double multiprocessors = 64;
    const double waves = std::ceil(static_cast<double>(patches) / multiprocessors);
    double sum = dispatch + waves * static_cast<double>(patch.within[rings]) * 2 * move;
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        double rows = 0;
        for (const PatchRows& table : patch.tables) rows += static_cast<double>(table.within[ring]);
        sum += 2 * phase + waves * (rows * row + static_cast<double>(patch.within[ring]) * move);
    }
    return sum / rings;
}

}  // namespace

std::vector<Patch> cut_into_patches(const ClothModel& model, const JacobiGather& gather, const PatchShape& shape) {
    Cutter cutter(model, gather);
    std::vector<Patch> patches;
    for (const Points& owned : bisect(model, shape.size)) patches.push_back(cutter.cut(owned, shape.rings));
    return patches;
}

std::optional<PatchShape> choose_patch_shape(const ClothModel& model, const JacobiGather& gather,
                                             std::uint32_t iterations, std::uint32_t most_points) {
    constexpr std::uint32_t most_rings = 8, smallest = 32;
    // An even number of dispatches, and not one iteration in each.
    const std::uint32_t rings = std::min(most_rings, iterations / 2);
    if (rings < 2) return std::nullopt;
    Cutter cutter(model, gather);
    std::optional<PatchShape> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t size = smallest; size <= most_points && size < model.point_count(); size *= 2) {
        // One from the middle stands for all.
        const std::vector<Points> parts = bisect(model, size);
        const Patch patch = cutter.cut(parts[parts.size() / 2], rings);
        for (std::uint32_t k = 2; k <= rings && patch.within[k] <= most_points; ++k) {
            const double now = cost(patch, parts.size(), k);
            if (now < least) least = now, best = PatchShape{size, k};
        }
    }
    return best;
}

}  // namespace weft::vulkan
