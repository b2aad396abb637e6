// Finds the first triangle that a ray meets, on meshes that deform.
#pragma once

#include "editor/tools/mesh_view.h"
#include "editor/tools/projection.h"

#include <weft/bounds.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace weft::editor {

struct SurfaceHit {
    float distance = 0;          ///< m, from the ray's origin
    Vec3 point;                  ///< m
    std::uint32_t triangle = 0;  ///< number in the mesh
    Triangle corners{};          ///< its vertices
    Vec3 weights;                ///< barycentric: ≥ 0, their sum is 1
    bool front = false;          ///< the ray meets its front side: the corners are counterclockwise as seen
};

/// Boxes around groups of four triangles, boxes around eight of those, and so on. Triangles are ordered along a curve
/// that fills space (Morton), so building takes linear time and no triangle makes it slower. Has its own copy of the
/// mesh. Triangles with corners out of range or not finite are never met.
class TriangleTree {
  public:
    TriangleTree() = default;
    explicit TriangleTree(const MeshView& mesh) { build(mesh); }

    void build(const MeshView& mesh);
    /// Takes other positions of the same triangles. Hits are then the same as after build(), but slower to find if the
    /// mesh has changed its shape much.
    void refit(const MeshView& mesh);

    std::uint32_t triangles() const { return static_cast<std::uint32_t>(order_.size()); }
    std::uint32_t vertices() const { return static_cast<std::uint32_t>(positions_.size()); }
    /// Total area of the smallest boxes, relative to that after build(): how much slower hits are to find.
    double looseness() const { return built_area_ > 0 ? area_ / built_area_ : 1; }
    Bounds bounds() const;

    /// The first triangle that the ray meets from either side, at a distance of at least `from` and at most `to`. Of
    /// several at the same distance, the one with the lowest number. No ray passes between triangles with a common
    /// edge.
    std::optional<SurfaceHit> nearest(const Ray& ray, float from = 0,
                                      float to = std::numeric_limits<float>::infinity()) const;
    /// Whether nearest() would find something.
    bool blocks(const Ray& ray, float from, float to) const;

    Vec3 position(std::uint32_t vertex) const { return positions_[vertex]; }

  private:
    static constexpr std::uint32_t width = 8;      // boxes of a group
    static constexpr std::uint32_t leaf_size = 4;  // triangles

    // Eight boxes: min x, y, z, then max x, y, z.
    struct Group {
        std::array<std::array<float, width>, 6> side;
    };
    template <class Visit>
    void visit_leaves(const Ray& ray, float from, double to, Visit&& visit) const;
    void take_positions(const MeshView& mesh);
    void take_boxes();

    std::vector<Vec3> positions_;
    std::vector<std::uint32_t> order_;        // numbers of the triangles, leaf by leaf
    std::vector<Triangle> corners_;           // in that order; {0, 0, 0} if out of range
    std::vector<std::vector<Group>> levels_;  // [0]: boxes of leaves; each group of a level is a box of the next one
    double area_ = 0, built_area_ = 0;        // m²
};

/// The tree of a surface that somebody else moves. Work is done only when somebody asks.
class SurfaceTree {
  public:
    /// `version`: changes with the triangles. `frame`: changes with the positions. Builds the tree for a new version
    /// and refits it for a new frame; builds it again once it is twice as loose as a new one.
    const TriangleTree& of(const MeshView& mesh, std::uint64_t version, std::uint64_t frame);

  private:
    TriangleTree tree_;
    std::uint64_t version_ = 0, frame_ = 0;
    bool built_ = false;
};

}  // namespace weft::editor
