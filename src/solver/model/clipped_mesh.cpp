#include "solver/model/clipped_mesh.h"

#include "base/wide_vector.h"
#include "collide/closest_point.h"
#include "mesh/polygon.h"
#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace weft {
namespace {

using Place = WideVec3;

Place unit(const Place& a) {
    const double l = length(a);
    return l > 0 ? a * (1 / l) : Place{};
}

/// The plane through an edge of the simulated mesh.
struct EdgePlane {
    Place origin, normal;
    std::array<std::uint32_t, 2> triangles = {none, none};
    std::array<double, 2> inside = {0, 0};  ///< sign of the distance on the side of each triangle
    bool separates = false;
    double near = 0;  ///< m: points that are so near count as points of the plane

    double distance(const Place& p) const { return dot(normal, p - origin); }
};

/// The planes of all edges, and the edges of all triangles.
class EdgePlanes {
  public:
    explicit EdgePlanes(const Topology& topology)
        : topology_(topology), edges_of_(topology.triangles.size(), {none, none, none}) {
        planes_.reserve(topology.edges.size());
        std::vector<std::uint32_t> count(topology.triangles.size());
        for (const Edge& edge : topology.edges) {
            const auto number = static_cast<std::uint32_t>(planes_.size());
            for (const std::uint32_t t : {edge.triangle0, edge.triangle1})
                if (t != none && count[t] < 3) edges_of_[t][count[t]++] = number;
            planes_.push_back(plane_of(edge));
        }
    }
    /// `none` for an edge of more than two triangles.
    const std::array<std::uint32_t, 3>& edges_of(std::uint32_t triangle) const { return edges_of_[triangle]; }
    const EdgePlane& operator[](std::uint32_t edge) const { return planes_[edge]; }

  private:
    Place corner(std::uint32_t particle) const { return wide(topology_.rest_positions[particle]); }
    Place normal_of(std::uint32_t t) const {
        const auto& [a, b, c] = topology_.triangles[t];
        return unit(cross(corner(b) - corner(a), corner(c) - corner(a)));
    }
    static bool winds(const Triangle& t, std::uint32_t a, std::uint32_t b) {
        return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
    }
    double height_of(std::uint32_t t) const {
        const auto& [a, b, c] = topology_.triangles[t];
        const Place ab = corner(b) - corner(a), ac = corner(c) - corner(a);
        const double longest = std::max({length(ab), length(ac), length(ac - ab)});
        return longest > 0 ? length(cross(ab, ac)) / longest : 0;
    }
    EdgePlane plane_of(const Edge& edge) const {
        constexpr double sharp_fold = -0.9;  // cosine between the normals
        EdgePlane plane;
        plane.triangles = {edge.triangle0, edge.triangle1};
        if (edge.triangle1 == none) return plane;
        const Place a = corner(edge.a), along = unit(corner(edge.b) - a);
        const bool alike = winds(topology_.triangles[edge.triangle0], edge.a, edge.b) ==
                           winds(topology_.triangles[edge.triangle1], edge.a, edge.b);
        const Place n0 = normal_of(edge.triangle0), n1 = normal_of(edge.triangle1) * (alike ? -1.0 : 1.0);
        if (dot(n0, n1) < sharp_fold) return plane;
        plane.origin = a;
        plane.normal = unit(cross(n0 + n1, along));
        for (std::size_t side = 0; side < 2; ++side) {
            const Triangle& t = topology_.triangles[plane.triangles[side]];
            const std::uint32_t opposite = t[0] + t[1] + t[2] - edge.a - edge.b;
            plane.inside[side] = plane.distance(corner(opposite)) < 0 ? -1 : 1;
        }
        plane.separates = plane.inside[0] != plane.inside[1];
        const double reach = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
        plane.near = std::max(1e-4 * std::min(height_of(edge.triangle0), height_of(edge.triangle1)), 2e-7 * reach);
        return plane;
    }

    const Topology& topology_;
    std::vector<std::array<std::uint32_t, 3>> edges_of_;
    std::vector<EdgePlane> planes_;
};

/// A corner of a polygon, and the side from it to the next one: on a side of the drawn triangle (0…2), or on the plane
/// of a simulated edge (3 and more).
struct PolygonCorner {
    std::uint32_t vertex = none;
    std::uint32_t side = 0;
};
using Polygon = std::vector<PolygonCorner>;
constexpr std::uint32_t first_plane = 3;

/// The vertices of the clipped mesh, and where they lie on edges of the drawn mesh.
class Vertices {
  public:
    explicit Vertices(const TriangleMesh& drawn)
        : weld_(weld_vertices(drawn.positions, 0)), places_(drawn.positions.size()) {
        mesh_ = drawn;
        mesh_.triangles.clear();
        for (std::size_t v = 0; v < places_.size(); ++v) places_[v] = wide(drawn.positions[v]);
    }
    const Place& place(std::uint32_t vertex) const { return places_[vertex]; }
    bool is_point(std::uint32_t a, std::uint32_t b) const {
        return weld_.vertex_to_welded[a] == weld_.vertex_to_welded[b];
    }

    /// The vertex where the drawn edge from `a` to `b` meets the plane. The same for both triangles at the edge, and at
    /// the same place on both sides of a seam.
    std::uint32_t on_edge(std::uint32_t a, std::uint32_t b, const EdgePlane& plane) {
        Edge& edge = edge_at(a, b);
        std::vector<double>& points = points_[edge.line];
        const Place from = places_[edge.from], to = places_[edge.to];
        const double d = plane.distance(from);
        const double t = std::clamp(d / (d - plane.distance(to)), 0.0, 1.0), near = plane.near / length(to - from);
        for (std::uint32_t i = 0; i < points.size(); ++i)
            if (std::abs(points[i] - t) <= near) return vertex_of(edge, i);
        points.push_back(t);
        return vertex_of(edge, static_cast<std::uint32_t>(points.size() - 1));
    }
    /// A vertex inside a drawn triangle.
    std::uint32_t inside(const Triangle& corners, const Place& place) {
        const Place a = places_[corners[0]], u = places_[corners[1]] - a, v = places_[corners[2]] - a, w = place - a;
        const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
        const double s = det > 0 ? (dot(w, u) * vv - dot(w, v) * uv) / det : 0;
        const double t = det > 0 ? (dot(w, v) * uu - dot(w, u) * uv) / det : 0;
        return append(place, corners, {1 - s - t, s, t});
    }
    /// All vertices on the drawn edge from `a` to `b`, in this direction.
    std::vector<std::uint32_t> along_edge(std::uint32_t a, std::uint32_t b) {
        Edge& edge = edge_at(a, b);
        const std::vector<double>& points = points_[edge.line];
        std::vector<std::uint32_t> order(points.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        const double forward = edge.from == a ? 1 : -1;
        std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(forward * points[i], i); });
        std::vector<std::uint32_t> vertices{a};
        for (const std::uint32_t i : order) vertices.push_back(vertex_of(edge, i));
        vertices.push_back(b);
        return vertices;
    }
    TriangleMesh take() && { return std::move(mesh_); }

  private:
    struct Edge {
        std::uint32_t from, to;  ///< vertices, the end with the lower welded number first
        std::uint32_t line;      ///< the edge between the welded ends
        std::vector<std::uint32_t> vertices;
    };
    static std::uint64_t both(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32) | b; }

    Edge& edge_at(std::uint32_t a, std::uint32_t b) {
        if (weld_.vertex_to_welded[a] > weld_.vertex_to_welded[b]) std::swap(a, b);
        const auto [found, is_new] = edge_numbers_.try_emplace(both(a, b), edges_.size());
        if (is_new) {
            const auto line = line_numbers_.try_emplace(both(weld_.vertex_to_welded[a], weld_.vertex_to_welded[b]),
                                                        static_cast<std::uint32_t>(points_.size()));
            if (line.second) points_.emplace_back();
            edges_.push_back({a, b, line.first->second, {}});
        }
        return edges_[found->second];
    }
    std::uint32_t vertex_of(Edge& edge, std::uint32_t point) {
        if (edge.vertices.size() <= point) edge.vertices.resize(point + std::size_t{1}, none);
        if (edge.vertices[point] == none) {
            const double t = points_[edge.line][point];
            const Place place = places_[edge.from] * (1 - t) + places_[edge.to] * t;
            edge.vertices[point] = append(place, {edge.from, edge.to, edge.to}, {1 - t, t, 0});
        }
        return edge.vertices[point];
    }
    std::uint32_t append(const Place& place, const Triangle& of, const std::array<double, 3>& weights) {
        const auto mean = [&](auto component) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) sum += weights[k] * static_cast<double>(component(of[k]));
            return static_cast<float>(sum);
        };
        places_.push_back(place);
        mesh_.positions.push_back(narrow(place));
        if (auto& uvs = mesh_.uvs; !uvs.empty())
            uvs.push_back({mean([&](auto v) { return uvs[v].x; }), mean([&](auto v) { return uvs[v].y; })});
        if (auto& n = mesh_.normals; !n.empty())
            n.push_back(normalized({mean([&](auto v) { return n[v].x; }), mean([&](auto v) { return n[v].y; }),
                                    mean([&](auto v) { return n[v].z; })}));
        if (auto& c = mesh_.colors; !c.empty())
            c.push_back({mean([&](auto v) { return c[v].x; }), mean([&](auto v) { return c[v].y; }),
                         mean([&](auto v) { return c[v].z; }), mean([&](auto v) { return c[v].w; })});
        return static_cast<std::uint32_t>(places_.size() - 1);
    }

    Weld weld_;
    TriangleMesh mesh_;
    std::vector<Place> places_;
    std::vector<Edge> edges_;
    std::unordered_map<std::uint64_t, std::size_t> edge_numbers_;
    std::unordered_map<std::uint64_t, std::uint32_t> line_numbers_;
    std::vector<std::vector<double>> points_;  ///< per line: places of its vertices, 0…1
};

/// Cuts one drawn triangle after another.
class Clipper {
  public:
    Clipper(const TriangleMesh& drawn, const Topology& topology)
        : drawn_(drawn),
          topology_(topology),
          planes_(topology),
          search_(topology.rest_positions, topology.triangles),
          vertices_(drawn) {}

    ClippedMesh run() && {
        for (std::uint32_t t = 0; t < drawn_.triangles.size(); ++t) clip(t);
        ClippedMesh result;
        std::vector<Triangle> triangles;
        for (const Piece& piece : pieces_) {
            triangulate(piece, triangles);
            result.triangle_of.resize(triangles.size(), piece.triangle);
        }
        result.mesh = std::move(vertices_).take();
        result.mesh.triangles = std::move(triangles);
        result.left_whole = left_whole_;
        return result;
    }

  private:
    struct Piece {
        std::uint32_t drawn, triangle;
        Polygon polygon;
    };
    /// A polygon on its way: the simulated triangle that it has come to, and the one before.
    struct Stop {
        std::uint32_t triangle, before;
        Polygon polygon;
    };

    void clip(std::uint32_t drawn) {
        corners_ = drawn_.triangles[drawn];
        const auto& [a, b, c] = corners_;
        lines_.clear();
        stops_.clear();
        const std::size_t first = pieces_.size();
        if (vertices_.is_point(a, b) || vertices_.is_point(b, c) || vertices_.is_point(c, a)) {
            pieces_.push_back({drawn, closest({{a, 0}, {b, 1}, {c, 2}}), {{a, 0}, {b, 1}, {c, 2}}});
            return;
        }
        stops_.push_back({closest({{a, 0}, {b, 1}, {c, 2}}), none, {{a, 0}, {b, 1}, {c, 2}}});
        for (std::uint32_t i = 0; i < stops_.size(); ++i) stop_at(i, drawn);
        for (std::size_t i = first; i < pieces_.size(); ++i) join_lines(pieces_[i].polygon);
    }
    std::uint32_t closest(const Polygon& polygon) const {
        Place sum;
        for (const PolygonCorner& corner : polygon) sum = sum + vertices_.place(corner.vertex);
        return search_.closest(narrow(sum * (1.0 / static_cast<double>(polygon.size())))).triangle;
    }
    bool was_at(std::uint32_t stop, std::uint32_t triangle) const {
        for (std::uint32_t i = stop; i != none; i = stops_[i].before)
            if (stops_[i].triangle == triangle) return true;
        return false;
    }
    // Keeps what lies inside the triangle and sends the rest to its neighbors.
    void stop_at(std::uint32_t stop, std::uint32_t drawn) {
        const std::size_t most = 64 + 4 * topology_.triangles.size();  // only malformed meshes have so many
        const std::uint32_t here = stops_[stop].triangle;
        Polygon rest = std::move(stops_[stop].polygon);
        for (const std::uint32_t edge : planes_.edges_of(here)) {
            if (edge == none || rest.empty()) continue;
            const EdgePlane& plane = planes_[edge];
            if (!plane.separates) continue;
            const std::size_t side = plane.triangles[0] == here ? 0 : 1;
            Polygon inside, outside;
            split(rest, edge, plane.inside[side], inside, outside);
            if (outside.empty()) continue;
            std::uint32_t next = plane.triangles[1 - side];
            if (was_at(stop, next)) next = closest(outside);
            if (was_at(stop, next) || stops_.size() > most) {
                pieces_.push_back({drawn, here, std::move(outside)});
                ++left_whole_;
            } else {
                stops_.push_back({next, stop, std::move(outside)});
            }
            rest = std::move(inside);
        }
        if (!rest.empty()) pieces_.push_back({drawn, here, std::move(rest)});
    }

    void split(const Polygon& polygon, std::uint32_t edge, double sign, Polygon& inside, Polygon& outside) {
        const EdgePlane& plane = planes_[edge];
        std::vector<double> distance(polygon.size());
        std::vector<int> where(polygon.size());
        bool any_inside = false, any_outside = false;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            distance[i] = sign * plane.distance(vertices_.place(polygon[i].vertex));
            where[i] = distance[i] > plane.near ? 1 : distance[i] < -plane.near ? -1 : 0;
            any_inside = any_inside || where[i] > 0;
            any_outside = any_outside || where[i] < 0;
        }
        if (!any_outside || !any_inside) {
            (any_outside ? outside : inside) = polygon;
            return;
        }
        const std::uint32_t cut = edge + first_plane;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const std::size_t next = (i + 1) % polygon.size();
            const PolygonCorner corner = polygon[i];
            if (where[i] >= 0) inside.push_back({corner.vertex, where[i] == 0 && where[next] < 0 ? cut : corner.side});
            if (where[i] <= 0) outside.push_back({corner.vertex, where[i] == 0 && where[next] > 0 ? cut : corner.side});
            if (where[i] == 0) note_on_line(cut, corner.vertex);
            if (where[i] * where[next] >= 0) continue;
            const double s = distance[i] / (distance[i] - distance[next]);
            const std::uint32_t met = meet(corner, polygon[next].vertex, s, edge);
            inside.push_back({met, where[i] > 0 ? cut : corner.side});
            outside.push_back({met, where[i] < 0 ? cut : corner.side});
        }
        if (inside.size() < 3) inside.clear();
        if (outside.size() < 3) outside.clear();
    }
    // The vertex where a side of a polygon meets the plane of an edge.
    std::uint32_t meet(const PolygonCorner& from, std::uint32_t to, double s, std::uint32_t edge) {
        const std::uint32_t cut = edge + first_plane;
        if (from.side < first_plane) {
            const std::uint32_t vertex =
                vertices_.on_edge(corners_[from.side], corners_[(from.side + 1) % 3], planes_[edge]);
            note_on_line(cut, vertex);
            return vertex;
        }
        const Place place = vertices_.place(from.vertex) * (1 - s) + vertices_.place(to) * s;
        for (const std::uint32_t line : {from.side, cut})
            for (const std::uint32_t vertex : lines_[line])
                if (length(vertices_.place(vertex) - place) <= planes_[edge].near) {
                    note_on_line(from.side, vertex);
                    note_on_line(cut, vertex);
                    return vertex;
                }
        const std::uint32_t vertex = vertices_.inside(corners_, place);
        note_on_line(from.side, vertex);
        note_on_line(cut, vertex);
        return vertex;
    }
    void note_on_line(std::uint32_t line, std::uint32_t vertex) {
        auto& on = lines_[line];
        if (std::ranges::find(on, vertex) == on.end()) on.push_back(vertex);
    }

    // Gives sides between pieces all vertices that other pieces have on them.
    void join_lines(Polygon& polygon) const {
        Polygon joined;
        std::vector<std::pair<double, std::uint32_t>> between;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const PolygonCorner corner = polygon[i];
            joined.push_back(corner);
            if (corner.side < first_plane) continue;
            const std::uint32_t next = polygon[(i + 1) % polygon.size()].vertex;
            const Place from = vertices_.place(corner.vertex), way = vertices_.place(next) - from;
            between.clear();
            const auto line = lines_.find(corner.side);
            if (line == lines_.end()) continue;
            for (const std::uint32_t vertex : line->second) {
                const double at = dot(vertices_.place(vertex) - from, way);
                const bool is_corner = std::ranges::find(polygon, vertex, &PolygonCorner::vertex) != polygon.end();
                if (at > 0 && at < dot(way, way) && !is_corner) between.push_back({at, vertex});
            }
            std::ranges::sort(between);
            for (const auto& [at, vertex] : between) joined.push_back({vertex, corner.side});
        }
        polygon = std::move(joined);
    }
    // Likewise for sides on edges of the drawn mesh.
    std::vector<std::uint32_t> join_edges(const Piece& piece) {
        const Triangle& corners = drawn_.triangles[piece.drawn];
        std::vector<std::uint32_t> polygon;
        for (std::size_t i = 0; i < piece.polygon.size(); ++i) {
            const auto& [vertex, side] = piece.polygon[i];
            polygon.push_back(vertex);
            if (side >= first_plane || vertices_.is_point(corners[side], corners[(side + 1) % 3])) continue;
            const auto all = vertices_.along_edge(corners[side], corners[(side + 1) % 3]);
            const auto from = std::ranges::find(all, vertex);
            const auto to = std::ranges::find(all, piece.polygon[(i + 1) % piece.polygon.size()].vertex);
            if (from < to && to != all.end()) polygon.insert(polygon.end(), from + 1, to);
        }
        return polygon;
    }
    void triangulate(const Piece& piece, std::vector<Triangle>& triangles) {
        const std::vector<std::uint32_t> polygon = join_edges(piece);
        const Triangle& corners = drawn_.triangles[piece.drawn];
        const Place origin = vertices_.place(corners[0]), side = vertices_.place(corners[1]) - origin;
        const Place normal = cross(side, vertices_.place(corners[2]) - origin);
        const Place x = unit(side), y = unit(cross(normal, side));
        std::vector<std::array<double, 2>> flat;
        for (const std::uint32_t vertex : polygon) {
            const Place p = vertices_.place(vertex) - origin;
            flat.push_back({dot(p, x), dot(p, y)});
        }
        for (const auto& [a, b, c] : triangulate_polygon(flat)) {
            const Triangle made{polygon[a], polygon[b], polygon[c]};
            if (made[0] != made[1] && made[1] != made[2] && made[2] != made[0]) triangles.push_back(made);
        }
    }

    const TriangleMesh& drawn_;
    const Topology& topology_;
    EdgePlanes planes_;
    SurfaceSearch search_;
    Vertices vertices_;
    std::vector<Piece> pieces_;
    std::uint32_t left_whole_ = 0;
    // Of the drawn triangle that is being clipped:
    Triangle corners_{};
    std::vector<Stop> stops_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> lines_;  ///< vertices on the planes of edges
};

}  // namespace

ClippedMesh clip_to_triangles(const TriangleMesh& drawn, const Topology& topology) {
    return Clipper(drawn, topology).run();
}

}  // namespace weft
