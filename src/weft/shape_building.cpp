#include "weft/shape_building.h"

#include "collide/convex_hull.h"
#include "scene/problems.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace weft {
namespace {

using SharedShape = std::shared_ptr<const ShapeData>;

struct ShapeSource {
    const MeshFiles& files;
    const std::string& collider;
    std::vector<std::string>& notes;

    void note(const std::string& what) const { notes.push_back("collider '" + collider + "': " + what); }
};

/// The mesh of a shape, in the collider's frame.
template <class Desc>
Result<TriangleMesh> mesh_of_shape(const Desc& shape, const ShapeSource& source) {
    if (shape.file.empty()) return shape.mesh;
    if (!source.files.read)
        return Error{"file",
                     shape.file + ": cannot be read: this program reads no mesh files (Options::read_mesh is empty)"};
    auto mesh = source.files.read(shape.file, source.files.folder);
    if (!mesh) return mesh.errors();
    place_mesh(*mesh, MeshFileDesc{shape.file, shape.scale, shape.up}, {});
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

}  // namespace

Result<SharedShape> ShapeLibrary::data_of(const ColliderDesc& collider, const MeshFiles& files,
                                          const std::string& pointer, std::vector<std::string>& notes) {
    std::erase_if(known_, [](const Entry& entry) { return entry.data.expired(); });
    const auto known = std::ranges::find(known_, collider.shape, &Entry::shape);
    if (known != known_.end()) return known->data.lock();
    const ShapeSource source{files, collider.name, notes};
    auto built = std::visit([&](const auto& shape) { return build_shape(shape, source); }, collider.shape);
    if (!built) {
        Errors placed;
        for (const Error& error : built.errors())
            placed.push_back({pointer, error.where.empty() ? error.what : error.message(), error.fault});
        return placed;
    }
    if (*built) known_.push_back({collider.shape, *built});
    return built;
}

}  // namespace weft
