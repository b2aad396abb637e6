// docs/rendering.md is written by hand, except for its table of materials: these tests compare every line with its
// preset and check that its swatch exists. A failure prints the line to paste.
#include "look/material.h"
#include "scene/check.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#ifdef WEFT_SOURCE_DIR

namespace weft {
namespace {

const std::string docs = WEFT_SOURCE_DIR "/docs/", image_begin = "<img src=\"";

std::string page() {
    std::ifstream file(docs + "rendering.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string swatch_of(const MaterialPreset& preset) {
    return "pictures/swatches/" + std::string(preset.name) + ".jpg";
}

std::string text_of(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", static_cast<double>(value));
    return text;
}

/// One number if both are equal.
std::string text_of(const float (&values)[2]) {
    return text_of(values[0]) + (values[0] == values[1] ? "" : ", " + text_of(values[1]));
}

std::string text_of(Vec3 color) {
    if (color.x == 0 && color.y == 0 && color.z == 0) return "";
    return text_of(color.x) + ", " + text_of(color.y) + ", " + text_of(color.z);
}

std::string weave_of(const Material& material) {
    for (const Parameter& p : material_parameters)
        if (p.key == "weave") return std::string(choice_names(p).at(static_cast<std::size_t>(material.weave)));
    return {};
}

/// For velvet, the sheen color is that of the hairs.
std::string fuzz_of(const Material& m) {
    const std::string color = text_of(m.sheen_color);
    if (m.velvet > 0) return "pile " + text_of(m.velvet) + ", α " + text_of(m.velvet_alpha) + "; hairs " + color;
    return color.empty() ? "" : color + "; " + text_of(m.sheen_roughness);
}

std::string through_of(const Material& m) {
    std::string text = m.transmission > 0 ? text_of(m.transmission) : "";
    if (m.coverage < 1) text += (text.empty() ? "" : "; ") + ("covers " + text_of(m.coverage));
    return text;
}

std::string row(const MaterialPreset& preset) {
    const Material& m = preset.material;
    const std::string name(preset.name);
    std::string text = "| " + image_begin + swatch_of(preset) + "\" width=\"160\" alt=\"" + name + "\"> |";
    for (const std::string& cell :
         {'`' + name + "`: " + std::string(preset.what),
          m.weave == Weave::smooth ? "" : weave_of(m) + ", " + text_of(m.thread_spacing) + " mm", text_of(m.color),
          text_of(m.diffuse_roughness), text_of(m.specular), m.velvet > 0 ? "" : text_of(m.roughness), fuzz_of(m),
          through_of(m)})
        text += (cell.empty() ? "" : " " + cell) + " |";
    return text;
}

TEST(MaterialReference, HasARowAndASwatchForEveryMaterial) {
    const std::string text = page();
    ASSERT_FALSE(text.empty());
    for (const MaterialPreset& preset : material_presets()) {
        EXPECT_NE(text.find('\n' + row(preset) + '\n'), text.npos) << "missing:\n" << row(preset);
        EXPECT_TRUE(std::filesystem::exists(docs + swatch_of(preset))) << swatch_of(preset);
    }
}

TEST(MaterialReference, HasNoRowForAMaterialThatIsNone) {
    std::set<std::string> known;
    for (const MaterialPreset& preset : material_presets()) known.insert(row(preset));
    const std::string text = page(), begin = "\n| " + image_begin;
    for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at + 1)) {
        const std::string line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
        EXPECT_TRUE(known.contains(line)) << line;
    }
}

}  // namespace
}  // namespace weft

#endif
