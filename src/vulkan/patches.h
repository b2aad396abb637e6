// A model cut into patches that workgroups can iterate on by themselves: each with the particles around it that it must
// compute as well, since every iteration of averaged Jacobi lets a particle hear from one ring of neighbors farther
// away.
#pragma once

#include "solver/model/cloth_model.h"
#include "solver/model/jacobi.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace weft::vulkan {

/// Rows of one kind, with the patch's own numbers for particles.
struct PatchRows {
    std::vector<std::uint32_t> rows;       ///< of the model: owned ones first, then ring by ring
    std::vector<std::uint32_t> particles;  ///< [slot · rows + row]
    std::vector<std::uint32_t> within;     ///< [ring]: so many move something within that ring
    std::uint32_t owned = 0;               ///< each row of the model is owned once
};

/// Particles and rows that several iterations on the owned particles need. What `rings` iterations leave of the owned
/// ones is what the whole model's would.
struct Patch {
    std::vector<std::uint32_t> points;  ///< of the model: owned ones first, then ring by ring
    std::vector<std::uint32_t> within;  ///< [ring], the last one included: within[0] are owned
    std::array<PatchRows, constraint_kind_count> tables;
    /// As JacobiGather has them: a row's correction of its particle `slot` is block
    /// first[kind] + slot · rows + row.
    std::array<std::uint32_t, constraint_kind_count> first{};
    std::uint32_t blocks = 0;
    std::vector<std::uint32_t> offsets, items;  ///< in the same order as the model's
};

/// How large patches are.
struct PatchShape {
    std::uint32_t size = 0;   ///< particles that a patch owns, at most
    std::uint32_t rings = 0;  ///< iterations that a patch does at once
    friend bool operator==(const PatchShape&, const PatchShape&) = default;
};

/// Every particle and anchor of the model is owned by one patch.
std::vector<Patch> cut_into_patches(const ClothModel& model, const JacobiGather& gather, const PatchShape& shape);

/// What promises to take the least time for `iterations` on a large GPU whose workgroups have room for `most_points`
/// particles; nothing if no patch of at least two iterations has room, or if the cloth is one patch.
std::optional<PatchShape> choose_patch_shape(const ClothModel& model, const JacobiGather& gather,
                                             std::uint32_t iterations, std::uint32_t most_points);

}  // namespace weft::vulkan
