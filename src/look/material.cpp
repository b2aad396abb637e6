#include "look/material.h"

#include <algorithm>

namespace weft {
namespace {

const MaterialPreset presets[] = {
// One file each. clang-format off: in the order in which they are listed
#include "look/materials/cotton.inl"
#include "look/materials/matte.inl"
#include "look/materials/silk.inl"
#include "look/materials/velvet.inl"
    // clang-format on
};

}  // namespace

std::span<const MaterialPreset> material_presets() {
    return presets;
}

const MaterialPreset* find_material(std::string_view name) {
    const auto found = std::ranges::find(presets, name, &MaterialPreset::name);
    return found == std::end(presets) ? nullptr : &*found;
}

}  // namespace weft
