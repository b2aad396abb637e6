#include "weft/shape_building.h"

#include "collide/convex_hull.h"
#include "collide/distance_field.h"
#include "collide/solid_surface.h"
#include "scene/problems.h"
#include "solver/model/collider_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace weft {
namespace {

using SharedShape = std::shared_ptr<const ShapeData>;

struct ShapeSource {
    const MeshFiles& files;
    const std::string& collider;
    std::vector<std::string>& notes;
    unsigned threads;
    const FieldCache& fields;
    bool body;  // of a body

    void note(const std::string& what) const { notes.push_back("collider '" + collider + "': " + what); }
};

// Along the axes of the mesh. An odd number of mirrored axes turns the triangles inside out, so they are turned around.
void scale_mesh(TriangleMesh& mesh, Vec3 scale) {
    for (Vec3& p : mesh.positions) p = {p.x * scale.x, p.y * scale.y, p.z * scale.z};
    for (Vec3& n : mesh.normals) n = normalized(Vec3{n.x / scale.x, n.y / scale.y, n.z / scale.z});
    if (scale.x * scale.y * scale.z < 0) {
        for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    }
}

/// The mesh of a shape, in the collider's frame.
template <class Desc>
Result<TriangleMesh> mesh_of_shape(const Desc& shape, const ShapeSource& source) {
    if (shape.file.empty()) {
        TriangleMesh mesh = shape.mesh;
        scale_mesh(mesh, shape.scale);
        return mesh;
    }
    if (!source.files.read)
        return Error{"file",
                     shape.file + ": cannot be read: this program reads no mesh files (Options::read_mesh is empty)"};
    auto mesh = source.files.read(shape.file, source.files.folder);
    if (!mesh) return mesh.errors();
    scale_mesh(*mesh, shape.scale);
    place_mesh(*mesh, MeshFileDesc{.file = shape.file, .up = shape.up}, {});
    return mesh;
}

template <class Desc>
Result<SharedShape> build_shape(const Desc&, const ShapeSource&) {
    return SharedShape{};
}

Result<SharedShape> build_shape(const ConvexDesc& convex, const ShapeSource& source) {
    const auto mesh = mesh_of_shape(convex, source);
    if (!mesh) return mesh.errors();
    const auto hull = convex_hull(mesh->positions);
    if (!hull) return hull.errors();
    if (hull->shortfall > 0) {
        source.note("its hull is simplified to " + std::to_string(hull->vertices.size()) +
                    " vertices; some points of the mesh are up to " + number_text(hull->shortfall) +
                    " m outside of it");
    }
    return std::make_shared<const ShapeData>(make_convex_data(*hull));
}

// Means over the triangles around each vertex, by their areas.
void add_normals(TriangleMesh& mesh) {
    if (!mesh.normals.empty()) return;
    mesh.normals.assign(mesh.positions.size(), {});
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 normal = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t corner : {a, b, c}) mesh.normals[corner] = mesh.normals[corner] + normal;
    }
    for (Vec3& normal : mesh.normals) {
        const float size = length(normal);
        normal = size > 0 ? normal * (1 / size) : Vec3{0, 1, 0};
    }
}

// A body is a solid: its triangles would need contact that pushes it.
bool is_surface(const SolidMeshDesc& mesh, bool open, bool body) {
    if (body) return false;
    return mesh.contact == MeshContact::surface || (mesh.contact == MeshContact::automatic && open);
}

void note_field(const DistanceField& field, bool as_surface, const ShapeSource& source) {
    const auto count = [&](std::uint32_t number, const std::string& what) {
        if (number > 0) source.note(std::to_string(number) + ' ' + what);
    };
    count(field.zero_area, "triangles without an area left out");
    count(field.flipped, "triangles face the other way than their neighbors; turned around");
    const std::string others = as_surface ? " for cloth without exact self-collision" : "";
    const auto rounded = [](double x, double digits) { return number_text(std::round(x * digits) / digits); };
    if (field.is_sheet) {
        source.note("the mesh is a sheet; it is solid for " + rounded(SolidSurface::sheet_thickness * field.cell, 1e4) +
                    " m behind the side that its triangles face" + (as_surface ? "," : "") + others);
    } else if (!field.has_inside) {
        source.note("the mesh encloses nothing, so cloth" +
                    std::string(as_surface ? " without exact self-collision" : "") + " passes through it");
    } else if (!field.closed) {
        source.note("the mesh is open; its holes count as closed" + others);
    }
    if (field.thin.thin > 0) {
        const Vec3 at = field.thin.place;
        source.note(rounded(100.0 * field.thin.thin / field.thin.samples, 100) +
                    " % of its surface are thinner than two cells of the distance field (" +
                    rounded(2 * field.cell, 1e5) + " m), most of all near (" + rounded(at.x, 1e4) + ", " +
                    rounded(at.y, 1e4) + ", " + rounded(at.z, 1e4) + "); a higher resolution helps");
    }
}

Result<DistanceField> field_of(const TriangleMesh& mesh, std::uint32_t cells, const ShapeSource& source) {
    const FieldCache::Key key = FieldCache::key_of(mesh.positions, mesh.triangles, cells);
    if (auto kept = source.fields.read(key)) return std::move(*kept);
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = cells, .threads = source.threads});
    if (field) source.fields.write(key, *field);
    return field;
}

Result<SharedShape> build_shape(const SolidMeshDesc& solid, const ShapeSource& source) {
    auto mesh = mesh_of_shape(solid, source);
    if (!mesh) return mesh.errors();
    auto field = field_of(*mesh, solid.resolution, source);
    if (!field) return field.errors();
    note_field(*field, is_surface(solid, !field->closed, source.body), source);
    add_normals(*mesh);
    field->data.bounds = bounds_of(mesh->positions);
    field->data.surface = std::move(*mesh);
    field->data.open = !field->closed;
    return std::make_shared<const ShapeData>(std::move(field->data));
}

/// The part of a shape that its data follow from.
ColliderShape without_contact(ColliderShape shape) {
    if (auto* mesh = std::get_if<SolidMeshDesc>(&shape)) mesh->contact = {};
    return shape;
}

}  // namespace

Result<SharedShape> ShapeLibrary::data_of(const ColliderDesc& collider, const MeshFiles& files,
                                          const std::string& pointer, std::vector<std::string>& notes) {
    std::erase_if(known_, [](const Entry& entry) { return entry.data.expired(); });
    ColliderShape shape = without_contact(collider.shape);
    const auto known = std::ranges::find(known_, shape, &Entry::shape);
    if (known != known_.end()) return known->data.lock();
    const ShapeSource source{files, collider.name, notes, threads_, fields_, collider.body.has_value()};
    auto built = std::visit([&](const auto& one) { return build_shape(one, source); }, collider.shape);
    if (!built) return within(pointer, built.errors());
    if (*built) known_.push_back({std::move(shape), *built});
    return built;
}

namespace {

// Contact with triangles computes in floats. Beyond this, rounding is a tenth of the distance that cloth of the default
// thickness keeps.
constexpr double largest_rounding = 1e-4;  // m

void note_rounding(const Bounds& box, const std::string& name, std::vector<std::string>& notes) {
    const auto largest = [](Vec3 v) { return double{std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)})}; };
    const double extent = std::max(largest(box.min), largest(box.max)), rounding = std::ldexp(extent, -24);
    if (!(rounding > largest_rounding)) return;
    notes.push_back("collider '" + name + "': its coordinates are up to " + number_text(std::round(extent)) +
                    " m and rounded to " + number_text(std::round(rounding * 1e5) / 1e5) +
                    " m, so cloth may pass through its triangles");
}

}  // namespace

Result<std::shared_ptr<const ClothModel>> surface_of(const ColliderDesc& collider, const ShapeData* data,
                                                     const std::string& pointer, std::vector<std::string>& notes) {
    const auto* mesh = std::get_if<SolidMeshDesc>(&collider.shape);
    if (!mesh || !is_surface(*mesh, data->open, collider.body.has_value())) return std::shared_ptr<const ClothModel>();
    auto surface = build_collider_surface(collider.name, data->surface, collider.friction);
    if (!surface) return within(pointer + "/mesh", surface.errors());
    if (const std::uint32_t count = surface->report.duplicate_triangles; count > 0)
        notes.push_back("collider '" + collider.name + "': " + std::to_string(count) + " doubled triangles left out");
    note_rounding(data->bounds, collider.name, notes);
    return std::move(surface->model);
}

}  // namespace weft
