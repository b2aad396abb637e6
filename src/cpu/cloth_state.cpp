#include "cpu/cloth_state.h"

namespace weft::cpu {

ClothState::ClothState(std::shared_ptr<const ClothModel> cloth_model) : model(std::move(cloth_model)) {
    const std::size_t capacity = model->capacity();
    now.position = model->start;
    now.start.resize(capacity);
    now.velocity.resize(capacity);
    now.carry.resize(capacity);
    last_good = now;
    for (const ConstraintTable& table : model->constraints) {
        lambda[static_cast<std::uint32_t>(table.kind)].resize(std::size_t{constraint_info(table.kind).lambdas} *
                                                              table.stride);
    }
    face_normals.resize(model->face_stride);
    normals.resize(capacity);
    update_normals();
}

void ClothState::update_normals() {
    const SurfaceView view = surface();
    scalar_passes().faces(view, {0, model->face_stride});
    normals_pass(view, {0, model->particle_count});
}

RowView ClothState::rows(ConstraintKind kind) {
    const ConstraintTable& table = model->table(kind);
    return {table.stride, table.particles.data(), table.fields.data(), lambda[static_cast<std::uint32_t>(kind)].data()};
}

SurfaceView ClothState::surface() {
    const Adjacency& around = model->topology.particle_triangles;
    return {&now.position[0].x,    model->faces.data(), model->face_stride, &face_normals[0].x,
            around.offsets.data(), around.items.data(), &normals[0].x};
}

}  // namespace weft::cpu
