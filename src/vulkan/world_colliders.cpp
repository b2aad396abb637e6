#include "vulkan/world_colliders.h"

#include "solver/plan/frame_numbers.h"
#include "solver/plan/world_plan.h"
#include "vulkan/pose_in.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <tuple>
#include <utility>

namespace weft::vulkan {
namespace {

// Sizes of the GLSL layout.
static_assert(sizeof(ColliderIn) == 80 && sizeof(PoseIn) == 64 && sizeof(CollidersIn) == 40 &&
              sizeof(NearTileIn) == 48);
static_assert(WEFT_TILE_SLACK == tile_slack_per_way && WEFT_ROOM_TO_STRETCH == room_to_stretch &&
              WEFT_COLLIDER_TILE == lane_padding);
static_assert(WEFT_FACE_SWEEPS == face_sweeps && WEFT_FACE_HOLDS == face_holds &&
              WEFT_MOST_HOLD_ROUNDS == most_hold_rounds);

// See CollidersIn::nodes.
struct NodeIn {
    Vec4 low, high;
};

NodeIn node_in(const Bounds& box, std::size_t next, std::uint32_t collider) {
    const float after = std::bit_cast<float>(static_cast<std::uint32_t>(next)), number = std::bit_cast<float>(collider);
    return {{box.min.x, box.min.y, box.min.z, after}, {box.max.x, box.max.y, box.max.z, number}};
}

// Each box of a leaf becomes a node of its own.
std::size_t nodes_of(const Bvh& tree) {
    return tree.nodes().size() + tree.size();
}

// `numbers`: collider of each box of the tree. `first`: number of the first node. Returns the end of the nodes.
NodeIn* write_tree(const Bvh& tree, std::span<const std::uint32_t> numbers, std::size_t first, NodeIn* to) {
    const auto nodes = tree.nodes();
    // Boxes of earlier leaves come before a node. Inner nodes too have the number of the first box below them.
    const auto place_of = [&](std::size_t n) { return first + n + (n < nodes.size() ? nodes[n].first : tree.size()); };
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        *to++ = node_in(nodes[n].bounds, place_of(nodes[n].skip), none);
        for (std::uint32_t k = 0; k < nodes[n].count; ++k) {
            const std::uint32_t box = nodes[n].first + k;
            *to++ = node_in(tree.boxes()[box], place_of(n) + k + 2, numbers[tree.items()[box]]);
        }
    }
    return to;
}

}  // namespace

Result<void> WorldColliders::update(gpu::Device& device, std::span<const Collider> colliders,
                                    const ColliderPlaces& places, std::uint64_t bodies) {
    assert(colliders.size() == places.size());
    auto done = shapes_.hold(device, colliders);
    if (done && !colliders.empty()) done = copy_changes(device, colliders, places, bodies);
    if (!done || colliders.empty()) order_ = 0;  // the next frame writes everything
    if (colliders.empty()) buffer_ = {}, upload_ = {}, head_ = {}, head_upload_ = {};
    return done;
}

Result<void> WorldColliders::copy_changes(gpu::Device& device, std::span<const Collider> colliders,
                                          const ColliderPlaces& places, std::uint64_t bodies) {
    const bool all = order_ != places.order();
    std::array<Range, 2> ranges;
    if (all) {
        lay_out(places);
        if (auto made = make_room(device); !made) return made;
        write_colliders(colliders, places);
        write_resting(places);
        write_moving(places);
        ranges[0] = {0, layout_.end};
    } else {
        ranges[0] = changed_friction(colliders);
        if (!places.moving().empty()) {
            write_moving(places);
            ranges[1] = {layout_.moving_nodes, layout_.end};
        }
    }
    const bool with_head = write_head(bodies);
    if (ranges[0].begin == ranges[0].end && ranges[1].begin == ranges[1].end && !with_head) return {};
    if (auto submitted = submit(ranges, with_head); !submitted) return submitted;
    order_ = places.order();
    return {};
}

void WorldColliders::lay_out(const ColliderPlaces& places) {
    std::uint64_t end = 0;
    const auto take = [&](std::uint64_t count, std::uint64_t bytes) {
        const std::uint64_t at = end;
        end += (count * bytes + sizeof(PoseIn) - 1) / sizeof(PoseIn) * sizeof(PoseIn);
        return at;
    };
    const std::uint64_t moving = places.moving().size(), of_each = places.substeps() + std::uint64_t{1};
    const std::uint64_t resting_nodes = nodes_of(places.resting_tree()),
                        moving_nodes = nodes_of(places.moving_tree()) + places.unbounded().size() + moving;
    layout_.colliders = take(places.size(), sizeof(ColliderIn));
    layout_.resting_poses = take(places.size() - moving, sizeof(PoseIn));
    layout_.nodes = take(resting_nodes + moving_nodes, sizeof(NodeIn));
    layout_.moving_nodes = layout_.nodes + resting_nodes * sizeof(NodeIn);
    layout_.moving_poses = take(moving * of_each, sizeof(PoseIn));
    layout_.end = end;
}

Result<void> WorldColliders::make_room(gpu::Device& device) {
    const auto make = [&](gpu::Buffer& buffer, std::uint64_t bytes, gpu::MemoryKind kind) -> Result<void> {
        if (buffer.size() >= bytes) return {};
        buffer = {};  // before more memory is taken
        auto made = device.memory().buffer(bytes, kind, "colliders");
        if (!made) return made.errors();
        buffer = std::move(*made);
        return {};
    };
    for (auto&& [buffer, bytes, kind] :
         {std::tuple(&buffer_, layout_.end, gpu::MemoryKind::device),
          std::tuple(&upload_, layout_.end, gpu::MemoryKind::upload),
          std::tuple(&head_, std::uint64_t{sizeof written_}, gpu::MemoryKind::device),
          std::tuple(&head_upload_, std::uint64_t{sizeof written_}, gpu::MemoryKind::upload)})
        if (auto made = make(*buffer, bytes, kind); !made) return made;
    if (commands_) return {};
    auto commands = gpu::Commands::create(device);
    if (!commands) return commands.errors();
    commands_ = std::move(*commands);
    return {};
}

void WorldColliders::write_colliders(std::span<const Collider> colliders, const ColliderPlaces& places) {
    const std::span<ColliderIn> to = array<ColliderIn>(layout_.colliders, colliders.size());
    const auto moving_first =
        static_cast<std::uint32_t>((layout_.moving_poses - layout_.resting_poses) / sizeof(PoseIn));
    std::uint32_t resting = 0, moving = 0, bodies = 0;
    friction_.clear();
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Collider& collider = colliders[i];
        const auto& n = collider.numbers;
        const bool moves = places.moves(i);
        friction_.push_back(collider.friction);
        to[i] = {.numbers = {n[0], n[1], n[2], n[3]},
                 .static_friction = collider.friction[0],
                 .kinetic_friction = collider.friction[1],
                 .shape = static_cast<std::uint32_t>(collider.shape),
                 .flags = (collider.adhesion ? WEFT_COLLIDER_STICKS : 0u) |
                          (collider.surface ? WEFT_COLLIDER_SURFACE : 0u) | (collider.body ? WEFT_COLLIDER_BODY : 0u),
                 .adhesion_distance = collider.adhesion ? collider.adhesion->distance : 0,
                 .adhesion_compliance = collider.adhesion ? collider.adhesion->compliance : 0,
                 .data = shapes_.address(collider.data.get()),
                 .first_pose = moves ? moving_first + moving++ * (places.substeps() + 1) : resting++,
                 .pose_step = moves ? 1u : 0u,
                 .steepness = steepness_of(collider),
                 .roundness = roundness_of(collider),
                 .width = width_of(collider),
                 .body = collider.body ? bodies++ : 0,
                 .unused0 = 0,
                 .unused1 = 0};
    }
}

void WorldColliders::write_resting(const ColliderPlaces& places) {
    write_tree(places.resting_tree(), places.resting(), 0, array<NodeIn>(layout_.nodes, 0).data());
    PoseIn* pose = array<PoseIn>(layout_.resting_poses, 0).data();
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!places.moves(i)) *pose++ = pose_in(places.pose(i, 0));
}

// Also the colliders without a box, some of which may move.
void WorldColliders::write_moving(const ColliderPlaces& places) {
    const std::size_t resting = nodes_of(places.resting_tree());
    NodeIn* node =
        write_tree(places.moving_tree(), places.moving(), resting, array<NodeIn>(layout_.moving_nodes, 0).data());
    constexpr float far = 1e38f;
    const Bounds everywhere{{-far, -far, -far}, {far, far, far}};
    node_count_ = resting + nodes_of(places.moving_tree());
    for (const auto& unbounded : {places.unbounded(), places.unbounded_moving()})
        for (const std::uint32_t collider : unbounded) *node++ = node_in(everywhere, ++node_count_, collider);
    PoseIn* pose = array<PoseIn>(layout_.moving_poses, 0).data();
    for (const std::uint32_t collider : places.moving())
        for (std::uint32_t substep = 0; substep <= places.substeps(); ++substep)
            *pose++ = pose_in(places.pose(collider, substep));
}

// Friction is what changes without a new order. Returns the range of bytes from the first to the last collider with
// other friction.
WorldColliders::Range WorldColliders::changed_friction(std::span<const Collider> colliders) {
    Range changed;
    const std::span<ColliderIn> to = array<ColliderIn>(layout_.colliders, colliders.size());
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        if (friction_[i] == colliders[i].friction) continue;
        friction_[i] = colliders[i].friction;
        to[i].static_friction = friction_[i][0];
        to[i].kinetic_friction = friction_[i][1];
        const std::uint64_t at = layout_.colliders + i * sizeof(ColliderIn);
        if (changed.end == 0) changed.begin = at;
        changed.end = at + sizeof(ColliderIn);
    }
    return changed;
}

// Returns whether it has changed.
bool WorldColliders::write_head(std::uint64_t bodies) {
    const std::uint64_t first = buffer_.address();
    const CollidersIn now = {.colliders = first + layout_.colliders,
                             .poses = first + layout_.resting_poses,
                             .nodes = first + layout_.nodes,
                             .bodies = bodies,
                             .node_count = static_cast<std::uint32_t>(node_count_),
                             .unused = 0};
    if (order_ != 0 && std::memcmp(&now, &written_, sizeof now) == 0) return false;
    written_ = now;
    std::memcpy(head_upload_.mapped().data(), &now, sizeof now);
    return true;
}

Result<void> WorldColliders::submit(std::span<const Range> ranges, bool with_head) {
    if (auto begun = commands_->begin(); !begun) return begun;
    for (const Range& range : ranges) {
        if (range.begin < range.end)
            commands_->copy(upload_, buffer_, range.end - range.begin, range.begin, range.begin);
    }
    if (with_head) commands_->copy(head_upload_, head_, sizeof written_);
    commands_->barrier();
    if (auto ended = commands_->end(); !ended) return ended;
    auto value = commands_->submit();
    if (!value) return value.errors();
    return {};
}

}  // namespace weft::vulkan
