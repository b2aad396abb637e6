// Changes the fabric of an existing model.

#include "physics/change_rows.h"
#include "solver/model/cloth_model.h"
#include "solver/model/masses.h"
#include "solver/model/opened_cloth.h"
#include "solver/model/tear_law.h"

#include <algorithm>
#include <bit>

namespace weft {
namespace {

bool same_stiffness(const StretchMaterial& a, const StretchMaterial& b) {
    return std::ranges::equal(a.stretch, b.stretch) && std::ranges::equal(a.compression, b.compression) &&
           std::ranges::equal(a.stretch_limit, b.stretch_limit) && a.shear == b.shear &&
           a.inextensible == b.inextensible && a.model == b.model;
}

bool same_tearing(const TearMaterial& a, const TearMaterial& b) {
    return std::ranges::equal(a.strength, b.strength) && a.tear_energy == b.tear_energy && a.tear_ratio == b.tear_ratio;
}

// The rest angle is compared by bits, because NaN stands for the angle of the mesh.
bool same_hinges(const BendMaterial& a, const BendMaterial& b) {
    return a.model == b.model && a.edges == b.edges &&
           std::bit_cast<std::uint32_t>(a.rest_angle) == std::bit_cast<std::uint32_t>(b.rest_angle);
}

// Returns false if the material needs other constraints.
template <class Material>
bool change_table(ClothModel& model, ConstraintKind kind, bool (*change)(const RowsToChange&, const Material&),
                  const Material& material) {
    ConstraintTable& table = model.constraints[static_cast<std::uint32_t>(kind)];
    AlignedVector<float> fields(table.fields.begin(), table.fields.end()),
        coupling(table.coupling.begin(), table.coupling.end());
    const RowsToChange rows{.stride = table.stride,
                            .particles = table.particles.data(),
                            .geometry = table.geometry.data(),
                            .left_out = table.left_out,
                            .rest_positions = model.start.data(),
                            .fields = fields.data(),
                            .coupling = coupling.data()};
    if (!change(rows, material)) return false;
    table.fields = std::move(fields);
    if (table.is_coupled()) table.coupling = std::move(coupling);
    return true;
}

bool change_bending(ClothModel& model, const BendMaterial& material) {
    switch (material.model) {
        case BendModel::dihedral:
            return change_table(model, ConstraintKind::bend, change_bend, material);
        case BendModel::distance:
            return change_table(model, ConstraintKind::distance_bend, change_distance_bend, material);
        case BendModel::moment:
            if (!model.weights->bend.empty()) break;  // its geometry has no weights
            return change_table(model, ConstraintKind::moment, change_moment, material);
        case BendModel::plate:
            break;  // needs a factorization per triangle; storing its input costs more than a rebuild
    }
    return false;
}

// The model has its new fabric.
Result<void> change_masses(ClothModel& model, float before_density) {
    const SharedArray<float> before = model.mass;
    const float ratio = model.fabric.body.density / before_density;
    AlignedVector<float> mass = masses_of(model);
    for (std::uint32_t p = 0; p < model.particle_count; ++p)
        if (!(mass[p] > 0)) mass[p] = before[p] * ratio;  // its triangles were removed (cloth_edit.h)
    weigh_opened(model, mass);
    model.mass = std::move(mass);
    if (auto weighed = check_masses(model.mass); !weighed) return weighed;
    AlignedVector<Vec4> start(model.start.begin(), model.start.end());
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const float weight = 1 / model.mass[p];
        start[p].w = start[p].w > 0 ? weight : 0;
    }
    model.start = std::move(start);
    return {};
}

}  // namespace

Result<std::shared_ptr<const ClothModel>> with_fabric(const ClothModel& from, const Fabric& fabric) {
    const float density = fabric.body.density;
    if (auto sound = check_density(density); !sound) return sound.errors();
    const std::shared_ptr<const ClothModel> other_rows;
    const Tethers asked = fabric.tether.use;
    if (!same_hinges(from.fabric.bend, fabric.bend) || from.fabric.tether.slack != fabric.tether.slack ||
        (asked != from.tethers_asked && asked != from.fabric.tether.use))
        return other_rows;

    auto model = std::make_shared<ClothModel>(from);
    model->fabric = fabric;
    model->fabric.tether = from.fabric.tether;
    model->tethers_asked = asked;
    model->fabric.moment = model->fabric.plate = model->fabric.distance_bend = fabric.bend;
    model->fabric.membrane = fabric.stretch;
    const StretchMaterial& stretch = fabric.stretch;
    const bool same_stretch = same_stiffness(from.fabric.stretch, stretch);
    const bool same_bend = std::ranges::equal(from.fabric.bend.bend, fabric.bend.bend);
    const bool same_density = from.fabric.body.density == density;
    // A membrane needs a split per triangle, as plates need a factorization.
    const bool membrane =
        StretchModel::membrane == stretch.model || StretchModel::membrane == from.fabric.stretch.model;
    if (!same_stretch && membrane) return other_rows;
    if (!same_stretch && !change_table(*model, ConstraintKind::stretch, change_stretch, stretch)) return other_rows;
    if (!same_bend && !change_bending(*model, fabric.bend)) return other_rows;
    if (!same_density)
        if (auto changed = change_masses(*model, from.fabric.body.density); !changed) return changed.errors();
    model->elasticity = elasticity_of(*model);
    if (model->tear_law && (!same_stretch || !same_tearing(from.fabric.tear, fabric.tear)))
        model->tear_law = make_tear_law(*model);
    return std::shared_ptr<const ClothModel>(std::move(model));
}

bool limits_differ(const Fabric& a, const Fabric& b) {
    return !std::ranges::equal(a.stretch.stretch, b.stretch.stretch) ||
           !std::ranges::equal(a.stretch.stretch_limit, b.stretch.stretch_limit) ||
           a.stretch.shear != b.stretch.shear || a.stretch.inextensible != b.stretch.inextensible ||
           a.body.density != b.body.density;
}

}  // namespace weft
