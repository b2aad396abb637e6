#include "vulkan/particle_contact/particle_contact.h"

#include "solver/plan/particle_contact_numbers.h"
#include "solver/state/contact_marks.h"
#include "solver/state/list_counts.h"
#include "vulkan/primitives/recorder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::vulkan {
namespace {

static_assert(sizeof(SphereTileIn) == 32 && sizeof(SpherePairIn) == 16 && sizeof(ParticleContactArgs) == 24);
static_assert(WEFT_PARTICLE_GROUP == WEFT_GROUP);

// Workgroups of a pass over the listed pairs at most: enough to fill a device.
constexpr std::uint32_t most_pair_groups = 4096;

// The tiles of all cloths, as the shaders read them.
struct SphereArrays {
    std::vector<SphereTileIn> tiles;
    std::vector<std::uint32_t> particles;
    std::vector<Vec4> rest, friction;

    void add(const ClothModel& model, std::uint32_t cloth, std::uint32_t base) {
        const std::vector<std::uint32_t>& order = *model.along_curve;
        const auto size = static_cast<std::uint32_t>(order.size());
        const UnevenThickness uneven = uneven_diameters(model);
        for (std::uint32_t begin = 0; begin < size; begin += WEFT_PARTICLE_TILE) {
            tiles.push_back({.count = std::min<std::uint32_t>(WEFT_PARTICLE_TILE, size - begin),
                             .cloth = cloth,
                             .with_alike = model.collision.with_cloth == SelfCollision::fast,
                             .groups = model.collision.filter.groups,
                             .collides_with = model.collision.filter.mask,
                             .diameter = 0,
                             .margin = particle_margin(model),
                             .less_at_rest = particle_less_at_rest(model)});
            float& largest = tiles.back().diameter = 0;
            for (std::uint32_t i = begin; i < begin + WEFT_PARTICLE_TILE; ++i) {
                const std::uint32_t p = order[std::min(i, size - 1)];
                particles.push_back(base + p);
                const Vec4 x = model.start[p];
                rest.push_back({x.x, x.y, x.z, uneven ? uneven.at(p) : particle_diameter(model)});
                largest = std::max(largest, rest.back().w);
            }
        }
        const auto& [of_rest, of_motion] = model.fabric.contact.friction;
        const std::uint32_t end = groups_of(base + model.particle_count, WEFT_PARTICLE_BLOCK);
        if (friction.size() < end) friction.resize(end);
        for (std::uint32_t block = base / WEFT_PARTICLE_BLOCK; block < end; ++block)
            friction[block] = {std::sqrt(of_rest), std::sqrt(of_motion), 0, 0};
    }
};

}  // namespace

Result<std::unique_ptr<ParticleContact>> ParticleContact::create(gpu::Device& device, Programs& programs,
                                                                 std::span<const Member> members,
                                                                 std::uint32_t capacity, std::uint32_t first_capacity,
                                                                 bool search_always, bool records_marks,
                                                                 const std::string& name) {
    auto self = std::unique_ptr<ParticleContact>(new ParticleContact(device, programs));
    self->capacity_ = capacity;
    if (auto built = self->build(members, first_capacity, search_always, records_marks, name); !built)
        return built.errors();
    return self;
}

Result<void> ParticleContact::build(std::span<const Member> members, std::uint32_t first_capacity, bool search_always,
                                    bool records_marks, const std::string& name) {
    SphereArrays arrays;
    std::vector<std::uint64_t> reports;
    std::uint64_t end = 0;
    SphereData data{};
    for (std::uint32_t m = 0; m < members.size(); ++m) {
        const ClothState& cloth = *members[m].cloth;
        reports.push_back(members[m].report);
        if (!cloth.model().along_curve) continue;
        arrays.add(cloth.model(), m, cloth.base());
        data.frame = members[m].frame;
        end = std::max(end, std::uint64_t{cloth.base()} + cloth.model().capacity());
    }
    tiles_ = static_cast<std::uint32_t>(arrays.tiles.size());
    const double pairs = 8.0 * WEFT_PARTICLE_TILE * tiles_ * first_capacity / default_list_capacity;
    capacity_ = std::max(capacity_, static_cast<std::uint32_t>(std::min(64 + pairs, double{most_list_rows})));

    std::vector<const Seams*> of_members;
    for (const Member& member : members) of_members.push_back(member.seams);
    const SeamArrays seams(of_members, end);

    constexpr std::uint64_t word = sizeof(std::uint32_t);
    const Slot friction = arena_.add_array(arrays.friction), pushes = arena_.reserve(end * word),
               sums = arena_.reserve(4 * end * word), particles = arena_.add_array(arrays.particles),
               rest = arena_.add_array(arrays.rest), listed = arena_.reserve(arrays.rest.size() * sizeof(Vec4)),
               boxes = arena_.reserve(2 * tiles_ * sizeof(Vec4)), tiles = arena_.add_array(arrays.tiles),
               all_pairs = arena_.reserve(sizeof(SpherePairIn) * capacity_), all_reports = arena_.add_array(reports);
    const Slot seam_first = arena_.add_array(seams.first()), seam_entries = arena_.add_array(seams.entries());
    head_ = arena_.reserve(sizeof(SphereHead));
    if (auto built = arena_.build(device_, "particle contact of " + name); !built) return built;
    auto back = device_.memory().buffer(sizeof(SphereHead), gpu::MemoryKind::readback, "counts of " + name);
    if (!back) return back.errors();
    back_ = std::move(*back);
    pushes_ = pushes;
    if (records_marks) {
        auto marks = device_.memory().buffer(pushes.bytes, gpu::MemoryKind::readback, "contact marks of " + name);
        if (!marks) return marks.errors();
        pushes_back_ = std::move(*marks);
    }

    const WorldParticles& world = members.front().cloth->world();
    data.position = world.address(PointArray::position, 0);
    data.start = world.address(PointArray::start, 0);
    data.friction = arena_.address(friction);
    data.pushes = arena_.address(pushes), data.sums = arena_.address(sums);
    data.particles = arena_.address(particles), data.rest = arena_.address(rest);
    data.listed = arena_.address(listed), data.boxes = arena_.address(boxes);
    data.tiles = arena_.address(tiles), data.pairs = arena_.address(all_pairs);
    data.head = arena_.address(head_), data.reports = arena_.address(all_reports);
    data.tile_count = tiles_, data.capacity = capacity_;
    data.report_count = static_cast<std::uint32_t>(reports.size());
    data.part_at_rest = particle_part_at_rest;
    data.search_always = search_always ? 1 : 0;
    data.seam_first = arena_.address(seam_first), data.seam_entries = arena_.address(seam_entries);
    data.has_seams = seams.empty() ? 0 : 1;
    data_ = data_arena_.add(std::as_bytes(std::span(&data, 1)));
    return data_arena_.build(device_, "particle contact addresses of " + name);
}

Result<void> ParticleContact::record(gpu::Commands& commands, const Pass& pass, std::uint32_t substep) const {
    Recorder passes(device_, programs_, commands);
    const ParticleSweep& sweep = particle_sweeps[pass.kind == PassKind::push_particles ? pass.batch : 0];
    const ParticleContactArgs args{.data = data_arena_.address(data_),
                                   .first_of_frame = substep == 0 ? 1u : 0u,
                                   .deep = sweep.deep,
                                   .recovery_speed = sweep.recovery_speed,
                                   .split = sweep.split};
    const std::uint32_t of_particles = groups_of(tiles_ * WEFT_PARTICLE_TILE, WEFT_PARTICLE_GROUP);
    const std::uint32_t of_pairs = std::min(groups_of(capacity_, WEFT_PARTICLE_GROUP), most_pair_groups);
    switch (pass.kind) {
        case PassKind::track_particles:
            passes.run("spheres_track", args, of_particles);
            break;
        case PassKind::search_particles:
            passes.run("spheres_bound", args, groups_of(tiles_, WEFT_PARTICLE_GROUP));
            break;
        case PassKind::list_particles:
            passes.run("spheres_list", args, tiles_);
            break;
        case PassKind::overlap_particles:
            passes.run("spheres_overlap", args, of_pairs);
            break;
        case PassKind::push_particles:
            passes.run("spheres_push", args, of_pairs);
            break;
        case PassKind::move_particles:
            passes.run("spheres_move", args, of_particles);
            break;
        case PassKind::hold_particles:
            passes.run("spheres_hold", args, of_pairs);
            break;
        default:
            passes.run("spheres_settle", args, of_particles);
            break;
    }
    return passes.end();
}

void ParticleContact::record_end(gpu::Commands& commands) const {
    commands.copy(arena_.buffer(), back_, sizeof(SphereHead), head_.offset, 0);
    if (pushes_back_.size() > 0) commands.copy(arena_.buffer(), pushes_back_, pushes_.bytes, pushes_.offset, 0);
}

void ParticleContact::add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const {
    const auto pushes = pushes_back_.as<const std::uint32_t>();
    for (std::size_t i = 0; i < marks.size() && base + i < pushes.size(); ++i)
        if (pushes[base + i] > 0) marks[i] |= mark_touches;
}

ClothContactCounts ParticleContact::counts() const {
    return {.contacts = counted().contacts, .searches = counted().searches};
}

}  // namespace weft::vulkan
