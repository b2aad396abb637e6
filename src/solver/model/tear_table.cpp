#include "solver/model/tear_table.h"

#include "physics/stretch/stretch_law.h"
#include "solver/model/cloth_model.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace weft {
namespace {

EdgeEnds sorted(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

class TearTableBuilder {
  public:
    TearTableBuilder(const ClothModel& model, const RestShape& rest)
        : model_(model), rest_(rest), topology_(rest.topology) {}

    TearTable run() {
        make_rings();
        table_.vertices.resize(std::size_t{3} * model_.face_stride);
        for (const TearTable::Entry& entry : table_.entries) table_.vertices[entry.corner] = entry.vertex;
        make_twins();
        make_stretch();
        make_springs();
        make_membranes();
        make_hinged(ConstraintKind::bend);
        make_hinged(ConstraintKind::moment);
        make_hinged(ConstraintKind::distance_bend);
        make_plates();
        list_rows();
        for (const EdgeEnds& ends : model_.edges->without_row) {
            const Edge& edge = *find_edge(ends[0], ends[1]);
            table_.without_row.push_back({corner(edge.triangle0, ends[0]), corner(edge.triangle0, ends[1])});
        }
        return std::move(table_);
    }

  private:
    std::uint32_t corner(std::uint32_t triangle, std::uint32_t particle) const {
        std::uint32_t k = 0;
        while (topology_.triangles[triangle][k] != particle) ++k;
        return k * model_.face_stride + triangle;
    }
    const Edge* find_edge(std::uint32_t a, std::uint32_t b) const {
        const EdgeEnds ends = sorted(a, b);
        const auto& edges = topology_.edges;
        const auto found = std::ranges::lower_bound(edges, ends, {}, [](const Edge& e) { return EdgeEnds{e.a, e.b}; });
        return found != edges.end() && found->a == ends[0] && found->b == ends[1] ? &*found : nullptr;
    }
    static std::uint32_t other_triangle(const Edge& edge, std::uint32_t triangle) {
        return edge.triangle0 == triangle ? edge.triangle1 : edge.triangle0;
    }

    // Walks from triangle to triangle around the vertex: first from the ends of open fans, then around closed ones.
    void make_rings() {
        table_.ring_begin.push_back(0);
        std::vector<std::uint32_t> left;
        for (std::uint32_t v = 0; v < topology_.particle_count; ++v) {
            const auto triangles = topology_.particle_triangles[v];
            left.assign(triangles.begin(), triangles.end());
            for (const bool open : {true, false}) {
                for (std::size_t i = 0; i < left.size();) {
                    std::uint32_t out = 0;  // where the walk leaves the first triangle
                    if (open ? ends_fan(v, left[i], out) : leaves(v, left[i], out)) {
                        walk(v, left[i], out, left);
                        i = 0;
                    } else {
                        ++i;
                    }
                }
            }
            table_.ring_begin.push_back(static_cast<std::uint32_t>(table_.entries.size()));
        }
    }
    std::array<std::uint32_t, 2> others(std::uint32_t v, std::uint32_t triangle) const {
        const Triangle& t = topology_.triangles[triangle];
        const std::uint32_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        return {t[(k + 1) % 3], t[(k + 2) % 3]};
    }
    // Whether one of the triangle's edges at v has no other triangle; the walk then leaves across the other one.
    bool ends_fan(std::uint32_t v, std::uint32_t triangle, std::uint32_t& out) const {
        const auto [b, c] = others(v, triangle);
        const bool at_b = find_edge(v, b)->triangle1 == none, at_c = find_edge(v, c)->triangle1 == none;
        out = at_b ? c : b;
        return at_b || at_c;
    }
    bool leaves(std::uint32_t v, std::uint32_t triangle, std::uint32_t& out) const {
        out = others(v, triangle)[1];
        return true;
    }
    void walk(std::uint32_t v, std::uint32_t triangle, std::uint32_t out, std::vector<std::uint32_t>& left) {
        const auto first = static_cast<std::uint32_t>(table_.entries.size());
        while (true) {
            left.erase(std::ranges::find(left, triangle));
            auto& entry = table_.entries.emplace_back();
            entry.vertex = v;
            entry.corner = corner(triangle, v);
            const std::uint32_t next = other_triangle(*find_edge(v, out), triangle);
            if (next == none) return;
            entry.far = corner(triangle, out);
            entry.next_far = corner(next, out);
            const bool closed = std::ranges::find(left, next) == left.end();
            entry.next = closed ? first : static_cast<std::uint32_t>(table_.entries.size());
            if (closed) return;
            const auto [b, c] = others(v, next);
            out = b == out ? c : b;
            triangle = next;
        }
    }
    std::uint32_t vertex_at(std::uint32_t corner) const {
        return topology_.triangles[corner % model_.face_stride][corner / model_.face_stride];
    }
    void make_twins() {
        for (std::uint32_t i = 0; i < table_.entries.size(); ++i) {
            TearTable::Entry& entry = table_.entries[i];
            if (entry.next == none) continue;
            const std::uint32_t far = vertex_at(entry.far);
            const auto of = [&](std::uint32_t c) { return c % model_.face_stride; };
            const EdgeEnds mine = sorted(of(entry.far), of(entry.next_far));
            for (std::uint32_t j = table_.ring_begin[far]; j < table_.ring_begin[far + 1]; ++j) {
                const TearTable::Entry& other = table_.entries[j];
                if (other.next == none || vertex_at(other.far) != entry.vertex) continue;
                if (sorted(of(other.far), of(other.next_far)) == mine) entry.twin = j;
            }
        }
    }

    TearTable::Rows& begin_rows(ConstraintKind kind) {
        const ConstraintTable& table = model_.table(kind);
        auto& rows = table_.rows[static_cast<std::uint32_t>(kind)];
        rows.stride = table.stride;
        rows.corners.assign(std::size_t{table.arity} * table.stride, none);
        return rows;
    }
    static std::array<std::uint32_t, 2> ends_of(const ConstraintTable& table, std::uint32_t row) {
        return {table.particles[row], table.particles[std::size_t{table.stride} + row]};
    }
    void make_stretch() {
        const ConstraintTable& table = model_.table(ConstraintKind::stretch);
        auto& rows = begin_rows(ConstraintKind::stretch);
        const std::uint32_t half = table_.half_stride = table.second_halves;
        table_.second.assign(std::size_t{2} * half, none);
        table_.first_part.assign(half, 1.0f);
        for (std::uint32_t row = 0; row < half; ++row) {
            if (!table.is_real(row)) continue;
            const auto ends = ends_of(table, row);
            const Edge& edge = *find_edge(ends[0], ends[1]);
            for (std::uint32_t slot = 0; slot < 2; ++slot) {
                rows.corners[std::size_t{slot} * rows.stride + row] = corner(edge.triangle0, ends[slot]);
                if (edge.triangle1 != none)
                    table_.second[std::size_t{slot} * half + row] = corner(edge.triangle1, ends[slot]);
            }
            if (edge.triangle1 == none) continue;
            const auto part = [&](std::uint32_t t) { return model_.face_area[t] * model_.weights->stretch.at(t); };
            const float first = part(edge.triangle0), second = part(edge.triangle1);
            table_.first_part[row] = first / (first + second);
        }
    }

    void make_springs() {
        if (!has_membranes(model_.fabric.stretch)) return;
        const auto springs = springs_of_membrane(rest_, model_.fabric.stretch);
        const auto& corners = table_.rows[static_cast<std::uint32_t>(ConstraintKind::stretch)].corners;
        const std::uint32_t half = table_.half_stride, stride = model_.table(ConstraintKind::stretch).stride;
        const auto of_edge = [&](std::uint32_t a, std::uint32_t b) -> StretchLaw::Compliances {
            if (a == none) return {-1, -1};
            return springs[a % model_.face_stride][3 - a / model_.face_stride - b / model_.face_stride];
        };
        table_.springs.resize(half);
        for (std::uint32_t row = 0; row < half; ++row) {
            if (corners[row] == none) continue;
            const auto first = of_edge(corners[row], corners[stride + row]);
            const auto second = of_edge(table_.second[row], table_.second[half + row]);
            table_.springs[row] = {first.stretched, first.compressed, second.stretched, second.compressed};
        }
    }
    void make_membranes() {
        const ConstraintTable& table = model_.table(ConstraintKind::membrane);
        auto& rows = begin_rows(ConstraintKind::membrane);
        rows.tie_begin.assign(std::size_t{table.stride} + 1, 0);
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            if (!table.is_real(row)) continue;
            const auto at = [&](std::uint32_t slot) { return table.particles[std::size_t{slot} * table.stride + row]; };
            const std::uint32_t t = triangle_with({at(0), at(1), at(2)});
            for (std::uint32_t slot = 0; slot < 3; ++slot)
                rows.corners[std::size_t{slot} * rows.stride + row] = corner(t, at(slot));
        }
    }

    void tie(TearTable::Rows& rows, std::uint32_t a, std::uint32_t b, std::uint32_t t0, std::uint32_t t1) const {
        for (const std::uint32_t end : {a, b}) rows.ties.push_back({corner(t0, end), corner(t1, end)});
    }
    // Constraints of hinges: the dihedral angle has the ends of the edge and both tips, the distance the tips alone.
    void make_hinged(ConstraintKind kind) {
        const ConstraintTable& table = model_.table(kind);
        auto& rows = begin_rows(kind);
        rows.tie_begin.push_back(0);
        std::multimap<EdgeEnds, const Hinge*> by_tips;
        if (table.rows > 0)
            for (const Hinge& hinge : topology_.hinges) by_tips.emplace(sorted(hinge.c, hinge.d), &hinge);
        const std::uint32_t tips = kind == ConstraintKind::distance_bend ? 0 : 2;
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            const auto at = [&](std::uint32_t slot) { return table.particles[std::size_t{slot} * table.stride + row]; };
            if (table.is_real(row)) {
                const std::uint32_t c = at(tips), d = at(tips + 1);
                auto begin = by_tips.equal_range(sorted(c, d)).first;
                while (tips > 0 && EdgeEnds{begin->second->a, begin->second->b} != sorted(at(0), at(1))) ++begin;
                const Hinge& hinge = *begin->second;
                if (tips == 0) by_tips.erase(begin);  // constraints with equal tips belong to different hinges
                const std::uint32_t with_c = hinge.c == c ? hinge.triangle0 : hinge.triangle1,
                                    with_d = hinge.c == c ? hinge.triangle1 : hinge.triangle0;
                rows.corners[std::size_t{tips} * rows.stride + row] = corner(with_c, c);
                rows.corners[std::size_t{tips + 1} * rows.stride + row] = corner(with_d, d);
                for (std::uint32_t slot = 0; slot < tips; ++slot)
                    rows.corners[std::size_t{slot} * rows.stride + row] = corner(with_c, at(slot));
                tie(rows, hinge.a, hinge.b, with_c, with_d);
            }
            rows.tie_begin.push_back(static_cast<std::uint32_t>(rows.ties.size()));
        }
    }
    // A plate has the three wings, then the three corners of its triangle. A wing that is a corner is unused.
    void make_plates() {
        const ConstraintTable& table = model_.table(ConstraintKind::plate);
        auto& rows = begin_rows(ConstraintKind::plate);
        rows.tie_begin.push_back(0);
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            const auto at = [&](std::uint32_t slot) { return table.particles[std::size_t{slot} * table.stride + row]; };
            if (table.is_real(row)) {
                const std::uint32_t t = triangle_of({at(3), at(4), at(5)});
                const auto put = [&](std::uint32_t slot, std::uint32_t c) {
                    rows.corners[std::size_t{slot} * rows.stride + row] = c;
                };
                for (std::uint32_t k = 0; k < 3; ++k) {
                    put(3 + k, corner(t, at(3 + k)));
                    const std::uint32_t wing = at(k), a = at(3 + (k + 1) % 3), b = at(3 + (k + 2) % 3);
                    if (wing == a || wing == b || wing == at(3 + k)) {
                        put(k, corner(t, wing));
                        continue;
                    }
                    const std::uint32_t across = other_triangle(*find_edge(a, b), t);
                    put(k, corner(across, wing));
                    tie(rows, a, b, t, across);
                }
            }
            rows.tie_begin.push_back(static_cast<std::uint32_t>(rows.ties.size()));
        }
    }
    std::uint32_t triangle_of(const std::array<std::uint32_t, 3>& corners) const {
        for (const std::uint32_t t : topology_.particle_triangles[corners[0]])
            if (topology_.triangles[t] == Triangle{corners[0], corners[1], corners[2]}) return t;
        return none;
    }

    // In any order.
    std::uint32_t triangle_with(std::array<std::uint32_t, 3> corners) const {
        std::ranges::sort(corners);
        for (const std::uint32_t t : topology_.particle_triangles[corners[0]]) {
            Triangle triangle = topology_.triangles[t];
            std::ranges::sort(triangle);
            if (std::ranges::equal(triangle, corners)) return t;
        }
        return none;
    }

    // Lists each constraint at every vertex on which its particles or its end depend.
    void list_rows() {
        std::vector<std::uint32_t> vertices;
        table_.rows_at = group_items<TearTable::RowRef>(topology_.particle_count, [&](auto put) {
            for (const ConstraintTable& table : model_.constraints) {
                const auto& rows = table_.rows[static_cast<std::uint32_t>(table.kind)];
                for (std::uint32_t row = 0; row < rows.stride; ++row) {
                    vertices.clear();
                    for (std::size_t at = row; at < rows.corners.size(); at += rows.stride)
                        if (rows.corners[at] != none) vertices.push_back(vertex_at(rows.corners[at]));
                    for (std::uint32_t i = 0; !rows.ties.empty() && i < rows.tie_begin[row + 1] - rows.tie_begin[row];
                         ++i)
                        vertices.push_back(vertex_at(rows.ties[rows.tie_begin[row] + i][0]));
                    std::ranges::sort(vertices);
                    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
                    for (const std::uint32_t v : vertices) put(v, TearTable::RowRef{table.kind, row});
                }
            }
        });
    }

    const ClothModel& model_;
    const RestShape& rest_;
    const Topology& topology_;
    TearTable table_;
};

}  // namespace

Result<std::shared_ptr<const TearTable>> make_tear_table(const ClothModel& model, const RestShape& rest) {
    if (rest.topology.report.non_manifold_edges > 0)
        return Error{"cloth '" + model.name + "'",
                     "cannot be cut or torn: " + std::to_string(rest.topology.report.non_manifold_edges) +
                         " edges of its mesh have three triangles or more"};
    return std::make_shared<const TearTable>(TearTableBuilder(model, rest).run());
}

}  // namespace weft
