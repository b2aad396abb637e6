#include "scene/scene_keys.h"

#include <vector>

namespace weft {
namespace {

const SceneHead scene_head;
const FabricHead fabric_head;
const SceneDesc scene;
const ClothDesc cloth;
const MeshFileDesc mesh_file;
const GridDesc grid;
const ColorPins color_pins;
const ColliderDesc collider;
const PlaneDesc plane;
const SphereDesc sphere;

std::vector<SceneTable> all_tables() {
    std::vector<SceneTable> tables = {
        {"", head_keys, &scene_head},
        {"", scene_keys, &scene},
        {"/solver", solver_keys, &scene.solver},
        {"/cloths/*", cloth_keys, &cloth},
        {"/cloths/*/mesh", mesh_keys, nullptr},
        {"/cloths/*/mesh", mesh_file_keys, &mesh_file},
        {"/cloths/*/mesh/grid", grid_keys, &grid},
        {"/cloths/*/transform", transform_keys, &cloth.transform},
        {"/cloths/*/fabric", fabric_keys, &fabric_head},
    };
    for (const FabricTable& table : fabric_tables())
        tables.push_back(
            {"/cloths/*/fabric", table.parameters, reinterpret_cast<const std::byte*>(&cloth.fabric) + table.offset});
    const SceneTable rest[] = {
        {"/cloths/*/pins/*", pin_keys, nullptr},
        {"/cloths/*/pins/*", color_pin_keys, &color_pins},
        {"/cloths/*/pins/*/box", box_keys, nullptr},
        {"/colliders/*", collider_keys, &collider},
        {"/colliders/*/transform", pose_keys, &collider.transform},
        {"/colliders/*/plane", plane_keys, &plane},
        {"/colliders/*/sphere", sphere_keys, &sphere},
    };
    tables.insert(tables.end(), std::begin(rest), std::end(rest));
    return tables;
}

}  // namespace

std::span<const SceneTable> scene_tables() {
    static const std::vector<SceneTable> tables = all_tables();
    return tables;
}

}  // namespace weft
