// Barill, Dickson, Schmidt, Levin, Jacobson, "Fast Winding Numbers for Soups and Clouds", ACM Transactions on Graphics
// 37(4), 2018: a tree of groups of triangles, and the Taylor expansion of each group's winding number around its
// center, here with the first three terms.
#include "collide/winding_number.h"

#include "base/wide_vector.h"

#include <weft/bounds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace weft {
namespace {

// Larger groups make a smaller tree, smaller groups faster queries.
constexpr std::uint32_t most_triangles = 12;

using Wide = WideVec3;

// Half of the solid angle of the triangle, positive as seen from behind it (van Oosterom and Strackee, "The Solid Angle
// of a Plane Triangle", IEEE Transactions on Biomedical Engineering 30(2), 1983).
double half_solid_angle(const Wide& p, Vec3 corner_a, Vec3 corner_b, Vec3 corner_c) {
    const Wide a = wide(corner_a) - p, b = wide(corner_b) - p, c = wide(corner_c) - p;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    const double volume = dot(a, cross(b, c));
    const double rest = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return volume == 0 && rest == 0 ? 0 : std::atan2(volume, rest);
}

constexpr double per_half_angle = 0.5 / std::numbers::pi;

// Axes of the ten products of three coordinates, in the order of WindingGroup::third, and in how many orders the axes
// of each can stand.
struct Product {
    std::size_t i, j, k;
    double orders;
};
constexpr std::array<Product, 10> products{{{0, 0, 0, 1},
                                            {1, 1, 1, 1},
                                            {2, 2, 2, 1},
                                            {0, 0, 1, 3},
                                            {0, 0, 2, 3},
                                            {0, 1, 1, 3},
                                            {1, 1, 2, 3},
                                            {0, 2, 2, 3},
                                            {1, 2, 2, 3},
                                            {0, 1, 2, 6}}};

using Axes = std::array<double, 3>;
Axes axes(const Wide& v) {
    return {v.x, v.y, v.z};
}

// Moments of the area vectors of a group's triangles, about its center. Those of a larger group follow from its parts.
// Only the symmetric parts of the tensors are kept: the expansion does not depend on the rest.
struct WindingSums {
    double area = 0;
    Wide weighted_center;  // sum of area * centroid
    Wide center;
    Wide dipole;
    std::array<Axes, 3> second{};    // integral of normal x offset
    std::array<double, 10> third{};  // integral of normal x offset x offset
    Bounds bounds;

    void include(const WindingSums& part) {
        area += part.area;
        weighted_center = weighted_center + part.weighted_center;
        dipole = dipole + part.dipole;
        bounds.include(part.bounds);
    }
    void choose_center() { center = area > 0 ? weighted_center * (1 / area) : wide(bounds.center()); }
    // The moments of a part, moved to this center.
    void include_moments(const WindingSums& part) {
        const Axes d = axes(part.center - center), n = axes(part.dipole);
        const auto& m = part.second;
        for (std::size_t p = 0; p < products.size(); ++p) {
            const auto [i, j, k, orders] = products[p];
            third[p] += part.third[p] + (2.0 / 3.0) * (m[i][j] * d[k] + m[i][k] * d[j] + m[j][k] * d[i]) +
                        (1.0 / 3.0) * (n[i] * d[j] * d[k] + n[j] * d[i] * d[k] + n[k] * d[i] * d[j]);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) second[i][j] += m[i][j] + 0.5 * (n[i] * d[j] + n[j] * d[i]);
        }
    }
    double squared_radius() const {  // up to the farthest corner of the bounds
        const auto farthest = [](float min, float max, double at) { return std::max(at - min, max - at); };
        const Wide r{farthest(bounds.min.x, bounds.max.x, center.x), farthest(bounds.min.y, bounds.max.y, center.y),
                     farthest(bounds.min.z, bounds.max.z, center.z)};
        return dot(r, r);
    }
};

WindingSums sums_of_triangle(Vec3 a, Vec3 b, Vec3 c) {
    WindingSums sums;
    sums.dipole = cross(wide(b) - wide(a), wide(c) - wide(a)) * 0.5;
    sums.area = std::sqrt(dot(sums.dipole, sums.dipole));
    sums.center = (wide(a) + wide(b) + wide(c)) * (1.0 / 3.0);
    sums.weighted_center = sums.center * sums.area;
    sums.bounds.include(a), sums.bounds.include(b), sums.bounds.include(c);
    const Axes n = axes(sums.dipole);
    for (const Vec3 corner : {a, b, c}) {  // the covariance of a triangle is a twelfth of the sum over its corners
        const Axes d = axes(wide(corner) - sums.center);
        for (std::size_t p = 0; p < products.size(); ++p) {
            const auto [i, j, k, orders] = products[p];
            sums.third[p] += (n[i] * d[j] * d[k] + n[j] * d[i] * d[k] + n[k] * d[i] * d[j]) / 36;
        }
    }
    return sums;
}

// Coefficients of the expansion, see expansion().
WindingGroup group_of(const WindingSums& sums) {
    WindingGroup group;
    group.center = narrow(sums.center);
    group.squared_radius = static_cast<float>(sums.squared_radius());
    group.dipole = narrow(sums.dipole);
    const auto& m = sums.second;
    const double third_of_trace = (m[0][0] + m[1][1] + m[2][2]) / 3;
    const double second[] = {m[0][0] - third_of_trace,
                             m[1][1] - third_of_trace,
                             m[2][2] - third_of_trace,
                             2 * m[0][1],
                             2 * m[0][2],
                             2 * m[1][2]};
    for (std::size_t p = 0; p < 6; ++p) group.second[p] = static_cast<float>(-3 * second[p]);
    const auto& s = sums.third;
    const Axes trace{s[0] + s[5] + s[7], s[3] + s[1] + s[8], s[4] + s[6] + s[2]};
    for (std::size_t p = 0; p < products.size(); ++p) {
        const auto [i, j, k, orders] = products[p];
        const double traces = (i == j ? trace[k] : 0) + (i == k ? trace[j] : 0) + (j == k ? trace[i] : 0);
        group.third[p] = static_cast<float>(7.5 * orders * (s[p] - traces / 5));
    }
    return group;
}

class WindingTreeBuilder {
  public:
    WindingTreeBuilder(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                       std::vector<WindingGroup>& groups, std::vector<std::uint32_t>& items)
        : positions_(positions), triangles_(triangles), groups_(groups), items_(items) {
        centers_.reserve(triangles.size());
        for (const auto& [a, b, c] : triangles) {
            centers_.push_back(narrow((wide(positions[a]) + wide(positions[b]) + wide(positions[c])) * (1.0 / 3.0)));
        }
    }

    // The depth of the recursion is at most log2 of the number of triangles.
    WindingSums build(std::uint32_t first, std::uint32_t count) {
        const std::size_t self = groups_.size();
        groups_.emplace_back();
        WindingSums sums;
        std::array<WindingSums, most_triangles> parts;
        std::size_t part_count = 0;
        if (count <= most_triangles) {
            for (std::uint32_t k = first; k < first + count; ++k) {
                const auto [a, b, c] = triangles_[items_[k]];
                parts[part_count++] = sums_of_triangle(positions_[a], positions_[b], positions_[c]);
            }
        } else {
            split(first, count);
            parts[part_count++] = build(first, count / 2);
            parts[part_count++] = build(first + count / 2, count - count / 2);
        }
        for (std::size_t k = 0; k < part_count; ++k) sums.include(parts[k]);
        sums.choose_center();
        for (std::size_t k = 0; k < part_count; ++k) sums.include_moments(parts[k]);
        groups_[self] = group_of(sums);
        groups_[self].first = first;
        groups_[self].count = count <= most_triangles ? count : 0;
        groups_[self].skip = static_cast<std::uint32_t>(groups_.size());
        return sums;
    }

  private:
    // At the median of the centroids along the longest axis. Ties go by number, so that the tree depends only on the
    // input.
    void split(std::uint32_t first, std::uint32_t count) {
        Bounds spread;
        for (std::uint32_t k = first; k < first + count; ++k) spread.include(centers_[items_[k]]);
        const Vec3 size = spread.size();
        const auto along = [&](Vec3 v) {
            return size.x >= size.y && size.x >= size.z ? v.x : size.y >= size.z ? v.y : v.z;
        };
        const auto begin = items_.begin() + first;
        std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t i, std::uint32_t j) {
            const float ci = along(centers_[i]), cj = along(centers_[j]);
            return ci < cj || (ci == cj && i < j);
        });
    }

    std::span<const Vec3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<WindingGroup>& groups_;
    std::vector<std::uint32_t>& items_;
    std::vector<Vec3> centers_;
};

// 4 pi times the winding number of the group's triangles at p. With r = x - p it is the integral of normal . r / |r|^3
// over the points x of the triangles, which the Taylor series of that function around the center approximates. The
// derivatives of r / |r|^3 are those of the harmonic function -1 / |r|, so only the traceless symmetric parts of the
// moments count, and each order has one term:
//   dipole . r / |r|^3  -  3 M(r, r) / |r|^5  +  15/2 S(r, r, r) / |r|^7
double expansion(const WindingGroup& g, const Wide& r, double r2) {
    const double inverse2 = 1 / r2, inverse3 = inverse2 * std::sqrt(inverse2);
    const double xx = r.x * r.x, yy = r.y * r.y, zz = r.z * r.z;
    const auto& m = g.second;
    const auto& s = g.third;
    const double second = m[0] * xx + m[1] * yy + m[2] * zz + r.x * (m[3] * r.y + m[4] * r.z) + m[5] * r.y * r.z;
    const double third = xx * (s[0] * r.x + s[3] * r.y + s[4] * r.z) + yy * (s[5] * r.x + s[1] * r.y + s[6] * r.z) +
                         zz * (s[7] * r.x + s[8] * r.y + s[2] * r.z) + s[9] * r.x * r.y * r.z;
    return inverse3 * (dot(wide(g.dipole), r) + inverse2 * (second + inverse2 * third));
}

// 4 pi times the gradient of the winding number of the group's triangles, of the first term alone.
Wide expansion_gradient(const WindingGroup& g, const Wide& r, double r2) {
    const double inverse2 = 1 / r2, inverse3 = inverse2 * std::sqrt(inverse2);
    const Wide dipole = wide(g.dipole);
    return (r * (3 * dot(dipole, r) * inverse2) - dipole) * inverse3;
}

// Twice the gradient of half_solid_angle(), which depends only on the triangle's sides: each adds the field that a
// current along it has by the law of Biot and Savart.
Wide solid_angle_gradient(const Wide& p, Vec3 corner_a, Vec3 corner_b, Vec3 corner_c) {
    const Wide corners[] = {wide(corner_a) - p, wide(corner_b) - p, wide(corner_c) - p};
    Wide sum;
    for (std::size_t i = 0; i < 3; ++i) {
        const Wide &a = corners[i], &b = corners[(i + 1) % 3];
        const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), along = la * lb * (la * lb + dot(a, b));
        if (along > 0) sum = sum + cross(a, b) * ((la + lb) / along);
    }
    return sum;
}

}  // namespace

double exact_winding_number(Vec3 point, std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    const Wide p = wide(point);
    double sum = 0;
    for (const auto& [a, b, c] : triangles) sum += half_solid_angle(p, positions[a], positions[b], positions[c]);
    return sum * per_half_angle;
}

WindingNumber::WindingNumber(std::span<const Vec3> positions, std::span<const Triangle> triangles)
    : positions_(positions), triangles_(triangles), items_(triangles.size()) {
    std::iota(items_.begin(), items_.end(), 0u);
    if (triangles.empty()) return;
    groups_.reserve(triangles.size() / 2);
    WindingTreeBuilder(positions, triangles, groups_, items_).build(0, static_cast<std::uint32_t>(items_.size()));
}

namespace {

// Calls far(group, r, r2) for groups that their expansions replace, and near(a, b, c) for all triangles of the others.
template <class Far, class Near>
void sum_windings(std::span<const WindingGroup> groups, std::span<const std::uint32_t> items,
                  std::span<const Triangle> triangles, const Wide& p, double accuracy, Far&& far, Near&& near) {
    const double accuracy2 = accuracy * accuracy;
    for (std::uint32_t n = 0; n < groups.size();) {
        const WindingGroup& group = groups[n];
        const Wide r = wide(group.center) - p;
        const double r2 = dot(r, r);
        if (r2 > accuracy2 * double{group.squared_radius}) {
            far(group, r, r2);
            n = group.skip;
            continue;
        }
        for (std::uint32_t k = group.first; k < group.first + group.count; ++k) near(triangles[items[k]]);
        ++n;  // the group's first part, or the next group after one without parts
    }
}

}  // namespace

double WindingNumber::at(Vec3 point, double accuracy) const {
    const Wide p = wide(point);
    double of_groups = 0, of_triangles = 0;
    sum_windings(
        groups_, items_, triangles_, p, accuracy,
        [&](const WindingGroup& group, const Wide& r, double r2) { of_groups += expansion(group, r, r2); },
        [&](const Triangle& t) {
            of_triangles += half_solid_angle(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]);
        });
    return of_groups * (0.5 * per_half_angle) + of_triangles * per_half_angle;
}

std::array<double, 3> WindingNumber::gradient_at(Vec3 point, double accuracy) const {
    const Wide p = wide(point);
    Wide sum;
    sum_windings(
        groups_, items_, triangles_, p, accuracy,
        [&](const WindingGroup& group, const Wide& r, double r2) { sum = sum + expansion_gradient(group, r, r2); },
        [&](const Triangle& t) {
            sum = sum + solid_angle_gradient(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]);
        });
    return axes(sum * (0.5 * per_half_angle));
}

}  // namespace weft
