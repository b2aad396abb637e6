#include "solver/measures/true_surfaces.h"

#include "base/workers.h"

namespace weft {

namespace {

// Of the field of a mesh: word 3 of block 1 (mesh.kernel.h).
double cell_of(const ShapeData& data) {
    return data.words.size() >= 8 && data.words[7] > 0 ? double{data.words[7]} : 1;
}

}  // namespace

// In cells of the distance field, from the center of the mesh: the unit that SignedDistanceWalk expects.
struct TrueSurfaces::Probe::OfMesh {
    std::shared_ptr<const ShapeData> data;  // so that no other shape gets its address
    Vec3 center;
    double cell;
    SolidSurface surface;
    SignedDistanceWalk walk;  // from probe to probe: the triangle that was nearest last is likely to be near

    OfMesh(std::shared_ptr<const ShapeData> shape, std::vector<Vec3> positions, OrientedTriangles oriented,
           WorkerTeam& team)
        : data(std::move(shape)),
          center(data->bounds.center()),
          cell(cell_of(*data)),
          surface(std::move(positions), std::move(oriented), team),
          walk(surface, 0) {}

    Vec3 to_cells(Vec3 p) const { return cells_from(p, center, cell); }

    static Vec3 cells_from(Vec3 p, Vec3 center, double cell) {
        const auto along = [&](float x, float from) { return static_cast<float>((double{x} - double{from}) / cell); };
        return {along(p.x, center.x), along(p.y, center.y), along(p.z, center.z)};
    }
};

TrueSurfaces::TrueSurfaces() = default;
TrueSurfaces::TrueSurfaces(TrueSurfaces&&) noexcept = default;
TrueSurfaces& TrueSurfaces::operator=(TrueSurfaces&&) noexcept = default;
TrueSurfaces::~TrueSurfaces() = default;

TrueSurfaces::Probe::OfMesh& TrueSurfaces::of_mesh(const std::shared_ptr<const ShapeData>& data) {
    auto& known = meshes_[data.get()];
    if (!known) {
        std::vector<Vec3> positions = data->surface.positions;
        for (Vec3& p : positions) p = Probe::OfMesh::cells_from(p, data->bounds.center(), cell_of(*data));
        OrientedTriangles oriented = orient_triangles(positions, data->surface.triangles);
        WorkerTeam team;
        known = std::make_unique<Probe::OfMesh>(data, std::move(positions), std::move(oriented), team);
    }
    return *known;
}

TrueSurfaces::Probe TrueSurfaces::probe(const Collider& collider, Vec3 center, double radius) {
    Probe probe(collider);
    if (!is_convex(collider) && collider.data) {
        probe.mesh_ = &of_mesh(collider.data);
        const Vec3 local = probe.mesh_->to_cells(to_local(collider.pose, center));
        // A little more, because the points are rounded.
        probe.radius_ = radius / probe.mesh_->cell * 1.001 + 0.01;
        probe.mesh_->walk.enter_region(probe.mesh_->surface.winding_gradient_bound(local, probe.radius_));
    }
    return probe;
}

bool TrueSurfaces::Probe::same_side(const Vec3 (&triangle)[3]) const {
    if (!mesh_ || !mesh_->walk.keeps_side_within(radius_)) return false;
    std::array<Vec3, 3> local;
    for (std::size_t k = 0; k < 3; ++k) local[k] = mesh_->to_cells(to_local(collider_.pose, triangle[k]));
    return !mesh_->surface.may_touch(local);
}

double TrueSurfaces::Probe::distance(Vec3 world) {
    if (!mesh_) return signed_distance(collider_, world, normal_);
    return mesh_->walk.distance_at(mesh_->to_cells(to_local(collider_.pose, world))) * mesh_->cell;
}

}  // namespace weft
