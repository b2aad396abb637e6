#include "mesh/topology.h"

#include "mesh/edges.h"
#include "mesh/grouping.h"
#include "mesh/ordering.h"
#include "mesh/sound_triangles.h"
#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <utility>

namespace weft {
namespace {

// The sides of all triangles are numbered in 32 bits.
constexpr std::size_t max_triangles = none / 3;

std::string text_of(float value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string text_of(Vec3 v) {
    return '(' + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + ')';
}

/// The first problem of each kind.
Errors check(const TriangleMesh& mesh, const TopologyOptions& options) {
    Errors errors;
    if (!(options.weld_distance >= 0))
        errors.push_back({"weld_distance", "must be >= 0 m, got " + text_of(options.weld_distance)});

    const std::size_t vertex_count = mesh.positions.size();
    if (vertex_count >= none)
        errors.push_back(
            {"", "must have fewer than " + std::to_string(none) + " vertices, got " + std::to_string(vertex_count)});
    const auto stray = std::find_if(mesh.positions.begin(), mesh.positions.end(), [](Vec3 p) { return !finite(p); });
    if (stray != mesh.positions.end())
        errors.push_back({"vertex " + std::to_string(stray - mesh.positions.begin()),
                          "position must be finite, got " + text_of(*stray)});

    if (mesh.triangles.empty()) errors.push_back({"", "must have at least one triangle, got none"});
    if (mesh.triangles.size() > max_triangles)
        errors.push_back({"", "must have at most " + std::to_string(max_triangles) + " triangles, got " +
                                  std::to_string(mesh.triangles.size())});
    const auto reaches_out = [&](const Triangle& t) { return std::max({t[0], t[1], t[2]}) >= vertex_count; };
    const auto wild = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), reaches_out);
    if (wild != mesh.triangles.end()) {
        const Triangle& t = *wild;
        errors.push_back({"triangle " + std::to_string(wild - mesh.triangles.begin()),
                          "indices must be < " + std::to_string(vertex_count) + ", the number of vertices, got " +
                              std::to_string(*std::find_if(t.begin(), t.end(),
                                                           [&](std::uint32_t i) { return i >= vertex_count; }))});
    }
    return errors;
}

std::vector<Triangle> mapped(std::span<const Triangle> triangles, std::span<const std::uint32_t> map) {
    std::vector<Triangle> result;
    result.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles) result.push_back({map[a], map[b], map[c]});
    return result;
}

/// Welded vertex -> particle, in welded order, for vertices that a triangle uses; `none` for the others.
std::vector<std::uint32_t> number_used(std::span<const Triangle> triangles, std::size_t welded_count,
                                       std::uint32_t& particle_count) {
    std::vector<std::uint32_t> number(welded_count, none);
    for (const Triangle& t : triangles)
        for (const std::uint32_t corner : t) number[corner] = 0;
    particle_count = 0;
    for (std::uint32_t& n : number)
        if (n != none) n = particle_count++;
    return number;
}

/// The elements at each particle, ascending; `ends(element)` returns the particles of an element.
template <class Row, class Ends>
Adjacency adjacency_of(std::span<const Row> rows, std::uint32_t particle_count, Ends ends) {
    auto groups = group_items<std::uint32_t>(particle_count, [&](auto put) {
        for (std::uint32_t i = 0; i < rows.size(); ++i)
            for (const std::uint32_t particle : ends(rows[i])) put(particle, i);
    });
    return {std::move(groups.offsets), std::move(groups.items)};
}

/// Finds edges, and then the hinges of the edges it found last.
class EdgeFinder {
  public:
    explicit EdgeFinder(const FindEdges& other) : other_(other) {}

    Result<EdgeList> edges(const Topology& topology) {
        if (!other_) return build_edges(topology.triangles, topology.particle_count);
        auto found = other_(topology.triangles, topology.particle_count);
        if (!found) return found.errors();
        hinges_ = std::move(found->hinges);
        return std::move(found->edges);
    }
    HingeList hinges(const EdgeList& edges, const Topology& topology) {
        return other_ ? std::move(hinges_) : build_hinges(edges, topology.triangles);
    }

  private:
    const FindEdges& other_;
    HingeList hinges_;  // from `other_`, which finds edges and hinges together
};

/// Fills everything that follows from the triangles, the edges and the hinges.
void derive(Topology& topology, EdgeList edges, HingeList hinges) {
    topology.report.non_manifold_edges = static_cast<std::uint32_t>(edges.non_manifold.size());
    topology.report.inconsistent_edges = hinges.inconsistent;
    topology.edges = std::move(edges.edges);
    topology.hinges = std::move(hinges.hinges);

    topology.particle_edges =
        adjacency_of(std::span<const Edge>(topology.edges), topology.particle_count, [](const Edge& e) {
            return std::array{e.a, e.b};
        });
    topology.particle_triangles = adjacency_of(std::span<const Triangle>(topology.triangles), topology.particle_count,
                                               [](const Triangle& t) { return t; });
    topology.boundary.assign(topology.particle_count, 0);
    for (const Edge& e : topology.edges)
        if (e.triangle1 == none) topology.boundary[e.a] = topology.boundary[e.b] = 1;
}

/// Fills the rest positions, the map from vertices to particles, and the counts of welded and isolated vertices.
void place_vertices(Topology& topology, const TriangleMesh& mesh, const Weld& weld) {
    topology.rest_positions.resize(topology.particle_count);
    for (std::size_t welded = 0; welded < topology.welded_to_particle.size(); ++welded)
        if (const std::uint32_t particle = topology.welded_to_particle[welded]; particle != none)
            topology.rest_positions[particle] = mesh.positions[weld.first_vertex[welded]];

    topology.vertex_to_particle.reserve(weld.vertex_to_welded.size());
    for (const std::uint32_t welded : weld.vertex_to_welded)
        topology.vertex_to_particle.push_back(topology.welded_to_particle[welded]);
    topology.report.welded_vertices =
        static_cast<std::uint32_t>(weld.vertex_to_welded.size() - weld.first_vertex.size());
    topology.report.isolated_vertices = static_cast<std::uint32_t>(
        std::count(topology.vertex_to_particle.begin(), topology.vertex_to_particle.end(), none));
}

}  // namespace

Result<Topology> build_topology(const TriangleMesh& mesh, const TopologyOptions& options) {
    return build_topology(mesh, options, FindEdges{});
}

Result<Topology> build_topology(const TriangleMesh& mesh, const TopologyOptions& options, const FindEdges& find) {
    if (Errors errors = check(mesh, options); !errors.empty()) return errors;

    const Weld weld = weld_vertices(mesh.positions, options.weld_distance);
    std::vector<Vec3> welded_positions;
    welded_positions.reserve(weld.first_vertex.size());
    for (const std::uint32_t vertex : weld.first_vertex) welded_positions.push_back(mesh.positions[vertex]);
    SoundTriangles sound = sound_triangles(mapped(mesh.triangles, weld.vertex_to_welded), welded_positions);
    if (sound.triangles.empty())
        return Error{"", "must have at least one triangle with an area, got " + std::to_string(mesh.triangles.size()) +
                             " without"};

    Topology topology;
    topology.report.degenerate_triangles = sound.degenerate;
    topology.report.duplicate_triangles = sound.duplicate;
    topology.source_triangle = std::move(sound.source_triangle);
    topology.welded_to_particle = number_used(sound.triangles, weld.first_vertex.size(), topology.particle_count);
    topology.triangles = mapped(sound.triangles, topology.welded_to_particle);

    EdgeFinder finder(find);
    auto edges = finder.edges(topology);
    if (edges && options.reorder) {
        if (const auto order = better_order(edges->edges, topology.particle_count); !order.empty()) {
            for (std::uint32_t& particle : topology.welded_to_particle)
                if (particle != none) particle = order[particle];
            topology.triangles = mapped(topology.triangles, order);
            edges = finder.edges(topology);
        }
    }
    if (!edges) return edges.errors();
    place_vertices(topology, mesh, weld);
    HingeList hinges = finder.hinges(*edges, topology);
    derive(topology, std::move(*edges), std::move(hinges));
    return topology;
}

}  // namespace weft
