// Meshes that keep their vertices and triangles for a whole animation, although cloth parts in it.
#pragma once

#include "io/exports/exporter.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// Follows the topology of one cloth from frame to frame. In the first frame, the constant mesh is the cloth's surface.
///
/// Each vertex has a source: the vertex of the surface that it shows. When the corners of triangles at a vertex get
/// different sources, the corners that leave get a new vertex. Its parent is the vertex that they left: in all earlier
/// frames both coincide. When a triangle is removed, its corners get new vertices too, which coincide from then on.
/// So vertices are only appended, and the last triangles are right in all frames.
///
/// Triangles are matched by their number. No data on copied particles is needed.
class ConstantMesh {
  public:
    explicit ConstantMesh(const ExportSurface& first);

    /// Follows to the next frame. Returns an empty text, or why the surface is not the same cloth, changed by parting
    /// and by removed triangles: "has …". Then the mesh can only be destroyed.
    std::string follow(const ExportSurface& surface);
    /// The frame that was followed last, with the vertices and triangles of this mesh. Valid until the next call.
    ExportSurface show(const ExportSurface& surface);

    const std::string& name() const { return name_; }
    std::size_t first_count() const { return first_count_; }  ///< vertices in the first frame
    std::size_t vertex_count() const { return source_.size(); }
    std::span<const Triangle> triangles() const { return triangles_; }
    std::span<const Vec2> uvs() const { return uvs_; }
    std::span<const Vec4> colors() const { return colors_; }
    /// Less than `vertex`, which is at least first_count().
    std::uint32_t parent(std::size_t vertex) const { return parent_[vertex - first_count_]; }

    /// Appends the values of the vertices that an earlier frame did not have yet.
    template <class Value>
    void widen(std::vector<Value>& values) const {
        values.reserve(vertex_count());
        for (std::size_t v = values.size(); v < vertex_count(); ++v) values.push_back(values[parent(v)]);
    }

  private:
    struct MovedCorner {
        std::uint32_t vertex, source, triangle, corner;
    };
    std::string find_moved(const ExportSurface& surface, std::vector<MovedCorner>& moved) const;
    bool is_same_place(std::uint32_t vertex, const ExportSurface& surface, std::uint32_t source) const;
    void part(std::vector<MovedCorner>& moved);
    void append_vertex(std::span<const MovedCorner> corners);

    std::string name_;
    std::size_t first_count_, surface_count_;
    std::uint64_t topology_version_;
    std::vector<Triangle> triangles_;
    std::vector<Vec2> uvs_;
    std::vector<Vec4> colors_;
    std::vector<Vec3> rest_positions_;
    std::vector<std::uint32_t> source_, corner_count_;  // by vertex
    std::vector<std::uint32_t> parent_;                 // of the appended vertices
    std::vector<Vec3> positions_, normals_;             // of show()
    bool same_as_surface_ = true;
};

/// All cloths of an animation.
class ConstantMeshes {
  public:
    /// Follows to the next frame. Returns an empty text, or a sentence that says why no mesh can show it together with
    /// the frames before. Then the meshes can only be destroyed.
    std::string follow(const ExportFrame& frame);

    /// The surfaces of the frame that was followed last, with constant vertices and triangles. Spans refer to the
    /// frame, or to these meshes.
    std::span<const ExportSurface> surfaces() const { return surfaces_; }
    bool empty() const { return meshes_.empty(); }
    std::size_t size() const { return meshes_.size(); }
    const ConstantMesh& operator[](std::size_t cloth) const { return meshes_[cloth]; }
    /// Whether vertices were appended, so that earlier frames lack some.
    bool have_grown() const;

  private:
    std::vector<ConstantMesh> meshes_;
    std::vector<ExportSurface> surfaces_;
};

/// Whether a triangle has three different corners.
inline bool is_face(const Triangle& t) {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

}  // namespace weft
