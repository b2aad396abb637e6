#include "editor/app/choice_words.h"

#include "editor/app/property_tables.h"
#include "editor/ui/expression.h"
#include "scene/check.h"
#include "scene/fabric.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft::editor {
namespace {

struct Words {
    std::string_view key, name, what;
};

// The names of two choices with the same key differ.
constexpr Words words[] = {
    {"tearing", "off", "never parts, cannot be cut"},
    {"tearing", "cuts", "parts where it is cut"},
    {"tearing", "split", "also tears by itself where the load is too high"},
    {"tearing", "erode", "loses triangles that are stretched too far"},
    {"self_collision", "off", "passes through itself"},
    {"self_collision", "fast", "particles keep a distance; may cross for a moment"},
    {"self_collision", "exact", "never passes through itself; slower"},
    {"tethers", "auto", "on if the cloth hangs and does not stretch"},
    {"tethers", "on", "limits the distance of each particle to its pins"},
    {"tethers", "off", "only the fabric limits the stretch"},
    {"diagonal", "uniform", "all alike"},
    {"diagonal", "alternating", "a checkerboard, bends alike in all directions"},
    {"diagonal", "cross", "both, with a particle in the middle"},
    {"stretch_model", "edges", "springs along the edges"},
    {"stretch_model", "membrane", "strain of each triangle; cannot tear"},
    {"bend_model", "moment", "bends as the fabric says, on any mesh"},
    {"bend_model", "dihedral", "each edge alone; up to a fifth off"},
    {"bend_model", "plate", "curvature of each triangle"},
    {"bend_model", "distance", "springs between neighboring triangles; fast"},
    {"bend_edges", "all", "bends at every edge"},
    {"bend_edges", "no-diagonals", "not at the diagonals of flat rectangles"},
    {"lift_model", "cosine", "most lift when the air meets the cloth head-on"},
    {"lift_model", "sine", "most lift when the air passes along the cloth"},
    {"phase", "smooth", "neighbors get the same gust"},
    {"phase", "scattered", "each triangle flutters by itself"},
    {"kind", "directional", "the same everywhere"},
    {"kind", "jet", "a round jet from a nozzle, as of a fan"},
    {"kind", "vortex", "turns around the y axis of the source"},
    {"contact", "auto", "the triangles of a mesh with holes, else the solid"},
    {"contact", "solid", "the inside is closed to cloth"},
    {"contact", "surface", "the triangles, from either side"},
    {"method", "xpbd", "stiffness in SI units"},
    {"method", "pbd", "plain position-based dynamics, for comparison"},
    {"projection", "auto", "lines, or gauss-seidel for pbd"},
    {"projection", "lines", "whole lines of edges at once"},
    {"projection", "gauss-seidel", "one constraint after another"},
    {"projection", "jacobi", "all at once, averaged; converges slowly"},
    {"accumulate", "gather", "sums floats in a fixed order"},
    {"accumulate", "fixed-point", "sums multiples of 1/65536 m in any order"},
    {"compensation", "auto", "on in substeps shorter than 1/2400 s"},
    {"compensation", "on", "keeps what rounding drops; a quarter slower"},
    {"compensation", "off", "drops it"},
    {"weave", "smooth", "no threads"},
    {"weave", "plain", "over one, under one: cotton, linen"},
    {"weave", "twill", "diagonal ribs: denim"},
    {"weave", "satin", "long floating threads: shine"},
    {"weave", "knit", "loops: jersey"},
    {"weave", "rib", "loops in ribs: cuffs"},
    {"weave", "grain", "leather"},
};

}  // namespace

std::vector<std::string_view> choice_words(const Parameter& parameter) {
    std::vector<std::string_view> whats;
    for (const std::string_view name : choice_names(parameter)) {
        const auto* const found =
            std::ranges::find_if(words, [&](const Words& one) { return one.key == parameter.key && one.name == name; });
        if (found == std::ranges::end(words)) return {};
        whats.push_back(found->what);
    }
    return whats;
}

std::vector<std::string_view> motion_words() {
    return {"stays where it is", "follows its keys", "a body that gravity and contact move"};
}

std::vector<std::string> preset_words(const std::string& place, const std::vector<std::string>& names) {
    if (pattern_of(place) != "/cloths/*/fabric") return {};
    std::vector<std::string> whats;
    for (const std::string& name : names) {
        const FabricPreset* const preset = find_fabric(name);
        const double grams = preset ? std::round(1000 * static_cast<double>(preset->fabric.body.density)) : 0;
        whats.push_back(format_number(grams, "g/m²"));
    }
    return whats;
}

}  // namespace weft::editor
