#include "solver/model/jacobi.h"

#include <algorithm>

namespace weft {
namespace {

std::uint32_t particle_of(const ConstraintTable& table, std::uint32_t row, std::uint32_t slot) {
    return table.particles[std::size_t{slot} * table.stride + row];
}

// Calls f(table, row, slot) for every particle that a constraint moves.
template <class F>
void for_each_moved(const ClothModel& model, F&& f) {
    for (const ConstraintTable& table : model.constraints) {
        const std::uint32_t moved = constraint_info(table.kind).moved;
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            if (!table.is_real(row)) continue;
            for (std::uint32_t slot = 0; slot < moved; ++slot) {
                // If a constraint names a particle twice, the last slot counts.
                bool again = false;
                for (std::uint32_t later = slot + 1; later < moved; ++later) {
                    again = again || particle_of(table, row, later) == particle_of(table, row, slot);
                }
                if (!again) f(table, row, slot);
            }
        }
    }
}

}  // namespace

JacobiGather build_gather(const ClothModel& model) {
    JacobiGather gather;
    for (const ConstraintTable& table : model.constraints) {
        gather.first[static_cast<std::uint32_t>(table.kind)] = gather.blocks;
        gather.blocks += constraint_info(table.kind).moved * table.stride;
    }

    std::vector<std::uint32_t> count(model.point_count());
    for_each_moved(model, [&](const ConstraintTable& table, std::uint32_t row, std::uint32_t slot) {
        ++count[particle_of(table, row, slot)];
    });
    gather.offsets.assign(count.size() + 1, 0);
    for (std::size_t p = 0; p < count.size(); ++p) gather.offsets[p + 1] = gather.offsets[p] + count[p];
    gather.items.resize(gather.offsets.back());
    std::vector<std::uint32_t> next(gather.offsets.begin(), gather.offsets.end() - 1);
    for (const ConstraintTable& table : model.constraints) {
        gather.share[static_cast<std::uint32_t>(table.kind)].assign(table.stride, 1.0f);
    }
    for_each_moved(model, [&](const ConstraintTable& table, std::uint32_t row, std::uint32_t slot) {
        const auto kind = static_cast<std::uint32_t>(table.kind);
        const std::uint32_t particle = particle_of(table, row, slot);
        gather.items[next[particle]++] = gather.first[kind] + slot * table.stride + row;
        float& share = gather.share[kind][row];
        share = std::min(share, 1.0f / static_cast<float>(count[particle]));
    });
    return gather;
}

}  // namespace weft
