// Cuts a sheet along a column of particles, as a tear would.
#pragma once

#include "solver/model/cloth_edit.h"

#include <algorithm>
#include <map>

namespace weft::test {

/// `is_right(particle)` says on which side of the cut a particle lies, `is_cut(particle)` whether it lies on the cut.
template <class IsCut, class IsRight>
ClothEdit cut(const ClothModel& model, IsCut&& is_cut, IsRight&& is_right) {
    ClothEdit edit;
    std::map<std::uint32_t, std::uint32_t> copies;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        if (!is_cut(p)) continue;
        copies[p] = model.particle_count + static_cast<std::uint32_t>(edit.appended.size());
        edit.appended.push_back(p);
    }
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        const auto [a, b, c] = model.triangles()[t];
        TriangleEdit changed{.triangle = t, .corners = {a, b, c}};
        if (!is_right(a) && !is_right(b) && !is_right(c)) continue;
        for (std::uint32_t& corner : changed.corners)
            if (copies.contains(corner)) corner = copies[corner];
        if (changed.corners != std::array{a, b, c}) edit.triangles.push_back(changed);
    }
    for (const ConstraintTable& table : model.constraints) {
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            if (!table.is_real(row)) continue;
            RowEdit changed{.kind = table.kind, .row = row};
            bool right = false, left = false;
            std::uint32_t on_cut = 0;
            for (std::uint32_t slot = 0; slot < table.arity; ++slot) {
                const std::uint32_t p = table.particles[std::size_t{slot} * table.stride + row];
                changed.particles[slot] = p;
                if (table.is_dummy(p)) continue;
                on_cut += is_cut(p);
                right = right || is_right(p);
                left = left || (!is_right(p) && !is_cut(p));
            }
            RowEdit moved = changed;
            for (std::uint32_t slot = 0; slot < table.arity; ++slot)
                if (copies.contains(changed.particles[slot])) moved.particles[slot] = copies[changed.particles[slot]];
            if (on_cut == 0) continue;
            if (table.kind == ConstraintKind::stretch && on_cut == 2) {  // an edge to each side
                changed.stiffness = moved.stiffness = 0.5f;
                edit.rows.push_back(changed);
                edit.added.push_back(moved);
            } else if (right && left) {  // across the cut
                changed.stiffness = 0;
                edit.rows.push_back(changed);
            } else if (right && !table.blocks.empty()) {  // along a line
                changed.stiffness = 0;
                edit.rows.push_back(changed);
                edit.added.push_back(moved);
            } else if (right) {
                edit.rows.push_back(moved);
            }
        }
    }
    return edit;
}

}  // namespace weft::test
