#include "editor/app/paint_kinds.h"

#include "editor/app/vertex_edits.h"
#include "scene/check.h"
#include "solver/model/tear_law.h"
#include "weft/painting.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace weft::editor {

const SceneCloth& described(const PaintTarget& target) {
    return target.document.scene.cloths.at(std::stoul(target.place.substr(target.place.rfind('/') + 1)));
}

namespace {

std::vector<float> membership(const PaintTarget& target, const VertexSet& vertices) {
    std::vector<float> values(target.cloth.particles());
    for (const std::uint32_t p : target.cloth.to_particles(vertices)) values[p] = 1;
    return values;
}

/// Splits the changed particles into vertices that have it now and vertices that have it no longer.
struct OnOff {
    VertexSet on, off;
    OnOff(const PaintTarget& target, const std::vector<float>& values, const VertexSet& changed) {
        VertexSet set, unset;
        for (const std::uint32_t p : changed) (values[p] >= 0.5f ? set : unset).push_back(p);
        on = target.cloth.to_vertices(set), off = target.cloth.to_vertices(unset);
    }
};

// --- Pins

// What boxes and colors select is known only to the simulation.
std::vector<float> read_pins(const PaintTarget& target) {
    std::vector<float> values = membership(target, listed_pins(target.document, target.place));
    const auto lists = [](const PinDesc& pin) { return std::holds_alternative<VertexPins>(pin.select); };
    if (std::ranges::all_of(described(target).pins, lists)) return values;
    for (std::size_t p = 0; p < values.size() && p < target.frame.positions.size(); ++p)
        if (!(target.frame.positions[p].w > 0)) values[p] = 1;
    return values;
}

std::vector<Edit> write_pins(const PaintTarget& target, const std::vector<float>& values, const VertexSet& changed) {
    const OnOff now(target, values, changed);
    return changed_pins(target.document, target.place, now.on, now.off).edits;
}

// --- Factors on values of the fabric

/// Descriptions of a cloth that give factors to particles: a ResistanceDesc or a WeightDesc each.
template <class Desc>
struct FactorList {
    const std::vector<Desc>& all;
    const char* key;  ///< of the list in the scene
    const Json head;  ///< what a new description has beside its vertices and factors
    const Parameter& limits;
    bool (*counts)(const Desc&, const Json& head);  ///< whether a description is one of this value

    /// The last one that counts, if it lists vertices with factors: the one that the brush writes.
    const Desc* painted() const {
        for (auto at = all.rbegin(); at != all.rend(); ++at)
            if (counts(*at, head)) return at->factors.empty() ? nullptr : &*at;
        return nullptr;
    }
};

FactorList<ResistanceDesc> resistance_of(const PaintTarget& target) {
    return {.all = described(target).resistance,
            .key = "resistance",
            .head = Json::object(),
            .limits = resistance_factor_keys[0],
            .counts = [](const ResistanceDesc&, const Json&) { return true; }};
}

FactorList<WeightDesc> weights_of(const PaintTarget& target, WeightOf of) {
    return {.all = described(target).weights,
            .key = "weights",
            .head = Json{{"of", choice_names(weight_keys[0]).at(static_cast<std::size_t>(of))}},
            .limits = weight_factor_keys[0],
            .counts = [](const WeightDesc& desc, const Json& head) {
                return head.at("of") == choice_names(weight_keys[0]).at(static_cast<std::size_t>(desc.of));
            }};
}

// What the painted description does not list comes from boxes, colors and groups, which the model has evaluated.
// `values`: those of the model.
template <class Desc>
std::vector<float> read_factors(const PaintTarget& target, const FactorList<Desc>& list, std::vector<float> values) {
    const Desc* painted = list.painted();
    if (!painted) return values;
    const auto& vertices = std::get<VertexPins>(painted->select).vertices;
    const auto& of_vertex = target.cloth.numbers->of_welded;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (vertices[i] < of_vertex.size() && of_vertex[vertices[i]] < values.size())
            values[of_vertex[vertices[i]]] = painted->factor * painted->factors[i];
    return values;
}

/// Three digits, so that scene files stay short.
float short_number(float value) {
    if (!(value > 0)) return value;
    const float unit = std::pow(10.0f, std::floor(std::log10(value)) - 2);
    return std::round(value / unit) * unit;
}

template <class Desc>
std::vector<Edit> write_factors(const PaintTarget& target, const FactorList<Desc>& list,
                                const std::vector<float>& values, const VertexSet& changed) {
    const Desc* painted = list.painted();
    const auto limited = [&](float value) {
        return std::clamp(value, static_cast<float>(list.limits.min), static_cast<float>(list.limits.max));
    };
    std::map<std::uint32_t, float> factors;
    if (painted) {
        const auto& vertices = std::get<VertexPins>(painted->select).vertices;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            factors[vertices[i]] = limited(painted->factor * painted->factors[i]);
    }
    for (const std::uint32_t p : changed)
        if (const std::uint32_t vertex = target.cloth.vertex_of[p]; vertex != none)
            factors[vertex] = limited(short_number(values[p]));
    Json desc = list.head;
    desc["vertices"] = Json::array(), desc["factors"] = Json::array();
    for (const auto& [vertex, factor] : factors) {
        desc["vertices"].push_back(vertex);
        desc["factors"].push_back(number(factor));
    }
    const std::string place = painted ? std::to_string(painted - list.all.data()) : "-";
    return {{target.place + '/' + list.key + '/' + place, std::move(desc)}};
}

// --- Resistance

std::vector<float> read_resistance(const PaintTarget& target) {
    std::vector<float> values(target.cloth.particles(), 1.0f);
    if (const auto& law = target.frame.model->tear_law)
        for (std::size_t p = 0; p < values.size() && p < law->inverse_resistance.size(); ++p)
            values[p] = 1 / law->inverse_resistance[p];
    return read_factors(target, resistance_of(target), std::move(values));
}

std::vector<Edit> write_resistance(const PaintTarget& target, const std::vector<float>& values,
                                   const VertexSet& changed) {
    return write_factors(target, resistance_of(target), values, changed);
}

std::vector<Edit> prepare_resistance(const PaintTarget& target) {
    const Tearing tearing = described(target).tearing;
    if (tearing == Tearing::split || tearing == Tearing::erode) return {};
    return {{target.place + "/tearing", "split"}};
}

// --- Weights

template <WeightOf of>
std::vector<float> read_weights(const PaintTarget& target) {
    const std::vector<float>& known = (*target.frame.model->weights.*factors_of(of)).of_particles;
    std::vector<float> values(target.cloth.particles(), 1.0f);
    std::copy_n(known.begin(), std::min(known.size(), values.size()), values.begin());
    return read_factors(target, weights_of(target, of), std::move(values));
}

template <WeightOf of>
std::vector<Edit> write_weights(const PaintTarget& target, const std::vector<float>& values, const VertexSet& changed) {
    return write_factors(target, weights_of(target, of), values, changed);
}

// --- Groups

std::vector<float> read_group(const PaintTarget& target) {
    const VertexGroup* group = find_group(target.document, target.place, target.group);
    return membership(target, group ? make_set(group->vertices) : VertexSet{});
}

std::vector<Edit> write_group(const PaintTarget& target, const std::vector<float>& values, const VertexSet& changed) {
    const OnOff now(target, values, changed);
    const VertexGroup* group = find_group(target.document, target.place, target.group);
    const VertexSet before = group ? make_set(group->vertices) : VertexSet{};
    const VertexSet after = without(with(before, now.on), now.off);
    if (after.empty()) return group_removal(target.document, target.place, target.group);
    return group_edits(target.document, target.place, target.group, after);
}

/// A factor on a value of the fabric.
template <WeightOf of>
constexpr PaintKind weight_kind(const char* name, const char* label, const char* what, float usual) {
    return {.name = name,
            .label = label,
            .what = what,
            .neutral = 1,
            .least = 0.01f,
            .most = 100,
            .usual = usual,
            .scale_low = "0.1 × the fabric",
            .scale_high = "10 ×",
            .read = read_weights<of>,
            .write = write_weights<of>};
}

constexpr PaintKind kinds[] = {
    {.name = "pins",
     .label = "Pins",
     .what = "whether a vertex is held",
     .on_off = true,
     .scale_low = "free",
     .scale_high = "pinned",
     .read = read_pins,
     .write = write_pins},
    {.name = "resistance",
     .label = "Resistance",
     .what = "factor on the load at which the cloth tears; 1 is the fabric",
     .neutral = 1,
     .least = 0.01f,
     .most = 100,
     .usual = 0.1f,
     .scale_low = "0.1 × the fabric",
     .scale_high = "10 ×",
     .read = read_resistance,
     .write = write_resistance,
     .prepare = prepare_resistance},
    weight_kind<WeightOf::density>("density", "Density", "factor on the mass per area; 1 is the fabric", 4),
    weight_kind<WeightOf::stretch>("stretch", "Stretch",
                                   "factor on the stiffness against stretch and shear; 1 is the fabric", 10),
    weight_kind<WeightOf::bend>("bend", "Bend", "factor on the stiffness against bending; 1 is the fabric", 10),
    weight_kind<WeightOf::thickness>("thickness", "Thickness", "factor on the thickness in contact; 1 is the fabric",
                                     3),
    {.name = "group",
     .label = "Group",
     .what = "which vertices a group has",
     .on_off = true,
     .scale_low = "outside",
     .scale_high = "in the group",
     .read = read_group,
     .write = write_group},
};

}  // namespace

std::span<const PaintKind> paint_kinds() {
    return kinds;
}

// Factors are shown by their logarithm: half and twice are as far from the fabric.
ClothPaint colors_of(const PaintKind& kind, const std::string& cloth, std::vector<float> values) {
    ClothPaint paint{.cloth = cloth, .values = std::move(values)};
    if (kind.neutral == 0) return paint;
    for (float& value : paint.values) value = std::log10(std::max(value / kind.neutral, 1e-3f));
    paint.least = -1, paint.most = 1;
    paint.scale = render::ColorScale::balance;
    return paint;
}

}  // namespace weft::editor
