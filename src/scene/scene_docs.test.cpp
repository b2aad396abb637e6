// docs/scene.md is written by hand, except for its tables: these tests compare every line with the parameter tables of
// the reader and the checks. A failure prints the line to paste.
#include "scene/check.h"
#include "scene/fabric.h"
#include "scene/scene_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>

#ifdef WEFT_SOURCE_DIR

namespace weft {
namespace {

std::string reference() {
    std::ifstream file(WEFT_SOURCE_DIR "/docs/scene.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

// The text between a heading that names `place` and the next heading.
std::string section(const std::string& text, std::string_view place) {
    const std::string heading = "## `" + (place.empty() ? "/" : std::string(place)) + "`\n";
    const std::size_t start = text.find(heading);
    if (start == text.npos) return {};
    return text.substr(start, text.find("\n#", start + heading.size()) - start);
}

std::string type_text(const Parameter& p) {
    const std::string count = std::to_string(p.count);
    switch (p.kind) {
        case ParameterKind::number:
            return p.count == 1 ? "number" : "number or " + count + " numbers";
        case ParameterKind::vector:
            return count + " numbers";
        case ParameterKind::integer:
            return p.count == 1 ? "whole number" : count + " whole numbers";
        case ParameterKind::angle_or_mesh:
            return "number or `\"mesh\"`";
        case ParameterKind::flag:
            return "`true` or `false`";
        case ParameterKind::choice:
            return "choice";
        case ParameterKind::text:
            return "text";
        case ParameterKind::object:
            return "object";
        case ParameterKind::list:
            return "list";
    }
    return {};
}

std::string range_text(const Parameter& p) {
    if (p.kind == ParameterKind::choice) {
        std::string names;
        for (const std::string_view name : choice_names(p))
            names += (names.empty() ? "`\"" : ", `\"") + std::string(name) + "\"`";
        return names;
    }
    if (p.kind >= ParameterKind::choice || p.kind == ParameterKind::flag) return "";
    const bool below = p.min > -any_float, above = p.max < any_float;
    const std::string min = number_text(p.min), max = number_text(p.max);
    if (!below) return above ? "≤ " + max : "any";
    if (p.min_excluded || !above) return (p.min_excluded ? "> " : "≥ ") + min + (above ? ", ≤ " + max : "");
    return (p.zero_too ? "0 or " : "") + min + " … " + max;
}

std::string default_text(const Parameter& p, const void* defaults) {
    if (p.required) return "required";
    if (!defaults || p.kind >= ParameterKind::object) return "";
    const std::byte* value = static_cast<const std::byte*>(defaults) + p.offset;
    const auto element = [&]<class T>(T initial, std::size_t i) {
        std::memcpy(&initial, value + i * sizeof(T), sizeof(T));
        return initial;
    };
    if (p.kind == ParameterKind::text) {
        const auto& text = *reinterpret_cast<const std::string*>(value);
        return text.empty() ? "" : "`\"" + text + "\"`";
    }
    if (p.kind == ParameterKind::flag) return element(false, 0) ? "`true`" : "`false`";
    if (p.kind == ParameterKind::choice)
        return "`\"" + std::string(choice_names(p).at(static_cast<std::size_t>(element(0, 0)))) + "\"`";
    if (p.kind == ParameterKind::angle_or_mesh && std::isnan(element(0.0f, 0))) return "`\"mesh\"`";
    std::string text;
    for (std::size_t i = 0; i < p.count; ++i)
        text += (i > 0 ? ", " : "") +
                (p.kind == ParameterKind::integer ? number_text(element(0u, i)) : number_text(element(0.0f, i)));
    return p.count > 1 ? '[' + text + ']' : text;
}

std::string row(const Parameter& p, const void* defaults) {
    std::string text = "| `" + std::string(p.key) + "` |";
    for (const std::string& cell :
         {type_text(p), std::string(p.unit), range_text(p), default_text(p, defaults), std::string(p.what)})
        text += (cell.empty() ? "" : " " + cell) + " |";
    return text;
}

std::string row(const FabricPreset& preset) {
    const Fabric& f = preset.fabric;
    const auto micro = [](float value) { return number_text(std::round(value * 1e8) / 1e2); };  // two decimals
    return "| `" + std::string(preset.name) + "` | " + number_text(f.body.density) + " | " +
           number_text(f.stretch.stretch[0]) + ", " + number_text(f.stretch.stretch[1]) + " | " +
           number_text(f.stretch.shear) + " | " + micro(f.bend.bend[0]) + ", " + micro(f.bend.bend[1]) + ", " +
           micro(f.bend.bend[2]) + " |";
}

std::string tearing_row(const FabricPreset& preset) {
    const TearMaterial& tear = preset.fabric.tear;
    return "| `" + std::string(preset.name) + "` | " + number_text(std::round(1000 * preset.tearing.elongation) / 10) +
           " | " + number_text(preset.tearing.breaking_force / 1000) + " | " + number_text(preset.tearing.tear_force) +
           " | " + number_text(tear.strength[0]) + ", " + number_text(tear.strength[1]) + " | " +
           number_text(tear.tear_energy) + " |";
}

TEST(SceneReference, HasARowForEveryKey) {
    const std::string text = reference();
    ASSERT_FALSE(text.empty());
    for (const SceneTable& table : scene_tables()) {
        const std::string part = section(text, table.place);
        EXPECT_FALSE(part.empty()) << "no section for " << table.place;
        for (const Parameter& p : table.keys)
            EXPECT_NE(part.find('\n' + row(p, table.defaults) + '\n'), part.npos)
                << "under ## `" << table.place << "`, missing:\n"
                << row(p, table.defaults);
    }
}

TEST(SceneReference, HasNoRowForAKeyThatIsNone) {
    const std::string text = reference();
    std::map<std::string_view, std::set<std::string>> rows;
    for (const SceneTable& table : scene_tables())
        for (const Parameter& p : table.keys) rows[table.place].insert(row(p, table.defaults));
    for (const auto& [place, known] : rows) {
        const std::string part = section(text, place);
        for (std::size_t at = part.find("\n| `"); at != part.npos; at = part.find("\n| `", at + 1)) {
            const std::string line = part.substr(at + 1, part.find('\n', at + 1) - at - 1);
            EXPECT_TRUE(known.contains(line)) << "under ## `" << place << "`:\n" << line;
        }
    }
}

TEST(SceneReference, HasARowForEveryFabric) {
    const std::string text = reference();
    for (const FabricPreset& preset : fabric_presets())
        for (const std::string& line : {row(preset), tearing_row(preset)})
            EXPECT_NE(text.find('\n' + line), text.npos) << "missing:\n" << line;
}

}  // namespace
}  // namespace weft

#endif
