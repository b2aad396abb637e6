#include "solver/model/opened_cloth.h"

#include "solver/model/tear_cloth.h"

namespace weft {

void weigh_opened(const ClothModel& model, std::span<float> mass) {
    if (!model.tears || (model.copied_from.empty() && !model.reserved.erodes)) return;
    OpenedArrays arrays;
    arrays.faces.assign(model.faces.begin(), model.faces.end());
    arrays.mass.assign(mass.begin(), mass.end());
    const StretchLaw law(model.fabric.stretch);
    const scalar::TearAccess access{model, arrays, law};
    const std::uint32_t vertices = model.tears->vertex_count();
    for (std::uint32_t from : model.copied_from) {
        while (from >= vertices) from = model.copied_from[from - vertices];
        scalar::tear_weigh(access, from);
    }
    for (std::uint32_t t = 0; model.reserved.erodes && t < model.triangle_count; ++t) {
        const auto [a, b, c] = model.triangles()[t];
        for (std::uint32_t k = 0; a == b && k < 3; ++k)
            scalar::tear_weigh(access, model.tears->vertices[std::size_t{k} * model.face_stride + t]);
    }
    std::ranges::copy(arrays.mass, mass.begin());
}

OpenedArrays::OpenedArrays(const ClothModel& model)
    : faces(model.faces.begin(), model.faces.end()),
      blocks(model.table(ConstraintKind::stretch).blocks),
      mass(model.mass.begin(), model.mass.end()),
      copied_from(model.copied_from.begin(), model.copied_from.end()),
      strayed(model.strayed.begin(), model.strayed.end()),
      without_row(model.edges->without_row),
      particle_count(model.particle_count),
      room(model.reserve) {
    for (const ConstraintTable& table : model.constraints) {
        Rows& mine = rows[static_cast<std::uint32_t>(table.kind)];
        mine.particles.assign(table.particles.begin(), table.particles.end());
        mine.fields.assign(table.fields.begin(), table.fields.end());
        mine.geometry.assign(table.geometry.begin(), table.geometry.end());
        mine.rows = table.rows;
    }
    const ConstraintTable& stretch = model.table(ConstraintKind::stretch);
    halves_used.resize(stretch.second_halves / lane_padding);
    for (std::uint32_t row = 0; row < stretch.second_halves; ++row)
        if (!stretch.is_dummy(stretch.particles[stretch.second_halves + row])) halves_used[row / lane_padding] = 1;
    if (model.reserved.erodes) find_settled(model);
    fan.resize(model.tears->entries.size());
    strayed.resize(model.tears->vertex_count());
    mass.resize(std::size_t{particle_count} + room);
    copied_from.reserve(copied_from.size() + room);
}

void OpenedArrays::find_settled(const ClothModel& model) {
    const TearTable& table = *model.tears;
    const auto& corners = table.rows[static_cast<std::size_t>(ConstraintKind::stretch)].corners;
    const auto is_removed = [&](std::uint32_t corner) {
        const auto [a, b, c] = model.triangles()[corner % model.face_stride];
        return a == b;
    };
    settled.resize(table.half_stride);
    for (std::uint32_t row = 0; row < table.half_stride; ++row)
        settled[row] = corners[row] != none &&
                       (is_removed(corners[row]) || (table.second[row] != none && is_removed(table.second[row])));
}

Opener::Opener(const ClothModel& model, OpenedArrays& arrays)
    : model_(model), arrays_(arrays), law_(model.fabric.stretch) {}

bool Opener::open(const Opening& opening) {
    scalar::TearOpening links{opening.links[0], opening.links[1], opening.strayed[0], opening.strayed[1]};
    if (links.first == none) {
        links = {links.second, none, links.second_strayed, 0};
        if (links.first == none) return true;
    }
    const scalar::TearAccess access{model_, arrays_, law_};
    if (!scalar::tear_open(access, links)) return false;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = scalar::tear_opened_vertex(access, links, k);
        if (vertex != none) update_rows(vertex);
    }
    return true;
}

void Opener::update_rows(std::uint32_t vertex) {
    const scalar::TearAccess access{model_, arrays_, law_};
    const auto& refs = model_.tears->rows_at;
    for (std::uint32_t i = refs.offsets[vertex]; i < refs.offsets[vertex + 1]; ++i)
        scalar::tear_update_row(access, scalar::tear_kind(refs.items[i].kind), refs.items[i].row);
}

}  // namespace weft
