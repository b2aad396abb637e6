#include "cpu/tearing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace weft::cpu {
namespace {

// A triangle with this part of the largest load that its particles can have is one around which an edge may open in the
// substep. The load of a particle is at most the largest of its triangles: it is that of their mean stress. The
// difference to 1 is room for rounding.
constexpr float loaded_part_of_load = 0.99f;

// Larger than 1 / limit of the tension in any direction at a particle where a cut ends, m/N. With the angle between a
// side and the tension, 2φ = angle of q and D, the stiffness is Σ k cos⁴φ = Σ k (1 + 2 q·D + (q·D)²)/4. It is at least
// (Σ k - 2 |Σ k q| + the smaller eigenvalue of Σ k q qᵀ)/4. Couplings only add to it.
float most_inverse_end_limit(const scalar::TearAccess& c, std::uint32_t particle) {
    const std::uint32_t vertex = c.vertex[particle];
    double area = 0, length = 0, links = 0, all = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (std::uint32_t i = scalar::tear_ring(c, vertex); i < scalar::tear_ring(c, vertex + 1); ++i) {
        if (!scalar::tear_has(c, i, particle)) continue;
        const std::uint32_t t = scalar::tear_triangle(c, scalar::tear_corner(c, i));
        const double here = double{scalar::tear_area(c, t)}, c2 = double{scalar::tear_turn(c, i, 0)},
                     s2 = double{scalar::tear_turn(c, i, 1)};
        area += here;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const scalar::TearSide side = scalar::tear_side(c, t, k);
            const double of_x = double{side.x} * double{side.x} - double{side.y} * double{side.y},
                         of_y = 2 * double{side.x} * double{side.y};
            const double qx = of_x * c2 - of_y * s2, qy = of_x * s2 + of_y * c2, stiffness = double{side.pull} * here;
            all += stiffness, x += stiffness * qx, y += stiffness * qy;
            xx += stiffness * qx * qx, xy += stiffness * qx * qy, yy += stiffness * qy * qy;
        }
        if (scalar::tear_next(c, i) == none) continue;
        length += double{scalar::tear_length(c, i)}, links += 1;
    }
    const double smaller = 0.5 * (xx + yy - std::hypot(xx - yy, 2 * xy));
    const double least = 0.999 * 0.25 * (all - 2 * std::hypot(x, y) + smaller) - 1e-6 * all;
    if (!(links > 0)) return 0;
    if (!(least > 0)) return 1e30f;
    return scalar::inverse_cut_limit(static_cast<float>(least / area), static_cast<float>(length / links),
                                     c.model.tear_law->tear_energy);
}

}  // namespace

Tearing::Tearing(const ClothModel& model) : arrays_(model) {
    const std::size_t room = std::size_t{arrays_.particle_count} + arrays_.room;
    vertex_.reserve(room);
    hot_.resize(model.face_stride / lane_padding);
    loaded_triangles_.resize(hot_.size());
    is_near_.resize(hot_.size());
    near_.reserve(hot_.size());
    is_watched_.resize(room);
    loads_.resize(room);
    is_loaded_.resize(room);
    loaded_.reserve(room);
    watched_.reserve(room), ends_.reserve(room), chosen_.reserve(room);
    openings_.reserve(arrays_.room);
    set_model(model);
}

void Tearing::set_model(const ClothModel& model) {
    openings_.clear();
    weights_before_.clear();
    const std::uint32_t vertices = model.tears->vertex_count();
    vertex_.resize(vertices);
    for (std::uint32_t v = 0; v < vertices; ++v) vertex_[v] = v;
    for (const std::uint32_t from : arrays_.copied_from) vertex_.push_back(vertex_[from]);
    list_ends(model);
}

void Tearing::roll_back(const ClothModel& model, std::span<float> weights) {
    if (openings_.empty()) return;
    for (std::size_t i = weights_before_.size(); i-- > 0;)
        weights[weights_before_[i].particle] = weights_before_[i].weight;
    arrays_ = OpenedArrays(model);
    set_model(model);
}

void Tearing::list_ends(const ClothModel& model) {
    const StretchLaw law(model.fabric.stretch);
    const scalar::TearAccess access{.model = model, .arrays = arrays_, .stretch = law, .vertex = vertex_.data()};
    ends_.clear();
    limits_ = model.tear_law->watch;
    for (std::uint32_t p = 0; p < arrays_.particle_count; ++p)
        if (scalar::tear_is_end(access, p)) ends_.push_back(p), limit_end(access, p);
}

// The limits of triangles hold for the ends of cuts at their corners too. Seams have limits of their own there.
void Tearing::limit_end(const scalar::TearAccess& access, std::uint32_t particle) {
    const ClothModel& model = access.model;
    const TearLaw& law = *model.tear_law;
    if (!law.seams.empty() || !(law.tear_energy > 0)) return;
    const std::uint32_t vertex = vertex_[particle];
    const float limit = most_inverse_end_limit(access, particle) * law.inverse_resistance[vertex];
    for (std::uint32_t i = model.tears->ring_begin[vertex]; i < model.tears->ring_begin[vertex + 1]; ++i) {
        if (!scalar::tear_has(access, i, particle)) continue;
        float& of_triangle = limits_[model.tears->entries[i].corner % model.face_stride];
        of_triangle = std::max(of_triangle, limit);
    }
}

void Tearing::watch(const Passes& passes, const ClothModel& model, const float* position, Range triangles) {
    passes.watch_tears(view(model, position, model.tear_law->watch.data(), hot_), watched_part_of_load, triangles);
}

TearView Tearing::view(const ClothModel& model, const float* position, const float* limits,
                       std::vector<std::uint16_t>& hot) const {
    const TearLaw& law = *model.tear_law;
    return {.position = position,
            .faces = arrays_.faces.data(),
            .stride = model.face_stride,
            .sides = law.sides.data(),
            .couplings = law.couplings.empty() ? nullptr : law.couplings.data(),
            .limits = limits,
            .hot = hot.data()};
}

void Tearing::add_watched(const ClothModel& model, std::uint32_t particle) {
    if (is_watched_[particle]) return;
    is_watched_[particle] = 1;
    watched_.push_back(particle);
    const TearTable& table = *model.tears;
    const std::uint32_t vertex = vertex_[particle];
    for (std::uint32_t i = table.ring_begin[vertex]; i < table.ring_begin[vertex + 1]; ++i) {
        const std::uint32_t packet = table.entries[i].corner % model.face_stride / lane_padding;
        if (is_near_[packet]) continue;
        is_near_[packet] = 1;
        near_.push_back(packet);
    }
}

void Tearing::begin_watching(const ClothModel& model) {
    for (const std::uint32_t p : watched_) is_watched_[p] = 0;
    watched_.clear();
    for (const std::uint32_t packet : near_) is_near_[packet] = 0;
    near_.clear();
    for (std::uint32_t packet = 0; packet < hot_.size(); ++packet) {
        for (unsigned bits = hot_[packet]; bits != 0; bits &= bits - 1) {
            const std::uint32_t t = packet * lane_padding + static_cast<std::uint32_t>(std::countr_zero(bits));
            for (std::uint32_t k = 0; k < 3; ++k)
                add_watched(model, arrays_.faces[std::size_t{k} * model.face_stride + t]);
        }
    }
    for (const std::uint32_t p : ends_) add_watched(model, p);
}

// The particles that share a triangle with one at the vertex.
void Tearing::add_around(const ClothModel& model, std::uint32_t vertex) {
    const TearTable& table = *model.tears;
    for (std::uint32_t i = table.ring_begin[vertex]; i < table.ring_begin[vertex + 1]; ++i) {
        const std::uint32_t t = table.entries[i].corner % model.face_stride;
        for (std::uint32_t k = 0; k < 3; ++k) add_watched(model, arrays_.faces[std::size_t{k} * model.face_stride + t]);
    }
}

void Tearing::add_loaded(std::uint32_t particle) {
    if (!is_watched_[particle] || is_loaded_[particle]) return;
    is_loaded_[particle] = 1;
    loaded_.push_back(particle);
}

// A particle does not open beside the end of a cut that has a load. The ends that scalar::tear_is_largest() asks for.
void Tearing::add_ends_around(const scalar::TearAccess& access, std::uint32_t particle) {
    const auto for_each_around = [&](std::uint32_t p, const auto& visit) {
        const std::uint32_t vertex = vertex_[p];
        for (std::uint32_t i = scalar::tear_ring(access, vertex); i < scalar::tear_ring(access, vertex + 1); ++i) {
            const std::uint32_t corner = scalar::tear_corner(access, i);
            if (scalar::tear_face(access, corner) != p) continue;
            const std::uint32_t t = scalar::tear_triangle(access, corner);
            for (std::uint32_t k = 0; k < 3; ++k) visit(scalar::tear_corner_of(access, t, k));
        }
    };
    for_each_around(particle, [&](std::uint32_t near) {
        for_each_around(near, [&](std::uint32_t other) {
            if (std::ranges::binary_search(ends_, other)) add_loaded(other);
        });
    });
}

// Of the loaded particles from `from` on.
void Tearing::find_loads(const scalar::TearAccess& access, std::span<const float> weights, std::size_t from) {
    for (std::size_t i = from; i < loaded_.size(); ++i) {
        const std::uint32_t p = loaded_[i];
        loads_[p] = scalar::tear_load(access, p);
        if (!(weights[p] > 0)) loads_[p].load = 0;  // a pinned particle stays whole; cloth tears beside it
    }
}

// Lists the watched particles that may open: those of loaded triangles, and the ends of cuts at seams.
void Tearing::list_loaded(const Passes& passes, const ClothModel& model, const float* position) {
    for (const std::uint32_t p : loaded_) is_loaded_[p] = 0, loads_[p] = {};
    loaded_.clear();
    const TearView triangles = view(model, position, limits_.data(), loaded_triangles_);
    for (const std::uint32_t packet : near_) {
        passes.watch_tears(triangles, loaded_part_of_load, {packet * lane_padding, (packet + 1) * lane_padding});
        for (unsigned bits = loaded_triangles_[packet]; bits != 0; bits &= bits - 1) {
            const std::uint32_t t = packet * lane_padding + static_cast<std::uint32_t>(std::countr_zero(bits));
            for (std::uint32_t k = 0; k < 3; ++k) add_loaded(arrays_.faces[std::size_t{k} * model.face_stride + t]);
        }
    }
    if (model.tear_law->seams.empty()) return;
    for (const std::uint32_t p : ends_) add_loaded(p);
}

// Particles at the vertex have other masses now, unless they are pinned.
void Tearing::open_vertex(const scalar::TearAccess& access, std::uint32_t vertex, const Particles& now,
                          std::span<float> weights) {
    const TearTable& table = *access.model.tears;
    for (std::uint32_t i = table.ring_begin[vertex]; i < table.ring_begin[vertex + 1]; ++i) {
        const std::uint32_t p = arrays_.faces[table.entries[i].corner];
        weights_before_.push_back({p, weights[p]});
        if (weights[p] > 0) weights[p] = 1 / arrays_.mass[p];
        now.position[p].w = weights[p];
        const auto at = std::ranges::lower_bound(ends_, p);
        const bool listed = at != ends_.end() && *at == p, end = scalar::tear_is_end(access, p);
        if (end && !listed) ends_.insert(at, p);
        if (end) limit_end(access, p);
        if (!end && listed) ends_.erase(at);
    }
    add_around(access.model, vertex);
}

void Tearing::open(const scalar::TearAccess& access, const scalar::TearOpening& opening,
                   const TornParticles& particles) {
    const auto& [now, weights, thickness_factors] = particles;
    const std::uint32_t before = arrays_.particle_count;
    const Opening links{{opening.first, opening.second}, {opening.first_strayed, opening.second_strayed}};
    if (!Opener(access.model, arrays_, access.stretch).open(links)) return;
    openings_.push_back(links);
    for (std::uint32_t copy = before; copy < arrays_.particle_count; ++copy) {
        const std::uint32_t from = arrays_.copied_from[copy - access.model.tears->vertex_count()];
        vertex_.push_back(vertex_[from]);
        for (const auto& array : {now.position, now.start, now.velocity, now.compensation}) array[copy] = array[from];
        weights_before_.push_back({copy, weights[copy]});
        weights[copy] = weights[from];
        if (!thickness_factors.empty()) thickness_factors[copy] = thickness_factors[from];
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = scalar::tear_opened_vertex(access, opening, k);
        if (vertex != none) open_vertex(access, vertex, now, weights);
    }
}

void Tearing::run(const Passes& passes, const ClothModel& model, const TornParticles& particles,
                  std::uint32_t substep) {
    const auto& [now, weights, unused] = particles;
    if (substep == 0) begin_watching(model);
    if (watched_.empty()) return;
    list_loaded(passes, model, &now.position.data()->x);
    if (loaded_.empty()) return;
    const StretchLaw law(model.fabric.stretch);
    const scalar::TearAccess access{.model = model,
                                    .arrays = arrays_,
                                    .stretch = law,
                                    .position = now.position.data(),
                                    .vertex = vertex_.data(),
                                    .watched = is_watched_.data(),
                                    .loads = loads_.data()};
    find_loads(access, weights, 0);
    const std::size_t loaded = loaded_.size();
    for (std::size_t i = 0; i < loaded; ++i)
        if (loads_[loaded_[i]].load >= 1) add_ends_around(access, loaded_[i]);
    find_loads(access, weights, loaded);
    chosen_.clear();
    for (const std::uint32_t p : loaded_)
        if (loads_[p].load >= 1 && scalar::tear_is_largest(access, p, loads_[p])) chosen_.push_back(p);
    std::ranges::sort(chosen_);
    if (chosen_.size() > WEFT_TEAR_MOST_OPENINGS) chosen_.resize(WEFT_TEAR_MOST_OPENINGS);
    for (const std::uint32_t p : chosen_) {
        const scalar::TearOpening opening = scalar::tear_opening(access, p, loads_[p]);
        if (opening.first != none) open(access, opening, particles);
    }
}

}  // namespace weft::cpu
