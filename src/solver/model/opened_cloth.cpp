#include "solver/model/opened_cloth.h"

#include "physics/change_rows.h"
#include "solver/model/cloth_model.h"

#include <algorithm>
#include <cassert>

namespace weft {
namespace {

// Sums in the order of the ring, in single precision, as every backend can. A particle without cloth keeps its mass.
void weigh_vertex(const ClothModel& model, std::span<const std::uint32_t> faces, std::uint32_t vertex,
                  std::span<float> mass) {
    const TearTable& table = *model.tears;
    const std::span ring(table.entries.data() + table.ring_begin[vertex],
                         table.entries.data() + table.ring_begin[vertex + 1]);
    const auto area = [&](const TearTable::Entry& entry) { return model.face_area[entry.corner % model.face_stride]; };
    for (const TearTable::Entry& entry : ring)
        if (area(entry) > 0) mass[faces[entry.corner]] = 0;
    for (const TearTable::Entry& entry : ring)
        if (area(entry) > 0) mass[faces[entry.corner]] += model.fabric.body.density * area(entry) / 3;
}

}  // namespace

void weigh_opened(const ClothModel& model, std::span<float> mass) {
    if (!model.tears) return;
    const std::uint32_t vertices = model.tears->vertex_count();
    for (std::uint32_t from : model.copied_from) {
        while (from >= vertices) from = model.copied_from[from - vertices];
        weigh_vertex(model, {model.faces.data(), model.faces.size()}, from, mass);
    }
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
    strayed.resize(model.tears->vertex_count());
    mass.resize(std::size_t{particle_count} + room);
    copied_from.reserve(copied_from.size() + room);
}

Opener::Opener(const ClothModel& model, OpenedArrays& arrays)
    : model_(model), table_(*model.tears), arrays_(arrays), law_(model.fabric.stretch) {}

bool Opener::open(const Opening& opening) {
    std::array<std::uint32_t, 2> links{};
    std::size_t count = 0;
    for (const std::uint32_t link : opening.links)
        if (link != none) links[count++] = link;
    if (count == 0) return true;
    const std::span<const std::uint32_t> opened(links.data(), count);
    const std::uint32_t vertex = table_.entries[links[0]].vertex;
    // Each vertex needs as many copies as it gets more fans. At the far ends these are at most one per link.
    if (fans(vertex, opened) + count > arrays_.room) return false;
    part(vertex, opened);
    for (std::size_t i = 0; i < 2; ++i) {
        if (opening.links[i] == none) continue;
        const std::uint32_t far = table_.entries[table_.entries[opening.links[i]].twin].vertex;
        arrays_.strayed[far] = opening.strayed[i];
        part(far, {});
    }
    return true;
}

bool Opener::is_closed(const TearTable::Entry& entry) const {
    if (entry.next == none) return false;
    const auto& faces = arrays_.faces;
    return faces[entry.corner] == faces[table_.entries[entry.next].corner] && faces[entry.far] == faces[entry.next_far];
}

// Groups the entries of the ring by fan. Returns how many fans have no particle of their own yet.
std::uint32_t Opener::fans(std::uint32_t vertex, std::span<const std::uint32_t> opened) {
    const std::uint32_t begin = table_.ring_begin[vertex], end = table_.ring_begin[vertex + 1];
    fan_.resize(end - begin);
    for (std::uint32_t i = 0; i < fan_.size(); ++i) fan_[i] = i;
    const auto join = [&](std::uint32_t i) {
        const TearTable::Entry& entry = table_.entries[i];
        if (!is_closed(entry) || std::ranges::find(opened, i) != opened.end()) return;
        std::uint32_t &a = fan_[i - begin], &b = fan_[entry.next - begin];
        a = b = std::min(a, b);
    };
    // A ring consists of chains and circles, so a sweep in each direction brings the lowest number to all of a fan.
    for (std::uint32_t i = begin; i < end; ++i) join(i);
    for (std::uint32_t i = end; i-- > begin;) join(i);
    std::uint32_t missing = 0;
    for (std::uint32_t i = 0; i < fan_.size(); ++i) {
        if (fan_[i] != i) continue;
        const std::uint32_t particle = arrays_.faces[table_.entries[begin + i].corner];
        for (std::uint32_t j = 0; j < i; ++j) {
            if (fan_[j] != j || arrays_.faces[table_.entries[begin + j].corner] != particle) continue;
            ++missing;
            break;
        }
    }
    return missing;
}

void Opener::part(std::uint32_t vertex, std::span<const std::uint32_t> opened) {
    if (fans(vertex, opened) == 0) {
        update_rows(vertex);
        return;
    }
    const std::uint32_t begin = table_.ring_begin[vertex];
    std::vector<std::uint32_t> taken;
    for (std::uint32_t i = 0; i < fan_.size(); ++i) {
        if (fan_[i] != i) continue;
        const std::uint32_t particle = arrays_.faces[table_.entries[begin + i].corner];
        if (std::ranges::find(taken, particle) == taken.end()) {
            taken.push_back(particle);
            continue;
        }
        if (arrays_.room == 0) continue;  // the fans stay joined by the particle
        const std::uint32_t copy = arrays_.particle_count++;
        --arrays_.room;
        arrays_.copied_from.push_back(particle);
        for (std::uint32_t j = i; j < fan_.size(); ++j)
            if (fan_[j] == i) arrays_.faces[table_.entries[begin + j].corner] = copy;
    }
    weigh(vertex);
    update_rows(vertex);
}

void Opener::weigh(std::uint32_t vertex) {
    weigh_vertex(model_, arrays_.faces, vertex, arrays_.mass);
}

void Opener::update_rows(std::uint32_t vertex) {
    const auto& refs = table_.rows_at;
    for (std::uint32_t i = refs.offsets[vertex]; i < refs.offsets[vertex + 1]; ++i) {
        const auto& [kind, row] = refs.items[i];
        if (kind == ConstraintKind::stretch) {
            update_stretch(row);
        } else {
            update_row(model_.table(kind), row);
        }
    }
}

void Opener::mark_cut(std::uint32_t row) {
    const auto after = std::ranges::upper_bound(arrays_.blocks, row, {}, &LineBlock::begin);
    if (after != arrays_.blocks.begin() && row < (after - 1)->end()) (after - 1)->cut = true;
}

void Opener::update_stretch(std::uint32_t row) {
    const ConstraintTable& table = model_.table(ConstraintKind::stretch);
    const auto& corners = table_.rows[static_cast<std::uint32_t>(table.kind)].corners;
    auto& rows = arrays_.rows[static_cast<std::uint32_t>(table.kind)];
    const std::size_t stride = table.stride, half = table.second_halves;
    if (rows.geometry[stride + row] < 0) return;  // it was removed
    std::uint32_t &a = rows.particles[row], &b = rows.particles[stride + row];
    const std::uint32_t first_a = arrays_.faces[corners[row]], first_b = arrays_.faces[corners[stride + row]];
    if (a != first_a || b != first_b) {
        a = first_a, b = first_b;
        mark_cut(row);
    }
    if (table_.second[row] == none) return;
    const std::uint32_t second_a = arrays_.faces[table_.second[row]],
                        second_b = arrays_.faces[table_.second[half + row]];
    if (second_a == first_a && second_b == first_b) return;
    const auto second = static_cast<std::uint32_t>(half) + row;
    if (table.is_dummy(rows.particles[second])) {
        part_stiffness(row);
        ++rows.rows;
        arrays_.halves_used[row / lane_padding] = 1;
    }
    rows.particles[second] = second_a, rows.particles[stride + second] = second_b;
    mark_cut(second);
}

// Each half of an opened edge has the stiffness of its own triangle.
void Opener::part_stiffness(std::uint32_t row) {
    const ConstraintTable& table = model_.table(ConstraintKind::stretch);
    auto& rows = arrays_.rows[static_cast<std::uint32_t>(table.kind)];
    const std::size_t stride = table.stride, second = std::size_t{table.second_halves} + row;
    const float cos2 = rows.geometry[row], strip = rows.geometry[stride + row], first_part = table_.first_part[row];
    rows.fields[second] = rows.fields[row];
    const auto set = [&](std::size_t at, float part) {
        const StretchLaw::Compliances compliances = law_.at(cos2, strip * part);
        rows.geometry[at] = cos2, rows.geometry[stride + at] = strip * part;
        rows.fields[stride + at] = compliances.stretched, rows.fields[2 * stride + at] = compliances.compressed;
    };
    set(row, first_part), set(second, 1 - first_part);
}

void Opener::update_row(const ConstraintTable& table, std::uint32_t row) {
    const TearTable::Rows& source = table_.rows[static_cast<std::uint32_t>(table.kind)];
    auto& rows = arrays_.rows[static_cast<std::uint32_t>(table.kind)];
    const std::size_t stride = table.stride;
    if (table.is_dummy(rows.particles[row])) return;  // it has ended
    bool whole = true;
    for (std::uint32_t i = source.tie_begin[row]; i < source.tie_begin[row + 1]; ++i)
        whole = whole && arrays_.faces[source.ties[i][0]] == arrays_.faces[source.ties[i][1]];
    for (std::uint32_t slot = 0; slot < table.arity; ++slot)
        rows.particles[slot * stride + row] =
            whole ? arrays_.faces[source.corners[slot * stride + row]] : dummy(table.first_dummy, slot, row);
    if (whole) return;
    --rows.rows;
    for (std::size_t at = row; at < rows.fields.size(); at += stride) rows.fields[at] = 0;
    for (std::size_t at = row; at < rows.geometry.size(); at += stride) rows.geometry[at] = no_area;
}

}  // namespace weft
