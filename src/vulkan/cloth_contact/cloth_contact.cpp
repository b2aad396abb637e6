#include "vulkan/cloth_contact/cloth_contact.h"

#include "solver/plan/cloth_contact_numbers.h"
#include "solver/state/contact_marks.h"
#include "solver/state/list_counts.h"
#include "vulkan/compiled_plan.h"
#include "vulkan/primitives/recorder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace weft::vulkan {
namespace {

// Sizes of the GLSL layout.
static_assert(sizeof(ContactTileIn) == 48 && sizeof(TrackedTile) == 64 && sizeof(ListedPair) == 32 &&
              sizeof(TangledPairIn) == 32);
static_assert(sizeof(ClothContactArgs) == 16);
static_assert(WEFT_TILE_VERTICES == tile_vertices && WEFT_TILE_EDGES == tile_edges &&
              WEFT_TILE_TRIANGLES == tile_triangles);
static_assert(WEFT_MARK_TOUCHES == mark_touches && WEFT_MARK_LIMITED == mark_limited &&
              WEFT_MARK_TANGLED == mark_tangled);
static_assert(WEFT_CONTACT_ROUNDS == contact_rounds && WEFT_CONTACT_EXTRA_SWEEPS == contact_extra_sweeps);
static_assert(static_cast<float>(WEFT_CAP_OF_SURFACE) == cap_of_surface &&
              static_cast<float>(WEFT_MOST_CARRIED) == most_carried);
static_assert(WEFT_LIMIT_SLIDES == limit_slides && WEFT_LIMIT_HALVINGS == limit_halvings);

// Part of the slack of lists by which contact may move particles. The rest is for the motion of the following substeps.
constexpr float contact_part_of_slack = 0.7f;

// The tiles of all cloths, as the shaders read them.
struct TileArrays {
    std::vector<ContactTileIn> tiles;
    std::vector<std::uint32_t> particles, edges, triangles;

    void add(const Tile& tile, const ClothModel& model, std::uint32_t cloth, std::uint32_t base, float slack) {
        const ContactMaterial& material = model.fabric.contact;
        const UnevenThickness uneven = uneven_pair_thickness(model);
        const std::span vertices(tile.particle.data(), tile.vertex_count);
        tiles.push_back(
            {.vertices = tile.vertex_count,
             .own_vertices = tile.own_vertices,
             .edges = tile.edge_count,
             .triangles = tile.triangle_count,
             .cloth = cloth,
             .thickness = uneven ? uneven.most_of(vertices) : pair_thickness(model),
             .static_friction = material.friction[0],
             .kinetic_friction = material.friction[1],
             .groups = model.collision.filter.groups,
             .collides_with = model.collision.filter.mask,
             .slack = slack,
             .kind = (model.collision.surface ? WEFT_TILE_OF_SURFACE : 0u) | (is_thin(model) ? WEFT_TILE_THIN : 0u)});
        for (const std::uint32_t p : tile.particle) particles.push_back(base + p);
        for (std::uint32_t e = 0; e < tile_edges; ++e) edges.push_back(tile.edge[0][e] | tile.edge[1][e] << 8);
        for (std::uint32_t t = 0; t < tile_triangles; ++t)
            triangles.push_back(tile.triangle[0][t] | tile.triangle[1][t] << 8 | tile.triangle[2][t] << 16);
    }
};

// Contact does not move the particles of surfaces, whatever it may do to those of cloths.
float cap_of(const ClothModel& model) {
    return model.collision.surface ? cap_of_surface : contact_cap(model);
}

// The slack of the lists of a cloth, m; infinite for surfaces.
float slack_of(const ClothModel& model) {
    return model.collision.surface ? cap_of_surface : contact_cap(model) / contact_part_of_slack;
}

/// What the shaders read of the cloths of a frame.
struct FrameArrays {
    TileArrays tiles;
    std::vector<Vec4> rest;               // by particle of the world; w: of cap_of()
    std::vector<float> thickness;         // m, by particle of the world; empty if all cloths are even
    std::vector<std::uint32_t> carrier;   // by particle: the surface to which it belongs, counted from 1; 0: none
    std::vector<std::uint64_t> carriers;  // poses of the surfaces
    std::vector<std::uint64_t> reports;
    std::uint64_t particles = 0;         // of cloths with contact
    std::uint64_t end = 0;               // of the particles of the world that shaders ask for
    std::uint64_t frame = 0;             // address of the inputs of any of the cloths
    float most_slack = 0, thickest = 0;  // m: of all tiles, of all cloths
    bool uneven = false;                 // whether the thickness of any cloth is

    explicit FrameArrays(std::span<const ClothContact::Member> members) {
        float least_slack = cap_of_surface;
        for (const ClothContact::Member& member : members)
            if (member.cloth->model().tiles) least_slack = std::min(least_slack, slack_of(member.cloth->model()));
        for (std::uint32_t m = 0; m < members.size(); ++m) {
            reports.push_back(members[m].report);
            if (members[m].cloth->model().tiles) add_tiles(members[m], m, least_slack);
        }
        rest.resize(end);
        if (uneven) thickness.resize(end);
        carrier.resize(end);
        for (const ClothContact::Member& member : members)
            if (member.cloth->model().tiles) add_particles(member);
    }

  private:
    void add_tiles(const ClothContact::Member& member, std::uint32_t number, float slack_of_surfaces) {
        const ClothState& cloth = *member.cloth;
        const ClothModel& model = cloth.model();
        const float slack = model.collision.surface ? slack_of_surfaces : slack_of(model);
        for (const Tile& tile : *model.tiles) tiles.add(tile, model, number, cloth.base(), slack);
        most_slack = std::max(most_slack, slack);
        thickest = std::max(thickest, pair_thickness(model));
        uneven = uneven || uneven_pair_thickness(model);
        frame = member.frame;
        particles += model.particle_count;
        end = std::max(end, std::uint64_t{cloth.base()} + model.capacity());
    }
    void add_particles(const ClothContact::Member& member) {
        const ClothModel& model = member.cloth->model();
        Vec4* const mine = &rest[member.cloth->base()];
        std::copy_n(model.rest_of_features(), model.particle_count, mine);
        for (std::uint32_t p = 0; p < model.particle_count; ++p) mine[p].w = cap_of(model);
        const UnevenThickness own = uneven_pair_thickness(model);
        for (std::uint32_t p = 0; uneven && p < model.particle_count; ++p)
            thickness[member.cloth->base() + p] = own ? own.at(p) : pair_thickness(model);
        if (member.poses == 0) return;
        carriers.push_back(member.poses);
        std::fill_n(&carrier[member.cloth->base()], model.particle_count, static_cast<std::uint32_t>(carriers.size()));
    }
};

/// Arrays of an arena whose addresses the shaders read from members of ContactData.
class AddressedSlots {
  public:
    using Address = std::uint64_t ContactData::*;
    void add(Address address, Slot slot) { slots_.push_back({address, slot}); }
    /// After the arena has been built.
    void write_addresses(const Arena& arena, ContactData& data) const {
        for (const auto& [address, slot] : slots_) data.*address = arena.address(slot);
    }

  private:
    struct Addressed {
        Address address;
        Slot slot;
    };
    std::vector<Addressed> slots_;
};

constexpr std::uint64_t word_bytes = sizeof(std::uint32_t);

void reserve_by_particle(Arena& arena, const FrameArrays& arrays, AddressedSlots& slots) {
    const std::uint64_t end = arrays.end;
    slots.add(&ContactData::reached, arena.reserve(end * sizeof(Vec4)));
    slots.add(&ContactData::asked, arena.reserve(end * sizeof(Vec4)));
    slots.add(&ContactData::rest, arena.add_array(arrays.rest));
    if (arrays.uneven) slots.add(&ContactData::thickness, arena.add_array(arrays.thickness));
    slots.add(&ContactData::share, arena.reserve(end * word_bytes));
    slots.add(&ContactData::sums, arena.reserve(4 * end * word_bytes));
    slots.add(&ContactData::scaled_sums, arena.reserve(4 * end * word_bytes));
    slots.add(&ContactData::part, arena.reserve(end * word_bytes));
    slots.add(&ContactData::retreats, arena.reserve(end * word_bytes));
    slots.add(&ContactData::slide, arena.reserve(end * sizeof(Vec4)));
    slots.add(&ContactData::marks, arena.reserve(end * word_bytes));
    slots.add(&ContactData::carrier, arena.add_array(arrays.carrier));
    slots.add(&ContactData::next_carrier, arena.reserve(end * word_bytes));
    slots.add(&ContactData::carriers, arena.add_array(arrays.carriers));
}

void reserve_by_tile(Arena& arena, const FrameArrays& arrays, std::uint64_t groups, AddressedSlots& slots) {
    const std::uint64_t tiles = arrays.tiles.tiles.size(), vertices = tiles * tile_vertices;
    slots.add(&ContactData::tiles, arena.add_array(arrays.tiles.tiles));
    slots.add(&ContactData::tracked, arena.reserve(tiles * sizeof(TrackedTile)));
    slots.add(&ContactData::places, arena.reserve(vertices * sizeof(Vec4)));
    slots.add(&ContactData::velocities, arena.reserve(vertices * sizeof(Vec4)));
    slots.add(&ContactData::particles, arena.add_array(arrays.tiles.particles));
    slots.add(&ContactData::edges, arena.add_array(arrays.tiles.edges));
    slots.add(&ContactData::triangles, arena.add_array(arrays.tiles.triangles));
    slots.add(&ContactData::groups, arena.reserve(2 * groups * sizeof(Vec4)));
}

void reserve_lists(Arena& arena, const ClothContactRoom& room, AddressedSlots& slots) {
    slots.add(&ContactData::tile_pairs, arena.reserve(2 * word_bytes * room.tile_pairs));
    slots.add(&ContactData::listed, arena.reserve(2 * sizeof(ListedPair) * room.listed));
    for (const AddressedSlots::Address near :
         {&ContactData::near_particles, &ContactData::near_weights, &ContactData::near_normals,
          &ContactData::near_starts, &ContactData::near_pushes})
        slots.add(near, arena.reserve(2 * sizeof(Vec4) * room.near));
    slots.add(&ContactData::near_kinds, arena.reserve(2 * word_bytes * room.near));
}

void set_numbers(const FrameArrays& arrays, const ClothContactRoom& room, ContactData& data) {
    data.frame = arrays.frame;
    data.report_count = static_cast<std::uint32_t>(arrays.reports.size());
    data.tile_pair_capacity = room.tile_pairs, data.listed_capacity = room.listed, data.near_capacity = room.near;
    data.thickest = arrays.thickest, data.most_slack = arrays.most_slack;
    data.cap_part = contact_part_of_slack;
    data.recovery_speed = contact_recovery_speed, data.gap_floor = contact_gap_floor, data.split = contact_split;
    data.brake_depth = contact_brake_depth, data.most_aside = limit_aside;
    data.carry_margin = limit_carry_margin;
}

std::uint32_t in_proportion(std::uint64_t items, double each) {
    return static_cast<std::uint32_t>(std::min(64 + static_cast<double>(items) * each, double{most_list_rows}));
}

/// Records one pass after another.
class PassRecorder {
  public:
    PassRecorder(gpu::Device& device, Programs& programs, gpu::Commands& commands, const Arena& arena, Slot head,
                 std::uint64_t data)
        : device_(device), programs_(programs), commands_(commands), arena_(arena), head_(head), data_(data) {}

    void on(std::uint32_t search) { search_ = search; }
    void round(std::uint32_t round) { round_ = round; }
    void run(std::string_view program, std::uint32_t groups) {
        if (bind(program)) dispatch_groups(commands_, groups, device_.limits());
    }
    /// Passes that compute the numbers of workgroups of later ones.
    void run_single(std::string_view program) {
        run(program, 1);
        counted_ = true;
    }
    /// One invocation per item.
    void run_each(std::string_view program, std::uint32_t items) {
        if (const gpu::Pipeline* pipeline = bind(program))
            dispatch_groups(commands_, groups_of(items, pipeline->workgroup()), device_.limits());
    }
    /// As many workgroups as the member of ContactHead at this offset says.
    void run_indirect(std::string_view program, std::size_t groups, bool barrier = true) {
        if (bind(program, barrier)) commands_.dispatch_indirect(arena_.buffer(), head_.offset + groups);
    }
    void run_near(std::string_view program) {
        run_indirect(program, search_ == WEFT_SEARCH_MOTION ? offsetof(ContactHead, near_groups0)
                                                            : offsetof(ContactHead, near_groups1));
    }
    Result<void> end() const {
        if (!errors_.empty()) return errors_;
        return {};
    }

  private:
    /// The pipeline, or null if it cannot be made.
    const gpu::Pipeline* bind(std::string_view program, bool barrier = true) {
        auto pipeline = programs_.get(program);
        if (!pipeline) {
            errors_.insert(errors_.end(), pipeline.errors().begin(), pipeline.errors().end());
            return nullptr;
        }
        const ClothContactArgs args{.data = data_, .round = round_, .search = search_};
        if (barrier) {
            counted_ ? commands_.indirect_barrier() : commands_.barrier();
            counted_ = false;
        }
        commands_.bind(**pipeline);
        commands_.push(std::as_bytes(std::span(&args, 1)));
        return *pipeline;
    }

    gpu::Device& device_;
    Programs& programs_;
    gpu::Commands& commands_;
    const Arena& arena_;
    Slot head_;
    std::uint64_t data_;
    std::uint32_t search_ = WEFT_SEARCH_MOTION, round_ = 0;
    bool counted_ = true;  ///< the pass before may have written numbers of workgroups
    Errors errors_;
};

// `round`: 1 for the search after the brake.
void record_search(PassRecorder& passes, std::uint32_t search, std::uint32_t tiles, std::uint32_t groups,
                   std::uint32_t round = 0) {
    passes.on(search), passes.round(round);
    passes.run("contact_track", tiles);
    passes.run("contact_bound_group", groups);
    passes.run("contact_pair_tiles", tiles);
    passes.run_single("contact_begin_search");
    passes.run_indirect("contact_keep", offsetof(ContactHead, keep_groups));
    passes.run_indirect("contact_list", offsetof(ContactHead, list_groups), false);
    passes.run_single("contact_end_search");
    passes.run_indirect("contact_near", offsetof(ContactHead, listed_groups));
    passes.run_single("contact_end_near");
}

void record_untangle(PassRecorder& passes, std::uint32_t pairs, std::uint32_t tiles) {
    passes.run_each("contact_share_untangling", pairs);
    passes.run_each("contact_push_untangling", pairs);
    passes.run("contact_untangle", tiles);
}

void record_sweep(PassRecorder& passes, std::uint32_t round, std::uint32_t tiles) {
    passes.round(round);
    passes.run_near("contact_overlaps");
    passes.run_near("contact_pushes");
    passes.run_near("contact_scale");
    passes.run("contact_move", tiles);
}

void record_brake(PassRecorder& passes, std::uint32_t tiles, std::uint32_t groups) {
    passes.run_near("contact_find_deep");
    passes.run("contact_brake", tiles);
    passes.run_single("contact_end_brake");
    record_search(passes, WEFT_SEARCH_MOTION, tiles, groups, 1);
}

void record_limit(PassRecorder& passes, std::uint32_t search, std::uint32_t tiles) {
    passes.on(search);
    for (std::uint32_t round = 0; round < WEFT_LIMIT_ROUNDS; ++round) {
        passes.round(round);
        passes.run_near("contact_find_lost");
        passes.run("contact_send_back", tiles);
    }
    passes.run("contact_finish_limit", 1);
}

}  // namespace

ClothContactRoom ClothContactRoom::for_cloths(std::uint64_t tiles, std::uint64_t particles,
                                              std::uint32_t list_capacity) {
    const double each = static_cast<double>(list_capacity) / default_list_capacity;
    return {in_proportion(tiles, 24 * each), in_proportion(particles, 32 * each), in_proportion(particles, 8 * each)};
}

ClothContactRoom ClothContactRoom::with(const ClothContactRoom& other) const {
    return {std::max(tile_pairs, other.tile_pairs), std::max(listed, other.listed), std::max(near, other.near),
            std::max(tangled, other.tangled), std::max(tangle_near, other.tangle_near)};
}

ClothContactRoom ClothContactRoom::grown(const ClothContactRoom& wanted) const {
    const auto grow = [](std::uint32_t room, std::uint32_t more) {
        return more <= room ? room : grown_list_capacity(more);
    };
    return {grow(tile_pairs, wanted.tile_pairs), grow(listed, wanted.listed), grow(near, wanted.near), tangled,
            tangle_near};
}

ClothContactRoom ClothContactRoom::for_tangle(const Tangle* tangle) const {
    ClothContactRoom room = *this;
    const auto capacity = [](std::size_t count) { return grown_list_capacity(static_cast<std::uint32_t>(count)); };
    room.tangled = tangle ? std::max(tangled, capacity(tangle->pairs.size())) : 0;
    room.tangle_near = tangle ? std::max(tangle_near, capacity(tangle->near.size())) : 0;
    return room;
}

Result<std::unique_ptr<ClothContact>> ClothContact::create(gpu::Device& device, Programs& programs,
                                                           std::span<const Member> members,
                                                           const ClothContactRoom& room, std::uint32_t list_capacity,
                                                           bool search_always, bool records_marks,
                                                           const std::string& name) {
    auto self = std::unique_ptr<ClothContact>(new ClothContact(device, programs));
    self->room_ = room;
    if (auto built = self->build(members, list_capacity, search_always, records_marks, name); !built)
        return built.errors();
    return self;
}

Result<void> ClothContact::build(std::span<const Member> members, std::uint32_t list_capacity, bool search_always,
                                 bool records_marks, const std::string& name) {
    const FrameArrays arrays(members);
    tiles_ = static_cast<std::uint32_t>(arrays.tiles.tiles.size());
    groups_ = groups_of(tiles_, WEFT_TILES_TOGETHER);
    room_ = room_.with(ClothContactRoom::for_cloths(tiles_, arrays.particles, list_capacity));
    std::vector<const Seams*> of_members;
    for (const Member& member : members) of_members.push_back(member.seams);
    const SeamArrays seams(of_members, arrays.end);

    AddressedSlots slots;
    reserve_by_particle(arena_, arrays, slots);
    reserve_by_tile(arena_, arrays, groups_, slots);
    reserve_lists(arena_, room_, slots);
    slots.add(&ContactData::reports, arena_.add_array(arrays.reports));
    slots.add(&ContactData::seam_first, arena_.add_array(seams.first()));
    slots.add(&ContactData::seam_entries, arena_.add_array(seams.entries()));
    if (records_marks) marks_ = arena_.reserve(arrays.end * word_bytes);
    slots.add(&ContactData::contact_marks, marks_);
    head_ = arena_.reserve(sizeof(ContactHead));
    slots.add(&ContactData::head, head_);
    if (auto built = arena_.build(device_, "cloth contact of " + name, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT); !built)
        return built;
    if (auto made = make_readback(name); !made) return made;

    ContactData data{};
    slots.write_addresses(arena_, data);
    const WorldParticles& world = members.front().cloth->world();
    data.position = world.address(PointArray::position, 0);
    data.start = world.address(PointArray::start, 0);
    data.velocity = world.address(PointArray::velocity, 0);
    set_numbers(arrays, room_, data);
    data.tile_count = tiles_, data.group_count = groups_;
    data.widest = device_.limits().workgroup_count[0];
    data.search_always = search_always ? 1 : 0;
    data.records_marks = records_marks ? 1 : 0;
    data.has_seams = seams.empty() ? 0 : 1;
    if (auto made = make_tangle(data, arrays.end, name); !made) return made;
    data_ = data_arena_.add(std::as_bytes(std::span(&data, 1)));
    return data_arena_.build(device_, "cloth contact addresses of " + name);
}

Result<void> ClothContact::make_readback(const std::string& name) {
    auto back = device_.memory().buffer(sizeof(ContactHead), gpu::MemoryKind::readback, "counts of " + name);
    if (!back) return back.errors();
    back_ = std::move(*back);
    if (marks_.bytes == 0) return {};
    auto marks_back = device_.memory().buffer(marks_.bytes, gpu::MemoryKind::readback, "contact marks of " + name);
    if (!marks_back) return marks_back.errors();
    marks_back_ = std::move(*marks_back);
    return {};
}

Result<void> ClothContact::make_tangle(ContactData& data, std::uint64_t particles, const std::string& name) {
    data.untangles = room_.tangled > 0 ? 1 : 0;
    data.untangling_speed = untangling_speed;
    if (room_.tangled == 0) return {};
    constexpr std::uint64_t pairs = 16;  // the count before them takes as much, for the alignment
    tangle_first_ = pairs + std::uint64_t{room_.tangled} * sizeof(TangledPairIn);
    tangle_near_ = tangle_first_ + (particles + 1) * sizeof(std::uint32_t);
    const std::uint64_t bytes = tangle_near_ + std::uint64_t{room_.tangle_near} * sizeof(std::uint32_t);
    auto upload = device_.memory().buffer(bytes, gpu::MemoryKind::upload, "upload of the tangle of " + name);
    if (!upload) return upload.errors();
    tangle_upload_ = std::move(*upload);
    auto buffer = device_.memory().buffer(bytes, gpu::MemoryKind::device, "tangle of " + name);
    if (!buffer) return buffer.errors();
    tangle_ = std::move(*buffer);
    data.tangled_count = tangle_.address(), data.tangled = tangle_.address() + pairs;
    data.tangle_first = tangle_.address() + tangle_first_, data.tangle_near = tangle_.address() + tangle_near_;
    return {};
}

void ClothContact::set_tangle(const Tangle* tangle) {
    if (room_.tangled == 0) return;
    std::byte* to = tangle_upload_.mapped().data();
    const auto count = static_cast<std::uint32_t>(tangle->pairs.size());
    std::memcpy(to, &count, sizeof(count));
    std::vector<TangledPairIn> pairs;
    for (const TangledPair& pair : tangle->pairs) {
        const auto [a, b, c, d, e] = pair.particle;
        pairs.push_back({a, b, c, d, e, pair.direction.x, pair.direction.y, pair.direction.z});
    }
    const auto copy = [&](std::uint64_t offset, const auto& array) {
        std::memcpy(to + offset, array.data(), array.size() * sizeof(array[0]));
    };
    copy(16, pairs), copy(tangle_first_, tangle->first), copy(tangle_near_, tangle->near);
}

void ClothContact::record_begin(gpu::Commands& commands) const {
    if (room_.tangled > 0) commands.copy(tangle_upload_, tangle_, tangle_.size());
    if (marks_.bytes > 0) commands.fill(arena_.buffer(), 0, marks_.bytes, marks_.offset);
}

Result<void> ClothContact::record(gpu::Commands& commands, const Pass& pass, std::uint32_t substep) const {
    PassRecorder passes(device_, programs_, commands, arena_, head_, data_arena_.address(data_));
    switch (pass.kind) {
        case PassKind::detect:
            passes.round(substep);
            passes.run_single("contact_begin");
            if (room_.tangled > 0) record_untangle(passes, room_.tangled, tiles_);
            record_search(passes, WEFT_SEARCH_MOTION, tiles_, groups_);
            record_brake(passes, tiles_, groups_);
            break;
        case PassKind::cloth_contact:
            if (pass.batch > 0) passes.run("contact_clamp", tiles_);
            record_sweep(passes, pass.batch, tiles_);
            if (pass.batch + 1 < contact_rounds) break;
            for (std::uint32_t k = 0; k < WEFT_CONTACT_EXTRA_SWEEPS; ++k)
                record_sweep(passes, contact_rounds + k, tiles_);
            break;
        case PassKind::limit:
            passes.run("contact_ask", tiles_);
            record_limit(passes, WEFT_SEARCH_MOTION, tiles_);
            passes.run("contact_check", tiles_);
            passes.run("contact_ask_again", tiles_);
            record_search(passes, WEFT_SEARCH_ANYWHERE, tiles_, groups_);
            record_limit(passes, WEFT_SEARCH_ANYWHERE, tiles_);
            passes.run("contact_count", tiles_);
            break;
        default:
            passes.run_near("contact_share_speeds");
            passes.run_near("contact_take_speeds");
            passes.run("contact_slow", tiles_);
            break;
    }
    return passes.end();
}

Result<void> ClothContact::record_end(gpu::Commands& commands) const {
    commands.copy(arena_.buffer(), back_, sizeof(ContactHead), head_.offset, 0);
    if (marks_.bytes == 0) return {};
    PassRecorder passes(device_, programs_, commands, arena_, head_, data_arena_.address(data_));
    passes.run_near("contact_mark_touching");
    commands.barrier();
    commands.copy(arena_.buffer(), marks_back_, marks_.bytes, marks_.offset, 0);
    return passes.end();
}

ClothContactRoom ClothContact::wanted() const {
    const ContactHead& head = back_.as<ContactHead>()[0];
    return {.tile_pairs = head.wanted_tile_pairs, .listed = head.wanted_listed, .near = head.wanted_near};
}

ClothContactCounts ClothContact::counts() const {
    const ContactHead& head = back_.as<ContactHead>()[0];
    return {.contacts = head.contacts,
            .searches = head.searches,
            .limited = head.limited,
            .tangled = head.tangled,
            .tangled_particle = head.tangled > 0 ? head.tangled_particle : no_particle};
}

void ClothContact::add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const {
    const auto recorded = marks_back_.as<const std::uint32_t>();
    for (std::size_t i = 0; i < marks.size() && base + i < recorded.size(); ++i) marks[i] |= recorded[base + i];
}

}  // namespace weft::vulkan
