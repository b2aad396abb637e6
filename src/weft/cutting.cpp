#include "weft/cutting.h"

#include "scene/problems.h"
#include "solver/model/cuts.h"
#include "solver/model/opened_cloth.h"

#include <algorithm>
#include <numeric>

namespace weft {
namespace {

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
        return Error{place, "leaves the cloth: the edges nearest to it are up to " + number_text(float(off)) +
                                " m away, the longest edge is " + number_text(model.longest_edge) +
                                " m; its points must follow the cloth"};
    return openings;
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
