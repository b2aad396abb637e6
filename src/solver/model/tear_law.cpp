#include "solver/model/tear_law.h"

#include "solver/model/stress_table.h"
#include "solver/model/tear_paint.h"
#include "solver/model/tear_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

// A strain limit below this would be within the rounding of positions.
constexpr float least_strain = 1e-4f;

float single(double x) {
    return static_cast<float>(x);
}

class LawBuilder {
  public:
    explicit LawBuilder(const ClothModel& model)
        : model_(model),
          faces_(model.tears->vertices),
          stress_(make_stress_table(model, {faces_.data(), model.face_stride, model.triangle_count})) {
        law_.stride = model.face_stride;
        law_.sides.resize(std::size_t{3 * WEFT_TEAR_SIDE_NUMBERS} * law_.stride);
        if (stress_.membranes) law_.couplings.resize(std::size_t{6} * law_.stride);
        law_.area.resize(law_.stride);
        law_.entries.resize(model.tears->entries.size());
    }

    TearLaw run() {
        std::vector<std::uint32_t> place(model_.triangle_count, none);
        for (std::uint32_t i = 0; i < stress_.faces.size(); ++i) {
            place[stress_.faces[i].triangle] = i;
            add_sides(stress_.faces[i]);
        }
        for (std::uint32_t i = 0; i < law_.entries.size(); ++i) {
            const TearTable::Entry& entry = model_.tears->entries[i];
            const std::uint32_t face = place[entry.corner % law_.stride];
            if (face != none) add_turn(stress_.faces[face], entry.vertex, law_.entries[i]);
            if (entry.next != none) add_link(entry, law_.entries[i]);
        }
        set_limits();
        paint();
        return std::move(law_);
    }

  private:
    std::uint32_t corner(std::uint32_t triangle, std::uint32_t k) const { return faces_[k * law_.stride + triangle]; }
    reference::vec3 place_of(std::uint32_t p) const { return reference::to_double(model_.rest_position(p)); }

    void add_sides(const StressTable::Face& face) {
        const std::uint32_t t = face.triangle;
        std::array<std::size_t, 3> same{};  // the face's side, by side of the triangle
        law_.area[t] = single(face.area);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corner(t, k), b = corner(t, (k + 1) % 3);
            for (std::uint32_t other = 0; other < 3; ++other) {
                const std::uint32_t c = face.corners[other], d = face.corners[(other + 1) % 3];
                if (!(a == c && b == d) && !(a == d && b == c)) continue;
                same[k] = other;
                const auto& [rest, pull, push, x, y, play] = face.sides[other];
                const double way = a == c ? 1 : -1;  // the side may run the other way
                const std::array numbers{rest, pull, push, way * x, way * y, play};
                for (std::uint32_t i = 0; i < WEFT_TEAR_SIDE_NUMBERS; ++i)
                    law_.sides[std::size_t{WEFT_TEAR_SIDE_NUMBERS * k + i} * law_.stride + t] = single(numbers[i]);
            }
        }
        if (stress_.membranes) add_coupling(face, same);
    }
    void add_coupling(const StressTable::Face& face, const std::array<std::size_t, 3>& same) {
        const auto at = [&](std::size_t k, std::size_t l) { return face.coupling[same[k]][same[l]]; };
        const std::array numbers{at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(2, 0)};
        for (std::size_t i = 0; i < numbers.size(); ++i)
            law_.couplings[i * law_.stride + face.triangle] = single(numbers[i]);
    }
    void add_turn(const StressTable::Face& face, std::uint32_t vertex, TearLaw::Entry& entry) const {
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (face.corners[k] != vertex) continue;
            entry.turn = {single(face.turns[k][0]), single(face.turns[k][1])};
            const auto a = place_of(face.corners[(k + 1) % 3]) - place_of(vertex),
                       b = place_of(face.corners[(k + 2) % 3]) - place_of(vertex);
            const auto n = cross(a, b);
            entry.angle = single(std::atan2(std::sqrt(dot(n, n)), dot(a, b)));
        }
    }
    void add_link(const TearTable::Entry& from, TearLaw::Entry& entry) const {
        const auto along = place_of(faces_[from.far]) - place_of(from.vertex);
        const auto& axes = stress_.axes[from.vertex];
        const double x = dot(along, axes[0]), y = dot(along, axes[1]), size = std::sqrt(x * x + y * y);
        entry.length = single(std::sqrt(dot(along, along)));
        if (size > 0) entry.along = {single(x / size), single(y / size)};
    }
    void set_limits() {
        if (!stress_.inextensible && !model_.reserved.erodes) {
            for (std::size_t i = 0; i < 2; ++i) law_.inverse_strength[i] = single(stress_.inverse_strength[i]);
            law_.tear_energy = single(stress_.tear_energy);
        }
        const float ratio = model_.fabric.tear.tear_ratio;
        if (ratio > 0) law_.inverse_stretch = 1 / std::max(ratio - 1, least_strain);
    }

    std::array<double, 2> across(const TearPaint::Link& seam, const std::array<reference::vec3, 2>& axes) const {
        const TearTable::Entry& entry = model_.tears->entries[seam.link];
        return seam_normal(seam, axes, place_of(faces_[entry.far]) - place_of(entry.vertex));
    }
    void paint() {
        const auto vertices = model_.tears->vertex_count();
        law_.inverse_resistance.assign(vertices, 1.0f);
        const float strength = std::max(law_.inverse_strength[0], law_.inverse_strength[1]);
        std::vector<float> tension(vertices, strength);
        if (model_.tear_paint) {
            const TearPaint& paint = *model_.tear_paint;
            for (std::size_t v = 0; v < paint.resistance.size(); ++v)
                law_.inverse_resistance[v] = 1 / paint.resistance[v];
            if (!paint.seams.empty() && !stress_.inextensible) law_.seams.resize(law_.entries.size());
            for (const TearPaint::Link& seam : paint.seams) {
                if (law_.seams.empty()) break;
                const auto [x, y] = across(seam, stress_.axes[model_.tears->entries[seam.link].vertex]);
                law_.seams[seam.link] = {1 / seam.strength, seam.tear_energy, single(x), single(y)};
                float& most = tension[model_.tears->entries[seam.link].vertex];
                most = std::max(most, 1 / seam.strength);
            }
        }
        law_.watch.resize(std::size_t{2} * law_.stride);
        for (const TearTable::Entry& entry : model_.tears->entries) {
            const float inverse = law_.inverse_resistance[entry.vertex];
            float* const at = law_.watch.data() + entry.corner % law_.stride;
            at[0] = std::max(at[0], tension[entry.vertex] * inverse);
            at[law_.stride] = std::max(at[law_.stride], law_.inverse_stretch * inverse);
        }
    }

    const ClothModel& model_;
    const std::vector<std::uint32_t>& faces_;  // corners before any opening
    StressTable stress_;
    TearLaw law_;
};

}  // namespace

std::shared_ptr<const TearLaw> make_tear_law(const ClothModel& model) {
    return std::make_shared<const TearLaw>(LawBuilder(model).run());
}

std::shared_ptr<const ClothModel> with_tear_paint(const ClothModel& from, std::shared_ptr<const TearPaint> paint) {
    auto model = std::make_shared<ClothModel>(from);
    model->tear_paint = std::move(paint);
    model->tear_law = make_tear_law(*model);
    return model;
}

}  // namespace weft
