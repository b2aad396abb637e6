#include "editor/app/pick_trees.h"

#include "solver/world/collider_mesh.h"

namespace weft::editor {

std::string PickTrees::name_of_cloth(const Picture& picture, std::size_t cloth) {
    return picture.world->model(cloth)->name;
}
std::string PickTrees::name_of_collider(const Picture& picture, std::size_t collider) {
    return picture.world->colliders()[collider].name;
}

MeshView PickTrees::mesh_of_cloth(const Picture& picture, std::size_t cloth) {
    const ClothFrame& frame = picture.world->frame().cloths[cloth];
    return {frame.positions, frame.triangles};
}

PickScene PickTrees::scene(const Picture& picture, const ViewMarks& marks) {
    const WorldFrame& world = *picture.world;
    const auto skipped = [&](const std::string& name) {
        return marks.hidden.contains(name) || marks.locked.contains(name);
    };
    cloths_.assign(world.cloth_count(), {});
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        const std::string name = name_of_cloth(picture, i);
        if (skipped(name)) continue;
        const ClothFrame& frame = world.frame().cloths[i];
        // Another cloth may have got the name: its id makes another version.
        const std::uint64_t version =
            frame.topology_version * 1'000'003 + world.cloth_id(i).generation * 8191 + world.cloth_id(i).index;
        cloths_[i].tree = &cloth_trees_[name].of(mesh_of_cloth(picture, i), version, picture.serial);
    }
    colliders_.assign(world.colliders().size(), {});
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        const Collider& collider = world.colliders()[i];
        if (skipped(collider.name)) continue;
        const ColliderId id = world.collider_id(i);
        std::unique_ptr<TriangleTree>& tree = collider_trees_[(std::uint64_t{id.generation} << 32) | id.index];
        if (!tree) {
            const TriangleMesh mesh = mesh_of(collider);
            tree = std::make_unique<TriangleTree>(MeshView(mesh));
        }
        colliders_[i] = pick_surface(collider, tree.get());
    }
    return {cloths_, colliders_, {}};
}

}  // namespace weft::editor
