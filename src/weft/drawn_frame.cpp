#include "weft/drawn_frame.h"

#include <algorithm>

namespace weft {
namespace {

const Material* material_of(const ClothFrame& cloth, std::span<const SceneLook> looks) {
    const auto look = std::ranges::find(looks, cloth.model->name, &SceneLook::object);
    if (look != looks.end()) return &look->material;
    return cloth.render_mesh().colors.empty() ? &find_material("cotton")->material : nullptr;
}

}  // namespace

void DrawnFrame::update(const Frame& frame, std::span<const SceneLook> looks) {
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
                        .material = material_of(cloth, looks)};
    }
}

}  // namespace weft
