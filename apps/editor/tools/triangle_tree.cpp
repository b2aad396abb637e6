#include "editor/tools/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace weft::editor {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

// Puts two zero bits before each of the lowest ten bits.
std::uint32_t spread_bits(std::uint32_t x) {
    x &= 0x3ff;
    x = (x | (x << 16)) & 0x030000ff;
    x = (x | (x << 8)) & 0x0300f00f;
    x = (x | (x << 4)) & 0x030c30c3;
    return (x | (x << 2)) & 0x09249249;
}

struct Keyed {
    std::uint32_t key, triangle;
};

// A stable radix sort by 30 bits.
void sort_by_key(std::vector<Keyed>& items) {
    constexpr std::uint32_t bits = 10, buckets = 1u << bits;
    std::vector<Keyed> other(items.size());
    for (std::uint32_t shift = 0; shift < 3 * bits; shift += bits) {
        std::array<std::uint32_t, buckets> starts{};
        for (const Keyed& item : items) ++starts[(item.key >> shift) & (buckets - 1)];
        std::exclusive_scan(starts.begin(), starts.end(), starts.begin(), 0u);
        for (const Keyed& item : items) other[starts[(item.key >> shift) & (buckets - 1)]++] = item;
        items.swap(other);
    }
}

// Neighbors in the curve are neighbors in space. Triangles that are not sound come last.
std::vector<std::uint32_t> curve_order(const MeshView& mesh) {
    Bounds bounds;
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v)
        if (const Vec3 p = mesh.position(v); finite(p)) bounds.include(p);
    const Vec3 size = bounds.size();
    const float scale = 1023.0f / std::max({size.x, size.y, size.z, 1e-30f});
    std::vector<Keyed> items(mesh.triangles());
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t) {
        const Triangle corners = mesh.triangle(t);
        items[t] = {(1u << 30) - 1, t};
        if (!mesh.sound(corners)) continue;
        const Vec3 center =
            (mesh.position(corners[0]) + mesh.position(corners[1]) + mesh.position(corners[2])) * (1.0f / 3);
        const auto cell = [&](float x, float min) {
            return static_cast<std::uint32_t>(std::clamp((x - min) * scale, 0.0f, 1023.0f));
        };
        items[t].key = spread_bits(cell(center.x, bounds.min.x)) | spread_bits(cell(center.y, bounds.min.y)) << 1 |
                       spread_bits(cell(center.z, bounds.min.z)) << 2;
    }
    sort_by_key(items);
    std::vector<std::uint32_t> order(items.size());
    std::ranges::transform(items, order.begin(), &Keyed::triangle);
    return order;
}

struct Crossing {
    double distance;
    std::array<double, 3> weights;
    bool front;
};

// Woop, Benthin, Wald 2013, "Watertight ray/triangle intersection": in coordinates in which the ray is the z axis, the
// signs of three 2-D determinants decide. Two triangles compute the same number for a common edge.
class ShearedRay {
  public:
    explicit ShearedRay(const Ray& ray) : origin_(exact(ray.origin)) {
        const Double3 d = exact(ray.direction);
        const std::array<double, 3> along{d.x, d.y, d.z};
        for (std::size_t i = 1; i < 3; ++i)
            if (std::abs(along[i]) > std::abs(along[z_])) z_ = i;
        x_ = (z_ + 1) % 3, y_ = (z_ + 2) % 3;
        if (along[z_] < 0) std::swap(x_, y_);  // keeps the winding
        shear_ = {along[x_] / along[z_], along[y_] / along[z_], 1 / along[z_]};
    }

    std::optional<Crossing> meet(Vec3 a, Vec3 b, Vec3 c) const {
        const Double3 p = sheared(a), q = sheared(b), r = sheared(c);
        const double u = r.x * q.y - r.y * q.x, v = p.x * r.y - p.y * r.x, w = q.x * p.y - q.y * p.x;
        if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
        const double sum = u + v + w;
        if (sum == 0) return std::nullopt;  // edge-on
        const double distance = (u * p.z + v * q.z + w * r.z) / sum;
        return Crossing{distance, {u / sum, v / sum, w / sum}, sum > 0};
    }

  private:
    Double3 sheared(Vec3 v) const {
        const Double3 d = exact(v) - origin_;
        const std::array<double, 3> at{d.x, d.y, d.z};
        return {at[x_] - shear_.x * at[z_], at[y_] - shear_.y * at[z_], shear_.z * at[z_]};
    }

    Double3 origin_, shear_;
    std::size_t x_ = 0, y_ = 1, z_ = 0;
};

// A ray with what tests of boxes need.
struct BoxRay {
    std::array<float, 3> origin, inverse;
    std::array<std::size_t, 3> entry, exit;  // which sides of a box the ray enters and leaves by

    explicit BoxRay(const Ray& ray) : origin{ray.origin.x, ray.origin.y, ray.origin.z} {
        const float along[] = {ray.direction.x, ray.direction.y, ray.direction.z};
        for (std::size_t i = 0; i < 3; ++i) {
            constexpr float least = 1e-20f;  // instead of 0: no product is 0 · infinity
            inverse[i] = 1 / (std::abs(along[i]) < least ? std::copysign(least, along[i]) : along[i]);
            entry[i] = inverse[i] > 0 ? i : i + 3;
            exit[i] = inverse[i] > 0 ? i + 3 : i;
        }
    }
};

// Around eight boxes: min x, y, z, then max x, y, z. Bounds::include() is for boxes that are not empty.
template <class Sides>
Bounds enclosing(const Sides& side) {
    return {{std::ranges::min(side[0]), std::ranges::min(side[1]), std::ranges::min(side[2])},
            {std::ranges::max(side[3]), std::ranges::max(side[4]), std::ranges::max(side[5])}};
}

bool usable(const Ray& ray) {
    return finite(ray.origin) && finite(ray.direction) && length(ray.direction) > 0;
}

}  // namespace

void TriangleTree::build(const MeshView& mesh) {
    order_ = curve_order(mesh);
    corners_.resize(order_.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
        const Triangle t = mesh.triangle(order_[i]);
        const bool in_range = std::ranges::all_of(t, [&](std::uint32_t v) { return v < mesh.vertices(); });
        corners_[i] = in_range ? t : Triangle{0, 0, 0};
    }
    levels_.clear();
    for (std::size_t boxes = (order_.size() + leaf_size - 1) / leaf_size; boxes > 0;) {
        levels_.emplace_back((boxes + width - 1) / width);
        boxes = boxes > width ? levels_.back().size() : 0;
    }
    take_positions(mesh);
    take_boxes();
    built_area_ = area_;
}

void TriangleTree::refit(const MeshView& mesh) {
    if (mesh.vertices() != vertices() || mesh.triangles() != triangles()) return build(mesh);
    take_positions(mesh);
    take_boxes();
}

void TriangleTree::take_positions(const MeshView& mesh) {
    positions_.resize(mesh.vertices());
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) positions_[v] = mesh.position(v);
}

void TriangleTree::take_boxes() {
    area_ = 0;
    const auto put = [](Group& group, std::size_t slot, const Bounds& box) {
        const float sides[] = {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
        for (std::size_t i = 0; i < 6; ++i) group.side[i][slot] = sides[i];
    };
    for (std::vector<Group>& level : levels_) {
        if (!level.empty()) {  // the last group may not be full
            for (std::size_t slot = 0; slot < width; ++slot) put(level.back(), slot, Bounds{});
        }
    }
    for (std::size_t first = 0; first < corners_.size(); first += leaf_size) {
        Bounds box;
        for (std::size_t i = first; i < std::min(first + leaf_size, corners_.size()); ++i) {
            const auto [a, b, c] = corners_[i];
            if (a == b) continue;
            const Vec3 p = positions_[a], q = positions_[b], r = positions_[c];
            if (!finite(p) || !finite(q) || !finite(r)) continue;
            box.include(p), box.include(q), box.include(r);
        }
        const Vec3 size = box.size();
        area_ += static_cast<double>(size.x * size.y + size.y * size.z + size.z * size.x);
        put(levels_[0][first / leaf_size / width], first / leaf_size % width, box);
    }
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        for (std::size_t g = 0; g < levels_[level - 1].size(); ++g) {
            const Bounds box = enclosing(levels_[level - 1][g].side);
            put(levels_[level][g / width], g % width, box);
        }
    }
}

Bounds TriangleTree::bounds() const {
    return levels_.empty() ? Bounds{} : enclosing(levels_.back()[0].side);
}

// Calls visit(leaf), nearer leaves first; it returns the distance beyond which nothing is of interest.
template <class Visit>
void TriangleTree::visit_leaves(const Ray& ray, float from, double to, Visit&& visit) const {
    if (levels_.empty()) return;
    struct Pending {
        float entry;
        std::uint32_t level, at;  // a group of levels_[level - 1], or a leaf for level 0
    };
    // Eleven levels hold 2³² triangles. Each leaves seven boxes or fewer to come back to.
    std::array<Pending, 11 * width> pending;
    std::size_t count = 0;
    pending[count++] = {0, static_cast<std::uint32_t>(levels_.size()), 0};
    const BoxRay box_ray(ray);
    constexpr float wider = 1 + 4e-7f;  // Ize 2013: rounding never misses a box
    while (count > 0) {
        const Pending next = pending[--count];
        if (static_cast<double>(next.entry) > to) continue;
        if (next.level == 0) {
            to = std::min(to, visit(next.at));
            continue;
        }
        const Group& group = levels_[next.level - 1][next.at];
        std::array<float, width> entries, exits;
        for (std::size_t i = 0; i < width; ++i) entries[i] = from, exits[i] = unbounded;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto &near = group.side[box_ray.entry[axis]], &far = group.side[box_ray.exit[axis]];
            const float o = box_ray.origin[axis], inverse = box_ray.inverse[axis];
            for (std::size_t i = 0; i < width; ++i) {
                const float enter = (near[i] - o) * inverse, leave = (far[i] - o) * inverse;
                entries[i] = entries[i] > enter ? entries[i] : enter;
                exits[i] = exits[i] < leave ? exits[i] : leave;
            }
        }
        const std::size_t first = count;
        for (std::uint32_t i = 0; i < width; ++i) {
            if (!(entries[i] <= exits[i] * wider)) continue;
            const Pending found{entries[i] / wider, next.level - 1, next.at * width + i};
            std::size_t at = count++;  // the nearest one last
            for (; at > first && pending[at - 1].entry < found.entry; --at) pending[at] = pending[at - 1];
            pending[at] = found;
        }
    }
}

std::optional<SurfaceHit> TriangleTree::nearest(const Ray& ray, float from, float to) const {
    if (!usable(ray)) return std::nullopt;
    const ShearedRay sheared(ray);
    std::optional<Crossing> best;
    std::size_t place = 0;
    double limit = static_cast<double>(to);
    visit_leaves(ray, from, limit, [&](std::uint32_t leaf) {
        const std::size_t first = std::size_t{leaf} * leaf_size;
        for (std::size_t i = first; i < std::min(first + leaf_size, corners_.size()); ++i) {
            const auto [a, b, c] = corners_[i];
            const auto found = sheared.meet(positions_[a], positions_[b], positions_[c]);
            if (!found || !(found->distance >= static_cast<double>(from)) || !(found->distance <= limit)) continue;
            if (best && found->distance == limit && order_[i] > order_[place]) continue;
            best = found, place = i, limit = found->distance;
        }
        return limit;
    });
    if (!best) return std::nullopt;
    const auto& w = best->weights;
    return SurfaceHit{.distance = static_cast<float>(best->distance),
                      .point = rounded(exact(ray.origin) + exact(ray.direction) * best->distance),
                      .triangle = order_[place],
                      .corners = corners_[place],
                      .weights = rounded(Double3{w[0], w[1], w[2]}),
                      .front = best->front};
}

bool TriangleTree::blocks(const Ray& ray, float from, float to) const {
    if (!usable(ray)) return false;
    const ShearedRay sheared(ray);
    bool blocked = false;
    visit_leaves(ray, from, static_cast<double>(to), [&](std::uint32_t leaf) {
        const std::size_t first = std::size_t{leaf} * leaf_size;
        for (std::size_t i = first; i < std::min(first + leaf_size, corners_.size()) && !blocked; ++i) {
            const auto [a, b, c] = corners_[i];
            const auto found = sheared.meet(positions_[a], positions_[b], positions_[c]);
            blocked =
                found && found->distance >= static_cast<double>(from) && found->distance <= static_cast<double>(to);
        }
        return blocked ? -1.0 : static_cast<double>(to);
    });
    return blocked;
}

const TriangleTree& SurfaceTree::of(const MeshView& mesh, std::uint64_t version, std::uint64_t frame) {
    constexpr double loosest = 2;
    if (!built_ || version != version_) {
        tree_.build(mesh);
    } else if (frame != frame_) {
        tree_.refit(mesh);
        if (tree_.looseness() > loosest) tree_.build(mesh);
    }
    built_ = true, version_ = version, frame_ = frame;
    return tree_;
}

}  // namespace weft::editor
