#include "vulkan/tear/tearing.h"

#include "physics/stretch/stretch_law.h"
#include "solver/model/opened_cloth.h"
#include "solver/model/tear_cloth.h"
#include "vulkan/primitives/recorder.h"
#include "vulkan/tear/args.data.h"

#include <cstring>

namespace weft::vulkan {
namespace {

static_assert(sizeof(TearKindIn) == 56 && sizeof(TearHead) == 16 && sizeof(TearOpeningIn) == 16);
static_assert(WEFT_TEAR_GROUP == WEFT_GROUP);
static_assert(WEFT_TEAR_KINDS == scalar::tear_kinds.size());

// What the shaders read, as arrays of numbers.
struct TearArrays {
    std::vector<std::uint32_t> entries, vertex, row_items;
    std::vector<float> numbers, half_fields, mass, face_mass, strayed;
    std::vector<std::uint32_t> settled;
    std::array<std::vector<std::uint32_t>, WEFT_TEAR_KINDS> corners;

    explicit TearArrays(const ClothModel& model) {
        const TearTable& table = *model.tears;
        const TearLaw& law = *model.tear_law;
        for (const TearTable::Entry& e : table.entries)
            entries.insert(entries.end(), {e.vertex, e.corner, e.next, e.far, e.next_far, e.twin});
        for (const TearLaw::Entry& e : law.entries)
            numbers.insert(numbers.end(), {e.turn[0], e.turn[1], e.angle, e.length, e.along[0], e.along[1]});
        const std::uint32_t vertices = table.vertex_count(), all = model.particle_count + model.reserve;
        for (std::uint32_t v = 0; v < vertices; ++v) vertex.push_back(v);
        for (const std::uint32_t from : model.copied_from) vertex.push_back(vertex[from]);
        vertex.resize(all);
        mass.assign(model.mass.begin(), model.mass.end());
        mass.resize(all);
        face_mass = face_masses(model);
        strayed.assign(model.strayed.begin(), model.strayed.end());
        strayed.resize(vertices);
        for (const TearTable::RowRef& ref : table.rows_at.items)
            row_items.push_back(scalar::tear_kind(ref.kind) << WEFT_TEAR_ROW_BITS | ref.row);
        const OpenedArrays opened(model);
        settled.assign(opened.settled.begin(), opened.settled.end());
        for (std::uint32_t kind = 0; kind < WEFT_TEAR_KINDS; ++kind) add_kind(model, kind);
        add_halves(model);
    }

  private:
    // Removed stretch constraints keep their particles, so shaders know them by their missing corners.
    void add_kind(const ClothModel& model, std::uint32_t kind) {
        const ConstraintTable& constraints = model.table(scalar::tear_kinds[kind]);
        corners[kind] = model.tears->rows[static_cast<std::size_t>(scalar::tear_kinds[kind])].corners;
        if (kind != scalar::WEFT_TEAR_STRETCH) return;
        for (std::uint32_t row = 0; row < constraints.stride; ++row)
            if (constraints.geometry[std::size_t{constraints.stride} + row] < 0) corners[kind][row] = none;
    }
    // Both compliances of both halves of each stretch constraint, while its edge is open.
    void add_halves(const ClothModel& model) {
        const ConstraintTable& table = model.table(ConstraintKind::stretch);
        const StretchLaw law(model.fabric.stretch);
        const std::size_t stride = table.stride, half = table.second_halves;
        half_fields.resize(4 * half);
        for (std::size_t row = 0; row < half; ++row) {
            if (!table.is_dummy(table.particles[half + row])) {  // it is open
                for (std::size_t k = 0; k < 2; ++k) {
                    half_fields[4 * row + k] = table.fields[(k + 1) * stride + row];
                    half_fields[4 * row + 2 + k] = table.fields[(k + 1) * stride + half + row];
                }
                continue;
            }
            const float cos2 = table.geometry[row], strip = table.geometry[stride + row],
                        first = model.tears->first_part[row];
            if (strip < 0) continue;
            const auto one = scalar::half_of_edge(*model.tears, law, row, true, cos2, strip * first);
            const auto other = scalar::half_of_edge(*model.tears, law, row, false, cos2, strip * (1 - first));
            half_fields[4 * row] = one.stretched, half_fields[4 * row + 1] = one.compressed;
            half_fields[4 * row + 2] = other.stretched, half_fields[4 * row + 3] = other.compressed;
        }
    }
};

}  // namespace

Result<std::unique_ptr<Tearing>> Tearing::create(gpu::Device& device, Programs& programs,
                                                 std::span<const ClothState* const> cloths, const std::string& name) {
    auto self = std::unique_ptr<Tearing>(new Tearing(device, programs));
    for (std::size_t i = 0; i < cloths.size(); ++i) {
        if (!cloths[i]->model().tear_law) continue;
        if (auto added = self->add(*cloths[i], i, name); !added) return added.errors();
    }
    if (self->torn_.empty()) return std::unique_ptr<Tearing>();
    return self;
}

Result<void> Tearing::add(const ClothState& cloth, std::size_t member, const std::string& name) {
    auto made = std::make_unique<Torn>();
    Torn& torn = *made;
    const ClothModel& model = cloth.model();
    const ModelBuffers& buffers = cloth.buffers();
    const TearTable& table = *model.tears;
    const TearLaw& law = *model.tear_law;
    const TearArrays arrays(model);
    constexpr std::uint64_t word = sizeof(std::uint32_t);
    const std::uint64_t all = torn.particles = model.particle_count + model.reserve;
    torn.member = member;

    Arena& arena = torn.arena;
    TearData data{};
    std::vector<std::pair<std::uint64_t*, Slot>> slots;
    const auto put = [&](std::uint64_t& address, Slot slot) { slots.push_back({&address, slot}); };
    put(data.ring, arena.add_array(table.ring_begin)), put(data.entries, arena.add_array(arrays.entries));
    put(data.numbers, arena.add_array(arrays.numbers)), put(data.sides, arena.add_array(law.sides));
    put(data.area, arena.add_array(law.area)), put(data.face_mass, arena.add_array(arrays.face_mass));
    put(data.mass, arena.add_array(arrays.mass)), put(data.vertex, arena.add_array(arrays.vertex));
    put(data.strayed, arena.add_array(arrays.strayed)), put(data.watched, arena.reserve(all * word));
    put(data.loads, arena.reserve(all * sizeof(Vec4))), put(data.chosen, arena.reserve(all * word));
    put(data.list, arena.reserve(all * word)), put(data.fan, arena.reserve(table.entries.size() * word));
    put(data.vertices, arena.add_array(table.vertices)), put(data.watch, arena.add_array(law.watch));
    put(data.inverse_resistance, arena.add_array(law.inverse_resistance));
    if (!law.seams.empty()) put(data.seams, arena.add_array(law.seams));
    if (!law.couplings.empty()) put(data.couplings, arena.add_array(law.couplings));
    if (!arrays.settled.empty()) put(data.settled, arena.add_array(arrays.settled));
    put(data.row_begin, arena.add_array(table.rows_at.offsets));
    put(data.row_items, arena.add_array(arrays.row_items)), put(data.second, arena.add_array(table.second));
    put(data.half_fields, arena.add_array(arrays.half_fields));
    std::array<TearKindIn, WEFT_TEAR_KINDS> kinds{};
    for (std::uint32_t kind = 0; kind < WEFT_TEAR_KINDS; ++kind) {
        const ConstraintTable& constraints = model.table(scalar::tear_kinds[kind]);
        const auto index = static_cast<std::size_t>(scalar::tear_kinds[kind]);
        TearKindIn& in = kinds[kind];
        in.particles = buffers.address(buffers.tables[index].particles);
        in.fields = buffers.address(buffers.tables[index].fields);
        in.stride = constraints.stride, in.arity = constraints.arity;
        in.field_count = constraints.field_count, in.first_dummy = constraints.first_dummy;
        put(in.corners, arena.add_array(arrays.corners[kind]));
        put(in.tie_begin, arena.add_array(table.rows[index].tie_begin));
        put(in.ties, arena.add_array(table.rows[index].ties));
    }
    torn.head = arena.reserve(sizeof(TearHead));
    torn.log = arena.reserve(std::max<std::uint64_t>(model.reserve, 1) * sizeof(TearOpeningIn));
    if (auto built = arena.build(device_, "tearing of " + name); !built) return built;
    for (const auto& [address, slot] : slots) *address = arena.address(slot);
    data.head = arena.address(torn.head), data.log = arena.address(torn.log);

    const auto stretch = static_cast<std::size_t>(ConstraintKind::stretch);
    data.faces = buffers.address(buffers.faces);
    data.blocks = buffers.address(buffers.tables[stretch].blocks);
    data.position = cloth.address(PointArray::position), data.start = cloth.address(PointArray::start);
    data.velocity = cloth.address(PointArray::velocity), data.compensation = cloth.address(PointArray::compensation);
    data.weights = cloth.address(cloth.weights);
    if (cloth.thickness.bytes > 0) data.thickness = cloth.address(cloth.thickness);
    data.stride = model.face_stride;
    data.block_count = static_cast<std::uint32_t>(model.table(ConstraintKind::stretch).blocks.size());
    data.halves = table.half_stride;
    data.first_particles = model.particle_count, data.all_particles = torn.particles;
    data.inverse_strength[0] = law.inverse_strength[0], data.inverse_strength[1] = law.inverse_strength[1];
    data.energy = law.tear_energy, data.inverse_stretch = law.inverse_stretch;
    data.watched_part = watched_part_of_load;
    data.erodes = model.reserved.erodes, data.has_seams = !law.seams.empty();
    data.has_couplings = !law.couplings.empty();
    const Slot of_kinds = torn.data_arena.add_array(kinds);
    torn.data = torn.data_arena.reserve(sizeof data);
    if (auto built = torn.data_arena.build(device_, "addresses of tearing of " + name); !built) return built;
    data.kinds = torn.data_arena.address(of_kinds);
    const auto bytes = std::as_bytes(std::span(&data, 1));
    if (auto written = upload(device_, torn.data_arena, torn.data, bytes); !written) return written;
    auto back =
        device_.memory().buffer(torn.head.bytes + torn.log.bytes, gpu::MemoryKind::readback, "tears of " + name);
    if (!back) return back.errors();
    torn.back = std::move(*back);
    torn_.push_back(std::move(made));
    return {};
}

Result<void> Tearing::record(gpu::Commands& commands, const Pass& pass) const {
    Recorder passes(device_, programs_, commands);
    for (const auto& torn : torn_) {
        const TearArgs args{torn->data_arena.address(torn->data)};
        const std::uint32_t groups = groups_of(torn->particles, WEFT_GROUP);
        if (pass.kind == PassKind::watch_tears) {
            passes.run("tear_watch", args, groups);
        } else {
            passes.run("tear_load", args, groups);
            passes.run("tear_open", args, 1);
        }
    }
    return passes.end();
}

void Tearing::record_end(gpu::Commands& commands) const {
    for (const auto& torn : torn_) {
        commands.copy(torn->arena.buffer(), torn->back, torn->head.bytes, torn->head.offset, 0);
        commands.copy(torn->arena.buffer(), torn->back, torn->log.bytes, torn->log.offset, torn->head.bytes);
    }
}

std::vector<Opening> Tearing::openings(std::size_t member) const {
    std::vector<Opening> openings;
    for (const auto& torn : torn_) {
        if (torn->member != member) continue;
        const std::byte* const bytes = torn->back.as<std::byte>().data();
        TearHead head;
        std::memcpy(&head, bytes, sizeof head);
        static_assert(sizeof(Opening) == sizeof(TearOpeningIn));
        if (head.openings == 0) return openings;
        openings.resize(head.openings);
        std::memcpy(openings.data(), bytes + torn->head.bytes, openings.size() * sizeof(Opening));
    }
    return openings;
}

}  // namespace weft::vulkan
