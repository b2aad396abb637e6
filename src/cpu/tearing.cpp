#include "cpu/tearing.h"

#include "physics/scalar.h"
#include "solver/model/tear_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace weft::cpu {
namespace {

// A triangle with this part of the largest load that its particles can have is looked at in every substep of a frame.
constexpr float watched_part = 0.5f;
// A cut ends at a particle of the rim with more cloth around it at rest, rad.
constexpr float end_angle = 1.5f * std::numbers::pi_v<float> + 1e-3f;
// A rip goes on along an edge that leads forward by at least this part of its length.
constexpr float forward = 0.35f;

scalar::vec3 place_of(const Particles& now, std::uint32_t p) {
    return {now.position[p].x, now.position[p].y, now.position[p].z};
}

scalar::TearSide side_of(const TearLaw& law, std::uint32_t triangle, std::uint32_t k) {
    const float* at = law.sides.data() + std::size_t{5 * k} * law.stride + triangle;
    const std::size_t stride = law.stride;
    return {at[0], at[stride], at[2 * stride], at[3 * stride], at[4 * stride]};
}

}  // namespace

Tearing::Tearing(const ClothModel& model) : arrays_(model) {
    const std::size_t room = std::size_t{arrays_.particle_count} + arrays_.room;
    vertex_.reserve(room);
    hot_.resize(model.face_stride / lane_padding);
    is_watched_.resize(room);
    place_.resize(room);
    watched_.reserve(room), loads_.reserve(room), ends_.reserve(room), chosen_.reserve(room);
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

template <class Visit>
void Tearing::for_each_entry(const TearTable& table, std::uint32_t particle, Visit&& visit) const {
    const std::uint32_t vertex = vertex_[particle];
    for (std::uint32_t i = table.ring_begin[vertex]; i < table.ring_begin[vertex + 1]; ++i)
        if (arrays_.faces[table.entries[i].corner] == particle) visit(i, table.entries[i]);
}

bool Tearing::is_closed(const TearTable& table, std::uint32_t link) const {
    const TearTable::Entry& entry = table.entries[link];
    return entry.next != none && arrays_.faces[entry.corner] == arrays_.faces[table.entries[entry.next].corner] &&
           arrays_.faces[entry.far] == arrays_.faces[entry.next_far];
}

bool Tearing::is_end(const ClothModel& model, std::uint32_t particle) const {
    float angle = 0;
    std::uint32_t triangles = 0, closed = 0;
    for_each_entry(*model.tears, particle, [&](std::uint32_t i, const TearTable::Entry&) {
        angle += model.tear_law->entries[i].angle;
        ++triangles;
        closed += is_closed(*model.tears, i);
    });
    return closed < triangles && angle > end_angle;
}

void Tearing::list_ends(const ClothModel& model) {
    ends_.clear();
    for (std::uint32_t p = 0; p < arrays_.particle_count; ++p)
        if (is_end(model, p)) ends_.push_back(p);
}

void Tearing::watch(const Passes& passes, const ClothModel& model, const float* position, Range triangles) {
    const TearLaw& law = *model.tear_law;
    passes.watch_tears({.position = position,
                        .faces = arrays_.faces.data(),
                        .stride = model.face_stride,
                        .sides = law.sides.data(),
                        .inverse_strength = law.largest_inverse_strength(),
                        .inverse_stretch = law.inverse_stretch,
                        .hot = hot_.data()},
                       watched_part, triangles);
}

void Tearing::add_watched(std::uint32_t particle) {
    if (is_watched_[particle]) return;
    is_watched_[particle] = 1;
    watched_.push_back(particle);
}

void Tearing::begin_watching(const ClothModel& model) {
    for (const std::uint32_t p : watched_) is_watched_[p] = 0;
    watched_.clear();
    for (std::uint32_t packet = 0; packet < hot_.size(); ++packet) {
        for (unsigned bits = hot_[packet]; bits != 0; bits &= bits - 1) {
            const std::uint32_t t = packet * lane_padding + static_cast<std::uint32_t>(std::countr_zero(bits));
            for (std::uint32_t k = 0; k < 3; ++k) add_watched(arrays_.faces[std::size_t{k} * model.face_stride + t]);
        }
    }
    for (const std::uint32_t p : ends_) add_watched(p);
}

// The particles that share a triangle with one at the vertex.
void Tearing::add_around(const ClothModel& model, std::uint32_t vertex) {
    const TearTable& table = *model.tears;
    for (std::uint32_t i = table.ring_begin[vertex]; i < table.ring_begin[vertex + 1]; ++i) {
        const std::uint32_t t = table.entries[i].corner % model.face_stride;
        for (std::uint32_t k = 0; k < 3; ++k) add_watched(arrays_.faces[std::size_t{k} * model.face_stride + t]);
    }
}

Tearing::Watched Tearing::load_of(const ClothModel& model, const Particles& now, std::uint32_t particle) const {
    const TearLaw& law = *model.tear_law;
    scalar::PlaneStress sum = scalar::no_stress();
    float area = 0, strain = 0;
    for_each_entry(*model.tears, particle, [&](std::uint32_t i, const TearTable::Entry& entry) {
        const std::uint32_t t = entry.corner % law.stride, mine = entry.corner / law.stride;
        const scalar::TearSide sides[3] = {side_of(law, t, 0), side_of(law, t, 1), side_of(law, t, 2)};
        scalar::vec3 x[3];
        for (std::uint32_t k = 0; k < 3; ++k) x[k] = place_of(now, arrays_.faces[std::size_t{k} * law.stride + t]);
        const auto stress = scalar::triangle_stress(x[0], x[1], x[2], sides[0], sides[1], sides[2]);
        const auto& [c2, s2] = law.entries[i].turn;
        sum = scalar::add_stress(sum, scalar::turn_stress(stress, c2, s2), law.area[t]);
        area += law.area[t];
        for (const std::uint32_t k : {mine, (mine + 2) % 3})
            strain = scalar::max(strain, scalar::side_strain(x[k], x[(k + 1) % 3], sides[k]));
    });
    Watched at{.particle = particle, .load = strain * law.inverse_stretch, .end = is_end(model, particle)};
    if (!(area > 0)) return at;
    const auto tension = scalar::principal_tension(scalar::add_stress(scalar::no_stress(), sum, 1 / area));
    at.x = tension.x, at.y = tension.y;
    at.load = scalar::max(at.load, scalar::max(tension.most, 0.0f) * inverse_limit(model, at, particle, area));
    return at;
}

float Tearing::inverse_limit(const ClothModel& model, const Watched& at, std::uint32_t particle, float area) const {
    const TearLaw& law = *model.tear_law;
    if (!at.end || !(law.tear_energy > 0))
        return scalar::inverse_strength(at.x, at.y, law.inverse_strength[0], law.inverse_strength[1]);
    float stiffness = 0, length = 0, links = 0;
    for_each_entry(*model.tears, particle, [&](std::uint32_t i, const TearTable::Entry& entry) {
        const std::uint32_t t = entry.corner % law.stride;
        const auto& [c2, s2] = law.entries[i].turn;
        for (std::uint32_t k = 0; k < 3; ++k) {
            stiffness += scalar::side_stiffness(side_of(law, t, k), c2, s2, at.x, at.y) * law.area[t];
        }
        if (entry.next != none) length += law.entries[i].length, links += 1;
    });
    if (!(links > 0)) return 0;
    return scalar::inverse_cut_limit(stiffness / area, length / links, law.tear_energy);
}

// Whether no particle within two edges has a larger load. A rip does not start beside the end of another one.
bool Tearing::is_largest(const ClothModel& model, const Watched& candidate) const {
    const TearTable& table = *model.tears;
    bool largest = true;
    const auto compare = [&](std::uint32_t p) {
        if (p == candidate.particle || !is_watched_[p]) return;
        const Watched& other = loads_[place_[p]];
        if (other.end && !candidate.end) largest = false;
        if (other.end == candidate.end &&
            (other.load > candidate.load || (other.load == candidate.load && p < candidate.particle)))
            largest = false;
    };
    const auto for_each_corner = [&](std::uint32_t p, auto&& visit) {
        for_each_entry(table, p, [&](std::uint32_t, const TearTable::Entry& entry) {
            const std::uint32_t t = entry.corner % model.face_stride;
            for (std::uint32_t k = 0; k < 3; ++k) visit(arrays_.faces[std::size_t{k} * model.face_stride + t]);
        });
    };
    for_each_corner(candidate.particle, [&](std::uint32_t p) {
        if (largest) for_each_corner(p, compare);
    });
    return largest;
}

// The edge of the particle's fan that keeps a rip in this direction nearest to its line.
Tearing::Choice Tearing::choose_link(const ClothModel& model, std::uint32_t particle, float along_x, float along_y,
                                     float strayed, std::uint32_t taken) const {
    Choice best;
    float least = 0;
    for_each_entry(*model.tears, particle, [&](std::uint32_t i, const TearTable::Entry&) {
        if (i == taken || !is_closed(*model.tears, i)) return;
        const auto& [x, y] = model.tear_law->entries[i].along;
        const float length = model.tear_law->entries[i].length;
        const float ahead = x * along_x + y * along_y, aside = strayed + length * (y * along_x - x * along_y);
        if (ahead <= 0) return;
        // Edges that lead more aside than forward count as far off the line.
        const float off = std::abs(aside) + (ahead < forward ? 2 * length * (1 - ahead) : 0);
        if (best.link != none && !(off < least)) return;
        best = {i, aside}, least = off;
    });
    return best;
}

// Inside the cloth a rip starts along two edges. From the rim, and from the end of a cut, it takes one.
Opening Tearing::opening_at(const ClothModel& model, const Watched& at) const {
    const TearTable& table = *model.tears;
    const TearLaw& law = *model.tear_law;
    const std::uint32_t p = at.particle;
    float along_x = -at.y, along_y = at.x;  // across the tension
    float back_x = 0, back_y = 0;           // mean direction of the open edges of its fan
    bool whole = true;
    for_each_entry(table, p, [&](std::uint32_t i, const TearTable::Entry& entry) {
        if (is_closed(table, i)) return;
        whole = false;
        if (entry.next != none) back_x += law.entries[i].along[0], back_y += law.entries[i].along[1];
    });
    Opening opening;
    const auto take = [&](std::size_t k, const Choice& choice) {
        opening.links[k] = choice.link;
        opening.strayed[k] = choice.strayed;
    };
    if (whole) {
        const Choice first = choose_link(model, p, along_x, along_y, 0, none);
        if (first.link == none) return opening;
        const Choice second = choose_link(model, p, -along_x, -along_y, 0, first.link);
        if (second.link == none) return opening;
        take(0, first), take(1, second);
        return opening;
    }
    if (at.end && (back_x != 0 || back_y != 0)) {
        if (along_x * back_x + along_y * back_y > 0) along_x = -along_x, along_y = -along_y;
        take(0, choose_link(model, p, along_x, along_y, arrays_.strayed[vertex_[p]], none));
        return opening;
    }
    const Choice one = choose_link(model, p, along_x, along_y, 0, none),
                 other = choose_link(model, p, -along_x, -along_y, 0, none);
    const bool first = other.link == none || (one.link != none && std::abs(one.strayed) <= std::abs(other.strayed));
    take(0, first ? one : other);
    return opening;
}

void Tearing::open(const ClothModel& model, const Opening& opening, const Particles& now, std::span<float> weights) {
    const std::uint32_t before = arrays_.particle_count;
    if (!Opener(model, arrays_).open(opening)) return;
    openings_.push_back(opening);
    const TearTable& table = *model.tears;
    for (std::uint32_t copy = before; copy < arrays_.particle_count; ++copy) {
        const std::uint32_t from = arrays_.copied_from[copy - table.vertex_count()];
        vertex_.push_back(vertex_[from]);
        for (const auto& array : {now.position, now.start, now.velocity, now.compensation}) array[copy] = array[from];
        weights_before_.push_back({copy, weights[copy]});
        weights[copy] = weights[from];
    }
    // Particles at the vertex and at the far ends have other masses now, unless they are pinned.
    std::array<std::uint32_t, 3> vertices{table.entries[opening.links[0]].vertex, none, none};
    for (std::size_t k = 0; k < 2; ++k)
        if (opening.links[k] != none) vertices[k + 1] = table.entries[table.entries[opening.links[k]].twin].vertex;
    for (const std::uint32_t v : vertices) {
        if (v == none) continue;
        for (std::uint32_t i = table.ring_begin[v]; i < table.ring_begin[v + 1]; ++i) {
            const std::uint32_t p = arrays_.faces[table.entries[i].corner];
            weights_before_.push_back({p, weights[p]});
            if (weights[p] > 0) weights[p] = 1 / arrays_.mass[p];
            now.position[p].w = weights[p];
            const auto at = std::ranges::lower_bound(ends_, p);
            const bool listed = at != ends_.end() && *at == p, end = is_end(model, p);
            if (end && !listed) ends_.insert(at, p);
            if (!end && listed) ends_.erase(at);
        }
        add_around(model, v);
    }
}

void Tearing::run(const ClothModel& model, const Particles& now, std::span<float> weights, std::uint32_t substep) {
    if (substep == 0) begin_watching(model);
    if (watched_.empty()) return;
    loads_.clear(), chosen_.clear();
    for (const std::uint32_t p : watched_) {
        place_[p] = static_cast<std::uint32_t>(loads_.size());
        loads_.push_back(load_of(model, now, p));
        if (!(weights[p] > 0)) loads_.back().load = 0;  // a pinned particle stays whole; cloth tears beside it
    }
    for (const Watched& at : loads_)
        if (at.load >= 1 && is_largest(model, at)) chosen_.push_back(at);
    std::ranges::sort(chosen_, {}, &Watched::particle);
    for (const Watched& at : chosen_) {
        const Opening opening = opening_at(model, at);
        if (opening.links[0] != none) open(model, opening, now, weights);
    }
}

}  // namespace weft::cpu
