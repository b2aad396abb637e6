#include "cpu/face_contacts.h"

#include "physics/scalar.h"

#include <algorithm>
#include <atomic>

namespace weft::cpu {
namespace {

constexpr float meters_per_quantum = static_cast<float>(1.0 / WEFT_PUSH_QUANTA_PER_METER);

constexpr std::size_t blocks_per_contact = 7;

struct FaceTarget {
    FaceSum* sums;
    std::vector<std::uint32_t>* pushed;
};

// One more than the length, so that it is not 0.
std::uint32_t length_of_push(const std::int32_t* quanta) {
    return static_cast<std::uint32_t>(quanta[3]) + 1;
}

void add_alone(const FaceSums& to, std::uint32_t particle, const std::int32_t* quanta) {
    const auto& [sums, pushed] = *static_cast<const FaceTarget*>(to.sums);
    FaceSum& sum = sums[particle];
    if (sum[3] == 0) pushed->push_back(particle);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += static_cast<std::uint32_t>(quanta[axis]);
    sum[3] = std::max(sum[3], length_of_push(quanta));
}

// While other threads do so too.
void add_shared(const FaceSums& to, std::uint32_t particle, const std::int32_t* quanta) {
    const auto& [sums, pushed] = *static_cast<const FaceTarget*>(to.sums);
    FaceSum& sum = sums[particle];
    for (std::size_t axis = 0; axis < 3; ++axis)
        std::atomic_ref(sum[axis]).fetch_add(static_cast<std::uint32_t>(quanta[axis]), std::memory_order_relaxed);
    std::atomic_ref counter(sum[3]);
    const std::uint32_t size = length_of_push(quanta);
    std::uint32_t before = counter.load(std::memory_order_relaxed);
    while (before < size && !counter.compare_exchange_weak(before, size, std::memory_order_relaxed)) {
    }
    if (before == 0) pushed->push_back(particle);
}

}  // namespace

void FaceContacts::prepare(std::uint32_t particles, std::uint32_t faces, std::uint32_t colliders, unsigned workers) {
    workers_ = colliders > 0 ? workers : 0;
    for (auto* marks : {&near_, &retry_, &settled_}) marks->resize(workers_ > 0 ? padded(particles) : 0);
    met_fast_ = false;
    for (Part& part : parts_) part.longest_edge = 0;
    if (workers_ == 0) return;
    if (parts_.size() < workers) parts_.resize(workers);
    if (sums_.size() < particles) sums_.resize(particles), holds_.resize(particles);
    for (Part& part : parts_) {
        if (part.items.size() < faces + lane_padding) {
            part.items.resize(faces + lane_padding), part.narrowed.resize(faces + lane_padding);
            part.measures.resize(numbers_per_face * padded(faces + lane_padding));
        }
        part.pushed.reserve(particles), part.held.reserve(particles);
        part.groups.reserve(2 * std::max<std::size_t>(part.groups.size(), colliders));
        // find() asks for room for all faces of a run.
        make_room(part, std::max<std::size_t>(faces / workers + lane_padding, 2 * part.rows.count));
        part.rows.count = 0;
        part.groups.clear();
    }
}

// Keeps the contacts.
void FaceContacts::make_room(Part& part, std::size_t rows) {
    const std::size_t room = part.corners.size() / 3;
    if (rows + lane_padding <= room) return;
    const std::size_t more = padded(static_cast<std::uint32_t>(rows + rows / 2)) + lane_padding;
    AlignedVector<Vec4> blocks(blocks_per_contact * more);
    AlignedVector<std::uint32_t> corners(3 * more);
    for (std::size_t i = 0; i < blocks_per_contact && room > 0; ++i)
        std::copy_n(part.blocks.begin() + static_cast<std::ptrdiff_t>(i * room), part.rows.count,
                    blocks.begin() + static_cast<std::ptrdiff_t>(i * more));
    for (std::size_t k = 0; k < 3 && room > 0; ++k)
        std::copy_n(part.corners.begin() + static_cast<std::ptrdiff_t>(k * room), part.rows.count,
                    corners.begin() + static_cast<std::ptrdiff_t>(k * more));
    part.blocks = std::move(blocks), part.corners = std::move(corners);
    float** const arrays[blocks_per_contact] = {&part.rows.weights, &part.rows.plane, &part.rows.start,
                                                &part.rows.gaps,    &part.rows.sum,   &part.rows.displacement,
                                                &part.rows.lever};
    for (std::size_t i = 0; i < blocks_per_contact; ++i) *arrays[i] = &part.blocks[i * more].x;
    for (std::size_t k = 0; k < 3; ++k) part.rows.corners[k] = &part.corners[k * more];
}

void FaceContacts::find_longest_edge(const Passes& passes, unsigned worker, const ParticleView& particles,
                                     const FacesByTile& faces, std::uint32_t substep) {
    if (substep > 0 && !met_fast_) return;
    const Share mine = weft::share_of(faces.begin.back(), lane_padding, worker, workers_);
    const FaceView all{.corners = faces.corners.data(), .stride = faces.stride, .items = nullptr, .count = 0};
    float& longest = parts_[worker].longest_edge;
    longest = std::max(longest, passes.longest_edge(particles, all, mine.begin, mine.end));
}

float FaceContacts::longest_edge() const {
    float longest = 0;
    for (unsigned worker = 0; worker < workers_; ++worker) longest = std::max(longest, parts_[worker].longest_edge);
    return longest;
}

void FaceContacts::begin(unsigned worker) {
    Part& part = parts_[worker];
    part.rows.count = 0;
    part.rows.any_fast = false;
    part.any_of_bodies = false;
    part.groups.clear();
    part.held.clear();
    part.any_settled = false;
}

namespace {

Range faces_of(const FacesByTile& faces, const ColliderRun& run) {
    const auto tiles = static_cast<std::uint32_t>(faces.begin.size() - 1);
    return {faces.begin[std::min(run.begin / lane_padding, tiles)],
            faces.begin[std::min((run.end + lane_padding - 1) / lane_padding, tiles)]};
}

struct HoldTarget {
    std::uint32_t* holds;
    std::vector<std::uint32_t>* held;
    std::uint32_t collider;
    bool still;
};

void hold_corner(const FaceView& faces, std::uint32_t particle, std::uint32_t part) {
    const auto& [holds, held, collider, still] = *static_cast<const HoldTarget*>(faces.holds);
    const std::uint32_t mark = (WEFT_HOLD_PARTS - (still ? 0 : part) + 1) * WEFT_HOLD_COLLIDERS + collider;
    std::atomic_ref most(holds[particle]);
    std::uint32_t before = most.load(std::memory_order_relaxed);
    while (before < mark && !most.compare_exchange_weak(before, mark, std::memory_order_relaxed)) {
    }
    if (before == 0) held->push_back(particle);
}

}  // namespace

bool FaceContacts::any_fast() const {
    const auto first = parts_.begin();
    return std::any_of(first, first + workers_, [](const Part& part) { return part.rows.any_fast; });
}

bool FaceContacts::any_settled() const {
    const auto first = parts_.begin();
    return std::any_of(first, first + workers_, [](const Part& part) { return part.any_settled; });
}

void FaceContacts::forget_settled() {
    std::ranges::fill(settled_, std::uint8_t{0});
    for (unsigned worker = 0; worker < workers_; ++worker) parts_[worker].any_settled = false;
}

bool FaceContacts::any_of_bodies() const {
    const auto first = parts_.begin();
    return std::any_of(first, first + workers_, [](const Part& part) { return part.any_of_bodies; });
}

void FaceContacts::clear_near(Range particles) {
    if (near_.empty()) return;
    for (auto* marks : {&near_, &retry_, &settled_})
        std::fill(marks->begin() + particles.begin, marks->begin() + particles.end, std::uint8_t{0});
}

void FaceContacts::collect(Part& part, const std::uint8_t* marks, const FacesByTile& faces, const ColliderRun& run) {
    const Range range = faces_of(faces, run);
    const std::uint32_t *const a = faces.corners.data(), *const b = a + faces.stride, *const c = b + faces.stride;
    part.is_narrowed = part.is_measured = false;
    std::uint32_t count = part.item_count;
    for (std::uint32_t f = range.begin; f < range.end; ++f) {
        part.items[count] = f;
        count += (marks[a[f]] | marks[b[f]] | marks[c[f]]) != 0;
    }
    // Lanes beyond the last one read a valid face.
    for (std::uint32_t k = 0; k < lane_padding; ++k) part.items[count + k] = range.begin;
    part.item_count = count;
}

void FaceContacts::collect(unsigned worker, const FacesByTile& faces, const ColliderRun& run) {
    collect(parts_[worker], near_.data(), faces, run);
}

void FaceContacts::collect_again(unsigned worker, const FacesByTile& faces, const ColliderRun& run, bool last) {
    collect(parts_[worker], last ? settled_.data() : retry_.data(), faces, run);
}

FaceView FaceContacts::view(const Part& part, const FacesByTile& faces) const {
    return {.corners = faces.corners.data(),
            .stride = faces.stride,
            .items = part.is_narrowed ? part.narrowed.data() : part.items.data(),
            .count = part.is_narrowed ? part.narrowed_count : part.item_count};
}

bool FaceContacts::narrow(const Passes& passes, unsigned worker, const ParticleView& particles,
                          const FacesByTile& faces, const MovingBall& ball, float nearest) {
    Part& part = parts_[worker];
    if (part.item_count == 0) return false;
    part.is_narrowed = false;
    const FaceView all = view(part, faces);
    const FaceMeasures measures{part.measures.data(), part.measures.size() / numbers_per_face};
    if (!part.is_measured) passes.measure_faces(particles, all, measures);
    part.is_measured = true;
    part.narrowed_count = passes.near_faces(all, measures, ball, nearest, part.narrowed.data());
    part.is_narrowed = true;
    if (part.narrowed_count == 0) return false;
    // Lanes beyond the last one read a valid face.
    std::fill_n(part.narrowed.data() + part.narrowed_count, lane_padding, part.narrowed[0]);
    return true;
}

std::size_t FaceContacts::find(const Passes& passes, unsigned worker, const ParticleView& particles,
                               const FacesByTile& faces, std::uint32_t collider, const ContactView& contact,
                               bool is_body) {
    Part& part = parts_[worker];
    if (part.item_count == 0) return 0;
    make_room(part, part.rows.count + part.item_count);
    const std::size_t before = part.rows.count;
    FaceView of = view(part, faces);
    of.retry = retry_.data(), of.of_moved_body = is_body;
    passes.find_faces[static_cast<std::uint32_t>(contact.kind)](particles, contact, of, part.rows);
    if (part.rows.count == before) return 0;
    part.any_of_bodies = part.any_of_bodies || is_body;
    if (!part.groups.empty() && part.groups.back().collider == collider)
        part.groups.back().end = part.rows.count;
    else
        part.groups.push_back({collider, part.rows.count});
    return part.rows.count - before;
}

void FaceContacts::hold(const Passes& passes, unsigned worker, const ParticleView& particles, const FacesByTile& faces,
                        std::uint32_t collider, const ContactView& contact, bool still) {
    Part& part = parts_[worker];
    if (part.item_count == 0) return;
    HoldTarget target{holds_.data(), &part.held, collider % WEFT_HOLD_COLLIDERS, still};
    FaceView of = view(part, faces);
    of.hold = hold_corner, of.holds = &target;
    passes.find_faces[static_cast<std::uint32_t>(contact.kind)](particles, contact, of, part.rows);
}

void FaceContacts::push(const Passes& passes, unsigned worker, const ParticleView& particles, Bodies& bodies, bool last,
                        float depenetration, const ThicknessView& thickness) {
    Part& part = parts_[worker];
    part.pushed.clear();
    FaceTarget target{sums_.data(), &part.pushed};
    // Lanes beyond the last contact read valid particles.
    for (std::size_t k = 0; k < 3 && part.rows.count > 0; ++k)
        std::fill_n(part.rows.corners[k] + part.rows.count, lane_padding, 0u);
    const FaceSums sums{&target, workers_ > 1 ? add_shared : add_alone};
    if (!part.any_of_bodies) {
        passes.push_faces(particles, part.rows, 0, part.rows.count, last, depenetration, thickness, sums);
        return;
    }
    // Groups begin anywhere, so their contacts come one at a time.
    std::size_t begin = 0;
    for (const Group& group : part.groups) {
        const std::uint32_t body = bodies.body_of(group.collider);
        if (last || body == none || !bodies.feels_cloth(body)) {
            scalar_passes().push_faces(particles, part.rows, begin, group.end, last, depenetration, thickness, sums);
        } else {
            scalar_passes().push_faces_of_body(particles, part.rows, begin, group.end, depenetration,
                                               bodies.view(body, worker), bodies.found(body), bodies.now(body), sums);
        }
        begin = group.end;
    }
}

Vec3 FaceContacts::push_of(const FaceRows& rows, std::size_t contact, std::size_t corner, bool last) {
    const float* by = rows.displacement + 4 * contact;
    const float* plane = rows.plane + 4 * contact;
    if (last) return Vec3{plane[0], plane[1], plane[2]} * by[corner];
    const float* weights = rows.weights + 4 * contact;
    const float third = 1.0f - weights[0] - weights[1];
    return Vec3{by[0], by[1], by[2]} * (corner < 2 ? weights[corner] : third);
}

Vec3 FaceContacts::total(const FaceSum& sum) {
    const auto axis = [&](std::size_t k) {
        return static_cast<float>(static_cast<std::int32_t>(sum[k])) * meters_per_quantum;
    };
    return {axis(0), axis(1), axis(2)};
}

float FaceContacts::share_of(const FaceSum& sum) {
    const Vec3 all = total(sum);
    return scalar::face_share(static_cast<float>(sum[3]) * meters_per_quantum, {all.x, all.y, all.z});
}

void FaceContacts::move(unsigned worker, const ParticleView& particles) {
    for (const std::uint32_t p : parts_[worker].pushed) {
        FaceSum& sum = sums_[p];
        const Vec3 by = total(sum) * share_of(sum);
        float* x = particles.position + 4 * std::size_t{p};
        x[0] += by.x, x[1] += by.y, x[2] += by.z;
        sum = {};
    }
}

}  // namespace weft::cpu
