#include "look/material.h"

#include <algorithm>

namespace weft {
namespace {

const MaterialPreset presets[] = {
// One file per preset, in the order of the documentation.
// clang-format off
#include "look/materials/cotton.inl"
#include "look/materials/linen.inl"
#include "look/materials/wool.inl"
#include "look/materials/silk.inl"
#include "look/materials/satin.inl"
#include "look/materials/velvet.inl"
#include "look/materials/denim.inl"
#include "look/materials/leather.inl"
#include "look/materials/chiffon.inl"
#include "look/materials/jersey.inl"
#include "look/materials/ribknit.inl"
#include "look/materials/felt.inl"
#include "look/materials/rubber.inl"
#include "look/materials/matte.inl"
#include "look/materials/floor.inl"
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
