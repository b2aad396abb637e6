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
                             "blanket", "cotton", "silk", "chiffon", "wool", "ripstop", "leather", "rubber"}) {
        const FabricPreset* preset = find_fabric(name);
        ASSERT_TRUE(preset) << name;
        EXPECT_EQ(preset->name, name);
        EXPECT_FALSE(preset->source.empty()) << name;
    }
    EXPECT_EQ(fabric_presets().size(), 16u);
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

TEST(Fabric, TearsAtThePublishedElongation) {
    for (const FabricPreset& preset : fabric_presets()) {
        const TearMaterial& tear = preset.fabric.tear;
        const TearingFigures& figures = preset.tearing;
        for (int i = 0; i < 2; ++i)
            EXPECT_NEAR(tear.strength[i] / preset.fabric.stretch.stretch[i], figures.elongation, 1e-6) << preset.name;
        const double reduced = (tear.strength[0] + tear.strength[1]) / 2 / figures.breaking_force;
        EXPECT_NEAR(tear.tear_energy / (2 * figures.tear_force * reduced), 1, 0.005) << preset.name;
        EXPECT_EQ(tear.tear_ratio, 0) << preset.name;
        EXPECT_LE(reduced, 1) << preset.name << ": real cloth stiffens";
        EXPECT_FALSE(figures.source.empty()) << preset.name;
    }
    const TearingFigures ripstop = find_fabric("ripstop")->tearing;
    EXPECT_NEAR(ripstop.breaking_force, 42 * 4.448222 / 0.0254, 50) << "42 lbf/in";
    EXPECT_NEAR(ripstop.tear_force, 5 * 4.448222, 0.3) << "5 lbf";
    EXPECT_NEAR(find_fabric("trouser")->tearing.breaking_force, 75 * 4.448222 / 0.0254, 50) << "75 lbf on an inch";
    EXPECT_NEAR(find_fabric("denim")->tearing.breaking_force, 244 / 0.0254, 50) << "244 N on an inch";
    EXPECT_NEAR(find_fabric("cotton")->tearing.breaking_force, 22 * 4.448222 / 0.0254, 50) << "22 lbf on an inch";
    EXPECT_NEAR(find_fabric("wool")->tearing.breaking_force, 80 * 4.448222 / 0.0254, 50) << "80 lbf on an inch";
    // Each figure has a source or the word "chosen".
    for (const FabricPreset& preset : fabric_presets()) {
        const std::string_view source = preset.tearing.source;
        const auto has = [&](std::string_view text) { return source.find(text) != source.npos; };
        if (has("every value is chosen")) continue;
        for (const char* figure : {"elongation", "breaking force", "tear force"})
            EXPECT_TRUE(has(figure)) << preset.name << ": " << figure;
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
    for (const char* name : {"cotton", "silk", "chiffon", "wool", "ripstop"})
        EXPECT_TRUE(says(name, "DrapeTester")) << name;
    for (const char* name : {"silk", "chiffon", "wool", "ripstop", "leather", "rubber"})
        EXPECT_TRUE(says(name, "chosen")) << name;
}

}  // namespace
}  // namespace weft
