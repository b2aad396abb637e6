#include "vulkan/model_buffers.h"

#include "vulkan/args.data.h"

#include <algorithm>

namespace weft::vulkan {
namespace {

// Arrays that the arena reads when it is built.
struct Lists {
    std::vector<std::vector<std::uint32_t>> blocks, prolongation_nodes, batches, pinned;
    std::vector<std::uint32_t> faces_by_tile, offsets, items, span_ends;
    std::vector<float> masses, span_lengths;
};

TableBuffers add_table(Arena& arena, const ConstraintTable& table, Lists& lists) {
    TableBuffers buffers{.particles = arena.add_array(table.particles),
                         .fields = arena.add_array(table.fields),
                         .coupled = arena.add_array(table.coupled),
                         .coupling = arena.add_array(table.coupling),
                         .blocks = {}};
    auto& list = lists.blocks.emplace_back();
    for (const LineBlock& block : table.blocks)
        list.insert(list.end(), {block.begin, block.length | (block.cut ? WEFT_CUT_BLOCK : 0)});
    buffers.blocks = arena.add_array(list);
    return buffers;
}

std::vector<std::uint32_t> list_batches(const ConstraintTable& table) {
    std::vector<std::uint32_t> list;
    for (const Batch& batch : table.batches)
        list.insert(list.end(), {batch.begin, batch.rows | (batch.serial ? WEFT_SERIAL_BATCH : 0)});
    return list;
}

// Lists of the triangles at each particle, one after another. Leaves out the zeros that pad packets of lanes, which do
// not change sums.
void list_around(const ClothModel& model, Lists& lists) {
    const FacesAround& around = *model.around;
    lists.offsets.push_back(0);
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const std::uint32_t packet = p / lane_padding, lane = p % lane_padding;
        if (around.abreast(packet)) {
            for (std::size_t k = around.begin[packet]; k < around.begin[packet + 1]; ++k) {
                const std::uint32_t triangle = around.triangles[k * lane_padding + lane];
                if (triangle < model.triangle_count) lists.items.push_back(triangle);
            }
        } else {
            const std::uint32_t* own = around.offsets.data() + around.own[packet] + lane;
            lists.items.insert(lists.items.end(), around.items.begin() + own[0], around.items.begin() + own[1]);
        }
        lists.offsets.push_back(static_cast<std::uint32_t>(lists.items.size()));
    }
}

}  // namespace

Result<std::shared_ptr<ModelBuffers>> ModelBuffers::create(gpu::Device& device,
                                                           std::shared_ptr<const ClothModel> cloth_model) {
    auto self = std::shared_ptr<ModelBuffers>(new ModelBuffers(std::move(cloth_model)));
    const ClothModel& model = *self->model_;
    Arena& arena = self->arena_;
    Lists lists;
    lists.blocks.reserve(constraint_kind_count + model.hierarchy.size());  // the arena keeps their addresses
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind)
        self->tables[kind] = add_table(arena, model.constraints[kind], lists);
    lists.prolongation_nodes.reserve(model.hierarchy.size());
    lists.batches.reserve(model.hierarchy.size());
    lists.pinned.reserve(model.hierarchy.size());
    for (const CoarseLevel& level : model.hierarchy) {
        auto& nodes = lists.prolongation_nodes.emplace_back(level.prolongation.weight.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = level.prolongation.node(i);
        lists.batches.push_back(list_batches(level.limits));
        auto& pinned = lists.pinned.emplace_back(level.count, WEFT_NOT_PINNED);
        for (const std::uint32_t node : level.pinned) pinned[node] = level.particle[node];
        self->levels.push_back({.restriction_begin = arena.add_array(level.restriction.begin),
                                .restriction_node = arena.add_array(level.restriction.node),
                                .restriction_weight = arena.add_array(level.restriction.weight),
                                .prolongation_node = arena.add_array(nodes),
                                .prolongation_weight = arena.add_array(level.prolongation.weight),
                                .limits = add_table(arena, level.limits, lists),
                                .batches = arena.add_array(lists.batches.back()),
                                .pinned = arena.add_array(pinned),
                                .weight = arena.add_array(level.weight)});
    }
    list_around(model, lists);
    lists.masses = face_masses(model);
    for (const PinSpan& span : model.pin_spans) {
        lists.span_ends.insert(lists.span_ends.end(), {span.a, span.b});
        lists.span_lengths.push_back(span.length);
    }
    for (const auto& part : {std::span<const std::uint32_t>(model.faces_by_tile->corners),
                             std::span<const std::uint32_t>(model.faces_by_tile->begin),
                             std::span<const std::uint32_t>(model.faces_by_tile->place)})
        lists.faces_by_tile.insert(lists.faces_by_tile.end(), part.begin(), part.end());
    self->faces = arena.add_array(model.faces);
    self->faces_by_tile = arena.add_array(lists.faces_by_tile);
    self->face_mass = arena.add_array(lists.masses);
    self->around_offsets = arena.add_array(lists.offsets);
    self->around_items = arena.add_array(lists.items);
    self->span_ends = arena.add_array(lists.span_ends);
    self->span_lengths = arena.add_array(lists.span_lengths);
    self->steadiness = arena.add_array(model.steadiness);
    self->pins = arena.add_array(model.pin_of);
    if (auto built = arena.build(device, "model of " + model.name); !built) return built.errors();
    return self;
}

Result<void> ModelBuffers::write_changed(gpu::Device& device, const ClothModel& from, const ClothModel& to) const {
    const auto write = [&](Slot slot, const auto& numbers) {
        return slot.bytes == 0 ? Result<void>()
                               : upload(device, arena_, slot, std::as_bytes(std::span(numbers.data(), numbers.size())));
    };
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        const ConstraintTable &now = to.constraints[kind], &before = from.constraints[kind];
        if (!now.fields.shares(before.fields))
            if (auto written = write(tables[kind].fields, now.fields); !written) return written;
        if (!now.coupling.shares(before.coupling))
            if (auto written = write(tables[kind].coupling, now.coupling); !written) return written;
    }
    if (to.mass.shares(from.mass)) return {};
    return write(face_mass, face_masses(to));
}

Result<void> ModelBuffers::set_material(gpu::Device& device, std::shared_ptr<const ClothModel> other) {
    if (auto written = write_changed(device, *model_, *other); !written) {
        (void)write_changed(device, *other, *model_);
        return written;
    }
    if (!other->mass.shares(model_->mass)) measure_lists_ = nullptr;
    model_ = std::move(other);
    return {};
}

Result<const MeasureLists*> ModelBuffers::measure_lists(gpu::Device& device) const {
    if (!measure_lists_) {
        auto made = MeasureLists::create(device, *model_);
        if (!made) return made.errors();
        measure_lists_ = std::move(*made);
    }
    return measure_lists_.get();
}

}  // namespace weft::vulkan
