#include "weft/drawn_frame.h"

#include "scene/materials.h"

#include <algorithm>
#include <string>

namespace weft {
namespace {

// Frame and scene list the cloths in the same order, so the cloth with this name is usually at this `place`.
const SceneCloth* find_cloth(std::span<const SceneCloth> cloths, const std::string& name, std::size_t place) {
    if (place < cloths.size() && cloths[place].name == name) return &cloths[place];
    const auto found = std::ranges::find(cloths, name, &SceneCloth::name);
    return found != cloths.end() ? &*found : nullptr;
}

const Material* drawn_material(const ClothFrame& cloth, const SceneCloth* described) {
    if (described && described->material) return &described->material->values;
    if (!cloth.render_mesh().colors.empty()) return nullptr;
    return described ? &material_of(*described) : &find_material("cotton")->material;
}

}  // namespace

void DrawnFrame::update(const Frame& frame, std::span<const SceneCloth> cloths) {
    surfaces_.resize(frame.cloths.size());
    for (std::size_t i = 0; i < frame.cloths.size(); ++i) {
        const ClothFrame& cloth = frame.cloths[i];
        const RenderMesh& mesh = cloth.render_mesh();
        surfaces_[i] = {.name = cloth.model->name,
                        .positions = mesh.positions,
                        .normals = mesh.normals,
                        .triangles = mesh.triangles,
                        .uvs = mesh.uvs,
                        .colors = mesh.colors,
                        .rest_positions = mesh.rest_positions,
                        .topology_version = cloth.topology_version,
                        .material = drawn_material(cloth, find_cloth(cloths, cloth.model->name, i)),
                        .spare_vertices = cloth.model->spare_vertices()};
    }
}

}  // namespace weft
