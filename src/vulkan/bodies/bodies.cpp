#include "vulkan/bodies/bodies.h"

#include "solver/plan/body_numbers.h"
#include "solver/plan/frame_numbers.h"
#include "solver/plan/world_plan.h"
#include "vulkan/arena.h"
#include "vulkan/primitives/recorder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

namespace weft::vulkan {
namespace {

// Sizes of the GLSL layout.
static_assert(sizeof(BodyIn) == 304 && sizeof(FeaturesIn) == 32 && sizeof(BodyRowIn) == 112 &&
              sizeof(BodiesIn) == 200 && sizeof(BodiesArgs) == 24);

Vec4 with(Vec3 v, float w) {
    return {v.x, v.y, v.z, w};
}

BodyIn body_in(const BodyStep& step, const Collider& collider, float h) {
    const Body& body = *collider.body;
    const BodyMass& mass = body.mass;
    const BodyState& state = *step.state;
    const auto first = [](const std::array<float, 6>& a, float w) { return Vec4{a[0], a[1], a[2], w}; };
    const auto last = [](const std::array<float, 6>& a, float w) { return Vec4{a[3], a[4], a[5], w}; };
    constexpr float nowhere = 3e38f;
    return {.place = state.place,
            .turn = state.turn,
            .velocity = state.velocity,
            .spin = state.spin,
            .v_dropped = state.v_dropped,
            .x_dropped = state.x_dropped,
            .moments = first(mass.inertia, 1 / mass.mass),
            .products = last(mass.inertia, radius_about(mass.center, collider.bounds)),
            .inverse_moments = first(mass.inverse_inertia, 1 / (1 + h * body.desc.damping)),
            .inverse_products = last(mass.inverse_inertia, 1 / (1 + h * body.desc.spin_damping)),
            .center = with(mass.center, body.desc.restitution),
            .v = {},
            .rate = {},
            .ix = {},
            .iy = {},
            .iz = {},
            .reach_low = {nowhere, nowhere, nowhere, 0},
            .reach_high = {-nowhere, -nowhere, -nowhere, 0},
            .collider = step.collider,
            .feels_cloth = body.desc.reaction ? 1u : 0u,
            .attached = step.attached,
            .unused = 0};
}

// The features of all colliders, as the shader reads them.
struct FeatureArrays {
    std::vector<FeaturesIn> features;
    std::vector<Vec4> points, edges, faces;

    explicit FeatureArrays(std::span<const Collider> colliders) {
        for (const Collider& collider : colliders) {
            const BodyFeatures& of = collider.features;
            features.push_back({.first_point = static_cast<std::uint32_t>(points.size()),
                                .points = static_cast<std::uint32_t>(of.points.size()),
                                .first_edge = static_cast<std::uint32_t>(edges.size() / 2),
                                .edges = static_cast<std::uint32_t>(of.edges.size()),
                                .first_face = static_cast<std::uint32_t>(faces.size()),
                                .faces = static_cast<std::uint32_t>(of.faces.size()),
                                .roundness = of.roundness,
                                .kind = kind_of_features(collider)});
            for (const RoundPoint& point : of.points) points.push_back(with(point.place, point.radius));
            for (const RoundEdge& edge : of.edges) {
                edges.push_back(with(edge.from, edge.radius_from));
                edges.push_back(with(edge.to, edge.radius_to));
            }
            for (const FlatFace& face : of.faces) faces.push_back(with(face.normal, face.offset));
        }
    }
};

// The room that a list gets which was too short.
std::uint32_t grown(std::uint32_t wanted) {
    return std::bit_ceil(std::max(wanted + wanted / 4, 16u));
}

constexpr std::uint64_t body_bytes(std::uint32_t count) {
    return sizeof(BodiesIn) + (16 - sizeof(BodiesIn) % 16) % 16 + std::uint64_t{count} * sizeof(BodyIn);
}
constexpr std::uint64_t first_body = body_bytes(0);

}  // namespace

std::uint64_t Bodies::address() const {
    return count_ == 0 ? 0 : head_.address();
}

Result<void> Bodies::update(gpu::Device& device, const WorldStep& step) {
    const StepInput& input = step.input;
    const auto count = static_cast<std::uint32_t>(input.bodies.size());
    steps_.assign(input.bodies.begin(), input.bodies.end());
    if (count == 0) {
        if (count_ > 0) ++serial_;
        count_ = 0;
        head_ = {}, upload_ = {}, lists_ = {}, back_ = {};
        return {};
    }
    const auto colliders = static_cast<std::uint32_t>(input.colliders.size());
    const bool same = count == count_ && colliders == colliders_ && order_ == input.places->order() &&
                      room_.pairs == made_.pairs && room_.rows == made_.rows;
    if (!same) {
        count_ = 0;
        if (auto made = make_buffers(device, input); !made) return made;
        count_ = count;
        colliders_ = colliders;
        order_ = input.places->order();
        made_ = room_;
        ++serial_;
    }
    write(step);
    return {};
}

Result<void> Bodies::make_buffers(gpu::Device& device, const StepInput& input) {
    const auto count = static_cast<std::uint32_t>(input.bodies.size());
    const FeatureArrays arrays(input.colliders);
    constexpr std::uint64_t word = sizeof(std::uint32_t);
    // One buffer of lists, in blocks of 16 bytes.
    std::uint64_t end = 0;
    const auto take = [&](std::uint64_t bytes) { return std::exchange(end, end + (bytes + 15) / 16 * 16); };
    const std::uint64_t features = take(arrays.features.size() * sizeof(FeaturesIn)),
                        points = take(arrays.points.size() * sizeof(Vec4)),
                        edges = take(arrays.edges.size() * sizeof(Vec4)),
                        faces = take(arrays.faces.size() * sizeof(Vec4)),
                        sums = take(std::uint64_t{count} * WEFT_BODY_SUM_WORDS * word),
                        poses = take(std::uint64_t{count} * WEFT_BODY_POSES * sizeof(PoseIn)),
                        pairs = take(std::uint64_t{room_.pairs} * 2 * word), margins = take(room_.pairs * word),
                        facing = take(room_.pairs * word), tasks = take(room_.pairs * word),
                        rows = take(2 * std::uint64_t{room_.rows} * sizeof(BodyRowIn)), order = take(room_.rows * word),
                        levels = take((room_.rows + std::uint64_t{1}) * word);
    for (auto&& [buffer, bytes, kind] : {std::tuple(&upload_, body_bytes(count), gpu::MemoryKind::upload),
                                         std::tuple(&head_, body_bytes(count), gpu::MemoryKind::device),
                                         std::tuple(&lists_, end, gpu::MemoryKind::device),
                                         std::tuple(&back_, body_bytes(count), gpu::MemoryKind::readback)}) {
        *buffer = {};
        auto made = device.memory().buffer(bytes, kind, "bodies");
        if (!made) return made.errors();
        *buffer = std::move(*made);
    }
    const auto put = [&](std::uint64_t at, const auto& array) {
        return array.empty() ? Result<void>() : upload(device, lists_, at, std::as_bytes(std::span(array)));
    };
    if (auto done = put(features, arrays.features); !done) return done;
    if (auto done = put(points, arrays.points); !done) return done;
    if (auto done = put(edges, arrays.edges); !done) return done;
    if (auto done = put(faces, arrays.faces); !done) return done;
    const std::uint64_t first = lists_.address();
    const std::uint64_t reports = addresses_.reports;
    addresses_ = {};
    addresses_.reports = reports;
    addresses_.bodies = head_.address() + first_body;
    addresses_.sums = first + sums;
    addresses_.poses = first + poses;
    addresses_.features = first + features;
    addresses_.points = first + points;
    addresses_.edges = first + edges;
    addresses_.faces = first + faces;
    addresses_.pairs = first + pairs;
    addresses_.margins = first + margins;
    addresses_.facing = first + facing;
    addresses_.tasks = first + tasks;
    addresses_.rows = first + rows;
    addresses_.order = first + order;
    addresses_.levels = first + levels;
    return {};
}

void Bodies::write(const WorldStep& step) {
    const StepInput& input = step.input;
    const auto h = static_cast<float>(input.dt / step.plan->substeps);
    BodiesIn head = addresses_;
    head.count = count_;
    head.report_count = report_count_;
    head.pair_room = room_.pairs, head.row_room = room_.rows;
    head.h = h, head.inv_h = 1 / h, head.inv_h2 = 1 / h / h;
    head.depenetration = depenetration_speed * h;
    head.gravity_x = input.gravity.x, head.gravity_y = input.gravity.y, head.gravity_z = input.gravity.z;
    head.substeps = step.plan->substeps;
    std::byte* const to = upload_.mapped().data();
    std::memcpy(to, &head, sizeof head);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        const BodyIn body = body_in(steps_[i], input.colliders[steps_[i].collider], h);
        std::memcpy(to + first_body + i * sizeof body, &body, sizeof body);
    }
}

Result<void> Bodies::set_reports(gpu::Device& device, std::span<const std::uint64_t> reports) {
    report_count_ = static_cast<std::uint32_t>(reports.size());
    if (!reports.empty()) {
        auto made = device.memory().buffer(reports.size_bytes(), gpu::MemoryKind::device, "reports for bodies");
        if (!made) return made.errors();
        reports_ = std::move(*made);
        addresses_.reports = reports_.address();
        if (auto done = upload(device, reports_, 0, std::as_bytes(reports)); !done) return done;
    }
    BodiesIn head;
    std::memcpy(&head, upload_.mapped().data(), sizeof head);
    head.reports = addresses_.reports, head.report_count = report_count_;
    std::memcpy(upload_.mapped().data(), &head, sizeof head);
    return {};
}

Result<void> Bodies::record_begin(gpu::Device& device, Programs& programs, gpu::Commands& commands,
                                  std::uint64_t colliders) const {
    commands.copy(upload_, head_, body_bytes(count_));
    Recorder passes(device, programs, commands);
    passes.run("bodies",
               BodiesArgs{.colliders = colliders, .pass = WEFT_BODIES_BEGIN, .substep = 0, .sweeps = 0, .places = 0},
               1);
    return passes.end();
}

Result<void> Bodies::record(gpu::Device& device, Programs& programs, gpu::Commands& commands, std::uint64_t colliders,
                            const Pass& pass, std::uint32_t substep) const {
    BodiesArgs args{.colliders = colliders, .pass = 0, .substep = substep, .sweeps = 0, .places = 0};
    if (pass.kind == PassKind::predict_bodies) {
        args.pass = WEFT_BODIES_PREDICT;
    } else if (pass.kind == PassKind::finish_bodies) {
        args.pass = WEFT_BODIES_FINISH, args.sweeps = sweeps_in(substep, sweeps_of_velocities);
    } else if (pass.batch == move_before_faces) {
        args.pass = WEFT_BODIES_COUNT;
    } else {
        args.pass = WEFT_BODIES_MOVE, args.sweeps = sweeps_of_move(pass.batch, substep);
        args.places = pass.batch == move_after_pulls ? 1 : 0;
    }
    Recorder passes(device, programs, commands);
    passes.run("bodies", args, 1);
    return passes.end();
}

void Bodies::record_end(gpu::Commands& commands) const {
    commands.barrier();
    commands.copy(head_, back_, body_bytes(count_));
    commands.host_barrier();
}

Result<void> Bodies::run_alone(gpu::Device& device, Programs& programs, std::uint64_t colliders,
                               std::uint32_t substeps) {
    if (auto set = set_reports(device, {}); !set) return set;
    Result<void> recorded;
    auto done = gpu::run_once(device, [&](gpu::Commands& commands) {
        recorded = record_begin(device, programs, commands, colliders);
        const auto run = [&](const Pass& pass, std::uint32_t substep) {
            if (recorded) recorded = record(device, programs, commands, colliders, pass, substep);
        };
        for (std::uint32_t substep = 0; substep < substeps; ++substep) {
            run({.kind = PassKind::predict_bodies}, substep);
            for (std::uint32_t sweep = 0; sweep < body_sweeps; ++sweep)
                run({.kind = PassKind::move_bodies, .batch = move_after_particles}, substep);
            run({.kind = PassKind::finish_bodies}, substep);
        }
        record_end(commands);
    });
    return recorded ? done : recorded;
}

std::span<const BodyIn> Bodies::bodies_back() const {
    return {reinterpret_cast<const BodyIn*>(back_.mapped().data() + first_body), count_};
}

bool Bodies::list_was_full() const {
    if (count_ == 0) return false;
    const BodiesIn& head = read_back();
    return head.wanted_pairs > made_.pairs || head.wanted_rows > made_.rows;
}

void Bodies::grow() {
    const BodiesIn& head = read_back();
    if (head.wanted_pairs > made_.pairs) room_.pairs = grown(head.wanted_pairs);
    if (head.wanted_rows > made_.rows) room_.rows = grown(head.wanted_rows);
}

bool Bodies::all_finite() const {
    return count_ == 0 || read_back().not_finite == 0;
}

void Bodies::finish() const {
    const auto bodies = bodies_back();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyIn& body = bodies[i];
        *steps_[i].state = {body.place, body.turn, body.velocity, body.spin, body.v_dropped, body.x_dropped};
    }
}

}  // namespace weft::vulkan
