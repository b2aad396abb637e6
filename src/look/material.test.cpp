#include "look/material.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>

namespace weft {
namespace {

TEST(Materials, AreAllThere) {
    for (const char* name : {"cotton", "linen", "wool", "silk", "satin", "velvet", "denim", "leather", "chiffon",
                             "jersey", "ribknit", "felt", "rubber", "matte", "floor"}) {
        const MaterialPreset* preset = find_material(name);
        ASSERT_TRUE(preset) << name;
        EXPECT_EQ(preset->name, name);
        EXPECT_FALSE(preset->what.empty()) << name;
    }
    EXPECT_EQ(material_presets().size(), 15u);
    EXPECT_FALSE(find_material(""));
    EXPECT_FALSE(find_material("Cotton"));
}

TEST(Materials, HaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const MaterialPreset& preset : material_presets())
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
}

TEST(Materials, AreWithinTheirRanges) {
    for (const MaterialPreset& preset : material_presets()) {
        const auto* base = reinterpret_cast<const std::byte*>(&preset.material);
        for (const Parameter& p : material_parameters) {
            if (p.kind != ParameterKind::number && p.kind != ParameterKind::vector) continue;
            const auto* values = reinterpret_cast<const float*>(base + p.offset);
            for (unsigned i = 0; i < p.count; ++i) {
                EXPECT_GE(values[i], static_cast<float>(p.min)) << preset.name << ' ' << p.key;
                EXPECT_LE(values[i], static_cast<float>(p.max)) << preset.name << ' ' << p.key;
            }
        }
        EXPECT_TRUE(preset.material.color_map.empty() && preset.material.normal_map.empty()) << preset.name;
    }
}

TEST(Materials, ShowEveryWeave) {
    std::set<Weave> used;
    for (const MaterialPreset& preset : material_presets()) used.insert(preset.material.weave);
    const auto& weave = *std::ranges::find(material_parameters, "weave", &Parameter::key);
    EXPECT_EQ(used.size(), static_cast<std::size_t>(std::ranges::count(weave.choices, '|')) + 1);
}

TEST(Materials, ReflectLessThanTheyGet) {
    for (const MaterialPreset& preset : material_presets()) {
        const Material& m = preset.material;
        for (const Vec3 color : {m.color, m.weft_color}) {
            for (const float channel : {color.x, color.y, color.z}) {
                EXPECT_GT(channel, 0) << preset.name;
                EXPECT_LE(channel + m.specular, 1) << preset.name;
            }
        }
    }
}

TEST(Materials, NameTheWeftWhereItIsOfAnotherColor) {
    // The weft is visible between the warp of all materials but these.
    const std::set<std::string_view> of_two = {"linen", "wool", "satin", "denim"};
    for (const MaterialPreset& preset : material_presets()) {
        EXPECT_EQ(preset.material.color == preset.material.weft_color, !of_two.count(preset.name)) << preset.name;
    }
}

}  // namespace
}  // namespace weft
