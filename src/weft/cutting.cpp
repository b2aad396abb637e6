#include "weft/cutting.h"

#include "scene/problems.h"
#include "solver/model/cuts.h"
#include "solver/model/opened_cloth.h"
#include "solver/model/tear_table.h"
#include "weft/painting.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <variant>

namespace weft {
namespace {

std::string short_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

// Opens edges in a copy of the cloth's arrays.
class Rehearsal {
  public:
    explicit Rehearsal(const ClothModel& model) : arrays_(model), opener_(model, arrays_) {}

    Result<void> open(std::span<const Opening> openings, const std::string& place) {
        const std::uint32_t before = arrays_.particle_count;
        for (const Opening& opening : openings)
            if (!opener_.open(opening))
                return Error{place,
                             "needs more room than there is for copies of particles: " + std::to_string(arrays_.room) +
                                 " are left of those that the cloth was built with"};
        if (arrays_.particle_count == before)
            return Error{place, "parts nothing: its edges are open already, or are a single edge inside the cloth"};
        return {};
    }

  private:
    OpenedArrays arrays_;
    Opener opener_;
};

}  // namespace

Result<std::vector<Opening>> find_cut(const CutDesc& cut, const ClothModel& model, std::span<const Vec4> positions,
                                      const std::string& place) {
    const bool at_rest = positions.empty();
    if (at_rest) positions = {model.start.data(), model.particle_count};
    if (const auto* plane = std::get_if<PlaneCut>(&cut.along)) {
        const Vec3 normal = normalized(plane->normal);
        auto openings = openings_along_plane(model, positions, normal * plane->offset, normal);
        if (openings.empty()) return Error{place, "meets no closed edge of the cloth"};
        return openings;
    }
    const auto& stroke = std::get<PathCut>(cut.along).points;
    auto openings =
        at_rest ? openings_along_stroke_at_rest(model, stroke) : openings_along_stroke(model, positions, stroke);
    if (openings.empty()) return Error{place, "meets no closed edge of the cloth"};
    const double off = farthest_from(stroke, model, positions, openings), most = 0.75 * double{model.longest_edge};
    if (off > most)
        return Error{place, "leaves the cloth: the edges nearest to it are up to " + short_text(off) +
                                " m away, the longest edge is " + short_text(double{model.longest_edge}) +
                                " m; its points must follow the cloth"};
    return openings;
}

namespace {

// Perpendicular to the plane, or to the part of the polyline that is nearest to the edge, in the plane of the cloth.
Vec3 across_seam(const std::variant<PathCut, PlaneCut>& along, const ClothModel& model, std::uint32_t link) {
    if (const auto* plane = std::get_if<PlaneCut>(&along)) return plane->normal;
    const TearTable& table = *model.tears;
    const TearTable::Entry& entry = table.entries[link];
    const auto place = [&](std::uint32_t corner) { return model.rest_position(table.vertices[corner]); };
    const Vec3 middle = (place(entry.corner) + place(entry.far)) * 0.5f;
    Vec3 normal{};
    for (std::uint32_t i = table.ring_begin[entry.vertex]; i < table.ring_begin[entry.vertex + 1]; ++i) {
        const std::uint32_t t = table.entries[i].corner % model.face_stride;
        const Vec3 a = place(t), b = place(model.face_stride + t), c = place(2 * model.face_stride + t);
        normal = normal + cross(b - a, c - a);
    }
    return cross(normal, nearest_direction(std::get<PathCut>(along).points, middle));
}

void add_seam(const SeamDesc& seam, const ClothModel& model, TearPaint& paint, Errors& errors,
              const std::string& place) {
    const auto links = find_cut({.time = 0, .along = seam.along}, model, {}, place);
    if (!links) {
        errors.insert(errors.end(), links.errors().begin(), links.errors().end());
        return;
    }
    for (const Opening& opening : *links)
        for (const std::uint32_t link : opening.links)
            if (link != none)
                paint.seams.push_back({link, seam.strength, seam.tear_energy, across_seam(seam.along, model, link)});
}

Result<std::vector<float>> resistance_of(const SceneCloth& cloth, const ClothModel& model, const PinnedCloth& particles,
                                         const std::string& pointer) {
    std::vector<float> resistance;
    Errors errors;
    if (!cloth.resistance.empty()) resistance.assign(model.tears->vertex_count(), 1.0f);
    for (std::size_t i = 0; i < cloth.resistance.size(); ++i) {
        const auto done = paint_factors(cloth.resistance[i], particles, resistance, at(at(pointer, "resistance"), i));
        if (!done) errors.insert(errors.end(), done.errors().begin(), done.errors().end());
    }
    if (!errors.empty()) return errors;
    return resistance;
}

}  // namespace

Result<std::shared_ptr<const TearPaint>> paint_strength(const SceneCloth& cloth, const ClothModel& model,
                                                        const PinnedCloth& particles, const std::string& pointer) {
    if (cloth.seams.empty() && cloth.resistance.empty()) return std::shared_ptr<const TearPaint>();
    auto paint = std::make_shared<TearPaint>();
    Errors errors;
    for (std::size_t i = 0; i < cloth.seams.size(); ++i)
        add_seam(cloth.seams[i], model, *paint, errors, at(at(pointer, "seams"), i));
    auto resistance = resistance_of(cloth, model, particles, pointer);
    if (!resistance) errors.insert(errors.end(), resistance.errors().begin(), resistance.errors().end());
    if (!errors.empty()) return errors;
    paint->resistance = std::move(*resistance);
    return std::shared_ptr<const TearPaint>(std::move(paint));
}

Result<std::shared_ptr<const TearPaint>> repaint_resistance(const SceneCloth& cloth, const ClothModel& model,
                                                            const PinnedCloth& particles, const std::string& pointer) {
    auto resistance = resistance_of(cloth, model, particles, pointer);
    if (!resistance) return resistance.errors();
    const bool has_seams = model.tear_paint && !model.tear_paint->seams.empty();
    if (resistance->empty() && !has_seams) return std::shared_ptr<const TearPaint>();
    auto paint = has_seams ? std::make_shared<TearPaint>(*model.tear_paint) : std::make_shared<TearPaint>();
    paint->resistance = std::move(*resistance);
    return std::shared_ptr<const TearPaint>(std::move(paint));
}

Result<void> check_opens(const ClothModel& model, std::span<const Opening> openings, const std::string& place) {
    return Rehearsal(model).open(openings, place);
}

Result<std::vector<PlannedCut>> plan_cuts(const SceneCloth& cloth, const ClothModel& model,
                                          const std::string& pointer) {
    std::vector<PlannedCut> planned;
    if (cloth.cuts.empty()) return planned;
    std::vector<std::size_t> order(cloth.cuts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return cloth.cuts[i].time; });
    Rehearsal rehearsal(model);
    std::vector<Errors> problems(cloth.cuts.size());
    for (const std::size_t i : order) {
        const std::string place = at(at(pointer, "cuts"), i);
        auto openings = find_cut(cloth.cuts[i], model, {}, place);
        const auto opened = openings ? rehearsal.open(*openings, place) : openings.errors();
        if (!opened) {
            problems[i] = opened.errors();
            continue;
        }
        planned.push_back({.time = cloth.cuts[i].time, .openings = std::move(*openings)});
    }
    Errors errors;
    for (const Errors& of_cut : problems) errors.insert(errors.end(), of_cut.begin(), of_cut.end());
    if (!errors.empty()) return errors;
    return planned;
}

}  // namespace weft
