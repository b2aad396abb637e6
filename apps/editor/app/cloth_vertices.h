// Vertices of a cloth as pins number them, and its particles.
#pragma once

#include "editor/app/picture.h"
#include "editor/tools/vertex_sets.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

/// The cloth as it was built. Cuts and tears make copies of particles, which count as their originals.
struct ClothVertices {
    std::shared_ptr<const ParticleNumbers> numbers;
    std::vector<std::uint32_t> vertex_of;  ///< per particle; `none`: it has no vertex
    std::vector<Vec3> rest;                ///< m, per particle: at the start, in axes of the cloth
    std::vector<Triangle> triangles;       ///< of particles

    std::uint32_t particles() const { return static_cast<std::uint32_t>(rest.size()); }
    MeshView mesh() const { return {rest, triangles}; }
    VertexSet to_vertices(const VertexSet& particles) const;
    /// Vertices without a particle are left out.
    VertexSet to_particles(const VertexSet& vertices) const;
};

ClothVertices vertices_of(const Picture& picture, std::size_t cloth);
/// The particle of a frame that this one is a copy of, or itself; `none`: the particle does not exist.
std::uint32_t original_of(const ClothFrame& frame, const ParticleNumbers& numbers, std::uint32_t particle);
/// The place of a cloth in the picture.
std::optional<std::size_t> cloth_called(const Picture& picture, const std::string& name);

}  // namespace weft::editor
