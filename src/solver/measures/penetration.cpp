#include "solver/measures/penetration.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr double rounding = 1e-6;  // m: of float positions a few meters from the origin

bool is_bounded_box(const Bounds& box) {
    return finite(box.min) && finite(box.max);
}

// Rotated boxes and positions are rounded to floats.
Bounds enlarged(const Bounds& box) {
    const float by = 1e-5f * std::max({1.0f, length(box.min), length(box.max)});
    return {box.min - Vec3{by, by, by}, box.max + Vec3{by, by, by}};
}

/// The colliders that a box may touch.
class NearColliders {
  public:
    explicit NearColliders(std::span<const Collider> colliders) {
        std::vector<Bounds> boxes;
        for (std::uint32_t i = 0; i < colliders.size(); ++i) {
            const Bounds box = to_world(colliders[i].pose, colliders[i].bounds);
            if (is_bounded_box(box)) {
                boxes.push_back(enlarged(box)), bounded_.push_back(i);
            } else {
                everywhere_.push_back(i);
            }
        }
        tree_ = Bvh(boxes);
    }
    template <class Visit>
    void for_each(const Bounds& box, Visit&& visit) const {
        for (const std::uint32_t i : everywhere_) visit(i);
        tree_.for_each_overlap(box, [&](std::uint32_t k) { visit(bounded_[k]); });
    }

  private:
    std::vector<std::uint32_t> bounded_, everywhere_;
    Bvh tree_;
};

}  // namespace

// Nothing deeper than this is left to find in the face.
double PenetrationSearch::limit() const {
    return face_resolution_ + (face_depth_ > rounding ? result_.max : 0);
}

double PenetrationSearch::sample(const Point& at, TrueSurfaces::Probe& probe) {
    const Vec3 p{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    const double depth = -probe.distance(p);
    ++face_samples_, ++result_.samples;
    face_depth_ = std::max(face_depth_, depth);
    if (depth > result_.max) {
        result_.max = depth;
        result_.collider = collider_, result_.cloth = cloth_, result_.place = p;
    }
    return depth;
}

// Samples the middle of the part, and keeps the part if it may have a deeper place.
void PenetrationSearch::add_part(const Part& part, TrueSurfaces::Probe& probe) {
    const auto& [a, b, c] = part.corners;
    const Point middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
    const double depth = sample(middle, probe);
    if (!std::isfinite(depth)) return;
    double way = 0, rise = 0;
    const Vec3 normal = convex_ ? probe.normal() : Vec3{};
    for (const Point& corner : part.corners) {
        const Point d{corner.x - middle.x, corner.y - middle.y, corner.z - middle.z};
        way = std::max(way, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z));
        rise = std::max(rise, -(d.x * double{normal.x} + d.y * double{normal.y} + d.z * double{normal.z}));
    }
    const double bound = std::min(part.bound, depth + (convex_ ? std::min(way, rise) : way));
    if (bound <= limit()) {
        result_.at_most = std::max(result_.at_most, bound);
        return;
    }
    parts_.push_back({{a, b, c}, bound});
    std::ranges::push_heap(parts_, {}, &Part::bound);
}

void PenetrationSearch::search_face(const Vec3 (&corners)[3], const Collider& collider) {
    const auto wide = [](Vec3 v) { return Point{double{v.x}, double{v.y}, double{v.z}}; };
    const auto half = [](const Point& a, const Point& b) {
        return Point{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    };
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, double{length(corners[(k + 1) % 3] - corners[k])});
    face_resolution_ = std::min(resolution, longest / 30);
    convex_ = TrueSurfaces::is_convex(collider);
    face_samples_ = 0;
    parts_.clear();
    const Point a = wide(corners[0]), b = wide(corners[1]), c = wide(corners[2]);
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0f;
    TrueSurfaces::Probe probe = surfaces_.probe(collider, middle, longest);
    const double before = face_depth_;
    face_depth_ = 0;
    add_part({{a, b, c}, std::numeric_limits<double>::infinity()}, probe);
    // Cloth that lies on a mesh is near it everywhere, so the distance at its samples would exclude nothing.
    if (!parts_.empty() && face_depth_ <= 0 && probe.same_side(corners)) parts_.clear();
    if (!parts_.empty()) {
        for (const Point& p : {a, b, c, half(a, b), half(b, c), half(c, a)}) sample(p, probe);
    }
    while (!parts_.empty() && parts_.front().bound > limit() && face_samples_ < most_samples) {
        std::ranges::pop_heap(parts_, {}, &Part::bound);
        const Part part = parts_.back();
        parts_.pop_back();
        const auto& [p, q, r] = part.corners;
        const Point pq = half(p, q), qr = half(q, r), rp = half(r, p);
        add_part({{p, pq, rp}, part.bound}, probe);
        add_part({{pq, q, qr}, part.bound}, probe);
        add_part({{rp, qr, r}, part.bound}, probe);
        add_part({{pq, qr, rp}, part.bound}, probe);
    }
    if (!parts_.empty()) result_.at_most = std::max(result_.at_most, parts_.front().bound);
    face_depth_ = std::max(face_depth_, before);
}

Penetration PenetrationSearch::measure(const Frame& frame, std::span<const Collider> colliders) {
    result_ = {};
    if (colliders.empty()) return result_;
    const NearColliders near(colliders);
    for (cloth_ = 0; cloth_ < frame.cloths.size(); ++cloth_) {
        const ClothFrame& cloth = frame.cloths[cloth_];
        for (const auto& [ia, ib, ic] : cloth.triangles) {
            const Vec3 corners[] = {cloth.positions[ia].xyz(), cloth.positions[ib].xyz(), cloth.positions[ic].xyz()};
            const Bounds box = bounds_of(corners);
            if (!finite(corners[0]) || !finite(corners[1]) || !finite(corners[2])) continue;
            face_depth_ = 0;
            near.for_each(box, [&](std::uint32_t i) {
                if (!shape_acts_on(colliders[i], *cloth.model)) return;
                collider_ = i;
                search_face(corners, colliders[i]);
            });
            result_.count += face_depth_ > rounding;
        }
    }
    result_.at_most = std::max(result_.at_most, result_.max);
    return result_;
}

}  // namespace weft
