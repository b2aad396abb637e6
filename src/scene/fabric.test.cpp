#include "scene/fabric.h"

#include "scene/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

namespace weft {
namespace {

constexpr double earth_gravity = 9.81;

TEST(Fabric, HasEveryPreset) {
    for (const char* name : {"trouser", "denim", "tablecloth", "tshirt", "jacket", "swimsuit", "ponte-roma", "rib-knit",
                             "blanket", "cotton", "silk", "chiffon", "wool", "leather", "rubber"}) {
        const FabricPreset* preset = find_fabric(name);
        ASSERT_TRUE(preset) << name;
        EXPECT_EQ(preset->name, name);
        EXPECT_FALSE(preset->source.empty()) << name;
    }
    EXPECT_EQ(fabric_presets().size(), 15u);
    EXPECT_FALSE(find_fabric(""));
    EXPECT_FALSE(find_fabric("Cotton"));
}

TEST(Fabric, PresetNamesAreUnique) {
    std::set<std::string_view> names;
    for (const FabricPreset& preset : fabric_presets()) EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
}

TEST(Fabric, ValuesAreInSi) {
    const Fabric& denim = find_fabric("denim")->fabric;
    EXPECT_FLOAT_EQ(denim.body.density, 0.324f);
    EXPECT_FLOAT_EQ(denim.stretch.stretch[0], 411);
    EXPECT_FLOAT_EQ(denim.stretch.stretch[1], 2028);
    EXPECT_FLOAT_EQ(denim.stretch.compression[0], 411);
    EXPECT_FLOAT_EQ(denim.stretch.compression[1], 2028);
    EXPECT_FLOAT_EQ(denim.stretch.shear, 27);
    EXPECT_FLOAT_EQ(denim.bend.bend[0], 16.0e-6f);
    EXPECT_FLOAT_EQ(denim.bend.bend[1], 18.3e-6f);
    EXPECT_FLOAT_EQ(denim.bend.bend[2], 24.2e-6f);
}

TEST(Fabric, DefaultIsCotton) {
    const Fabric by_default, cotton = find_fabric("cotton")->fabric;
    for (const FabricTable& table : fabric_tables())
        for (const Parameter& p : table.parameters) {
            const auto value = [&](const Fabric& f) {
                return reinterpret_cast<const std::byte*>(&f) + table.offset + p.offset;
            };
            const std::size_t size = p.kind == ParameterKind::flag ? sizeof(bool) : p.count * sizeof(float);
            EXPECT_EQ(std::memcmp(value(by_default), value(cotton), size), 0) << p.key;
        }
}

TEST(Fabric, EveryPresetIsInRange) {
    for (const FabricPreset& preset : fabric_presets()) {
        Problems problems;
        for (const FabricTable& table : fabric_tables())
            check_values(table.parameters, reinterpret_cast<const std::byte*>(&preset.fabric) + table.offset, "",
                         problems);
        EXPECT_TRUE(problems.none()) << preset.name;
    }
}

// A strip of cloth bends under its own weight over about this length: Peirce's bending length of real textiles is a few
// centimeters. A decimal point error in stiffness or density leaves the interval.
TEST(Fabric, BendingLengthIsThatOfTextiles) {
    for (const FabricPreset& preset : fabric_presets()) {
        if (!preset.woven_or_knitted) continue;
        const char* directions[] = {"warp", "bias", "weft"};
        for (int i = 0; i < 3; ++i) {
            const double length = std::cbrt(preset.fabric.bend.bend[i] / (preset.fabric.body.density * earth_gravity));
            EXPECT_GE(length, 0.011) << preset.name << ", " << directions[i];
            EXPECT_LE(length, 0.030) << preset.name << ", " << directions[i];
        }
    }
}

TEST(Fabric, LeatherAndRubberAreNoTextiles) {
    for (const FabricPreset& preset : fabric_presets())
        EXPECT_EQ(preset.woven_or_knitted, preset.name != "leather" && preset.name != "rubber") << preset.name;
}

TEST(Fabric, SourcesSayWhatIsMeasured) {
    const auto says = [](const char* name, std::string_view text) {
        return find_fabric(name)->source.find(text) != std::string_view::npos;
    };
    for (const char* name :
         {"trouser", "denim", "tablecloth", "tshirt", "jacket", "swimsuit", "ponte-roma", "rib-knit", "blanket"})
        EXPECT_TRUE(says(name, "Wang, O'Brien, Ramamoorthi 2011")) << name;
    for (const char* name : {"cotton", "silk", "chiffon", "wool"}) EXPECT_TRUE(says(name, "DrapeTester")) << name;
    for (const char* name : {"silk", "chiffon", "wool", "leather", "rubber"}) EXPECT_TRUE(says(name, "chosen")) << name;
}

}  // namespace
}  // namespace weft
